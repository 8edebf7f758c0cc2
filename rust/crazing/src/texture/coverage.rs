//! How much of each pixel the crack covers.
//!
//! Per piece and pixel this is the overlap of the pixel, seen as an interval of length 1 along the line through the
//! nearest disc's centre, with the piece's chord on that line. It is exact for sides along the rows or columns,
//! and off by at most .043 for oblique ones. Pieces are joined by the largest: joints have no seams, and no order.

use super::grid::UNIT;
use super::piece::Piece;

/// Pixels done at a time.
const LANES: usize = 8;

/// 2^23: added to a number from 0 to 255, it leaves the nearest integer in the lowest bits.
const ROUND: f32 = 8_388_608.0;

/// Raises the coverage in rows of `width` pixels, of which the first starts at `corner`, pixels.
pub(super) fn ink(piece: &Piece, corner: [i64; 2], width: usize, rows: &mut [u8]) {
    let [left, top, right, bottom] = piece.region();
    let height = rows.len() / width.max(1);
    let pixel = |place: i64, from: i64, limit: usize| (place.div_euclid(UNIT) - from).clamp(0, limit as i64) as usize;
    let (first, last) = (pixel(top, corner[1], height), pixel(bottom + UNIT, corner[1], height));
    let (start, end) = (pixel(left, corner[0], width), pixel(right + UNIT, corner[0], width));
    if start >= end {
        return;
    }
    for (row, line) in (first..last).zip(rows[first * width..].chunks_exact_mut(width)) {
        let y = (corner[1] + row as i64) * UNIT + UNIT / 2;
        let (mut chunk, end) = (start, end);
        while chunk < end {
            let x = (corner[0] + chunk as i64) * UNIT + UNIT / 2;
            let values = covered(piece, x, y);
            for (pixel, value) in line[chunk..end.min(chunk + LANES)].iter_mut().zip(values) {
                *pixel = (*pixel).max(value);
            }
            chunk += LANES;
        }
    }
}

/// The coverage of some pixels of a row, 0 to 255.
#[inline(always)]
fn covered(piece: &Piece, x: i64, y: i64) -> [u8; LANES] {
    let mut values = [0; LANES];
    for (lane, value) in values.iter_mut().enumerate() {
        let [dx, dy] = piece.from_start(x + lane as i64 * UNIT, y);
        *value = share(piece, dx, dy);
    }
    values
}

/// The coverage of one pixel.
#[inline(always)]
fn share(piece: &Piece, dx: f32, dy: f32) -> u8 {
    let foot = piece.foot(dx, dy);
    let near = unit(0.5 + foot.radius - foot.centre);
    let far = unit(0.5 - foot.radius - foot.centre);
    ((near - far) * 255.0 + ROUND).to_bits() as u8
}

/// Cut to 0 to 1.
#[inline(always)]
fn unit(value: f32) -> f32 {
    let value = if value < 0.0 { 0.0 } else { value };
    if value > 1.0 { 1.0 } else { value }
}
