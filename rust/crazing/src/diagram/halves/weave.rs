//! How two triangulations side by side become one.

use std::cmp::Ordering;
use std::ops::Range;

use super::{Half, NONE, Part, ROOM, Site, Stop};
use crate::graph::Point;
use crate::predicates::{in_circle, orientation};

/// Above these parts of the sizes of their terms, areas and circles have the sign they seem to have (Shewchuk 1997).
const SURE_AREA: f64 = 2.0 * f64::EPSILON;
const SURE_CIRCLE: f64 = 8.0 * f64::EPSILON;

/// Numbers of edges that are not in use.
pub(super) struct Free {
    pub(super) fresh: Vec<Range<u32>>,
    pub(super) used: Vec<u32>,
}

impl Free {
    fn take(&mut self) -> Option<u32> {
        if let Some(edge) = self.used.pop() {
            return Some(edge);
        }
        while let Some(last) = self.fresh.last_mut() {
            if let Some(edge) = last.next() {
                return Some(edge);
            }
            self.fresh.pop();
        }
        None
    }
}

/// From left to right, or turned a quarter: from the bottom up.
#[inline]
pub(super) fn order(a: Point, b: Point, upright: bool) -> Ordering {
    // Without a branch: which of two sites comes first cannot be foretold.
    let is_less = |a: Point, b: Point| {
        if upright {
            (a[0] < b[0]) | ((a[0] == b[0]) & (a[1] < b[1]))
        } else {
            (a[1] < b[1]) | ((a[1] == b[1]) & (a[0] > b[0]))
        }
    };
    is_less(b, a).cmp(&is_less(a, b))
}

/// Makes and removes the edges of a part.
pub(super) struct Weaver<'a> {
    pub(super) part: Part<'a>,
    pub(super) free: Free,
}

