//! Tiles of a TIFF: differences of neighbours, compressed. The file around them is the face's.
//!
//! # Source
//! TIFF 6.0, section 14, for integers; Adobe Photoshop TIFF technical note 3 for floats.

use crate::error::{Error, Result};
use crate::watch::Watch;
use crate::{deflate, parallel};

/// Tiles of one size, one after the other, without gaps.
#[derive(Debug, Clone, Copy)]
pub struct Tiles<'a> {
    /// `height * width * channels` samples a tile, little-endian.
    pub bytes: &'a [u8],
    /// Rows a tile.
    pub height: usize,
    /// Pixels a row of a tile.
    pub width: usize,
    /// Samples a pixel.
    pub channels: usize,
    /// Bytes a sample: 1, 2 or 4.
    pub sample: usize,
    /// Whether the samples are floats.
    pub float: bool,
}

/// Every tile as a zlib stream of differences along the rows: predictor 3 of TIFF for floats, 2 for integers.
///
/// # Errors
/// [`Error::BadLength`] or [`Error::BadValue`] for bytes that are no such tiles, [`Error::Interrupted`].
pub fn compress(tiles: Tiles<'_>, watch: Watch<'_>) -> Result<Vec<Vec<u8>>> {
    if !matches!(tiles.sample, 1 | 2 | 4) {
        return Err(Error::BadValue {
            name: "sample",
            value: tiles.sample as f64,
            wanted: "1, 2 or 4 bytes are wanted",
        });
    }
    let row = tiles.width.saturating_mul(tiles.channels).saturating_mul(tiles.sample);
    let size = row.saturating_mul(tiles.height);
    if size == 0 || !tiles.bytes.len().is_multiple_of(size) {
        return Err(Error::BadLength { array: "tiles", found: tiles.bytes.len(), wanted: size });
    }
    parallel::several(tiles.bytes.len() / size, |index| {
        watch.poll()?;
        let mut out = Vec::with_capacity(size);
        for row in tiles.bytes[index * size..(index + 1) * size].chunks_exact(row) {
            tiles.predict(row, &mut out);
        }
        Ok(deflate::zlib(&out))
    })
    .into_iter()
    .collect()
}

impl Tiles<'_> {
    /// Appends a row as differences.
    fn predict(&self, row: &[u8], out: &mut Vec<u8>) {
        match (self.float, self.sample) {
            (true, _) => self.planes(row, out),
            (false, 1) => differences(row, self.channels, out),
            (false, 2) => self.words(row, u16::from_le_bytes, u16::wrapping_sub, u16::to_le_bytes, out),
            (false, _) => self.words(row, u32::from_le_bytes, u32::wrapping_sub, u32::to_le_bytes, out),
        }
    }

    fn words<const N: usize, T: Copy>(
        &self,
        row: &[u8],
        read: impl Fn([u8; N]) -> T,
        subtract: impl Fn(T, T) -> T,
        write: impl Fn(T) -> [u8; N],
        out: &mut Vec<u8>,
    ) {
        let words = row.as_chunks::<N>().0;
        out.extend_from_slice(words[..self.channels].as_flattened());
        for (&here, &left) in words[self.channels..].iter().zip(words) {
            out.extend_from_slice(&write(subtract(read(here), read(left))));
        }
    }

    /// The highest bytes of all samples, then the next ones, and so on: as one row of bytes.
    fn planes(&self, row: &[u8], out: &mut Vec<u8>) {
        let planes: Vec<u8> =
            (0..self.sample).rev().flat_map(|place| row.iter().skip(place).step_by(self.sample).copied()).collect();
        differences(&planes, self.channels, out);
    }
}

/// Appends bytes as differences to those `stride` before them.
fn differences(row: &[u8], stride: usize, out: &mut Vec<u8>) {
    out.extend_from_slice(&row[..stride]);
    out.extend(row[stride..].iter().zip(row).map(|(a, b)| a.wrapping_sub(*b)));
}
