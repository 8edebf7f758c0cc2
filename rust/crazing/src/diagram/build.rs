//! From rows of points to a [`Diagram`]: check, scale, merge duplicates, triangulate, dualise.

use super::scale::{Scale, cleared, largest};
use super::{Diagram, delaunay, order, vertices};
use crate::error::{Error, Result};
use crate::graph::Point;
use crate::parallel;
use crate::watch::Watch;

/// Edges are numbered with 32 bits, and there are up to three a point.
const MOST_POINTS: usize = i32::MAX as usize / 3;

/// The Delaunay triangulation and Voronoi diagram of `points`.
///
/// Duplicates are merged. A coordinate smaller than 2^-126 of the largest one counts as zero. Fewer than three
/// distinct points, or points all on one line, have edges between neighbours and no triangles. Combinatorics are
/// exact for the points as given; vertices are rounded.
///
/// # Errors
/// [`Error::NotFinite`], [`Error::TooMany`], [`Error::Interrupted`].
///
/// # Source
/// Thesis, sections 3.1 and 3.2.
pub fn diagram(points: &[Point], watch: Watch<'_>) -> Result<Diagram> {
    check_points(points)?;
    let (merged, scale) = merge_scaled(points);
    let topology = delaunay::triangulate(&merged.along, watch)?;
    Ok(finished(merged, topology, scale))
}

/// Distinct points near 1, and the unit they are in.
pub(super) fn merge_scaled(points: &[Point]) -> (Merged, Scale) {
    let largest = largest(points);
    let scale = Scale::of(largest);
    (merge(points.iter().map(|&p| scale.down(cleared(p, largest))).collect()), scale)
}

/// The diagram of a triangulation, in the user's numbering and unit.
pub(super) fn finished(merged: Merged, mut topology: delaunay::Topology, scale: Scale) -> Diagram {
    let mut sites = merged.sites;
    let mut vertices = vertices::vertices(&merged.along, &topology);
    renumber(&mut topology, &merged.curve);
    if !scale.is_one() {
        for p in sites.iter_mut().chain(&mut vertices) {
            *p = scale.up(*p);
        }
    }
    let delaunay::Topology { triangles, edges, dual_edges } = topology;
    Diagram { sites, site_of: merged.site_of, triangles, vertices, edges, dual_edges }
}

/// Distinct points in the order of their first appearance, the one of every row, and the unit they are near 1 in.
pub(crate) fn distinct(points: &[Point]) -> (Vec<Point>, Vec<i32>, Scale) {
    let (merged, scale) = merge_scaled(points);
    (merged.sites, merged.site_of, scale)
}

/// The edges alone of a Delaunay triangulation of points near 1, and the first row of every point they join.
///
/// # Errors
/// [`Error::TooMany`], [`Error::Interrupted`].
pub(crate) fn triangulate_near_one(points: Vec<Point>, watch: Watch<'_>) -> Result<(Vec<u32>, Vec<[i32; 2]>)> {
    check_points(&points)?;
    let rows = points.len();
    let merged = merge(points);
    let mut first_row = vec![0; merged.sites.len()];
    for row in (0..rows).rev() {
        first_row[merged.site_of[row] as usize] = row as u32;
    }
    let mut topology = delaunay::triangulate(&merged.along, watch)?;
    renumber(&mut topology, &merged.curve);
    Ok((first_row, topology.edges))
}

/// From numbers along the curve to sites; the outside comes to lie on the left, other edges run upward.
fn renumber(topology: &mut delaunay::Topology, curve: &[u32]) {
    let site = |along: i32| curve[along as usize] as i32;
    parallel::alter(&mut topology.triangles, |corners| *corners = corners.map(site));
    parallel::alter_both(&mut topology.edges, &mut topology.dual_edges, |ends, sides| {
        *ends = ends.map(site);
        let outside = sides.map(|side| side == -1);
        if outside == [true, false] || (outside[0] == outside[1] && ends[0] > ends[1]) {
            ends.reverse();
            sides.reverse();
        }
    });
}

pub(crate) fn check_points(points: &[Point]) -> Result<()> {
    if points.len() > MOST_POINTS {
        return Err(Error::TooMany { what: "points", found: points.len(), limit: MOST_POINTS });
    }
    match points.iter().position(|p| !(p[0].is_finite() && p[1].is_finite())) {
        Some(row) => Err(Error::NotFinite { row, x: points[row][0], y: points[row][1] }),
        None => Ok(()),
    }
}

/// Rows without their duplicates.
pub(super) struct Merged {
    /// Distinct points in the order of first appearance.
    pub(super) sites: Vec<Point>,
    /// The one of every row.
    pub(super) site_of: Vec<i32>,
    /// Sites along a Hilbert curve.
    pub(super) curve: Vec<u32>,
    /// Their positions: everything is computed in the numbering of the curve, where neighbours are close in memory.
    pub(super) along: Vec<Point>,
}

pub(super) fn merge(points: Vec<Point>) -> Merged {
    let mut curve = order::hilbert(&points);
    let mut along = parallel::map(curve.len(), |i| points[curve[i] as usize]);
    if along.windows(2).all(|pair| pair[0] != pair[1]) {
        return Merged { site_of: (0..points.len() as i32).collect(), sites: points, curve, along };
    }
    // Equal rows stand together on the curve, the first of them first.
    let mut first_row: Vec<i32> = (0..points.len() as i32).collect();
    curve.dedup_by(|row, kept| {
        let same = points[*row as usize] == points[*kept as usize];
        if same {
            first_row[*row as usize] = *kept as i32;
        }
        same
    });
    along.dedup();
    let (sites, site_of) = number_first_rows(&points, first_row);
    for row in &mut curve {
        *row = site_of[*row as usize] as u32;
    }
    Merged { sites, site_of, curve, along }
}

/// Numbers the rows that are the first of their kind, and points every row at the number of its kind.
fn number_first_rows(points: &[Point], mut first_row: Vec<i32>) -> (Vec<Point>, Vec<i32>) {
    let mut sites = Vec::new();
    for row in 0..points.len() {
        let first = first_row[row] as usize;
        if first == row {
            first_row[row] = sites.len() as i32;
            sites.push(points[row]);
        } else {
            first_row[row] = first_row[first];
        }
    }
    (sites, first_row)
}
