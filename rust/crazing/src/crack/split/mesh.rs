//! Cells and the walls between them, as cells are split. Half-edge 2 k + s is wall k from its end s; its cell lies on
//! its left.

use super::chord::{Outline, Wall};
use super::founders::Founders;
use crate::clip::Bounds;
use crate::crack::net::NONE;
use crate::graph::Point;

pub(super) type Turn = [i32; 2];

/// Corners that a cell gets from its neighbours before its list must grow, usually.
const SPARE: usize = 4;

#[derive(Clone, Copy)]
pub(super) struct Edge {
    pub(super) ends: [u32; 2],
    /// On the left and on the right; -1 outside.
    pub(super) cells: [i32; 2],
    /// Age of its crack; -1 for the outline of the bounds, which is no crack.
    pub(super) age: i32,
    /// Periods crossed.
    pub(super) shift: [i8; 2],
}

/// A half-edge of a cell, and beside it what is looked at again and again of the vertex where it starts: cells are
/// split in no order of place, and to look it up elsewhere takes longer than all else.
#[derive(Clone, Copy)]
pub(super) struct Corner {
    at: Point,
    pub(super) half: u32,
    /// Periods crossed along the half-edge.
    shift: [i8; 2],
    /// Whether a junction or a corner of the bounds is there.
    is_node: bool,
}

pub(super) struct Mesh {
    pub(super) points: Vec<Point>,
    pub(super) edges: Vec<Edge>,
    /// For both ends of every wall the half-edge by which its crack goes on, as the end where that starts; -1 at the ends of the crack.
    pub(super) partners: Vec<[i32; 2]>,
    /// Counter-clockwise.
    pub(super) cells: Vec<Vec<Corner>>,
    pub(super) period: Point,
    ages: i32,
}

impl Mesh {
    /// One cell, the bounds.
    pub(super) fn of_box([xmin, ymin, xmax, ymax]: Bounds) -> Self {
        let points = vec![[xmin, ymin], [xmax, ymin], [xmax, ymax], [xmin, ymax]];
        let edge = |i: u32| Edge { ends: [i, (i + 1) % 4], shift: [0, 0], cells: [0, NONE], age: NONE };
        let corner = |i: u32| Corner { at: points[i as usize], half: 2 * i, shift: [0, 0], is_node: true };
        let cells = vec![(0..4).map(corner).collect()];
        let edges = (0..4).map(edge).collect();
        Self { points, edges, partners: vec![[NONE; 2]; 4], cells, period: [0.0; 2], ages: 0 }
    }

    /// One cell, a period of a torus between its founders.
    pub(super) fn of_founders(founders: &Founders, period: Point) -> Self {
        let (round, over) = (founders.ring.len() as u32, founders.across.len() as u32);
        let points: Vec<Point> = founders.ring.iter().chain(&founders.across).copied().collect();
        let end = Founders::END as u32;
        let ring = (0..round).map(|i| {
            let is_last = i + 1 == round;
            let shift = if is_last { founders.way.map(|x| x as i8) } else { [0, 0] };
            Edge { ends: [i, if is_last { 0 } else { i + 1 }], shift, cells: [0, 0], age: 0 }
        });
        let across = (0..=over).map(|i| {
            let ends = [if i == 0 { 0 } else { round + i - 1 }, if i == over { end } else { round + i }];
            let shift = if i == over { founders.shift.map(|x| x as i8) } else { [0, 0] };
            Edge { ends, shift, cells: [0, 0], age: 1 }
        });
        let edges: Vec<Edge> = ring.chain(across).collect();
        let around = (0..round).map(|i| [(i + round - 1) % round, (i + 1) % round].map(|k| k as i32));
        let around = around.map(|[before, after]| [2 * before + 1, 2 * after]);
        let partners = around.chain(chain(round as i32..(round + over) as i32 + 1)).collect();
        // Along the ring, over to its next turn, back, and down again.
        let outline = (0..round).map(|k| 2 * k);
        let outline = outline.chain((0..=over).map(|k| 2 * (round + k)));
        let outline = outline.chain((0..round).map(|k| 2 * ((2 * round + end - 1 - k) % round) + 1));
        let outline = outline.chain((0..=over).rev().map(|k| 2 * (round + k) + 1));
        let corner = |half: u32| {
            let edge = edges[half as usize / 2];
            let start = edge.ends[half as usize % 2] as usize;
            Corner {
                at: points[start],
                half,
                shift: along(edge.shift, half),
                is_node: start == 0 || start == Founders::END,
            }
        };
        let cells = vec![outline.map(corner).collect()];
        Self { points, edges, partners, cells, period, ages: 2 }
    }

