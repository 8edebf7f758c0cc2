//! The order of insertion: rounds that grow fourfold (Amenta, Choi, Rote 2003), each along a Hilbert curve.
//!
//! Points of a curve in sorted order are the worst case of incremental insertion (quadratic); in rounds the expected
//! cost is O(n log n) whatever the input. Every round comes by all of the memory once: rounds that double come by half
//! as much again as these, and a million points take a third longer. Rounds are drawn by a hash of the coordinates, so
//! the order depends on the set of points only, not on their numbering.

use super::hilbert::curve_position;
use super::radix;
use super::scale::largest;
use crate::graph::Point;
use crate::parallel;

/// Runs of one key no longer than this are put in order by comparing coordinates.
const SHORT: usize = 8;

/// Rows of distinct `points` in the order of insertion.
pub fn insertion(points: &[Point]) -> Vec<u32> {
    let curve = hilbert(points);
    let along: Vec<Point> = curve.iter().map(|&row| points[row as usize]).collect();
    rounds(&along).order.into_iter().map(|i| curve[i as usize]).collect()
}

/// Rows along a Hilbert curve; equal points stand together, the first row of them first.
pub(crate) fn hilbert(points: &[Point]) -> Vec<u32> {
    let mut rows: Vec<u32> = (0..points.len() as u32).collect();
    // A point far away makes all others share one cell: runs of one cell get a curve of their own.
    let mut todo = vec![(0, rows.len())];
    while let Some((start, end)) = todo.pop() {
        let run = &mut rows[start..end];
        if run.len() <= SHORT {
            run.sort_unstable_by(|&a, &b| compare(points, a, b));
        } else if let Some(square) = Square::around(points, run) {
            todo.extend(along_curve(points, run, square).into_iter().map(|(a, b)| (start + a, start + b)));
        } else {
            run.sort_unstable();
        }
    }
    rows
}

fn compare(points: &[Point], a: u32, b: u32) -> std::cmp::Ordering {
    let (p, q) = (points[a as usize], points[b as usize]);
    p[0].total_cmp(&q[0]).then(p[1].total_cmp(&q[1])).then(a.cmp(&b))
}

/// Sorts `run` by cell, and returns the ranges of it that share a cell.
fn along_curve(points: &[Point], run: &mut [u32], square: Square) -> Vec<(usize, usize)> {
    let rows: &[u32] = run;
    let keys =
        parallel::map(rows.len(), |i| (u64::from(square.key(points[rows[i] as usize])) << 32) | u64::from(rows[i]));
    // Rows of one cell stay in their order.
    let keys = radix::by_upper_half(keys);
    for (row, key) in run.iter_mut().zip(&keys) {
        *row = *key as u32;
    }
    let mut shared = Vec::new();
    let mut start = 0;
    for end in 1..=keys.len() {
        if end == keys.len() || keys[end] >> 32 != keys[start] >> 32 {
            if end - start > 1 {
                shared.push((start, end));
            }
            start = end;
        }
    }
    shared
}

/// The square a Hilbert curve of 2^32 cells is laid over.
#[derive(Clone, Copy)]
struct Square {
    corner: Point,
    scale: f64,
}

impl Square {
    /// None when the points coincide.
    fn around(points: &[Point], run: &[u32]) -> Option<Self> {
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for p in run.iter().map(|&row| points[row as usize]) {
            low = [low[0].min(p[0]), low[1].min(p[1])];
            high = [high[0].max(p[0]), high[1].max(p[1])];
        }
        let side = (high[0] - low[0]).max(high[1] - low[1]);
        // Dividing by the side, not multiplying by its inverse: the far corner must reach the last cell.
        (side > 0.0).then_some(Self { corner: low, scale: side })
    }

    /// Position along the curve of the cell that holds `p`.
    fn key(&self, p: Point) -> u32 {
        let cell = |x: f64, low: f64| ((x - low) / self.scale * 65535.0) as u32;
        curve_position(cell(p[0], self.corner[0]), cell(p[1], self.corner[1]))
    }
}

