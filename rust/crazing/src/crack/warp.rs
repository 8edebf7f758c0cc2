//! A smooth warp of a whole drawing: no line stays quite straight, no angle quite even.

use pulp::{Arch, Simd, WithSimd};

use super::fence::FenceView;
use super::guard::Guard;
use super::net::NetView;
use crate::error::{Error, Result};
use crate::graph::Point;
use crate::parallel;
use crate::rng::{Key, Rng, stream};
use crate::watch::Watch;

/// Waves that are added up.
const WAVES: usize = 12;
/// The shortest wave, as a part of the box: this many fit into its longer side.
const SHORTEST: f64 = 6.0;

/// The vertices of a drawing, and the anchors of its fence, after a smooth warp of `amplitude` (standard deviation, data
/// units) over `bounds`.
///
/// A sum of waves, longer ones higher; on a torus whole waves fit the period. Cut ends stay, and no edges cross, see
/// [`super::Fence`]: anchors move where triangles would be turned over about them.
///
/// # Errors
/// [`Error::BadValue`], [`Error::Interrupted`].
pub fn warp(
    net: NetView<'_>,
    fence: FenceView<'_>,
    amplitude: f64,
    bounds: [f64; 4],
    key: Key,
    watch: Watch<'_>,
) -> Result<(Vec<Point>, Vec<Point>)> {
    if !(amplitude.is_finite() && amplitude >= 0.0) {
        let wanted = "a finite number of at least 0 is wanted";
        return Err(Error::BadValue { name: "warp", value: amplitude, wanted });
    }
    let on_torus = !net.shifts.is_empty();
    let (waves, arch) = (Waves::of(bounds, !on_torus, key), Arch::new());
    let mut guard = Guard::of(net, fence);
    watch.poll()?;
    let step = |place: Point| arch.dispatch(At(&waves, place)).map(|part| amplitude * part);
    let goals = parallel::map(net.vertices.len() + fence.anchors.len(), |point| match net.cut.get(point) {
        Some(false) => guard.shoved(point, step(net.vertices[point])),
        _ => guard.place(point),
    });
    let [xmin, ymin, xmax, ymax] = bounds;
    let is_within = |[x, y]: Point| on_torus || (x > xmin && x < xmax && y > ymin && y < ymax);
    let scale = guard.scale();
    guard.sweep(
        goals,
        net.cut,
        |corner| {
            let place = fence.anchors[corner - net.vertices.len()];
            let [x, y] = step(place);
            let there = [place[0] + x, place[1] + y];
            (is_within(place) && is_within(there)).then(|| scale.down(there))
        },
        watch,
    )?;
    let mut vertices = guard.into_points();
    let anchors = vertices.split_off(net.vertices.len());
    Ok((vertices, anchors))
}

/// Waves over a box.
struct Waves {
    corner: Point,
    /// Turns a unit along each axis.
    rates: [[f64; WAVES]; 2],
    /// The turns that both displacements start at.
    phases: [[f64; WAVES]; 2],
    heights: [f64; WAVES],
}

impl Waves {
    fn of([xmin, ymin, xmax, ymax]: [f64; 4], free: bool, key: Key) -> Self {
        let sides = [xmax - xmin, ymax - ymin];
        let mut rng = Rng::new(key, stream::WARP);
        let (corner, blank) = ([xmin, ymin], [0.0; WAVES]);
        let mut waves = Self { corner, rates: [blank; 2], phases: [blank; 2], heights: blank };
        let mut found = 0;
        while found < WAVES {
            let [u, v, phase, other] = [0; 4].map(|_| rng.unit());
            let mut turns = [u, v].map(|u| (2.0 * u - 1.0) * SHORTEST);
            if !free {
                turns = turns.map(f64::round);
            }
            let count = libm::hypot(turns[0], turns[1]);
            if (1.0..=SHORTEST).contains(&count) {
                for (axis, phase) in [phase, other].into_iter().enumerate() {
                    waves.rates[axis][found] = turns[axis] / sides[axis];
                    waves.phases[axis][found] = phase;
                }
                waves.heights[found] = 1.0 / count;
                found += 1;
            }
        }
        // So that each coordinate has a standard deviation of 1.
        let power: f64 = waves.heights.iter().map(|height| height * height / 2.0).sum();
        waves.heights.iter_mut().for_each(|height| *height /= power.sqrt());
        waves
    }

    /// All waves side by side, then added up in their order. In loops: what arrays have for them is compiled apart.
    #[inline(always)]
    fn at(&self, p: Point) -> Point {
        let (x, y) = (p[0] - self.corner[0], p[1] - self.corner[1]);
        let (mut parts, mut sum) = ([[0.0; WAVES]; 2], [0.0; 2]);
        for (parts, phases) in parts.iter_mut().zip(&self.phases) {
            for (i, part) in parts.iter_mut().enumerate() {
                let turns = self.rates[0][i] * x + self.rates[1][i] * y;
                *part = self.heights[i] * sine(turns + phases[i]);
            }
        }
        let [across, up] = &parts;
        for (x, y) in across.iter().zip(up) {
            sum = [sum[0] + x, sum[1] + y];
        }
        sum
    }
}

/// Where waves move a place: compiled for any processor and for those with AVX2, to the same bits.
struct At<'a>(&'a Waves, Point);

impl WithSimd for At<'_> {
    type Output = Point;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Point {
        self.0.at(self.1)
    }
}

/// The sine of so many turns, within 1e-13; many times faster than that of radians, and the same on every platform.
#[inline(always)]
fn sine(turns: f64) -> f64 {
    // Adding and taking away a number whose last bit is 1 rounds to the nearest whole.
    const WHOLE: f64 = 6_755_399_441_055_744.0; // 1.5 * 2^52
    let part = turns - ((turns + WHOLE) - WHOLE);
    let (near, far) = (part.abs(), 0.5 - part.abs());
    let quarter = if near < far { near } else { far };
    let x = std::f64::consts::TAU * quarter;
    let square = x * x;
    // Taylor's series, of which the first term left out is below 1e-13 at a quarter turn.
    const TERMS: [f64; 9] = [
        1.0 / 355_687_428_096_000.0,
        -1.0 / 1_307_674_368_000.0,
        1.0 / 6_227_020_800.0,
        -1.0 / 39_916_800.0,
        1.0 / 362_880.0,
        -1.0 / 5_040.0,
        1.0 / 120.0,
        -1.0 / 6.0,
        1.0,
    ];
    let mut sum = 0.0;
    for term in TERMS {
        sum = sum * square + term;
    }
    (x * sum).copysign(part)
}

#[cfg(test)]
mod tests {
    use super::sine;

    #[test]
    fn sines_are_those_of_radians() {
        for i in -4000..=4000 {
            let turns = f64::from(i) / 640.0;
            assert!((sine(turns) - libm::sin(std::f64::consts::TAU * turns)).abs() < 1e-13, "{turns}");
        }
        assert_eq!([sine(0.0), sine(3.0), sine(-0.5)].map(f64::abs), [0.0; 3]);
        assert!(sine(f64::MAX).abs() <= 1.0);
    }
}
