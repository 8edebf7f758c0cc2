//! A quick look at which sides of a cell a wall may meet.

use std::cmp::Ordering;

use crate::graph::Point;
use crate::predicates::FILTER;

/// The strip along the chord of a wall that holds all of the wall.
pub(super) struct Band {
    origin: Point,
    across: Point,
    low: f64,
    high: f64,
}

impl Band {
    pub(super) fn of(points: &[Point]) -> Self {
        let (origin, end) = (points[0], points[points.len() - 1]);
        let across = [origin[1] - end[1], end[0] - origin[0]];
        let mut band = Self { origin, across, low: 0.0, high: 0.0 };
        for &p in points {
            let (off, error) = band.off(p);
            (band.low, band.high) = (band.low.min(off - error), band.high.max(off + error));
        }
        band
    }

    /// How far off the chord, by some measure, and a bound on the error of that.
    #[inline]
    fn off(&self, p: Point) -> (f64, f64) {
        let (x, y) = ((p[0] - self.origin[0]) * self.across[0], (p[1] - self.origin[1]) * self.across[1]);
        (x + y, FILTER * (x.abs() + y.abs()))
    }

    /// Whether a point is surely below or above the strip. A side whose ends are both surely below, or above, meets
    /// nothing within.
    #[inline]
    pub(super) fn place(&self, p: Point) -> Ordering {
        let (off, error) = self.off(p);
        if off - error > self.high {
            Ordering::Greater
        } else if off + error < self.low {
            Ordering::Less
        } else {
            Ordering::Equal
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::chord::meet;
    use super::*;
    use crate::rng::{Rng, stream};

    #[test]
    fn what_is_beside_meets_nothing_within() {
        let mut rng = Rng::new([3, 4], stream::SPLIT);
        let (mut beside, mut met) = (0, 0);
        for _ in 0..20_000 {
            // On a coarse grid, so that ends lie on the line through others.
            let points: Vec<Point> =
                (0..5).map(|_| [f64::from(rng.below(9)) / 7.0, f64::from(rng.below(5)) / 7.0]).collect();
            let (wall, side) = points.split_at(3);
            let band = Band::of(wall);
            let [p, q] = [side[0], side[1]].map(|p| band.place(p));
            let meets = wall.windows(2).any(|piece| meet(piece[0], piece[1], side[0], side[1]));
            beside += usize::from(p == q && p != Ordering::Equal);
            met += usize::from(meets);
            assert!(!meets || p != q || p == Ordering::Equal, "{points:?}");
        }
        assert!(beside > 2000 && met > 2000, "{beside} {met}");
    }
}
