//! A smooth warp of a whole drawing: no line stays quite straight, no angle quite even.

use super::fence::{FenceView, Guard};
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
    let free: Vec<u32> = (0..net.vertices.len() as u32).filter(|&vertex| !net.cut[vertex as usize]).collect();
    let moves = parallel::map(free.len(), |i| {
        let [x, y] = waves.at(net.vertices[free[i] as usize]);
        (free[i], guard.shoved(free[i] as usize, [amplitude * x, amplitude * y]))
    });
    guard.advance(&moves, watch)?;
    Ok(guard.into_vertices())
}

/// Waves over a box: radians a unit along each axis, two phases, and height.
struct Waves {
    corner: Point,
    waves: Vec<([f64; 2], [f64; 2], f64)>,
}

impl Waves {
    fn of([xmin, ymin, xmax, ymax]: [f64; 4], free: bool, key: Key) -> Self {
        let sides = [xmax - xmin, ymax - ymin];
        let mut rng = Rng::new(key, stream::WARP);
        let mut waves = Vec::new();
        let turn = std::f64::consts::TAU;
        while waves.len() < WAVES {
            let [u, v, phase, other] = [0; 4].map(|_| rng.unit());
            let mut turns = [u, v].map(|u| (2.0 * u - 1.0) * SHORTEST);
            if !free {
                turns = turns.map(f64::round);
            }
            let count = libm::hypot(turns[0], turns[1]);
            if (1.0..=SHORTEST).contains(&count) {
                let rate = [0, 1].map(|i| turn * turns[i] / sides[i]);
                waves.push((rate, [turn * phase, turn * other], 1.0 / count));
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
            for (sum, phase) in sum.iter_mut().zip(phases) {
                *sum += height * libm::sin(at + phase);
            }
        }
        sum
    }
}
