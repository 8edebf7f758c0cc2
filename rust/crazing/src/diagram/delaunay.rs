//! The only file that names spade: distinct points along a curve to triangles, edges and dual edges.
//!
//! Points are inserted one by one in rounds ([`super::order`]). Bulk loading is not used: see
//! `tests/spade_traps.rs` for the inputs on which it failed, and on samples of curves it is quadratic.

use spade::handles::FixedVertexHandle;
use spade::{
    ConstrainedDelaunayTriangulation, DelaunayTriangulation, LastUsedVertexHintGenerator, LineIntersectionIterator,
    Point2, Triangulation,
};

use super::order::{self, Rounds};
use crate::error::{Error, Result};
use crate::graph::Point;
use crate::parallel;
use crate::predicates::orientation;
use crate::rng::{Rng, stream};
use crate::scatter::{scatter, scatter_both};
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
        Some(Rounds { order, near }) => {
            let mesh = insert::<Mesh>(points, &order, &near, watch)?;
            drop(near);
            read(&mesh, &order, watch)
        }
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

    /// The numbers of all points in the order of insertion: of those given first, every first part holds a random sample.
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
    let mut constraints = outwards(constraints, points.len());
    let mut patience = Some(PATIENCE * points.len());
    for step in 0..constraints.len() {
        watch.poll_at(step)?;
        let handles = |ends: [u32; 2]| ends.map(|end| FixedVertexHandle::from_index(vertex_of[end as usize]));
        if let Some(left) = patience {
            let [from, to] = handles(constraints[step]);
            let crossed = LineIntersectionIterator::new_from_handles(&mesh, from, to).count();
            patience = left.checked_sub(crossed);
            if patience.is_none() {
                shuffle(&mut constraints[step..]);
            }
        }
        let [from, to] = handles(constraints[step]);
        // Not `add_constraint`, which panics where it cannot: a bug of ours would then be the user's.
        if mesh.try_add_constraint(from, to).is_empty() {
            return Err(Error::Internal("a constraint that crosses none was refused by the triangulation"));
        }
    }
    let mut edge_of = lowest_ends(&mesh, &order);
    to_places(&mut edge_of, order.len());
    let mut constrained = vec![false; mesh.num_undirected_edges()];
    for (edge, place) in mesh.undirected_edges().zip(edge_of) {
        constrained[place as usize] = edge.is_constraint_edge();
    }
    Ok((read(&mesh, &order, watch)?, constrained))
}

/// More constraints than this at one site are a crowd. Drawings have three or four, whose order stays as it was given.
const CROWD: u32 = 32;

/// Constraints turned so that they lead to a crowd and not from it: spade looks for the way to begin among all edges
/// about the first end, so that the spokes of a hub would cost the square of their number.
fn outwards(constraints: &[[u32; 2]], sites: usize) -> Vec<[u32; 2]> {
    let mut meeting = vec![0; sites];
    constraints.iter().flatten().for_each(|&end| meeting[end as usize] += 1);
    let turned = |&[a, b]: &[u32; 2]| {
        let [here, there] = [a, b].map(|end| meeting[end as usize]);
        if here > CROWD && here > there { [b, a] } else { [a, b] }
    };
    constraints.iter().map(turned).collect()
}

/// Edges a point that constraints may cross, all together, while they are inserted in the order given.
///
/// A fan whose every edge crosses a whole row of others costs the square of their number in order along the fan, and
/// next to nothing in random order, where few cross what those before left of the row. Ordinary outlines cross a few
/// edges a point, and keep their order.
///
/// # Source
/// Shewchuk, Brown: Fast Segment Insertion and Incremental Construction of Constrained Delaunay Triangulations (2015).
const PATIENCE: usize = 8;

