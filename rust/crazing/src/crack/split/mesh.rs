//! Cells and the walls between them, as cells are split. Half-edge 2 k + s is wall k from its end s; its cell lies on
//! its left.

use std::ops::Range;

use super::BORDER;
use super::chord::{Outline, Wall};
use super::corners::{Corner, Corners};
use super::founders::Founders;
use crate::clip::Bounds;
use crate::crack::net::NONE;
use crate::graph::Point;

pub(super) type Turn = [i32; 2];

/// So many cells are fetched together: enough for memory to be busy, few enough for the nearest caches.
pub(super) const TOGETHER: usize = 32;
/// Corners that most cells have.
const ROUND: usize = 24;
/// Walls of which it is put down later that they were parted.
const LATER: usize = 64;

/// A wall that was parted at a vertex, and what goes on from there.
struct Parted {
    wall: u32,
    vertex: i32,
    rest: u32,
}

pub(super) struct Mesh {
    /// How many vertices there are.
    pub(super) count: usize,
    pub(super) corners: Corners,
    /// Of each cell the half-edge from which on it is told.
    pub(super) firsts: Vec<u32>,
    /// Vertices at both ends of each wall. These and the next two are right but for what is in `parted`.
    pub(super) walls: Vec<[i32; 2]>,
    /// For both ends of every wall by which half-edge, written as the end where that starts, its crack goes on; -1 where
    /// it ends.
    pub(super) partners: Vec<[i32; 2]>,
    /// Of the crack of each wall.
    pub(super) ages: Vec<i32>,
    /// Nobody asks for ends, partners and ages while cells are split: memory answers for many at once.
    parted: Vec<Parted>,
    /// Vertices at both ends of each side of the bounds, or part of one.
    pub(super) border: Vec<[i32; 2]>,
    /// Zeros in the plane.
    pub(super) period: Point,
    age: i32,
}

