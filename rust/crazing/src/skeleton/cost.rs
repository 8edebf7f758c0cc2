//! What a curve costs: edges by their length, sites by how two edges meet there, and small rings.
//!
//! The weights were set on sampled silhouettes (`python/benchmarks/curves.py` has the table); all of them are plain
//! numbers, so the cost does not depend on the unit.

use crate::graph::Point;

/// What turning costs, and where an exchange begins.
#[derive(Clone, Copy)]
pub(super) struct Turning {
    /// Full turn back, beside an edge as long as its surroundings.
    most: f64,
    /// Part of half a turn at which half as much is reached as there would be without end: the first degrees cost most,
    /// so that the turning gathers in few corners.
    soft: f64,
    /// Whether the dearest edge of a site is tried first, or the cheapest. Tried on outlines of land and on noisy rings:
    /// the one finds two more of a thousand true edges, the other leaves half as many rings open.
    pub(super) dearest_first: bool,
}

/// Samples that are few but stand on the curve: which way it goes on says most.
pub(super) const SPARSE: Turning = Turning { most: 3.0, soft: 1.0, dearest_first: true };
/// Samples beside the curve: small turns are noise, and with more weight rings would come open.
pub(super) const NOISY: Turning = Turning { most: 2.0, soft: 0.5, dearest_first: false };
/// Edges at a site whose lengths differ by a factor e.
const RATIO: f64 = 0.3;
/// Logarithm of the lengths beyond which it costs no more.
const RATIO_MOST: f64 = 2.0;
/// An edge across one of the diagram, beside one of it: one in a hundred edges of the outlines of land is such.
pub(super) const ACROSS: f64 = 0.3;
/// An end that is free.
pub(super) const FREE: f64 = 8.0;
/// A ring of three sites; larger ones cost less.
const RING: f64 = 4.0;
/// Sites of a ring that costs nothing for its smallness.
pub(super) const RING_FREE: usize = 13;
/// Costs at a site beyond this make the search begin there.
pub(super) const SUSPECT: f64 = 0.8;

/// An edge as seen from a site.
#[derive(Clone, Copy)]
pub(super) struct End {
    step: Point,
    length: f64,
}

impl End {
    /// An edge whose length is known.
    #[inline]
    pub(super) fn of(from: Point, to: Point, length: f64) -> Self {
        Self { step: [to[0] - from[0], to[1] - from[1]], length }
    }
}

pub(super) fn distance(a: Point, b: Point) -> f64 {
    libm::hypot(b[0] - a[0], b[1] - a[1])
}

/// An edge between two sites with their spacings.
pub(super) fn edge(length: f64, a: f64, b: f64) -> f64 {
    length / (a * b).sqrt()
}

/// A site with two edges, one or none.
pub(super) fn site(ends: [Option<End>; 2], turning: Turning) -> f64 {
    let [Some(a), Some(b)] = ends else {
        return FREE * ends.iter().filter(|end| end.is_none()).count() as f64;
    };
    let cross = a.step[0] * b.step[1] - a.step[1] * b.step[0];
    let dot = a.step[0] * b.step[0] + a.step[1] * b.step[1];
    let turn = 1.0 - libm::atan2(cross.abs(), dot) / std::f64::consts::PI;
    let ratio = libm::log(a.length / b.length).abs().min(RATIO_MOST);
    turning.most * turn * (1.0 + turning.soft) / (turn + turning.soft) + RATIO * ratio
}

/// A ring of so many sites.
pub(super) fn ring(sites: usize) -> f64 {
    RING * RING_FREE.saturating_sub(sites) as f64 / (RING_FREE - 3) as f64
}
