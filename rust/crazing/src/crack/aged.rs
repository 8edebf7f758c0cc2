//! Drawings whose cracks know their age, and trimming them to bounds.

use super::fence::{Fence, FenceView};
use super::net::{Ends, NONE, Net, NetView};
use crate::clip::{Bounds, check_bounds};
use crate::error::Result;
use crate::graph::Point;
use crate::parallel;

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
    /// See [`trimmed`].
    ///
    /// # Errors
    /// [`crate::Error::BadValue`] for bounds without an area.
    pub fn trimmed(&self, bounds: Bounds) -> Result<Self> {
        trimmed(self.net.view(), self.fence.view(), &self.partner, &self.age, bounds)
    }
}

/// The part of a drawing within bounds, in the plane: edges are cut there, and what stays is numbered anew.
///
/// # Errors
/// [`crate::Error::BadValue`] for bounds without an area.
pub fn trimmed(net: NetView<'_>, fence: FenceView<'_>, partner: &[i32], age: &[i32], bounds: Bounds) -> Result<Aged> {
    check_bounds(bounds)?;
    let (before, drawn) = (net.vertices.len(), net.edges.len());
    let Kept { rows: kept, ends, number, places } = Kept::of(net, bounds);
    // Vertices in use first; the others become anchors, which stay where they are.
    let mut row = vec![NONE; before + places.len()];
    ends.iter().flatten().for_each(|&vertex| row[vertex as usize] = 0);
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
    let edges = parallel::map(kept.len(), |i| ends[i].map(|vertex| row[vertex as usize]));
    let kites = parallel::map(kept.len() + fence.kites.len() - drawn, |i| match kept.get(i) {
        Some(&k) => {
            let [_, _, left, right] = fence.kites[k].map(renumbered);
            [edges[i][0], edges[i][1], left, right]
        }
        None => fence.kites[drawn + i - kept.len()].map(renumbered),
    });
    let partner_of = |i: usize, side: usize| match partner[2 * kept[i] + side] {
        // A cut end goes on outside.
        NONE => NONE,
        _ if ends[i][side] as usize >= before => NONE,
        other => number[other as usize],
    };
    let place = |vertex: usize| *net.vertices.get(vertex).unwrap_or_else(|| &places[vertex - before]);
    Ok(Aged {
        partner: parallel::map(2 * kept.len(), |end| partner_of(end / 2, end % 2)),
        age: kept.iter().filter_map(|&k| age.get(k).copied()).collect(),
        fence: Fence {
            anchors: others.iter().map(|&vertex| net.vertices[vertex]).chain(fence.anchors.iter().copied()).collect(),
            kites,
            shifts: Vec::new(),
        },
        net: Net {
            vertices: parallel::map(used.len(), |i| place(used[i])),
            edges,
            cut: used.iter().map(|&vertex| vertex >= before || net.cut[vertex]).collect(),
            ..Net::default()
        },
    })
}

/// The edges of which a part lies within bounds.
struct Kept {
    rows: Vec<usize>,
    /// Their vertices; numbers after those of the drawing are places on the bounds.
    ends: Vec<[i32; 2]>,
    /// What the ends of all edges are now, or -1.
    number: Vec<i32>,
    /// Where edges are cut.
    places: Vec<Point>,
}

impl Kept {
    fn of(net: NetView<'_>, bounds: Bounds) -> Self {
        let (before, drawn) = (net.vertices.len(), net.edges.len());
        let inside = parallel::map(drawn, |k| within(net.edges[k].map(|v| net.vertices[v as usize]), bounds));
        let (rows, ends, places) = (Vec::with_capacity(drawn), Vec::with_capacity(drawn), Vec::new());
        let mut kept = Self { rows, ends, number: vec![NONE; 2 * drawn], places };
        for (k, cuts) in inside.into_iter().enumerate() {
            let (Some(cuts), mut edge) = (cuts, net.edges[k]) else { continue };
            for (side, cut) in cuts.into_iter().enumerate() {
                kept.number[2 * k + side] = 2 * kept.rows.len() as i32 + side as i32;
                if let Some(place) = cut {
                    edge[side] = (before + kept.places.len()) as i32;
                    kept.places.push(place);
                }
            }
            kept.rows.push(k);
            kept.ends.push(edge);
        }
        kept
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
