//! The cotangent of the angle under which a point sees a segment, and exact comparison of two.

use super::expansion::Expansion;
use super::{FILTER, apex, exact_apex};
use crate::graph::Point;

/// The cotangent of the angle `p v q`: `(p - v)·(q - v) / (p - v)×(q - v)`.
#[derive(Debug, Clone, Copy)]
pub struct Cotangent {
    p: Point,
    q: Point,
    v: Point,
    side: i8,
    dot: f64,
    value: f64,
    error: f64,
}

impl Cotangent {
    /// Evaluates the angle at `v`.
    pub fn of(p: Point, q: Point, v: Point) -> Self {
        let ([dot, cross], [size_dot, size_cross]) = apex(p, q, v);
        if cross.abs() > FILTER * size_cross {
            let value = dot / cross;
            let error = FILTER * (size_dot + value.abs() * size_cross) / cross.abs();
            return Self { p, q, v, side: cross.signum() as i8, dot, value, error };
        }
        let (dot, cross) = exact_apex(p, q, v);
        let (dot, side) = (dot.estimate(), cross.sign() as i8);
        let value = dot / cross.estimate();
        Self { p, q, v, side, dot, value, error: 4.0 * f64::EPSILON * value.abs() }
    }

    /// 1 when `v` is on the left of `pq`, -1 on the right, 0 on its line; exact.
    pub fn side(&self) -> i8 {
        self.side
    }

    /// Whether `v`, on the line of `p` and `q`, is between them.
    pub fn is_between(&self) -> bool {
        self.side == 0 && self.dot < 0.0
    }

    /// The cotangent, rounded.
    pub fn value(&self) -> f64 {
        self.value
    }

    /// Whether this is less than `other - slack`. Certain when the rounding errors of both are too small to matter;
    /// otherwise both are evaluated exactly and their difference rounded once.
    pub fn is_below(&self, other: &Self, slack: f64) -> bool {
        let difference = self.value - other.value + slack;
        if difference.abs() > self.error + other.error + f64::EPSILON * (self.value.abs() + other.value.abs()) {
            return difference < 0.0;
        }
        let ((dot_a, cross_a), (dot_b, cross_b)) =
            (exact_apex(self.p, self.q, self.v), exact_apex(other.p, other.q, other.v));
        let above = dot_a.times(&cross_b).minus(&dot_b.times(&cross_a)).estimate();
        above / (cross_a.estimate() * cross_b.estimate()) < -slack
    }
}

/// The power of `v` with respect to the circle through `p` and `q` at `tau` (see [`in_pencil`]) is `v^2 + a v + c`, below
/// zero inside: `a` and `c`, each exact but for the last bits.
pub fn power(p: Point, q: Point, tau: f64) -> (Point, f64) {
    let times_tau = |x: &Expansion| Expansion::difference(tau, 0.0).times(x);
    let (sum, step) =
        ([0, 1].map(|i| Expansion::difference(p[i], -q[i])), [0, 1].map(|i| Expansion::difference(p[i], q[i])));
    let (dot, cross) = exact_apex(p, q, [0.0; 2]);
    let a = [-sum[0].plus(&times_tau(&step[1])).estimate(), times_tau(&step[0]).minus(&sum[1]).estimate()];
    (a, dot.minus(&times_tau(&cross)).estimate())
}

/// Whether `v` is inside the circle through `p` and `q` whose centre is `tau` half lengths of `pq` to the left of their
/// middle, and by more than a tie: the cotangent of the angle `p v q` is beyond `tau` by more than `slack`. Exact.
#[inline]
pub fn in_pencil(p: Point, q: Point, v: Point, tau: f64, slack: f64) -> bool {
    let ([dot, cross], [size_dot, size_cross]) = apex(p, q, v);
    let value = dot - tau * cross + slack * cross.abs();
    if value.abs() > FILTER * (size_dot + (tau.abs() + slack) * size_cross) {
        return value < 0.0;
    }
    // Coincident vertices stand in many places.
    if v == p || v == q {
        return false;
    }
    let (dot, cross) = exact_apex(p, q, v);
    let tau = Expansion::difference(tau, slack * cross.sign());
    dot.minus(&tau.times(&cross)).sign() < 0.0
}
