//! Any drawing of straight edges.

mod apart;
mod components;
mod polylines;

use crate::error::{Error, Result};
use crate::parallel;
use crate::watch::Watch;

pub use apart::distances;
pub use components::{Components, components};
pub use polylines::{Polylines, polylines};

/// A point in the plane.
pub type Point = [f64; 2];

/// Vertices and the straight edges between them. Vertices without an edge are allowed: graphs drawn
/// from one diagram share its numbering.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct PlanarGraph {
    /// Positions.
    pub vertices: Vec<Point>,
    /// Rows of `vertices`, two an edge.
    pub edges: Vec<[i32; 2]>,
}

/// Edges that can be counted: a degree and the number of a half-edge then fit 32 bits.
const MOST_EDGES: usize = (1 << 30) - 1;

/// Vertices that 32-bit signed indices can number.
const MOST_VERTICES: usize = i32::MAX as usize;

/// Checks that neither `edges` nor vertices are too many, and that edges point into the `count` vertices.
fn check(count: usize, edges: &[[i32; 2]]) -> Result<()> {
    let few = |what, found, limit| if found <= limit { Ok(()) } else { Err(Error::TooMany { what, found, limit }) };
    few("edges", edges.len(), MOST_EDGES)?;
    few("vertices", count, MOST_VERTICES)?;
    check_indices("edges", edges, 0, count)
}

/// The number of edge ends at every vertex; an edge from a vertex to itself counts twice.
///
/// # Errors
/// [`Error::BadIndex`] or [`Error::TooMany`] for edges that do not fit; [`Error::Interrupted`].
pub fn degrees(count: usize, edges: &[[i32; 2]], watch: Watch<'_>) -> Result<Vec<i32>> {
    check(count, edges)?;
    let mut degrees = vec![0; count];
    for (k, edge) in edges.iter().enumerate() {
        watch.poll_at(k)?;
        edge.iter().for_each(|&vertex| degrees[vertex as usize] += 1);
    }
    Ok(degrees)
}

/// The same drawing without the vertices that no edge uses; the others keep their order, and so do the edges.
///
/// # Errors
/// As [`degrees`].
pub fn compact(vertices: &[Point], edges: &[[i32; 2]], watch: Watch<'_>) -> Result<PlanarGraph> {
    let degrees = degrees(vertices.len(), edges, watch)?;
    let mut kept = Vec::new();
    let mut row_of = vec![-1; vertices.len()];
    for (vertex, _) in degrees.iter().enumerate().filter(|&(_, &degree)| degree > 0) {
        watch.poll_at(kept.len())?;
        row_of[vertex] = kept.len() as i32;
        kept.push(vertices[vertex]);
    }
    let edges = edges.iter().map(|edge| edge.map(|vertex| row_of[vertex as usize])).collect();
    Ok(PlanarGraph { vertices: kept, edges })
}

/// Checks that every entry of `rows` is at least `low` and less than `limit`.
///
/// # Errors
/// [`Error::BadIndex`] naming the first entry that is not.
pub fn check_indices<const N: usize>(array: &'static str, rows: &[[i32; N]], low: i32, limit: usize) -> Result<()> {
    if !parallel::ranges(rows.len(), |range| are_indices(&rows[range], low, limit)).contains(&false) {
        return Ok(());
    }
    let limit = i32::try_from(limit).unwrap_or(i32::MAX);
    let bad = |value: i32| (value < low) | (value >= limit);
    let row = rows.iter().position(|row| row.iter().any(|&value| bad(value))).unwrap_or(0);
    let value = rows[row].iter().copied().find(|&value| bad(value)).unwrap_or(low);
    Err(Error::BadIndex { array, row, value: value.into(), low: low.into(), limit: limit.into() })
}

/// Whether every entry of `rows` is at least `low` and less than `limit`.
#[inline(always)]
pub(crate) fn are_indices<const N: usize>(rows: &[[i32; N]], low: i32, limit: usize) -> bool {
    let limit = i32::try_from(limit).unwrap_or(i32::MAX);
    // Without a way out of the loop: all entries are looked at several at a time.
    rows.as_flattened().iter().fold(true, |fit, &value| fit & (value >= low) & (value < limit))
}
