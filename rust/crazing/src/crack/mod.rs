//! Cracks: the walls of a maze, followed as strands and given a width.

mod strand;
mod width;

pub use strand::{Strands, strands};
pub use width::{Profile, widths};

use crate::clip::{self, Bounds};
use crate::diagram::DiagramView;
use crate::error::Result;
use crate::graph::PlanarGraph;

/// A crack pattern.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Crack {
    /// Every vertex has an edge.
    pub graph: PlanarGraph,
    /// Width at the two ends of each edge, data units.
    pub width: Vec<[f64; 2]>,
    /// The strand of each edge; strand 0 is the longest.
    pub strand: Vec<i32>,
    /// How many strands stand between the strand of each edge and one that abuts none.
    pub generation: Vec<i32>,
}

/// The dual edges of rows that are not `open`, within `bounds`, with widths.
///
/// # Errors
/// [`crate::Error::BadLength`], [`crate::Error::BadValue`].
///
/// # Source
/// Thesis, section 8; strands and widths are ours.
pub fn crack(view: DiagramView<'_>, open: &[bool], bounds: Bounds, profile: Profile) -> Result<Crack> {
    let clipped = clip::dual_edges(view, bounds, |k| !open[k])?;
    let (graph, free) = compact(&clipped.graph, view.vertices.len());
    let strands = strands(&graph);
    let width = widths(&graph, &strands, &free, profile)?;
    Ok(Crack { graph, width, strand: strands.of_edge, generation: strands.generation })
}

/// The vertices that have an edge, in their order, and whether each may be a free tip: one on the bounds, where an edge
/// was cut, goes on outside the picture.
fn compact(graph: &PlanarGraph, uncut: usize) -> (PlanarGraph, Vec<bool>) {
    let mut number = vec![-1; graph.vertices.len()];
    for &end in graph.edges.iter().flatten() {
        number[end as usize] = 0;
    }
    let (mut vertices, mut free) = (Vec::new(), Vec::new());
    for (old, slot) in number.iter_mut().enumerate().filter(|(_, slot)| **slot == 0) {
        *slot = vertices.len() as i32;
        vertices.push(graph.vertices[old]);
        free.push(old < uncut);
    }
    let edges = graph.edges.iter().map(|edge| edge.map(|end| number[end as usize])).collect();
    (PlanarGraph { vertices, edges }, free)
}
