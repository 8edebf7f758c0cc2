//! The fence around a drawing: triangles that pave the plane about its edges. While a vertex moves, all triangles at
//! it must stay counter-clockwise; then no edge can cross another, and none can change sides.
//!
//! The law behind it: triangles that are all counter-clockwise, and whose outline does not move, pave the same region
//! as before, each point once. Edges are sides of triangles, so they cannot meet but at their ends.

use super::net::{NONE, NetView};
use crate::diagram::scale::{Scale, largest};
use crate::error::{Error, Result};
use crate::graph::{Point, check_indices};
use crate::incidence::Incidence;
use crate::parallel;
use crate::predicates::orientation;
use crate::watch::Watch;

/// No triangle that moves may become flatter than this part of the square of its longest side, unless it was:
/// copies of a place on a torus differ by roundings, and pictures have a resolution.
const FLAT: f64 = 1e-9;

/// A sum of two products above this part of their sizes has the sign it seems to have.
const SURE: f64 = 16.0 * f64::EPSILON;

/// Two triangles an edge: kite `[a, b, left, right]` holds `a b left` and `b a right`. Kite `k` is about edge `k` of
/// the drawing; more may follow, about edges that are not drawn. Nothing at a kite with a -1 moves.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Fence {
    /// Points that do not move; numbered after the vertices of the drawing.
    pub anchors: Vec<Point>,
    /// Rows of vertices and anchors.
    pub kites: Vec<[i32; 4]>,
    /// Periods between `a` and each of `b`, `left`, `right`; empty in the plane.
    pub shifts: Vec<[i8; 6]>,
}

/// The arrays of a [`Fence`], borrowed.
#[derive(Debug, Clone, Copy)]
pub struct FenceView<'a> {
    /// See [`Fence::anchors`].
    pub anchors: &'a [Point],
    /// See [`Fence::kites`].
    pub kites: &'a [[i32; 4]],
    /// See [`Fence::shifts`].
    pub shifts: &'a [[i8; 6]],
}

impl Fence {
    /// A fence without room: no vertex of the drawing moves.
    pub fn shut(net: NetView<'_>) -> Self {
        let kites = net.edges.iter().map(|&[a, b]| [a, b, NONE, NONE]).collect();
        Self { anchors: Vec::new(), kites, shifts: vec![[0; 6]; net.shifts.len()] }
    }

    /// Borrows the arrays.
    pub fn view(&self) -> FenceView<'_> {
        FenceView { anchors: &self.anchors, kites: &self.kites, shifts: &self.shifts }
    }
}

impl FenceView<'_> {
    /// A copy that owns its arrays.
    pub fn to_fence(&self) -> Fence {
        Fence { anchors: self.anchors.to_vec(), kites: self.kites.to_vec(), shifts: self.shifts.to_vec() }
    }

    /// Checks that the fence fits the drawing.
    ///
    /// # Errors
    /// [`Error::BadIndex`], [`Error::BadLength`], [`Error::Inconsistent`].
    pub fn check(&self, net: NetView<'_>) -> Result<()> {
        check_indices("kites", self.kites, NONE, net.vertices.len() + self.anchors.len())?;
        if self.kites.len() < net.edges.len() {
            return Err(Error::BadLength { array: "kites", found: self.kites.len(), wanted: net.edges.len() });
        }
        if !self.shifts.is_empty() && self.shifts.len() != self.kites.len() {
            return Err(Error::BadLength { array: "shifts", found: self.shifts.len(), wanted: self.kites.len() });
        }
        let differs = |k: &usize| self.kites[*k][..2] != net.edges[*k];
        match (0..net.edges.len()).find(differs).or(self.kites.iter().position(|kite| kite[0] < 0 || kite[1] < 0)) {
            Some(row) => Err(Error::Inconsistent { array: "kites", row }),
            None => Ok(()),
        }
    }
}

/// A part of the way.
#[inline]
fn part_of(part: f64, from: Point, to: Point) -> Point {
    [from[0] + part * (to[0] - from[0]), from[1] + part * (to[1] - from[1])]
}

/// Vertices that move, and what keeps them from crossing.
pub(super) struct Guard<'a> {
    fence: FenceView<'a>,
    period: Point,
    scale: Scale,
    /// Vertices, then anchors, in the unit of exact work.
    points: Vec<Point>,
    /// Where vertices are to be; kept for its memory.
    goals: Vec<Point>,
    movable: usize,
    /// No coordinate is much larger than this.
    large: f64,
}

impl<'a> Guard<'a> {
    pub(super) fn of(net: NetView<'_>, fence: FenceView<'a>) -> Self {
        let large = largest(net.vertices).max(largest(fence.anchors)).max(net.period[0]).max(net.period[1]);
        let scale = Scale::of(large);
        let points: Vec<Point> = net.vertices.iter().chain(fence.anchors).map(|&p| scale.down(p)).collect();
        let [large, _] = scale.down([large, 0.0]);
        let period = scale.down(net.period);
        Self { fence, period, scale, points, goals: Vec::new(), movable: net.vertices.len(), large }
    }

