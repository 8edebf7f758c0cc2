//! Square bins over a region, and the pieces that may reach into each.

use super::grid::{UNIT, both};
use super::nearest::PAGE;
use super::piece::{Piece, Region};
use crate::error::{Error, Result};

/// Pieces a bin that the side of the bins aims at.
const CROWD: f64 = 3.0;

/// Bins that a page has at most, where they are smaller than it and lie along it.
const MIDDLES: usize = 16;

/// Sides of bins, pixels: powers of two.
const LEAST: i64 = 16;
const MOST: i64 = 1 << 40;

/// Bins in rows over a region; every bin lists its pieces in ascending order.
#[derive(Debug)]
pub(super) struct Bins {
    /// Pixels a side, a power of two.
    pub(super) side: i64,
    /// Left and top, in parts of a pixel.
    corner: [i64; 2],
    columns: i64,
    rows: i64,
    starts: Vec<u32>,
    pieces: Vec<u32>,
}

/// The side of bins that suits pieces of that number and width in an area, in pixels.
pub(super) fn side(count: usize, area: f64, widest: f32) -> i64 {
    let wanted = (CROWD * area / count.max(1) as f64).sqrt().max(f64::from(widest) / 2.0);
    let mut side = LEAST;
    while (side as f64) < wanted && side < MOST {
        side *= 2;
    }
    side
}

impl Bins {
    /// No bins at all.
    pub(super) fn none() -> Self {
        Self { side: LEAST, corner: [0; 2], columns: 0, rows: 0, starts: Vec::new(), pieces: Vec::new() }
    }

    /// Sorts the pieces into bins of `side` pixels; `region` is made of whole bins.
    pub(super) fn new(pieces: &[Piece], region: Region, side: i64) -> Result<Self> {
        let corner = [region[0], region[1]];
        let count = |axis: usize| (region[axis + 2] - region[axis]) / (side * UNIT);
        let (columns, rows) = (count(0), count(1));
        let mut bins = Self { side, corner, columns, rows, starts: Vec::new(), pieces: Vec::new() };
        let cells = (columns * rows) as usize;
        bins.starts = vec![0; cells + 1];
        let mut total = 0_u64;
        for piece in pieces {
            bins.each(piece, |bins, bin| bins.starts[bin + 1] += 1);
            total += 1;
        }
        let mut sum = 0_u64;
        for start in &mut bins.starts {
            sum += u64::from(*start);
            *start = sum as u32;
        }
        if total > u64::from(u32::MAX) || sum > u64::from(u32::MAX) {
            return Err(Error::TooMany { what: "pieces of edges", found: sum as usize, limit: u32::MAX as usize });
        }
        let bytes = 4 * u128::from(sum);
        bins.pieces
            .try_reserve_exact(sum as usize)
            .map_err(|_| Error::OutOfMemory { what: "the edges by tiles", bytes })?;
        bins.pieces.resize(sum as usize, 0);
        let mut next = bins.starts.clone();
        for (id, piece) in pieces.iter().enumerate() {
            bins.each(piece, |bins, bin| {
                bins.pieces[next[bin] as usize] = id as u32;
                next[bin] += 1;
            });
        }
        Ok(bins)
    }

    /// The column or row of a place. Sides are powers of two, and a shift is many times faster than a division.
    #[inline(always)]
    fn along(&self, axis: usize, value: i64) -> i64 {
        (value - self.corner[axis]) >> (self.side * UNIT).trailing_zeros()
    }

    /// Calls back for every bin that the piece may reach into.
    fn each(&mut self, piece: &Piece, mut call: impl FnMut(&mut Self, usize)) {
        let region = piece.region();
        let bin = |axis: usize, value: i64, count: i64| self.along(axis, value).clamp(-1, count);
        let (first, last) =
            (bin(0, region[0], self.columns).max(0), bin(0, region[2], self.columns).min(self.columns - 1));
        let (top, bottom) = (bin(1, region[1], self.rows).max(0), bin(1, region[3], self.rows).min(self.rows - 1));
        for row in top..=bottom {
            for column in first..=last {
                call(self, (row * self.columns + column) as usize);
            }
        }
    }

