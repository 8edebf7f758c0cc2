//! The only file that names spade: distinct points along a curve to triangles, edges and dual edges.
//!
//! Points are inserted one by one in rounds ([`super::order`]). Bulk loading is not used: see
//! `tests/spade_traps.rs` for the inputs on which it failed, and on samples of curves it is quadratic.

use spade::handles::FixedVertexHandle;
use spade::{
    ConstrainedDelaunayTriangulation, DelaunayTriangulation, LastUsedVertexHintGenerator, Point2, Triangulation,
};

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
type ConstrainedMesh = ConstrainedDelaunayTriangulation<Point2<f64>, (), (), (), LastUsedVertexHintGenerator>;

/// Triangulates distinct points that follow a Hilbert curve.
pub(super) fn triangulate(points: &[Point], watch: Watch<'_>) -> Result<Topology> {
    match sequence(points) {
        None => Ok(path(points)),
        Some(Rounds { order, near }) => read(&insert::<Mesh>(points, &order, &near, watch)?, &order, watch),
    }
}

/// A triangulation that takes more points.
pub(super) struct Growing {
    mesh: Mesh,
    /// The number of every vertex.
    sequence: Vec<u32>,
}

impl Growing {
    /// Triangulates distinct points that follow a Hilbert curve; None when all lie on one line.
    pub(super) fn of(points: &[Point], watch: Watch<'_>) -> Result<Option<Self>> {
        let Some(Rounds { order, near }) = sequence(points) else { return Ok(None) };
        Ok(Some(Self { mesh: insert(points, &order, &near, watch)?, sequence: order }))
    }

    /// Adds points that differ from each other and from all before. They are numbered on.
    pub(super) fn add(&mut self, points: &[Point], watch: Watch<'_>) -> Result<()> {
        let curve = order::hilbert(points);
        let along: Vec<Point> = curve.iter().map(|&row| points[row as usize]).collect();
        let Rounds { order, near } = order::rounds(&along);
        insert_into(&mut self.mesh, &along, &order, &near, watch)?;
        let before = self.sequence.len() as u32;
        self.sequence.extend(order.into_iter().map(|i| before + curve[i as usize]));
        Ok(())
    }

    /// The numbers of all points in the order of insertion: of those given first, every first part is a random sample.
    pub(super) fn sequence(&self) -> &[u32] {
        &self.sequence
    }

    /// The corners of every triangle.
    pub(super) fn triangles(&self) -> impl Iterator<Item = [u32; 3]> {
        self.mesh.inner_faces().map(|face| face.vertices().map(|vertex| self.sequence[vertex.index()]))
    }

    /// The points on the convex hull.
    pub(super) fn hull(&self) -> impl Iterator<Item = u32> {
        self.mesh.convex_hull().map(|edge| self.sequence[edge.from().index()])
    }

    /// See [`triangulate`].
    pub(super) fn read(&self, watch: Watch<'_>) -> Result<Topology> {
        read(&self.mesh, &self.sequence, watch)
    }
}

/// The same with edges along `constraints`, of which no two cross, and which of the edges these are.
pub(super) fn triangulate_constrained(
    points: &[Point],
    constraints: &[[u32; 2]],
    watch: Watch<'_>,
) -> Result<(Topology, Vec<bool>)> {
    let Some(Rounds { order, near }) = sequence(points) else {
        let topology = path(points);
        let constrained = constrained_path(points, &topology.edges, constraints);
        return Ok((topology, constrained));
    };
    let mut mesh = insert::<ConstrainedMesh>(points, &order, &near, watch)?;
    let mut vertex_of = vec![0; points.len()];
    for (step, &i) in order.iter().enumerate() {
        vertex_of[i as usize] = step;
    }
    for (step, ends) in constraints.iter().enumerate() {
        watch.poll_at(step)?;
        let [from, to] = ends.map(|end| FixedVertexHandle::from_index(vertex_of[end as usize]));
        // Not `add_constraint`, which panics where it cannot: a bug of ours would then be the user's.
        if mesh.try_add_constraint(from, to).is_empty() {
            return Err(Error::Internal("a constraint that crosses none was refused by the triangulation"));
        }
    }
    let mut places = Places::count(lowest_ends(&mesh, &order), order.len());
    let mut constrained = vec![false; mesh.num_undirected_edges()];
    for (edge, lowest) in mesh.undirected_edges().zip(lowest_ends(&mesh, &order)) {
        constrained[places.take(lowest)] = edge.is_constraint_edge();
    }
    Ok((read(&mesh, &order, watch)?, constrained))
}