    #[inline]
    fn moved(&self, p: Point, turn: Turn) -> Point {
        [p[0] + f64::from(turn[0]) * self.period[0], p[1] + f64::from(turn[1]) * self.period[1]]
    }

    /// Of each corner of a cell the periods between its vertex and where the polygon has it.
    pub(super) fn turns(&self, cell: usize) -> impl Iterator<Item = (&Corner, Turn)> {
        self.cells[cell].iter().scan([0, 0], |turn, corner| {
            let here = *turn;
            *turn = [0, 1].map(|i| here[i] + i32::from(corner.shift[i]));
            Some((corner, here))
        })
    }

    /// Corners, counter-clockwise; on a torus as one piece.
    pub(super) fn ring(&self, cell: usize) -> impl Iterator<Item = Point> {
        self.turns(cell).map(|(corner, turn)| self.moved(corner.at, turn))
    }

    /// The same with the first once more at the end, and the junctions among them.
    pub(super) fn lay_out(&self, cell: usize, Outline { ring, nodes, .. }: &mut Outline) {
        ring.clear();
        ring.extend(self.ring(cell));
        nodes.clear();
        nodes.extend(self.cells[cell].iter().zip(&*ring).filter(|(corner, _)| corner.is_node).map(|(_, p)| *p));
        ring.extend_from_within(..1);
    }

    /// Whether two sides of a cell are the two faces of one wall.
    pub(super) fn same_edge(&self, cell: usize, a: usize, b: usize) -> bool {
        self.cells[cell][a].half / 2 == self.cells[cell][b].half / 2
    }

    fn add_point(&mut self, p: Point) -> u32 {
        self.points.push(p);
        self.points.len() as u32 - 1
    }

    /// Puts a junction on a side of a cell, at a place of its polygon: the vertex, the half-edge that leaves it within
    /// the cell, and the periods between the vertex and the place.
    fn junction(&mut self, half: u32, turn: Turn, at: Point) -> (u32, u32, Turn) {
        let (k, side) = (half as usize / 2, half as usize % 2);
        let old = self.edges[k];
        // The frame of the wall's first end.
        let turn = if side == 0 { turn } else { [0, 1].map(|i| turn[i] - i32::from(old.shift[i])) };
        let at = self.moved(at, turn.map(|x| -x));
        let vertex = self.add_point(at);
        let more = self.edges.len() as u32;
        self.edges.push(Edge { ends: [vertex, old.ends[1]], ..old });
        self.edges[k] = Edge { ends: [old.ends[0], vertex], shift: [0, 0], ..old };
        let after = std::mem::replace(&mut self.partners[k][1], 2 * more as i32);
        self.partners.push([2 * k as i32 + 1, after]);
        if after != NONE {
            self.partners[after as usize / 2][after as usize % 2] = 2 * more as i32 + 1;
        }
        for (side, cell) in old.cells.into_iter().enumerate().filter(|&(_, cell)| cell != NONE) {
            let list = &mut self.cells[cell as usize];
            let half = 2 * k as u32 + side as u32;
            let Some(place) = list.iter().position(|corner| corner.half == half) else { continue };
            let halves = if side == 0 { [half, 2 * more] } else { [2 * more + 1, half] };
            let shifts = if side == 0 { [[0, 0], old.shift] } else { [along(old.shift, 1), [0, 0]] };
            (list[place].half, list[place].shift) = (halves[0], shifts[0]);
            if list.len() == list.capacity() {
                list.reserve_exact(SPARE);
            }
            list.insert(place + 1, Corner { at, half: halves[1], shift: shifts[1], is_node: true });
        }
        (vertex, if side == 0 { 2 * more } else { half }, turn)
    }

