//! From a mask to the graph of its centrelines.

use super::Mask;
use super::distance::squared_distances;
use super::network::{Drawing, Network};
use super::thin::{AROUND, around, thin};
use crate::error::Result;
use crate::graph::{PlanarGraph, Point};
use crate::sets::DisjointSets;
use crate::watch::Watch;

/// Centrelines of a mask, in pixels, y up, the lower left corner of the picture at the origin.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Trace {
    /// Vertices are centres of pixels, but for merged nodes.
    pub graph: PlanarGraph,
    /// Width of the crack at every vertex, in pixels: twice the distance to the nearest pixel that is no crack.
    pub width: Vec<f64>,
}

/// Spurs fork at their tips: cutting one uncovers another. Rounds beyond the second change little on real masks.
const ROUNDS: usize = 2;

/// The skeleton of a mask as a graph: free ends shorter than `spur` are cut off, nodes closer than `merge` along a
/// segment become one at their middle. Both in pixels; 0 leaves all as it is. A line that ends at the edge of the
/// picture is no spur.
///
/// # Errors
/// [`crate::Error::Interrupted`].
pub fn trace(mask: &Mask, spur: f64, merge: f64, watch: Watch<'_>) -> Result<Trace> {
    let mut found = pixels(mask, &thin(mask, watch)?);
    for _ in 0..ROUNDS {
        if !cut_spurs(&mut found.graph, spur, [mask.width as f64, mask.height as f64], watch)? {
            break;
        }
    }
    merge_nodes(&mut found.graph, merge, watch)?;
    compact(found, watch)
}

/// One vertex a pixel of the skeleton. Pixels that touch at a corner are joined only if no pixel lies beside both.
fn pixels(mask: &Mask, skeleton: &Mask) -> Trace {
    let squares = squared_distances(mask);
    let kept: Vec<u32> = (0..skeleton.pixels.len() as u32).filter(|&at| skeleton.pixels[at as usize]).collect();
    let mut row_of = vec![-1; skeleton.pixels.len()];
    let mut found = Trace::default();
    for (row, &at) in kept.iter().enumerate() {
        row_of[at as usize] = row as i32;
        let (down, right) = (at as usize / mask.width, at as usize % mask.width);
        found.graph.vertices.push([right as f64 + 0.5, (mask.height - down) as f64 - 0.5]);
        found.width.push(2.0 * (squares[at as usize] as f64).sqrt());
    }
    for (row, &at) in kept.iter().enumerate() {
        let near = around(skeleton, at);
        // East, north-east, north, north-west: the other four are met from the other side.
        for (i, &step) in AROUND.iter().enumerate().take(4) {
            let beside = !i.is_multiple_of(2) && (near[i - 1] || near[i + 1]);
            if let Some(other) = skeleton.beside(at, step).filter(|_| near[i] && !beside) {
                found.graph.edges.push([row as i32, row_of[other as usize]]);
            }
        }
    }
    found
}

fn drawing(graph: &PlanarGraph) -> Drawing<'_> {
    Drawing { vertices: &graph.vertices, edges: &graph.edges, ..Drawing::default() }
}

/// Takes away the segments between a junction and a free tip that are shorter than `spur`; whether there were any.
fn cut_spurs(graph: &mut PlanarGraph, spur: f64, size: Point, watch: Watch<'_>) -> Result<bool> {
    let network = Network::of(&drawing(graph), watch)?;
    let edge = |at: u32| {
        let p = graph.vertices[at as usize];
        (0..2).any(|i| p[i] < 1.0 || p[i] > size[i] - 1.0)
    };
    let free = |end: usize| network.degree_at(end) == 1 && !edge(network.ends[end / 2][end % 2]);
    let is_spur = |segment: usize| {
        let tip = [0, 1].map(|side| free(2 * segment + side));
        let junction = [0, 1].map(|side| network.degree_at(2 * segment + side) > 2);
        network.length[segment] < spur && (tip[0] && junction[1] || tip[1] && junction[0])
    };
    let mut keep = vec![true; graph.edges.len()];
    let mut any = false;
    for segment in (0..network.count()).filter(|&segment| is_spur(segment)) {
        any = true;
        network.along(segment).iter().for_each(|&half| keep[half as usize / 2] = false);
    }
    retain(graph, &keep);
    Ok(any)
}

fn retain(graph: &mut PlanarGraph, keep: &[bool]) {
    let mut flags = keep.iter();
    graph.edges.retain(|_| flags.next().copied().unwrap_or(true));
}

/// A loop shorter than this many times the distance of merged nodes is what is left of a merged knot.
const KNOT: f64 = 3.0;

fn merge_nodes(graph: &mut PlanarGraph, merge: f64, watch: Watch<'_>) -> Result<()> {
    let network = Network::of(&drawing(graph), watch)?;
    let mut sets = DisjointSets::new(graph.vertices.len());
    let is_junction = |segment: usize| (0..2).all(|side| network.degree_at(2 * segment + side) > 2);
    for segment in (0..network.count()).filter(|&s| is_junction(s) && network.length[s] < merge) {
        let [a, b] = network.ends[segment].map(|end| end as usize);
        sets.unite(a, b);
    }
    let mut keep = vec![true; graph.edges.len()];
    for segment in (0..network.count()).filter(|&s| network.length[s] < KNOT * merge) {
        let [a, b] = network.ends[segment].map(|end| sets.lowest(end as usize));
        if a == b {
            network.along(segment).iter().for_each(|&half| keep[half as usize / 2] = false);
        }
    }
    let set_of: Vec<usize> = (0..graph.vertices.len()).map(|vertex| sets.lowest(vertex)).collect();
    graph.edges.iter_mut().flatten().for_each(|end| *end = set_of[*end as usize] as i32);
    centre(&mut graph.vertices, &set_of);
    retain(graph, &keep);
    Ok(())
}

/// Puts the lowest vertex of every set in the middle of the set.
fn centre(vertices: &mut [Point], set_of: &[usize]) {
    let mut sums = vec![[0.0; 3]; vertices.len()];
    for (&set, &[x, y]) in set_of.iter().zip(vertices.iter()) {
        let sum = &mut sums[set];
        *sum = [sum[0] + x, sum[1] + y, sum[2] + 1.0];
    }
    for (vertex, [x, y, count]) in vertices.iter_mut().zip(sums).filter(|(_, sum)| sum[2] > 1.0) {
        *vertex = [x / count, y / count];
    }
}

/// Drops the vertices that no edge uses.
fn compact(found: Trace, watch: Watch<'_>) -> Result<Trace> {
    let Trace { graph, width } = found;
    let degrees = crate::graph::degrees(graph.vertices.len(), &graph.edges, watch)?;
    let width = width.into_iter().zip(&degrees).filter(|(_, degree)| **degree > 0).map(|(width, _)| width).collect();
    let graph = crate::graph::compact(&graph.vertices, &graph.edges, watch)?;
    Ok(Trace { graph, width })
}
