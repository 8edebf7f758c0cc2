//! For every pixel of a square the nearest piece: a search over bins, then over ever smaller squares.
//!
//! A distance changes by at most as much as the place it is measured at. So pieces whose distance at the middle of a
//! square exceeds the least one there by the square's diagonal are nearest nowhere in it. What is left out this way
//! could not have changed a pixel: the result depends neither on the squares nor on the bins.

use super::bins::Bins;
use super::grid::{PART, UNIT};
use super::piece::Piece;

/// Pixels a side of the smallest square.
pub(super) const QUAD: usize = 4;

/// Pixels of the smallest square.
const LANES: usize = QUAD * QUAD;

/// Pixels a side of the largest square whose results are kept at a time.
pub(super) const PAGE: usize = 64;

/// Lists this short are not worth another look.
const SHORT: usize = 2;

/// What a distance computed in `f32` may be off, in pixels and as a part of itself.
const SLACK: (f32, f32) = (2e-3, 4e-6);

/// Parts of a pixel from a corner to which [`Near`] counts; with a page more they still fit.
const NEAR: i64 = (1 << 31) - (PAGE as i64 + 1) * UNIT;

/// Pieces, and the bins they lie in.
#[derive(Debug)]
pub(super) struct Set {
    /// In the order of their edges.
    pub(super) pieces: Vec<Piece>,
    pub(super) bins: Bins,
    /// Whether nothing lies outside the bins, or nothing that is nearer than what lies inside.
    pub(super) whole: bool,
}

/// A piece seen from a corner near by, in parts of a pixel.
#[derive(Debug, Clone, Copy)]
struct Near {
    start: [i32; 2],
    along: [f32; 2],
    length: f32,
    radius: f32,
    slope: f32,
    lean: f32,
}

/// Nearest pieces of a page of pixels.
#[derive(Debug)]
pub(super) struct Page {
    /// Rows of [`PAGE`] pixels: signed distance, pixels.
    pub(super) distance: Vec<f32>,
    /// Twice the place of the nearest piece in `ids`, plus one where the pixel lies to its right.
    pub(super) code: Vec<u32>,
    /// The pieces that were candidates.
    pub(super) ids: Vec<u32>,
}

/// Buffers of one thread.
#[derive(Debug)]
pub(super) struct Search {
    pub(super) page: Page,
    /// The last square for which a piece was looked at.
    stamps: Vec<u32>,
    stamp: u32,
    near: Vec<Near>,
    /// What was found in the bins: pieces and their distance from the middle.
    found: Vec<(u32, f32)>,
    /// The four lists of every level of squares.
    levels: Vec<[Vec<u32>; 4]>,
    distances: Vec<[f32; 4]>,
}

/// How the search over bins ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Found {
    /// Every pixel of the square is at least this far from the crack, in pixels.
    AtLeast(f32),
    /// The region of the bins is too small to tell.
    TooFar,
}

impl Search {
    /// Empty buffers.
    pub(super) fn new() -> Self {
        let page = Page { distance: vec![0.0; PAGE * PAGE], code: vec![0; PAGE * PAGE], ids: Vec::new() };
        let (near, found, levels, distances) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        Self { page, stamps: Vec::new(), stamp: 0, near, found, levels, distances }
    }