    /// Splits a cell by a wall; the new cell's number.
    pub(super) fn divide(&mut self, cell: usize, wall: &Wall) -> usize {
        let place = |side: usize| self.turns(cell).nth(side).map_or((0, [0, 0]), |(corner, turn)| (corner.half, turn));
        let [one, two] = wall.sides.map(place);
        let points = wall.line.points();
        let last = points.len() - 1;
        let (from, out_of_from, near) = self.junction(one.0, one.1, points[0]);
        let (to, out_of_to, far) = self.junction(two.0, two.1, points[last]);
        let other = self.cells.len();
        let first = self.edges.len() as u32;
        let mut before = from;
        for (i, &p) in points.iter().enumerate().skip(1) {
            let is_last = i == last;
            let after = if is_last { to } else { self.add_point(self.moved(p, near.map(|x| -x))) };
            let shift = if is_last { [0, 1].map(|i| (far[i] - near[i]) as i8) } else { [0, 0] };
            self.edges.push(Edge { ends: [before, after], shift, cells: [other as i32, cell as i32], age: self.ages });
            before = after;
        }
        let walls = first..self.edges.len() as u32;
        self.partners.extend(chain(walls.start as i32..walls.end as i32));
        self.ages += 1;
        self.share(cell, [out_of_from, out_of_to], walls);
        other
    }

    /// Shares the corners of a cell among its two halves: those from the first junction to the second stay.
    fn share(&mut self, cell: usize, [out_of_from, out_of_to]: [u32; 2], walls: std::ops::Range<u32>) {
        let mut kept = std::mem::take(&mut self.cells[cell]);
        let place = |list: &[Corner], half: u32| list.iter().position(|corner| corner.half == half).unwrap_or(0);
        let start = place(&kept, out_of_from);
        kept.rotate_left(start);
        let end = place(&kept, out_of_to);
        let corner = |half: u32| {
            let edge = self.edges[half as usize / 2];
            let start = edge.ends[half as usize % 2] as usize;
            let is_node = half == 2 * walls.start || half + 1 == 2 * walls.end;
            Corner { at: self.points[start], half, shift: along(edge.shift, half), is_node }
        };
        let mut given = Vec::with_capacity(kept.len() - end + walls.len() + SPARE);
        given.extend_from_slice(&kept[end..]);
        given.extend(walls.clone().map(|k| corner(2 * k)));
        kept.truncate(end);
        kept.extend(walls.clone().rev().map(|k| corner(2 * k + 1)));
        let other = self.cells.len() as i32;
        for &Corner { half, .. } in &given {
            self.edges[half as usize / 2].cells[half as usize % 2] = other;
        }
        self.cells[cell] = kept;
        self.cells.push(given);
    }
}

/// Periods crossed along a half-edge of a wall that crosses `shift`.
#[inline]
fn along([x, y]: [i8; 2], half: u32) -> [i8; 2] {
    if half.is_multiple_of(2) { [x, y] } else { [-x, -y] }
}

/// For both ends of each piece of a crack the one by which it goes on.
fn chain(pieces: std::ops::Range<i32>) -> impl Iterator<Item = [i32; 2]> {
    let (first, last) = (pieces.start, pieces.end - 1);
    pieces.map(move |k| [if k == first { NONE } else { 2 * k - 1 }, if k == last { NONE } else { 2 * k + 2 }])
}