impl Mesh {
    /// One cell, the bounds.
    pub(super) fn of_box([xmin, ymin, xmax, ymax]: Bounds) -> Self {
        let points = [[xmin, ymin], [xmax, ymin], [xmax, ymax], [xmin, ymax]];
        let mut corners = Corners::default();
        for at in points {
            corners.push_like(BORDER, [Corner { at, cell: 0, is_node: true, ..Corner::OUTSIDE }, Corner::OUTSIDE]);
        }
        corners.close((BORDER..BORDER + 4).map(|k| 2 * k));
        let border = (0..4).map(|i| [i, (i + 1) % 4]).collect();
        let (walls, partners, ages, parted) = Default::default();
        let firsts = vec![2 * BORDER];
        Self { count: 4, corners, firsts, walls, partners, ages, parted, border, period: [0.0; 2], age: 0 }
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
            Corner { at: points[start], cell: 0, shift, is_node, ..Corner::OUTSIDE }
        };
        let mut corners = Corners::default();
        for k in 0..ends.len() as u32 {
            corners.push_like(0, [corner(2 * k), corner(2 * k + 1)]);
        }
        corners.close(outline);
        let walls = ends.iter().map(|ends| ends.map(|end| end as i32)).collect();
        let (parted, border) = Default::default();
        Self { count: points.len(), corners, firsts: vec![0], walls, partners, ages, parted, border, period, age: 2 }
    }

    #[inline]
    fn moved(&self, p: Point, turn: Turn) -> Point {
        if turn == [0, 0] {
            // As below: a zero without a sign.
            return p.map(|x| x + 0.0);
        }
        [p[0] + f64::from(turn[0]) * self.period[0], p[1] + f64::from(turn[1]) * self.period[1]]
    }

    /// The half-edges around a cell, counter-clockwise, and of each the periods between its vertex and where the polygon
    /// has it.
    pub(super) fn turns(&self, cell: usize) -> impl Iterator<Item = (u32, &Corner, Turn)> {
        let first = self.firsts[cell];
        let (mut next, mut turn) = (Some(first), [0, 0]);
        std::iter::from_fn(move || {
            let (half, here) = (next?, turn);
            let corner = self.corners.get(half);
            next = (corner.next != first).then_some(corner.next);
            if corner.shift != [0, 0] {
                turn = [0, 1].map(|i| here[i] + i32::from(corner.shift[i]));
            }
            Some((half, corner, here))
        })
    }

    /// Corners, counter-clockwise; on a torus as one piece.
    pub(super) fn ring(&self, cell: usize) -> impl Iterator<Item = Point> {
        self.turns(cell).map(|(_, corner, turn)| self.moved(corner.at, turn))
    }

    /// The same with the first once more at the end, the junctions among them, and the sides.
    pub(super) fn lay_out(&self, cell: usize, Outline { ring, nodes, sides, .. }: &mut Outline) {
        ring.clear();
        nodes.clear();
        sides.clear();
        for (half, corner, turn) in self.turns(cell) {
            let p = self.moved(corner.at, turn);
            ring.push(p);
            sides.push((half, turn));
            if corner.is_node {
                nodes.push(p);
            }
        }
        ring.extend_from_within(..1);
    }

    /// Goes around up to [`TOGETHER`] cells at once, for memory to answer for all of them while it is waited for the
    /// first: whoever looks at them soon need not wait.
    pub(super) fn fetch(&self, cells: impl Iterator<Item = usize>) {
        let mut around = [0; TOGETHER];
        let mut count = 0;
        for (half, cell) in around.iter_mut().zip(cells) {
            *half = self.firsts[cell];
            count += 1;
        }
        for _ in 0..ROUND {
            for half in &mut around[..count] {
                *half = self.corners.get(*half).next;
            }
        }
        std::hint::black_box(around);
    }

    fn add_vertex(&mut self) -> i32 {
        self.count += 1;
        self.count as i32 - 1
    }

    /// Parts a wall at a new vertex: the number of its second part.
    fn part(&mut self, wall: u32, vertex: i32) -> u32 {
        if wall >= BORDER {
            let [start, end] = self.border[(wall - BORDER) as usize];
            self.border[(wall - BORDER) as usize] = [start, vertex];
            self.border.push([vertex, end]);
            return BORDER + self.border.len() as u32 - 1;
        }
        let rest = self.walls.len() as u32;
        self.walls.push([vertex, NONE]);
        self.partners.push([2 * wall as i32 + 1, NONE]);
        self.ages.push(0);
        self.parted.push(Parted { wall, vertex, rest });
        rest
    }

    /// Puts down what was parted.
    pub(super) fn settle(&mut self) {
        for &Parted { wall, vertex, rest } in &self.parted {
            let (k, more) = (wall as usize, rest as usize);
            self.ages[more] = self.ages[k];
            self.walls[more][1] = std::mem::replace(&mut self.walls[k][1], vertex);
            let after = std::mem::replace(&mut self.partners[k][1], 2 * rest as i32);
            self.partners[more][1] = after;
            if after != NONE {
                self.partners[after as usize / 2][after as usize % 2] = 2 * rest as i32 + 1;
            }
        }
        self.parted.clear();
    }

    /// Puts a junction on a side of a cell, at a place of its polygon: the vertex, the half-edge that leaves it within
    /// the cell, and the periods between the vertex and the place.
    fn junction(&mut self, (half, turn): (u32, Turn), at: Point) -> (i32, u32, Turn) {
        let (k, side) = (half / 2, half % 2);
        let [left, right] = [2 * k, 2 * k + 1].map(|half| *self.corners.get(half));
        // The frame of the wall's first end.
        let turn = if side == 0 { turn } else { [0, 1].map(|i| turn[i] - i32::from(left.shift[i])) };
        let at = self.moved(at, turn.map(|x| -x));
        let vertex = self.add_vertex();
        let more = self.part(k, vertex);
        let corners = &mut self.corners;
        // On the left what goes on is new, on the right what comes first.
        let new = Corner { at, is_node: true, is_first: false, ..left };
        corners.push_like(k, [new, Corner { shift: along(left.shift, 1), ..right }]);
        corners.get_mut(2 * k).shift = [0, 0];
        if right.cell != NONE {
            let corner = corners.get_mut(2 * k + 1);
            *corner = Corner { at, is_node: true, is_first: false, shift: [0, 0], ..right };
            corners.link(right.before, 2 * more + 1);
            corners.link(2 * more + 1, 2 * k + 1);
            if right.is_first {
                self.firsts[right.cell as usize] = 2 * more + 1;
            }
        }
        // Looked up again: where a wall turns back on itself it has just changed.
        let next = corners.get(2 * k).next;
        corners.link(2 * more, next);
        corners.link(2 * k, 2 * more);
        (vertex, if side == 0 { 2 * more } else { half }, turn)
    }

    /// Splits a cell, laid out, by a wall; the new cell's number.
    pub(super) fn divide(&mut self, cell: usize, wall: &Wall, outline: &Outline) -> usize {
        if self.parted.len() >= LATER {
            self.settle();
        }
        let [one, two] = wall.sides.map(|side| outline.sides[side]);
        let points = wall.line.points();
        let last = points.len() - 1;
        let (from, out_of_from, near) = self.junction(one, points[0]);
        let (to, out_of_to, far) = self.junction(two, points[last]);
        let other = self.firsts.len();
        let first = self.walls.len() as u32;
        let pieces = first..first + last as u32;
        let (mut before, mut start) = (from, self.corners.get(out_of_from).at);
        for (k, &p) in pieces.clone().zip(&points[1..]) {
            let is_last = k + 1 == pieces.end;
            let after = if is_last { to } else { self.add_vertex() };
            let end = if is_last { self.corners.get(out_of_to).at } else { self.moved(p, near.map(|x| -x)) };
            let shift = if is_last { [0, 1].map(|i| (far[i] - near[i]) as i8) } else { [0, 0] };
            let left = Corner { at: start, cell: other as i32, shift, is_node: k == first, ..Corner::OUTSIDE };
            let shift = along(shift, 1);
            let right = Corner { at: end, cell: cell as i32, shift, is_node: is_last, ..Corner::OUTSIDE };
            self.corners.push_like(k, [left, right]);
            self.walls.push([before, after]);
            self.partners.push(partners(k, &pieces));
            self.ages.push(self.age);
            (before, start) = (after, end);
        }
        self.age += 1;
        self.share(cell, [out_of_from, out_of_to], pieces);
        other
    }

    /// Shares the corners of a cell among its two halves: those from the first junction to the second stay.
    fn share(&mut self, cell: usize, [out_of_from, out_of_to]: [u32; 2], pieces: Range<u32>) {
        let (other, corners) = (self.firsts.len(), &mut self.corners);
        let [into_from, into_to] = [out_of_from, out_of_to].map(|half| corners.get(half).before);
        let mut half = out_of_to;
        while half != out_of_from {
            let corner = corners.get_mut(half);
            (corner.cell, half) = (other as i32, corner.next);
        }
        for k in pieces.start..pieces.end - 1 {
            corners.link(2 * k, 2 * k + 2);
            corners.link(2 * k + 3, 2 * k + 1);
        }
        let (first, last) = (pieces.start, pieces.end - 1);
        corners.link(into_from, 2 * first);
        corners.link(2 * last, out_of_to);
        corners.link(into_to, 2 * last + 1);
        corners.link(2 * first + 1, out_of_from);
        corners.get_mut(self.firsts[cell]).is_first = false;
        for half in [out_of_from, out_of_to] {
            corners.get_mut(half).is_first = true;
        }
        self.firsts[cell] = out_of_from;
        self.firsts.push(out_of_to);
    }
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
