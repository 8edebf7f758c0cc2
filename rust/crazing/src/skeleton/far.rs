//! Voronoi vertices brought to where a triangulation and exact arithmetic can hold them.

use crate::graph::Point;

/// Scaled vertices beyond this are moved in to it along their direction: for circles of any smaller radius a vertex
/// that far is a half-plane all the same.
pub(super) const FAR: f64 = 1e60;
/// Scaled vertex coordinates below this are zero: they are rounded far coarser than that, and the triangulation does
/// not hold smaller ones.
const SMALL: f64 = 1e-42;

/// A scaled vertex where it may be counted with.
pub(super) fn near(v: Point) -> Point {
    let size = v[0].abs().max(v[1].abs());
    let v = if size > FAR { v.map(|x| x / size * FAR) } else { v };
    v.map(|x| if x.abs() < SMALL { 0.0 } else { x })
}
