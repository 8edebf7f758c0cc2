//! Which pieces reach into which band of rows.

use super::grid::{UNIT, Window};
use super::piece::Piece;
use crate::error::{Error, Result};

/// The pieces of every band, in ascending order.
#[derive(Debug)]
pub(super) struct Bands {
    /// How many pieces were sorted.
    pub(super) count: usize,
    starts: Vec<usize>,
    pieces: Vec<u32>,
}

impl Bands {
    /// Sorts pieces into bands of `rows` rows each of a window.
    pub(super) fn new(pieces: &[Piece], window: Window, rows: usize) -> Result<Self> {
        let Window { top, left, height, width } = window;
        let (count, height) = (height.div_ceil(rows), rows as i64 * UNIT);
        let (left, right) = (left * UNIT, (left + width as i64) * UNIT);
        let span = |piece: &Piece| {
            let region = piece.region();
            let band = |place: i64| (place - top * UNIT).div_euclid(height);
            let beside = region[0] >= right || region[2] < left;
            let (first, last) = (band(region[1]).max(0), band(region[3]).min(count as i64 - 1));
            if beside || last < first { 0..0 } else { first as u32..last as u32 + 1 }
        };
        let mut starts = vec![0_usize; count + 1];
        let spans: Vec<_> = pieces.iter().map(span).collect();
        for span in &spans {
            span.clone().for_each(|band| starts[band as usize + 1] += 1);
        }
        for band in 0..count {
            starts[band + 1] += starts[band];
        }
        let mut next = starts.clone();
        let mut sorted = Vec::new();
        let bytes = 4 * starts[count] as u128;
        sorted
            .try_reserve_exact(starts[count])
            .map_err(|_| Error::OutOfMemory { what: "the edges by bands", bytes })?;
        sorted.resize(starts[count], 0);
        for (id, span) in (0..).zip(spans) {
            for band in span {
                sorted[next[band as usize]] = id;
                next[band as usize] += 1;
            }
        }
        Ok(Self { count: pieces.len(), starts, pieces: sorted })
    }

    /// The pieces that reach into a band.
    pub(super) fn of(&self, band: usize) -> &[u32] {
        &self.pieces[self.starts[band]..self.starts[band + 1]]
    }
}
