//! Rays to the left, to find what lies around a crack that floats.

use super::faces::{Net, add, less};
use crate::graph::Point;

/// Edges by the rows of a grid that they meet.
pub(super) struct Rows {
    bottom: f64,
    height: f64,
    rows: Vec<Vec<u32>>,
}

impl Rows {
    /// The rows in which rays at some heights run; the others stay empty.
    pub(super) fn new(net: &Net, rays: impl Iterator<Item = f64>) -> Self {
        let ends = |k: usize| {
            let y = net.places[net.edges[k][0]][1];
            (y.min(y + net.steps[k][1]), y.max(y + net.steps[k][1]))
        };
        let all = 0..net.edges.len();
        let low = all.clone().map(|k| ends(k).0).fold(f64::INFINITY, f64::min);
        let high = all.clone().map(|k| ends(k).1).fold(f64::NEG_INFINITY, f64::max);
        // On a torus a row lies in one period, and edges that leave it come in again.
        let (bottom, tall) = net.period.map_or((low, (high - low).max(f64::MIN_POSITIVE)), |period| (0.0, period[1]));
        let count = ((net.edges.len() as f64).sqrt() as usize).clamp(1, 4096);
        let mut rows = Self { bottom, height: tall / count as f64, rows: vec![Vec::new(); count] };
        let mut wanted = vec![false; count];
        rays.for_each(|y| wanted[rows.at(net, y)] = true);
        for k in all {
            let (low, high) = ends(k);
            let (first, last) = (rows.row(low), rows.row(high));
            for row in first..=last.min(first + count as i64 - 1) {
                let row = row.rem_euclid(count as i64) as usize;
                if wanted[row] {
                    rows.rows[row].push(k as u32);
                }
            }
        }
        rows
    }

    fn row(&self, y: f64) -> i64 {
        ((y - self.bottom) / self.height).floor() as i64
    }

    /// The row of a ray.
    fn at(&self, net: &Net, y: f64) -> usize {
        let (row, count) = (self.row(y), self.rows.len() as i64);
        (if net.period.is_some() { row.rem_euclid(count) } else { row.clamp(0, count - 1) }) as usize
    }

    /// The half-edge whose face a ray to the left of a place runs through, and from the place to its start.
    pub(super) fn left_of(&self, net: &Net, place: Point) -> Option<(usize, Point)> {
        let mut best: Option<(f64, usize, Point)> = None;
        for &k in &self.rows[self.at(net, place[1])] {
            let (start, step) = (net.places[net.edges[k as usize][0]], net.steps[k as usize]);
            let mut from = less(start, place);
            if let Some(period) = net.period {
                // The image whose lower end is the last at or below the ray.
                let low = from[1].min(from[1] + step[1]);
                from[1] -= (low / period[1]).ceil() * period[1];
            }
            let (low, high) = (from[1].min(from[1] + step[1]), from[1].max(from[1] + step[1]));
            if !(low <= 0.0 && 0.0 < high) {
                continue;
            }
            let at = from[0] - from[1] / step[1] * step[0];
            let back = net.period.map_or(0.0, |period| ((at / period[0]).floor() + 1.0) * period[0]);
            let (at, from) = (at - back, [from[0] - back, from[1]]);
            if at < 0.0 && best.is_none_or(|(other, ..)| at > other) {
                // The face to the right of the edge, as one looks up.
                let (half, from) =
                    if step[1] > 0.0 { (2 * k as usize + 1, add(from, step)) } else { (2 * k as usize, from) };
                best = Some((at, half, from));
            }
        }
        best.map(|(_, half, from)| (half, from))
    }
}
