//! A piece as it is seen from a corner near by: in numbers of 32 bits, of which many are done at a time.

use super::piece::{Foot, Piece};

/// A piece seen from a corner near by, in parts of a pixel.
#[derive(Debug, Clone, Copy)]
pub(super) struct Near {
    pub(super) start: [i32; 2],
    pub(super) along: [f32; 2],
    pub(super) length: f32,
    pub(super) radius: f32,
    pub(super) slope: f32,
    pub(super) lean: f32,
}

/// Codes of one piece: to its left, and its right; the same behind its start, and behind its end.
pub(super) const CODES: u32 = 8;
pub(super) const RIGHT: u32 = 1;
pub(super) const BEHIND_START: u32 = 2;
pub(super) const BEHIND_END: u32 = 4;

impl Near {
    pub(super) fn new(piece: &Piece, x: i64, y: i64) -> Self {
        let Piece { start, along, length, radius, slope, lean, .. } = *piece;
        Self { start: [(start[0] - x) as i32, (start[1] - y) as i32], along, length, radius, slope, lean }
    }

    /// How far the centre of the nearest disc is, and the unit vector from there.
    #[inline(always)]
    pub(super) fn away(&self, dx: f32, dy: f32) -> (f32, [f32; 2]) {
        let [u, v] = self.along;
        let Foot { ahead, side, centre, .. } =
            Foot::new(dx, dy, self.along, self.length, [self.radius, self.slope], self.lean);
        (centre, [(ahead * u + side * v) / centre, (ahead * v - side * u) / centre])
    }

    /// Signed distance, and where the place lies beside the piece. The same sum as [`Piece::foot`], of which only
    /// this is wanted here.
    #[inline(always)]
    pub(super) fn measure(&self, dx: f32, dy: f32) -> (f32, u32) {
        let [u, v] = self.along;
        let t = dx * u + dy * v;
        let side = dx * v - dy * u;
        let n = side.abs();
        let raw = t + self.lean * n;
        let s = if raw < 0.0 { 0.0 } else { raw };
        let s = if s > self.length { self.length } else { s };
        let ahead = t - s;
        let distance = (ahead * ahead + n * n).sqrt() - (self.radius + self.slope * s);
        (distance, beside(raw, self.length) + (side.to_bits() >> 31))
    }
}

/// Behind which end of a piece a place lies, if behind any.
#[inline(always)]
pub(super) fn beside(along: f32, length: f32) -> u32 {
    let behind_end = if along >= length { BEHIND_END } else { 0 };
    if along <= 0.0 { BEHIND_START } else { behind_end }
}

/// Behind which end of its edge a code lies, if behind any: 0 the first, 1 the second.
pub(super) fn behind(code: u32, piece: &Piece) -> Option<usize> {
    // A disc is behind its own end, seen from any side.
    let end = usize::from(if piece.length > 0.0 { code & BEHIND_START == 0 } else { piece.ends[1] });
    (code & (BEHIND_START | BEHIND_END) != 0 && piece.ends[end]).then_some(end)
}
