//! Drawings over point sets that make trouble, in the plane and on a torus, and what is wrong with them.
#![allow(dead_code, unreachable_pub, clippy::unwrap_used, missing_docs)]

use crazing::crack::{
    Fence, Grown, Net, NetView, Rough, Roughness, Straightening, Stubs, Walls, on_torus, roughen, stubs, within,
};
use crazing::diagram::{diagram, periodic};
use crazing::predicates::orientation;
use crazing::rng::{Rng, stream};
use crazing::{Point, Watch};
use proptest::prelude::*;

use super::families::family;

pub const TROUBLES: [&str; 10] = [
    "uniform",
    "grid",
    "circle",
    "two circles",
    "nearly a line",
    "duplicates",
    "far offset",
    "cluster and outlier",
    "many decades",
    "curve",
];

/// A drawing, its fence and its box; some doors are open by chance.
pub fn drawn(trouble: &str, n: usize, torus: bool, opening: f64, seed: u64) -> (Walls, [f64; 4]) {
    let mut rng = Rng::new([seed, 1], stream::MAZE);
    // In one period clusters are so small that copies of them differ by roundings.
    let is_wide = !["many decades", "far offset", "cluster and outlier"].contains(&trouble);
    let mut points = family(if is_wide || !torus { trouble } else { "uniform" }, n, seed);
    if torus {
        // One period about all of them, of another width than height.
        let side = points.iter().flatten().fold(0.0_f64, |most, x| most.max(x.abs())) * 2.0 + 1.0;
        points.iter_mut().for_each(|p| *p = p.map(|x| x / side + 0.5));
        let period = [1.0, 1.25];
        let d = periodic(&points, period, Watch::default()).unwrap();
        let open: Vec<bool> = d.shifts.iter().map(|_| rng.unit() < opening).collect();
        let walls = on_torus(d.diagram.view(), &open, &d.shifts, &d.dual_shifts, period).unwrap();
        return (walls, [0.0, 0.0, period[0], period[1]]);
    }
    let d = diagram(&points, Watch::default()).unwrap();
    let open: Vec<bool> = d.edges.iter().map(|_| rng.unit() < opening).collect();
    let end = |i: usize, pick: fn(f64, f64) -> f64, start: f64| points.iter().map(|p| p[i]).fold(start, pick);
    let (low, high) = ([0, 1].map(|i| end(i, f64::min, f64::MAX)), [0, 1].map(|i| end(i, f64::max, f64::MIN)));
    let margin = 0.1 * (high[0] - low[0]).max(high[1] - low[1]).max(1e-3);
    let bounds = [low[0] - margin, low[1] - margin, high[0] + margin, high[1] + margin];
    (within(d.view(), &open, bounds).unwrap(), bounds)
}

/// The two ends of a segment, and their names: vertex and copy of the torus.
pub type Segment = ([Point; 2], [(i32, [i32; 2]); 2]);

/// Segments as drawn; of a torus those of 3 x 3 copies. With the name of both ends.
pub fn segments(net: NetView<'_>) -> Vec<Segment> {
    let around: &[i32] = if net.shifts.is_empty() { &[0] } else { &[-1, 0, 1] };
    let copies = around.iter().flat_map(|&x| around.iter().map(move |&y| [x, y]));
    let one = |copy: [i32; 2], k: usize| {
        let (ends, shift) = (net.edges[k], net.shift(k).map(i32::from));
        let place = [copy, [copy[0] + shift[0], copy[1] + shift[1]]];
        // From one vertex all edges start in one place, to the last bit.
        let at = |i: usize| {
            [0, 1].map(|axis| net.vertices[ends[i] as usize][axis] + f64::from(place[i][axis]) * net.period[axis])
        };
        ([at(0), at(1)], [(ends[0], place[0]), (ends[1], place[1])])
    };
    copies.flat_map(|copy| (0..net.edges.len()).map(move |k| one(copy, k))).collect()
}

