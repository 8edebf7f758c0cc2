//! Drawings whose cracks know their age, and trimming them to bounds.

use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

use super::fence::{Fence, FenceView};
use super::net::{Ends, NONE, Net, NetView};
use crate::clip::{Bounds, check_bounds, on_side};
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
    let kept = Kept::of(net, bounds);
    let mut number = vec![NONE; net.edges.len()];
    kept.rows.iter().zip(0..).for_each(|(&row, place)| number[row as usize] = place);
    let partner_of = |end: usize| match partner[2 * kept.rows[end / 2] as usize + end % 2] {
        // A cut end goes on outside.
        _ if kept.ends[end / 2][end % 2] as usize >= net.vertices.len() => NONE,
        NONE => NONE,
        other if number[other as usize / 2] == NONE => NONE,
        other => 2 * number[other as usize / 2] + other % 2,
    };
    let partner = parallel::map(2 * kept.rows.len(), partner_of);
    let age = kept.rows.iter().filter_map(|&k| age.get(k as usize).copied()).collect();
    let (net, fence) = kept.drawn(net, fence);
    Ok(Aged { net, fence, partner, age })
}

/// A drawing in the plane under an affine map, `matrix` by rows and then `centre`, and the part of it within bounds.
///
/// # Errors
/// [`crate::Error::BadValue`] for bounds without an area.
pub fn stretched(
    net: NetView<'_>,
    fence: FenceView<'_>,
    matrix: [Point; 2],
    centre: Point,
    bounds: Bounds,
) -> Result<(Net, Fence)> {
    check_bounds(bounds)?;
    let mapped = |points: &[Point]| {
        parallel::map(points.len(), |i| {
            let [x, y] = points[i];
            [0, 1].map(|k| matrix[k][0] * x + matrix[k][1] * y + centre[k])
        })
    };
    let (vertices, anchors) = (mapped(net.vertices), mapped(fence.anchors));
    let net = NetView { vertices: &vertices, ..net };
    let (mut net, mut fence) = Kept::of(net, bounds).drawn(net, FenceView { anchors: &anchors, ..fence });
    // What was cut before it was mapped lies on the bounds where the map turns nothing, but for rounding.
    for (p, _) in net.vertices.iter_mut().zip(&net.cut).filter(|(_, cut)| **cut) {
        *p = on_side(*p, bounds);
    }
    trim_doors(&net, &mut fence, bounds);
    fence.draw_in(&net.vertices, bounds);
    Ok((net, fence))
}

/// Cuts the kites about edges that are not drawn as well, in the fence of a maze: no two share a corner but at places
/// that stay, and at vertices of the drawing, which lie within.
fn trim_doors(net: &Net, fence: &mut Fence, bounds: Bounds) {
    let (drawn, vertices) = (net.edges.len(), net.vertices.len());
    let doors = fence.kites.split_off(drawn);
    for [a, b, left, right] in doors {
        let place = |point: i32| match net.vertices.get(point as usize) {
            Some(vertex) => *vertex,
            None => fence.anchors[point as usize - vertices],
        };
        let Some(cuts) = within([place(a), place(b)], bounds) else { continue };
        let mut ends = [a, b];
        for (end, cut) in ends.iter_mut().zip(cuts) {
            if let Some(cut) = cut {
                *end = (vertices + fence.anchors.len()) as i32;
                fence.anchors.push(cut);
            }
        }
        fence.kites.push([ends[0], ends[1], left, right]);
    }
}

/// How much of an edge lies within bounds.
#[derive(Clone, Copy, PartialEq)]
enum Within {
    Nothing,
    Part,
    Whole,
}

/// The edges of which a part lies within bounds.
struct Kept {
    rows: Vec<u32>,
    /// Their vertices; numbers after those of the drawing are places on the bounds.
    ends: Vec<[i32; 2]>,
    /// Where edges are cut.
    places: Vec<Point>,
}

impl Kept {
    fn of(net: NetView<'_>, bounds: Bounds) -> Self {
        let (before, drawn) = (net.vertices.len(), net.edges.len());
        let cuts = |k: usize| within(net.edges[k].map(|v| net.vertices[v as usize]), bounds);
        // What lies within as a whole, as nearly all does, needs no more than a look.
        let parts = parallel::map(drawn, |k| match cuts(k) {
            None => Within::Nothing,
            Some([None, None]) => Within::Whole,
            _ => Within::Part,
        });
        let rows = parallel::compact(drawn, |k| (parts[k] != Within::Nothing).then_some(k as u32));
        let mut ends = parallel::map(rows.len(), |i| net.edges[rows[i] as usize]);
        let mut places = Vec::new();
        for i in parallel::compact(rows.len(), |i| (parts[rows[i] as usize] == Within::Part).then_some(i)) {
            for (end, place) in ends[i].iter_mut().zip(cuts(rows[i] as usize).into_iter().flatten()) {
                let Some(place) = place else { continue };
                *end = (before + places.len()) as i32;
                places.push(place);
            }
        }
        Self { rows, ends, places }
    }

    fn drawn(self, net: NetView<'_>, fence: FenceView<'_>) -> (Net, Fence) {
        let Self { rows: kept, ends, places } = self;
        let (before, drawn) = (net.vertices.len(), net.edges.len());
        // Vertices in use first; the others become anchors, which stay where they are. Marked in any order, the marks are
        // the same.
        let is_used = parallel::map(before + places.len(), |_| AtomicBool::new(false));
        parallel::each(ends.len(), |i| ends[i].iter().for_each(|&end| is_used[end as usize].store(true, Relaxed)));
        let used = parallel::compact(is_used.len(), |i| is_used[i].load(Relaxed).then_some(i as i32));
        let others = parallel::compact(before, |i| (!is_used[i].load(Relaxed)).then_some(i as i32));
        let mut row = vec![NONE; is_used.len()];
        for (place, &vertex) in used.iter().chain(&others).enumerate() {
            row[vertex as usize] = place as i32;
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
                let [_, _, left, right] = fence.kites[k as usize].map(renumbered);
                [edges[i][0], edges[i][1], left, right]
            }
            None => fence.kites[drawn + i - kept.len()].map(renumbered),
        });
        let anchors = parallel::map(others.len() + fence.anchors.len(), |i| match others.get(i) {
            Some(&vertex) => net.vertices[vertex as usize],
            None => fence.anchors[i - others.len()],
        });
        let place = |vertex: usize| *net.vertices.get(vertex).unwrap_or_else(|| &places[vertex - before]);
        let net = Net {
            vertices: parallel::map(used.len(), |i| place(used[i] as usize)),
            edges,
            cut: parallel::map(used.len(), |i| used[i] as usize >= before || net.cut[used[i] as usize]),
            ..Net::default()
        };
        (net, Fence { anchors, kites, shifts: Vec::new() })
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
    let at = |t: f64| on_side([0, 1].map(|i| a[i] + t * (b[i] - a[i])), bounds);
    (start < end).then(|| [(start > 0.0).then(|| at(start)), (end < 1.0).then(|| at(end))])
}
