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
    let site = |i: i32| {
        let p = view.sites[i as usize];
        if scale.is_one() { p } else { scale.down(p) }
    };
    Ok(parallel::map(view.edges.len(), |k| is_crust(view, k, &site)))
}

#[inline]
fn is_crust(view: DiagramView<'_>, k: usize, site: &impl Fn(i32) -> Point) -> bool {
    let [p, q] = view.edges[k];
    let apex = |triangle: i32| site(opposite(view.triangles[triangle as usize], p, q));
    match view.dual_edges[k] {
        [-1, -1] => false,
        [t, -1] | [-1, t] => apex_sign(site(p), site(q), apex(t)) > 0.0,
        [right, left] => one_step_sign(site(p), site(q), apex(right), apex(left)) >= 0.0,
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
