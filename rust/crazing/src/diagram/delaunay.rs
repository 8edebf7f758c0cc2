//! The only file that names spade: distinct points along a curve to triangles, edges and dual edges.
//!
//! Points are inserted one by one in rounds ([`super::order`]). Bulk loading is not used: see
//! `tests/spade_traps.rs` for the inputs on which it failed, and on samples of curves it is quadratic.

use spade::handles::FixedVertexHandle;
use spade::{DelaunayTriangulation, LastUsedVertexHintGenerator, Point2, Triangulation};

use super::order::{self, Rounds};
use crate::error::{Error, Result};
use crate::graph::Point;
use crate::parallel;
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
            let Rounds { order, near } = order::rounds(points);
            // spade searches linearly while all its vertices are on one line, so a triangle goes first.
            let seed = [0, 1, corner as u32];
            let rest = order.into_iter().filter(|i| !seed.contains(i));
            let sequence: Vec<u32> = seed.into_iter().chain(rest).collect();
            read(&insert(points, &sequence, &near, watch)?, &sequence, watch)
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

fn insert(points: &[Point], sequence: &[u32], near: &[u32], watch: Watch<'_>) -> Result<Mesh> {
    let mut mesh = Mesh::with_capacity(points.len(), 3 * points.len(), 2 * points.len());
    let mut vertex_of = vec![0_u32; points.len()];
    for (step, &i) in sequence.iter().enumerate() {
        watch.poll_at(step)?;
        let [x, y] = points[i as usize];
        // From a neighbour, not from the last vertex: a quarter faster on samples of curves.
        let hint = FixedVertexHandle::from_index(vertex_of[near[i as usize] as usize] as usize);
        mesh.insert_with_hint(Point2::new(x, y), hint)
            .map_err(|_| Error::Internal("a prepared coordinate was refused by the triangulation"))?;
        vertex_of[i as usize] = step as u32;
    }
    if mesh.num_vertices() == points.len() {
        Ok(mesh)
    } else {
        Err(Error::Internal("distinct points were merged by the triangulation"))
    }
}

/// Reads the mesh in the order of its own memory (walking it would wait for memory at every step), then sorts
/// triangles and edges by their lowest site: neighbours in the plane are then neighbours in memory.
fn read(mesh: &Mesh, sequence: &[u32], watch: Watch<'_>) -> Result<Topology> {
    let (edges, (triangles, triangle_of)) =
        parallel::join(sequence.len(), || Edges::read(mesh, sequence, watch), || read_triangles(mesh, sequence));
    let Edges { rows, places } = edges?;
    let mut topology = Topology { triangles, edges: vec![[0; 2]; rows.len()], dual_edges: vec![[0; 2]; rows.len()] };
    for ([from, to, right, left], place) in rows.into_iter().zip(places) {
        topology.edges[place as usize] = [from, to];
        topology.dual_edges[place as usize] = [triangle_of[right as usize], triangle_of[left as usize]];
    }
    Ok(topology)
}

/// Edges in the mesh's order, and their places when sorted by the lower end.
struct Edges {
    /// From, to, and the faces on the right and on the left.
    rows: Vec<[i32; 4]>,
    places: Vec<i32>,
}

impl Edges {
    fn read(mesh: &Mesh, sequence: &[u32], watch: Watch<'_>) -> Result<Self> {
        let site = |vertex: usize| sequence[vertex] as i32;
        let mut rows = Vec::with_capacity(mesh.num_undirected_edges());
        for (step, edge) in mesh.undirected_edges().enumerate() {
            watch.poll_at(step)?;
            let edge = edge.as_directed();
            let faces = [edge.rev(), edge].map(|side| side.face().fix().index() as i32);
            rows.push([site(edge.from().index()), site(edge.to().index()), faces[0], faces[1]]);
        }
        let places = sorted_places(rows.iter().map(|row| row[0].min(row[1])), sequence.len());
        Ok(Self { rows, places })
    }
}

/// Triangles sorted by their lowest corner, and the number of every face (-1 for the outside).
fn read_triangles(mesh: &Mesh, sequence: &[u32]) -> (Vec<[i32; 3]>, Vec<i32>) {
    let corners: Vec<[i32; 3]> =
        mesh.inner_faces().map(|face| face.vertices().map(|vertex| sequence[vertex.index()] as i32)).collect();
    let lowest = corners.iter().map(|&[a, b, c]| a.min(b).min(c));
    let places = sorted_places(lowest, sequence.len());
    let mut triangles = vec![[0; 3]; corners.len()];
    let mut triangle_of = vec![-1; mesh.num_all_faces()];
    for ((face, corners), place) in mesh.inner_faces().zip(corners).zip(places) {
        triangles[place as usize] = corners;
        triangle_of[face.index()] = place;
    }
    (triangles, triangle_of)
}

/// The place of each item when sorted by its key, which is less than `keys`, stably.
fn sorted_places(items: impl Iterator<Item = i32> + Clone, keys: usize) -> Vec<i32> {
    let mut next = vec![0_i32; keys + 1];
    for key in items.clone() {
        next[key as usize + 1] += 1;
    }
    for i in 1..next.len() {
        next[i] += next[i - 1];
    }
    let take = |key: i32| {
        let place = &mut next[key as usize];
        *place += 1;
        *place - 1
    };
    items.map(take).collect()
}
