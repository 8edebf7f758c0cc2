//! How much of each pixel the crack covers.
//!
//! Per piece and pixel this is the overlap of the pixel, seen as an interval of length 1 along the line through the
//! nearest disc's centre, with the piece's chord on that line. It is exact for sides along the rows or columns,
//! and off by at most .043 for oblique ones. Pieces are joined by the largest: joints have no seams, and no order.

use pulp::{Simd, WithSimd};

use super::grid::{PART, UNIT};
use super::piece::Piece;

/// Pixels done at a time.
const LANES: usize = 8;

/// 2^23: added to a number from 0 to 255, it leaves the nearest integer in the lowest bits.
const ROUND: f32 = 8_388_608.0;

/// Pixels to which 32-bit parts of a pixel count.
const COUNTABLE: f32 = 30_000.0;

/// Rows of `width` pixels that are to be covered by some pieces; the first pixel is at `corner`.
pub(super) struct Ink<'a> {
    pub(super) pieces: &'a [Piece],
    pub(super) ids: &'a [u32],
    pub(super) corner: [i64; 2],
    pub(super) width: usize,
    pub(super) rows: &'a mut [u8],
}

impl WithSimd for Ink<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        for &id in self.ids {
            ink(&self.pieces[id as usize], self.corner, self.width, self.rows);
        }
    }
}

/// Raises the coverage in rows of `width` pixels, of which the first starts at `corner`, pixels.
#[inline(always)]
fn ink(piece: &Piece, corner: [i64; 2], width: usize, rows: &mut [u8]) {
    let [left, top, right, bottom] = piece.region();
    let height = (rows.len() / width.max(1)) as i64;
    let from = corner.map(|pixel| pixel * UNIT);
    let row_of = |place: i64| ((place - from[1]) >> 16).clamp(0, height);
    let column_of = |place: i64| ((place - from[0]) >> 16).clamp(0, width as i64) as usize;
    // The region is a pixel wider than the piece, and nothing is covered farther than half a pixel from that to a
    // pixel's middle.
    let (columns, lines) = ((column_of(left), column_of(right + UNIT)), row_of(top + UNIT)..row_of(bottom));
    if columns.0 >= columns.1 {
        return;
    }
    let strip = Strip::new(piece, from, columns);
    let thick = piece.radius.min(piece.radius + piece.slope * piece.length) > 0.5;
    let countable = piece.length + 2.0 * piece.radius.max(strip.widest) + (LANES as f32) < COUNTABLE;
    for row in lines {
        let y = from[1] + row * UNIT + UNIT / 2 - piece.start[1];
        let dy = y as f32 * PART;
        let line = &mut rows[row as usize * width..][..width];
        let (start, end) = strip.columns(dy);
        if countable && width >= LANES {
            let mut chunk = start;
            while chunk < end {
                let chunk_start = chunk.min(width - LANES);
                let x = (from[0] + chunk_start as i64 * UNIT + UNIT / 2 - piece.start[0]) as i32;
                if let Some(pixels) = line[chunk_start..].first_chunk_mut() {
                    if thick { raise::<true>(piece, x, dy, pixels) } else { raise::<false>(piece, x, dy, pixels) }
                }
                chunk += LANES;
            }
        } else {
            for (column, pixel) in (start..end).zip(&mut line[start..end]) {
                let x = from[0] + column as i64 * UNIT + UNIT / 2 - piece.start[0];
                *pixel = (*pixel).max(share::<false>(piece, x as f32 * PART, dy).to_bits() as u8);
            }
        }
    }
}

/// The columns that a piece can reach, row by row.
struct Strip {
    /// Columns between which all of it lies.
    columns: (usize, usize),
    widest: f32,
    /// Columns a row down along the middle line, and to either side of it; none for pieces along a row.
    step: Option<(f64, f64)>,
    /// The piece's start, in columns.
    start: f64,
}

impl Strip {
    #[inline(always)]
    fn new(piece: &Piece, from: [i64; 2], columns: (usize, usize)) -> Self {
        let [u, v] = piece.along.map(f64::from);
        let widest = piece.radius.max(piece.radius + piece.slope * piece.length);
        // Half a pixel beyond the widest disc nothing is covered; half a column is the pixel's own middle.
        let reach = f64::from(widest) + 0.51;
        let step = (v.abs() > 0.01 && piece.length > 0.0).then(|| (u / v, reach / v.abs()));
        let start = (piece.start[0] - from[0]) as f64 / UNIT as f64 - 0.5;
        Self { columns, widest, step, start }
    }

    /// First and last but one of the columns of a row; none are counted from no farther than the last.
    #[inline(always)]
    fn columns(&self, dy: f32) -> (usize, usize) {
        let Some((slope, reach)) = self.step else { return self.columns };
        let middle = self.start + slope * f64::from(dy);
        let (low, high) = (middle - reach, middle + reach + 1.0);
        // `as` takes what is negative to 0.
        let end = (high as usize + 1).min(self.columns.1);
        ((low as usize).max(self.columns.0).min(end), end)
    }
}

/// Raises some pixels of a row; the first lies `x` parts of a pixel to the right of the piece's start.
#[inline(always)]
fn raise<const THICK: bool>(piece: &Piece, x: i32, dy: f32, pixels: &mut [u8; LANES]) {
    let mut values = [0.0_f32; LANES];
    for (lane, value) in values.iter_mut().enumerate() {
        *value = share::<THICK>(piece, (x + lane as i32 * UNIT as i32) as f32 * PART, dy);
    }
    // In numbers as wide as the values: as bytes they would be taken out and compared one by one.
    let mut highest = [0_u32; LANES];
    for (lane, highest) in highest.iter_mut().enumerate() {
        let (value, pixel) = (values[lane].to_bits() & 0xFF, u32::from(pixels[lane]));
        *highest = if value > pixel { value } else { pixel };
    }
    for (pixel, highest) in pixels.iter_mut().zip(&highest) {
        *pixel = *highest as u8;
    }
}

/// The coverage of one pixel, in the lowest byte. Both sides of a thick piece are never within one pixel.
#[inline(always)]
fn share<const THICK: bool>(piece: &Piece, dx: f32, dy: f32) -> f32 {
    let foot = piece.foot(dx, dy);
    let near = unit(0.5 + foot.radius - foot.centre);
    let far = if THICK { 0.0 } else { unit(0.5 - foot.radius - foot.centre) };
    (near - far) * 255.0 + ROUND
}

/// Cut to 0 to 1.
#[inline(always)]
fn unit(value: f32) -> f32 {
    let value = if value < 0.0 { 0.0 } else { value };
    if value > 1.0 { 1.0 } else { value }
}
