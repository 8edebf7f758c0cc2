//! Cells and the walls between them, as cells are split. Half-edge 2 k + s is wall k from its end s; its cell lies on
//! its left.

use super::chord::Wall;
use super::founders::Founders;
use super::moments;
use crate::clip::Bounds;
use crate::crack::aged::{Aged, by_age};
use crate::crack::fence::Fence;
use crate::crack::net::{NONE, Net};
use crate::graph::Point;
use crate::parallel;
use crate::predicates::orientation;

type Turn = [i32; 2];

#[derive(Clone, Copy)]
struct Edge {
    ends: [u32; 2],
    /// Periods crossed.
    shift: Turn,
    /// On the left and on the right; -1 outside.
    cells: [i32; 2],
    /// Age of its crack; -1 for the outline of the bounds, which is no crack.
    age: i32,
}

pub(super) struct Mesh {
    points: Vec<Point>,
    /// Whether a junction or a corner is there.
    is_node: Vec<bool>,
    edges: Vec<Edge>,
    /// Half-edges, counter-clockwise.
    pub(super) cells: Vec<Vec<u32>>,
    period: Point,
    ages: i32,
}

impl Mesh {
    /// One cell, the bounds.
    pub(super) fn of_box([xmin, ymin, xmax, ymax]: Bounds) -> Self {
        let points = vec![[xmin, ymin], [xmax, ymin], [xmax, ymax], [xmin, ymax]];
        let edge = |i: u32| Edge { ends: [i, (i + 1) % 4], shift: [0, 0], cells: [0, NONE], age: NONE };
        let cells = vec![vec![0, 2, 4, 6]];
        let edges = (0..4).map(edge).collect();
        Self { points, is_node: vec![true; 4], edges, cells, period: [0.0; 2], ages: 0 }
    }

    /// One cell, a period of a torus between its founders.
    pub(super) fn of_founders(founders: &Founders, period: Point) -> Self {
        let (round, over) = (founders.ring.len() as u32, founders.across.len() as u32);
        let points: Vec<Point> = founders.ring.iter().chain(&founders.across).copied().collect();
        let end = Founders::END as u32;
        let ring = (0..round).map(|i| {
            let is_last = i + 1 == round;
            let shift = if is_last { founders.way } else { [0, 0] };
            Edge { ends: [i, if is_last { 0 } else { i + 1 }], shift, cells: [0, 0], age: 0 }
        });
        let across = (0..=over).map(|i| {
            let ends = [if i == 0 { 0 } else { round + i - 1 }, if i == over { end } else { round + i }];
            let shift = if i == over { founders.shift } else { [0, 0] };
            Edge { ends, shift, cells: [0, 0], age: 1 }
        });
        let edges: Vec<Edge> = ring.chain(across).collect();
        // Along the ring, over to its next turn, back, and down again.
        let outline = (0..round).map(|k| 2 * k);
        let outline = outline.chain((0..=over).map(|k| 2 * (round + k)));
        let outline = outline.chain((0..round).map(|k| 2 * ((2 * round + end - 1 - k) % round) + 1));
        let outline = outline.chain((0..=over).rev().map(|k| 2 * (round + k) + 1));
        let is_node = (0..points.len()).map(|i| i == 0 || i == Founders::END).collect();
        Self { points, is_node, edges, cells: vec![outline.collect()], period, ages: 2 }
    }

    #[inline]
    fn start(&self, half: u32) -> usize {
        self.edges[half as usize / 2].ends[half as usize % 2] as usize
    }

    /// Periods crossed along a half-edge.
    #[inline]
    fn shift(&self, half: u32) -> Turn {
        let [x, y] = self.edges[half as usize / 2].shift;
        if half.is_multiple_of(2) { [x, y] } else { [-x, -y] }
    }

    #[inline]
    fn moved(&self, p: Point, turn: Turn) -> Point {
        [p[0] + f64::from(turn[0]) * self.period[0], p[1] + f64::from(turn[1]) * self.period[1]]
    }

    /// For each half-edge of a cell the periods between its start and where the polygon has it.
    fn turns(&self, cell: usize) -> Vec<Turn> {
        let mut turn = [0, 0];
        let step = |&half: &u32| {
            let here = turn;
            let shift = self.shift(half);
            turn = [turn[0] + shift[0], turn[1] + shift[1]];
            here
        };
        self.cells[cell].iter().map(step).collect()
    }

