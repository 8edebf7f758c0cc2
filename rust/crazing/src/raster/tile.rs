//! One square of the picture, from outlines to pixels.

use tiny_skia::{FillRule, Mask, PathBuilder, Transform};

use super::blend::Table;
use super::clip;
use super::taper::Taper;
use crate::error::{Error, Result};
use crate::graph::Point;

/// Pixels a side. Together with [`GRID`] it makes a mask of 256 KiB, which stays in a core's own cache.
pub(super) const TILE: usize = 64;

/// Samples a pixel along one side.
const GRID: usize = 8;

/// Samples a pixel.
pub(super) const SAMPLES: u32 = (GRID * GRID) as u32;

/// Pixels from sample to sample: a line thinner than this would break into dashes.
pub(super) const THINNEST: f64 = 1.0 / GRID as f64;

/// Samples a side of the tile.
const SIDE: usize = TILE * GRID;

/// Outlines filled in one go. Filling is a union, so parts give the whole; tiny-skia's cost a fill is about that of
/// ten outlines, and its sorting grows faster than their number.
const BATCH: usize = 16;

/// A tile under work, with its buffers; one a thread.
pub(super) struct Tile {
    origin: Point,
    mask: Mask,
    /// Whether the mask holds anything but zeros.
    inked: bool,
    full: bool,
    waiting: usize,
    path: PathBuilder,
    corners: Vec<Point>,
    spare: Vec<Point>,
}

impl Tile {
    /// An empty tile.
    pub(super) fn new() -> Result<Self> {
        let mask = Mask::new(SIDE as u32, SIDE as u32).ok_or(Error::Internal("no mask of a tile's size"))?;
        let (path, corners, spare) = (PathBuilder::new(), Vec::new(), Vec::new());
        Ok(Self { origin: [0.0; 2], mask, inked: false, full: false, waiting: 0, path, corners, spare })
    }

    /// Moves to the tile whose top left corner is `origin`.
    pub(super) fn open(&mut self, origin: Point) {
        self.origin = origin;
        self.full = false;
    }

    /// Adds one taper.
    pub(super) fn add(&mut self, taper: &Taper, poll: &dyn Fn() -> Result<()>) -> Result<()> {
        if self.full {
            return Ok(());
        }
        self.corners.clear();
        taper.outline(self.origin, &mut self.corners);
        let side = TILE as f64;
        if self.corners.iter().flatten().any(|value| !(0.0..=side).contains(value)) {
            clip::to_square(&mut self.corners, &mut self.spare, side);
            self.full = clip::fills_square(&self.corners, side);
        }
        self.trace();
        if self.waiting == BATCH {
            self.fill();
            poll()?;
        }
        Ok(())
    }

    /// Appends the outline to the path, in samples.
    fn trace(&mut self) {
        let samples = |value: f64| (value * GRID as f64) as f32;
        let mut corners = self.corners.iter().map(|corner| corner.map(samples));
        let Some([x, y]) = corners.next() else { return };
        self.path.move_to(x, y);
        corners.for_each(|[x, y]| self.path.line_to(x, y));
        self.path.close();
        self.waiting += 1;
    }

    /// Fills what waits in the path.
    fn fill(&mut self) {
        self.waiting = 0;
        let Some(path) = std::mem::take(&mut self.path).finish() else { return };
        self.mask.fill_path(&path, FillRule::Winding, false, Transform::identity());
        self.path = path.clear();
        self.inked = true;
    }

    /// Writes the pixels into `band`, rows of `width` pixels, from column `left` on, and wipes the mask.
    pub(super) fn close(&mut self, band: &mut [u8], width: usize, left: usize, table: &Table) {
        self.fill();
        let columns = TILE.min(width - left);
        let rows = band.chunks_exact_mut(4 * width).map(|row| &mut row[4 * left..4 * (left + columns)]);
        if self.full || !self.inked {
            let color = table[if self.full { SAMPLES as usize } else { 0 }];
            rows.for_each(|row| row.as_chunks_mut().0.fill(color));
        } else {
            let groups = self.mask.data().chunks_exact(SIDE * GRID);
            rows.zip(groups).for_each(|(row, samples)| resolve(samples, row.as_chunks_mut().0, table));
        }
        if self.inked {
            self.mask.clear();
            self.inked = false;
        }
    }
}

/// Turns the samples of one row of pixels into colours.
fn resolve(samples: &[u8], row: &mut [[u8; 4]], table: &Table) {
    // A sample is 0 or 255. Eight rows add up to at most 8 in each byte, eight bytes to at most 64.
    let mut sums = [0_u8; SIDE];
    for line in samples.chunks_exact(SIDE) {
        sums.iter_mut().zip(line).for_each(|(sum, sample)| *sum += sample & 1);
    }
    for (pixel, sums) in row.iter_mut().zip(sums.as_chunks::<GRID>().0) {
        let inked = u64::from_le_bytes(*sums).wrapping_mul(0x0101_0101_0101_0101) >> 56;
        *pixel = table[inked as usize];
    }
}
