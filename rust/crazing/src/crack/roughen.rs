//! Rough cracks: 1/f wandering about their straight edges, pinned at the nodes.

use super::fence::{FenceView, Guard};
use super::net::{Ends, NONE, Net, NetView};
use crate::error::{Error, Result};
use crate::graph::Point;
use crate::parallel;
use crate::quantile;
use crate::rng::{Key, block, open_unit, stream};
use crate::watch::Watch;

/// The part of its kite that an edge may wander in.
const ROOM: f64 = 0.6;
/// Most halvings of one edge.
const DEEPEST: u32 = 8;
/// An edge is not subdivided when its kite is thinner than this part of its length: roundings could leave it.
const THIN: f64 = 1e-6;

/// How cracks wander.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Roughness {
    /// Standard deviation, in the middle, of a crack as long as `unit`, as a part of it.
    pub amplitude: f64,
    /// Deviation grows with this power of length: .5 is a random walk, .7 is what real cracks show.
    pub hurst: f64,
    /// The length that `amplitude` is about, data units.
    pub unit: f64,
    /// Edges are halved until no longer than this, data units.
    pub grain: f64,
}

/// A rough drawing.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Rough {
    /// Its first vertices are those of the drawing before; pieces of one edge follow one another.
    pub net: Net,
    /// See [`super::pairs`].
    pub partner: Vec<i32>,
    /// The edge that each piece is of.
    pub origin: Vec<i32>,
}

/// Subdivides edges and moves the new vertices across them, after moving the vertices inside each crack.
///
/// Between nodes (vertices of other degree than 2, cut ends) a crack is a bridge of fractional Brownian motion by
/// midpoint displacement. Vertices move behind the fence, see [`super::Fence`]; every edge wanders in its own kite, a
/// region no other edge enters, and forward only: topology stays, and nothing new crosses.
///
/// # Errors
/// [`Error::BadValue`], [`Error::TooMany`], [`Error::Interrupted`].
///
/// # Source
/// Fournier, Fussell, Carpenter: Computer Rendering of Stochastic Models (1982), for midpoint displacement.
pub fn roughen(
    net: NetView<'_>,
    partner: &[i32],
    fence: FenceView<'_>,
    how: Roughness,
    key: Key,
    watch: Watch<'_>,
) -> Result<Rough> {
    for (name, value) in [("roughness", how.amplitude), ("hurst", how.hurst), ("unit", how.unit), ("grain", how.grain)]
    {
        if !(value.is_finite() && value >= 0.0) {
            return Err(Error::BadValue { name, value, wanted: "a finite number of at least 0 is wanted" });
        }
    }
    let vertices = wander(net, fence, how, key, watch)?;
    let moved = NetView { vertices: &vertices, ..net };
    watch.poll()?;
    let inner = parallel::map(net.edges.len(), |k| pieces(moved, fence, how, key, k));
    let mut starts = vec![0_usize];
    for (k, inner) in inner.iter().enumerate() {
        starts.push(starts[k] + 1 + inner.len());
    }
    let found = starts[net.edges.len()];
    const MOST: usize = (1 << 30) - 1;
    if found > MOST {
        return Err(Error::TooMany { what: "pieces of rough edges; a larger grain is wanted", found, limit: MOST });
    }
    Ok(assemble(moved, partner, &starts, &inner))
}

/// Standard normal numbers, one of its own for every place on an edge.
struct Noise {
    key: Key,
    edge: u64,
    level: u64,
    block: u64,
    words: [u64; 4],
}

impl Noise {
    fn of(key: Key, edge: usize, level: u64) -> Self {
        let words = block(key, [edge as u64, 0, stream::ROUGHNESS, level]);
        Self { key, edge: edge as u64, level, block: 0, words }
    }

    fn at(&mut self, index: usize) -> f64 {
        if index as u64 / 4 != self.block {
            self.block = index as u64 / 4;
            self.words = block(self.key, [self.edge, self.block, stream::ROUGHNESS, self.level]);
        }
        quantile::normal(open_unit(self.words[index % 4]))
    }
}