impl Weaver<'_> {
    #[inline]
    fn half(&self, edge: u32) -> Half {
        self.part.halves[(edge - ROOM as u32 * self.part.first) as usize]
    }

    #[inline]
    fn half_mut(&mut self, edge: u32) -> &mut Half {
        &mut self.part.halves[(edge - ROOM as u32 * self.part.first) as usize]
    }

    #[inline]
    fn site_mut(&mut self, site: u32) -> &mut Site {
        &mut self.part.sites[(site - self.part.first) as usize]
    }

    #[inline]
    fn from(&self, edge: u32) -> Point {
        self.part.sites[(self.half(edge).origin - self.part.first) as usize].place
    }

    #[inline]
    fn to(&self, edge: u32) -> Point {
        self.from(edge ^ 1)
    }

    /// A new edge between two sites, in no ring yet.
    fn edge(&mut self, from: u32, to: u32) -> u32 {
        // There is always one: a triangulation of some sites has fewer than three edges a site.
        let edge = 2 * self.free.take().unwrap_or(ROOM as u32 / 2 * self.part.first);
        *self.half_mut(edge) = Half { next: edge, prev: edge, origin: from };
        *self.half_mut(edge + 1) = Half { next: edge + 1, prev: edge + 1, origin: to };
        self.site_mut(from).edge = edge;
        self.site_mut(to).edge = edge + 1;
        edge
    }

    /// Puts a half-edge that is in no ring after another about one origin.
    fn put(&mut self, edge: u32, after: u32) {
        let next = self.half(after).next;
        self.half_mut(after).next = edge;
        let half = self.half_mut(edge);
        (half.prev, half.next) = (after, next);
        self.half_mut(next).prev = edge;
    }

    /// A new edge from where one leads to where the other starts, with one region on the left of all three.
    fn joined(&mut self, one: u32, other: u32) -> u32 {
        let (from, to) = (self.half(one ^ 1).origin, self.half(other).origin);
        let edge = self.edge(from, to);
        let after = self.half(one ^ 1).prev;
        self.put(edge, after);
        self.put(edge + 1, other);
        edge
    }

    fn remove(&mut self, edge: u32) {
        for half in [edge, edge ^ 1] {
            let Half { next, prev, origin } = self.half(half);
            self.half_mut(prev).next = next;
            self.half_mut(next).prev = prev;
            if self.site_mut(origin).edge == half {
                self.site_mut(origin).edge = next;
            }
        }
        self.free.used.push(edge / 2);
    }

    /// Triangulates a range of the part; a half-edge of the hull with all on its left.
    pub(super) fn woven(&mut self, range: Range<usize>, upright: bool) -> std::result::Result<u32, Stop> {
        let count = range.len();
        if count <= 3 {
            return self.small(range);
        }
        let (start, end) = (range.start, range.end);
        let middle = start + Part { sites: &mut self.part.sites[range], halves: &mut [], first: 0 }.cut(upright)?;
        let left = self.woven(start..middle, !upright)?;
        let right = self.woven(middle..end, !upright)?;
        Ok(self.sewn(left, right, upright))
    }

    fn small(&mut self, range: Range<usize>) -> std::result::Result<u32, Stop> {
        let first = self.part.first + range.start as u32;
        let count = range.len();
        let sites = &mut self.part.sites[range];
        sites.sort_unstable_by(|a, b| order(a.place, b.place, true));
        if sites.windows(2).any(|pair| pair[0].place == pair[1].place) {
            return Err(Stop::Equal);
        }
        if count < 2 {
            return Ok(NONE);
        }
        let corners = [sites[0].place, sites[1].place, sites[count - 1].place];
        let one = self.edge(first, first + 1);
        if count == 2 {
            return Ok(one);
        }
        let two = self.edge(first + 1, first + 2);
        self.put(two, one ^ 1);
        let turn = area(corners[0], corners[1], corners[2]);
        if turn > 0.0 {
            self.joined(two, one);
        } else if turn < 0.0 {
            return Ok(self.joined(two, one) ^ 1);
        }
        Ok(one)
    }

    /// The half-edge of a hull that leaves its first or last site.
    fn outermost(&self, hull: u32, upright: bool, wanted: Ordering) -> u32 {
        let (mut best, mut place, mut edge) = (hull, self.from(hull), hull);
        loop {
            edge = self.half(edge ^ 1).next;
            if edge == hull {
                return best;
            }
            let here = self.from(edge);
            if order(here, place, upright) == wanted {
                (best, place) = (edge, here);
            }
        }
    }

    /// Joins two triangulations, the one before the other, into one; see the source.
    pub(super) fn sewn(&mut self, left: u32, right: u32, upright: bool) -> u32 {
        let mut left = self.outermost(left, upright, Ordering::Greater);
        left = self.half(left).prev;
        let mut right = self.outermost(right, upright, Ordering::Less);
        // Down to the lowest line that has all on one side.
        loop {
            let (from, to) = (self.from(left), self.from(right));
            if area(to, from, self.to(left)) > 0.0 {
                left = self.half(left ^ 1).prev;
            } else if area(from, self.to(right), to) > 0.0 {
                right = self.half(right ^ 1).next;
            } else {
                break;
            }
        }
        let lowest = self.joined(right ^ 1, left);
        let mut base = lowest;
        loop {
            let (from, to) = (self.from(base), self.to(base));
            let left = self.rising(base ^ 1, from, to, |half| half.next);
            let right = self.rising(base, from, to, |half| half.prev);
            base = match (left, right) {
                (None, None) => return lowest ^ 1,
                (Some((left, p)), Some((right, q))) => {
                    if is_inside(p, to, from, q) {
                        self.joined(right, base ^ 1)
                    } else {
                        self.joined(base ^ 1, left ^ 1)
                    }
                }
                (Some((left, _)), None) => self.joined(base ^ 1, left ^ 1),
                (None, Some((right, _))) => self.joined(right, base ^ 1),
            };
        }
    }

    /// The next half-edge above the base on one side, and where it leads, once those are removed whose circle has the
    /// one behind them inside; None when there is none above.
    #[inline]
    fn rising(&mut self, side: u32, from: Point, to: Point, step: impl Fn(Half) -> u32) -> Option<(u32, Point)> {
        let mut edge = step(self.half(side));
        let mut place = self.to(edge);
        if area(place, to, from) <= 0.0 {
            return None;
        }
        loop {
            let behind = step(self.half(edge));
            let next = self.to(behind);
            // Behind the last one comes the base again, whose ends are on the circle, not inside: that would be found out
            // in exact numbers only.
            if behind == side || !is_inside(to, from, place, next) {
                return Some((edge, place));
            }
            self.remove(edge);
            (edge, place) = (behind, next);
        }
    }
}

/// Sign of the area of a triangle.
#[inline]
fn area(a: Point, b: Point, c: Point) -> f64 {
    let (p, q) = ((a[0] - c[0]) * (b[1] - c[1]), (a[1] - c[1]) * (b[0] - c[0]));
    let area = p - q;
    if area.abs() > SURE_AREA * (p.abs() + q.abs()) { area } else { orientation(a, b, c) }
}

/// Whether `d` lies inside the circle through `a b c`, which are counter-clockwise.
#[inline]
fn is_inside(a: Point, b: Point, c: Point, d: Point) -> bool {
    let [(ax, ay), (bx, by), (cx, cy)] = [a, b, c].map(|p| (p[0] - d[0], p[1] - d[1]));
    let square = |x: f64, y: f64| x * x + y * y;
    let (bc, cb, ca, ac, ab, ba) = (bx * cy, cx * by, cx * ay, ax * cy, ax * by, bx * ay);
    let (one, two, three) = (square(ax, ay), square(bx, by), square(cx, cy));
    let inside = one * (bc - cb) + two * (ca - ac) + three * (ab - ba);
    let size = (bc.abs() + cb.abs()) * one + (ca.abs() + ac.abs()) * two + (ab.abs() + ba.abs()) * three;
    if inside.abs() > SURE_CIRCLE * size { inside > 0.0 } else { in_circle(a, b, c, d) > 0.0 }
}
