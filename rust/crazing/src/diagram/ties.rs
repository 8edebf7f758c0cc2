//! Cocircular sites made independent of the order of insertion: their polygon becomes a fan.
//!
//! Copies of one polygon, a period apart, would otherwise be cut by different diagonals.

use super::delaunay::Topology;
use super::vertices::coincide;
use crate::graph::Point;
use crate::parallel;
use crate::predicates::in_circle;

/// Cuts every polygon of cocircular sites into a fan about its lowest corner, by x and then y: a choice that does not
/// change when the polygon is moved.
///
/// `centres` are the circumcentres of the triangles: where they differ much there is no need of an exact sign. Whether
/// any of neighbours may coincide.
pub(super) fn settle(topology: &mut Topology, points: &[Point], centres: &[Point]) -> bool {
    let near = |k: usize| match topology.dual_edges[k] {
        [-1, _] | [_, -1] => false,
        [r, s] => may_be_one(centres[r as usize], centres[s as usize], points[topology.edges[k][0] as usize]),
    };
    let Some(first) = parallel::first(topology.edges.len(), near) else { return false };
    let tied = parallel::map(topology.edges.len() - first, |k| near(first + k) && is_tied(topology, points, first + k));
    let seeds: Vec<usize> = (first..topology.edges.len()).filter(|&k| tied[k - first]).collect();
    if seeds.is_empty() {
        return true;
    }
    let edges_of = edges_of(topology);
    let mut seen = vec![false; topology.triangles.len()];
    for k in seeds {
        let first = topology.dual_edges[k][0];
        if !std::mem::replace(&mut seen[first as usize], true) {
            let polygon = Polygon::around(topology, points, &edges_of, first, &mut seen);
            polygon.fan(topology, points);
        }
    }
    true
}

/// Whether two rounded centres of circles through `site` may be those of one circle.
fn may_be_one(a: Point, b: Point, site: Point) -> bool {
    // Of circles far smaller than their distance from the origin, the rounding of the centres is what parts them.
    let size = |v: Point| v[0].abs().max(v[1].abs());
    size([a[0] - b[0], a[1] - b[1]]) <= 8.0 * f64::EPSILON * size(a) || coincide(a, b, site)
}

/// Whether the two triangles at an edge have one circumcircle.
fn is_tied(topology: &Topology, points: &[Point], k: usize) -> bool {
    let (ends, sides) = (topology.edges[k], topology.dual_edges[k]);
    if sides.contains(&-1) {
        return false;
    }
    let apex = |t: i32| topology.triangles[t as usize].into_iter().find(|corner| !ends.contains(corner));
    match sides.map(apex) {
        [Some(r), Some(s)] => {
            let [p, q, r, s] = [ends[0], ends[1], r, s].map(|corner| points[corner as usize]);
            in_circle(p, q, s, r) == 0.0
        }
        _ => false,
    }
}

/// The three edges of every triangle.
fn edges_of(topology: &Topology) -> Vec<[i32; 3]> {
    let mut edges_of = vec![[-1; 3]; topology.triangles.len()];
    for (k, sides) in topology.dual_edges.iter().enumerate() {
        for &t in sides.iter().filter(|&&t| t != -1) {
            if let Some(free) = edges_of[t as usize].iter_mut().find(|edge| **edge == -1) {
                *free = k as i32;
            }
        }
    }
    edges_of
}

/// Triangles of one circumcircle.
struct Polygon {
    triangles: Vec<i32>,
    diagonals: Vec<i32>,
    /// Corner, the next corner counter-clockwise, and the edge between them.
    outline: Vec<(i32, i32, i32)>,
}

impl Polygon {
    fn around(topology: &Topology, points: &[Point], edges_of: &[[i32; 3]], first: i32, seen: &mut [bool]) -> Self {
        let mut polygon = Self { triangles: vec![first], diagonals: Vec::new(), outline: Vec::new() };
        let mut next = 0;
        while let Some(&t) = polygon.triangles.get(next) {
            next += 1;
            for k in edges_of[t as usize] {
                let [right, left] = topology.dual_edges[k as usize];
                let [from, to] = topology.edges[k as usize];
                if !is_tied(topology, points, k as usize) {
                    polygon.outline.push(if left == t { (from, to, k) } else { (to, from, k) });
                    continue;
                }
                let other = if left == t { right } else { left };
                if !std::mem::replace(&mut seen[other as usize], true) {
                    polygon.triangles.push(other);
                    polygon.diagonals.push(k);
                }
            }
        }
        polygon.triangles.sort_unstable();
        polygon.diagonals.sort_unstable();
        polygon.outline.sort_unstable();
        polygon
    }

    /// Corners and sides counter-clockwise from the lowest corner.
    fn walk(&self, points: &[Point]) -> Vec<(i32, i32, i32)> {
        let compare = |a: i32, b: i32| {
            let [p, q] = [a, b].map(|corner| points[corner as usize]);
            p[0].total_cmp(&q[0]).then(p[1].total_cmp(&q[1]))
        };
        let lowest = self.outline.iter().copied().min_by(|a, b| compare(a.0, b.0));
        let after =
            |corner: i32| self.outline.binary_search_by_key(&corner, |side| side.0).ok().map(|row| self.outline[row]);
        std::iter::successors(lowest, |side| after(side.1)).take(self.outline.len()).collect()
    }

    fn fan(&self, topology: &mut Topology, points: &[Point]) {
        let sides = self.walk(points);
        let last = self.triangles.len() - 1;
        let hub = sides[0].0;
        for (i, &t) in self.triangles.iter().enumerate() {
            topology.triangles[t as usize] = [hub, sides[i + 1].0, sides[i + 2].0];
        }
        for (i, &k) in self.diagonals.iter().enumerate() {
            topology.edges[k as usize] = [hub, sides[i + 2].0];
            topology.dual_edges[k as usize] = [self.triangles[i], self.triangles[i + 1]];
        }
        for (i, &(from, _, k)) in sides.iter().enumerate() {
            let inside = self.triangles[i.saturating_sub(1).min(last)];
            let is_left = topology.edges[k as usize][0] == from;
            topology.dual_edges[k as usize][usize::from(is_left)] = inside;
        }
    }
}
