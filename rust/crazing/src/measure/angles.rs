//! Angles between the segments that meet at a node.

use super::lines::point_at;
use super::network::{Drawing, Network};
use crate::graph::Point;
use crate::incidence::Incidence;

/// Angles of one node, in degrees, in the order of the turn.
pub(super) struct Corner {
    pub(super) degree: i32,
    pub(super) angles: Vec<f64>,
}

/// The ends of the segments at every vertex.
pub(super) fn ends_at(network: &Network) -> Incidence {
    // One row an end, so that a row number is an end.
    let table: Vec<[i32; 1]> = network.ends.iter().flatten().map(|&vertex| [vertex as i32]).collect();
    Incidence::of(network.degree.len(), &table)
}

/// The junctions for which `counts` holds. A segment's direction is that of its point `reach` along it, or of its
/// other end if it is shorter; 0 takes the first edge.
pub(super) fn corners(
    drawing: &Drawing<'_>,
    network: &Network,
    at: &Incidence,
    reach: f64,
    counts: impl Fn(usize) -> bool,
) -> Vec<Corner> {
    let junctions = (0..network.degree.len()).filter(|&vertex| network.degree[vertex] > 2 && counts(vertex));
    let turn = |&end: &u32| heading(point_at(drawing, network, end as usize, reach));
    junctions
        .map(|vertex| {
            let mut turns: Vec<f64> = at.at(vertex).iter().map(turn).collect();
            turns.sort_by(f64::total_cmp);
            let next = turns.iter().skip(1).copied().chain(turns.first().map(|first| first + 360.0));
            let angles = turns.iter().zip(next).map(|(a, b)| b - a).collect();
            Corner { degree: network.degree[vertex], angles }
        })
        .collect()
}

fn heading([x, y]: Point) -> f64 {
    libm::atan2(y, x).to_degrees()
}