/// Length of a vector; only those that would over- or underflow take the slow way.
fn length([x, y]: Point) -> f64 {
    let square = x * x + y * y;
    if (1e-280..1e280).contains(&square) { square.sqrt() } else { libm::hypot(x, y) }
}

impl Roughness {
    /// Standard deviation in the middle of a stretch.
    fn deviation(&self, length: f64) -> f64 {
        if length > 0.0 && self.unit > 0.0 {
            self.amplitude * self.unit * libm::pow(length / self.unit, self.hurst)
        } else {
            0.0
        }
    }
}

/// Moves the vertices of degree 2 across their crack.
fn wander(net: NetView<'_>, fence: FenceView<'_>, how: Roughness, key: Key, watch: Watch<'_>) -> Result<Vec<Point>> {
    let ends = Ends::of(net);
    let mut guard = Guard::of(net, fence);
    let mut seen = vec![false; net.edges.len()];
    let is_node = |vertex: usize| ends.at(vertex).len() != 2 || net.cut[vertex];
    let all = 0..2 * net.edges.len() as u32;
    let from_nodes = all.clone().filter(|&end| is_node(net.vertex(end)));
    for (step, end) in from_nodes.chain(all).enumerate() {
        watch.poll_at(step)?;
        if seen[end as usize / 2] {
            continue;
        }
        let chain = chain(net, &ends, end, &mut seen, is_node);
        if chain.len() < 2 {
            continue;
        }
        let heights = bridge(net, how, key, &chain);
        for (pair, height) in chain.windows(2).zip(&heights[1..]) {
            let (before, after) = (net.along(pair[0]), net.along(pair[1]));
            let across = [-(before[1] + after[1]), before[0] + after[0]];
            let length = libm::hypot(across[0], across[1]);
            if length > 0.0 {
                guard.shove(net.vertex(pair[1]), [height * across[0] / length, height * across[1] / length]);
            }
        }
    }
    Ok(guard.into_vertices())
}

/// The ends to enter edges by, from one node to the next, or once around a ring.
fn chain(net: NetView<'_>, ends: &Ends, start: u32, seen: &mut [bool], is_node: impl Fn(usize) -> bool) -> Vec<u32> {
    let (mut chain, mut end) = (Vec::new(), start);
    while !std::mem::replace(&mut seen[end as usize / 2], true) {
        chain.push(end);
        let out = end ^ 1;
        let vertex = net.vertex(out);
        match ends.at(vertex) {
            &[a, b] if !is_node(vertex) => end = if a == out { b } else { a },
            _ => break,
        }
    }
    chain
}

/// Heights at the vertices along a chain; zero at both ends.
fn bridge(net: NetView<'_>, how: Roughness, key: Key, chain: &[u32]) -> Vec<f64> {
    let mut along = vec![0.0];
    for (i, &end) in chain.iter().enumerate() {
        along.push(along[i] + net.length(end as usize / 2));
    }
    let mut heights = vec![0.0; along.len()];
    let mut noise = Noise::of(key, chain[0] as usize, 1);
    let mut stretches = vec![(0, chain.len())];
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
    heights
}

/// How often an edge is halved.
fn halvings(room: &Room, how: Roughness) -> u32 {
    let across = room.sides[0][1].max(room.sides[1][1]);
    if !(how.grain > 0.0 && room.length.is_finite() && across > THIN * room.length) || how.amplitude == 0.0 {
        return 0;
    }
    let mut depth = 0;
    while depth < DEEPEST && room.length > how.grain * f64::from(1 << depth) {
        depth += 1;
    }
    depth
}

/// The kite of an edge in its own frame: how far along and how far across the apexes lie, left and right.
struct Room {
    length: f64,
    sides: [Point; 2],
}

