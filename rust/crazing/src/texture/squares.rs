//! The nearest pieces of a page of pixels: candidates are left out from square to ever smaller square.

use super::grid::{PART, UNIT, both};
use super::near::{CODES, Near};
use super::nearest::{PAGE, Page, limit};

/// Parts of a square along each side.
const PARTS: usize = 4;

/// Pixels a side of the squares that a page is cut into, and of the parts of these.
const BLOCK: usize = PAGE / PARTS;
const QUAD: usize = BLOCK / PARTS;

/// Parts of a square, and pixels of the smallest one.
const LANES: usize = PARTS * PARTS;

/// Lists this short are not worth another look.
const SHORT: usize = 2;

/// The candidates of the parts of a square.
#[derive(Debug, Default)]
struct Spread {
    lists: [Vec<u32>; LANES],
    distances: Vec<[f32; LANES]>,
}

/// The candidates of the parts of a page, and of their parts.
#[derive(Debug, Default)]
pub(super) struct Squares {
    all: Vec<u32>,
    blocks: Spread,
    quads: Spread,
}

impl Squares {
    /// Solves the first `size` pixels of a page, across and down, as far as they are nearer to the crack than `reach`.
    #[inline(always)]
    pub(super) fn solve(&mut self, page: &mut Page, size: [usize; 2], reach: f32) {
        let Self { all, blocks, quads } = self;
        all.clear();
        all.extend(0..page.near.len() as u32);
        if all.len() > SHORT {
            blocks.spread(&page.near, all, [0; 2], BLOCK, reach);
        }
        for (nth, list) in blocks.lists.iter().enumerate() {
            let corner = [nth % PARTS * BLOCK, nth / PARTS * BLOCK];
            if corner[0] >= size[0] || corner[1] >= size[1] {
                continue;
            }
            let list = if all.len() > SHORT { list } else { &*all };
            if let [place] = list[..] {
                alone(place, page, corner);
                continue;
            }
            if list.len() > SHORT {
                quads.spread(&page.near, list, corner, QUAD, reach);
            }
            for (nth, quad) in quads.lists.iter().enumerate() {
                let list = if list.len() > SHORT { quad } else { list };
                solve(list, page, [corner[0] + nth % PARTS * QUAD, corner[1] + nth / PARTS * QUAD]);
            }
        }
    }
}

impl Spread {
    /// Lists for every part of a square, `side` pixels wide each, which candidates may be nearest in it.
    #[inline(always)]
    fn spread(&mut self, near: &[Near], list: &[u32], corner: [usize; 2], side: usize, reach: f32) {
        let step = side as i32 * UNIT as i32;
        let [x, y] = both(|axis| corner[axis] as i32 * UNIT as i32 + step / 2);
        let mut best = [f32::INFINITY; LANES];
        self.distances.clear();
        for &place in list {
            let piece = &near[place as usize];
            let (x, y) = (x.wrapping_sub(piece.start[0]), y.wrapping_sub(piece.start[1]));
            let mut distances = [0.0_f32; LANES];
            for lane in 0..LANES {
                let dx = (x + (lane % PARTS) as i32 * step) as f32 * PART;
                let dy = (y + (lane / PARTS) as i32 * step) as f32 * PART;
                distances[lane] = piece.measure(dx, dy).0;
                best[lane] = if distances[lane] < best[lane] { distances[lane] } else { best[lane] };
            }
            self.distances.push(distances);
        }
        let mut limits = [0.0_f32; LANES];
        for lane in 0..LANES {
            limits[lane] = limit(best[lane], side, reach);
        }
        self.lists.iter_mut().for_each(Vec::clear);
        for (&place, distances) in list.iter().zip(&self.distances) {
            let mut kept = 0_u32;
            for lane in 0..LANES {
                kept |= u32::from(distances[lane] <= limits[lane]) << lane;
            }
            while kept != 0 {
                self.lists[kept.trailing_zeros() as usize % LANES].push(place);
                kept &= kept - 1;
            }
        }
    }
}

/// A square of a page in which one piece is the nearest everywhere.
#[inline(always)]
fn alone(place: u32, page: &mut Page, corner: [usize; 2]) {
    let piece = page.near[place as usize];
    let [x, y] = both(|axis| corner[axis] as i32 * UNIT as i32 + UNIT as i32 / 2);
    let (x, y) = (x.wrapping_sub(piece.start[0]), y.wrapping_sub(piece.start[1]));
    for row in 0..BLOCK {
        let (dy, at) = ((y + row as i32 * UNIT as i32) as f32 * PART, (corner[1] + row) * PAGE + corner[0]);
        let (mut distances, mut codes) = ([0.0_f32; BLOCK], [0_u32; BLOCK]);
        for lane in 0..BLOCK {
            let (distance, code) = piece.measure((x + lane as i32 * UNIT as i32) as f32 * PART, dy);
            (distances[lane], codes[lane]) = (distance, CODES * place + code);
        }
        put(&mut page.distance[at..], &distances);
        put(&mut page.code[at..], &codes);
    }
}

/// The nearest of some pieces for 4 x 4 pixels; of equally near ones the first.
#[inline(always)]
fn solve(list: &[u32], page: &mut Page, corner: [usize; 2]) {
    let mut best = [f32::INFINITY; LANES];
    let mut code = [0_u32; LANES];
    let [x, y] = both(|axis| corner[axis] as i32 * UNIT as i32 + UNIT as i32 / 2);
    for &place in list {
        let piece = &page.near[place as usize];
        let (x, y) = (x.wrapping_sub(piece.start[0]), y.wrapping_sub(piece.start[1]));
        let (mut distances, mut codes) = ([0.0_f32; LANES], [0_u32; LANES]);
        for lane in 0..LANES {
            let dx = (x + (lane % QUAD) as i32 * UNIT as i32) as f32 * PART;
            let dy = (y + (lane / QUAD) as i32 * UNIT as i32) as f32 * PART;
            (distances[lane], codes[lane]) = piece.measure(dx, dy);
        }
        // Without a branch, so that several lanes are done at a time.
        for lane in 0..LANES {
            let nearer = 0_u32.wrapping_sub(u32::from(distances[lane] < best[lane]));
            code[lane] ^= (code[lane] ^ (CODES * place + codes[lane])) & nearer;
            best[lane] = f32::from_bits((distances[lane].to_bits() & nearer) | (best[lane].to_bits() & !nearer));
        }
    }
    for row in 0..QUAD {
        let at = (corner[1] + row) * PAGE + corner[0];
        put(&mut page.distance[at..], &best.as_chunks::<QUAD>().0[row]);
        put(&mut page.code[at..], &code.as_chunks::<QUAD>().0[row]);
    }
}

/// Writes to the beginning of a stretch. Copying slices is a call, which takes longer than so few numbers do.
#[inline(always)]
fn put<T: Copy, const N: usize>(out: &mut [T], values: &[T; N]) {
    if let Some(out) = out.first_chunk_mut() {
        *out = *values;
    }
}
