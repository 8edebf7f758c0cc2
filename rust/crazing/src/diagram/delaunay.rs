//! The only file that names spade: distinct points along a curve to triangles, edges and dual edges.
//!
//! Points are inserted one by one in rounds ([`super::order`]). Bulk loading is not used: see
//! `tests/spade_traps.rs` for the inputs on which it failed, and on samples of curves it is quadratic.

use spade::{DelaunayTriangulation, LastUsedVertexHintGenerator, Point2, Triangulation};

use super::order;
use crate::error::{Error, Result};
use crate::graph::Point;
use crate::predicates::orientation;
use crate::watch::Watch;

/// Who borders on whom, in the layout of [`super::Diagram`] with sites numbered along the curve.
#[derive(Debug, Default)]
pub(super) struct Topology {
    pub(super) triangles: Vec<[i32; 3]>,
    pub(super) edges: Vec<[i32; 2]>,
    pub(super) dual_edges: Vec<[i32; 2]>,
}

/// Vertices are numbered by their step of insertion.
type Mesh = DelaunayTriangulation<Point2<f64>, (), (), (), LastUsedVertexHintGenerator>;

/// Triangulates distinct points that follow a Hilbert curve.
pub(super) fn triangulate(points: &[Point], watch: Watch<'_>) -> Result<Topology> {
    match (2..points.len()).find(|&i| orientation(points[0], points[1], points[i]) != 0.0) {
        None => Ok(path(points)),
        Some(corner) => {
            // spade searches linearly while all its vertices are on one line, so a triangle goes first.
            let seed = [0, 1, corner as u32];
            let rest = order::rounds(points).into_iter().filter(|i| !seed.contains(i));
            let sequence: Vec<u32> = seed.into_iter().chain(rest).collect();
            read(&insert(points, &sequence, watch)?, &sequence, watch)
        }
    }
}

/// All points on one line: neighbours along it are joined, and there is no triangle.
fn path(points: &[Point]) -> Topology {
    let mut rows: Vec<usize> = (0..points.len()).collect();
    rows.sort_unstable_by(|&a, &b| points[a][0].total_cmp(&points[b][0]).then(points[a][1].total_cmp(&points[b][1])));
    let edges: Vec<[i32; 2]> = rows.windows(2).map(|pair| [pair[0] as i32, pair[1] as i32]).collect();
    Topology { triangles: Vec::new(), dual_edges: vec![[-1, -1]; edges.len()], edges }
}

fn insert(points: &[Point], sequence: &[u32], watch: Watch<'_>) -> Result<Mesh> {
    let mut mesh = Mesh::with_capacity(points.len(), 3 * points.len(), 2 * points.len());
    for (step, &i) in sequence.iter().enumerate() {
        watch.poll_at(step)?;
        let [x, y] = points[i as usize];
        mesh.insert(Point2::new(x, y))
            .map_err(|_| Error::Internal("a prepared coordinate was refused by the triangulation"))?;
    }
    if mesh.num_vertices() == points.len() {
        Ok(mesh)
    } else {
        Err(Error::Internal("distinct points were merged by the triangulation"))
    }
}

/// Corner not yet known.
const UNKNOWN: u32 = u32::MAX;

/// Reads the mesh in the order of its own memory (walking it would wait for memory at every step), then sorts
/// triangles and edges by their lowest site: neighbours in the plane are then neighbours in memory.
fn read(mesh: &Mesh, sequence: &[u32], watch: Watch<'_>) -> Result<Topology> {
    let mut corners = vec![[UNKNOWN; 3]; mesh.num_all_faces()];
    let mut edges = Vec::with_capacity(mesh.num_undirected_edges());
    for (step, edge) in mesh.undirected_edges().enumerate() {
        watch.poll_at(step)?;
        let edge = edge.as_directed();
        let (from, to) = (sequence[edge.from().index()], sequence[edge.to().index()]);
        let (left, right) = (edge.face().fix().index(), edge.rev().face().fix().index());
        note_side(&mut corners[left], from, to);
        note_side(&mut corners[right], to, from);
        edges.push([from, to, right as u32, left as u32]);
    }
    let outer = mesh.outer_face().fix().index();
    let (triangles, triangle_of) = number_triangles(&corners, outer, sequence.len());
    let (edges, dual_edges) = number_edges(&edges, &triangle_of, sequence.len());
    Ok(Topology { triangles, edges, dual_edges })
}

/// Notes the side `from` to `to` of a triangle that lies on its left.
fn note_side(corners: &mut [u32; 3], from: u32, to: u32) {
    match *corners {
        [UNKNOWN, ..] => *corners = [from, to, UNKNOWN],
        [a, b, UNKNOWN] => corners[2] = if from == a || from == b { to } else { from },
        _ => {}
    }
}

/// Triangles by their lowest corner, and the new number of every face (-1 for the outside).
fn number_triangles(corners: &[[u32; 3]], outer: usize, sites: usize) -> (Vec<[i32; 3]>, Vec<i32>) {
    let lowest = |face: usize| (face != outer).then(|| corners[face][0].min(corners[face][1]).min(corners[face][2]));
    let triangle_of = sorted_places(corners.len(), sites, lowest);
    let mut triangles = vec![[0; 3]; corners.len() - 1];
    for (face, &place) in triangle_of.iter().enumerate().filter(|&(face, _)| face != outer) {
        triangles[place as usize] = corners[face].map(|site| site as i32);
    }
    (triangles, triangle_of)
}

/// Edges by their lower end.
fn number_edges(edges: &[[u32; 4]], triangle_of: &[i32], sites: usize) -> (Vec<[i32; 2]>, Vec<[i32; 2]>) {
    let places = sorted_places(edges.len(), sites, |k| Some(edges[k][0].min(edges[k][1])));
    let mut ends = vec![[0; 2]; edges.len()];
    let mut sides = vec![[0; 2]; edges.len()];
    for (&[from, to, right, left], &place) in edges.iter().zip(&places) {
        ends[place as usize] = [from as i32, to as i32];
        sides[place as usize] = [triangle_of[right as usize], triangle_of[left as usize]];
    }
    (ends, sides)
}

/// The place of each item when sorted by its key below `keys`, stably; -1 for an item without a key.
fn sorted_places(items: usize, keys: usize, key: impl Fn(usize) -> Option<u32>) -> Vec<i32> {
    let mut next = vec![0_i32; keys + 1];
    for key in (0..items).filter_map(&key) {
        next[key as usize + 1] += 1;
    }
    for i in 1..next.len() {
        next[i] += next[i - 1];
    }
    let mut take = |key: u32| {
        let place = &mut next[key as usize];
        *place += 1;
        *place - 1
    };
    (0..items).map(|item| key(item).map_or(-1, &mut take)).collect()
}