/// The order of insertion; none when all points lie on one line.
fn sequence(points: &[Point]) -> Option<Rounds> {
    let corner = (2..points.len()).find(|&i| orientation(points[0], points[1], points[i]) != 0.0)?;
    let Rounds { order, near } = order::rounds(points);
    // spade searches linearly while all its vertices are on one line, so a triangle goes first.
    let seed = [0, 1, corner as u32];
    let rest = order.into_iter().filter(|i| !seed.contains(i));
    Some(Rounds { order: seed.into_iter().chain(rest).collect(), near })
}

/// On one line, the edges that lie between the ends of a constraint.
fn constrained_path(points: &[Point], edges: &[[i32; 2]], constraints: &[[u32; 2]]) -> Vec<bool> {
    let at = |i: usize| points[i];
    let spans: Vec<[Point; 2]> = constraints
        .iter()
        .map(|ends| ends.map(|end| at(end as usize)))
        .map(|[a, b]| if a < b { [a, b] } else { [b, a] })
        .collect();
    let held = |ends: &[i32; 2]| {
        let [a, b] = ends.map(|end| at(end as usize));
        spans.iter().any(|&[low, high]| low <= a && b <= high)
    };
    edges.iter().map(held).collect()
}

/// All points on one line: neighbours along it are joined, and there is no triangle.
fn path(points: &[Point]) -> Topology {
    let mut rows: Vec<usize> = (0..points.len()).collect();
    rows.sort_unstable_by(|&a, &b| points[a][0].total_cmp(&points[b][0]).then(points[a][1].total_cmp(&points[b][1])));
    let edges: Vec<[i32; 2]> = rows.windows(2).map(|pair| [pair[0] as i32, pair[1] as i32]).collect();
    Topology { triangles: Vec::new(), dual_edges: vec![[-1, -1]; edges.len()], edges }
}

fn insert<M: Triangulation<Vertex = Point2<f64>>>(
    points: &[Point],
    sequence: &[u32],
    near: &[u32],
    watch: Watch<'_>,
) -> Result<M> {
    let mut mesh = M::with_capacity(points.len(), 3 * points.len(), 2 * points.len());
    insert_into(&mut mesh, points, sequence, near, watch)?;
    Ok(mesh)
}

fn insert_into<M: Triangulation<Vertex = Point2<f64>>>(
    mesh: &mut M,
    points: &[Point],
    sequence: &[u32],
    near: &[u32],
    watch: Watch<'_>,
) -> Result<()> {
    let before = mesh.num_vertices();
    let mut vertex_of = vec![0_u32; points.len()];
    for (step, &i) in sequence.iter().enumerate() {
        watch.poll_at(step)?;
        let [x, y] = points[i as usize];
        // From a neighbour, not from the last vertex: a quarter faster on samples of curves.
        let hint = FixedVertexHandle::from_index(vertex_of[near[i as usize] as usize] as usize);
        mesh.insert_with_hint(Point2::new(x, y), hint)
            .map_err(|_| Error::Internal("a prepared coordinate was refused by the triangulation"))?;
        vertex_of[i as usize] = (before + step) as u32;
    }
    if mesh.num_vertices() == before + points.len() {
        Ok(())
    } else {
        Err(Error::Internal("distinct points were merged by the triangulation"))
    }
}

/// A mesh of spade, with constraints or without, that threads may share.
trait Flat: Triangulation<Vertex = Point2<f64>> + Sync {}

impl<M: Triangulation<Vertex = Point2<f64>> + Sync> Flat for M {}

