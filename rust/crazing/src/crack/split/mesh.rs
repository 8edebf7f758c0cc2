//! Cells and the walls between them, as cells are split. Half-edge 2 k + s is wall k from its end s; its cell lies on
//! its left.

use std::ops::Range;

use super::chord::{Outline, Wall};
use super::founders::Founders;
use super::lists::{Corner, Lists};
use crate::clip::Bounds;
use crate::crack::net::NONE;
use crate::graph::Point;

pub(super) type Turn = [i32; 2];

/// What of a wall is looked at again and again: its ends, and the cells on its left and on its right, -1 outside.
pub(super) type Sides = [i32; 4];

/// From here on walls are numbered that are no cracks, the outline of the bounds.
const BORDER: u32 = 1 << 30;

pub(super) struct Mesh {
    pub(super) points: Vec<Point>,
    pub(super) walls: Vec<Sides>,
    /// For both ends of every wall by which half-edge, written as the end where that starts, its crack goes on; -1 where
    /// it ends.
    pub(super) partners: Vec<[i32; 2]>,
    /// Of the crack of each wall.
    pub(super) ages: Vec<i32>,
    /// Periods that each wall crosses; empty in the plane.
    pub(super) shifts: Vec<[i8; 2]>,
    pub(super) border: Vec<Sides>,
    /// Counter-clockwise.
    pub(super) cells: Lists,
    pub(super) period: Point,
    age: i32,
}

impl Mesh {
    /// One cell, the bounds.
    pub(super) fn of_box([xmin, ymin, xmax, ymax]: Bounds) -> Self {
        let points = vec![[xmin, ymin], [xmax, ymin], [xmax, ymax], [xmin, ymax]];
        let corner = |(&at, k): (&Point, u32)| Corner { at, half: 2 * k, shift: [0, 0], is_node: true };
        let cells = Lists::of(points.iter().zip(BORDER..).map(corner));
        let border = (0..4).map(|i| [i, (i + 1) % 4, 0, NONE]).collect();
        let (walls, partners, ages, shifts) = Default::default();
        Self { points, walls, partners, ages, shifts, border, cells, period: [0.0; 2], age: 0 }
    }

    /// One cell, a period of a torus between its founders.
    pub(super) fn of_founders(founders: &Founders, period: Point) -> Self {
        let (round, over) = (founders.ring.len() as u32, founders.across.len() as u32);
        let points: Vec<Point> = founders.ring.iter().chain(&founders.across).copied().collect();
        let (end, pieces) = (Founders::END as u32, round..round + over + 1);
        let ring = (0..round).map(|i| [i, (i + 1) % round]);
        let across =
            pieces.clone().map(|k| [if k == round { 0 } else { k - 1 }, if k + 1 == pieces.end { end } else { k }]);
        let ends: Vec<[u32; 2]> = ring.chain(across).collect();
        let mut shifts = vec![[0; 2]; ends.len()];
        shifts[round as usize - 1] = founders.way.map(|x| x as i8);
        shifts[ends.len() - 1] = founders.shift.map(|x| x as i8);
        let around =
            (0..round).map(|k| [2 * ((k + round - 1) % round) + 1, 2 * ((k + 1) % round)].map(|end| end as i32));
        let partners = around.chain(pieces.clone().map(|k| partners(k, &pieces))).collect();
        let ages = (0..ends.len() as u32).map(|k| i32::from(k >= round)).collect();
        // Along the ring, over to its next turn, back, and down again.
        let outline = (0..round).map(|k| 2 * k);
        let outline = outline.chain(pieces.clone().map(|k| 2 * k));
        let outline = outline.chain((0..round).map(|k| 2 * ((2 * round + end - 1 - k) % round) + 1));
        let outline = outline.chain(pieces.rev().map(|k| 2 * k + 1));
        let corner = |half: u32| {
            let start = ends[half as usize / 2][half as usize % 2] as usize;
            let (shift, is_node) = (along(shifts[half as usize / 2], half), start == 0 || start == Founders::END);
            Corner { at: points[start], half, shift, is_node }
        };
        let cells = Lists::of(outline.map(corner));
        let walls = ends.iter().map(|&[a, b]| [a as i32, b as i32, 0, 0]).collect();
        Self { points, walls, partners, ages, shifts, border: Vec::new(), cells, period, age: 2 }
    }

