//! Smooth noise over the pixels: through the points of a lattice planes of random height and slope, between which it runs
//! smoothly. Both repeat with the pattern, and move with it by whole pixels.
//!
//! Heights alone show the squares of the lattice, slopes alone are zero at its points; of both, the noise is as strong
//! everywhere to a tenth.
//!
//! # Source
//! Perlin: Improving Noise (2002), for slopes at the points, and for the quintic between them.

mod held;
mod values;

use super::nearest::PAGE;
use crate::rng::{Key, block, stream};
pub(super) use held::Held;
use held::{Plane, Side, ease};
pub(super) use values::{Value, Values};

/// Points of the lattice that one block of random words is for.
const LANES: i64 = 8;

/// The pitch of the finest octave, in pixels: finer ones are not seen as noise but as single pixels.
const FINEST: f64 = 2.0;

/// The squares of the lattice are so many times larger than the spots.
const SPOTS: f64 = 4.0 / 3.0;

/// The largest height and slope at points of the lattice. One pixel in fifty lies beyond -1 or 1, none beyond 2; the
/// standard deviation is .42.
const HEIGHT: f32 = 0.7;
const SLOPE: f32 = 1.6;

/// By how much more of a step the lattice of each octave is moved than that of the one before, so that points where
/// one is zero are none of the others.
const MOVED: [f64; 2] = [0.618_033_988_749_894_9, 0.754_877_666_246_692_7];

/// No more octaves than have numbers of their own.
const OCTAVES: u64 = 16;

/// Noise on a lattice of a given pitch, across and down.
#[derive(Debug, Clone, Copy)]
pub(super) struct Noise {
    key: Key,
    octave: u64,
    weight: f32,
    /// Lattice steps a pixel.
    rate: [f64; 2],
    /// How many of them lie before the pin.
    shift: [f64; 2],
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

/// Octaves of noise, each of half the pitch and half the weight of the one before: those that make its look, which are
/// there at any size, their weights 1 in all; and as many more as have a pitch of [`FINEST`] pixels, so that a large
/// picture shows more of the same. `size` is that of the largest spots, pixels, where they are least wide; they are
/// `stretch` times as long down the picture as they are wide, across it below 1.
pub(super) fn octaves(ground: Ground, kind: u64, size: f64, stretch: f64, count: u64) -> Vec<Noise> {
    let (pitch, sum) = (SPOTS * size, 2.0 - 1.0 / (1_u64 << (count - 1)) as f32);
    let longer = [1.0 / stretch, stretch].map(|times| times.max(1.0));
    let one = |octave: u64| {
        let part = 1.0 / (1_u64 << octave) as f64;
        let pitch = longer.map(|times| (pitch * part).max(1.0) * times);
        Noise::new(ground, 16 * kind + octave, pitch, part as f32 / sum)
    };
    let finer = (count..OCTAVES).take_while(|&octave| pitch >= FINEST * (1_u64 << octave) as f64);
    if pitch > 0.0 { (0..count).chain(finer).map(one).collect() } else { Vec::new() }
}

impl Noise {
    fn new(ground: Ground, octave: u64, pitch: [f64; 2], weight: f32) -> Self {
        let Ground { key, period, pin } = ground;
        let round = |axis: usize| (period[axis] as f64 / pitch[axis]).round().max(1.0) as i64;
        let steps = [0, 1].map(|axis| if period[axis] > 0 { round(axis) } else { 0 });
        let rate = [0, 1]
            .map(|axis| if steps[axis] > 0 { steps[axis] as f64 / period[axis] as f64 } else { 1.0 / pitch[axis] });
        let shift = MOVED.map(|part| (octave as f64 * part).fract());
        Self { key, octave, weight, rate, shift, steps, period, pin }
    }

    /// Where a pixel lies from the pin, within a period.
    fn beyond_pin(&self, axis: usize, pixel: i64) -> i64 {
        let from = pixel - self.pin[axis];
        if self.period[axis] > 0 { from.rem_euclid(self.period[axis]) } else { from }
    }

    /// The middle of a pixel so far from the pin, in lattice steps.
    #[inline(always)]
    fn place(&self, axis: usize, from: f64) -> f64 {
        (from + 0.5) * self.rate[axis] + self.shift[axis]
    }