    pub(super) fn place(&self, vertex: usize) -> Point {
        self.points[vertex]
    }

    pub(super) fn period(&self) -> Point {
        self.period
    }

    /// Positions of the vertices in the unit of the drawing.
    pub(super) fn into_vertices(self) -> Vec<Point> {
        self.points[..self.movable].iter().map(|&p| self.scale.up(p)).collect()
    }

    /// Where a vertex is after `step`, in the unit of the drawing.
    pub(super) fn shoved(&self, vertex: usize, step: Point) -> Point {
        let (from, step) = (self.points[vertex], self.scale.down(step));
        [from[0] + step[0], from[1] + step[1]]
    }

    /// Moves vertices, each at most once, to targets in the unit of exact work, one after the other: all the way, or
    /// half of it, or a quarter, or not at all.
    ///
    /// Most may go whatever the others do; that is found out on all cores. The rest goes in turn, each seeing those
    /// before it moved and those behind it not.
    pub(super) fn advance(&mut self, moves: &[(u32, Point)], watch: Watch<'_>) -> Result<()> {
        let mut after = std::mem::take(&mut self.goals);
        after.clear();
        after.extend_from_slice(&self.points[..self.movable]);
        for &(vertex, to) in moves {
            after[vertex as usize] = part_of(1.0, self.points[vertex as usize], to);
        }
        let in_turn = self.in_turn(moves, &after);
        watch.poll()?;
        let mut turn = vec![u32::MAX; self.movable];
        for (i, &(vertex, _)) in moves.iter().enumerate() {
            turn[vertex as usize] = i as u32;
        }
        let about = self.kites_about(&in_turn);
        for (i, &(vertex, to)) in in_turn.iter().enumerate() {
            watch.poll_at(i)?;
            let mine = turn[vertex as usize];
            let is_before = |other: usize| other < self.movable && turn[other] < mine;
            let now = |other: usize| if is_before(other) { after[other] } else { self.points[other] };
            after[vertex as usize] = self.farthest(about.at(i), vertex as usize, to, now);
        }
        self.points[..self.movable].copy_from_slice(&after);
        self.goals = after;
        Ok(())
    }

    /// The kites that hold each of the vertices that move in turn.
    fn kites_about(&self, in_turn: &[(u32, Point)]) -> Incidence {
        let mut number = vec![NONE; self.movable];
        for (i, &(vertex, _)) in in_turn.iter().enumerate() {
            number[vertex as usize] = i as i32;
        }
        let number_of = |corner: i32| number.get(corner as usize).copied().unwrap_or(NONE);
        let held = parallel::ranges(self.fence.kites.len(), |range| {
            let all = range.map(|row| (row as u32, self.fence.kites[row].map(number_of)));
            all.filter(|(_, numbers)| numbers.iter().any(|&number| number != NONE)).collect::<Vec<_>>()
        });
        Incidence::of_rows(in_turn.len(), || held.iter().flatten().copied())
    }

    /// The moves that may depend on others.
    fn in_turn(&self, moves: &[(u32, Point)], goals: &[Point]) -> Vec<(u32, Point)> {
        let tight = parallel::ranges(self.fence.kites.len(), |range| {
            let mut tight = Vec::new();
            for row in range.filter(|&row| !self.is_free(row, goals)) {
                // None is -1, which is no vertex either.
                tight.extend(self.fence.kites[row].into_iter().filter(|&corner| (corner as usize) < self.movable));
            }
            tight
        });
        let mut waits = vec![false; self.movable];
        tight.into_iter().flatten().for_each(|corner| waits[corner as usize] = true);
        moves.iter().copied().filter(|&(vertex, _)| waits[vertex as usize]).collect()
    }

    /// How far towards `to` a vertex may go while the others are where `now` says.
    fn farthest(&self, about: &[u32], vertex: usize, to: Point, now: impl Fn(usize) -> Point) -> Point {
        let from = self.points[vertex];
        let mut places = [1.0, 0.5, 0.25].into_iter().map(|part| part_of(part, from, to));
        places.find(|&place| self.allows(about, vertex, place, &now)).unwrap_or(from)
    }

    /// Whether both triangles of a kite are far from flat wherever its corners are on the way to their goals.
    ///
    /// An area is linear in each corner, so its least value is taken where all are at a start or a goal. The floor is
    /// above that of [`Guard::is_clear`], by enough for all roundings.
    fn is_free(&self, row: usize, goals: &[Point]) -> bool {
        let kite = self.fence.kites[row];
        if kite.into_iter().all(|corner| corner as usize >= self.movable) {
            return true;
        }
        if kite[2] < 0 || kite[3] < 0 {
            return false;
        }
        let way = |i: usize| {
            let corner = kite[i] as usize;
            let from = self.moved(row, i, self.points[corner]);
            [from, goals.get(corner).map_or(from, |&goal| self.moved(row, i, goal))]
        };
        let (a, b, left, right) = (way(0), way(1), way(2), way(3));
        self.paves(a, b, left) && self.paves(b, a, right)
    }

