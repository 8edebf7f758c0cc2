//! Voronoi edges as segments: rays and lines are cut at the bounds.

mod inner;

use crate::diagram::scale::{Scale, largest};
use crate::diagram::{DiagramView, representatives};
use crate::error::{Error, Result};
use crate::graph::{PlanarGraph, Point};
use crate::parallel;
use inner::Inner;

/// xmin, ymin, xmax, ymax.
pub type Bounds = [f64; 4];

/// Dual edges within the bounds.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Clipped {
    /// Vertices of the diagram (coincident ones represented by the lowest triangle), then the points on the bounds
    /// where an edge was cut.
    pub graph: PlanarGraph,
    /// The row of the diagram each edge comes from.
    pub rows: Vec<i32>,
}

/// Checks that bounds are finite and have an area.
///
/// # Errors
/// [`Error::BadValue`].
pub fn check_bounds(bounds: Bounds) -> Result<()> {
    let [xmin, ymin, xmax, ymax] = bounds;
    let sides = [("the width of bounds", xmax - xmin), ("the height of bounds", ymax - ymin)];
    match sides.into_iter().find(|(_, side)| !(side.is_finite() && *side > 0.0)) {
        Some((name, value)) => Err(Error::BadValue { name, value, wanted: "a positive, finite number is wanted" }),
        None => Ok(()),
    }
}

/// Of a side, this part of how far out it lies: a cut is rounded by less.
const ROUNDING: f64 = 1.0 / (1_u64 << 50) as f64;

/// A place where something was cut at the bounds: on their side to the last bit, and nowhere beyond.
pub(crate) fn on_side(place: Point, bounds: Bounds) -> Point {
    [0, 1].map(|axis| {
        let [low, high] = [bounds[axis], bounds[axis + 2]];
        let near = ROUNDING * low.abs().max(high.abs());
        match place[axis] {
            x if x - low <= near => low,
            x if high - x <= near => high,
            x => x,
        }
    })
}

/// The dual edges of the rows that `wanted` names, clipped to `bounds`. Edges without length are left out.
///
/// Every dual edge is an interval of the bisector of its two sites; it is cut there, so far ends cost no precision.
///
/// # Errors
/// [`Error::BadValue`] for bounds without an area.
pub fn dual_edges(view: DiagramView<'_>, bounds: Bounds, wanted: impl Fn(usize) -> bool + Sync) -> Result<Clipped> {
    check_bounds(bounds)?;
    // Sites may be far smaller than the bounds: directions are taken in the unit of the sites, positions in a common one.
    let fine = Scale::of(largest(view.sites));
    let scale = Scale::of(largest(view.sites).max(largest(&[[bounds[0], bounds[1]], [bounds[2], bounds[3]]])));
    let (low, high) = (scale.down([bounds[0], bounds[1]]), scale.down([bounds[2], bounds[3]]));
    let representative = representatives(view);
    let (vertices, inner) = (view.vertices.len(), Inner::of(view, bounds));
    // Where an edge is cut stands the number of its place after the vertices, counted anew in every range.
    let found = parallel::ranges(view.edges.len(), |range| {
        let (mut edges, mut rows) = (Vec::with_capacity(range.len()), Vec::with_capacity(range.len()));
        let mut places = Vec::new();
        for k in range.filter(|&k| wanted(k)) {
            if inner.holds(view, k) {
                edges.push(view.dual_edges[k].map(|triangle| representative[triangle as usize]));
                rows.push(k as i32);
                continue;
            }
            let line = Bisector::of(view, k, fine, scale);
            let Some(inside) = line.within(low, high) else { continue };
            let mut cut = |t: f64| {
                places.push(on_side(scale.up(line.at(t)), bounds));
                (vertices + places.len()) as i32 - 1
            };
            let [right, left] = view.dual_edges[k];
            let from =
                if right == -1 || inside[0] > line.ends[0] { cut(inside[0]) } else { representative[right as usize] };
            let to =
                if left == -1 || inside[1] < line.ends[1] { cut(inside[1]) } else { representative[left as usize] };
            edges.push([from, to]);
            rows.push(k as i32);
        }
        (edges, rows, places)
    });
    Ok(joined(view, found))
}

/// Edges, the rows they come from, and places where they are cut.
type Found = (Vec<[i32; 2]>, Vec<i32>, Vec<Point>);

/// What was found in ranges, one after the other.
fn joined(view: DiagramView<'_>, found: Vec<Found>) -> Clipped {
    let vertices = view.vertices.len();
    let counts: Vec<usize> = found.iter().map(|(edges, _, _)| edges.len()).collect();
    let (count, cut) = (counts.iter().sum(), found.iter().map(|(_, _, cuts)| cuts.len()).sum::<usize>());
    let (mut edges, mut rows, mut places) = (vec![[0; 2]; count], vec![0; count], vec![[0.0; 2]; vertices + cut]);
    let (old, mut rest) = places.split_at_mut(vertices);
    parallel::fill(old, |range, part| part.copy_from_slice(&view.vertices[range]));
    let own_edges = parallel::shared(&mut edges, counts.iter().copied());
    let own_rows = parallel::shared(&mut rows, counts.iter().copied());
    let (mut parts, mut before) = (Vec::with_capacity(found.len()), 0);
    for (own, some) in own_edges.zip(own_rows).zip(found) {
        let cuts;
        (cuts, rest) = rest.split_at_mut(some.2.len());
        cuts.copy_from_slice(&some.2);
        parts.push((own, some, before));
        before += cuts.len() as i32;
    }
    parallel::parts(count, parts, |((edges, rows), (some, of_some, _), before)| {
        rows.copy_from_slice(&of_some);
        for (edge, ends) in edges.iter_mut().zip(some) {
            *edge = ends.map(|v| if v < vertices as i32 { v } else { v + before });
        }
    });
    Clipped { graph: PlanarGraph { vertices: places, edges }, rows }
}

