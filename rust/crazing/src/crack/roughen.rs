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

/// Where rough edges lie, before they are a drawing of their own.
pub(super) struct Trace {
    /// Those of the drawing before, then the inner ones of edge after edge.
    pub(super) vertices: Vec<Point>,
    /// Where the pieces of each edge start, and the end; each has one more than inner vertices.
    pub(super) starts: Vec<usize>,
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
    let Trace { vertices, starts } = trace(net, partner, fence, how, key, watch)?;
    watch.poll()?;
    let mut cut = net.cut.to_vec();
    cut.resize(vertices.len(), false);
    let (edges, shifts) = (pieces_of(net, &starts), shifts_of(net, &starts));
    Ok(Rough {
        net: Net { vertices, edges, shifts, period: net.period, cut },
        partner: partners_of(partner, &starts),
        origin: repeated(&starts, |k| k as i32),
    })
}

/// See [`roughen`].
pub(super) fn trace(
    net: NetView<'_>,
    partner: &[i32],
    fence: FenceView<'_>,
    how: Roughness,
    key: Key,
    watch: Watch<'_>,
) -> Result<Trace> {
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
    let (old, edges) = (vertices.len(), net.edges.len());
    let depths = parallel::map(edges, |k| {
        halvings(&Room::of(moved, fence, k), &Bow::of(moved, partner, k, rounding), how) as u8
    });
    let mut starts = Vec::with_capacity(edges + 1);
    starts.push(0_usize);
    for (k, &depth) in depths.iter().enumerate() {
        starts.push(starts[k] + (1 << depth));
    }
    let found = starts[edges];
    const MOST: usize = (1 << 30) - 1;
    if found > MOST {
        return Err(Error::TooMany { what: "pieces of rough edges; a larger grain is wanted", found, limit: MOST });
    }
    watch.poll()?;
    let mut places = vec![[0.0; 2]; old + found - edges];
    places[..old].copy_from_slice(&vertices);
    parallel::grouped(
        edges,
        |k| starts[k] - k,
        &mut places[old..],
        |range, mut places| {
            let next = libm::exp2(-how.hurst);
            let mut heights = [0.0; (1 << DEEPEST) + 1];
            for k in range.filter(|&k| depths[k] > 0) {
                let own;
                (own, places) = places.split_at_mut((1 << depths[k]) - 1);
                let room = Room::of(moved, fence, k);
                let heights = &mut heights[..=1 << depths[k]];
                wavy(heights, how.deviation(room.length), next, key, k);
                place(moved, &room, &Bow::of(moved, partner, k, rounding), heights, k, own);
            }
        },
    );
    Ok(Trace { vertices: places, starts })
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

/// Finds the places of the inner vertices of an edge.
fn place(net: NetView<'_>, room: &Room, bow: &Bow, heights: &[f64], edge: usize, places: &mut [Point]) {
    let count = heights.len() - 1;
    let [a, b] = net.ends(edge);
    let (x, y) = ((b[0] - a[0]) / room.length, (b[1] - a[1]) / room.length);
    let (is_straight, step) = (bow.is_straight(), 1.0 / count as f64);
    for (place, i) in places.iter_mut().zip(1..count) {
        // Exact: there are a power of two.
        let part = i as f64 * step;
        let bent = if is_straight { 0.0 } else { room.length * bow.height(part) };
        let height = room.within(part * room.length, bent + heights[i]);
        *place = [a[0] + part * (b[0] - a[0]) - height * y, a[1] + part * (b[1] - a[1]) + height * x];
    }
}

/// Piece `i` of edge `k` is edge `starts[k] + i`; the inner vertices follow the old ones in the order of the pieces.
pub(super) fn pieces_of(net: NetView<'_>, starts: &[usize]) -> Vec<[i32; 2]> {
    let old = net.vertices.len();
    let mut pieces = vec![[0; 2]; starts[net.edges.len()]];
    parallel::grouped(
        net.edges.len(),
        |k| starts[k],
        &mut pieces,
        |range, pieces| {
            let first = starts[range.start];
            for k in range {
                for piece in starts[k]..starts[k + 1] {
                    // The vertex after the piece; every edge before has one piece more than inner vertices.
                    let after = (old + piece - k) as i32;
                    pieces[piece - first] = [after - 1, after];
                }
                pieces[starts[k] - first][0] = net.edges[k][0];
                pieces[starts[k + 1] - 1 - first][1] = net.edges[k][1];
            }
        },
    );
    pieces
}

/// The last piece of an edge crosses what the edge crosses.
pub(super) fn shifts_of(net: NetView<'_>, starts: &[usize]) -> Vec<[i8; 2]> {
    let mut shifts = vec![[0; 2]; if net.shifts.is_empty() { 0 } else { starts[net.edges.len()] }];
    net.shifts.iter().zip(&starts[1..]).for_each(|(&shift, &end)| shifts[end - 1] = shift);
    shifts
}

/// Pieces of one edge continue each other; its ends go on as before.
fn partners_of(partner: &[i32], starts: &[usize]) -> Vec<i32> {
    let end_of = |end: i32| match end {
        NONE => NONE,
        _ if end % 2 == 0 => 2 * starts[end as usize / 2] as i32,
        _ => 2 * starts[end as usize / 2 + 1] as i32 - 1,
    };
    let edges = partner.len() / 2;
    let mut partners = vec![NONE; 2 * starts[edges]];
    parallel::grouped(
        edges,
        |k| 2 * starts[k],
        &mut partners,
        |range, partners| {
            let first = 2 * starts[range.start];
            for k in range {
                let (start, end) = (2 * starts[k], 2 * starts[k + 1]);
                for near in (start + 1..end - 1).step_by(2) {
                    partners[near - first] = near as i32 + 1;
                    partners[near + 1 - first] = near as i32;
                }
                partners[start - first] = end_of(partner[2 * k]);
                partners[end - 1 - first] = end_of(partner[2 * k + 1]);
            }
        },
    );
    partners
}

/// `value` of each edge, for each of its pieces.
pub(super) fn repeated(starts: &[usize], value: impl Fn(usize) -> i32 + Sync + Send) -> Vec<i32> {
    let edges = starts.len() - 1;
    let mut values = vec![0; starts[edges]];
    parallel::grouped(
        edges,
        |k| starts[k],
        &mut values,
        |range, values| {
            let first = starts[range.start];
            range.for_each(|k| values[starts[k] - first..starts[k + 1] - first].fill(value(k)));
        },
    );
    values
}