    /// Finds the pieces that may be nearest in the square of `side` pixels whose top left pixel is given.
    pub(super) fn open(&mut self, set: &Set, corner: [i64; 2], side: usize) -> Found {
        let Set { pieces, bins, whole } = set;
        self.stamps.resize(pieces.len().max(self.stamps.len()), 0);
        self.stamp += 1;
        self.found.clear();
        let corner = corner.map(|pixel| pixel * UNIT);
        let [x, y] = corner.map(|part| part + side as i64 * UNIT / 2);
        let of = bins.of(corner, side as i64);
        let (mut best, mut ring) = (f32::INFINITY, 0);
        loop {
            bins.ring(of, ring, |ids| {
                for &id in ids {
                    let stamp = &mut self.stamps[id as usize];
                    if *stamp != self.stamp {
                        *stamp = self.stamp;
                        let distance = pieces[id as usize].distance(x, y);
                        best = if distance < best { distance } else { best };
                        self.found.push((id, distance));
                    }
                }
            });
            // The bins looked at so far reach at least this far from the middle.
            let reach = (ring * bins.side + side as i64 / 2) as f32;
            if reach >= widened(best + diagonal(side)) {
                break;
            }
            ring += 1;
            if !whole && !bins.holds_ring(of, ring) {
                return Found::TooFar;
            }
            if !bins.meets_ring(of, ring) {
                break;
            }
        }
        let limit = widened(best + diagonal(side));
        self.page.ids.clear();
        self.page.ids.extend(self.found.iter().filter(|&&(_, distance)| distance <= limit).map(|&(id, _)| id));
        self.page.ids.sort_unstable();
        Found::AtLeast(best - diagonal(side) / 2.0)
    }

    /// Fills the page with the nearest pieces of the square that was opened last.
    pub(super) fn fill(&mut self, set: &Set, corner: [i64; 2], side: usize) {
        let pieces = &set.pieces;
        let [x, y] = corner.map(|pixel| pixel * UNIT);
        let fits = |&id: &u32| {
            let [a, b] = pieces[id as usize].start;
            (a - x).abs().max((b - y).abs()) < NEAR
        };
        if !self.page.ids.iter().all(fits) {
            return self.fill_far(pieces, [x, y], side);
        }
        self.near.clear();
        self.near.extend(self.page.ids.iter().map(|&id| Near::new(&pieces[id as usize], x, y)));
        let list: Vec<u32> = (0..self.near.len() as u32).collect();
        self.divide(&list, 0, [0, 0], side);
    }

    /// The same for candidates too far for the numbers of [`Near`]: every one for every pixel.
    fn fill_far(&mut self, pieces: &[Piece], corner: [i64; 2], side: usize) {
        for (row, column) in (0..side * side).map(|pixel| (pixel / side, pixel % side)) {
            let [x, y] = [(corner[0], column), (corner[1], row)].map(|(at, by)| at + by as i64 * UNIT + UNIT / 2);
            let (mut best, mut code) = (f32::INFINITY, 0);
            for (place, &id) in (0..).zip(&self.page.ids) {
                let piece = &pieces[id as usize];
                let [dx, dy] = piece.offset(x, y);
                let foot = piece.foot(dx, dy);
                if foot.distance < best {
                    (best, code) = (foot.distance, (2 * place) | (foot.side.to_bits() >> 31));
                }
            }
            self.page.distance[row * PAGE + column] = best;
            self.page.code[row * PAGE + column] = code;
        }
    }

    /// Solves a square with its candidates, in four parts where that spares work.
    fn divide(&mut self, list: &[u32], level: usize, corner: [usize; 2], side: usize) {
        if side == QUAD || list.len() <= SHORT {
            for y in (0..side).step_by(QUAD) {
                for x in (0..side).step_by(QUAD) {
                    solve(&self.near, list, &mut self.page, [corner[0] + x, corner[1] + y]);
                }
            }
            return;
        }
        if self.levels.len() <= level {
            self.levels.resize_with(level + 1, Default::default);
        }
        let mut parts = std::mem::take(&mut self.levels[level]);
        self.narrow(list, &mut parts, corner, side / 2);
        for (part, list) in parts.iter().enumerate() {
            self.divide(list, level + 1, [corner[0] + part % 2 * side / 2, corner[1] + part / 2 * side / 2], side / 2);
        }
        self.levels[level] = parts;
    }