    /// Whether a triangle is far from flat with its corners at any of their two places; two of `r` may be one.
    #[inline]
    fn paves(&self, p: [Point; 2], q: [Point; 2], r: [Point; 2]) -> bool {
        self.is_wide(p, q, r[0]) && (r[0] == r[1] || self.is_wide(p, q, r[1]))
    }

    /// The same with one corner at one place. Twice the squares of two sides are more than that of the third.
    #[inline]
    fn is_wide(&self, p: [Point; 2], q: [Point; 2], r: Point) -> bool {
        let [p, q] = [p, q].map(|way| way.map(|place| [place[0] - r[0], place[1] - r[1]]));
        let area = |p: Point, q: Point| p[0] * q[1] - p[1] * q[0];
        let areas = [area(p[0], q[0]), area(p[0], q[1]), area(p[1], q[0]), area(p[1], q[1])];
        let square = |[first, second]: [Point; 2]| {
            (first[0] * first[0] + first[1] * first[1]).max(second[0] * second[0] + second[1] * second[1])
        };
        let most = 2.0 * (square(p) + square(q));
        let least = areas[0].min(areas[1]).min(areas[2].min(areas[3]));
        let rounded = 64.0 * f64::EPSILON * self.large;
        // No NaN is positive, and a least of some would not show it.
        areas.iter().all(|&area| area > 0.0) && least > 8.0 * FLAT * most && least * least > rounded * rounded * most
    }

    fn allows(&self, about: &[u32], vertex: usize, to: Point, now: impl Fn(usize) -> Point) -> bool {
        to != self.points[vertex]
            && about.iter().all(|&row| {
                if self.is_clear(row as usize, vertex as i32, to, &now) {
                    return true;
                }
                let kite = self.fence.kites[row as usize];
                let end = |corner: usize| kite[corner] == vertex as i32;
                // Vertex and row of a kite may be the same twice: an edge from a place to a copy of it.
                let (left, right) = (end(0) || end(1) || end(2), end(0) || end(1) || end(3));
                (!left || self.stays(row as usize, [0, 1, 2], vertex, to, &now))
                    && (!right || self.stays(row as usize, [1, 0, 3], vertex, to, &now))
            })
    }

    /// Whether both triangles of a kite are far from flat after a move: most are, and then no exact arithmetic is needed.
    #[inline]
    fn is_clear(&self, row: usize, vertex: i32, to: Point, now: impl Fn(usize) -> Point) -> bool {
        let kite = self.fence.kites[row];
        if kite[2] < 0 || kite[3] < 0 {
            return false;
        }
        let [a, b, left, right] = [0, 1, 2, 3].map(|i| {
            let p = if kite[i] == vertex { to } else { now(kite[i] as usize) };
            self.moved(row, i, p)
        });
        let from = |p: Point| [p[0] - a[0], p[1] - a[1]];
        let (along, left, right) = (from(b), from(left), from(right));
        let square = |p: Point| p[0] * p[0] + p[1] * p[1];
        // Four times the longer of two sides is more than the square of the third.
        let clear = |side: Point, sign: f64| {
            let (p, q) = (along[0] * side[1], along[1] * side[0]);
            let area = sign * (p - q);
            area > SURE * (p.abs() + q.abs()) && area >= 4.0 * FLAT * square(along).max(square(side))
        };
        clear(left, 1.0) && clear(right, -1.0)
    }

    /// Whether a triangle of a kite stays counter-clockwise, and is not flattened.
    fn stays(&self, row: usize, triangle: [usize; 3], vertex: usize, to: Point, now: impl Fn(usize) -> Point) -> bool {
        let kite = self.fence.kites[row];
        if kite[triangle[2]] < 0 {
            return false;
        }
        let point = |i: usize| now(kite[i] as usize);
        let after = triangle.map(|i| self.moved(row, i, if kite[i] == vertex as i32 { to } else { point(i) }));
        let [a, b, c] = after;
        let square = |p: Point, q: Point| (p[0] - q[0]) * (p[0] - q[0]) + (p[1] - q[1]) * (p[1] - q[1]);
        let floor = FLAT * square(a, b).max(square(b, c)).max(square(c, a));
        let area = orientation(a, b, c);
        let before = triangle.map(|i| self.moved(row, i, point(i)));
        area > 0.0 && (area >= floor || area >= orientation(before[0], before[1], before[2]))
    }

    #[inline]
    fn moved(&self, row: usize, corner: usize, p: Point) -> Point {
        match self.fence.shifts.get(row) {
            Some(shift) if corner > 0 => {
                let turn = |i: usize| f64::from(shift[2 * (corner - 1) + i]) * self.period[i];
                [p[0] + turn(0), p[1] + turn(1)]
            }
            _ => p,
        }
    }
}
