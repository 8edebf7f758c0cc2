//! Drawings whose cracks know their age, and trimming them to bounds.

use super::fence::Fence;
use super::net::{Ends, NONE, Net};
use crate::clip::{Bounds, check_bounds};
use crate::error::Result;
use crate::graph::Point;

/// A drawing whose cracks know their age.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Aged {
    /// The cracks.
    pub net: Net,
    /// Room on both sides of every edge.
    pub fence: Fence,
    /// See [`super::pairs`].
    pub partner: Vec<i32>,
    /// Of the crack of each edge, low is old.
    pub age: Vec<i32>,
}

/// Ends of one age at one vertex continue each other.
pub(super) fn by_age(net: &Net, age: &[i32]) -> Vec<i32> {
    let ends = Ends::of(net.view());
    let mut partner = vec![NONE; 2 * net.edges.len()];
    let mut waiting: Vec<(i32, u32)> = Vec::new();
    for vertex in 0..net.vertices.len() {
        waiting.clear();
        waiting.extend(ends.at(vertex).iter().map(|&end| (age[end as usize / 2], end)));
        waiting.sort_unstable();
        let mut rest = &waiting[..];
        while let [(old, a), (young, b), ..] = *rest {
            rest = &rest[if old == young { 2 } else { 1 }..];
            if old == young {
                partner[a as usize] = b as i32;
                partner[b as usize] = a as i32;
            }
        }
    }
    partner
}

impl Aged {
    /// The part within bounds, in the plane: edges are cut there, and what stays is numbered anew.
    ///
    /// # Errors
    /// [`crate::Error::BadValue`] for bounds without an area.
    pub fn trimmed(self, bounds: Bounds) -> Result<Self> {
        check_bounds(bounds)?;
        let Self { mut net, fence, partner, age } = self;
        let (before, drawn) = (net.vertices.len(), net.edges.len());
        let mut kept = Vec::new();
        let mut number = vec![NONE; 2 * drawn];
        for k in 0..drawn {
            let Some(cuts) = within(net.edges[k].map(|v| net.vertices[v as usize]), bounds) else { continue };
            for (side, cut) in cuts.into_iter().enumerate() {
                number[2 * k + side] = 2 * kept.len() as i32 + side as i32;
                if let Some(place) = cut {
                    net.edges[k][side] = net.vertices.len() as i32;
                    net.vertices.push(place);
                    net.cut.push(true);
                }
            }
            kept.push(k);
        }
        // Vertices in use first; the others become anchors, which stay where they are.
        let mut row = vec![NONE; net.vertices.len()];
        kept.iter().flat_map(|&k| &net.edges[k]).for_each(|&vertex| row[vertex as usize] = 0);
        let used: Vec<usize> = (0..row.len()).filter(|&vertex| row[vertex] == 0).collect();
        let others: Vec<usize> = (0..before).filter(|&vertex| row[vertex] == NONE).collect();
        for (place, &vertex) in used.iter().chain(&others).enumerate() {
            row[vertex] = place as i32;
        }
        let points = (used.len() + others.len()) as i32;
        let renumbered = |point: i32| match point {
            NONE => NONE,
            _ if (point as usize) < before => row[point as usize],
            _ => points + point - before as i32,
        };
        let ends = |k: usize| net.edges[k].map(|vertex| row[vertex as usize]);
        let kite = |k: usize| {
            let [from, to, left, right] = fence.kites[k].map(renumbered);
            let [from, to] = if k < drawn { ends(k) } else { [from, to] };
            [from, to, left, right]
        };
        let partner_of = |end: usize| match partner[end] {
            // A cut end goes on outside.
            NONE => NONE,
            _ if net.edges[end / 2][end % 2] as usize >= before => NONE,
            other => number[other as usize],
        };
        Ok(Self {
            partner: kept.iter().flat_map(|&k| [2 * k, 2 * k + 1]).map(partner_of).collect(),
            age: kept.iter().filter_map(|&k| age.get(k).copied()).collect(),
            fence: Fence {
                anchors: others.iter().map(|&vertex| net.vertices[vertex]).chain(fence.anchors).collect(),
                kites: kept.iter().copied().chain(drawn..fence.kites.len()).map(kite).collect(),
                shifts: Vec::new(),
            },
            net: Net {
                vertices: used.iter().map(|&vertex| net.vertices[vertex]).collect(),
                edges: kept.iter().map(|&k| ends(k)).collect(),
                cut: used.iter().map(|&vertex| net.cut[vertex]).collect(),
                ..Net::default()
            },
        })
    }
}

/// Where a segment is cut by the bounds, at either end; None when no part of it lies within.
fn within([a, b]: [Point; 2], bounds: Bounds) -> Option<[Option<Point>; 2]> {
    let (mut start, mut end) = (0.0_f64, 1.0_f64);
    for i in 0..2 {
        let step = b[i] - a[i];
        let (low, high) = (bounds[i] - a[i], bounds[i + 2] - a[i]);
        if step == 0.0 {
            if low > 0.0 || high < 0.0 {
                return None;
            }
            continue;
        }
        let (near, far) = ((low / step).min(high / step), (low / step).max(high / step));
        start = start.max(near);
        end = end.min(far);
    }
    let at = |t: f64| [0, 1].map(|i| (a[i] + t * (b[i] - a[i])).clamp(bounds[i], bounds[i + 2]));
    (start < end).then(|| [(start > 0.0).then(|| at(start)), (end < 1.0).then(|| at(end))])
}
