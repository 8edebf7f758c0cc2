//! Points no nearer to each other than a radius, as many as fit.

mod frame;
mod piece;
mod ring;
mod tiles;
mod window;

use super::check_box;
use crate::error::Result;
use crate::graph::Point;
use crate::rng::Key;
use crate::watch::Watch;
use frame::Frame;
use tiles::Tiling;

/// Places tried about a point before it is given up; Bridson's own number.
const TRIES: usize = 30;
/// Fewer cells than this, of some five thousand points, are not cut into tiles.
const ONE_PIECE: usize = 1 << 14;

/// Points in `bounds`, no two nearer than `radius`; on a torus copies count too.
///
/// Points are tried in the ring from one radius to two about points that are there, until none has room. Up to some
/// five thousand points are in order of birth. More are made tile by tile, on all cores: tiles lie row by row from the
/// lower left, and the points of one, in order of birth, follow those of the tile before. A point belongs to the tile of
/// some place within two radii of it.
///
/// # Errors
/// [`crate::Error::BadValue`] for a radius that is not positive or too small for the bounds,
/// [`crate::Error::Interrupted`].
///
/// # Source
/// Bridson: Fast Poisson Disk Sampling in Arbitrary Dimensions (SIGGRAPH sketches 2007).
pub fn poisson_disk(radius: f64, bounds: [f64; 4], on_torus: bool, key: Key, watch: Watch<'_>) -> Result<Vec<Point>> {
    check_box(bounds)?;
    let frame = Frame::of(radius, bounds, on_torus)?;
    match Tiling::of(&frame).filter(|_| frame.counts[0] * frame.counts[1] > ONE_PIECE) {
        Some(tiling) => tiles::by_tiles(&tiling, key, watch),
        None => piece::in_one_piece(&frame, key, watch),
    }
}
