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
    /// Candidates of each level of squares: places in `near`.
    lists: Vec<Vec<u32>>,
    distances: Vec<f32>,
    near: Vec<Near>,
    chosen: Vec<(u32, f32)>,
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
        let (lists, distances, near, chosen) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        Self { page, stamps: Vec::new(), stamp: 0, lists, distances, near, chosen }
    }

    /// Finds the pieces that may be nearest in the square of `side` pixels whose top left pixel is given.
    ///
    /// The square must lie within one bin.
    pub(super) fn open(&mut self, set: &Set, corner: [i64; 2], side: usize) -> Found {
        let Set { pieces, bins, whole } = set;
        self.stamps.resize(pieces.len().max(self.stamps.len()), 0);
        let [x, y] = corner.map(|pixel| pixel * UNIT + side as i64 * UNIT / 2);
        let diagonal = diagonal(side);
        let bin = bins.at(x, y);
        self.stamp += 1;
        self.chosen.clear();
        let (mut best, mut ring) = (f32::INFINITY, 0);
        loop {
            bins.ring(bin, ring, |ids| {
                for &id in ids {
                    if self.stamps[id as usize] != self.stamp {
                        self.stamps[id as usize] = self.stamp;
                        let distance = pieces[id as usize].distance(x, y);
                        best = if distance < best { distance } else { best };
                        self.chosen.push((id, distance));
                    }
                }
            });
            // The square lies in one bin, so the bins looked at so far reach at least this far from its middle.
            let reach = (ring * bins.side + side as i64 / 2) as f32;
            if reach >= widened(best + diagonal) {
                break;
            }
            ring += 1;
            if !whole && !bins.holds_ring(bin, ring) {
                return Found::TooFar;
            }
            if !bins.meets_ring(bin, ring) {
                break;
            }
        }
        let limit = widened(best + diagonal);
        self.chosen.retain(|&(_, distance)| distance <= limit);
        self.chosen.sort_unstable_by_key(|&(id, _)| id);
        Found::AtLeast(best - diagonal / 2.0)
    }

    /// Fills the page with the nearest pieces of the square that was opened last.
    pub(super) fn fill(&mut self, set: &Set, corner: [i64; 2], side: usize) {
        let pieces = &set.pieces;
        let [x, y] = corner.map(|pixel| pixel * UNIT);
        self.page.ids.clear();
        let fits = |&(id, _): &(u32, f32)| {
            let [a, b] = pieces[id as usize].start;
            (a - x).abs().max((b - y).abs()) < NEAR
        };
        if !self.chosen.iter().all(fits) {
            return self.fill_far(pieces, [x, y], side);
        }
        self.near.clear();
        let mut list = std::mem::take(self.level(0));
        list.clear();
        for (place, &(id, _)) in self.chosen.iter().enumerate() {
            let piece = &pieces[id as usize];
            self.page.ids.push(id);
            self.near.push(Near::new(piece, x, y));
            list.push(place as u32);
        }
        self.lists[0] = list;
        self.divide(0, [0, 0], side);
    }

    /// The same for candidates too far for the numbers of [`Near`]: every one for every pixel.
    fn fill_far(&mut self, pieces: &[Piece], corner: [i64; 2], side: usize) {
        self.page.ids.extend(self.chosen.iter().map(|&(id, _)| id));
        for (row, column) in (0..side * side).map(|pixel| (pixel / side, pixel % side)) {
            let [x, y] = [(corner[0], column), (corner[1], row)].map(|(at, by)| at + by as i64 * UNIT + UNIT / 2);
            let (mut best, mut code) = (f32::INFINITY, 0);
            for (place, &(id, _)) in (0..).zip(&self.chosen) {
                let piece = &pieces[id as usize];
                let [dx, dy] = piece.from_start(x, y);
                let foot = piece.foot(dx, dy);
                if foot.distance < best {
                    (best, code) = (foot.distance, 2 * place | (foot.side.to_bits() >> 31));
                }
            }
            self.page.distance[row * PAGE + column] = best;
            self.page.code[row * PAGE + column] = code;
        }
    }

    fn level(&mut self, level: usize) -> &mut Vec<u32> {
        if self.lists.len() <= level {
            self.lists.resize_with(level + 1, Vec::new);
        }
        &mut self.lists[level]
    }

    /// Solves the square with the candidates of its level.
    fn divide(&mut self, level: usize, corner: [usize; 2], side: usize) {
        if side == QUAD {
            return solve(&self.near, &self.lists[level], &mut self.page, corner);
        }
        let half = side / 2;
        for [i, j] in [[0, 0], [1, 0], [0, 1], [1, 1]] {
            let corner = [corner[0] + i * half, corner[1] + j * half];
            self.narrow(level, corner, half);
            self.divide(level + 1, corner, half);
        }
    }

    /// Keeps those candidates that may be nearest somewhere in a smaller square.
    fn narrow(&mut self, level: usize, corner: [usize; 2], side: usize) {
        self.level(level + 1);
        let (above, below) = self.lists.split_at_mut(level + 1);
        let (list, kept) = (&above[level], &mut below[0]);
        kept.clear();
        if list.len() <= SHORT {
            return kept.extend_from_slice(list);
        }
        let half = (side as i32 * UNIT as i32) / 2;
        let [x, y] = corner.map(|pixel| pixel as i32 * UNIT as i32 + half);
        self.distances.clear();
        let mut best = f32::INFINITY;
        for &place in list {
            let distance = self.near[place as usize].distance(x, y);
            best = if distance < best { distance } else { best };
            self.distances.push(distance);
        }
        let limit = widened(best + diagonal(side));
        kept.extend(
            list.iter().zip(&self.distances).filter(|&(_, &distance)| distance <= limit).map(|(&place, _)| place),
        );
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

    #[inline(always)]
    fn distance(&self, x: i32, y: i32) -> f32 {
        self.measure((x - self.start[0]) as f32 * PART, (y - self.start[1]) as f32 * PART).0
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
        for lane in 0..LANES {
            let dx = (x + (lane % QUAD) as i32 * UNIT as i32) as f32 * PART;
            let dy = (y + (lane / QUAD) as i32 * UNIT as i32) as f32 * PART;
            let (distance, side) = piece.measure(dx, dy);
            let here = 2 * place | (side.to_bits() >> 31);
            let nearer = distance < best[lane];
            best[lane] = if nearer { distance } else { best[lane] };
            code[lane] = if nearer { here } else { code[lane] };
        }
    }
    for row in 0..QUAD {
        let at = (corner[1] + row) * PAGE + corner[0];
        page.distance[at..at + QUAD].copy_from_slice(&best[row * QUAD..][..QUAD]);
        page.code[at..at + QUAD].copy_from_slice(&code[row * QUAD..][..QUAD]);
    }
}
