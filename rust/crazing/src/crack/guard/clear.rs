//! Whether the triangles of a fence stay counter-clockwise.

use super::{Guard, part_of};
use crate::graph::Point;
use crate::predicates::orientation;

/// No triangle that moves may become flatter than this part of the square of its longest side, unless it was:
/// copies of a place on a torus differ by roundings, and pictures have a resolution.
const FLAT: f64 = 1e-9;

/// A sum of two products above this part of their sizes has the sign it seems to have.
const SURE: f64 = 16.0 * f64::EPSILON;

/// The least area that triangles with these corners may get.
pub(super) fn floor([a, b, c]: [Point; 3]) -> f64 {
    let square = |p: Point, q: Point| (p[0] - q[0]) * (p[0] - q[0]) + (p[1] - q[1]) * (p[1] - q[1]);
    FLAT * square(a, b).max(square(b, c)).max(square(c, a))
}

impl Guard<'_> {
    /// How far towards `to` a vertex may go while the others are where `now` says.
    pub(super) fn farthest(&self, about: &[u32], vertex: usize, to: Point, now: impl Fn(usize) -> Point) -> Point {
        let from = self.points[vertex];
        let mut places = [1.0, 0.5, 0.25].into_iter().map(|part| part_of(part, from, to));
        places.find(|&place| self.allows(about, vertex, place, &now)).unwrap_or(from)
    }

    /// Whether both triangles of a kite are far from flat wherever its corners are on the way to their goals.
    ///
    /// An area is linear in each corner, so its least value is taken where all are at a start or a goal. The floor is
    /// above that of [`Guard::is_clear`], by enough for all roundings.
    pub(super) fn is_free(&self, row: usize, goals: &[Point]) -> bool {
        let kite = self.fence.kites[row];
        let rests = |corner: i32| goals.get(corner as usize).is_none_or(|goal| *goal == self.points[corner as usize]);
        if kite[2] < 0 || kite[3] < 0 {
            return kite.into_iter().all(rests);
        }
        let way = |i: usize| {
            let corner = kite[i] as usize;
            let from = self.moved(row, i, self.points[corner]);
            [from, goals.get(corner).map_or(from, |&goal| self.moved(row, i, goal))]
        };
        let (a, b, left, right) = (way(0), way(1), way(2), way(3));
        (self.paves(a, b, left) && self.paves(b, a, right)) || kite.into_iter().all(rests)
    }

    /// Whether a triangle is far from flat with its corners at any of their two places; two of `r` may be one.
    #[inline(always)]
    fn paves(&self, p: [Point; 2], q: [Point; 2], r: [Point; 2]) -> bool {
        self.is_wide(p, q, r[0]) && (r[0] == r[1] || self.is_wide(p, q, r[1]))
    }

    /// The same with one corner at one place. Twice the squares of two sides are more than that of the third.
    #[inline(always)]
    fn is_wide(&self, p: [Point; 2], q: [Point; 2], r: Point) -> bool {
        let [p, q] = [p, q].map(|way| way.map(|place| [place[0] - r[0], place[1] - r[1]]));
        let area = |p: Point, q: Point| p[0] * q[1] - p[1] * q[0];
        let areas = [area(p[0], q[0]), area(p[0], q[1]), area(p[1], q[0]), area(p[1], q[1])];
        // Plain comparisons, where those of the library would make sure of NaNs.
        let less = |a: f64, b: f64| if a < b { a } else { b };
        let more = |a: f64, b: f64| if a > b { a } else { b };
        let square = |[x, y]: Point| x * x + y * y;
        let larger = |[first, second]: [Point; 2]| more(square(first), square(second));
        let most = 2.0 * (larger(p) + larger(q));
        let least = less(less(areas[0], areas[1]), less(areas[2], areas[3]));
        let rounded = 64.0 * f64::EPSILON * self.large;
        // No NaN is positive, and a least of some would not show it.
        let are_positive = (areas[0] > 0.0) & (areas[1] > 0.0) & (areas[2] > 0.0) & (areas[3] > 0.0);
        are_positive & (least > 8.0 * FLAT * most) & (least * least > rounded * rounded * most)
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
    pub(super) fn is_clear(&self, row: usize, vertex: i32, to: Point, now: impl Fn(usize) -> Point) -> bool {
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
        let area = orientation(a, b, c);
        let before = triangle.map(|i| self.moved(row, i, point(i)));
        area > 0.0 && (area >= floor(after) || area >= orientation(before[0], before[1], before[2]))
    }

    #[inline]
    pub(super) fn moved(&self, row: usize, corner: usize, p: Point) -> Point {
        match self.fence.shifts.get(row) {
            Some(shift) if corner > 0 => {
                let turn = |i: usize| f64::from(shift[2 * (corner - 1) + i]) * self.period[i];
                [p[0] + turn(0), p[1] + turn(1)]
            }
            _ => p,
        }
    }
}
