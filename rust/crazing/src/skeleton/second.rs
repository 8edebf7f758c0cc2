//! The thesis' own way: a second triangulation, of sites and Voronoi vertices together.

use super::far::near;
use super::one_step;
use crate::diagram::scale::{Scale, largest};
use crate::diagram::{DiagramView, representatives, triangulate_near_one};
use crate::error::Result;
use crate::graph::Point;
use crate::watch::Watch;

/// What the second triangulation says of the first.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Second {
    /// Two-pass crust: rows of `edges` that are edges of it.
    pub crust: Vec<bool>,
    /// Initial axis: its edges between two Voronoi vertices, coincident ones represented by the lowest triangle.
    pub axis: Vec<[i32; 2]>,
    /// Edge-filtered axis: rows of `dual_edges` that are in `axis`.
    pub filtered: Vec<bool>,
}

/// Triangulates sites and Voronoi vertices together and sorts the edges by their ends.
///
/// # Errors
/// [`crate::Error::TooFewSites`], [`crate::Error::Collinear`], [`crate::Error::Interrupted`].
///
/// # Source
/// Amenta, Bern, Eppstein: The Crust and the Beta-Skeleton (1998); thesis, sections 4.1, 4.2 and 5.2.
pub fn second(view: DiagramView<'_>, watch: Watch<'_>) -> Result<Second> {
    view.check_triangle()?;
    let representative = representatives(view);
    let distinct: Vec<i32> = (0..representative.len() as i32).filter(|&t| representative[t as usize] == t).collect();
    let scale = Scale::of(largest(view.sites));
    let mut points: Vec<Point> = view.sites.iter().map(|&p| scale.down(p)).collect();
    points.extend(distinct.iter().map(|&t| near(scale.down(view.vertices[t as usize]))));
    let (first_row, edges) = triangulate_near_one(points, watch)?;
    let found = Ends::sort(&edges, &first_row, &distinct, view.sites.len());
    let dual = |k: usize| view.dual_edges[k].map(|t| if t == -1 { -1 } else { representative[t as usize] });
    // Whether the two ends of its own dual let an edge be crust is known exactly, not only for rounded vertices.
    let one_step = one_step(view)?;
    let is_crust = |k: usize| one_step[k] && found.crust.binary_search(&ordered(view.edges[k])).is_ok();
    let is_axis = |k: usize| !one_step[k] && found.axis.binary_search(&ordered(dual(k))).is_ok();
    Ok(Second {
        crust: (0..view.edges.len()).map(is_crust).collect(),
        filtered: (0..view.edges.len()).map(is_axis).collect(),
        axis: found.axis,
    })
}

fn ordered([a, b]: [i32; 2]) -> [i32; 2] {
    [a.min(b), a.max(b)]
}

/// Edges between two sites, and between two Voronoi vertices, each sorted.
struct Ends {
    crust: Vec<[i32; 2]>,
    axis: Vec<[i32; 2]>,
}

impl Ends {
    fn sort(edges: &[[i32; 2]], first_row: &[u32], distinct: &[i32], sites: usize) -> Self {
        let mut found = Self { crust: Vec::new(), axis: Vec::new() };
        for edge in edges {
            let rows = edge.map(|point| first_row[point as usize] as usize);
            match rows.map(|row| row < sites) {
                [true, true] => found.crust.push(ordered(rows.map(|row| row as i32))),
                [false, false] => found.axis.push(ordered(rows.map(|row| distinct[row - sites]))),
                _ => {}
            }
        }
        found.crust.sort_unstable();
        found.axis.sort_unstable();
        found
    }
}
