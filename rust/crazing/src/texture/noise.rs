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
    weight: f32,
    /// Lattice steps a pixel.
    rate: [f64; 2],
    /// Lattice steps a period; 0 where there is none.
    steps: [i64; 2],
    period: [i64; 2],
    /// The pixel that the lattice is pinned to.
    pin: [i64; 2],
}

/// What a lattice is laid over.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ground {
    pub(super) key: Key,
    pub(super) period: [i64; 2],
    pub(super) pin: [i64; 2],
}

/// A value from -1 to 1 and how it changes a pixel to the right and a pixel down.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Value {
    pub(super) value: f32,
    pub(super) slope: [f32; 2],
}

/// Octaves of noise, each of half the pitch and half the weight of the one before; of at least a pixel.
pub(super) fn octaves(ground: Ground, kind: u64, pitch: f64, count: u64) -> Vec<Noise> {
    let sum = 2.0 - 1.0 / (1_u64 << (count - 1)) as f32;
    let one = |octave: u64| {
        let part = 1.0 / (1_u64 << octave) as f64;
        Noise::new(ground, 16 * kind + octave, (pitch * part).max(1.0), part as f32 / sum)
    };
    if pitch > 0.0 { (0..count).map(one).collect() } else { Vec::new() }
}

impl Noise {
    fn new(ground: Ground, octave: u64, pitch: f64, weight: f32) -> Self {
        let Ground { key, period, pin } = ground;
        let steps = period.map(|length| if length > 0 { (length as f64 / pitch).round().max(1.0) as i64 } else { 0 });
        let rate =
            [0, 1].map(|axis| if steps[axis] > 0 { steps[axis] as f64 / period[axis] as f64 } else { 1.0 / pitch });
        Self { key, octave, weight, rate, steps, period, pin }
    }

    /// The lattice step before a pixel's middle, and how far beyond it the middle is.
    fn split(&self, axis: usize, pixel: i64) -> (i64, f32) {
        let from = pixel - self.pin[axis];
        let from = if self.period[axis] > 0 { from.rem_euclid(self.period[axis]) } else { from };
        let at = (from as f64 + 0.5) * self.rate[axis];
        let step = at.floor();
        (step as i64, (at - step) as f32)
    }

    /// A value at a lattice point, and the words it is from: the next points take theirs from the same.
    fn lattice(&self, column: i64, row: i64, held: &mut Option<(i64, [u64; 4])>) -> f32 {
        let wrap = |axis: usize, step: i64| if self.steps[axis] > 0 { step.rem_euclid(self.steps[axis]) } else { step };
        let (column, row) = (wrap(0, column), wrap(1, row));
        let (group, lane) = (column.div_euclid(LANES), column.rem_euclid(LANES) as usize);
        let words = match *held {
            Some((held, words)) if held == group => words,
            _ => block(self.key, [group as u64, row as u64, stream::GRAIN, self.octave]),
        };
        *held = Some((group, words));
        let bits = (words[lane / 4] >> (16 * (lane % 4))) as u16;
        (f32::from(bits) + 0.5) * (2.0 / 65536.0) - 1.0
    }

    /// Adds a row of pixels, or writes it.
    pub(super) fn add(&self, row: i64, left: i64, out: &mut [Value], first: bool) {
        let (j, y) = self.split(1, row);
        let (sy, dy) = ease(y);
        let (mut above, mut below) = (None, None);
        let (mut at, mut corners) = (i64::MIN, [0.0; 4]);
        for (pixel, out) in (left..).zip(out) {
            let (i, x) = self.split(0, pixel);
            if i != at {
                let [_, b, _, d] = corners;
                let (a, c) = match at.checked_add(1) {
                    Some(next) if next == i => (b, d),
                    _ => (self.lattice(i, j, &mut above), self.lattice(i, j + 1, &mut below)),
                };
                at = i;
                corners = [a, self.lattice(i + 1, j, &mut above), c, self.lattice(i + 1, j + 1, &mut below)];
            }
            let [a, b, c, d] = corners;
            let (sx, dx) = ease(x);
            let (top, bottom) = (a + (b - a) * sx, c + (d - c) * sx);
            let across = (b - a) + ((d - c) - (b - a)) * sy;
            let slope = [across * dx * self.rate[0] as f32, (bottom - top) * dy * self.rate[1] as f32];
            let old = if first { Value::default() } else { *out };
            out.value = old.value + self.weight * (top + (bottom - top) * sy);
            out.slope = [0, 1].map(|axis| old.slope[axis] + self.weight * slope[axis]);
        }
    }
}

/// From 0 to 1 with level ends, and its derivative.
fn ease(t: f32) -> (f32, f32) {
    (t * t * (3.0 - 2.0 * t), 6.0 * t * (1.0 - t))
}
