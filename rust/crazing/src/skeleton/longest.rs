//! The longest path of an axis: its centreline.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::cost::distance;
use crate::error::Result;
use crate::graph::{Point, components, degrees};
use crate::incidence::Incidence;
use crate::watch::Watch;

/// The rows of edges along the longest of all shortest paths, in order.
///
/// Each component is walked twice: to the vertex farthest from any, and from there to the farthest one again. In a
/// tree that is the longest path; where there are rings it is a shortest path nearly as long as any.
///
/// # Errors
/// [`crate::Error::BadIndex`], [`crate::Error::Interrupted`].
pub fn longest(vertices: &[Point], edges: &[[i32; 2]], watch: Watch<'_>) -> Result<Vec<i32>> {
    let labels = components(vertices.len(), edges, watch)?.labels;
    let degrees = degrees(vertices.len(), edges, watch)?;
    let about = Incidence::of(vertices.len(), edges);
    // The first vertex of each component, and then the farthest ones of all components at once.
    let mut starts: Vec<Option<usize>> = Vec::new();
    for v in (0..vertices.len()).filter(|&v| degrees[v] > 0) {
        let label = labels[v] as usize;
        starts.resize(starts.len().max(label + 1), None);
        starts[label].get_or_insert(v);
    }
    let first = walk(vertices, edges, &about, starts.into_iter().flatten(), watch)?;
    let from = first.farthest(&labels);
    let second = walk(vertices, edges, &about, from.into_iter(), watch)?;
    let ends = second.farthest(&labels);
    let end = ends.into_iter().reduce(|a, b| if second.far[b] > second.far[a] { b } else { a });
    Ok(end.map_or_else(Vec::new, |end| second.path(end, edges)))
}

/// How far every vertex is from the start of its component, and the edge by which it was reached.
struct Ways {
    far: Vec<f64>,
    by: Vec<i32>,
}

fn walk(
    vertices: &[Point],
    edges: &[[i32; 2]],
    about: &Incidence,
    starts: impl Iterator<Item = usize>,
    watch: Watch<'_>,
) -> Result<Ways> {
    let mut ways = Ways { far: vec![f64::INFINITY; vertices.len()], by: vec![-1; vertices.len()] };
    let mut queue: BinaryHeap<Reverse<(u64, usize)>> = BinaryHeap::new();
    for start in starts {
        ways.far[start] = 0.0;
        queue.push(Reverse((0, start)));
    }
    let mut steps = 0;
    while let Some(Reverse((bits, v))) = queue.pop() {
        watch.poll_at(steps)?;
        steps += 1;
        if bits > ways.far[v].to_bits() {
            continue;
        }
        for &k in about.at(v) {
            let [a, b] = edges[k as usize].map(|end| end as usize);
            let u = if a == v { b } else { a };
            let far = ways.far[v] + distance(vertices[a], vertices[b]);
            if far < ways.far[u] {
                (ways.far[u], ways.by[u]) = (far, k as i32);
                queue.push(Reverse((far.to_bits(), u)));
            }
        }
    }
    Ok(ways)
}

impl Ways {
    /// Of every component the vertex farthest from its start; the lowest of those equally far.
    fn farthest(&self, labels: &[i32]) -> Vec<usize> {
        let mut best: Vec<Option<usize>> = Vec::new();
        for (v, &label) in labels.iter().enumerate().filter(|&(v, &label)| label >= 0 && self.far[v].is_finite()) {
            best.resize(best.len().max(label as usize + 1), None);
            let slot = &mut best[label as usize];
            if slot.is_none_or(|held| self.far[v] > self.far[held]) {
                *slot = Some(v);
            }
        }
        best.into_iter().flatten().collect()
    }

    fn path(&self, end: usize, edges: &[[i32; 2]]) -> Vec<i32> {
        let (mut path, mut at) = (Vec::new(), end);
        while self.by[at] >= 0 {
            path.push(self.by[at]);
            let [a, b] = edges[self.by[at] as usize].map(|end| end as usize);
            at = if a == at { b } else { a };
        }
        path
    }
}