    /// The planes at some points of a row of the lattice.
    fn lattice(&self, first: i64, row: i64, planes: &mut [Plane]) {
        let wrap = |axis: usize, step: i64| if self.steps[axis] > 0 { step.rem_euclid(self.steps[axis]) } else { step };
        let row = wrap(1, row);
        let mut held = None;
        for (column, plane) in (first..).zip(planes) {
            let column = wrap(0, column);
            let (group, lane) = (column.div_euclid(LANES), column.rem_euclid(LANES) as usize);
            let words = match held {
                Some((held, words)) if held == group => words,
                _ => block(self.key, [group as u64, row as u64, stream::GRAIN, self.octave]),
            };
            held = Some((group, words));
            let bits = words[lane / 2] >> (32 * (lane % 2));
            let number = |shift: u32| (((bits >> shift) & 1023) as f32 + 0.5) * (2.0 / 1024.0) - 1.0;
            *plane = Plane { height: HEIGHT * number(0), slope: [SLOPE * number(10), SLOPE * number(20)] };
        }
    }

    /// Adds to some pixels of a row: lattice step by lattice step, all pixels of one together.
    #[inline(always)]
    pub(super) fn add(&self, row: Stretch, held: &mut Held, out: &mut Values) {
        let Stretch { corner: [left, row], width, sloped } = row;
        let y = self.place(1, self.beyond_pin(1, row) as f64);
        let (j, y) = (y.floor(), (y - y.floor()) as f32);
        let mut start = 0;
        while start < width {
            let from = self.beyond_pin(0, left + start as i64);
            // No farther than the period: there places begin anew.
            let most = if self.period[0] > 0 { (self.period[0] - from).min(PAGE as i64) as usize } else { PAGE };
            let end = width.min(start + most);
            let mut places = [0.0; PAGE];
            let places = &mut places[..end - start];
            for (k, place) in (0_i32..).zip(places.iter_mut()) {
                *place = self.place(0, from as f64 + f64::from(k));
            }
            let (step, last) = (places[0].floor(), places[places.len() - 1].floor());
            held.look(self, [step as i64, j as i64], (last - step) as usize + 2, y);
            let mut step = step;
            let mut rest = &*places;
            for sides in held.sides.windows(2) {
                let own;
                (own, rest) = rest.split_at(self.run(rest, step));
                let some = start..start + own.len();
                start = some.end;
                let value = &mut out.value[some.clone()];
                if sloped {
                    let [right, down] = &mut out.slope;
                    self.sloped([&sides[0], &sides[1]], own, step, value, [&mut right[some.clone()], &mut down[some]]);
                } else {
                    self.level([&sides[0], &sides[1]], own, step, value);
                }
                step += 1.0;
            }
        }
    }

    /// How many of the next places lie on one lattice step.
    #[inline(always)]
    fn run(&self, places: &[f64], step: f64) -> usize {
        let far = (step + 1.0 - places[0]) / self.rate[0];
        let mut count = (far as usize).clamp(1, places.len());
        // The quotient may be one off.
        while count > 1 && places[count - 1] >= step + 1.0 {
            count -= 1;
        }
        while count < places.len() && places[count] < step + 1.0 {
            count += 1;
        }
        count
    }

    /// Adds to the values of pixels in one square of the lattice.
    #[inline(always)]
    fn level(&self, [left, right]: [&Side; 2], places: &[f64], step: f64, value: &mut [f32]) {
        for (place, value) in places.iter().zip(value) {
            let x = (place - step) as f32;
            let (here, there) = (left.value(x), right.value(x - 1.0));
            *value += self.weight * (here + (there - here) * ease(x).0);
        }
    }

    /// The same with slopes.
    #[inline(always)]
    fn sloped(
        &self,
        [left, right]: [&Side; 2],
        places: &[f64],
        step: f64,
        value: &mut [f32],
        [to_right, down]: [&mut [f32]; 2],
    ) {
        let [by_x, by_y] = self.rate.map(|rate| rate as f32);
        let turn = right.slope - left.slope;
        for (((place, value), to_right), down) in places.iter().zip(value).zip(to_right).zip(down) {
            let x = (place - step) as f32;
            let (here, there) = (left.value(x), right.value(x - 1.0));
            let (near, far) = (left.down(x), right.down(x - 1.0));
            let (part, steep) = ease(x);
            *value += self.weight * (here + (there - here) * part);
            *to_right += self.weight * ((left.slope + turn * part + (there - here) * steep) * by_x);
            *down += self.weight * ((near + (far - near) * part) * by_y);
        }
    }
}

/// Some pixels of a row, from the first; slopes are wanted or not.
#[derive(Clone, Copy)]
pub(super) struct Stretch {
    pub(super) corner: [i64; 2],
    pub(super) width: usize,
    pub(super) sloped: bool,
}

#[cfg(test)]
mod tests {
    use super::*;

    const KEY: Key = [3, 4];

    fn noise(period: [i64; 2], pitch: f64) -> Noise {
        stretched(period, [pitch; 2])
    }

    fn stretched(period: [i64; 2], pitch: [f64; 2]) -> Noise {
        Noise::new(Ground { key: KEY, period, pin: [5, -7] }, 18, pitch, 1.0)
    }

