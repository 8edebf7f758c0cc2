//! The edge table seen through Guibas and Stolfi's quad-edge.
//!
//! Quarter-edge `q = 4k + r` is edge `k` turned by `r` quarters: `r` = 0 runs from `edges[k][0]` to `edges[k][1]`, 1 is
//! its dual from the right to the left, 2 and 3 are these two reversed. `rot` and `sym` are arithmetic; only `onext`
//! needs links.
//!
//! # Source
//! Guibas, Stolfi: Primitives for the Manipulation of General Subdivisions (1985).

use crate::diagram::DiagramView;
use crate::error::{Error, Result};

/// The dual of `q`, from its right to its left.
#[inline]
pub fn rot(q: i32) -> i32 {
    (q & !3) | ((q + 1) & 3)
}

/// The dual of `q`, from its left to its right.
#[inline]
pub fn inv_rot(q: i32) -> i32 {
    (q & !3) | ((q + 3) & 3)
}

/// `q` reversed.
#[inline]
pub fn sym(q: i32) -> i32 {
    q ^ 2
}

/// The next quarter-edge counter-clockwise about the same origin, for every quarter-edge.
///
/// # Errors
/// [`Error::Inconsistent`] when triangles, edges and dual edges do not belong together; [`Error::TooMany`].
pub fn onext(view: DiagramView<'_>) -> Result<Vec<i32>> {
    let quarters = 4 * view.edges.len();
    if quarters > i32::MAX as usize {
        return Err(Error::TooMany { what: "edges", found: view.edges.len(), limit: i32::MAX as usize / 4 });
    }
    let mut onext = vec![-1; quarters];
    if view.triangles.is_empty() {
        link_path(view, &mut onext);
    } else {
        link_triangles(view, &mut onext)?;
    }
    // Rot Onext Rot Onext = 1 gives the dual quarter-edges from the primal ones.
    for q in (0..quarters as i32).step_by(2) {
        let next = onext[q as usize];
        onext[rot(next) as usize] = inv_rot(q);
    }
    match onext.iter().position(|&next| next == -1) {
        Some(q) => Err(Error::Inconsistent { array: "edges", row: q / 4 }),
        None => Ok(onext),
    }
}

/// The edge that starts at each corner of each triangle, and the edge of the outside that ends at each site.
struct Sides {
    inner: Vec<[i32; 3]>,
    outer: Vec<i32>,
}

fn link_triangles(view: DiagramView<'_>, onext: &mut [i32]) -> Result<()> {
    let sides = sides(view)?;
    let bad = |row| Error::Inconsistent { array: "dual_edges", row };
    for (k, (ends, duals)) in view.edges.iter().zip(view.dual_edges).enumerate() {
        for (r, face) in [(0, duals[1]), (2, duals[0])] {
            let origin = ends[r / 2];
            // The edge before this one about the face on its left, reversed.
            let before = match face {
                -1 => sides.outer[origin as usize],
                t => sides.inner[t as usize][(corner(view, t, origin).ok_or_else(|| bad(k))? + 2) % 3],
            };
            if before == -1 {
                return Err(bad(k));
            }
            onext[4 * k + r] = sym(before);
        }
    }
    Ok(())
}

fn sides(view: DiagramView<'_>) -> Result<Sides> {
    let mut sides = Sides { inner: vec![[-1; 3]; view.triangles.len()], outer: vec![-1; view.sites.len()] };
    for (k, (ends, duals)) in view.edges.iter().zip(view.dual_edges).enumerate() {
        for (r, face) in [(0, duals[1]), (2, duals[0])] {
            let q = 4 * k as i32 + r;
            let (origin, end) = (ends[r as usize / 2], ends[1 - r as usize / 2]);
            if face == -1 {
                sides.outer[end as usize] = q;
            } else {
                let at = corner(view, face, origin).ok_or(Error::Inconsistent { array: "dual_edges", row: k })?;
                sides.inner[face as usize][at] = q;
            }
        }
    }
    Ok(sides)
}

fn corner(view: DiagramView<'_>, triangle: i32, site: i32) -> Option<usize> {
    view.triangles[triangle as usize].iter().position(|&c| c == site)
}

/// Sites on one line: at most two edges a site, each followed by the other.
fn link_path(view: DiagramView<'_>, onext: &mut [i32]) {
    let mut out = vec![-1; view.sites.len()];
    for (k, ends) in view.edges.iter().enumerate() {
        for r in [0, 2] {
            let q = 4 * k + r;
            let first = std::mem::replace(&mut out[ends[r / 2] as usize], q as i32);
            if first == -1 {
                onext[q] = q as i32;
            } else {
                onext[q] = first;
                onext[first as usize] = q as i32;
            }
        }
    }
}
