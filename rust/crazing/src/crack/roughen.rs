//! Rough cracks: 1/f wandering about their straight edges, pinned at the nodes.

mod bridge;
mod fineness;
pub(super) mod pieces;

use super::bow::Bow;
use super::fence::FenceView;
use super::guard::Guard;
use super::net::{Ends, Net, NetView};
use super::room::Room;
use crate::error::{Error, Result};
use crate::graph::Point;
use crate::parallel;
use crate::rng::Key;
use crate::watch::Watch;
use bridge::{Bridge, wavy};
use fineness::{DEEPEST, Fineness, levels};
use pieces::{partners_of, pieces_of, repeated, shifts_of};

/// How cracks wander.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Roughness {
    /// Standard deviation, in the middle, of a crack as long as `unit`, as a part of it.
    pub amplitude: f64,
    /// Deviation grows with this power of length: .5 is a random walk, .7 is what real cracks show.
    pub hurst: f64,
    /// The length that `amplitude` is about, data units.
    pub unit: f64,
    /// Edges are halved until no longer than this, data units, or until they would be next to straight: see
    /// [`roughen`].
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
    /// Who meets where in the drawing before, if that had to be known.
    pub(super) ends: Option<Ends>,
}

/// How much more of rough edges is wanted than their grain has.
pub(super) struct Detail<'a> {
    /// See [`Roughness::grain`]; a finer one.
    pub(super) grain: f64,
    /// The widths at both ends of the edges of a drawing.
    pub(super) widths: &'a dyn Fn(NetView<'_>) -> Result<Vec<[f64; 2]>>,
}

/// Pieces that are placed between two looks at the watch: all of an ordinary pattern.
const AT_ONCE: usize = 1 << 21;

/// Subdivides edges and moves the new vertices across them, after moving the vertices inside each crack: along the
/// bow that its turns ask for, and about that at random.
///
/// Between nodes (vertices of other degree than 2, cut ends) a crack is a bridge of fractional Brownian motion by
/// midpoint displacement. Vertices move behind the fence, see [`super::Fence`]; every edge wanders in its own kite, a
/// region no other edge enters, and forward only: topology stays, and nothing new crosses.
///
/// Edges are halved until their pieces are no longer than `grain`, or until the middle of a piece lies off its chord by
/// no more than a 25th of `grain` (the standard deviation of its wandering) and a 40th (its bow). Those with a free tip
/// are halved to the grain.
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
    let Trace { vertices, starts, .. } = trace(net, Chains::of(net, watch)?, partner, fence, (how, key), None, watch)?;
    watch.poll()?;
    let mut cut = net.cut.to_vec();
    cut.resize(vertices.len(), false);
    let (edges, shifts) = (pieces_of(net, &starts), shifts_of(net, &starts));
    watch.poll()?;
    let partner = partners_of(partner, &starts);
    watch.poll()?;
    let origin = repeated(&starts, |k| k as i32);
    Ok(Rough { net: Net { vertices, edges, shifts, period: net.period, cut }, partner, origin })
}

/// See [`roughen`].
pub(super) fn trace(
    net: NetView<'_>,
    chains: Chains,
    partner: &[i32],
    fence: FenceView<'_>,
    (how, key): (Roughness, Key),
    detail: Option<&Detail<'_>>,
    watch: Watch<'_>,
) -> Result<Trace> {
    let Roughness { amplitude, hurst, unit, grain, rounding } = how;
    let given = [("roughness", amplitude), ("hurst", hurst), ("unit", unit), ("grain", grain), ("rounding", rounding)];
    for (name, value) in given {
        if !(value.is_finite() && value >= 0.0) {
            return Err(Error::BadValue { name, value, wanted: "a finite number of at least 0 is wanted" });
        }
    }
    let (vertices, ends) = wander(net, chains, fence, how, key, watch)?;
    let moved = NetView { vertices: &vertices, ..net };
    watch.poll()?;
    let (old, edges) = (vertices.len(), net.edges.len());
    let depths = depths(moved, (partner, &ends), fence, how, detail)?;
    let mut starts = Vec::with_capacity(edges + 1);
    starts.push(0_usize);
    for (k, &[depth, _]) in depths.iter().enumerate() {
        starts.push(starts[k] + (1 << depth));
    }
    let found = starts[edges];
    const MOST: usize = (1 << 30) - 1;
    if found > MOST {
        return Err(Error::TooMany { what: "pieces of rough edges; a larger grain is wanted", found, limit: MOST });
    }
    watch.poll()?;
    let mut places = vec![[0.0; 2]; old + found - edges];
    parallel::fill(&mut places[..old], |range, part| part.copy_from_slice(&vertices[range]));
    let next = libm::exp2(-how.hurst);
    let places_of = |k: usize, own: &mut [Point], (heights, numbers): (&mut [f64], &mut [f64])| {
        let room = Room::of(moved, fence, k);
        wavy(heights, numbers, (how.deviation(room.length), next, depths[k][1]), key, k);
        place(moved, &room, &Bow::of(moved, partner, k, rounding), heights, k, own);
    };
    place_all(&starts, &mut places[old..], places_of, watch)?;
    Ok(Trace { vertices: places, starts, ends: Some(ends) })
}

