//! Rough cracks: 1/f wandering about their straight edges, pinned at the nodes.

mod bridge;

use super::bow::Bow;
use super::fence::{FenceView, Guard};
use super::net::{Ends, NONE, Net, NetView};
use super::room::Room;
use crate::error::{Error, Result};
use crate::graph::Point;
use crate::parallel;
use crate::rng::Key;
use crate::watch::Watch;
use bridge::{Bridge, wavy};

/// Most halvings of one edge.
const DEEPEST: u32 = 8;
/// An edge is not subdivided when its kite is thinner than this part of its length: roundings could leave it.
const THIN: f64 = 1e-6;
/// Edges whose pieces are put together at a time.
const TOGETHER: usize = 1 << 12;

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
    /// How far edges are bent so that a crack turns smoothly from one to the next: 0 not at all, 1 all the way.
    pub rounding: f64,
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

/// Subdivides edges and moves the new vertices across them, after moving the vertices inside each crack: along the
/// bow that its turns ask for, and about that at random.
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
    let Roughness { amplitude, hurst, unit, grain, rounding } = how;
    let given = [("roughness", amplitude), ("hurst", hurst), ("unit", unit), ("grain", grain), ("rounding", rounding)];
    for (name, value) in given {
        if !(value.is_finite() && value >= 0.0) {
            return Err(Error::BadValue { name, value, wanted: "a finite number of at least 0 is wanted" });
        }
    }
    let vertices = wander(net, fence, how, key, watch)?;
    let moved = NetView { vertices: &vertices, ..net };
    watch.poll()?;
    let depths = parallel::map(net.edges.len(), |k| {
        halvings(&Room::of(moved, fence, k), &Bow::of(moved, partner, k, rounding), how) as u8
    });
    let mut starts = Vec::with_capacity(depths.len() + 1);
    starts.push(0_usize);
    for (k, &depth) in depths.iter().enumerate() {
        starts.push(starts[k] + (1 << depth));
    }
    let found = starts[net.edges.len()];
    const MOST: usize = (1 << 30) - 1;
    if found > MOST {
        return Err(Error::TooMany { what: "pieces of rough edges; a larger grain is wanted", found, limit: MOST });
    }
    watch.poll()?;
    let inner = parallel::ranges(net.edges.len(), |range| {
        let mut places = Vec::with_capacity(starts[range.end] - starts[range.start] - range.len());
        let next = libm::exp2(-how.hurst);
        let mut heights = [0.0; (1 << DEEPEST) + 1];
        for k in range.filter(|&k| depths[k] > 0) {
            let room = Room::of(moved, fence, k);
            let heights = &mut heights[..=1 << depths[k]];
            wavy(heights, how.deviation(room.length), next, key, k);
            pieces(moved, &room, &Bow::of(moved, partner, k, rounding), heights, k, &mut places);
        }
        places
    });
    watch.poll()?;
    Ok(assemble(moved, partner, &starts, &inner))
}

/// Moves the vertices of degree 2 across their crack.
fn wander(net: NetView<'_>, fence: FenceView<'_>, how: Roughness, key: Key, watch: Watch<'_>) -> Result<Vec<Point>> {
    let ends = Ends::of(net);
    let mut guard = Guard::of(net, fence);
    let mut seen = vec![false; net.edges.len()];
    let is_node = |vertex: usize| ends.at(vertex).len() != 2 || net.cut[vertex];
    let all = 0..2 * net.edges.len() as u32;
    let from_nodes = all.clone().filter(|&end| is_node(net.vertex(end)));
    let (mut entries, mut starts) = (Vec::new(), vec![0]);
    for (step, end) in from_nodes.chain(all).enumerate() {
        watch.poll_at(step)?;
        if seen[end as usize / 2] {
            continue;
        }
        chain(net, &ends, end, &mut seen, is_node, &mut entries);
        // What has no inner vertex does not wander.
        if entries.len() - starts[starts.len() - 1] < 2 {
            entries.truncate(starts[starts.len() - 1]);
        } else {
            starts.push(entries.len());
        }
    }
    let moves = parallel::ranges(starts.len() - 1, |range| {
        let (mut bridge, mut moves) = (Bridge::default(), Vec::new());
        for i in range {
            let chain = &entries[starts[i]..starts[i + 1]];
            bridge.over(net, how, key, chain);
            bend(net, &guard, &bridge.heights, chain, &mut moves);
        }
        moves
    });
    guard.advance(&moves.concat(), watch)?;
    Ok(guard.into_vertices())
}

/// Where the vertices along a chain go.
fn bend(net: NetView<'_>, guard: &Guard<'_>, heights: &[f64], chain: &[u32], moves: &mut Vec<(u32, Point)>) {
    for (pair, height) in chain.windows(2).zip(&heights[1..]) {
        let (before, after) = (net.along(pair[0]), net.along(pair[1]));
        let across = [-(before[1] + after[1]), before[0] + after[0]];
        let length = libm::hypot(across[0], across[1]);
        if length > 0.0 {
            let (vertex, step) = (net.vertex(pair[1]), across.map(|part| height * part / length));
            moves.push((vertex as u32, guard.shoved(vertex, step)));
        }
    }
}

