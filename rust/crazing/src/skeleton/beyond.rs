//! Where an axis leaves the boundary that it lies within: the centre of a circle through two points of a side and a third
//! is beyond the side.

use super::one_step::opposite;
use crate::diagram::DiagramView;
use crate::diagram::scale::largest;
use crate::error::{Error, Result};
use crate::graph::Point;
use crate::parallel;

/// Part of an edge by which a centre may lie beyond it: there it is rounding.
const SLIGHT: f64 = 1e-6;

/// The edges of a boundary, and for each the site opposite, where the dual vertex on the side of that site lies beyond
/// the edge: for vertices that the kept part of an axis uses.
///
/// # Errors
/// [`Error::BadLength`].
pub fn beyond(view: DiagramView<'_>, boundary: &[bool], kept: &[bool]) -> Result<Vec<[i32; 2]>> {
    let wanted = view.edges.len();
    for (array, found) in [("boundary", boundary.len()), ("axis", kept.len())] {
        if found != wanted {
            return Err(Error::BadLength { array, found, wanted });
        }
    }
    let mut used = vec![false; view.triangles.len()];
    for (duals, _) in view.dual_edges.iter().zip(kept).filter(|(_, kept)| **kept) {
        duals.iter().filter(|&&t| t != -1).for_each(|&t| used[t as usize] = true);
    }
    let far = largest(view.sites);
    let out = |k: usize, t: i32, turn: f64| {
        let ends = view.edges[k];
        let is_out = t != -1 && used[t as usize] && {
            let [p, q] = ends.map(|end| view.sites[end as usize]);
            is_beyond(p, q, view.vertices[t as usize], turn, far)
        };
        is_out.then(|| [k as i32, opposite(view.triangles[t as usize], ends[0], ends[1])])
    };
    let found = parallel::ranges(wanted, |range| {
        let rows = range.filter(|&k| boundary[k]);
        // The triangle on the right of an edge, and that on its left.
        rows.flat_map(|k| {
            let [right, left] = view.dual_edges[k];
            [out(k, right, 1.0), out(k, left, -1.0)]
        })
        .flatten()
        .collect::<Vec<_>>()
    });
    Ok(found.concat())
}

/// Whether a vertex lies on the left of `p` to `q` (`turn` 1), or on the right (-1).
fn is_beyond(p: Point, q: Point, vertex: Point, turn: f64, far: f64) -> bool {
    let (step, to) = ([q[0] - p[0], q[1] - p[1]], [vertex[0] - p[0], vertex[1] - p[1]]);
    let square = step[0] * step[0] + step[1] * step[1];
    let least = SLIGHT * square + 8.0 * f64::EPSILON * far * square.sqrt();
    turn * (step[0] * to[1] - step[1] * to[0]) > least
}
