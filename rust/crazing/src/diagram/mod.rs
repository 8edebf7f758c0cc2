//! The table of edges with two faces: row `k` of `edges` and row `k` of `dual_edges` are one edge and its dual.

mod build;
mod constrained;
mod delaunay;
mod depths;
pub(crate) mod halves;
mod hilbert;
mod missing;
mod mosaic;
mod order;
mod periodic;
mod radix;
pub mod scale;
mod sweep;
mod ties;
mod tile;
mod torus;
mod vertices;

pub use build::diagram;
pub(crate) use build::{check_points, distinct, triangulate_near_one};
pub use constrained::{ConstrainedDiagram, constrained};
pub use depths::depths;
pub use mosaic::{Mosaic, mosaic};
pub(crate) use order::hilbert as curve_order;
pub use order::insertion as insertion_order;
pub use periodic::{PeriodicDiagram, periodic};
pub use sweep::check_apart;
pub use tile::tile;
pub use vertices::representatives;
pub(crate) use vertices::{COINCIDENT, lowest_of, shares};

use std::ops::Range;

use crate::error::{Error, Result};
use crate::graph::{Point, are_indices, check_indices};

/// A Delaunay triangulation and its Voronoi dual, edge by edge.
///
/// Voronoi vertex `i` is triangle `i`, cell `i` is site `i`. Edge `k` runs from `edges[k][0]` to `edges[k][1]`;
/// `dual_edges[k]` holds the triangle on its right and the one on its left, -1 for the outside. Edges of the hull
/// have the outside on their left, all others run from the lower site to the higher. Rows of triangles and edges
/// follow a Hilbert curve.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Diagram {
    /// Distinct points, in the order of their first appearance.
    pub sites: Vec<Point>,
    /// The site of every input row.
    pub site_of: Vec<i32>,
    /// Corners, counter-clockwise.
    pub triangles: Vec<[i32; 3]>,
    /// Circumcentres. Coincident ones of neighbouring triangles are equal to the last bit.
    pub vertices: Vec<Point>,
    /// Two sites an edge.
    pub edges: Vec<[i32; 2]>,
    /// Two triangles an edge, -1 = outside.
    pub dual_edges: Vec<[i32; 2]>,
}

/// The arrays of a [`Diagram`], borrowed from whoever owns them.
#[derive(Debug, Clone, Copy)]
pub struct DiagramView<'a> {
    /// See [`Diagram::sites`].
    pub sites: &'a [Point],
    /// See [`Diagram::triangles`].
    pub triangles: &'a [[i32; 3]],
    /// See [`Diagram::vertices`].
    pub vertices: &'a [Point],
    /// See [`Diagram::edges`].
    pub edges: &'a [[i32; 2]],
    /// See [`Diagram::dual_edges`].
    pub dual_edges: &'a [[i32; 2]],
}

impl Diagram {
    /// Borrows the arrays.
    pub fn view(&self) -> DiagramView<'_> {
        DiagramView {
            sites: &self.sites,
            triangles: &self.triangles,
            vertices: &self.vertices,
            edges: &self.edges,
            dual_edges: &self.dual_edges,
        }
    }
}

impl DiagramView<'_> {
    /// Checks that every index points somewhere: what follows may then index without a look.
    ///
    /// # Errors
    /// [`Error::BadIndex`] or [`Error::BadLength`] with the first place that does not fit.
    pub fn check(&self) -> Result<()> {
        self.check_lengths()?;
        check_indices("triangles", self.triangles, 0, self.sites.len())?;
        check_indices("edges", self.edges, 0, self.sites.len())?;
        self.check_duals()
    }

    /// Checks that arrays which belong together are as long.
    ///
    /// # Errors
    /// [`Error::BadLength`] with the first that is not.
    pub fn check_lengths(&self) -> Result<()> {
        let length = |array, found, wanted| {
            if found == wanted { Ok(()) } else { Err(Error::BadLength { array, found, wanted }) }
        };
        length("vertices", self.vertices.len(), self.triangles.len())?;
        length("dual_edges", self.dual_edges.len(), self.edges.len())
    }

    /// Whether some edges join sites, and their duals vertices: for who looks at them anyway.
    #[inline(always)]
    pub(crate) fn fits(&self, rows: Range<usize>) -> bool {
        are_indices(&self.edges[rows.clone()], 0, self.sites.len())
            && are_indices(&self.dual_edges[rows], -1, self.vertices.len())
    }

    /// Checks that dual edges join vertices.
    ///
    /// # Errors
    /// [`Error::BadIndex`] with the first that does not.
    pub fn check_duals(&self) -> Result<()> {
        check_indices("dual_edges", self.dual_edges, -1, self.vertices.len())
    }

    /// Checks that there is a triangle, which curves and skeletons need.
    ///
    /// # Errors
    /// [`Error::TooFewSites`] or [`Error::Collinear`].
    pub fn check_triangle(&self) -> Result<()> {
        match self.sites.len() {
            found @ 0..3 => Err(Error::TooFewSites { found }),
            found if self.triangles.is_empty() => Err(Error::Collinear { found }),
            _ => Ok(()),
        }
    }
}