/// Adds the ends to enter edges by, from one node to the next, or once around a ring.
fn chain(
    net: NetView<'_>,
    ends: &Ends,
    start: u32,
    seen: &mut [bool],
    is_node: impl Fn(usize) -> bool,
    chain: &mut Vec<u32>,
) {
    let mut end = start;
    while !std::mem::replace(&mut seen[end as usize / 2], true) {
        chain.push(end);
        let out = end ^ 1;
        let vertex = net.vertex(out);
        match ends.at(vertex) {
            &[a, b] if !is_node(vertex) => end = if a == out { b } else { a },
            _ => break,
        }
    }
}

/// How often an edge is halved.
fn halvings(room: &Room, bow: &Bow, how: Roughness) -> u32 {
    let across = room.sides[0][1].max(room.sides[1][1]);
    if !(how.grain > 0.0 && room.length.is_finite() && across > THIN * room.length)
        || (how.amplitude == 0.0 && bow.is_straight())
    {
        return 0;
    }
    let mut depth = 0;
    while depth < DEEPEST && room.length > how.grain * f64::from(1 << depth) {
        depth += 1;
    }
    depth
}

/// Adds the places of the inner vertices of an edge.
fn pieces(net: NetView<'_>, room: &Room, bow: &Bow, heights: &[f64], edge: usize, places: &mut Vec<Point>) {
    let count = heights.len() - 1;
    let [a, b] = net.ends(edge);
    let (x, y) = ((b[0] - a[0]) / room.length, (b[1] - a[1]) / room.length);
    places.extend((1..count).map(|i| {
        let part = i as f64 / count as f64;
        let bent = if bow.is_straight() { 0.0 } else { room.length * bow.height(part) };
        let height = room.within(part * room.length, bent + heights[i]);
        [a[0] + part * (b[0] - a[0]) - height * y, a[1] + part * (b[1] - a[1]) + height * x]
    }));
}

/// Piece `i` of edge `k` is edge `starts[k] + i`; the inner vertices follow the old ones in the order of the pieces.
fn assemble(net: NetView<'_>, partner: &[i32], starts: &[usize], inner: &[Vec<Point>]) -> Rough {
    let (old, edges, count) = (net.vertices.len(), net.edges.len(), starts[net.edges.len()]);
    let mut rough = Rough {
        net: Net { edges: vec![[0; 2]; count], period: net.period, ..Net::default() },
        partner: vec![NONE; 2 * count],
        origin: vec![0; count],
    };
    let end_of = |end: i32| match end {
        NONE => NONE,
        _ if end % 2 == 0 => 2 * starts[end as usize / 2] as i32,
        _ => 2 * starts[end as usize / 2 + 1] as i32 - 1,
    };
    let some = (0..edges).step_by(TOGETHER).map(|from| from..edges.min(from + TOGETHER));
    let cuts = some.clone().map(|range| starts[range.end] - starts[range.start]);
    let own = parallel::shared(&mut rough.net.edges, cuts.clone());
    let partners = parallel::shared(rough.partner.as_chunks_mut::<2>().0, cuts.clone());
    let origins = parallel::shared(&mut rough.origin, cuts);
    let parts = some.zip(own).zip(partners).zip(origins).collect();
    parallel::parts(count, parts, |(((range, own), partners), origins)| {
        let first = starts[range.start];
        for k in range {
            let (start, end) = (starts[k], starts[k + 1]);
            for piece in start..end {
                // The vertex after the piece; every edge before has one piece more than inner vertices.
                let after = (old + piece - k) as i32;
                let (near, far) = (2 * piece as i32, 2 * piece as i32 + 1);
                own[piece - first] = [after - 1, after];
                partners[piece - first] = [near - 1, far + 1];
            }
            origins[start - first..end - first].fill(k as i32);
            let (start, last) = (start - first, end - 1 - first);
            own[start][0] = net.edges[k][0];
            own[last][1] = net.edges[k][1];
            partners[start][0] = end_of(partner[2 * k]);
            partners[last][1] = end_of(partner[2 * k + 1]);
        }
    });
    if !net.shifts.is_empty() {
        rough.net.shifts = vec![[0; 2]; count];
        net.shifts.iter().zip(&starts[1..]).for_each(|(&shift, &end)| rough.net.shifts[end - 1] = shift);
    }
    let vertices: Vec<&[Point]> = [net.vertices].into_iter().chain(inner.iter().map(Vec::as_slice)).collect();
    rough.net.vertices = vertices.concat();
    rough.net.cut = net.cut.to_vec();
    rough.net.cut.resize(rough.net.vertices.len(), false);
    rough
}
