//! Stubs: short free branches that leave a crack at about a right angle and end in the plate beside it.
//!
//! A stub stays in the triangle of the fence that it grows into, which no other edge enters; the triangle is then
//! divided about it. So nothing crosses, what was joined stays joined, and later steps find a fence that fits.

mod bed;
mod index;

use super::fence::{Fence, FenceView};
use super::net::{NONE, Net, NetView};
use crate::error::{Error, Result};
use crate::graph::Point;
use crate::parallel;
use crate::quantile;
use crate::rng::{Key, block, open_unit, stream};
use crate::watch::Watch;
use bed::Bed;

/// How far up its triangle a stub may reach.
const ROOM: f64 = 0.85;
/// A stub keeps this part of the piece it grows from to both ends of it.
const MARGIN: f64 = 0.04;
/// Most stubs that are tried on one edge.
const MOST: u64 = 64;
/// Edges that stubs are tried on at a time.
const TOGETHER: usize = 1 << 17;

/// How many stubs there are, and how long.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stubs {
    /// Stubs tried for one unit of length.
    pub rate: f64,
    /// Median length.
    pub length: f64,
    /// Standard deviation of the logarithm of length.
    pub spread: f64,
    /// Standard deviation of the angle to the right angle, radians.
    pub lean: f64,
}

/// A drawing with stubs.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Grown {
    /// Its first vertices and edges are those before; an edge with stubs keeps its first piece.
    pub net: Net,
    /// Room on both sides of every edge, as before.
    pub fence: Fence,
    /// See [`super::pairs`].
    pub partner: Vec<i32>,
    /// The edge that each piece is of; -1 for stubs.
    pub origin: Vec<i32>,
}

impl Grown {
    /// The age of every edge, where those before had one: stubs are the youngest, the later the younger.
    pub fn ages(&self, before: &[i32]) -> Vec<i32> {
        let Some(mut youngest) = before.iter().copied().max() else { return Vec::new() };
        let age = |&origin: &i32| {
            if origin != NONE {
                return before[origin as usize];
            }
            youngest += 1;
            youngest
        };
        self.origin.iter().map(age).collect()
    }
}

/// Grows stubs off the edges of a drawing; `partner` is what [`super::pairs`] gives.
///
/// Along every edge stubs are a Poisson process. One that finds no room on its side grows on the other, or is left
/// out: no room is where it would leave its triangle, `bounds` (in the plane), or be longer than its edge.
///
/// # Errors
/// [`Error::BadValue`], [`Error::Interrupted`].
///
/// # Source
/// Ours, after the mask of a painting whose dead ends are short (REALISM: .15 of the nodes, .015 of the length).
pub fn stubs(
    net: NetView<'_>,
    partner: &[i32],
    fence: FenceView<'_>,
    bounds: [f64; 4],
    how: Stubs,
    key: Key,
    watch: Watch<'_>,
) -> Result<Grown> {
    grown(net.to_net(), partner.to_vec(), fence.to_fence(), bounds, how, key, watch)
}

/// The same in a drawing of its own.
pub(super) fn grown(
    net: Net,
    partner: Vec<i32>,
    fence: Fence,
    bounds: [f64; 4],
    how: Stubs,
    key: Key,
    watch: Watch<'_>,
) -> Result<Grown> {
    let values = [("rate", how.rate), ("length", how.length), ("spread", how.spread), ("lean", how.lean)];
    for (name, value) in values {
        if !(value.is_finite() && value >= 0.0) {
            return Err(Error::BadValue { name, value, wanted: "a finite number of at least 0 is wanted" });
        }
    }
    let mut bed = Bed::of(net, partner, fence, bounds);
    if how.rate > 0.0 && how.length > 0.0 {
        let edges = bed.net.edges.len();
        for from in (0..edges).step_by(TOGETHER) {
            watch.poll()?;
            bed.settle();
            // What is tried does not depend on what grew before, and most tries are too long for their edge; where a try
            // fits neither, but on triangles that others divide meanwhile.
            let tries = parallel::ranges(TOGETHER.min(edges - from), |range| {
                let mut tries = Vec::new();
                range.for_each(|i| sow(from + i, bed.net.view().length(from + i), how, key, &mut tries));
                let fitted = |(edge, seed): (usize, Seed)| (edge, fit(&bed, edge, seed.along, &seed), seed);
                tries.into_iter().map(fitted).collect::<Vec<_>>()
            });
            // The edge, its last piece, and where that starts.
            let mut place = (usize::MAX, 0, 0.0);
            for (edge, found, seed) in tries.iter().flatten() {
                if place.0 != *edge {
                    place = (*edge, *edge, 0.0);
                }
                let is_known = place.1 == *edge && bed.is_settled(*edge);
                let found = if is_known { *found } else { fit(&bed, place.1, seed.along - place.2, seed) };
                if let Some((side, foot, tip)) = found {
                    place = (*edge, bed.grow(place.1, side, foot, tip), seed.along);
                }
            }
        }
    }
    Ok(bed.finish())
}

