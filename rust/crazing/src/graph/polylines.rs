//! Edges joined into the longest lines that pass no junction: what a plotter, a file or a pen wants.

use super::degrees;
use crate::error::Result;
use crate::watch::Watch;

/// Lines one after the other: line `i` is `rows[offsets[i]..offsets[i + 1]]`.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Polylines {
    /// Rows of the vertices along the lines.
    pub rows: Vec<i32>,
    /// Where each line begins, and at last the number of rows.
    pub offsets: Vec<i64>,
}

/// Splits a drawing into chains between vertices of degree other than 2, and after them the closed rings, whose
/// first vertex is repeated at the end. Every edge is in one line, once. Chains come in the order of their first
/// edge end, rings in the order of their first edge. Linear in the size of the drawing.
///
/// # Errors
/// [`Error::BadIndex`](crate::Error::BadIndex) or [`Error::TooMany`](crate::Error::TooMany) for edges that do not
/// fit; [`Error::Interrupted`](crate::Error::Interrupted).
pub fn polylines(count: usize, edges: &[[i32; 2]], watch: Watch<'_>) -> Result<Polylines> {
    let degrees = degrees(count, edges, watch)?;
    let mut walk = Walk::new(&degrees, edges);
    for half in 0..2 * edges.len() {
        watch.poll_at(half)?;
        if degrees[walk.origin(half)] != 2 {
            walk.line(half, watch)?;
        }
    }
    for edge in 0..edges.len() {
        watch.poll_at(edge)?;
        walk.line(2 * edge, watch)?;
    }
    Ok(walk.lines)
}

/// Half-edge `2 k` leaves the first end of edge `k`, half-edge `2 k + 1` the second: the way back is `h ^ 1`.
struct Walk<'a> {
    edges: &'a [[i32; 2]],
    degrees: &'a [i32],
    /// Exclusive or of the half-edges that leave each vertex: where two leave, either one gives the other.
    leaving: Vec<u32>,
    used: Vec<bool>,
    lines: Polylines,
}

impl<'a> Walk<'a> {
    fn new(degrees: &'a [i32], edges: &'a [[i32; 2]]) -> Self {
        let mut leaving = vec![0; degrees.len()];
        for (k, &[a, b]) in edges.iter().enumerate() {
            leaving[a as usize] ^= 2 * k as u32;
            leaving[b as usize] ^= 2 * k as u32 + 1;
        }
        let lines = Polylines { rows: Vec::new(), offsets: vec![0] };
        Self { edges, degrees, leaving, used: vec![false; edges.len()], lines }
    }

    fn origin(&self, half: usize) -> usize {
        self.edges[half / 2][half % 2] as usize
    }

    /// Follows the line that begins with `half` to its end, unless it was followed before.
    fn line(&mut self, mut half: usize, watch: Watch<'_>) -> Result<()> {
        if self.used[half / 2] {
            return Ok(());
        }
        self.lines.rows.push(self.origin(half) as i32);
        while !self.used[half / 2] {
            watch.poll_at(self.lines.rows.len())?;
            self.used[half / 2] = true;
            let end = self.origin(half ^ 1);
            self.lines.rows.push(end as i32);
            if self.degrees[end] == 2 {
                half = self.leaving[end] as usize ^ half ^ 1;
            }
        }
        self.lines.offsets.push(self.lines.rows.len() as i64);
        Ok(())
    }
}
