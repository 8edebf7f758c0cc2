//! The shut doors of a maze as a drawing, in the plane or on a torus, with the kites of their cells as its fence.

use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

use super::fence::Fence;
use super::net::{NONE, Net};
use crate::clip::{self, Bounds, Clipped};
use crate::diagram::DiagramView;
use crate::error::{Error, Result};
use crate::graph::Point;
use crate::parallel;
use crate::sets::DisjointSets;

/// A drawing and its fence: the site on either side of every wall, of open doors too.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Walls {
    /// Shut doors. Every vertex has an edge.
    pub net: Net,
    /// Its first kites are those of the shut doors; the site to the left is the first site of the door's edge.
    pub fence: Fence,
}

/// The dual edges of rows that are not `open`, within `bounds`.
///
/// # Errors
/// [`Error::BadValue`] for bounds without an area.
///
/// # Source
/// Thesis, section 8.
pub fn within(view: DiagramView<'_>, open: &[bool], bounds: Bounds) -> Result<Walls> {
    Ok(of_clipped(view, clip::dual_edges(view, bounds, |_| true)?, open, bounds))
}

/// The same where all dual edges have been cut at the bounds.
pub(super) fn of_clipped(view: DiagramView<'_>, clipped: Clipped, open: &[bool], bounds: Bounds) -> Walls {
    let uncut = view.vertices.len();
    let doors = Doors { ends: clipped.graph.edges, rows: clipped.rows, shifts: Vec::new() };
    let mut walls = doors.walls(view, open, &clipped.graph.vertices, uncut, |_, _| [0; 6]);
    // A vertex that happens to lie on a side is part of the outline too, and must not leave it.
    for (cut, p) in walls.net.cut.iter_mut().zip(&walls.net.vertices) {
        *cut |= (0..2).any(|i| p[i] == bounds[i] || p[i] == bounds[i + 2]);
    }
    walls.fence.draw_in(&walls.net.vertices, bounds);
    walls
}

/// The dual edges of rows that are not `open`, on a torus: `shifts` and `dual_shifts` are those of its diagram.
///
/// # Errors
/// [`Error::BadLength`].
pub fn on_torus(
    view: DiagramView<'_>,
    open: &[bool],
    shifts: &[[i8; 2]],
    dual_shifts: &[[i8; 2]],
    period: Point,
) -> Result<Walls> {
    for (array, found) in [("shifts", shifts.len()), ("dual_shifts", dual_shifts.len())] {
        if found != view.edges.len() {
            return Err(Error::BadLength { array, found, wanted: view.edges.len() });
        }
    }
    let doors = Doors::on_torus(view, dual_shifts);
    let site_shifts = |row: usize, [from, to]: [i32; 2]| {
        // The middle of the edge and the middle of its dual lie on one line across it: nowhere nearer than this copy.
        let middle = |a: Point, b: Point, shift: [i8; 2]| {
            [0, 1].map(|i| a[i] / 2.0 + b[i] / 2.0 + 0.5 * f64::from(shift[i]) * period[i])
        };
        let [p, q] = view.edges[row].map(|site| view.sites[site as usize]);
        let [v, w] = [from, to].map(|vertex| view.vertices[vertex as usize]);
        let (dual, edge) = (middle(v, w, dual_shifts[row]), middle(p, q, shifts[row]));
        let [x, y] = [0, 1].map(|i| ((dual[i] - edge[i]) / period[i]).round() as i8);
        let ([u, v], [s, t]) = (dual_shifts[row], shifts[row]);
        [u, v, x, y, x + s, y + t]
    };
    let mut walls = doors.walls(view, open, view.vertices, view.vertices.len(), site_shifts);
    walls.net.period = period;
    Ok(walls)
}

/// Dual edges that have a length.
struct Doors {
    ends: Vec<[i32; 2]>,
    /// The row of the diagram each comes from.
    rows: Vec<i32>,
    shifts: Vec<[i8; 2]>,
}

