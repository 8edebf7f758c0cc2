//! Rays to the left, to find what lies around a crack that floats.

use super::faces::{Net, less};
use crate::graph::Point;

/// What rounding may move the end of an edge by, as a part of a row.
const ROUNDING: f64 = 1e-9;

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
            let ([a, b], period) =
                (net.edges[k].map(|vertex| net.places[vertex][1]), net.period.unwrap_or_default()[1]);
            let b = b + net.turns[k][1] * period;
            (a.min(b), a.max(b))
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
            let (first, last) = (rows.row(low - ROUNDING * rows.height), rows.row(high + ROUNDING * rows.height));
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

    /// The half-edge whose face a ray to the left of a vertex runs through, and from the vertex to its start.
    pub(super) fn left_of(&self, net: &Net, vertex: usize) -> Option<(usize, Point)> {
        let place = net.places[vertex];
        let period = net.period.unwrap_or_default();
        // The same for all edges that end there, so that no ray slips through between them.
        let image = |vertex: usize, turns: Point| {
            let from = less(net.places[vertex], place);
            [from[0] + turns[0] * period[0], from[1] + turns[1] * period[1]]
        };
        let mut best: Option<Hit> = None;
        for &k in &self.rows[self.at(net, place[1])] {
            let ([a, b], turns) = (net.edges[k as usize], net.turns[k as usize]);
            let (start, end) = (image(a, [0.0; 2])[1], image(b, turns)[1]);
            // The images that may meet the ray.
            let far = |y: f64| net.period.map_or(0.0, |period| -y / period[1]);
            for by in far(start.max(end)).floor() as i64..=far(start.min(end)).ceil() as i64 {
                let by = by as f64;
                let ends = [image(a, [0.0, by]), image(b, [turns[0], turns[1] + by])];
                if let Some(hit) = Hit::new(k as usize, ends, net.period.map(|period| period[0])) {
                    best = Some(best.filter(|best| !hit.is_right_of(best)).unwrap_or(hit));
                }
            }
        }
        best.map(|hit| (hit.half, hit.start))
    }
}

/// What a ray to the left meets.
struct Hit {
    /// How far to the right; it is less than 0.
    at: f64,
    /// The vector of the edge, upwards.
    up: Point,
    /// To the right of the edge, as one looks up; and from the vertex to its start.
    half: usize,
    start: Point,
}

impl Hit {
    /// Where an edge with these ends meets a ray to the left, on a torus for the first time.
    fn new(k: usize, [a, b]: [Point; 2], period: Option<f64>) -> Option<Self> {
        let (low, high, half, start) = if a[1] <= b[1] { (a, b, 2 * k + 1, b) } else { (b, a, 2 * k, a) };
        if !(low[1] <= 0.0 && 0.0 < high[1]) {
            return None;
        }
        let up = less(high, low);
        let at = low[0] - low[1] / up[1] * up[0];
        let back = period.map_or(0.0, |period| ((at / period).floor() + 1.0) * period);
        (at - back < 0.0).then_some(Self { at: at - back, up, half, start: [start[0] - back, start[1]] })
    }

    /// Of edges that meet the ray in one place, above it the one to the right comes first.
    fn is_right_of(&self, other: &Self) -> bool {
        let leans = self.up[0] * other.up[1] - other.up[0] * self.up[1];
        self.at > other.at || (self.at == other.at && leans > 0.0)
    }
}
