//! Bounds cut into cells, each too small for two points.

use crate::error::{Error, Result};
use crate::graph::Point;

/// Most cells, each of which holds at most one point.
const MOST_CELLS: f64 = 268_435_456.0;

/// Where points may lie, in cells of a diagonal of at most the radius.
pub(super) struct Frame {
    pub(super) radius: f64,
    pub(super) bounds: [f64; 4],
    pub(super) on_torus: bool,
    pub(super) counts: [usize; 2],
    /// Of a cell.
    pub(super) sides: Point,
}

impl Frame {
    pub(super) fn of(radius: f64, bounds: [f64; 4], on_torus: bool) -> Result<Self> {
        let size = [bounds[2] - bounds[0], bounds[3] - bounds[1]];
        let wanted = size.map(|side| (side / radius * std::f64::consts::SQRT_2).ceil().max(1.0));
        let refused = |wanted| Err(Error::BadValue { name: "radius", value: radius, wanted });
        // Distances are compared by their squares: if all of these were zero or infinite, there would always be room.
        if !(radius > 0.0 && (radius * radius).is_normal()) {
            return refused("a positive number whose square is a float is wanted");
        }
        if wanted[0] * wanted[1] > MOST_CELLS {
            return refused("so near to each other, more than 90 million points have room; a larger radius is wanted");
        }
        let counts = wanted.map(|count| count as usize);
        let sides = [0, 1].map(|i| size[i] / counts[i] as f64);
        Ok(Self { radius, bounds, on_torus, counts, sides })
    }

    /// Width and height of the bounds.
    pub(super) fn size(&self) -> Point {
        [0, 1].map(|i| self.bounds[i + 2] - self.bounds[i])
    }

    /// How many cells on either side of its own hold what is nearer to a point than so many radii.
    pub(super) fn reach(&self, radii: f64) -> [usize; 2] {
        [0, 1].map(|i| ((radii * self.radius / self.sides[i]).ceil() as usize).min(self.counts[i]))
    }

    pub(super) fn inside_bounds(&self, p: Point) -> Option<Point> {
        let size = self.size();
        let mut inside = p;
        for i in 0..2 {
            let (low, high) = (self.bounds[i], self.bounds[i + 2]);
            if self.on_torus {
                inside[i] = p[i] - ((p[i] - low) / size[i]).floor() * size[i];
                inside[i] = if inside[i] < high { inside[i].max(low) } else { low };
            } else if !(low..=high).contains(&p[i]) {
                return None;
            }
        }
        Some(inside)
    }

    pub(super) fn cell(&self, p: Point) -> [usize; 2] {
        [0, 1].map(|i| (((p[i] - self.bounds[i]) / self.sides[i]) as usize).min(self.counts[i] - 1))
    }

    /// Whether a place lies within the bounds, but on neither of the upper sides, which are the lower ones on a torus.
    #[inline(always)]
    pub(super) fn is_well_inside(&self, p: Point) -> bool {
        (0..2).all(|i| self.bounds[i] <= p[i] && p[i] < self.bounds[i + 2])
    }
}
