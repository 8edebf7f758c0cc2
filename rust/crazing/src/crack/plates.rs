//! From a diagram to the drawing that a recipe starts from, in one call.

use std::f64::consts::PI;

use super::aged::stretched;
use super::fence::Fence;
use super::net::{Ends, Net};
use super::spacing::spacing;
use super::strand::paired;
use super::walls::{Walls, of_clipped};
use crate::clip::{self, Bounds};
use crate::diagram::DiagramView;
use crate::error::Result;
use crate::graph::Point;
use crate::maze::{Doors, Tree, carve, voronoi_doors};
use crate::parallel;
use crate::rng::Key;
use crate::watch::Watch;

/// How the plates of a maze are carved, and where its walls then lie.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Carving {
    /// See [`carve`].
    pub tree: Tree,
    /// See [`carve`].
    pub opening: f64,
    /// See [`carve`].
    pub key: Key,
    /// What the walls are cut at.
    pub bounds: Bounds,
    /// See [`stretched`]: matrix, centre and bounds.
    pub stretch: Option<([Point; 2], Point, Bounds)>,
}

/// The walls of a maze of plates.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Plates {
    /// The drawing.
    pub net: Net,
    /// Its fence.
    pub fence: Fence,
    /// See [`super::pairs`]; no turn is too sharp.
    pub partner: Vec<i32>,
    /// See [`spacing`].
    pub spacing: f64,
}

/// The walls of a maze in the plane: the same bits as one step after the other.
///
/// # Errors
/// Those of the steps.
pub fn plates(view: DiagramView<'_>, how: Carving, watch: Watch<'_>) -> Result<Plates> {
    let door = voronoi_doors(view, Some(how.bounds));
    let doors = Doors { cells: view.sites.len(), sides: view.edges, door: &door };
    // A maze is carved on one thread; what does not depend on it is done beside.
    let beside = || (clip::dual_edges(view, how.bounds, |_| true), spacing(view.sites, view.edges, &[], [0.0; 2]));
    let (maze, (clipped, spacing)) = parallel::join(
        view.edges.len(),
        || carve(doors, how.tree, None, how.opening, how.key, watch),
        || parallel::in_one_pool(beside),
    );
    let Walls { net, fence } = of_clipped(view, clipped?, &maze?.open, how.bounds);
    watch.poll()?;
    let (net, fence) = match how.stretch {
        Some((matrix, centre, bounds)) => stretched(net.view(), fence.view(), matrix, centre, bounds)?,
        None => (net, fence),
    };
    let partner = paired(net.view(), &Ends::of(net.view()), PI);
    Ok(Plates { net, fence, partner, spacing })
}