/// Whether two segments meet anywhere but at a common end.
pub fn cross(p: &Segment, q: &Segment) -> bool {
    let ([a, b], [c, d]) = (p.0, q.0);
    let apart = |i: usize| a[i].max(b[i]) < c[i].min(d[i]) || c[i].max(d[i]) < a[i].min(b[i]);
    if apart(0) || apart(1) {
        return false;
    }
    let common = p.1.iter().enumerate().find_map(|(i, end)| q.1.iter().position(|other| other == end).map(|j| (i, j)));
    if let Some((i, j)) = common {
        let (at, u, v) = (p.0[i], p.0[1 - i], q.0[1 - j]);
        let ahead = (u[0] - at[0]) * (v[0] - at[0]) + (u[1] - at[1]) * (v[1] - at[1]) > 0.0;
        return orientation(at, u, v) == 0.0 && ahead;
    }
    let beside = |a, b, c, d| {
        let (s, t): (f64, f64) = (orientation(a, b, c), orientation(a, b, d));
        (s > 0.0 && t > 0.0) || (s < 0.0 && t < 0.0)
    };
    !beside(a, b, c, d) && !beside(c, d, a, b)
}

/// Pairs of edges that cross, found by looking at all that are near in x.
pub fn crossings(net: NetView<'_>) -> usize {
    let mut all = segments(net);
    let low = |s: &([Point; 2], [(i32, [i32; 2]); 2])| s.0[0][0].min(s.0[1][0]);
    all.sort_by(|p, q| low(p).total_cmp(&low(q)));
    (0..all.len())
        .map(|i| {
            let end = all[i].0[0][0].max(all[i].0[1][0]);
            all[i + 1..].iter().take_while(|q| low(q) <= end).filter(|q| cross(&all[i], q)).count()
        })
        .sum()
}

pub fn moved(net: &Net, vertices: Vec<Point>) -> Net {
    Net { vertices, ..net.clone() }
}

pub fn unit(bounds: [f64; 4], n: usize) -> f64 {
    ((bounds[2] - bounds[0]) * (bounds[3] - bounds[1]) / n as f64).sqrt()
}

pub const HARD: Straightening = Straightening { rounds: 6, pull: 1.0, slide: 1.0, clamp: 0.02, unbend: 6 };

pub fn rough_of(net: &Net, partner: &[i32], fence: &Fence, unit: f64, seed: u64) -> Rough {
    let how = Roughness { amplitude: 0.6, hurst: 0.4, unit, grain: 0.2 * unit, rounding: 0.0 };
    roughen(net.view(), partner, fence.view(), how, [seed, 2], Watch::default()).unwrap()
}

pub fn stubs_of(net: &Net, partner: &[i32], fence: &Fence, bounds: [f64; 4], unit: f64, seed: u64) -> Grown {
    let how = Stubs { rate: 2.5 / unit, length: 0.2 * unit, spread: 0.6, lean: 0.3 };
    stubs(net.view(), partner, fence.view(), bounds, how, [seed, 3], Watch::default()).unwrap()
}

pub fn loops(net: NetView<'_>) -> (i64, usize) {
    let pieces = crazing::graph::components(net.vertices.len(), net.edges, Watch::default()).unwrap().count;
    (net.edges.len() as i64 - net.vertices.len() as i64 + pieces as i64, pieces)
}

/// Every triangle of the fence that is whole runs counter-clockwise.
pub fn paves(net: NetView<'_>, fence: &Fence) -> bool {
    let point = |number: i32| match net.vertices.get(number as usize) {
        Some(&p) => p,
        None => fence.anchors[number as usize - net.vertices.len()],
    };
    fence.kites.iter().enumerate().all(|(row, kite)| {
        let at = |i: usize| {
            let shift =
                if i == 0 { [0, 0] } else { fence.shifts.get(row).map_or([0, 0], |s| [s[2 * i - 2], s[2 * i - 1]]) };
            net.moved(point(kite[i]), shift)
        };
        (kite[2] < 0 || orientation(at(0), at(1), at(2)) > 0.0)
            && (kite[3] < 0 || orientation(at(1), at(0), at(3)) > 0.0)
    })
}

pub fn any_drawing() -> impl Strategy<Value = (Walls, [f64; 4], usize, u64)> {
    (0..TROUBLES.len(), 4_usize..34, any::<bool>(), 0.0..0.9, 0_u64..1000).prop_map(
        |(trouble, n, torus, opening, seed)| {
            let (walls, bounds) = drawn(TROUBLES[trouble], n, torus, opening, seed);
            (walls, bounds, n, seed)
        },
    )
}