    /// Rows of a window, taken in pieces no wider than `part`, as pages do.
    fn window(noise: &Noise, corner: [i64; 2], size: [usize; 2], part: usize) -> Vec<Vec<Value>> {
        let mut held: Vec<Held> = (0..size[0].div_ceil(part)).map(|_| Held::default()).collect();
        let row = |y: usize| {
            let mut row = Vec::new();
            for (left, held) in (0..size[0]).step_by(part).zip(&mut held) {
                let (mut out, width) = (Values::new(PAGE), part.min(size[0] - left));
                let corner = [corner[0] + left as i64, corner[1] + y as i64];
                noise.add(Stretch { corner, width, sloped: true }, held, &mut out);
                row.extend((0..width).map(|x| out.at(x)));
            }
            row
        };
        (0..size[1]).map(row).collect()
    }

    fn bits(rows: &[Vec<Value>]) -> Vec<[u32; 3]> {
        rows.iter().flatten().map(|at| [at.value, at.slope[0], at.slope[1]].map(f32::to_bits)).collect()
    }

    #[test]
    fn neither_pages_nor_periods_are_seen() {
        for (period, pitch) in [
            ([0, 0], [1.0; 2]),
            ([0, 0], [2.7, 8.1]),
            ([0, 0], [1e30; 2]),
            ([40, 23], [7.3; 2]),
            ([40, 23], [9.0, 2.0]),
            ([5, 3], [2.0; 2]),
            ([1, 1], [9.0; 2]),
        ] {
            let noise = stretched(period, pitch);
            let whole = window(&noise, [-60, -9], [128, 30], 64);
            for part in [1, 7, 63] {
                assert_eq!(
                    bits(&whole),
                    bits(&window(&noise, [-60, -9], [128, 30], part)),
                    "{period:?} {pitch:?} {part}"
                );
            }
            let moved = window(&noise, [-60 + period[0], -9 + 2 * period[1]], [128, 30], 64);
            assert_eq!(bits(&whole), bits(&moved), "{period:?} {pitch:?}");
        }
    }

    #[test]
    fn slopes_are_those_of_the_values() {
        // So coarse that a pixel is next to nothing.
        let rows = window(&stretched([0, 0], [900.0, 1100.0]), [1000, 2000], [900, 900], 64);
        for y in (1..899).step_by(37) {
            for x in 1..899 {
                let right = 0.5 * (rows[y][x + 1].value - rows[y][x - 1].value);
                let down = 0.5 * (rows[y + 1][x].value - rows[y - 1][x].value);
                let [by_x, by_y] = rows[y][x].slope;
                assert!((right - by_x).abs().max((down - by_y).abs()) < 4e-6, "{x} {y}");
            }
        }
    }

    #[test]
    fn noise_is_nearly_as_strong_everywhere() {
        let (pitch, steps) = (8, 150);
        let noise = noise([0, 0], f64::from(pitch));
        let rows = window(&noise, [0, 0], [(pitch * steps) as usize; 2], 64);
        let mut squares = vec![0.0_f64; (pitch * pitch) as usize];
        for (y, row) in rows.iter().enumerate() {
            for (x, at) in row.iter().enumerate() {
                squares[y % 8 * 8 + x % 8] += f64::from(at.value * at.value);
                assert!(at.value.abs() < 2.0);
            }
        }
        let spread: Vec<f64> = squares.iter().map(|sum| (sum / f64::from(steps * steps)).sqrt()).collect();
        assert!(spread.iter().all(|spread| (0.36..0.47).contains(spread)), "{spread:?}");
    }

    #[test]
    fn larger_pictures_have_more_octaves_down_to_two_pixels() {
        let ground = Ground { key: KEY, period: [0; 2], pin: [0; 2] };
        let count = |size: f64| octaves(ground, 1, size, 1.0, 3).len();
        assert_eq!([0.0, 0.1, 6.0, 12.0, 24.0, 24.0 * 1024.0].map(count), [0, 3, 3, 4, 5, 15]);
        assert_eq!(count(1e300), 16);
        for (stretch, wanted) in [(4.0, [0.125, 0.03125]), (0.25, [0.03125, 0.125]), (1.0, [0.125; 2])] {
            let rates: Vec<_> = octaves(ground, 1, 6.0, stretch, 3).iter().map(|octave| octave.rate).collect();
            assert_eq!(rates[..2], [wanted, wanted.map(|rate| 2.0 * rate)]);
        }
        let weights: f32 = octaves(ground, 1, 1.0, 5.0, 3).iter().map(|octave| octave.weight).sum();
        assert!((weights - 1.0).abs() < 1e-6);
    }
}
