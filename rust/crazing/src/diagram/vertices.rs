//! Voronoi vertices: circumcentres, with coincident neighbours made equal.

use super::DiagramView;
use super::delaunay::Topology;
use crate::graph::Point;
use crate::parallel;
use crate::predicates::circumcentre;
use crate::sets::DisjointSets;

/// Neighbouring circumcentres no farther apart than this part of the circumradius are one Voronoi vertex.
pub(crate) const COINCIDENT: f64 = 1e-9;

/// One vertex a triangle. Coincident neighbours all get the position of the lowest triangle among them, so that a
/// dual edge has no length exactly when its two ends are equal.
pub(super) fn vertices(sites: &[Point], topology: &Topology) -> Vec<Point> {
    let corner = |site: i32| sites[site as usize];
    let mut vertices = parallel::map(topology.triangles.len(), |t| {
        let [a, b, c] = topology.triangles[t];
        circumcentre(corner(a), corner(b), corner(c))
    });
    let coincident = |k: usize| {
        let ([right, left], site) = (topology.dual_edges[k], topology.edges[k][0]);
        right != -1 && left != -1 && coincide(vertices[right as usize], vertices[left as usize], corner(site))
    };
    if let Some(first) = parallel::first(topology.edges.len(), coincident) {
        let mut sets = DisjointSets::new(vertices.len());
        for k in (first..topology.edges.len()).filter(|&k| coincident(k)) {
            let [right, left] = topology.dual_edges[k];
            sets.unite(right as usize, left as usize);
        }
        for triangle in 0..vertices.len() {
            vertices[triangle] = vertices[sets.lowest(triangle)];
        }
    }
    vertices
}

/// Whether two circumcentres of neighbours, on circles through `site`, are one vertex.
pub(super) fn coincide(a: Point, b: Point, site: Point) -> bool {
    let apart = [a[0] - b[0], a[1] - b[1]];
    let radius = [a[0] - site[0], a[1] - site[1]];
    // Nearly all pairs are told apart without a root; sizes, not squares, since far vertices would overflow.
    let size = |v: Point| v[0].abs().max(v[1].abs());
    size(apart) <= 2.0 * COINCIDENT * size(radius)
        && libm::hypot(apart[0], apart[1]) <= COINCIDENT * libm::hypot(radius[0], radius[1])
}

/// For every triangle the lowest one that shares its Voronoi vertex.
pub fn representatives(view: DiagramView<'_>) -> Vec<i32> {
    let pair = |k: usize| shares(view, k).then(|| view.dual_edges[k]);
    lowest_of(view.vertices.len(), &parallel::compact(view.dual_edges.len(), pair))
}

/// The same of so many triangles, where all pairs of neighbours that share a vertex are known.
pub(crate) fn lowest_of(triangles: usize, pairs: &[[i32; 2]]) -> Vec<i32> {
    let mut sets = DisjointSets::new(triangles);
    for &[right, left] in pairs {
        sets.unite(right as usize, left as usize);
    }
    sets.into_lowest(pairs.as_flattened().iter().map(|&triangle| triangle as usize))
}

/// Whether the triangles on both sides of an edge share their Voronoi vertex.
#[inline]
pub(crate) fn shares(view: DiagramView<'_>, k: usize) -> bool {
    let [right, left] = view.dual_edges[k];
    right != -1 && left != -1 && view.vertices[right as usize] == view.vertices[left as usize]
}