/// Dual edges as ways between two points, rays and far ends cut.
pub(crate) struct Ways<'a> {
    view: DiagramView<'a>,
    bounds: Bounds,
    fine: Scale,
    scale: Scale,
}

impl<'a> Ways<'a> {
    /// Cut at `bounds`, or somewhere beyond them.
    pub(crate) fn of(view: DiagramView<'a>, bounds: Bounds) -> Self {
        let fine = Scale::of(largest(view.sites));
        let scale = Scale::of(largest(view.sites).max(largest(&[[bounds[0], bounds[1]], [bounds[2], bounds[3]]])));
        Self { view, bounds, fine, scale }
    }

    /// The two ends of dual edge `k`, when both are finite and within the bounds.
    #[inline]
    pub(crate) fn whole(&self, k: usize) -> Option<[Point; 2]> {
        let [right, left] = self.view.dual_edges[k];
        if right == -1 || left == -1 {
            return None;
        }
        let ends = [right, left].map(|t| self.view.vertices[t as usize]);
        let [xmin, ymin, xmax, ymax] = self.bounds;
        let within = |[x, y]: Point| xmin <= x && x <= xmax && ymin <= y && y <= ymax;
        (within(ends[0]) && within(ends[1])).then_some(ends)
    }

    /// The part of dual edge `k` within the bounds, from the right of its edge to the left; None without a length.
    pub(crate) fn cut(&self, k: usize) -> Option<[Point; 2]> {
        if let Some(ends) = self.whole(k) {
            return (ends[0] != ends[1]).then_some(ends);
        }
        let line = Bisector::of(self.view, k, self.fine, self.scale);
        let [xmin, ymin, xmax, ymax] = self.bounds;
        let [from, to] = line.within(self.scale.down([xmin, ymin]), self.scale.down([xmax, ymax]))?;
        let end = |t: f64, own: f64, triangle: i32| {
            if triangle != -1 && t == own { self.view.vertices[triangle as usize] } else { self.scale.up(line.at(t)) }
        };
        let [right, left] = self.view.dual_edges[k];
        let ends = [end(from, line.ends[0], right), end(to, line.ends[1], left)];
        (ends[0] != ends[1]).then_some(ends)
    }
}

/// The line of points as far from one site as from the other: `middle + t * normal`.
struct Bisector {
    middle: Point,
    normal: Point,
    /// Where the dual edge starts and ends, right to left; infinite on the outside. Equal when it has no length.
    ends: [f64; 2],
}

impl Bisector {
    fn of(view: DiagramView<'_>, k: usize, fine: Scale, scale: Scale) -> Self {
        let ends = view.edges[k].map(|site| view.sites[site as usize]);
        let [p, q] = ends.map(|p| fine.down(p));
        let size = (q[0] - p[0]).abs().max((q[1] - p[1]).abs());
        let normal = [(p[1] - q[1]) / size, (q[0] - p[0]) / size];
        let [p, q] = ends.map(|p| scale.down(p));
        let middle = [p[0] + 0.5 * (q[0] - p[0]), p[1] + 0.5 * (q[1] - p[1])];
        let square = normal[0] * normal[0] + normal[1] * normal[1];
        let [right, left] = view.dual_edges[k];
        let along = |triangle: i32, outside: f64| {
            if triangle == -1 {
                return outside;
            }
            let v = scale.down(view.vertices[triangle as usize]);
            ((v[0] - middle[0]) * normal[0] + (v[1] - middle[1]) * normal[1]) / square
        };
        Self { middle, normal, ends: [along(right, f64::NEG_INFINITY), along(left, f64::INFINITY)] }
    }

    fn at(&self, t: f64) -> Point {
        [self.middle[0] + t * self.normal[0], self.middle[1] + t * self.normal[1]]
    }

    /// The part of the dual edge between two corners; None when that has no length.
    fn within(&self, low: Point, high: Point) -> Option<[f64; 2]> {
        let [mut start, mut end] = self.ends;
        for axis in 0..2 {
            let (origin, step) = (self.middle[axis], self.normal[axis]);
            if step == 0.0 {
                if origin < low[axis] || origin > high[axis] {
                    return None;
                }
                continue;
            }
            let (a, b) = ((low[axis] - origin) / step, (high[axis] - origin) / step);
            start = start.max(a.min(b));
            end = end.min(a.max(b));
        }
        (start < end).then_some([start, end])
    }
}