fn shuffle(constraints: &mut [[u32; 2]]) {
    let mut rng = Rng::new([0; 2], stream::CONSTRAINT);
    for i in (1..constraints.len()).rev() {
        constraints.swap(i, rng.below(i as u32 + 1) as usize);
    }
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
    let span = |ends: &[u32; 2]| {
        let [a, b] = ends.map(|end| at(end as usize));
        if a < b { [a, b] } else { [b, a] }
    };
    let mut spans: Vec<[Point; 2]> = constraints.iter().map(span).collect();
    // None of them overlap.
    spans.sort_unstable_by(|[p, _], [q, _]| p[0].total_cmp(&q[0]).then(p[1].total_cmp(&q[1])));
    let held = |ends: &[i32; 2]| {
        let [a, b] = ends.map(|end| at(end as usize));
        let before = spans.partition_point(|&[low, _]| low <= a);
        before > 0 && b <= spans[before - 1][1]
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
trait Flat: Triangulation<Vertex = Point2<f64>> + Sync {
    /// The sites at both ends of an edge.
    fn ends(&self, k: usize, sequence: &[u32]) -> [u32; 2] {
        let edge = self.undirected_edges().nth(k);
        edge.map_or([0; 2], |edge| edge.vertices().map(|vertex| sequence[vertex.index()]))
    }

    /// The faces on the right and on the left of an edge; 0 is the outside.
    fn sides(&self, k: usize) -> [usize; 2] {
        let edge = self.undirected_edges().nth(k).map(|edge| edge.as_directed());
        edge.map_or([0; 2], |edge| [edge.rev(), edge].map(|side| side.face().index()))
    }

    /// The corners of a face that is not the outside.
    fn corners(&self, face: usize, sequence: &[u32]) -> [u32; 3] {
        let face = self.all_faces().nth(face).and_then(|face| face.as_inner());
        face.map_or([0; 3], |face| face.vertices().map(|vertex| sequence[vertex.index()]))
    }
}

impl<M: Triangulation<Vertex = Point2<f64>> + Sync> Flat for M {}

/// Reads the mesh in the order of its own memory (walking it would wait for memory at every step), and puts triangles
/// and edges in the order of their lowest site: neighbours in the plane are then neighbours in memory. All cores read;
/// only the places are counted out one by one.
fn read(mesh: &impl Flat, sequence: &[u32], watch: Watch<'_>) -> Result<Topology> {
    let sites = sequence.len();
    let corners = parallel::map(mesh.num_inner_faces(), |i| mesh.corners(i + 1, sequence));
    watch.poll()?;
    let mut triangle_of: Vec<u32> = corners.iter().map(|&[a, b, c]| a.min(b).min(c)).collect();
    let mut edge_of = lowest_ends(mesh, sequence);
    parallel::join(sites, || to_places(&mut triangle_of, sites), || to_places(&mut edge_of, sites));
    watch.poll()?;
    let triangles = scatter(&triangle_of, |i| corners[i].map(|site| site as i32));
    drop(corners);
    watch.poll()?;
    let triangle = |face: usize| face.checked_sub(1).map_or(-1, |i| triangle_of[i] as i32);
    let (edges, dual_edges) =
        scatter_both(&edge_of, |k| (mesh.ends(k, sequence).map(|site| site as i32), mesh.sides(k).map(triangle)));
    Ok(Topology { triangles, edges, dual_edges })
}

/// The lower end of every edge.
fn lowest_ends(mesh: &impl Flat, sequence: &[u32]) -> Vec<u32> {
    parallel::map(mesh.num_undirected_edges(), |k| {
        let [a, b] = mesh.ends(k, sequence);
        a.min(b)
    })
}

/// Where items go when sorted by a small key, stably: of the key of each, below `keys`, makes its place.
fn to_places(key_of: &mut [u32], keys: usize) {
    let mut next = vec![0_u32; keys];
    for &key in key_of.iter() {
        next[key as usize] += 1;
    }
    let mut places = 0;
    for slot in &mut next {
        places += std::mem::replace(slot, places);
    }
    for key in key_of {
        let place = &mut next[*key as usize];
        *key = *place;
        *place += 1;
    }
}
