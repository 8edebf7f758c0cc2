//! 1/f noise by midpoint displacement: along a chain of edges, and along one edge.

use super::Roughness;
use crate::crack::net::NetView;
use crate::crack::noise::{Noise, power};
use crate::rng::Key;

impl Roughness {
    /// Standard deviation in the middle of a stretch.
    pub(super) fn deviation(&self, length: f64) -> f64 {
        if length > 0.0 && self.unit > 0.0 {
            self.amplitude * self.unit * power(length / self.unit, self.hurst)
        } else {
            0.0
        }
    }
}

/// Memory that one chain after another is bridged in.
#[derive(Default)]
pub(super) struct Bridge {
    /// How far along the chain its vertices lie.
    along: Vec<f64>,
    pub(super) heights: Vec<f64>,
    stretches: Vec<(usize, usize)>,
}

impl Bridge {
    /// Finds the heights at the vertices along a chain; zero at both ends.
    pub(super) fn over(&mut self, net: NetView<'_>, how: Roughness, key: Key, chain: &[u32]) {
        let Self { along, heights, stretches } = self;
        along.clear();
        along.push(0.0);
        for (i, &end) in chain.iter().enumerate() {
            along.push(along[i] + net.length(end as usize / 2));
        }
        heights.clear();
        heights.resize(along.len(), 0.0);
        let mut noise = Noise::of(key, chain[0] as usize, 1);
        stretches.push((0, chain.len()));
        while let Some((from, to)) = stretches.pop() {
            if to - from < 2 {
                continue;
            }
            let (middle, length) = (usize::midpoint(from, to), along[to] - along[from]);
            let part = if length > 0.0 { (along[middle] - along[from]) / length } else { 0.5 };
            let spread = how.deviation(length) * 2.0 * (part * (1.0 - part)).max(0.0).sqrt();
            let between = heights[from] + part * (heights[to] - heights[from]);
            heights[middle] = between + spread * noise.at(middle);
            stretches.push((from, middle));
            stretches.push((middle, to));
        }
    }
}

/// Heights along an edge, with room for as many numbers; from one level to the next deviation is `next` as large, and
/// behind so many levels there is none.
///
/// Numbers are drawn level by level: an edge that is halved once more keeps all the heights it had.
pub(super) fn wavy(
    heights: &mut [f64],
    numbers: &mut [f64],
    (mut spread, next, levels): (f64, f64, u8),
    key: Key,
    edge: usize,
) {
    let count = heights.len() - 1;
    // The first is not used; from there on there are twice as many from level to level.
    Noise::fill(key, edge, 2, numbers);
    (heights[0], heights[count]) = (0.0, 0.0);
    let (mut stretch, mut level) = (count, 1);
    while stretch > 1 {
        let off = if level >> levels == 0 { spread } else { 0.0 };
        let own = &numbers[level..2 * level];
        for (middle, number) in (stretch / 2..count).step_by(stretch).zip(own) {
            let between = 0.5 * (heights[middle - stretch / 2] + heights[middle + stretch / 2]);
            heights[middle] = between + off * number;
        }
        spread *= next;
        (stretch, level) = (stretch / 2, 2 * level);
    }
}