    /// The bins that a square of `side` pixels lies in: first column, first row, last column, last row.
    pub(super) fn of(&self, corner: [i64; 2], side: i64) -> [i64; 4] {
        let bin = |axis: usize, by: i64| self.along(axis, corner[axis] + by);
        let last = side * UNIT - 1;
        [bin(0, 0), bin(1, 0), bin(0, last), bin(1, last)]
    }

    /// How far from the nearest piece a place in some bins can be, pixels: what is measured at the middle of one bin
    /// holds for another as far as that is away. Infinite for bins that are no smaller than a page, of which a measure
    /// at their middles would say little, for bins without pieces, and for many or such as lie beyond the region.
    pub(super) fn farthest(&self, of: [i64; 4], pieces: &[Piece]) -> f32 {
        let (columns, rows) = (of[2] - of[0] + 1, of[3] - of[1] + 1);
        let outside = of[0] < 0 || of[1] < 0 || of[2] >= self.columns || of[3] >= self.rows;
        if self.side >= PAGE as i64 || columns * rows > MIDDLES as i64 || outside {
            return f32::INFINITY;
        }
        let mut best = [f32::INFINITY; MIDDLES];
        let place = |nth: usize| [of[0] + nth as i64 % columns, of[1] + nth as i64 / columns];
        let count = (columns * rows) as usize;
        for (nth, best) in best[..count].iter_mut().enumerate() {
            let [column, row] = place(nth);
            let at = (row * self.columns + column) as usize;
            let [x, y] = both(|axis| self.corner[axis] + (2 * [column, row][axis] + 1) * self.side * UNIT / 2);
            for &id in &self.pieces[self.starts[at] as usize..self.starts[at + 1] as usize] {
                let distance = pieces[id as usize].distance(x, y);
                *best = if distance < *best { distance } else { *best };
            }
        }
        let side = self.side as f32;
        let apart = |a: usize, b: usize| {
            let [x, y] = both(|axis| (place(a)[axis] - place(b)[axis]) as f32 * side);
            (x * x + y * y).sqrt()
        };
        let nearest = |a: usize| (0..count).fold(best[a], |least, b| least.min(best[b] + apart(a, b)));
        let is_full = best[..count].iter().all(|&best| best < f32::INFINITY);
        let farthest = (0..count).map(|nth| if is_full { best[nth] } else { nearest(nth) }).fold(0.0, f32::max);
        farthest + side * std::f32::consts::FRAC_1_SQRT_2
    }

    /// Whether the ring of bins that far around some bins lies wholly within the region.
    pub(super) fn holds_ring(&self, of: [i64; 4], ring: i64) -> bool {
        of[0] >= ring && of[1] >= ring && of[2] + ring < self.columns && of[3] + ring < self.rows
    }

    /// Whether any bin of the ring is in the region.
    pub(super) fn meets_ring(&self, of: [i64; 4], ring: i64) -> bool {
        of[0] >= ring || of[1] >= ring || of[2] + ring < self.columns || of[3] + ring < self.rows
    }

    /// Calls back with the pieces of every bin on the ring that far around some bins; ring 0 is the bins themselves.
    pub(super) fn ring(&self, of: [i64; 4], ring: i64, mut call: impl FnMut(&[u32])) {
        let (left, right) = (of[0] - ring, of[2] + ring);
        let (top, bottom) = (of[1] - ring, of[3] + ring);
        for row in top.max(0)..=bottom.min(self.rows - 1) {
            let mut stretch = |first: i64, last: i64| {
                let (first, last) = (first.max(0), last.min(self.columns - 1));
                if first <= last {
                    // Bins of a row lie behind each other.
                    let at = |column: i64| self.starts[(row * self.columns + column) as usize] as usize;
                    call(&self.pieces[at(first)..at(last + 1)]);
                }
            };
            if ring == 0 || row == top || row == bottom {
                stretch(left, right);
            } else {
                stretch(left, left);
                stretch(right, right);
            }
        }
    }
}