    /// For each of the four squares of `side` pixels at a corner, those candidates that may be nearest in it.
    fn narrow(&mut self, list: &[u32], parts: &mut [Vec<u32>; 4], corner: [usize; 2], side: usize) {
        let step = (side as i64 * UNIT) as i32;
        let [x, y] = corner.map(|pixel| (pixel as i64 * UNIT) as i32 + step / 2);
        let mut best = [f32::INFINITY; 4];
        self.distances.clear();
        for &place in list {
            let piece = &self.near[place as usize];
            let (x, y) = (x - piece.start[0], y - piece.start[1]);
            let (dx, dy) = ([x, x + step, x, x + step], [y, y, y + step, y + step]);
            let mut distances = [0.0; 4];
            for part in 0..4 {
                distances[part] = piece.measure(dx[part] as f32 * PART, dy[part] as f32 * PART).0;
                best[part] = if distances[part] < best[part] { distances[part] } else { best[part] };
            }
            self.distances.push(distances);
        }
        let limits = best.map(|best| widened(best + diagonal(side)));
        for (part, kept) in parts.iter_mut().enumerate() {
            kept.resize(list.len(), 0);
            let mut count = 0;
            for (&place, distances) in list.iter().zip(&self.distances) {
                kept[count] = place;
                count += usize::from(distances[part] <= limits[part]);
            }
            kept.truncate(count);
        }
    }
}

/// Between the middles of the outermost pixels of a square, corner to corner.
fn diagonal(side: usize) -> f32 {
    (side - 1) as f32 * std::f32::consts::SQRT_2
}

/// A distance with what rounding may have taken from it.
fn widened(distance: f32) -> f32 {
    distance + SLACK.0 + SLACK.1 * distance.abs()
}

impl Near {
    fn new(piece: &Piece, x: i64, y: i64) -> Self {
        let Piece { start, along, length, radius, slope, lean, .. } = *piece;
        Self { start: [(start[0] - x) as i32, (start[1] - y) as i32], along, length, radius, slope, lean }
    }

    /// Signed distance, and to which side. The same sum as [`Piece::foot`], of which only this is wanted here.
    #[inline(always)]
    fn measure(&self, dx: f32, dy: f32) -> (f32, f32) {
        let [u, v] = self.along;
        let t = dx * u + dy * v;
        let side = dx * v - dy * u;
        let n = side.abs();
        let s = t + self.lean * n;
        let s = if s < 0.0 { 0.0 } else { s };
        let s = if s > self.length { self.length } else { s };
        let ahead = t - s;
        ((ahead * ahead + n * n).sqrt() - (self.radius + self.slope * s), side)
    }
}

/// The nearest of some pieces for 4 x 4 pixels; of equally near ones the first.
fn solve(near: &[Near], list: &[u32], page: &mut Page, corner: [usize; 2]) {
    let mut best = [f32::INFINITY; LANES];
    let mut code = [0_u32; LANES];
    let [x, y] = corner.map(|pixel| pixel as i32 * UNIT as i32 + UNIT as i32 / 2);
    for &place in list {
        let piece = &near[place as usize];
        let (x, y) = (x.wrapping_sub(piece.start[0]), y.wrapping_sub(piece.start[1]));
        let (mut distances, mut sides) = ([0.0_f32; LANES], [0_u32; LANES]);
        for lane in 0..LANES {
            let dx = (x + (lane % QUAD) as i32 * UNIT as i32) as f32 * PART;
            let dy = (y + (lane / QUAD) as i32 * UNIT as i32) as f32 * PART;
            let (distance, side) = piece.measure(dx, dy);
            (distances[lane], sides[lane]) = (distance, side.to_bits() >> 31);
        }
        // Without a branch, so that four lanes are done at a time.
        for lane in 0..LANES {
            let nearer = 0_u32.wrapping_sub(u32::from(distances[lane] < best[lane]));
            code[lane] ^= (code[lane] ^ ((2 * place) | sides[lane])) & nearer;
            best[lane] = f32::from_bits((distances[lane].to_bits() & nearer) | (best[lane].to_bits() & !nearer));
        }
    }
    for row in 0..QUAD {
        let at = (corner[1] + row) * PAGE + corner[0];
        page.distance[at..at + QUAD].copy_from_slice(&best[row * QUAD..][..QUAD]);
        page.code[at..at + QUAD].copy_from_slice(&code[row * QUAD..][..QUAD]);
    }
}
