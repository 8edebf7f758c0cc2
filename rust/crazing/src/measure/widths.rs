//! The distribution of widths, weighted with length, and how they run out.

use super::network::{Drawing, Network};

/// Widths of a drawing.
#[derive(Debug, Clone, Copy)]
pub(super) struct Widths {
    pub(super) mean: f64,
    pub(super) cv: f64,
    /// 95th percentile over the median.
    pub(super) ratio: f64,
    /// Mean width of the outer quarter of segments with a free tip over that of the rest of them.
    pub(super) taper: f64,
    /// Area of all edges, crossings counted twice.
    pub(super) area: f64,
}

/// The part of a segment with a free tip that counts as its end.
const OUTER: f64 = 0.25;

/// `tips` tells which ends of segments are free.
pub(super) fn widths(drawing: &Drawing<'_>, network: &Network, tips: &[bool]) -> Widths {
    let middle = |k: usize| f64::midpoint(drawing.widths[k][0], drawing.widths[k][1]);
    let length = |k: usize| {
        let [x, y] = drawing.step(2 * k as u32);
        libm::hypot(x, y)
    };
    let mut rows: Vec<(f64, f64)> = (0..drawing.widths.len()).map(|k| (middle(k), length(k))).collect();
    rows.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let total: f64 = rows.iter().map(|row| row.1).sum();
    let moment = |power: i32| rows.iter().map(|row| row.1 * row.0.powi(power)).sum::<f64>() / total;
    let mean = moment(1);
    let deviation = (moment(2) - mean * mean).max(0.0).sqrt();
    let ratio = quantile(&rows, total, 0.95) / quantile(&rows, total, 0.5);
    Widths { mean, cv: deviation / mean, ratio, taper: taper(drawing, network, tips), area: mean * total }
}

fn quantile(rows: &[(f64, f64)], total: f64, part: f64) -> f64 {
    let mut run = 0.0;
    let reached = |row: &&(f64, f64)| {
        run += row.1;
        run >= part * total
    };
    rows.iter().find(reached).or(rows.last()).map_or(f64::NAN, |row| row.0)
}

fn taper(drawing: &Drawing<'_>, network: &Network, tips: &[bool]) -> f64 {
    let mut sums = [[0.0; 2]; 2];
    for end in (0..tips.len()).filter(|&end| tips[end]) {
        let mut run = 0.0;
        for half in network.inwards(end) {
            let [x, y] = drawing.step(half);
            let length = libm::hypot(x, y);
            let [a, b] = drawing.widths[half as usize / 2];
            let inner = usize::from(run + length / 2.0 > OUTER * network.length[end / 2]);
            sums[inner][0] += length * f64::midpoint(a, b);
            sums[inner][1] += length;
            run += length;
        }
    }
    let [outer, inner] = sums.map(|[area, length]| area / length);
    outer / inner
}
