//! How surely a line rises above a circle of the axis: what noise does to single samples, means of many undo.

use super::bumps::noise;
use super::cost::distance;
use super::rings::{Line, Rings};
use crate::graph::Point;

/// Parts of an arc, to either side of its ends and of its middle, over which distances are averaged.
const ENDS: f64 = 0.125;
const MIDDLE: f64 = 0.25;
/// Weights of the end that is farther from the centre, and of the nearer one: a centre that lies askew is no rise.
const WEIGHTS: [f64; 2] = [0.75, 0.25];
/// Samples up to which a sum is taken anew: exact where windows are small, and a few steps where they are not.
const FEW: usize = 64;
/// Noise that every line has, as a part of its length.
const ROUNDING: f64 = 1e-12;

/// The arc of a ring between two of its sites, the shorter way: its first place, its steps, and how long it is.
#[derive(Debug, Clone, Copy)]
pub(super) struct Arc {
    pub(super) line: usize,
    pub(super) start: usize,
    pub(super) count: usize,
    length: f64,
}

/// A closed line whose noise is known, ready for means over any of its parts.
#[derive(Debug)]
pub(super) struct Ring {
    noise: f64,
    /// About the first site: sums of the coordinates and of their squares up to each place.
    sums: Vec<[f64; 3]>,
}

impl Ring {
    /// None for a line whose noise is not known.
    pub(super) fn of(line: &Line, along: &[f64], sites: &[Point]) -> Option<Self> {
        let noise = noise(line, sites)?.max(ROUNDING * along[along.len() - 1]);
        let origin = sites[line.sites[0] as usize];
        let mut sums = vec![[0.0; 3]; line.sites.len() + 1];
        for (i, &site) in line.sites.iter().enumerate() {
            let [x, y] = [0, 1].map(|axis| sites[site as usize][axis] - origin[axis]);
            sums[i + 1] = [sums[i][0] + x, sums[i][1] + y, sums[i][2] + (x * x + y * y)];
        }
        Some(Self { noise, sums })
    }
}

impl Rings<'_> {
    /// The arc between the sites of an edge; None between two lines.
    pub(super) fn arc(&self, [p, q]: [i32; 2]) -> Option<Arc> {
        let (a, b) = (self.stands[p as usize], self.stands[q as usize]);
        if a.line != b.line || a.line == -1 {
            return None;
        }
        let line = a.line as usize;
        let (from, to) = (a.place.min(b.place) as usize, a.place.max(b.place) as usize);
        let (along, sites) = (&self.along[line], self.lines[line].sites.len());
        let (whole, way) = (along[along.len() - 1], along[to] - along[from]);
        // The other way round begins at the later one.
        let round = self.lines[line].closed && 2.0 * way > whole;
        Some(if round {
            Arc { line, start: to, count: sites - to + from, length: whole - way }
        } else {
            Arc { line, start: from, count: to - from, length: way }
        })
    }

    /// The rise of the middle of an arc above a circle about `centre` over its ends, in standard deviations.
    pub(super) fn rise(&self, arc: &Arc, ring: &Ring, centre: Point) -> f64 {
        let along = &self.along[arc.line];
        let (begin, ends) = (along[arc.start], ENDS * arc.length);
        let near = |at: f64, reach: f64| self.mean(arc.line, ring, [at - reach, at + reach], centre);
        let ([first, parts], [last, others]) = (near(begin, ends), near(begin + arc.length, ends));
        let [middle, inner] = near(begin + arc.length / 2.0, MIDDLE * arc.length);
        let circle = WEIGHTS[0] * first.max(last) + WEIGHTS[1] * first.min(last);
        let variance = 1.0 / inner + WEIGHTS[0] * (0.5 / parts + 0.5 / others);
        (middle - circle) / (ring.noise * variance.sqrt())
    }

    /// Root mean square of the distances of the sites of a line between two lengths along it, and how many they are; of
    /// the site next to their middle if there are none.
    fn mean(&self, line: usize, ring: &Ring, [from, to]: [f64; 2], centre: Point) -> [f64; 2] {
        let (sites, along) = (&self.lines[line].sites, &self.along[line]);
        let (n, whole) = (sites.len(), along[along.len() - 1]);
        // Places count on round the ring.
        let place = |at: f64| {
            let turns = (at / whole).floor();
            let within = along[..n].partition_point(|&a| a < at - turns * whole);
            turns as isize * n as isize + within as isize
        };
        let (low, high) = (place(from), place(to));
        let (low, high) = if low < high { (low, high) } else { (low, low + 1) };
        let count = (high - low) as usize;
        let start = low.rem_euclid(n as isize) as usize;
        let square = if count <= FEW {
            let site = |i: usize| self.sites[sites[(start + i) % n] as usize];
            (0..count).map(|i| distance(site(i), centre).powi(2)).sum::<f64>()
        } else {
            let origin = self.sites[sites[0] as usize];
            let [x, y] = [0, 1].map(|axis| centre[axis] - origin[axis]);
            let end = start + count;
            let sum = |i: usize| ring.sums[end.min(n)][i] - ring.sums[start][i] + ring.sums[end.saturating_sub(n)][i];
            sum(2) - 2.0 * (x * sum(0) + y * sum(1)) + count as f64 * (x * x + y * y)
        };
        [(square / count as f64).max(0.0).sqrt(), count as f64]
    }
}
