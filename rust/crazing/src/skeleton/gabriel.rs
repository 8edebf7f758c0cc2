//! The Gabriel graph: the thesis' own wording of the one-step crust.

use super::one_step::opposite;
use crate::diagram::DiagramView;
use crate::diagram::scale::{Scale, largest};
use crate::error::Result;
use crate::parallel;
use crate::predicates::apex_sign;

/// Whether each edge is crossed by its dual, i.e. no angle opposite it is obtuse: no site lies within the circle that
/// has the edge as its diameter.
///
/// Signs are exact; a right angle is none that is obtuse, on both sides or on the one side of a hull edge. Of the two
/// diagonals of a rectangle the diagram has one, and that one is kept.
///
/// # Errors
/// [`crate::Error::TooFewSites`] or [`crate::Error::Collinear`].
///
/// # Source
/// Thesis, section 5.3, read literally; Gabriel, Sokal: A New Statistical Approach to Geographic Variation (1969).
pub fn gabriel(view: DiagramView<'_>) -> Result<Vec<bool>> {
    view.check_triangle()?;
    let scale = Scale::of(largest(view.sites));
    let site = |i: i32| scale.down(view.sites[i as usize]);
    let keeps = |[p, q]: [i32; 2], t: i32| {
        t == -1 || apex_sign(site(p), site(q), site(opposite(view.triangles[t as usize], p, q))) >= 0.0
    };
    Ok(parallel::map(view.edges.len(), |k| view.dual_edges[k].iter().all(|&t| keeps(view.edges[k], t))))
}
