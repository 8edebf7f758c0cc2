//! The room about each edge of an impact: no edge but its own is in it.

use super::OFF;
use crate::crack::net::{Ends, NetView};
use crate::graph::Point;
use crate::parallel;

/// How near the room about an edge comes to its neighbours.
const ROOM: f64 = 0.25;
/// Where a fork leaves at a narrow angle, this part of it.
const SHARP: f64 = 0.25;
/// How near it comes to a crack of a copy, as a part of the way, and of the angle between the two.
const APART: f64 = 0.4;
/// Where more edges than this meet, they are spokes about the source.
const CROWD: usize = 64;

/// An edge, moved by whole periods: the vertices it joins and where they are.
#[derive(Clone, Copy)]
struct Piece {
    edge: usize,
    ends: [(i32, [i8; 2]); 2],
    at: [Point; 2],
    length: f64,
}

impl Piece {
    fn of(net: NetView<'_>, edge: usize, copy: [i8; 2]) -> Self {
        let shift = net.shift(edge);
        let to = [copy[0] + shift[0], copy[1] + shift[1]];
        let [a, b] = net.edges[edge];
        let at = [(a, copy), (b, to)].map(|(vertex, by)| net.moved(net.vertices[vertex as usize], by));
        let length = libm::hypot(at[1][0] - at[0][0], at[1][1] - at[0][1]);
        Self { edge, ends: [(a, copy), (b, to)], at, length }
    }

    /// Whether the boxes about both, grown by a margin, have nothing in common.
    fn is_beyond(&self, other: &Self, margin: f64) -> bool {
        [0, 1].iter().any(|&axis| {
            let [a, b] = [self, other].map(|piece| piece.at.map(|p| p[axis]));
            a[0].max(a[1]) + margin < b[0].min(b[1]) || b[0].max(b[1]) + margin < a[0].min(a[1])
        })
    }

    /// How far from the middle of this edge its room may lie for that of another one.
    fn clear_of(&self, other: &Self) -> f64 {
        for (i, end) in self.ends.iter().enumerate() {
            if let Some(j) = other.ends.iter().position(|at| at == end) {
                let along =
                    |piece: &Self, from: usize| [0, 1].map(|axis| piece.at[1 - from][axis] - piece.at[from][axis]);
                let (a, b) = (along(self, i), along(other, j));
                let angle = libm::atan2((a[0] * b[1] - a[1] * b[0]).abs(), a[0] * b[0] + a[1] * b[1]);
                return 0.5 * self.length * libm::tan(APART * angle);
            }
        }
        let from = |p: Point, piece: &Self| {
            let [a, b] = piece.at;
            let (x, y) = (b[0] - a[0], b[1] - a[1]);
            let part = ((p[0] - a[0]) * x + (p[1] - a[1]) * y) / (x * x + y * y).max(f64::MIN_POSITIVE);
            let part = part.clamp(0.0, 1.0);
            libm::hypot(p[0] - a[0] - part * x, p[1] - a[1] - part * y)
        };
        // Edges do not cross: their distance is that of an end.
        let ends = self.at.iter().map(|&p| from(p, other)).chain(other.at.iter().map(|&p| from(p, self)));
        APART * ends.fold(f64::INFINITY, f64::min)
    }
}

