//! Point sets named after the trouble they make.
#![allow(dead_code, unreachable_pub, clippy::unwrap_used, clippy::panic, missing_docs)]

use crazing::Point;
use crazing::rng::{Rng, stream};
use proptest::prelude::*;

pub const FAMILIES: [&str; 13] = [
    "uniform",
    "grid",
    "circle",
    "two circles",
    "line",
    "nearly a line",
    "duplicates",
    "far offset",
    "cluster and outlier",
    "many decades",
    "subnormal",
    "huge",
    "curve",
];

/// `n` points of a family.
pub fn family(name: &str, n: usize, seed: u64) -> Vec<Point> {
    let mut rng = Rng::new([seed, 0], stream::SAMPLE);
    let side = (n as f64).sqrt().ceil() as usize;
    let turn = |i: usize, n: usize| i as f64 / n as f64 * std::f64::consts::TAU;
    let mut point = |i: usize| -> Point {
        let [u, v] = [rng.unit(), rng.unit()];
        match name {
            "uniform" => [u, v],
            "grid" => [(i % side) as f64, (i / side) as f64],
            "circle" => [turn(i, n).cos(), turn(i, n).sin()],
            "two circles" => {
                let r = if i.is_multiple_of(2) { 1.0 } else { 2.0 };
                [r * turn(i, n).cos(), r * turn(i, n).sin()]
            }
            "line" => [i as f64, 2.0 * i as f64],
            "nearly a line" => [u, u + f64::EPSILON * (4.0 * v).floor()],
            "duplicates" => [(5.0 * u).floor(), (5.0 * v).floor()],
            "far offset" => [5e5 + u, 4.6e6 + v],
            "cluster and outlier" if i == 0 => [1e12, -1e12],
            "cluster and outlier" => [1e-6 * u, 1e-6 * v],
            "many decades" => [10_f64.powf(60.0 * u - 30.0), 10_f64.powf(60.0 * v - 30.0)],
            "subnormal" => [(40.0 * u).floor() * 5e-324, (40.0 * v).floor() * 5e-324],
            "huge" => [(u - 0.5) * f64::MAX, (v - 0.5) * f64::MAX],
            "curve" => {
                let r = 1.0 + 0.3 * (5.0 * turn(i, n)).cos();
                [r * turn(i, n).cos(), r * turn(i, n).sin()]
            }
            _ => panic!("no family {name}"),
        }
    };
    (0..n).map(&mut point).collect()
}

/// Any family, any small size.
pub fn any_points() -> impl Strategy<Value = Vec<Point>> {
    (0..FAMILIES.len(), 0_usize..90, any::<u64>()).prop_map(|(f, n, seed)| family(FAMILIES[f], n, seed))
}

/// Points of a small lattice: every tie there is.
pub fn lattice() -> impl Strategy<Value = Vec<Point>> {
    prop::collection::vec((0..6_i32, 0..6_i32).prop_map(|(x, y)| [f64::from(x), f64::from(y)]), 3..30)
}

/// The points in another order.
pub fn shuffled(points: &[Point], seed: u64) -> Vec<Point> {
    let mut rng = Rng::new([seed, 1], stream::SAMPLE);
    let mut points = points.to_vec();
    for i in (1..points.len()).rev() {
        points.swap(i, rng.below(i as u32 + 1) as usize);
    }
    points
}
