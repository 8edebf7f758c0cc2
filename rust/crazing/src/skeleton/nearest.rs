//! The nearest-neighbour crust.

use crate::diagram::DiagramView;
use crate::diagram::scale::{Scale, largest};
use crate::error::Result;
use crate::graph::Point;
use crate::incidence::Incidence;
use crate::parallel;
use crate::predicates::{apex_sign, nearer_sign};
use crate::watch::Watch;

/// Whether each edge joins a site to its nearest neighbour, or to the nearest one beyond it: at more than 90 degrees
/// from the first. Neighbours are those of the diagram.
///
/// Distances and angles are compared exactly. Neighbours equally near are all taken, and what is beyond is beyond all
/// of them, so the result depends neither on the order of the sites nor on a turn.
///
/// # Errors
/// [`crate::Error::TooFewSites`], [`crate::Error::Collinear`], [`crate::Error::Interrupted`].
///
/// # Source
/// Dey, Kumar: A Simple Provable Algorithm for Curve Reconstruction (1999).
pub fn nearest(view: DiagramView<'_>, watch: Watch<'_>) -> Result<Vec<bool>> {
    view.check_triangle()?;
    let scale = Scale::of(largest(view.sites));
    let sites: Vec<Point> = view.sites.iter().map(|&p| scale.down(p)).collect();
    let about = Incidence::of(sites.len(), view.edges);
    let of = |site: usize| joined(view, &sites, about.at(site), site as i32);
    let joined = parallel::map_watched(sites.len(), of, watch)?;
    let mut mask = vec![false; view.edges.len()];
    for k in joined.into_iter().flatten() {
        mask[k as usize] = true;
    }
    Ok(mask)
}

/// The edges that `site` asks for.
fn joined(view: DiagramView<'_>, sites: &[Point], edges: &[u32], site: i32) -> Vec<u32> {
    let p = sites[site as usize];
    let other = |k: u32| {
        let [a, b] = view.edges[k as usize];
        sites[if a == site { b } else { a } as usize]
    };
    let mut kept = shortest(p, edges.iter().copied(), other);
    let first: Vec<Point> = kept.iter().map(|&k| other(k)).collect();
    let beyond = |k: &u32| first.iter().all(|&q| apex_sign(q, other(*k), p) < 0.0);
    kept.extend(shortest(p, edges.iter().copied().filter(beyond), other));
    kept
}

/// Those of the edges whose other end is as near to `p` as that of any.
fn shortest(p: Point, edges: impl Iterator<Item = u32>, other: impl Fn(u32) -> Point) -> Vec<u32> {
    let mut kept: Vec<u32> = Vec::new();
    for k in edges {
        let sign = kept.first().map_or(-1.0, |&best| nearer_sign(p, other(k), other(best)));
        if sign < 0.0 {
            kept.clear();
        }
        if sign <= 0.0 {
            kept.push(k);
        }
    }
    kept
}
