//! The nearest pieces of a page of pixels: candidates are left out from square to ever smaller square.
//!
//! Far from all cracks more is known of a candidate than that its distance changes no faster than the place. It is convex,
//! so that it grows at least as its slope in the middle of a square says; and that to the nearest disc of another grows by
//! no more than its own slope says and the square of the way over twice that disc's distance.

use super::grid::{PART, UNIT, both};
use super::near::{CODES, Near};
use super::nearest::{PAGE, Page, diagonal, limit};

/// Parts of a square along each side.
const PARTS: usize = 4;

/// Pixels a side of the squares that a page is cut into, and of the parts of these.
const BLOCK: usize = PAGE / PARTS;
const QUAD: usize = BLOCK / PARTS;

/// Parts of a square, and pixels of the smallest one.
const LANES: usize = PARTS * PARTS;

/// Lists this short are not worth another look.
const SHORT: usize = 2;

/// Nor these a look at slopes, nor squares nearer to a crack than so many of their sides.
const FEW: usize = 8;
const FAR: f32 = 4.0;

/// The candidates of the parts of a square.
#[derive(Debug, Default)]
struct Spread {
    lists: [Vec<u32>; LANES],
    distances: Vec<[f32; LANES]>,
    aways: Vec<Away>,
}

/// How the distance to a candidate grows, from the middle of every part: a unit vector.
type Away = [[f32; LANES]; 2];

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
        let is_far = best.iter().fold(true, |all, &best| all & (best > FAR * side as f32));
        if is_far && list.len() > FEW {
            return self.spread_far(near, list, [x, y], side, &limits);
        }
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

    /// The same far from all cracks, from distances that are known and how they grow.
    #[inline(always)]
    fn spread_far(&mut self, near: &[Near], list: &[u32], [x, y]: [i32; 2], side: usize, limits: &[f32; LANES]) {
        let step = side as i32 * UNIT as i32;
        let (mut best, mut centres, mut most) = ([f32::INFINITY; LANES], [0.0_f32; LANES], [[0.0_f32; LANES]; 2]);
        self.aways.clear();
        for (&place, distances) in list.iter().zip(&self.distances) {
            let piece = &near[place as usize];
            let (x, y) = (x.wrapping_sub(piece.start[0]), y.wrapping_sub(piece.start[1]));
            let mut away = [[0.0_f32; LANES]; 2];
            for lane in 0..LANES {
                let dx = (x + (lane % PARTS) as i32 * step) as f32 * PART;
                let dy = (y + (lane / PARTS) as i32 * step) as f32 * PART;
                let (centre, [right, down]) = piece.away(dx, dy);
                (away[0][lane], away[1][lane]) = (right, down);
                let nearer = distances[lane] < best[lane];
                best[lane] = if nearer { distances[lane] } else { best[lane] };
                centres[lane] = if nearer { centre } else { centres[lane] };
                most[0][lane] = if nearer { right } else { most[0][lane] };
                most[1][lane] = if nearer { down } else { most[1][lane] };
            }
            self.aways.push(away);
        }
        let radius = diagonal(side) / 2.0;
        let mut bulges = [0.0_f32; LANES];
        for lane in 0..LANES {
            bulges[lane] = best[lane] + radius * radius / (2.0 * centres[lane]) + slack(best[lane]);
        }
        for ((&place, distances), away) in list.iter().zip(&self.distances).zip(&self.aways) {
            let mut kept = 0_u32;
            for lane in 0..LANES {
                let [right, down] = [0, 1].map(|axis| away[axis][lane] - most[axis][lane]);
                let over = distances[lane] - bulges[lane];
                let is_over = over > 0.0 && over * over > radius * radius * (right * right + down * down);
                kept |= u32::from(distances[lane] <= limits[lane] && !is_over) << lane;
            }
            while kept != 0 {
                self.lists[kept.trailing_zeros() as usize % LANES].push(place);
                kept &= kept - 1;
            }
        }
    }
}

/// What rounding may have added to the difference of two distances, or of their slopes over a page.
#[inline(always)]
fn slack(distance: f32) -> f32 {
    0.02 + 2e-5 * distance.abs()
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
