//! Rows of a picture, filtered and compressed in strips of their own.

use crate::deflate;

/// Bytes of a strip: enough for codes of its own, few enough for the cache.
const STRIP: usize = 1 << 18;

/// Filters of PNG, section 9.2: the difference to the pixel on the left, to the one above.
const SUB: u8 = 1;
const UP: u8 = 2;

/// Rows without gaps, the samples of 16 bits in little-endian order.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rows<'a> {
    /// Whole rows.
    pub(super) pixels: &'a [u8],
    /// Bytes a row.
    pub(super) row: usize,
    /// Bytes a pixel.
    pub(super) pixel: usize,
    /// Whether a sample has two bytes.
    pub(super) deep: bool,
}

/// A strip as a part of a zlib stream.
pub(super) struct Strip {
    /// Whole blocks of deflate, none the last.
    pub(super) piece: Vec<u8>,
    /// The checksum of its filtered bytes.
    pub(super) adler: u32,
    /// How many they are.
    pub(super) len: usize,
}

impl<'a> Rows<'a> {
    /// Rows a strip.
    fn height(&self) -> usize {
        (STRIP / self.row).max(1)
    }

    /// How many strips the rows make.
    pub(super) fn strips(&self) -> usize {
        (self.pixels.len() / self.row).div_ceil(self.height())
    }

    /// The strip of that index, compressed.
    pub(super) fn strip(&self, index: usize) -> Strip {
        let first = index * self.height();
        let last = (first + self.height()).min(self.pixels.len() / self.row);
        let mut filtered = Vec::with_capacity((last - first) * (self.row + 1));
        for y in first..last {
            self.filter(y, &mut filtered);
        }
        Strip { piece: deflate::piece(&filtered), adler: deflate::adler(&filtered), len: filtered.len() }
    }

    fn at(&self, y: usize) -> &'a [u8] {
        &self.pixels[y * self.row..(y + 1) * self.row]
    }

    /// Appends row `y`, filtered. The top row is not told from what stands above, so that rows can come in bands.
    fn filter(&self, y: usize, out: &mut Vec<u8>) {
        let here = self.at(y);
        out.push(if y > 0 { UP } else { SUB });
        let start = out.len();
        if y > 0 {
            out.extend(here.iter().zip(self.at(y - 1)).map(|(a, b)| a.wrapping_sub(*b)));
        } else {
            let (head, rest) = here.split_at(self.pixel);
            out.extend(head);
            out.extend(rest.iter().zip(here).map(|(a, b)| a.wrapping_sub(*b)));
        }
        if self.deep {
            // Filters work byte by byte, so that the bytes of a sample can change places afterwards.
            out[start..].as_chunks_mut::<2>().0.iter_mut().for_each(|pair| pair.reverse());
        }
    }
}