impl Room {
    fn of(net: NetView<'_>, fence: FenceView<'_>, edge: usize) -> Self {
        let [a, b] = net.ends(edge);
        let (x, y) = (b[0] - a[0], b[1] - a[1]);
        let length = self::length([x, y]);
        let side = |side: usize, sign: f64| {
            let corner = fence.kites[edge][2 + side];
            if corner < 0 || length == 0.0 {
                return [0.0; 2];
            }
            let at = corner as usize;
            let place = if at < net.vertices.len() { net.vertices[at] } else { fence.anchors[at - net.vertices.len()] };
            let shift = fence.shifts.get(edge).map_or([0; 2], |s| [s[2 + 2 * side], s[3 + 2 * side]]);
            let apex = net.moved(place, shift);
            let mut away = [apex[0] - a[0], apex[1] - a[1]];
            if at < net.vertices.len() {
                // A triangle between vertices may be about three edges: each has the third up to the middle.
                away = [(away[0] + x) / 3.0, (away[1] + y) / 3.0];
            }
            let [u, v] = away;
            [(u * x + v * y) / length, (sign * (x * v - y * u) / length).max(0.0)]
        };
        Self { length, sides: [side(0, 1.0), side(1, -1.0)] }
    }

    /// `height` at `x` along the edge, kept within the kite.
    fn within(&self, x: f64, height: f64) -> f64 {
        let [along, across] = self.sides[usize::from(height < 0.0)];
        let left = if along > 0.0 { x / along } else { f64::INFINITY };
        let right = if along < self.length { (self.length - x) / (self.length - along) } else { f64::INFINITY };
        let most = ROOM * across * left.min(right).min(1.0);
        height.clamp(-most, most)
    }
}

/// The places of the inner vertices of an edge.
fn pieces(net: NetView<'_>, fence: FenceView<'_>, how: Roughness, key: Key, edge: usize) -> Vec<Point> {
    let room = Room::of(net, fence, edge);
    let depth = halvings(&room, how);
    if depth == 0 {
        return Vec::new();
    }
    let count = 1_usize << depth;
    let mut noise = Noise::of(key, edge, 2);
    let (mut spread, next) = (how.deviation(room.length), libm::exp2(-how.hurst));
    let mut heights = [0.0; (1 << DEEPEST) + 1];
    for level in 0..depth {
        let stretch = count >> level;
        for middle in (stretch / 2..count).step_by(stretch) {
            let between = 0.5 * (heights[middle - stretch / 2] + heights[middle + stretch / 2]);
            heights[middle] = between + spread * noise.at(middle);
        }
        spread *= next;
    }
    let [a, b] = net.ends(edge);
    let (x, y) = ((b[0] - a[0]) / room.length, (b[1] - a[1]) / room.length);
    (1..count)
        .map(|i| {
            let part = i as f64 / count as f64;
            let height = room.within(part * room.length, heights[i]);
            [a[0] + part * (b[0] - a[0]) - height * y, a[1] + part * (b[1] - a[1]) + height * x]
        })
        .collect()
}

fn assemble(net: NetView<'_>, partner: &[i32], starts: &[usize], inner: &[Vec<Point>]) -> Rough {
    let pieces = starts[net.edges.len()];
    let mut rough = Rough { partner: Vec::with_capacity(2 * pieces), ..Rough::default() };
    rough.net.vertices = net.vertices.to_vec();
    rough.net.cut = net.cut.to_vec();
    rough.net.period = net.period;
    let end_of = |end: i32| match end {
        NONE => NONE,
        _ if end % 2 == 0 => 2 * starts[end as usize / 2] as i32,
        _ => 2 * starts[end as usize / 2 + 1] as i32 - 1,
    };
    for (k, &[from, to]) in net.edges.iter().enumerate() {
        let last = starts[k + 1] - 1;
        let mut before = from;
        for (i, piece) in (starts[k]..=last).enumerate() {
            let after = if piece == last { to } else { rough.net.vertices.len() as i32 };
            if piece < last {
                rough.net.vertices.push(inner[k][i]);
                rough.net.cut.push(false);
            }
            rough.net.edges.push([before, after]);
            rough.origin.push(k as i32);
            let (near, far) = (2 * piece as i32, 2 * piece as i32 + 1);
            rough.partner.push(if i == 0 { end_of(partner[2 * k]) } else { near - 1 });
            rough.partner.push(if piece == last { end_of(partner[2 * k + 1]) } else { far + 1 });
            if !net.shifts.is_empty() {
                rough.net.shifts.push(if piece == last { net.shifts[k] } else { [0, 0] });
            }
            before = after;
        }
    }
    rough
}