/// How often each edge is halved, and on how many levels it wanders.
fn depths(
    net: NetView<'_>,
    (partner, ends): (&[i32], &Ends),
    fence: FenceView<'_>,
    how: Roughness,
    detail: Option<&Detail<'_>>,
) -> Result<Vec<[u8; 2]>> {
    let own = Fineness::of(how);
    let more = match detail {
        Some(&Detail { grain, widths }) => Some((Fineness::of(Roughness { grain, ..how }), widths(net)?)),
        None => None,
    };
    let finest = more.as_ref().map_or(how.grain, |(fineness, _)| fineness.grain);
    Ok(parallel::map(net.edges.len(), |k| {
        if net.length(k) <= finest {
            return [0; 2];
        }
        let is_tip = net.edges[k].iter().any(|&end| ends.at(end as usize).len() == 1 && !net.cut[end as usize]);
        let (room, bow) = (Room::of(net, fence, k), Bow::of(net, partner, k, how.rounding));
        let depth = own.halvings(&room, &bow, is_tip, DEEPEST);
        let Some((fineness, widths)) = &more else { return [depth as u8, DEEPEST as u8] };
        let levels = levels(depth, room.length, 0.5 * (widths[k][0] + widths[k][1]));
        [fineness.halvings(&room, &bow, is_tip, levels), levels].map(|count| count as u8)
    }))
}

/// The cracks of a drawing from node to node, as chains of edges.
pub(super) struct Chains {
    /// Who meets where.
    ends: Ends,
    /// The ends to enter edges by, chain after chain; those without inner vertices are left out.
    entries: Vec<u32>,
    /// Where each chain starts, and the end.
    starts: Vec<usize>,
}

impl Chains {
    pub(super) fn of(net: NetView<'_>, watch: Watch<'_>) -> Result<Self> {
        let ends = Ends::of(net);
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
        Ok(Self { ends, entries, starts })
    }
}

/// Moves the vertices of degree 2 across their crack, and gives back who meets where.
fn wander(
    net: NetView<'_>,
    Chains { ends, entries, starts }: Chains,
    fence: FenceView<'_>,
    how: Roughness,
    key: Key,
    watch: Watch<'_>,
) -> Result<(Vec<Point>, Ends)> {
    let mut guard = Guard::of(net, fence);
    let moves = parallel::ranges(starts.len() - 1, |range| {
        let (mut bridge, mut moves) = (Bridge::default(), Vec::new());
        for i in range {
            let chain = &entries[starts[i]..starts[i + 1]];
            bridge.over(net, how, key, chain);
            bend(net, &guard, &bridge.heights, chain, &mut moves);
        }
        moves
    });
    // Those that wait for others go in the order of their cracks.
    let (mut goals, mut turns) = (guard.places(), vec![u32::MAX; net.vertices.len()]);
    for ((vertex, goal), turn) in moves.into_iter().flatten().zip(0..) {
        (goals[vertex as usize], turns[vertex as usize]) = (goal, turn);
    }
    guard.advance(|_, vertex| goals[vertex], Some(&turns), watch)?;
    Ok((guard.into_vertices(), ends))
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

/// Finds the places of the inner vertices of all edges, edge by edge, with room for heights and numbers.
fn place_all(
    starts: &[usize],
    mut rest: &mut [Point],
    places_of: impl Fn(usize, &mut [Point], (&mut [f64], &mut [f64])) + Sync + Send,
    watch: Watch<'_>,
) -> Result<()> {
    let mut first = 0;
    while first + 1 < starts.len() {
        watch.poll()?;
        let inner = |k: usize| starts[first + k] - starts[first] - k;
        let count = starts[first + 1..].partition_point(|&start| start - starts[first] <= AT_ONCE).max(1);
        let own;
        (own, rest) = rest.split_at_mut(inner(count));
        parallel::grouped(count, inner, own, |range, mut places| {
            let (mut heights, mut numbers) = ([0.0; (1 << DEEPEST) + 1], [0.0; 1 << DEEPEST]);
            for k in range.map(|k| first + k) {
                let pieces = starts[k + 1] - starts[k];
                if pieces > 1 {
                    let own;
                    (own, places) = places.split_at_mut(pieces - 1);
                    places_of(k, own, (&mut heights[..=pieces], &mut numbers[..pieces]));
                }
            }
        });
        first += count;
    }
    Ok(())
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
        let height = room.within(part * room.length, bent, heights[i]);
        *place = [a[0] + part * (b[0] - a[0]) - height * y, a[1] + part * (b[1] - a[1]) + height * x];
    }
}
