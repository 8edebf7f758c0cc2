//! What reaches into which band of rows.

use std::ops::Range;

use super::grid::{UNIT, Window};
use super::piece::Piece;
use crate::error::{Error, Result};

/// What reaches into every band, in ascending order.
#[derive(Debug)]
pub(super) struct Sorted {
    starts: Vec<usize>,
    ids: Vec<u32>,
}

/// The pieces of every band.
#[derive(Debug)]
pub(super) struct Bands {
    /// How many pieces were sorted.
    pub(super) count: usize,
    sorted: Sorted,
}

impl Sorted {
    /// Sorts by the bands, of that number, into which each reaches.
    pub(super) fn new(spans: Vec<Range<u32>>, count: usize) -> Result<Self> {
        let mut starts = vec![0_usize; count + 1];
        for span in &spans {
            span.clone().for_each(|band| starts[band as usize + 1] += 1);
        }
        for band in 0..count {
            starts[band + 1] += starts[band];
        }
        let mut next = starts.clone();
        let mut ids = Vec::new();
        let bytes = 4 * starts[count] as u128;
        ids.try_reserve_exact(starts[count]).map_err(|_| Error::OutOfMemory { what: "the edges by bands", bytes })?;
        ids.resize(starts[count], 0);
        for (id, span) in (0..).zip(spans) {
            for band in span {
                ids[next[band as usize]] = id;
                next[band as usize] += 1;
            }
        }
        Ok(Self { starts, ids })
    }

    /// What reaches into a band.
    pub(super) fn of(&self, band: usize) -> &[u32] {
        &self.ids[self.starts[band]..self.starts[band + 1]]
    }
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
        Ok(Self { count: pieces.len(), sorted: Sorted::new(pieces.iter().map(span).collect(), count)? })
    }

    /// The pieces that reach into a band.
    pub(super) fn of(&self, band: usize) -> &[u32] {
        self.sorted.of(band)
    }
}