    #[inline]
    fn moved(&self, p: Point, turn: Turn) -> Point {
        [p[0] + f64::from(turn[0]) * self.period[0], p[1] + f64::from(turn[1]) * self.period[1]]
    }

    /// Of each corner of a cell the periods between its vertex and where the polygon has it.
    pub(super) fn turns(&self, cell: usize) -> impl Iterator<Item = (&Corner, Turn)> {
        self.cells.list(cell).iter().scan([0, 0], |turn, corner| {
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
        nodes.extend(self.cells.list(cell).iter().zip(&*ring).filter(|(corner, _)| corner.is_node).map(|(_, p)| *p));
        ring.extend_from_within(..1);
    }

    /// Whether two sides of a cell are the two faces of one wall.
    pub(super) fn same_edge(&self, cell: usize, a: usize, b: usize) -> bool {
        let list = self.cells.list(cell);
        list[a].half / 2 == list[b].half / 2
    }

    fn add_point(&mut self, p: Point) -> i32 {
        self.points.push(p);
        self.points.len() as i32 - 1
    }

    #[inline]
    fn sides(&mut self, k: u32) -> &mut Sides {
        if k < BORDER { &mut self.walls[k as usize] } else { &mut self.border[(k - BORDER) as usize] }
    }

    fn shift(&self, k: u32) -> [i8; 2] {
        self.shifts.get(k as usize).copied().unwrap_or_default()
    }

    /// For both sides of a wall where it stands in the list of the cell there.
    fn spots(&mut self, k: u32) -> [usize; 2] {
        let [_, _, left, right] = *self.sides(k);
        let spot = |cell: i32, half: u32| if cell == NONE { 0 } else { place(self.cells.list(cell as usize), half) };
        [spot(left, 2 * k), spot(right, 2 * k + 1)]
    }

    /// Parts a wall at a new vertex: the number of its second part.
    fn part(&mut self, k: u32, vertex: i32) -> u32 {
        let sides = self.sides(k);
        let [start, end, left, right] = *sides;
        *sides = [start, vertex, left, right];
        let rest = [vertex, end, left, right];
        if k >= BORDER {
            self.border.push(rest);
            return BORDER + self.border.len() as u32 - 1;
        }
        let more = self.walls.len() as u32;
        self.walls.push(rest);
        let k = k as usize;
        self.ages.push(self.ages[k]);
        if let Some(shift) = self.shifts.get_mut(k) {
            let all = std::mem::take(shift);
            self.shifts.push(all);
        }
        let after = std::mem::replace(&mut self.partners[k][1], 2 * more as i32);
        self.partners.push([2 * k as i32 + 1, after]);
        if after != NONE {
            self.partners[after as usize / 2][after as usize % 2] = 2 * more as i32 + 1;
        }
        more
    }

    /// Puts a junction on a side of a cell, at a place of its polygon: the vertex, the half-edge that leaves it within
    /// the cell, and the periods between the vertex and the place. `spots` are right unless the lists changed since.
    fn junction(&mut self, half: u32, turn: Turn, at: Point, spots: [usize; 2]) -> (i32, u32, Turn) {
        let (k, side) = (half / 2, half % 2);
        let shift = self.shift(k);
        // The frame of the wall's first end.
        let turn = if side == 0 { turn } else { [0, 1].map(|i| turn[i] - i32::from(shift[i])) };
        let at = self.moved(at, turn.map(|x| -x));
        let vertex = self.add_point(at);
        let more = self.part(k, vertex);
        let [_, _, left, right] = *self.sides(k);
        // On the left what goes on is new, on the right what comes first.
        let changes =
            [(left, [2 * k, 2 * more], [[0, 0], shift]), (right, [2 * more + 1, 2 * k + 1], [along(shift, 1), [0, 0]])];
        for (side, (cell, halves, shifts)) in changes.into_iter().enumerate().filter(|(_, change)| change.0 != NONE) {
            let (cell, half) = (cell as usize, 2 * k + side as u32);
            let list = self.cells.list_mut(cell);
            let is_there = list.get(spots[side]).is_some_and(|corner| corner.half == half);
            let spot = if is_there { spots[side] } else { place(list, half) };
            (list[spot].half, list[spot].shift) = (halves[0], shifts[0]);
            self.cells.insert(cell, spot + 1, Corner { at, half: halves[1], shift: shifts[1], is_node: true });
        }
        (vertex, if side == 0 { 2 * more } else { half }, turn)
    }

    /// Splits a cell by a wall; the new cell's number.
    pub(super) fn divide(&mut self, cell: usize, wall: &Wall) -> usize {
        let side = |side: usize| self.turns(cell).nth(side).map_or((0, [0, 0]), |(corner, turn)| (corner.half, turn));
        let [one, two] = wall.sides.map(side);
        // Both before anything changes: memory answers both at once.
        let [spots, more] = [one, two].map(|(half, _)| self.spots(half / 2));
        let points = wall.line.points();
        let last = points.len() - 1;
        let (from, out_of_from, near) = self.junction(one.0, one.1, points[0], spots);
        let (to, out_of_to, far) = self.junction(two.0, two.1, points[last], more);
        let other = self.cells.len();
        let first = self.walls.len() as u32;
        let pieces = first..first + last as u32;
        let mut before = from;
        for (k, &p) in pieces.clone().zip(&points[1..]) {
            let is_last = k + 1 == pieces.end;
            let after = if is_last { to } else { self.add_point(self.moved(p, near.map(|x| -x))) };
            self.walls.push([before, after, other as i32, cell as i32]);
            self.partners.push(partners(k, &pieces));
            self.ages.push(self.age);
            before = after;
        }
        if self.period[0] > 0.0 {
            self.shifts.resize(self.walls.len() - 1, [0, 0]);
            self.shifts.push([0, 1].map(|i| (far[i] - near[i]) as i8));
        }
        self.age += 1;
        self.share(cell, [out_of_from, out_of_to], pieces);
        other
    }

    /// Shares the corners of a cell among its two halves: those from the first junction to the second stay.
    fn share(&mut self, cell: usize, [out_of_from, out_of_to]: [u32; 2], pieces: Range<u32>) {
        let list = self.cells.list_mut(cell);
        list.rotate_left(place(list, out_of_from));
        let end = place(list, out_of_to);
        let corner = |half: u32| {
            let start = self.walls[half as usize / 2][half as usize % 2] as usize;
            let shift = self.shifts.get(half as usize / 2).copied().unwrap_or_default();
            let is_node = half == 2 * pieces.start || half + 1 == 2 * pieces.end;
            Corner { at: self.points[start], half, shift: along(shift, half), is_node }
        };
        let (one, two) = (pieces.clone().rev().map(|k| corner(2 * k + 1)), pieces.clone().map(|k| corner(2 * k)));
        let other = self.cells.share(cell, end, one, two);
        for &Corner { half, .. } in self.cells.list(other) {
            let k = half / 2;
            let sides = if k < BORDER { &mut self.walls[k as usize] } else { &mut self.border[(k - BORDER) as usize] };
            sides[2 + half as usize % 2] = other as i32;
        }
    }
}

/// Where a half-edge stands in a list that has it. All of the list is read: what comes next need not wait for it.
fn place(list: &[Corner], half: u32) -> usize {
    list.iter().enumerate().fold(0, |found, (i, corner)| if corner.half == half { i } else { found })
}

/// Periods crossed along a half-edge of a wall that crosses `shift`.
#[inline]
fn along([x, y]: [i8; 2], half: u32) -> [i8; 2] {
    if half.is_multiple_of(2) { [x, y] } else { [-x, -y] }
}

/// See [`Mesh::partners`], for one of the pieces of a crack.
fn partners(k: u32, pieces: &Range<u32>) -> [i32; 2] {
    let [before, after] = [2 * k as i32 - 1, 2 * k as i32 + 2];
    [if k == pieces.start { NONE } else { before }, if k + 1 == pieces.end { NONE } else { after }]
}
