//! Smooth noise over the pixels: random values on a lattice, between which it runs smoothly. Both repeat with the
//! pattern, and move with it by whole pixels.

use crate::rng::{Key, block, stream};

/// Values that one block of random words gives.
const LANES: i64 = 16;

/// Noise on a lattice of a given pitch.
#[derive(Debug, Clone, Copy)]
pub(super) struct Noise {
    key: Key,
    octave: u64,
    /// Lattice steps a pixel.
    rate: [f64; 2],
    /// Lattice steps a period; 0 where there is none.
    steps: [i64; 2],
    period: [i64; 2],
    /// The pixel that the lattice is pinned to.
    pin: [i64; 2],
}

/// A value from -1 to 1 and how it changes a pixel to the right and a pixel down.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Value {
    pub(super) value: f32,
    pub(super) slope: [f32; 2],
}

impl Noise {
    /// Noise of about `pitch` pixels a lattice step.
    pub(super) fn new(key: Key, octave: u64, pitch: f64, period: [i64; 2], pin: [i64; 2]) -> Self {
        let steps = period.map(|length| if length > 0 { (length as f64 / pitch).round().max(1.0) as i64 } else { 0 });
        let rate =
            [0, 1].map(|axis| if steps[axis] > 0 { steps[axis] as f64 / period[axis] as f64 } else { 1.0 / pitch });
        Self { key, octave, rate, steps, period, pin }
    }

    /// The lattice step before a pixel's middle, and how far beyond it the middle is.
    fn split(&self, axis: usize, pixel: i64) -> (i64, f32) {
        let from = pixel - self.pin[axis];
        let from = if self.period[axis] > 0 { from.rem_euclid(self.period[axis]) } else { from };
        let at = (from as f64 + 0.5) * self.rate[axis];
        let step = at.floor();
        (step as i64, (at - step) as f32)
    }

    fn wrap(&self, axis: usize, step: i64) -> i64 {
        if self.steps[axis] > 0 { step.rem_euclid(self.steps[axis]) } else { step }
    }

    /// The random value at a lattice point, -1 to 1.
    fn lattice(&self, column: i64, row: i64) -> f32 {
        let (column, row) = (self.wrap(0, column), self.wrap(1, row));
        let words = block(self.key, [column.div_euclid(LANES) as u64, row as u64, stream::GRAIN, self.octave]);
        let lane = column.rem_euclid(LANES) as usize;
        let bits = (words[lane / 4] >> (16 * (lane % 4))) as u16;
        (f32::from(bits) + 0.5) * (2.0 / 65536.0) - 1.0
    }

    /// Fills a row of pixels.
    pub(super) fn row(&self, row: i64, left: i64, out: &mut [Value]) {
        let (j, y) = self.split(1, row);
        let (sy, dy) = ease(y);
        let mut at = None;
        let mut corners = [0.0; 4];
        for (pixel, out) in (left..).zip(out) {
            let (i, x) = self.split(0, pixel);
            if at != Some(i) {
                at = Some(i);
                corners = [[0, 0], [1, 0], [0, 1], [1, 1]].map(|[a, b]| self.lattice(i + a, j + b));
            }
            let [a, b, c, d] = corners;
            let (sx, dx) = ease(x);
            let (top, bottom) = (a + (b - a) * sx, c + (d - c) * sx);
            let across = (b - a) + ((d - c) - (b - a)) * sy;
            let slope = [across * dx * self.rate[0] as f32, (bottom - top) * dy * self.rate[1] as f32];
            *out = Value { value: top + (bottom - top) * sy, slope };
        }
    }
}

/// From 0 to 1 with level ends, and its derivative.
fn ease(t: f32) -> (f32, f32) {
    (t * t * (3.0 - 2.0 * t), 6.0 * t * (1.0 - t))
}
