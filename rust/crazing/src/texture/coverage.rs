//! How much of each pixel the crack covers.
//!
//! Per piece and pixel this is the overlap of the pixel, seen as an interval of length 1 along the line through the
//! nearest disc's centre, with the piece's chord on that line. It is exact for sides along the rows or columns,
//! and off by at most .043 for oblique ones; at ends, and where a piece is narrower than a pixel, by more. Pieces are
//! joined by the largest: joints have no seams, and no order, but pieces side by side in one pixel are not added up.

use pulp::{Simd, WithSimd};

use super::grid::{PART, UNIT, both};
use super::lanes::Number;
use super::piece::{Foot, Piece};

/// Pixels done at a time.
const LANES: usize = 8;

/// 2^23: added to a number from 0 to 255, it leaves the nearest integer in the lowest bits.
const ROUND: f32 = 8_388_608.0;

/// Pixels to which 32-bit parts of a pixel count.
const COUNTABLE: f32 = 30_000.0;

/// More parts of a pixel than any row has.
const ANYWHERE: f64 = 1e15;

/// Pieces looked at before the first of them is drawn: they lie anywhere in memory, and are waited for together.
const BLOCK: usize = 16;

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
        let Self { pieces, ids, corner, width, rows } = self;
        let mut strokes = [Stroke::default(); BLOCK];
        for ids in ids.chunks(BLOCK) {
            for (stroke, &id) in strokes.iter_mut().zip(ids) {
                *stroke = Stroke::new(&pieces[id as usize], corner, [width, rows.len() / width.max(1)]);
            }
            for stroke in &strokes[..ids.len()] {
                match stroke.pen {
                    Pen::Thick => stroke.draw::<true>(rows, width),
                    Pen::Thin => stroke.draw::<false>(rows, width),
                    Pen::Slow => stroke.draw_slowly(rows, width),
                }
            }
        }
    }
}

/// How a piece is drawn.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
enum Pen {
    /// Both sides of it are never within one pixel.
    Thick,
    Thin,
    /// Pixel by pixel: it is too long for 32-bit parts of a pixel, or the rows are too short for the lanes.
    #[default]
    Slow,
}

/// A piece as it is drawn into some rows: pixels count from their first one. The columns it can reach follow its middle
/// line from row to row.
#[derive(Debug, Default, Clone, Copy)]
struct Stroke {
    pen: Pen,
    /// The rows and columns it can reach.
    rows: [usize; 2],
    columns: [i64; 2],
    /// From the piece's start to the middle of the first column, and of the first of `rows`, parts of a pixel.
    from: [i64; 2],
    /// Where the middle line passes that row, how far it goes to the right from row to row, and how far to both sides of
    /// it the piece can reach: parts of a pixel.
    middle: i64,
    step: i64,
    reach: i64,
    along: [f32; 2],
    length: f32,
    radius: f32,
    slope: f32,
    lean: f32,
}

impl Stroke {
    #[inline(always)]
    fn new(piece: &Piece, corner: [i64; 2], [width, height]: [usize; 2]) -> Self {
        let Piece { start, along, length, radius, slope, lean, .. } = *piece;
        let other = radius + slope * length;
        let (least, most) = (radius.min(other), radius.max(other));
        // Half a pixel beyond the widest disc nothing is covered.
        let far = ((f64::from(most) + 0.51) * UNIT as f64) as i64;
        let [x, y] = both(|axis| start[axis] - corner[axis] * UNIT - UNIT / 2);
        let end = both(|axis| [x, y][axis] + (f64::from(along[axis]) * f64::from(length) * UNIT as f64) as i64);
        let from = |a: i64, b: i64, size: usize| above(a.min(b) - far).clamp(0, size as i64);
        let to = |a: i64, b: i64, size: usize| (below(a.max(b) + far) + 1).clamp(0, size as i64);
        let columns = [from(x, end[0], width), to(x, end[0], width)];
        let rows = [from(y, end[1], height), to(y, end[1], height)];
        let down = rows[0] * UNIT - y;
        let [u, v] = along.map(f64::from);
        // Along a row the columns of all of it are as good.
        let steep = v.abs() > 0.01 && length > 0.0;
        let (slant, reach) = if steep { (u / v, far as f64 / v.abs()) } else { (0.0, ANYWHERE) };
        let pen = if length + 2.0 * most + LANES as f32 >= COUNTABLE || width < LANES {
            Pen::Slow
        } else if least > 0.5 {
            Pen::Thick
        } else {
            Pen::Thin
        };
        Self {
            pen,
            rows: rows.map(|row| row as usize),
            columns,
            from: [-x, down],
            middle: x + (slant * down as f64) as i64,
            step: (slant * UNIT as f64) as i64,
            reach: reach as i64,
            along,
            length,
            radius,
            slope,
            lean,
        }
    }