    /// Corners, counter-clockwise; on a torus as one piece.
    pub(super) fn polygon(&self, cell: usize) -> Vec<Point> {
        let mut turn = [0, 0];
        let mut polygon = Vec::with_capacity(self.cells[cell].len());
        for &half in &self.cells[cell] {
            polygon.push(self.moved(self.points[self.start(half)], turn));
            let [x, y] = self.shift(half);
            turn = [turn[0] + x, turn[1] + y];
        }
        polygon
    }

    /// Area and middle of a cell.
    pub(super) fn measure(&self, cell: usize) -> (f64, Point) {
        let (area, middle, _) = moments(&self.polygon(cell));
        (area, middle)
    }

    /// Distance from a place to the nearest junction of a cell.
    pub(super) fn gap(&self, cell: usize, polygon: &[Point], at: Point) -> f64 {
        let nodes = self.cells[cell].iter().zip(polygon).filter(|(half, _)| self.is_node[self.start(**half)]);
        let square = |p: &Point| (p[0] - at[0]) * (p[0] - at[0]) + (p[1] - at[1]) * (p[1] - at[1]);
        nodes.map(|(_, p)| square(p)).fold(f64::INFINITY, f64::min).sqrt()
    }

    /// Whether two sides of a cell are the two faces of one wall.
    pub(super) fn same_edge(&self, cell: usize, a: usize, b: usize) -> bool {
        self.cells[cell][a] / 2 == self.cells[cell][b] / 2
    }

    fn add_point(&mut self, p: Point, is_node: bool) -> u32 {
        self.points.push(p);
        self.is_node.push(is_node);
        self.points.len() as u32 - 1
    }

    /// Puts a junction on a side of a cell, at a place of its polygon: the vertex, the half-edge that leaves it within
    /// the cell, and the periods between the vertex and the place.
    fn junction(&mut self, half: u32, turn: Turn, at: Point) -> (u32, u32, Turn) {
        let (k, side) = (half as usize / 2, half as usize % 2);
        let old = self.edges[k];
        // The frame of the wall's first end.
        let turn = if side == 0 { turn } else { [turn[0] - old.shift[0], turn[1] - old.shift[1]] };
        let vertex = self.add_point(self.moved(at, turn.map(|x| -x)), true);
        let more = self.edges.len() as u32;
        self.edges.push(Edge { ends: [vertex, old.ends[1]], ..old });
        self.edges[k] = Edge { ends: [old.ends[0], vertex], shift: [0, 0], ..old };
        for (side, cell) in old.cells.into_iter().enumerate().filter(|&(_, cell)| cell != NONE) {
            let list = &mut self.cells[cell as usize];
            let half = 2 * k as u32 + side as u32;
            if let Some(place) = list.iter().position(|&other| other == half) {
                let pair = if side == 0 { [half, 2 * more] } else { [2 * more + 1, half] };
                list.splice(place..=place, pair);
            }
        }
        (vertex, if side == 0 { 2 * more } else { half }, turn)
    }

    /// Splits a cell by a wall; the new cell's number.
    pub(super) fn divide(&mut self, cell: usize, wall: &Wall) -> usize {
        let turns = self.turns(cell);
        let [one, two] = wall.sides.map(|side| (self.cells[cell][side], turns[side]));
        let last = wall.points.len() - 1;
        let (from, out_of_from, near) = self.junction(one.0, one.1, wall.points[0]);
        let (to, out_of_to, far) = self.junction(two.0, two.1, wall.points[last]);
        let other = self.cells.len();
        let first = self.edges.len() as u32;
        let mut before = from;
        for (i, &p) in wall.points.iter().enumerate().skip(1) {
            let is_last = i == last;
            let after = if is_last { to } else { self.add_point(self.moved(p, near.map(|x| -x)), false) };
            let shift = if is_last { [far[0] - near[0], far[1] - near[1]] } else { [0, 0] };
            self.edges.push(Edge { ends: [before, after], shift, cells: [other as i32, cell as i32], age: self.ages });
            before = after;
        }
        self.ages += 1;
        self.share(cell, out_of_from, out_of_to, first..self.edges.len() as u32);
        other
    }

