//! Where the doors of cells within a region are.

use super::Region;
use super::chains::Chains;
use crate::diagram::{DiagramView, representatives};
use crate::error::{Error, Result};
use crate::graph::{PlanarGraph, Point};
use crate::watch::Watch;

/// Pieces of dual edges within a region.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Doors {
    /// Vertices of the diagram (coincident ones represented by the lowest triangle), then those on the outline.
    pub graph: PlanarGraph,
    /// The door that each edge of the graph is, numbered as in [`super::cells::Cells::sides`].
    pub numbers: Vec<i32>,
}

/// The pieces that `wanted` names by their doors, in the order of their dual edges.
///
/// # Errors
/// [`Error::BadLength`] when `wanted` has not one entry a door; [`Error::BadValue`] as [`super::cells::cells`];
/// [`Error::Interrupted`].
pub fn doors(view: DiagramView<'_>, region: &Region, wanted: &[bool], watch: Watch<'_>) -> Result<Doors> {
    let chains = Chains::of(view, region, watch)?;
    let representative = representatives(view);
    let mut found = Doors::default();
    found.graph.vertices = view.vertices.to_vec();
    let is_wanted = |door: usize| {
        wanted.get(door).copied().ok_or(Error::BadLength { array: "wanted", found: wanted.len(), wanted: door + 1 })
    };
    let mut further = view.edges.len() as i32;
    for (k, sides) in view.dual_edges.iter().enumerate() {
        watch.poll_at(k)?;
        if chains.inside[k] {
            // Rows wholly inside have no end at infinity.
            if is_wanted(k)? && !sides.contains(&-1) {
                found.graph.edges.push(sides.map(|t| representative[t as usize]));
                found.numbers.push(k as i32);
            }
            continue;
        }
        for piece in chains.cut(k as u32).into_iter().flat_map(|cut| chains.pieces(cut)) {
            let Some(number) = piece.door else { continue };
            let door = if number == 0 { k as i32 } else { further };
            further += i32::from(number > 0);
            if is_wanted(door as usize)? {
                let vertices = &mut found.graph.vertices;
                let mut vertex = |crossing: Option<u32>, place: Point, side: i32| match crossing {
                    None if side != -1 => representative[side as usize],
                    _ => {
                        vertices.push(place);
                        vertices.len() as i32 - 1
                    }
                };
                let ends = [vertex(piece.from, piece.ends[0], sides[0]), vertex(piece.to, piece.ends[1], sides[1])];
                found.graph.edges.push(ends);
                found.numbers.push(door);
            }
        }
    }
    Ok(found)
}