/// Reads the mesh in the order of its own memory (walking it would wait for memory at every step), and puts triangles
/// and edges in the order of their lowest site: neighbours in the plane are then neighbours in memory. Reading the mesh
/// once for each array is cheaper than fresh memory for what was read.
fn read(mesh: &impl Flat, sequence: &[u32], watch: Watch<'_>) -> Result<Topology> {
    let ((edges, places), (triangles, triangle_of)) = parallel::join(
        sequence.len(),
        || {
            let places = Places::count(lowest_ends(mesh, sequence), sequence.len());
            (read_edges(mesh, sequence, places.clone(), watch), places)
        },
        || read_triangles(mesh, sequence),
    );
    let dual_edges = read_dual_edges(mesh, sequence, places, &triangle_of, watch)?;
    Ok(Topology { triangles, edges: edges?, dual_edges })
}

fn lowest_ends<'a>(mesh: &'a impl Flat, sequence: &'a [u32]) -> impl Iterator<Item = u32> + 'a {
    let site = |vertex: usize| sequence[vertex];
    mesh.undirected_edges().map(move |edge| {
        let [a, b] = edge.vertices();
        site(a.index()).min(site(b.index()))
    })
}

/// From and to of every edge.
fn read_edges(mesh: &impl Flat, sequence: &[u32], mut places: Places, watch: Watch<'_>) -> Result<Vec<[i32; 2]>> {
    let mut edges = vec![[0; 2]; mesh.num_undirected_edges()];
    for (step, edge) in mesh.undirected_edges().enumerate() {
        watch.poll_at(step)?;
        let edge = edge.as_directed();
        let [from, to] = [edge.from(), edge.to()].map(|end| sequence[end.index()]);
        edges[places.take(from.min(to))] = [from as i32, to as i32];
    }
    Ok(edges)
}

/// The triangles on the right and on the left of every edge.
fn read_dual_edges(
    mesh: &impl Flat,
    sequence: &[u32],
    mut places: Places,
    triangle_of: &[i32],
    watch: Watch<'_>,
) -> Result<Vec<[i32; 2]>> {
    let mut dual_edges = vec![[0; 2]; mesh.num_undirected_edges()];
    for (step, (edge, lowest)) in mesh.undirected_edges().zip(lowest_ends(mesh, sequence)).enumerate() {
        watch.poll_at(step)?;
        let edge = edge.as_directed();
        dual_edges[places.take(lowest)] = [edge.rev(), edge].map(|side| triangle_of[side.face().index()]);
    }
    Ok(dual_edges)
}

/// Triangles, and the number of every face (-1 for the outside).
fn read_triangles(mesh: &impl Flat, sequence: &[u32]) -> (Vec<[i32; 3]>, Vec<i32>) {
    let corners: Vec<[u32; 3]> =
        mesh.inner_faces().map(|face| face.vertices().map(|vertex| sequence[vertex.index()])).collect();
    let lowest = |[a, b, c]: [u32; 3]| a.min(b).min(c);
    let mut places = Places::count(corners.iter().map(|&corners| lowest(corners)), sequence.len());
    let mut triangles = vec![[0; 3]; corners.len()];
    let mut triangle_of = vec![-1; mesh.num_all_faces()];
    for (face, corners) in mesh.inner_faces().zip(corners) {
        let place = places.take(lowest(corners));
        triangles[place] = corners.map(|corner| corner as i32);
        triangle_of[face.index()] = place as i32;
    }
    (triangles, triangle_of)
}

/// Where items go when sorted by a small key, stably.
#[derive(Clone)]
struct Places {
    /// The next place of each key.
    next: Vec<u32>,
}

impl Places {
    /// For items with `items` as their keys, each less than `keys`.
    fn count(items: impl Iterator<Item = u32>, keys: usize) -> Self {
        let mut next = vec![0_u32; keys];
        for key in items {
            next[key as usize] += 1;
        }
        let mut places = 0;
        for slot in &mut next {
            places += std::mem::replace(slot, places);
        }
        Self { next }
    }

    /// The place of the next item with this key.
    #[inline]
    fn take(&mut self, key: u32) -> usize {
        let place = &mut self.next[key as usize];
        *place += 1;
        *place as usize - 1
    }
}
