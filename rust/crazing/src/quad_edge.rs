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
/// `shifts` are the periods that each edge crosses, on a torus; none in the plane. On a torus of one site they alone
/// tell the sides of a triangle apart.
///
/// # Errors
/// [`Error::Inconsistent`] when triangles, edges and dual edges do not belong together; [`Error::TooMany`];
/// [`Error::BadLength`].
pub fn onext(view: DiagramView<'_>, shifts: Option<&[[i8; 2]]>) -> Result<Vec<i32>> {
    let quarters = 4 * view.edges.len();
    if quarters > i32::MAX as usize {
        return Err(Error::TooMany { what: "edges", found: view.edges.len(), limit: i32::MAX as usize / 4 });
    }
    if let Some(found) = shifts.map(<[_]>::len).filter(|&found| found != view.edges.len()) {
        return Err(Error::BadLength { array: "shifts", found, wanted: view.edges.len() });
    }
    let mut onext = vec![-1; quarters];
    if view.triangles.is_empty() {
        link_path(view, &mut onext);
    } else {
        link_triangles(view, shifts, &mut onext)?;
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

/// The three edges that have each triangle on their left, counter-clockwise, and the edge of the outside that ends at
/// each site.
struct Sides {
    inner: Vec<[i32; 3]>,
    outer: Vec<i32>,
}

fn link_triangles(view: DiagramView<'_>, shifts: Option<&[[i8; 2]]>, onext: &mut [i32]) -> Result<()> {
    let sides = sides(view, shifts)?;
    for (k, (ends, duals)) in view.edges.iter().zip(view.dual_edges).enumerate() {
        for (r, face) in [(0, duals[1]), (2, duals[0])] {
            let q = 4 * k as i32 + r;
            // The edge before this one about the face on its left, reversed.
            let before = match face {
                -1 => sides.outer[ends[r as usize / 2] as usize],
                t => {
                    let around = sides.inner[t as usize];
                    around.iter().position(|&side| side == q).map_or(-1, |at| around[(at + 2) % 3])
                }
            };
            if before == -1 {
                return Err(Error::Inconsistent { array: "dual_edges", row: k });
            }
            onext[q as usize] = sym(before);
        }
    }
    Ok(())
}

fn sides(view: DiagramView<'_>, shifts: Option<&[[i8; 2]]>) -> Result<Sides> {
    let mut sides = Sides { inner: vec![[-1; 3]; view.triangles.len()], outer: vec![-1; view.sites.len()] };
    for (k, (ends, duals)) in view.edges.iter().zip(view.dual_edges).enumerate() {
        let bad = Error::Inconsistent { array: "dual_edges", row: k };
        for (r, face) in [(0, duals[1]), (2, duals[0])] {
            let q = 4 * k as i32 + r;
            if face == -1 {
                sides.outer[ends[1 - r as usize / 2] as usize] = q;
                continue;
            }
            let corners = &view.triangles[face as usize];
            let free = sides.inner[face as usize].iter_mut().find(|side| **side == -1);
            match free.filter(|_| ends.iter().all(|end| corners.contains(end))) {
                Some(slot) => *slot = q,
                None => return Err(bad),
            }
        }
    }
    let ends = |q: i32| if q & 2 == 0 { view.edges[q as usize / 4] } else { swapped(view.edges[q as usize / 4]) };
    let shift = |q: i32| {
        let [x, y] = shifts.map_or([0, 0], |shifts| shifts[q as usize / 4]).map(i32::from);
        if q & 2 == 0 { [x, y] } else { [-x, -y] }
    };
    for around in &mut sides.inner {
        if let Some(row) = around.iter().position(|&side| side == -1) {
            let row = around[(row + 2) % 3].max(0) as usize / 4;
            return Err(Error::Inconsistent { array: "dual_edges", row });
        }
        let follow = |[a, b, c]: [i32; 3]| {
            let pairs = [(a, b), (b, c), (c, a)];
            pairs.into_iter().all(|(from, to)| ends(from)[1] == ends(to)[0])
        };
        let turned = [around[0], around[2], around[1]];
        // Where all three corners are one site, either order follows; the counter-clockwise one turns left.
        let left = |[a, b, _]: [i32; 3]| {
            let ([ax, ay], [bx, by]) = (shift(a), shift(b));
            ax * by > ay * bx
        };
        match (follow(*around), follow(turned)) {
            (true, false) => {}
            (false, true) => *around = turned,
            (true, true) if left(*around) => {}
            (true, true) if left(turned) => *around = turned,
            _ => return Err(Error::Inconsistent { array: "dual_edges", row: around[0] as usize / 4 }),
        }
    }
    Ok(sides)
}

fn swapped([a, b]: [i32; 2]) -> [i32; 2] {
    [b, a]
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
