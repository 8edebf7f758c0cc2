//! The circles through two points, and which of them hold no point of a set.
//!
//! The centre of such a circle is `middle + tau * normal / 2`, where `normal` is `pq` turned left by a quarter. A point
//! `v` on the left of `pq` is outside for `tau` up to the cotangent of the angle `p v q`, one on the right from it on.
//! So each point cuts an interval of `tau` at one end, and some circle is empty when the interval that is left is not.

use super::disc::Disc;
use crate::graph::Point;
use crate::predicates::{Cotangent, in_pencil};

/// Intervals shorter than this below zero count as a point: ties between rounded vertices, which could as well be
/// exactly on one circle. `tau` is in half lengths of `pq`, so this has no unit.
pub(super) const TIE: f64 = 1e-9;

/// The circles through `p` and `q` that the points looked at so far leave.
pub(super) struct Pencil {
    p: Point,
    q: Point,
    low: Option<Cotangent>,
    high: Option<Cotangent>,
    /// A point lies between `p` and `q`: no circle is left.
    blocked: bool,
}

impl Pencil {
    pub(super) fn new(p: Point, q: Point) -> Self {
        Self { p, q, low: None, high: None, blocked: false }
    }

    /// Leaves only circles that do not hold `v` inside.
    pub(super) fn cut(&mut self, v: Point) {
        let cut = Cotangent::of(self.p, self.q, v);
        match cut.side() {
            1 => self.high = Some(self.high.take().filter(|old| old.value() <= cut.value()).unwrap_or(cut)),
            -1 => self.low = Some(self.low.take().filter(|old| old.value() >= cut.value()).unwrap_or(cut)),
            _ => self.blocked |= cut.is_between(),
        }
    }

    /// Whether no circle is left, ties apart.
    pub(super) fn is_empty(&self) -> bool {
        match (&self.low, &self.high) {
            _ if self.blocked => true,
            (Some(low), Some(high)) => high.is_below(low, TIE),
            _ => false,
        }
    }

    /// The points that all of its circles go through.
    pub(super) fn ends(&self) -> [Point; 2] {
        [self.p, self.q]
    }

    /// A circle that is left: the smallest, if it is, else one in the middle.
    pub(super) fn choose(&self) -> f64 {
        let low = self.low.as_ref().map_or(f64::NEG_INFINITY, Cotangent::value);
        let high = self.high.as_ref().map_or(f64::INFINITY, Cotangent::value);
        if low <= 0.0 && 0.0 <= high {
            0.0
        } else if low == f64::NEG_INFINITY {
            high - high.abs().max(1.0)
        } else if high == f64::INFINITY {
            low + low.abs().max(1.0)
        } else {
            0.5 * low + 0.5 * high
        }
    }

    /// The circle at `tau`.
    pub(super) fn disc(&self, tau: f64) -> Disc {
        let (dx, dy) = (self.q[0] - self.p[0], self.q[1] - self.p[1]);
        let centre = [self.p[0] + 0.5 * (dx - tau * dy), self.p[1] + 0.5 * (dy + tau * dx)];
        Disc::new(centre, 0.25 * (dx * dx + dy * dy) * (1.0 + tau * tau))
    }

    /// Whether `v` is inside the circle at `tau`, ties apart; exact.
    #[inline]
    pub(super) fn holds(&self, tau: f64, v: Point) -> bool {
        in_pencil(self.p, self.q, v, tau, TIE)
    }
}
