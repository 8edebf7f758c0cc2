//! Tiles of a TIFF: differences of neighbours, compressed. The file around them is the face's.
//!
//! # Source
//! TIFF 6.0, section 14, for integers; Adobe Photoshop TIFF technical note 3 for floats.

use std::io::Write;

use crate::error::{Error, Result};
use crate::watch::Watch;
use crate::{deflate, parallel};

/// Rows of a picture that are to be cut into one row of tiles.
#[derive(Debug, Clone, Copy)]
pub struct Band<'a> {
    /// Rows of `width * channels` samples, little-endian; at most as many rows as a tile has.
    pub bytes: &'a [u8],
    /// Pixels a row.
    pub width: usize,
    /// Samples a pixel.
    pub channels: usize,
    /// Bytes a sample: 1, 2 or 4.
    pub sample: usize,
    /// Whether the samples are floats.
    pub float: bool,
    /// Rows and columns of a tile.
    pub tile: [usize; 2],
}

/// Writes every tile as a zlib stream of differences along the rows: predictor 3 of TIFF for floats, 2 for integers.
/// Gives the bytes of each.
///
/// Pixels beyond the edges go on as the last ones: they cost least so.
///
/// # Errors
/// [`Error::BadLength`] or [`Error::BadValue`] for bytes that are no such rows, [`Error::Write`] with the reason of the
/// writer, [`Error::Interrupted`].
pub fn compress(mut writer: impl Write, band: Band<'_>, watch: Watch<'_>) -> Result<Vec<usize>> {
    if !matches!(band.sample, 1 | 2 | 4) {
        return Err(Error::BadValue {
            name: "sample",
            value: band.sample as f64,
            wanted: "1, 2 or 4 bytes are wanted",
        });
    }
    let row = band.width.saturating_mul(band.channels).saturating_mul(band.sample);
    let [height, width] = band.tile;
    let rows = band.bytes.len().checked_div(row).unwrap_or(0);
    if rows == 0 || rows > height || width == 0 || rows * row != band.bytes.len() {
        return Err(Error::BadLength { array: "rows", found: band.bytes.len(), wanted: row.saturating_mul(height) });
    }
    let tiles = parallel::several_with(band.width.div_ceil(width), Room::default, |room, index| {
        watch.poll()?;
        Ok(deflate::zlib(band.tile(index, row, room)))
    });
    let put = |tile: Result<Vec<u8>>| {
        let tile = tile?;
        writer.write_all(&tile).map_err(|error| Error::Write { reason: error.to_string() })?;
        Ok(tile.len())
    };
    tiles.into_iter().map(put).collect()
}

/// What is needed for one tile, and used again for the next one.
#[derive(Default)]
struct Room {
    out: Vec<u8>,
    /// A row that goes on beyond the picture.
    line: Vec<u8>,
    planes: Vec<u8>,
}

impl Band<'_> {
    /// The differences of one tile, from rows of so many bytes.
    fn tile<'a>(&self, index: usize, row: usize, room: &'a mut Room) -> &'a [u8] {
        let pixel = self.channels * self.sample;
        let wide = self.tile[1] * pixel;
        let (first, last) = (index * wide, row.min((index + 1) * wide));
        let Room { out, line, planes } = room;
        out.resize(self.tile[0] * wide, 0);
        line.resize(wide, 0);
        planes.resize(wide, 0);
        let (done, below) = out.split_at_mut(self.bytes.len() / row * wide);
        for (row, out) in self.bytes.chunks_exact(row).zip(done.chunks_exact_mut(wide)) {
            let mut own = &row[first..last];
            if own.len() < wide {
                let (inside, beyond) = line.split_at_mut(own.len());
                inside.copy_from_slice(own);
                let edge = &inside[inside.len() - pixel..];
                beyond.chunks_exact_mut(pixel).for_each(|beyond| beyond.copy_from_slice(edge));
                own = line;
            }
            self.predict(own, planes, out);
        }
        let last = &done[done.len() - wide..];
        below.chunks_exact_mut(wide).for_each(|below| below.copy_from_slice(last));
        out
    }

    /// Writes a row as differences.
    fn predict(&self, row: &[u8], planes: &mut [u8], out: &mut [u8]) {
        match (self.float, self.sample) {
            (false, 1) => self.words(row, u8::from_le_bytes, u8::wrapping_sub, u8::to_le_bytes, out),
            (false, 2) => self.words(row, u16::from_le_bytes, u16::wrapping_sub, u16::to_le_bytes, out),
            (false, _) => self.words(row, u32::from_le_bytes, u32::wrapping_sub, u32::to_le_bytes, out),
            (true, sample) => {
                match sample {
                    2 => split::<2>(row, planes),
                    4 => split::<4>(row, planes),
                    _ => planes.copy_from_slice(row),
                }
                self.words(planes, u8::from_le_bytes, u8::wrapping_sub, u8::to_le_bytes, out);
            }
        }
    }

    fn words<const N: usize, T: Copy>(
        &self,
        row: &[u8],
        read: impl Fn([u8; N]) -> T,
        subtract: impl Fn(T, T) -> T,
        write: impl Fn(T) -> [u8; N],
        out: &mut [u8],
    ) {
        let (words, out) = (row.as_chunks::<N>().0, out.as_chunks_mut::<N>().0);
        out[..self.channels].copy_from_slice(&words[..self.channels]);
        for ((out, &here), &left) in out[self.channels..].iter_mut().zip(&words[self.channels..]).zip(words) {
            *out = write(subtract(read(here), read(left)));
        }
    }
}

/// The highest bytes of all samples, then the next ones, and so on: as one row of bytes.
fn split<const N: usize>(row: &[u8], planes: &mut [u8]) {
    let words = row.as_chunks::<N>().0;
    for (place, plane) in (0..N).rev().zip(planes.chunks_exact_mut(words.len().max(1))) {
        plane.iter_mut().zip(words).for_each(|(out, word)| *out = word[place]);
    }
}
