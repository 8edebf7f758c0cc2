//! Rays to the left, to find what lies around a crack that floats on a torus; in the plane see [`super::slabs`].

use std::ops::Range;

use super::faces::{Net, less};
use crate::graph::Point;

/// What rounding may move the end of an edge by, as a part of the period.
const ROUNDING: f64 = 1e-12;

/// What rounding may move the place by where an edge meets a ray, as a part of all that is there.
pub(super) const ASIDE: f64 = 1e-12;

/// Rays of a row, at least.
const RAYS: usize = 8;

/// Entries that rows may have, for every edge.
const ENTRIES: usize = 4;

/// The edges that rays to the left may meet, by rows of rays that run next to each other within one period.
pub(super) struct Rows {
    /// Where the rays run, from the bottom up.
    rays: Vec<f64>,
    /// Rays of a row.
    stride: usize,
    rows: Vec<Vec<u32>>,
}

impl Rows {
    /// The rows of rays at some heights.
    pub(super) fn new(net: &Net, rays: impl Iterator<Item = f64>) -> Self {
        let mut rays: Vec<f64> = rays.map(|y| within(net, y)).collect();
        rays.sort_unstable_by(f64::total_cmp);
        let mut rows = Self { rays, stride: RAYS, rows: Vec::new() };
        let most = ENTRIES * net.edges.len();
        while rows.stride < rows.rays.len() && rows.entries(net, most) > most {
            rows.stride *= 2;
        }
        rows.rows = vec![Vec::new(); rows.rays.len().div_ceil(rows.stride)];
        for k in 0..net.edges.len() {
            for met in rows.met(net, k) {
                for row in rows.rows_of(met) {
                    rows.rows[row].push(k as u32);
                }
            }
        }
        rows
    }

    /// How many entries there are with this stride; counted no farther than where they are too many.
    fn entries(&self, net: &Net, most: usize) -> usize {
        let mut count = 0;
        for k in 0..net.edges.len() {
            count += self.met(net, k).into_iter().map(|met| self.rows_of(met).len()).sum::<usize>();
            if count > most {
                break;
            }
        }
        count
    }

    fn rows_of(&self, met: Range<usize>) -> Range<usize> {
        if met.is_empty() { 0..0 } else { met.start / self.stride..(met.end - 1) / self.stride + 1 }
    }

    /// The rays that an edge may meet, in up to two parts.
    fn met(&self, net: &Net, k: usize) -> [Range<usize>; 2] {
        let from = |y: f64| self.rays.partition_point(|&ray| ray < y);
        let [a, b] = net.edges[k].map(|vertex| net.places[vertex as usize][1]);
        let [_, period] = net.period.unwrap_or_default();
        let (b, slack) = (b + net.turns[k][1] * period, ROUNDING * period);
        let (low, high) = (a.min(b) - slack, a.max(b) + slack);
        if high - low >= period {
            return [0..self.rays.len(), 0..0];
        }
        let (low, high) = (within(net, low), within(net, high));
        let (first, last) = (from(low), self.rays.partition_point(|&ray| ray <= high));
        if low <= high { [first..last, 0..0] } else { [first..self.rays.len(), 0..last] }
    }

    /// The half-edge whose face a ray to the left of a vertex runs through, and from the vertex to its start.
    pub(super) fn left_of(&self, net: &Net, vertex: usize) -> Option<(usize, Point)> {
        let height = within(net, net.places[vertex][1]);
        let row = &self.rows[self.rays.partition_point(|&ray| ray < height) / self.stride];
        let all = row.iter().flat_map(|&edge| hits(net, vertex, edge as usize));
        all.fold(None, |best, hit| better(best, Some(hit))).map(|hit| (hit.half, hit.start))
    }
}

/// A height, on a torus in the first period.
fn within(net: &Net, y: f64) -> f64 {
    net.period.map_or(y, |period| y.rem_euclid(period[1]))
}

/// Where an edge, on a torus its images, meets a ray to the left of a vertex.
fn hits(net: &Net, vertex: usize, k: usize) -> impl Iterator<Item = Hit> {
    let (place, period) = (net.places[vertex], net.period.unwrap_or_default());
    let ([a, b], turns) = (net.edges[k].map(|end| net.places[end as usize]), net.turns[k]);
    // The same for all edges that end there, so that no ray slips through between them.
    let image = move |end: Point, turns: Point| {
        let from = less(end, place);
        [from[0] + turns[0] * period[0], from[1] + turns[1] * period[1]]
    };
    let (start, end) = (image(a, [0.0; 2])[1], image(b, turns)[1]);
    let (across, up) = (net.period.map(|period| period[0]), net.period.map(|period| period[1]));
    // The images that may meet the ray.
    let far = move |y: f64| up.map_or(0.0, |up| -y / up);
    (far(start.max(end)).floor() as i64..=far(start.min(end)).ceil() as i64).filter_map(move |by| {
        let by = by as f64;
        Hit::new(k, [image(a, [0.0, by]), image(b, [turns[0], turns[1] + by])], across)
    })
}

/// What a ray to the left meets.
pub(super) struct Hit {
    /// How far to the right; it is less than 0.
    pub(super) at: f64,
    /// The vector of the edge, upwards.
    up: Point,
    /// To the right of the edge, as one looks up; and from the vertex to its start.
    pub(super) half: usize,
    pub(super) start: Point,
}

/// What is met first.
pub(super) fn better(best: Option<Hit>, hit: Option<Hit>) -> Option<Hit> {
    match (best, hit) {
        (Some(best), Some(hit)) => Some(if hit.is_right_of(&best) { hit } else { best }),
        (best, hit) => best.or(hit),
    }
}

/// How far to the right an edge from below to above passes the height 0.
pub(super) fn crossing(low: Point, high: Point) -> f64 {
    let up = less(high, low);
    low[0] - low[1] / up[1] * up[0]
}

impl Hit {
    /// Where an edge with these ends meets a ray to the left, on a torus for the first time.
    pub(super) fn new(k: usize, [a, b]: [Point; 2], period: Option<f64>) -> Option<Self> {
        let (low, high, half, start) = if a[1] <= b[1] { (a, b, 2 * k + 1, b) } else { (b, a, 2 * k, a) };
        if !(low[1] <= 0.0 && 0.0 < high[1]) {
            return None;
        }
        let up = less(high, low);
        let at = crossing(low, high);
        let back = period.map_or(0.0, |period| ((at / period).floor() + 1.0) * period);
        (at - back < 0.0).then_some(Self { at: at - back, up, half, start: [start[0] - back, start[1]] })
    }

    /// Of edges that meet the ray in one place, above it the one to the right comes first; of such as lie on top of each
    /// other the first.
    fn is_right_of(&self, other: &Self) -> bool {
        let leans = self.up[0] * other.up[1] - other.up[0] * self.up[1];
        let comes_first = leans > 0.0 || (leans == 0.0 && self.half / 2 < other.half / 2);
        self.at > other.at || (self.at == other.at && comes_first)
    }
}
