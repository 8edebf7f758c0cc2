//! Faces of a plane drawing: what the cracks close off.

use super::lines::point_at;
use super::network::{Drawing, Network};
use crate::error::Result;
use crate::graph::Point;
use crate::incidence::Incidence;
use crate::watch::Watch;

/// The outline of a tree encloses nothing but rounding, this part of the square of its length.
const ROUNDING: f64 = 1e-12;

/// Areas of the cells: faces with a closed outline run through against the clock, on a torus those that go round
/// nothing. Islands inside are not taken off. In the order of the first end on each outline.
///
/// `O(n log n)` for the turns about the nodes.
///
/// # Source
/// Guibas, Stolfi: Primitives for the manipulation of general subdivisions (1985): the face to the left of an edge.
pub(super) fn cells(drawing: &Drawing<'_>, network: &Network, at: &Incidence, watch: Watch<'_>) -> Result<Vec<f64>> {
    let next = turns(drawing, network, at);
    let twice: Vec<f64> = (0..network.count()).map(|segment| twice_area(drawing, network, segment)).collect();
    let shifts: Vec<[i32; 2]> = (0..network.count()).map(|segment| shift(drawing, network, segment)).collect();
    let mut used = vec![false; 2 * network.count()];
    let mut areas = Vec::new();
    for first in 0..used.len() {
        watch.poll_at(first)?;
        let (mut end, mut area, mut corner, mut turned, mut length) = (first, 0.0, [0.0; 2], [0; 2], 0.0);
        while !std::mem::replace(&mut used[end], true) {
            let sign = if end.is_multiple_of(2) { 1.0 } else { -1.0 };
            let way = network.way[end / 2].map(|x| sign * x);
            area += sign * twice[end / 2] + cross(corner, way);
            corner = [corner[0] + way[0], corner[1] + way[1]];
            length += network.length[end / 2];
            let step = shifts[end / 2].map(|x| if end.is_multiple_of(2) { x } else { -x });
            turned = [turned[0] + step[0], turned[1] + step[1]];
            end = next[end ^ 1] as usize;
        }
        if area > ROUNDING * length * length && turned == [0; 2] {
            areas.push(area / 2.0);
        }
    }
    Ok(areas)
}

/// For the end at which an outline arrives, the end by which it leaves: the next about the node with the clock.
fn turns(drawing: &Drawing<'_>, network: &Network, at: &Incidence) -> Vec<u32> {
    let mut next = vec![0; 2 * network.count()];
    for vertex in 0..network.degree.len() {
        let heading = |&end: &u32| {
            let [x, y] = point_at(drawing, network, end as usize, 0.0);
            (libm::atan2(y, x), end)
        };
        let mut about: Vec<(f64, u32)> = at.at(vertex).iter().map(heading).collect();
        about.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        for (i, &(_, end)) in about.iter().enumerate() {
            next[end as usize] = about[(i + about.len() - 1) % about.len()].1;
        }
    }
    next
}

/// Twice the area that a segment sweeps, seen from its first end.
fn twice_area(drawing: &Drawing<'_>, network: &Network, segment: usize) -> f64 {
    let (mut at, mut area) = ([0.0; 2], 0.0);
    for &half in network.along(segment) {
        let step = drawing.step(half);
        area += cross(at, step);
        at = [at[0] + step[0], at[1] + step[1]];
    }
    area
}

fn shift(drawing: &Drawing<'_>, network: &Network, segment: usize) -> [i32; 2] {
    let add = |sum: [i32; 2], step: [i32; 2]| [sum[0] + step[0], sum[1] + step[1]];
    network.along(segment).iter().fold([0; 2], |sum, &half| add(sum, drawing.shift(half)))
}

fn cross(a: Point, b: Point) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}