/// Round of a point: 0 with probability 3/4, 1 with 3/16, ...; later rounds are inserted first.
fn round(p: Point) -> usize {
    // SplitMix64's finaliser over both coordinates.
    let mut hash = p[0].to_bits() ^ p[1].to_bits().rotate_left(32).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    hash = (hash ^ (hash >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    hash = (hash ^ (hash >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    (hash ^ (hash >> 31)).trailing_zeros() as usize / 2
}

/// In which order to insert points that follow a curve.
pub(super) struct Rounds {
    /// Rows in the order of insertion.
    pub(super) order: Vec<u32>,
    /// For each row one that is close on the curve and inserted earlier: the place to start looking from.
    pub(super) near: Vec<u32>,
}

/// Sorts rows by round, and along the curve within each.
pub(super) fn rounds(points: &[Point]) -> Rounds {
    // In units of the largest coordinate's power of two, so that scaling by one changes no round.
    let largest = largest(points);
    let unit = if largest > 0.0 { libm::ldexp(1.0, -libm::ilogb(largest)) } else { 1.0 };
    let round_of: Vec<u8> = points.iter().map(|&p| round(p.map(|x| x * unit)) as u8).collect();
    Rounds { order: by_round(&round_of), near: nearest_inserted(points, &round_of) }
}

/// The highest round is inserted first.
fn by_round(round_of: &[u8]) -> Vec<u32> {
    let mut starts = [0_usize; 65];
    for &r in round_of {
        starts[64 - usize::from(r)] += 1;
    }
    let mut next = 0;
    for start in &mut starts {
        next += std::mem::replace(start, next);
    }
    let mut order = vec![0; round_of.len()];
    for (row, &r) in round_of.iter().enumerate() {
        let slot = &mut starts[64 - usize::from(r)];
        order[*slot] = row as u32;
        *slot += 1;
    }
    order
}

/// The last row before each one whose round is at least as high, or the next after it whose round is higher: the nearer
/// of the two. On a curve the order jumps, and the one alone may be many samples away.
fn nearest_inserted(points: &[Point], round_of: &[u8]) -> Vec<u32> {
    let mut near = next_inserted(round_of);
    // The last row of each round or a higher one.
    let mut last = [0_u32; 65];
    for (row, &r) in round_of.iter().enumerate() {
        let before = last[usize::from(r)];
        let distance = |other: u32| {
            let (p, q) = (points[row], points[other as usize]);
            (p[0] - q[0]).abs() + (p[1] - q[1]).abs()
        };
        let after = near[row];
        if after == NONE || distance(before) <= distance(after) {
            near[row] = before;
        }
        last[..=usize::from(r)].fill(row as u32);
    }
    near
}

/// No row.
const NONE: u32 = u32::MAX;

fn next_inserted(round_of: &[u8]) -> Vec<u32> {
    // The next row of each round or a higher one.
    let mut next = [NONE; 66];
    let mut near = vec![NONE; round_of.len()];
    for (row, &r) in round_of.iter().enumerate().rev() {
        near[row] = next[usize::from(r) + 1];
        next[..=usize::from(r)].fill(row as u32);
    }
    near
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_far_point_does_not_spoil_the_order() {
        let mut points: Vec<Point> = (0..1000).map(|i| [f64::from(i) * 1e-9, 0.0]).collect();
        points.push([1e12, 1e12]);
        let rows = hilbert(&points);
        assert!(rows.windows(2).take(998).all(|w| w[0].abs_diff(w[1]) == 1));
    }

    #[test]
    fn duplicates_stand_together_first_row_first() {
        let points: Vec<Point> = (0..300).map(|i| [f64::from(i % 100), 1.0]).collect();
        let rows = hilbert(&points);
        assert!(rows.chunks(3).all(|c| c[0] + 100 == c[1] && c[1] + 100 == c[2]));
    }
}