    /// Shares the half-edges of a cell among its two halves: those from the first junction to the second stay.
    fn share(&mut self, cell: usize, out_of_from: u32, out_of_to: u32, wall: std::ops::Range<u32>) {
        let list = std::mem::take(&mut self.cells[cell]);
        let place = |half: u32| list.iter().position(|&other| other == half).unwrap_or(0);
        let (start, end) = (place(out_of_from), place(out_of_to));
        let between = |start: usize, end: usize| {
            let count = (end + list.len() - start) % list.len();
            (0..count).map(|i| list[(start + i) % list.len()]).collect::<Vec<u32>>()
        };
        let (mut kept, mut given) = (between(start, end), between(end, start));
        kept.extend(wall.clone().rev().map(|k| 2 * k + 1));
        given.extend(wall.map(|k| 2 * k));
        let other = self.cells.len() as i32;
        for &half in &given {
            self.edges[half as usize / 2].cells[half as usize % 2] = other;
        }
        self.cells[cell] = kept;
        self.cells.push(given);
    }

    /// The cracks, without the outline.
    pub(super) fn finish(self) -> Aged {
        let drawn: Vec<usize> = (0..self.edges.len()).filter(|&k| self.edges[k].age != NONE).collect();
        let mut number = vec![NONE; self.points.len()];
        let mut order = Vec::new();
        for &end in drawn.iter().flat_map(|&k| &self.edges[k].ends) {
            if number[end as usize] == NONE {
                number[end as usize] = order.len() as i32;
                order.push(end as usize);
            }
        }
        let mut cut = vec![false; order.len()];
        for edge in self.edges.iter().filter(|edge| edge.age == NONE) {
            for end in edge.ends.map(|end| number[end as usize]).into_iter().filter(|&end| end != NONE) {
                cut[end as usize] = true;
            }
        }
        let torus = self.period[0] > 0.0;
        let net = Net {
            vertices: order.iter().map(|&old| self.points[old]).collect(),
            edges: drawn.iter().map(|&k| self.edges[k].ends.map(|end| number[end as usize])).collect(),
            shifts: if torus {
                drawn.iter().map(|&k| self.edges[k].shift.map(|x| x as i8)).collect()
            } else {
                Vec::new()
            },
            period: self.period,
            cut,
        };
        let age: Vec<i32> = drawn.iter().map(|&k| self.edges[k].age).collect();
        let fence = self.fence(&drawn, &net);
        let partner = by_age(&net, &age);
        Aged { net, fence, partner, age }
    }

    /// The middle of each cell whose walls all see it.
    fn fence(&self, drawn: &[usize], net: &Net) -> Fence {
        let mut anchors = Vec::new();
        // Anchor and shift from the wall's first end, for both sides of every wall.
        let mut apexes = vec![[(NONE, [0, 0]); 2]; self.edges.len()];
        let middles = parallel::map(self.cells.len(), |cell| {
            let polygon = self.polygon(cell);
            let (area, middle, _) = moments(&polygon);
            let seen = |i: usize| {
                let next = if i + 1 == polygon.len() { 0 } else { i + 1 };
                orientation(polygon[i], polygon[next], middle) > 1e-9 * area
            };
            (0..polygon.len()).all(seen).then_some(middle)
        });
        for (cell, middle) in middles.into_iter().enumerate() {
            let Some(middle) = middle else { continue };
            let anchor = (net.vertices.len() + anchors.len()) as i32;
            anchors.push(middle);
            for (&half, turn) in self.cells[cell].iter().zip(self.turns(cell)) {
                let shift = self.edges[half as usize / 2].shift;
                let turn = if half.is_multiple_of(2) { turn } else { [turn[0] - shift[0], turn[1] - shift[1]] };
                apexes[half as usize / 2][half as usize % 2] = (anchor, turn.map(|x| -x as i8));
            }
        }
        let kite = |(&[a, b], &k): (&[i32; 2], &usize)| [a, b, apexes[k][0].0, apexes[k][1].0];
        let shift = |&k: &usize| {
            let ([(_, left), (_, right)], shift) = (apexes[k], self.edges[k].shift.map(|x| x as i8));
            [shift[0], shift[1], left[0], left[1], right[0], right[1]]
        };
        let shifts = if net.shifts.is_empty() { Vec::new() } else { drawn.iter().map(shift).collect() };
        Fence { anchors, kites: net.edges.iter().zip(drawn).map(kite).collect(), shifts }
    }
}
