//! The plates between the cracks, and how each differs from the others.

use crate::error::{Error, Result};
use crate::graph::check_indices;
use crate::rng::{Key, block, open_unit, stream};

/// What lies on either side of every edge.
#[derive(Debug, Clone, Copy)]
pub struct Sides<'a> {
    /// The plates to the left and to the right of each edge, from its first end to its second. Empty, as are the
    /// middles, where it does not matter which plate a pixel is on: all are plate 0 then.
    pub plates: &'a [[i32; 2]],
    /// From the first end of each edge to the middles of these plates, data units.
    pub middles: &'a [[[f64; 2]; 2]],
    /// The farthest corner of each plate from its middle, data units.
    pub reaches: &'a [f64],
    /// Where the plates end, data units: xmin, ymin, xmax, ymax; of no matter with a period. A pixel beyond is on the
    /// plate of the nearest place within.
    pub bounds: [f64; 4],
}

impl Sides<'_> {
    /// Refuses tables that do not fit the edges.
    pub(super) fn check(&self, wanted: usize) -> Result<()> {
        let lone = self.reaches.len() == 1 && self.plates.is_empty() && self.middles.is_empty();
        let wanted = if lone { 0 } else { wanted };
        for (array, found) in [("plates", self.plates.len()), ("middles", self.middles.len())] {
            if found != wanted {
                return Err(Error::BadLength { array, found, wanted });
            }
        }
        check_indices("plates", self.plates, 0, self.reaches.len())
    }

    /// The plate on a side of an edge.
    pub(super) fn plate(&self, edge: usize, side: usize) -> i32 {
        self.plates.get(edge).map_or(0, |beside| beside[side])
    }

    /// From the first end of an edge to the middle of the plate on a side, data units.
    pub(super) fn middle(&self, edge: usize, side: usize) -> [f64; 2] {
        self.middles.get(edge).map_or([0.0; 2], |beside| beside[side])
    }
}

/// How one plate differs.
#[derive(Debug, Clone, Copy)]
pub(super) struct Plate {
    /// Where it is on the ramp of colours, -1 to 1.
    pub(super) tint: f32,
    /// How much higher it lies, -1 to 1.
    pub(super) level: f32,
    /// Up which way it is tilted: a vector in the unit disc, over the plate's reach in data units.
    pub(super) tilt: [f32; 2],
    /// How much it curls, 0 to 1.
    pub(super) curl: f32,
}

/// Every plate's own numbers, from a generator that counts plates.
pub(super) fn plates(reaches: &[f64], key: Key) -> Vec<Plate> {
    let own = |plate: usize| {
        let words = block(key, [plate as u64, 0, stream::PLATE, 0]);
        let half = |word: u64| [word & 0xFFFF_FFFF, word >> 32].map(|bits| (open_unit(bits << 32) * 2.0 - 1.0) as f32);
        let [tint, level] = half(words[0]);
        let [x, y] = half(words[1]);
        let [curl, _] = half(words[2]);
        let length = (x * x + y * y).sqrt().max(1.0);
        let reach = reaches.get(plate).copied().filter(|reach| *reach > 0.0).map_or(0.0, |reach| (1.0 / reach) as f32);
        Plate { tint, level, tilt: [x / length * reach, y / length * reach], curl: 0.5 + 0.5 * curl }
    };
    (0..reaches.len()).map(own).collect()
}