/// Where a stub is tried: how far along its edge, on which side, how long, and its angle to the right angle.
struct Seed {
    along: f64,
    side: usize,
    length: f64,
    lean: f64,
}

/// Adds what is tried along one edge, from its first end on.
fn sow(edge: usize, length: f64, how: Stubs, key: Key, tries: &mut Vec<(usize, Seed)>) {
    let mut along = 0.0;
    for count in 0..MOST {
        let [gap, side, size, lean] = block(key, [edge as u64, count, stream::STUBS, 0]);
        along -= libm::log(open_unit(gap)) / how.rate;
        if along.is_nan() || along >= length {
            return;
        }
        let size = how.length * libm::exp(how.spread * quantile::normal(open_unit(size)));
        if size <= length || size.is_nan() {
            let lean = how.lean * quantile::normal(open_unit(lean));
            tries.push((edge, Seed { along, side: (side >> 63) as usize, length: size, lean }));
        }
    }
}

/// Side, foot and tip of a stub on either side of a piece, if there is room.
fn fit(bed: &Bed, piece: usize, at: f64, seed: &Seed) -> Option<(usize, Point, Point)> {
    [seed.side, 1 - seed.side].iter().find_map(|&side| fit_on(bed, piece, side, at, seed))
}

/// The same on one side.
fn fit_on(bed: &Bed, piece: usize, side: usize, at: f64, seed: &Seed) -> Option<(usize, Point, Point)> {
    let kite = bed.kite_of[piece] as usize;
    let [_, _, left, right] = bed.kites[kite];
    if [left, right][side] < 0 {
        return None;
    }
    let [a, b] = [0, 1].map(|corner| bed.corner(kite, corner));
    let (x, y) = (b[0] - a[0], b[1] - a[1]);
    let length = libm::hypot(x, y);
    let (margin, sign) = (MARGIN * length, if side == 0 { 1.0 } else { -1.0 });
    if !(at > margin && at < length - margin) {
        return None;
    }
    let (along, across) = apex(bed, kite, side, [a, b], length);
    let u = at + seed.length * libm::sin(seed.lean);
    let v = seed.length * libm::cos(seed.lean);
    let rising = if along > 0.0 { u / along } else { f64::INFINITY };
    let falling = if along < length { (length - u) / (length - along) } else { f64::INFINITY };
    if !(v > 0.0 && v <= ROOM * across * rising.min(falling).min(1.0)) {
        return None;
    }
    let (x, y) = (x / length, y / length);
    let foot = [a[0] + at * x, a[1] + at * y];
    let tip = [a[0] + u * x - sign * v * y, a[1] + u * y + sign * v * x];
    let [xmin, ymin, xmax, ymax] = bed.bounds;
    let inside = (xmin..=xmax).contains(&tip[0]) && (ymin..=ymax).contains(&tip[1]);
    let is_free = inside || !bed.net.shifts.is_empty();
    (is_free && bed.paves(kite, side, foot, tip)).then_some((side, foot, tip))
}

/// How far along and across the apex of a triangle lies; of one that is about three edges, its middle.
fn apex(bed: &Bed, kite: usize, side: usize, [a, b]: [Point; 2], length: f64) -> (f64, f64) {
    let apex = bed.corner(kite, 2 + side);
    let (x, y) = (b[0] - a[0], b[1] - a[1]);
    let mut away = [apex[0] - a[0], apex[1] - a[1]];
    if bed.is_vertex(bed.kites[kite][2 + side]) {
        away = [(away[0] + x) / 3.0, (away[1] + y) / 3.0];
    }
    let across = (x * away[1] - y * away[0]) / length;
    ((away[0] * x + away[1] * y) / length, if side == 0 { across } else { -across })
}
