//! The one-step crust: every edge is crust, or its dual is anti-crust.

use crate::diagram::DiagramView;
use crate::diagram::scale::{Scale, largest};
use crate::error::Result;
use crate::graph::Point;
use crate::parallel;
use crate::predicates::{apex_sign, one_step_sign};

/// Whether each edge is crust: some circle through its ends contains neither end of its dual.
///
/// An edge of the hull is crust when the angle opposite it is acute. Signs are exact; a tie is crust, but for the
/// hull, where the circle would have to be a line.
///
/// # Errors
/// [`crate::Error::TooFewSites`] or [`crate::Error::Collinear`].
///
/// # Source
/// Gold, Snoeyink: A One-Step Crust and Skeleton Extraction Algorithm (2001); thesis, section 5.3.
pub fn one_step(view: DiagramView<'_>) -> Result<Vec<bool>> {
    view.check_triangle()?;
    let scale = Scale::of(largest(view.sites));
    let sites = scale.all_down(view.sites);
    Ok(parallel::map(view.edges.len(), |k| is_crust(view, &sites, k)))
}

#[inline]
fn is_crust(view: DiagramView<'_>, sites: &[Point], k: usize) -> bool {
    let ends = view.edges[k];
    let [p, q] = ends.map(|site| sites[site as usize]);
    // What is left of a triangle's corners when the two ends are taken out; arrays of others may leave no site at all.
    let apex = |t: i32| {
        let [a, b, c] = view.triangles[t as usize];
        sites.get((a ^ b ^ c ^ ends[0] ^ ends[1]) as usize).copied().unwrap_or(p)
    };
    match view.dual_edges[k] {
        [-1, -1] => false,
        [t, -1] | [-1, t] => apex_sign(p, q, apex(t)) > 0.0,
        [right, left] => one_step_sign(p, q, apex(right), apex(left)) >= 0.0,
    }
}

/// The corner that is neither `p` nor `q`.
#[inline]
pub(super) fn opposite(corners: [i32; 3], p: i32, q: i32) -> i32 {
    let other = |c: i32| c != p && c != q;
    if other(corners[0]) {
        corners[0]
    } else if other(corners[1]) {
        corners[1]
    } else {
        corners[2]
    }
}
