//! How crack patterns measure: the statistics of fracture networks, mosaics and lines.

mod angles;
mod bounds;
mod boxes;
mod bridges;
mod distance;
mod faces;
mod lines;
mod network;
mod stamp;
mod statistics;
mod thin;
mod trace;
mod widths;

pub use network::Drawing;
pub use stamp::stamp;
pub use statistics::{Gauge, Statistics, statistics};
pub use thin::thin;
pub use trace::{Trace, trace};

use crate::error::{Error, Result};

/// Pixels that are crack, row 0 on top.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Mask {
    /// `height * width` entries.
    pub pixels: Vec<bool>,
    /// Rows.
    pub height: usize,
    /// Columns.
    pub width: usize,
}

impl Mask {
    /// A mask of `height` rows.
    ///
    /// # Errors
    /// [`Error::BadLength`] or [`Error::TooMany`].
    pub fn new(pixels: Vec<bool>, height: usize, width: usize) -> Result<Self> {
        let (found, wanted) = (pixels.len(), height.saturating_mul(width));
        if found != wanted {
            return Err(Error::BadLength { array: "mask", found, wanted });
        }
        let limit = i32::MAX as usize / 2;
        if found > limit {
            return Err(Error::TooMany { what: "pixels", found, limit });
        }
        Ok(Self { pixels, height, width })
    }

    /// The pixel one step away, if it is in the picture.
    pub(crate) fn beside(&self, at: u32, (down, right): (isize, isize)) -> Option<u32> {
        let row = (at as usize / self.width).checked_add_signed(down).filter(|&row| row < self.height)?;
        let column = (at as usize % self.width).checked_add_signed(right).filter(|&column| column < self.width)?;
        Some((row * self.width + column) as u32)
    }
}