/// Two places beside every edge, one to its left and one to its right.
///
/// Nearer than any other edge of the impact: neighbours leave its ends at about a right angle, other spokes are an angle
/// away, other arcs a part of the distance to the source. Edges that are `new` are among those of copies: about them,
/// everything is looked at.
pub(super) fn rooms(
    net: NetView<'_>,
    source: Point,
    narrowest: f64,
    is_fork: &[bool],
    new: &[usize],
) -> Vec<[Point; 2]> {
    let mut is_new = vec![false; net.edges.len()];
    new.iter().for_each(|&edge| is_new[edge] = true);
    let mut most: Vec<f64> = parallel::map(net.edges.len(), |k| {
        let Piece { at: [a, b], length, .. } = Piece::of(net, k, [0; 2]);
        let far = libm::hypot(0.5 * (a[0] + b[0]) - source[0], 0.5 * (a[1] + b[1]) - source[1]);
        let narrow = if is_new[k] { f64::INFINITY } else { (far * narrowest).min(OFF * far) };
        let part = if net.edges[k].iter().any(|&end| is_fork[end as usize]) { SHARP } else { 1.0 };
        part * ROOM * length.min(narrow)
    });
    for (k, limit) in at_vertices(net) {
        most[k] = most[k].min(limit);
    }
    if !new.is_empty() {
        let near = beside(net, new, &most);
        let limits = parallel::ranges(net.edges.len(), |range| {
            let mut limits = Vec::new();
            for k in range {
                let piece = Piece::of(net, k, [0; 2]);
                for other in &near {
                    let margin = (most[k] + most[other.edge]) / APART;
                    if (other.edge != k || other.ends != piece.ends) && !piece.is_beyond(other, margin) {
                        limits.push((k, piece.clear_of(other)));
                        limits.push((other.edge, other.clear_of(&piece)));
                    }
                }
            }
            limits
        });
        limits.into_iter().flatten().for_each(|(k, limit)| most[k] = most[k].min(limit));
    }
    parallel::map(net.edges.len(), |k| {
        let Piece { at: [a, b], length, .. } = Piece::of(net, k, [0; 2]);
        let middle = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
        let part = most[k] / length.max(f64::MIN_POSITIVE);
        let (x, y) = (part * (b[0] - a[0]), part * (b[1] - a[1]));
        [[middle[0] - y, middle[1] + x], [middle[0] + y, middle[1] - x]]
    })
}

/// How far the rooms of edges may lie from their middles for those that meet them, but for the very busiest vertices.
fn at_vertices(net: NetView<'_>) -> Vec<(usize, f64)> {
    let ends = Ends::of(net);
    let mut limits = Vec::new();
    for here in (0..net.vertices.len()).map(|vertex| ends.at(vertex)).filter(|here| here.len() <= CROWD) {
        // Both seen from the vertex.
        let seen = |end: u32| {
            let (edge, side) = (end as usize / 2, end as usize % 2);
            let whole = Piece::of(net, edge, [0; 2]);
            Piece::of(net, edge, if side == 0 { [0; 2] } else { whole.ends[1].1.map(|turns| -turns) })
        };
        for (i, &one) in here.iter().enumerate() {
            for &other in &here[i + 1..] {
                let (one, other) = (seen(one), seen(other));
                limits.push((one.edge, one.clear_of(&other)));
                limits.push((other.edge, other.clear_of(&one)));
            }
        }
    }
    limits
}

/// Some edges in all copies that come near any edge.
fn beside(net: NetView<'_>, new: &[usize], most: &[f64]) -> Vec<Piece> {
    let all = (0..net.edges.len()).map(|k| Piece::of(net, k, [0; 2]));
    let (mut low, mut high, mut longest) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2], 0.0_f64);
    for piece in all {
        for p in piece.at {
            low = [0, 1].map(|axis| low[axis].min(p[axis]));
            high = [0, 1].map(|axis| high[axis].max(p[axis]));
        }
        longest = longest.max(most[piece.edge]);
    }
    let around = [0, 1].map(|axis| ((high[axis] - low[axis]) / net.period[axis]).ceil().min(63.0) as i8);
    let whole = Piece { edge: 0, ends: [(0, [0; 2]); 2], at: [low, high], length: 0.0 };
    let copies = |&edge: &usize| {
        let all = (-around[0]..=around[0]).flat_map(move |x| (-around[1]..=around[1]).map(move |y| [x, y]));
        all.map(move |copy| Piece::of(net, edge, copy))
    };
    new.iter().flat_map(copies).filter(|piece| !piece.is_beyond(&whole, 2.0 * longest / APART)).collect()
}
