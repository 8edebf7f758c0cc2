//! One period of a drawing on a torus: edges cut at its sides, each piece moved into it, so that the picture tiles.

use crate::error::{Error, Result};
use crate::graph::{PlanarGraph, Point, check_indices};
use crate::watch::Watch;

/// Edge `k` runs from `points[edges[k][0]]` to `points[edges[k][1]] + shifts[k] * period`; points lie in the period.
/// Edges without length are left out. Vertices are `points`, then those where edges were cut: on opposite sides they
/// agree to the last bit in the other coordinate.
///
/// # Errors
/// [`Error::BadIndex`], [`Error::BadLength`], [`Error::Interrupted`].
pub fn tile(
    points: &[Point],
    edges: &[[i32; 2]],
    shifts: &[[i8; 2]],
    period: Point,
    watch: Watch<'_>,
) -> Result<PlanarGraph> {
    check_indices("edges", edges, 0, points.len())?;
    if shifts.len() != edges.len() {
        return Err(Error::BadLength { array: "shifts", found: shifts.len(), wanted: edges.len() });
    }
    let mut graph = PlanarGraph { vertices: points.to_vec(), edges: Vec::with_capacity(edges.len()) };
    for (k, (&[a, b], &shift)) in edges.iter().zip(shifts).enumerate() {
        watch.poll_at(k)?;
        let [p, q] = [a, b].map(|end| points[end as usize]);
        if shift == [0, 0] {
            if p != q {
                graph.edges.push([a, b]);
            }
        } else {
            let step = [0, 1].map(|i| q[i] + f64::from(shift[i]) * period[i] - p[i]);
            cut(&mut graph, [a, b], step, &crossings(p, step, shift, period), period);
        }
    }
    Ok(graph)
}

/// Where an edge leaves the period: at which part of its way, along which axis, and to which side.
fn crossings(p: Point, step: Point, shift: [i8; 2], period: Point) -> Vec<(f64, usize, bool)> {
    let mut found = Vec::new();
    for i in 0..2 {
        let up = shift[i] > 0;
        for turn in 0..i32::from(shift[i]).abs() {
            let side = f64::from(if up { turn + 1 } else { -turn }) * period[i];
            found.push((((side - p[i]) / step[i]).clamp(0.0, 1.0), i, up));
        }
    }
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    found
}

fn cut(graph: &mut PlanarGraph, [a, b]: [i32; 2], step: Point, crossings: &[(f64, usize, bool)], period: Point) {
    let start = graph.vertices[a as usize];
    let (mut from, mut moved) = (a, [0.0; 2]);
    for &(t, axis, up) in crossings {
        let mut at = [0, 1].map(|i| (start[i] + t * step[i] - moved[i] * period[i]).clamp(0.0, period[i]));
        // It leaves on one side and comes in on the other.
        for entering in [false, true] {
            at[axis] = if up != entering { period[axis] } else { 0.0 };
            let vertex = graph.vertices.len() as i32;
            graph.vertices.push(at);
            if !entering && graph.vertices[from as usize] != at {
                graph.edges.push([from, vertex]);
            }
            from = vertex;
        }
        moved[axis] += if up { 1.0 } else { -1.0 };
    }
    if graph.vertices[from as usize] != graph.vertices[b as usize] {
        graph.edges.push([from, b]);
    }
}
