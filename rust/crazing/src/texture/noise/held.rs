//! The planes that an octave of noise runs through, kept from row to row.

use super::Noise;

/// What the noise is like at a point of the lattice.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Plane {
    pub(super) height: f32,
    /// A lattice step to the right and down.
    pub(super) slope: [f32; 2],
}

/// What is kept of an octave from row to row.
#[derive(Debug, Default)]
pub(in super::super) struct Held {
    /// The first of the points above the last row of pixels.
    first: [i64; 2],
    /// The points above and below.
    planes: [Vec<Plane>; 2],
    /// What they say about the row of pixels between them.
    pub(super) sides: Vec<Side>,
}

impl Held {
    /// Looks at so many points from one on, and as many below them, from a row of pixels `y` down between them.
    #[inline(always)]
    pub(super) fn look(&mut self, noise: &Noise, first: [i64; 2], count: usize, y: f32) {
        let Self { planes, sides, .. } = self;
        let [column, row] = first;
        let is_next = self.first == [column, row - 1] && planes[0].len() == count;
        if self.first != first || planes[0].len() != count {
            let [above, below] = planes;
            if is_next {
                std::mem::swap(above, below);
            } else {
                above.resize(count, Plane::default());
                noise.lattice(column, row, above);
            }
            below.resize(count, Plane::default());
            noise.lattice(column, row + 1, below);
            self.first = first;
        }
        sides.clear();
        sides.extend(planes[0].iter().zip(&planes[1]).map(|(above, below)| Side::of([*above, *below], y)));
    }
}

/// What one side of a square says about a row of pixels: linear in how far they are from it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Side {
    value: f32,
    pub(super) slope: f32,
    down: f32,
    down_slope: f32,
}

impl Side {
    /// That between the planes above and below, for the row `y` down from the one above.
    #[inline(always)]
    fn of([above, below]: [Plane; 2], y: f32) -> Self {
        let (part, steep) = ease(y);
        let (top, bottom) = (above.height + above.slope[1] * y, below.height + below.slope[1] * (y - 1.0));
        let by_side = [0, 1].map(|axis| below.slope[axis] - above.slope[axis]);
        Self {
            value: top + (bottom - top) * part,
            slope: above.slope[0] + by_side[0] * part,
            down: above.slope[1] + by_side[1] * part + (bottom - top) * steep,
            down_slope: by_side[0] * steep,
        }
    }

    #[inline(always)]
    pub(super) fn value(&self, x: f32) -> f32 {
        self.value + self.slope * x
    }

    /// How that changes from row to row.
    #[inline(always)]
    pub(super) fn down(&self, x: f32) -> f32 {
        self.down + self.down_slope * x
    }
}

/// From 0 to 1 with level ends that do not bend, and its derivative.
#[inline(always)]
pub(super) fn ease(t: f32) -> (f32, f32) {
    let rest = 1.0 - t;
    (t * t * t * (t * (6.0 * t - 15.0) + 10.0), 30.0 * t * t * rest * rest)
}
