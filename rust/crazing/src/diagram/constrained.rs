//! Diagrams with edges that must be there.

use super::Diagram;
use super::build::{check_points, finished, merge_scaled};
use super::delaunay::triangulate_constrained;
use super::sweep::check_apart;
use crate::error::{Error, Result};
use crate::graph::{Point, check_indices};
use crate::watch::Watch;

/// A constrained Delaunay triangulation.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ConstrainedDiagram {
    /// As without constraints, but a triangle's circle may hold sites that no straight way within the constraints
    /// leads to: `vertices` are still circumcentres, and `dual_edges` neighbours, but no Voronoi diagram.
    pub diagram: Diagram,
    /// Whether each edge lies on a constraint.
    pub constrained: Vec<bool>,
}

/// The constrained Delaunay triangulation of `points`: `constraints` are two rows of `points` each. A constraint that
/// passes through a site is several edges.
///
/// # Errors
/// As [`super::diagram`]; [`Error::BadIndex`] for an end that is no row, [`Error::Loop`] for a constraint without a
/// length, [`Error::Crossing`] for two that cross or overlap.
///
/// # Source
/// Chew: Constrained Delaunay Triangulations (1989).
pub fn constrained(points: &[Point], constraints: &[[i32; 2]], watch: Watch<'_>) -> Result<ConstrainedDiagram> {
    check_points(points)?;
    check_indices("constraints", constraints, 0, points.len())?;
    let (merged, scale) = merge_scaled(points);
    let mut along_of = vec![0; merged.sites.len()];
    for (along, &site) in merged.curve.iter().enumerate() {
        along_of[site as usize] = along as u32;
    }
    let row_along = |row: i32| along_of[merged.site_of[row as usize] as usize];
    let ends: Vec<[u32; 2]> = constraints.iter().map(|rows| rows.map(row_along)).collect();
    if let Some(row) = ends.iter().position(|[a, b]| a == b) {
        return Err(Error::Loop { array: "constraints", row, ends: constraints[row] });
    }
    check_apart(&merged.along, &ends, "constraint", watch).map_err(|error| match error {
        // From numbers along the curve to the user's rows.
        Error::Crossing { what, first, second } => {
            let given = |found: [usize; 2]| {
                let row = ends.iter().position(|ends| ends.map(|end| end as usize) == found);
                row.map_or(found, |row| constraints[row].map(|end| end as usize))
            };
            Error::Crossing { what, first: given(first), second: given(second) }
        }
        other => other,
    })?;
    let (topology, constrained) = triangulate_constrained(&merged.along, &ends, watch)?;
    Ok(ConstrainedDiagram { diagram: finished(merged, topology, scale), constrained })
}
