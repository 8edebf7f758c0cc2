//! Points of a distribution, each coordinate independent of the other.
//!
//! Point `i` is made of block `i` of the stream alone: it depends neither on the number of points nor on threads.
//! The arithmetic is + - * / and square root, which are exact everywhere, and the logarithm of `libm`, which is
//! the same code everywhere: equal keys give equal bits on every platform.

mod density;
mod poisson_disk;
mod relax;

pub use density::{Density, from_density};
pub use poisson_disk::poisson_disk;
pub use relax::relax;

use crate::error::{Error, Result};
use crate::graph::Point;
use crate::parallel;
use crate::quantile;
use crate::rng::{Key, block, open_unit, stream};
use crate::watch::Watch;

/// `n` points, uniform over `bounds` (xmin, ymin, xmax, ymax).
///
/// # Errors
/// [`Error::BadValue`] if the width or the height is not positive and finite, [`Error::OutOfMemory`],
/// [`Error::Interrupted`].
///
/// # Source
/// Thesis, section 8.1.
pub fn uniform(n: usize, bounds: [f64; 4], key: Key, watch: Watch<'_>) -> Result<Vec<Point>> {
    check_box(bounds)?;
    let [xmin, ymin, xmax, ymax] = bounds;
    let (width, height) = (xmax - xmin, ymax - ymin);
    // Rounding of the sum may step over the upper bound, never under the lower.
    points(n, key, watch, |[u, v]| [(xmin + width * u).min(xmax), (ymin + height * v).min(ymax)])
}

fn check_box([xmin, ymin, xmax, ymax]: [f64; 4]) -> Result<()> {
    match [xmax - xmin, ymax - ymin].into_iter().find(|side| !(*side > 0.0 && side.is_finite())) {
        Some(value) => {
            Err(Error::BadValue { name: "a side of bounds", value, wanted: "positive and finite is wanted" })
        }
        None => Ok(()),
    }
}

/// An empty list with room for `n` points.
fn reserved(n: usize) -> Result<Vec<Point>> {
    let mut points = Vec::new();
    let bytes = n as u128 * size_of::<Point>() as u128;
    points.try_reserve_exact(n).map_err(|_| Error::OutOfMemory { what: "the points", bytes })?;
    Ok(points)
}

/// `n` points, each coordinate normal with mean `loc` and standard deviation `scale`.
///
/// # Errors
/// [`Error::BadValue`] if a scale is negative or so large that points overflow, [`Error::OutOfMemory`],
/// [`Error::Interrupted`].
///
/// # Source
/// Thesis, section 8.3.
pub fn normal(n: usize, loc: [f64; 2], scale: [f64; 2], key: Key, watch: Watch<'_>) -> Result<Vec<Point>> {
    located(n, loc, scale, key, watch, quantile::normal)
}

/// `n` points, each coordinate Laplace with median `loc` and mean distance `scale` from it.
///
/// # Errors
/// [`Error::BadValue`] if a scale is negative or so large that points overflow, [`Error::OutOfMemory`],
/// [`Error::Interrupted`].
///
/// # Source
/// Thesis, section 8.3.
pub fn laplace(n: usize, loc: [f64; 2], scale: [f64; 2], key: Key, watch: Watch<'_>) -> Result<Vec<Point>> {
    located(n, loc, scale, key, watch, quantile::laplace)
}

/// Scaled and shifted points of a standard distribution.
fn located(
    n: usize,
    loc: [f64; 2],
    scale: [f64; 2],
    key: Key,
    watch: Watch<'_>,
    quantile: impl Fn(f64) -> f64 + Sync + Send,
) -> Result<Vec<Point>> {
    // No quantile of 2^-53 or more is 64 away from the middle: Laplace's farthest is 36.04, the normal one's 8.3.
    const FARTHEST: f64 = 64.0;
    for (middle, spread) in loc.into_iter().zip(scale) {
        if !(spread >= 0.0 && (middle.abs() + FARTHEST * spread).is_finite()) {
            let wanted = "0 or more is wanted, and neither loc nor scale may be so large that points overflow";
            return Err(Error::BadValue { name: "scale", value: spread, wanted });
        }
    }
    points(n, key, watch, |[u, v]| [loc[0] + scale[0] * quantile(u), loc[1] + scale[1] * quantile(v)])
}

/// `place` of two uniform numbers a point, x from word 0 and y from word 1 of the point's block.
fn points(n: usize, key: Key, watch: Watch<'_>, place: impl Fn([f64; 2]) -> Point + Sync + Send) -> Result<Vec<Point>> {
    // So many between two questions whether to go on.
    const PART: usize = 1 << 20;
    let mut points = reserved(n)?;
    points.resize(n, [0.0; 2]);
    for (part, first) in points.chunks_mut(PART).zip((0..).step_by(PART)) {
        watch.poll()?;
        parallel::fill(part, |range, places| {
            for (slot, i) in places.iter_mut().zip(range) {
                let words = block(key, [(first + i) as u64, 0, stream::SAMPLE, 0]);
                *slot = place([open_unit(words[0]), open_unit(words[1])]);
            }
        });
    }
    Ok(points)
}