    /// The rows it can reach, each with how far below the start it is and the columns that can be reached in it.
    #[inline(always)]
    fn lines<'a>(&self, rows: &'a mut [u8], width: usize) -> impl Iterator<Item = (&'a mut [u8], i64, [i64; 2])> {
        let Self { rows: [first, last], columns, from, step, reach, mut middle, .. } = *self;
        let empty = first >= last || columns[0] >= columns[1];
        let lines = if empty { &mut [] } else { &mut rows[first * width..last * width] };
        lines.chunks_exact_mut(width).zip((from[1]..).step_by(UNIT as usize)).map(move |(line, down)| {
            let (left, right) = (above(middle - reach), below(middle + reach) + 1);
            middle += step;
            (line, down, [left.max(columns[0]), right.min(columns[1])])
        })
    }

    #[inline(always)]
    fn draw<const THICK: bool>(&self, rows: &mut [u8], width: usize) {
        for (line, down, [left, right]) in self.lines(rows, width) {
            let dy = down as i32 as f32 * PART;
            for chunk in (left..right).step_by(LANES) {
                let at = chunk.min((width - LANES) as i64);
                if let Some(pixels) = line[at as usize..].first_chunk_mut() {
                    self.raise::<THICK>((self.from[0] + at * UNIT) as i32, dy, pixels);
                }
            }
        }
    }

    fn draw_slowly(&self, rows: &mut [u8], width: usize) {
        for (line, down, [left, right]) in self.lines(rows, width) {
            for column in left..right {
                let [dx, dy] = [self.from[0] + column * UNIT, down].map(|parts| parts as f32 * PART);
                let pixel = &mut line[column as usize];
                *pixel = (*pixel).max(self.share::<false>(dx, dy).to_bits() as u8);
            }
        }
    }

    /// Raises some pixels of a row; the first lies `x` parts of a pixel to the right of the piece's start.
    #[inline(always)]
    fn raise<const THICK: bool>(&self, x: i32, dy: f32, pixels: &mut [u8; LANES]) {
        let mut values = [0.0_f32; LANES];
        for (lane, value) in values.iter_mut().enumerate() {
            *value = self.share::<THICK>((x + lane as i32 * UNIT as i32) as f32 * PART, dy);
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

    /// The coverage of one pixel, in the lowest byte.
    #[inline(always)]
    fn share<const THICK: bool>(&self, dx: f32, dy: f32) -> f32 {
        let foot = Foot::new(dx, dy, self.along, self.length, [self.radius, self.slope], self.lean);
        let near = (0.5 + foot.radius - foot.centre).unit();
        let far = if THICK { 0.0 } else { (0.5 - foot.radius - foot.centre).unit() };
        (near - far) * 255.0 + ROUND
    }
}

/// The first whole pixel that is no less, and the last that is no more.
#[inline(always)]
fn above(parts: i64) -> i64 {
    (parts + UNIT - 1) >> 16
}

#[inline(always)]
fn below(parts: i64) -> i64 {
    parts >> 16
}
