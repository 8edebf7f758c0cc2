//! Any drawing of straight edges.

use crate::error::{Error, Result};

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

/// Checks that every entry of `rows` is at least `low` and less than `limit`.
///
/// # Errors
/// [`Error::BadIndex`] naming the first entry that is not.
pub fn check_indices<const N: usize>(array: &'static str, rows: &[[i32; N]], low: i32, limit: usize) -> Result<()> {
    let limit = i64::try_from(limit).unwrap_or(i64::MAX);
    let bad = |value: i32| value < low || i64::from(value) >= limit;
    match rows.iter().position(|row| row.iter().any(|&value| bad(value))) {
        None => Ok(()),
        Some(row) => {
            let value = rows[row].iter().copied().find(|&value| bad(value)).unwrap_or(low);
            Err(Error::BadIndex { array, row, value: value.into(), low: low.into(), limit })
        }
    }
}
