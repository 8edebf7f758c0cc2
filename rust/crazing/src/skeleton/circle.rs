//! One circle of a pencil, to be asked what it holds.

use std::cell::OnceCell;

use super::boxes::{Box, meets};
use super::disc::Disc;
use super::pencil::Pencil;
use crate::graph::Point;
use crate::predicates::power;

/// Rounding errors of a power, a part of the sizes of what is summed up: some ten of them, many times over.
const ROUNDED: f64 = 1e-14;
/// Square radius, in a frame of size 1, up to which the disc tells well enough; it is much cheaper to come by.
const SMALL: f64 = 1e8;
/// Powers below this may be rounded anyhow; coordinates are near 1.
const TINY: f64 = 1e-290;

/// The circle of a pencil at a place.
pub(super) struct Circle<'a> {
    pencil: &'a Pencil,
    tau: f64,
    /// What it encloses, and a little more.
    pub(super) disc: Disc,
    power: OnceCell<Power>,
}

impl<'a> Circle<'a> {
    pub(super) fn of(pencil: &'a Pencil, tau: f64) -> Self {
        Self { pencil, tau, disc: pencil.disc(tau), power: OnceCell::new() }
    }

    /// Whether a point is inside, ties apart; exact.
    #[inline]
    pub(super) fn holds(&self, v: Point) -> bool {
        self.pencil.holds(self.tau, v)
    }

    /// Whether a box may hold a point that is inside.
    pub(super) fn meets(&self, b: &Box) -> bool {
        meets(self.disc, b) && !self.is_surely_outside(b)
    }

    /// The same as [`holds`](Self::holds) for those of a box that it meets, of which nearly none is inside.
    pub(super) fn holds_one_of(&self, v: Point) -> bool {
        !self.is_surely_outside(&[v[0], v[1], v[0], v[1]]) && self.holds(v)
    }

    fn is_surely_outside(&self, b: &Box) -> bool {
        let power = || {
            let [p, q] = self.pencil.ends();
            let (a, c) = power(p, q, self.tau);
            Power { a, c }
        };
        self.disc.square_radius > SMALL && self.power.get_or_init(power).is_positive_in(b)
    }
}

/// The power of a point with respect to a circle, `v^2 + a v + c`: below zero inside.
///
/// Circles about edges far out are half-planes, and the disc, whose centre is rounded, cannot tell on which side a box
/// is: of a lattice of hexagons they would ask for every point, and every answer would take exact arithmetic.
struct Power {
    a: Point,
    c: f64,
}

impl Power {
    /// Whether the power of all of a box is surely above zero.
    fn is_positive_in(&self, b: &Box) -> bool {
        let (mut least, mut size) = (self.c, self.c.abs());
        for (axis, a) in self.a.into_iter().enumerate() {
            let (low, high) = (b[axis], b[axis + 2]);
            let (near, far) = (low.max(-high).max(0.0), high.max(-low));
            least += near * near + (a * low).min(a * high);
            size += far * far + a.abs() * far;
        }
        least > ROUNDED * size + TINY
    }
}

#[cfg(test)]
mod tests {
    use super::Circle;
    use crate::graph::Point;
    use crate::skeleton::pencil::Pencil;

    #[test]
    fn no_box_is_left_out_that_holds_something() {
        let at = |i: u32| f64::from(i.wrapping_mul(2_654_435_769)) / f64::from(u32::MAX) - 0.5;
        let (mut held, mut left_out) = (0, 0);
        for i in 0..4000 {
            // From ends among the points to some so far out that the circle is a line for all of them.
            let far = 10_f64.powi(i as i32 % 18);
            let ends: [Point; 2] = [[at(i) * far, at(i + 1) * far], [at(i + 2) * far, at(i + 3) * far]];
            let pencil = Pencil::new(ends[0], ends[1]);
            let middle = at(i + 4) * 10_f64.powi(i as i32 % 7 * 2);
            let circle = Circle::of(&pencil, middle);
            let corner = [at(i + 5) * 3.0, at(i + 6) * 3.0];
            let side = 0.7 * (at(i + 7) + 0.5);
            let points = (0..40).map(|j| [0, 1].map(|k| corner[k] + side * (at(i + 8 + 2 * j + k as u32) + 0.5)));
            let inside = points.filter(|&v| circle.holds(v)).collect::<Vec<_>>();
            let is_met = circle.meets(&[corner[0], corner[1], corner[0] + side, corner[1] + side]);
            assert!(is_met || inside.is_empty());
            assert!(inside.iter().all(|&v| circle.holds_one_of(v)));
            held += usize::from(!inside.is_empty());
            left_out += usize::from(!is_met);
        }
        assert!(held > 500 && left_out > 500, "{held} {left_out}");
    }
}
