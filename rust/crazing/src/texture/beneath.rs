//! The nearest pieces of some pixels, number by number.

use super::finish::Row;
use super::grid::{PART, UNIT, both};
use super::lanes::Several;
use super::near::{CODES, Near};
use super::piece::Foot;

use pulp::Simd;

/// Pixels done together: a whole number of times what any processor does at a time.
pub(super) const GROUP: usize = 16;

pub(super) type Group = [f32; GROUP];

/// As many, and room to write as many from any of them on.
type Wide = [f32; 2 * GROUP];

/// For every pixel where it lies from the start of its piece, and the piece's numbers.
#[derive(Debug, Default)]
pub(super) struct Beneath {
    offset: [Wide; 2],
    along: [Wide; 2],
    length: Wide,
    radius: Wide,
    slope: Wide,
    lean: Wide,
}

impl Beneath {
    /// Looks up the pieces of the pixels of a row from the one numbered `first` on.
    #[inline(always)]
    pub(super) fn find(&mut self, row: &Row<'_>, first: usize) {
        let codes = group(&row.code[first..], row.code[first]);
        let mut places = [0; GROUP];
        for lane in 0..GROUP {
            places[lane] = codes[lane] / CODES;
        }
        // Where another piece begins to be nearest.
        let mut starts = 1_u32;
        for lane in 1..GROUP {
            starts |= u32::from(places[lane] != places[lane - 1]) << lane;
        }
        while starts != 0 {
            let lane = starts.trailing_zeros() as usize % GROUP;
            let Some(near) = row.page.near.get(places[lane] as usize) else { return self.find_far(row, first) };
            self.put(near, [first, row.y], lane);
            starts &= starts - 1;
        }
    }

    /// Takes a piece for the nearest from a pixel on; the first of them all is `at`, within the page.
    #[inline(always)]
    fn put(&mut self, near: &Near, at: [usize; 2], lane: usize) {
        let [x, y] = both(|axis| {
            let middle = at[axis] as i32 * UNIT as i32 + UNIT as i32 / 2;
            middle.wrapping_sub(near.start[axis])
        });
        let x = x.wrapping_add(lane as i32 * UNIT as i32);
        let mut dx = [0.0; GROUP];
        for (step, dx) in dx.iter_mut().enumerate() {
            *dx = x.wrapping_add(step as i32 * UNIT as i32) as f32 * PART;
        }
        set(&mut self.offset[0], lane, dx);
        set(&mut self.offset[1], lane, [y as f32 * PART; GROUP]);
        set(&mut self.along[0], lane, [near.along[0]; GROUP]);
        set(&mut self.along[1], lane, [near.along[1]; GROUP]);
        set(&mut self.length, lane, [near.length; GROUP]);
        set(&mut self.radius, lane, [near.radius; GROUP]);
        set(&mut self.slope, lane, [near.slope; GROUP]);
        set(&mut self.lean, lane, [near.lean; GROUP]);
    }

    /// The same where a piece lies too far away for [`Near`].
    #[cold]
    fn find_far(&mut self, row: &Row<'_>, first: usize) {
        for lane in 0..GROUP.min(row.width() - first) {
            let Some(piece) = row.piece(first + lane) else { continue };
            [self.offset[0][lane], self.offset[1][lane]] = row.offset(first + lane, piece);
            [self.along[0][lane], self.along[1][lane]] = piece.along;
            (self.length[lane], self.radius[lane]) = (piece.length, piece.radius);
            (self.slope[lane], self.lean[lane]) = (piece.slope, piece.lean);
        }
    }

    /// The nearest discs of the pixels from the one numbered `at` on.
    #[inline(always)]
    pub(super) fn discs<S: Simd>(&self, simd: S, at: usize) -> Discs<Several<S>> {
        let dx = Several::load(simd, &self.offset[0], at);
        let dy = Several::load(simd, &self.offset[1], at);
        let along = [Several::load(simd, &self.along[0], at), Several::load(simd, &self.along[1], at)];
        let length = Several::load(simd, &self.length, at);
        let radius = Several::load(simd, &self.radius, at);
        let slope = Several::load(simd, &self.slope, at);
        let lean = Several::load(simd, &self.lean, at);
        let foot = Foot::new(dx, dy, along, length, [radius, slope], lean);
        Discs { foot, along, length, slope, lean }
    }
}

/// The nearest discs of some pixels.
pub(super) struct Discs<N> {
    pub(super) foot: Foot<N>,
    pub(super) along: [N; 2],
    pub(super) length: N,
    pub(super) slope: N,
    pub(super) lean: N,
}

/// Writes from one of the first places on.
#[inline(always)]
fn set(out: &mut Wide, from: usize, values: Group) {
    if let Some(out) = out[from % GROUP..].first_chunk_mut() {
        *out = values;
    }
}

/// The first of some values, as many as are done together; what is missing is `pad`.
#[inline(always)]
pub(super) fn group<T: Copy>(values: &[T], pad: T) -> [T; GROUP] {
    values.first_chunk().copied().unwrap_or_else(|| {
        let mut group = [pad; GROUP];
        group[..values.len()].copy_from_slice(values);
        group
    })
}
