//! For every pixel of a square the nearest piece: a search over bins, then over ever smaller squares.
//!
//! A distance changes by at most as much as the place it is measured at. So pieces whose distance at the middle of a
//! square exceeds the least one there by the square's diagonal are nearest nowhere in it. What is left out this way
//! could not have changed a pixel: the result depends neither on the squares nor on the bins.

use super::bins::Bins;
use super::grid::{UNIT, both};
use super::near::{CODES, Near, beside};
use super::piece::Piece;
use super::squares::Squares;

/// Pixels a side of the square whose results are kept at a time.
pub(super) const PAGE: usize = 64;

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
    /// The radius of the widest disc of any.
    pub(super) widest: f32,
}

/// Nearest pieces of a page of pixels.
#[derive(Debug)]
pub(super) struct Page {
    /// Which of the scene's sets they are of.
    pub(super) level: usize,
    /// Rows of [`PAGE`] pixels: signed distance, pixels.
    pub(super) distance: Vec<f32>,
    /// [`CODES`] times the place of the nearest piece in `ids`, and where the pixel lies beside it.
    pub(super) code: Vec<u32>,
    /// The pieces that were candidates.
    pub(super) ids: Vec<u32>,
    /// The same as seen from the page's corner; none where one of them is too far away for that.
    pub(super) near: Vec<Near>,
}

/// Buffers of one thread.
#[derive(Debug)]
pub(super) struct Search {
    /// The last square for which a piece was looked at.
    stamps: Vec<u32>,
    stamp: u32,
    /// What was found in the bins: pieces and their distance from the middle.
    found: Vec<(u32, f32)>,
    squares: Squares,
}

impl Search {
    /// Empty buffers.
    pub(super) fn new() -> Self {
        Self { stamps: Vec::new(), stamp: 0, found: Vec::new(), squares: Squares::default() }
    }

    /// Finds the pieces that may be nearest in the page whose top left pixel is given, for pixels
    /// nearer to the crack than `reach`; false if the region of the bins is too small to tell.
    pub(super) fn open(&mut self, page: &mut Page, set: &Set, corner: [i64; 2], reach: f32) -> bool {
        let Set { pieces, bins, whole, .. } = set;
        self.stamps.resize(pieces.len().max(self.stamps.len()), 0);
        self.stamp += 1;
        self.found.clear();
        let corner = both(|axis| corner[axis] * UNIT);
        let [x, y] = both(|axis| corner[axis] + PAGE as i64 * UNIT / 2);
        let of = bins.of(corner, PAGE as i64);
        let farthest = bins.farthest(of, pieces);
        if farthest < f32::INFINITY {
            return self.collect(page, set, of, if farthest < reach { farthest } else { reach });
        }
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
            // The bins looked at so far go at least this far from the middle.
            if (ring * bins.side + PAGE as i64 / 2) as f32 >= limit(best, PAGE, reach) {
                break;
            }
            ring += 1;
            if !whole && !bins.holds_ring(of, ring) {
                return false;
            }
            if !bins.meets_ring(of, ring) {
                break;
            }
        }
        let limit = limit(best, PAGE, reach);
        page.ids.clear();
        page.ids.extend(self.found.iter().filter(|&&(_, distance)| distance <= limit).map(|&(id, _)| id));
        page.ids.sort_unstable();
        true
    }

    /// Takes all pieces from the bins of a page and as many rings around them as may hold what is nearer than
    /// `farthest` to one of its pixels; false if the region of the bins is too small for that.
    fn collect(&mut self, page: &mut Page, set: &Set, of: [i64; 4], farthest: f32) -> bool {
        let Set { bins, whole, .. } = set;
        let (mut ring, farthest) = (0, widened(farthest));
        let Self { stamps, stamp, .. } = self;
        page.ids.clear();
        loop {
            bins.ring(of, ring, |ids| {
                for &id in ids {
                    if stamps[id as usize] != *stamp {
                        stamps[id as usize] = *stamp;
                        page.ids.push(id);
                    }
                }
            });
            if (ring * bins.side) as f32 >= farthest {
                break;
            }
            ring += 1;
            if !whole && !bins.holds_ring(of, ring) {
                return false;
            }
            if !bins.meets_ring(of, ring) {
                break;
            }
        }
        page.ids.sort_unstable();
        true
    }

    /// Fills the first `size` pixels of a page, across and down, with the nearest of the pieces it was opened for.
    #[inline(always)]
    pub(super) fn fill(&mut self, page: &mut Page, set: &Set, corner: [i64; 2], size: [usize; 2], reach: f32) {
        let [x, y] = both(|axis| corner[axis] * UNIT);
        page.near.clear();
        if page.see(&set.pieces, [x, y]) {
            self.squares.solve(page, size, reach);
        } else {
            page.fill_far(&set.pieces, [x, y], size);
        }
    }
}

impl Page {
    pub(super) fn new() -> Self {
        let (distance, code) = (vec![0.0; PAGE * PAGE], vec![0; PAGE * PAGE]);
        Self { level: 0, distance, code, ids: Vec::new(), near: Vec::new() }
    }

    /// Looks at the candidates from a corner; false if one is too far away.
    fn see(&mut self, pieces: &[Piece], [x, y]: [i64; 2]) -> bool {
        let fits = |&id: &u32| {
            let [a, b] = pieces[id as usize].start;
            (a - x).abs().max((b - y).abs()) < NEAR
        };
        let all = self.ids.iter().all(fits);
        if all {
            self.near.extend(self.ids.iter().map(|&id| Near::new(&pieces[id as usize], x, y)));
        }
        all
    }

    /// Fills the page from candidates too far for the numbers of [`Near`]: every one for every pixel.
    fn fill_far(&mut self, pieces: &[Piece], corner: [i64; 2], [width, height]: [usize; 2]) {
        for (row, column) in (0..width * height).map(|pixel| (pixel / width, pixel % width)) {
            let [x, y] = [(corner[0], column), (corner[1], row)].map(|(at, by)| at + by as i64 * UNIT + UNIT / 2);
            let (mut best, mut code) = (f32::INFINITY, 0);
            for (place, &id) in (0..).zip(&self.ids) {
                let piece = &pieces[id as usize];
                let [dx, dy] = piece.offset(x, y);
                let foot = piece.foot(dx, dy);
                if foot.distance < best {
                    let side = foot.side.to_bits() >> 31;
                    (best, code) = (foot.distance, CODES * place + beside(foot.raw, piece.length) + side);
                }
            }
            self.distance[row * PAGE + column] = best;
            self.code[row * PAGE + column] = code;
        }
    }
}

/// Between the middles of the outermost pixels of a square, corner to corner.
pub(super) fn diagonal(side: usize) -> f32 {
    (side - 1) as f32 * std::f32::consts::SQRT_2
}

/// How far from the middle of a square a piece may be if it is nearest to a pixel that is nearer to it than `reach`.
#[inline(always)]
pub(super) fn limit(best: f32, side: usize, reach: f32) -> f32 {
    let (first, second) = (best + diagonal(side), reach + diagonal(side) / 2.0);
    widened(if first < second { first } else { second })
}

/// A distance with what rounding may have taken from it.
fn widened(distance: f32) -> f32 {
    distance + SLACK.0 + SLACK.1 * distance.abs()
}
