//! Segments as lines: points at equal steps along them, their length, orientation and roughness.

use super::network::{Drawing, Network};
use crate::graph::Point;

/// The point `reach` along the segment from one of its ends, relative to that end: the far end if the segment is
/// shorter, the next vertex if `reach` is 0.
pub(super) fn point_at(drawing: &Drawing<'_>, network: &Network, end: usize, reach: f64) -> Point {
    let (mut at, mut run) = ([0.0; 2], 0.0);
    for half in network.inwards(end) {
        let step = drawing.step(half);
        let length = libm::hypot(step[0], step[1]);
        if reach > 0.0 && run + length >= reach {
            let part = if length > 0.0 { (reach - run) / length } else { 0.0 };
            return [at[0] + part * step[0], at[1] + part * step[1]];
        }
        at = [at[0] + step[0], at[1] + step[1]];
        run += length;
        if reach == 0.0 {
            break;
        }
    }
    at
}

/// Points of a segment relative to its first end: its vertices, or, for a `stride` above 0, points at equal steps of
/// about that length along it.
pub(super) fn points(drawing: &Drawing<'_>, network: &Network, segment: usize, stride: f64) -> Vec<Point> {
    let chain = chain(drawing, network, segment);
    if stride > 0.0 { stepped(&chain, network.length[segment], stride).collect() } else { chain }
}

/// The vertices of a segment relative to its first end.
fn chain(drawing: &Drawing<'_>, network: &Network, segment: usize) -> Vec<Point> {
    let mut vertices = vec![[0.0; 2]];
    let mut at = [0.0; 2];
    for &half in network.along(segment) {
        let step = drawing.step(half);
        at = [at[0] + step[0], at[1] + step[1]];
        vertices.push(at);
    }
    vertices
}

/// Points at equal steps along a chain.
fn stepped(chain: &[Point], length: f64, stride: f64) -> impl Iterator<Item = Point> {
    let pieces = (length / stride).round().clamp(1.0, 1e9) as usize;
    let (mut i, mut run) = (0, 0.0);
    let within = move |piece: usize| {
        let wanted = length * piece as f64 / pieces as f64;
        while i + 2 < chain.len() && run + distance(chain[i], chain[i + 1]) < wanted {
            run += distance(chain[i], chain[i + 1]);
            i += 1;
        }
        let step = distance(chain[i], chain[i + 1]);
        let part = if step > 0.0 { ((wanted - run) / step).min(1.0) } else { 0.0 };
        [0, 1].map(|k| chain[i][k] + part * (chain[i + 1][k] - chain[i][k]))
    };
    std::iter::once(chain[0]).chain((1..pieces).map(within)).chain(chain.last().copied())
}

pub(super) fn distance(a: Point, b: Point) -> f64 {
    libm::hypot(b[0] - a[0], b[1] - a[1])
}

pub(super) fn length(points: &[Point]) -> f64 {
    points.windows(2).map(|pair| distance(pair[0], pair[1])).sum()
}

/// Sums of cos 2a, sin 2a and 1 over steps of orientation a, weighted with their length.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Orientation {
    cosine: f64,
    sine: f64,
    length: f64,
}

impl Orientation {
    pub(super) fn add(&mut self, points: &[Point]) {
        for pair in points.windows(2) {
            let (x, y) = (pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]);
            let length = libm::hypot(x, y);
            if length > 0.0 {
                self.cosine += (x * x - y * y) / length;
                self.sine += 2.0 * x * y / length;
                self.length += length;
            }
        }
    }

    /// 0 for all directions alike, 1 for one direction.
    pub(super) fn order(self) -> f64 {
        libm::hypot(self.cosine, self.sine) / self.length
    }

    /// The direction most lines run in, degrees from the x axis, 0 to 180.
    pub(super) fn direction(self) -> f64 {
        (libm::atan2(self.sine, self.cosine).to_degrees() / 2.0).rem_euclid(180.0)
    }
}

/// Sum of squared second differences over `lag` of points a lag apart, and their number.
pub(super) fn roughness(drawing: &Drawing<'_>, network: &Network, segment: usize, lag: f64) -> (f64, usize) {
    let length = network.length[segment];
    if length < 2.0 * lag {
        return (0.0, 0);
    }
    if network.along(segment).len() == 1 {
        // Straight: what stepping along it would say.
        return (0.0, (length / lag).round() as usize - 1);
    }
    // One after the other: a long segment has very many beside a short lag.
    let chain = chain(drawing, network, segment);
    let (mut last, mut sum, mut count) = ([[0.0; 2]; 2], 0.0, 0);
    for (i, point) in stepped(&chain, length, lag).enumerate() {
        if i > 1 {
            let [x, y] = [0, 1].map(|k| last[0][k] - 2.0 * last[1][k] + point[k]);
            sum += (x * x + y * y) / (lag * lag);
            count += 1;
        }
        last = [last[1], point];
    }
    (sum, count)
}
