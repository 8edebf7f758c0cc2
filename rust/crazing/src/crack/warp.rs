//! A smooth warp of a whole drawing: no line stays quite straight, no angle quite even.

use super::fence::FenceView;
use super::guard::Guard;
use super::net::NetView;
use crate::error::{Error, Result};
use crate::graph::Point;
use crate::rng::{Key, Rng, stream};
use crate::watch::Watch;

/// Waves that are added up.
const WAVES: usize = 12;
/// The shortest wave, as a part of the box: this many fit into its longer side.
const SHORTEST: f64 = 6.0;

/// The vertices of a drawing after a smooth warp of `amplitude` (standard deviation, data units) over `bounds`.
///
/// A sum of waves, longer ones higher; on a torus whole waves fit the period. Cut ends stay, and no move lets edges
/// cross, see [`super::Fence`].
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
) -> Result<Vec<Point>> {
    if !(amplitude.is_finite() && amplitude >= 0.0) {
        let wanted = "a finite number of at least 0 is wanted";
        return Err(Error::BadValue { name: "warp", value: amplitude, wanted });
    }
    let waves = Waves::of(bounds, net.shifts.is_empty(), key);
    let mut guard = Guard::of(net, fence);
    watch.poll()?;
    let goal = |guard: &Guard<'_>, vertex: usize| {
        if net.cut[vertex] {
            return guard.place(vertex);
        }
        let [x, y] = waves.at(net.vertices[vertex]);
        guard.shoved(vertex, [amplitude * x, amplitude * y])
    };
    guard.advance(goal, None, watch)?;
    Ok(guard.into_vertices())
}

/// Waves over a box: turns a unit along each axis, the turns that both displacements start at, and height.
struct Waves {
    corner: Point,
    waves: Vec<([f64; 2], [f64; 2], f64)>,
}

impl Waves {
    fn of([xmin, ymin, xmax, ymax]: [f64; 4], free: bool, key: Key) -> Self {
        let sides = [xmax - xmin, ymax - ymin];
        let mut rng = Rng::new(key, stream::WARP);
        let mut waves = Vec::new();
        while waves.len() < WAVES {
            let [u, v, phase, other] = [0; 4].map(|_| rng.unit());
            let mut turns = [u, v].map(|u| (2.0 * u - 1.0) * SHORTEST);
            if !free {
                turns = turns.map(f64::round);
            }
            let count = libm::hypot(turns[0], turns[1]);
            if (1.0..=SHORTEST).contains(&count) {
                waves.push(([turns[0] / sides[0], turns[1] / sides[1]], [phase, other], 1.0 / count));
            }
        }
        // So that each coordinate has a standard deviation of 1.
        let power: f64 = waves.iter().map(|(_, _, height)| height * height / 2.0).sum();
        waves.iter_mut().for_each(|(_, _, height)| *height /= power.sqrt());
        Self { corner: [xmin, ymin], waves }
    }

    fn at(&self, p: Point) -> Point {
        let mut sum = [0.0; 2];
        for (rate, phases, height) in &self.waves {
            let at = rate[0] * (p[0] - self.corner[0]) + rate[1] * (p[1] - self.corner[1]);
            sum[0] += height * sine(at + phases[0]);
            sum[1] += height * sine(at + phases[1]);
        }
        sum
    }
}

/// The sine of so many turns, within 1e-13; many times faster than that of radians, and the same on every platform.
#[inline]
fn sine(turns: f64) -> f64 {
    // Adding and taking away a number whose last bit is 1 rounds to the nearest whole.
    const WHOLE: f64 = 6_755_399_441_055_744.0; // 1.5 * 2^52
    let part = turns - ((turns + WHOLE) - WHOLE);
    let quarter = part.abs().min(0.5 - part.abs());
    let x = std::f64::consts::TAU * quarter;
    let square = x * x;
    // Taylor's series, of which the first term left out is below 1e-13 at a quarter turn.
    let terms = [
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
    let sum = terms.iter().fold(0.0, |sum, term| sum * square + term);
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