impl Doors {
    fn on_torus(view: DiagramView<'_>, dual_shifts: &[[i8; 2]]) -> Self {
        let is_point = |k: usize| {
            let [a, b] = view.dual_edges[k].map(|vertex| view.vertices[vertex as usize]);
            a == b && dual_shifts[k] == [0, 0]
        };
        let inside = |k: &usize| !view.dual_edges[*k].contains(&NONE);
        let mut sets = DisjointSets::new(view.vertices.len());
        for k in (0..view.edges.len()).filter(|k| inside(k) && is_point(*k)) {
            sets.unite(view.dual_edges[k][0] as usize, view.dual_edges[k][1] as usize);
        }
        let kept: Vec<usize> = (0..view.edges.len()).filter(|k| inside(k) && !is_point(*k)).collect();
        let ends = kept.iter().map(|&k| view.dual_edges[k].map(|vertex| sets.lowest(vertex as usize) as i32));
        Self {
            ends: ends.collect(),
            rows: kept.iter().map(|&k| k as i32).collect(),
            shifts: kept.iter().map(|&k| dual_shifts[k]).collect(),
        }
    }

    /// Shut doors first, each half in the order of the rows; vertices are numbered likewise.
    fn walls(
        self,
        view: DiagramView<'_>,
        open: &[bool],
        places: &[Point],
        uncut: usize,
        kite_shifts: impl Fn(usize, [i32; 2]) -> [i8; 6] + Sync,
    ) -> Walls {
        let Self { ends, rows, shifts } = self;
        let is_open = |i: usize| open[rows[i] as usize];
        let [wall, door] =
            [false, true].map(|wanted| parallel::compact(rows.len(), |i| (is_open(i) == wanted).then_some(i as u32)));
        let (mut number, mut order) = (vec![NONE; places.len()], Vec::with_capacity(places.len()));
        count(&mut number, &mut order, &wall, &ends);
        let drawn = order.len();
        count(&mut number, &mut order, &door, &ends);
        let vertices = parallel::map(drawn, |i| places[order[i] as usize]);
        let beside = order.len() - drawn;
        let anchors = parallel::map(beside + view.sites.len(), |i| match order.get(drawn + i) {
            Some(&old) => places[old as usize],
            None => view.sites[i - beside],
        });
        let sites = order.len() as i32;
        let numbered = |i: usize| ends[i].map(|old| number[old as usize]);
        let kite = |i: usize| {
            let ([a, b], [left, right]) = (numbered(i), view.edges[rows[i] as usize]);
            [a, b, sites + left, sites + right]
        };
        let both = |i: usize| *wall.get(i).unwrap_or_else(|| &door[i - wall.len()]) as usize;
        let fence = Fence {
            anchors,
            kites: parallel::map(rows.len(), |i| kite(both(i))),
            shifts: if shifts.is_empty() {
                Vec::new()
            } else {
                parallel::map(rows.len(), |i| kite_shifts(rows[both(i)] as usize, ends[both(i)]))
            },
        };
        let net = Net {
            vertices,
            edges: parallel::map(wall.len(), |i| numbered(wall[i] as usize)),
            shifts: if shifts.is_empty() { Vec::new() } else { wall.iter().map(|&i| shifts[i as usize]).collect() },
            period: [0.0; 2],
            cut: parallel::map(drawn, |i| order[i] as usize >= uncut),
        };
        Walls { net, fence }
    }
}

/// Numbers the vertices of some edges that have no number yet, in the order of the vertices.
fn count(number: &mut [i32], order: &mut Vec<u32>, some: &[u32], ends: &[[i32; 2]]) {
    // Marked in any order, the marks are the same.
    let is_seen = parallel::map(number.len(), |_| AtomicBool::new(false));
    parallel::each(some.len(), |i| {
        ends[some[i] as usize].iter().for_each(|&end| is_seen[end as usize].store(true, Relaxed));
    });
    for (old, (slot, is_seen)) in (0..).zip(number.iter_mut().zip(is_seen)) {
        if *slot == NONE && is_seen.into_inner() {
            *slot = order.len() as i32;
            order.push(old);
        }
    }
}
