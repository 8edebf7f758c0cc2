//! `cargo bench --bench diagram`: our diagram against bare spade, ratios of one run.
//!
//! Every figure is the least of several interleaved runs on the same points.

#![allow(clippy::print_stdout, clippy::unwrap_used, missing_docs)]

use std::time::Instant;

use crazing::diagram::{diagram, insertion_order};
use crazing::{Point, Watch};
use spade::{DelaunayTriangulation, LastUsedVertexHintGenerator, Point2, Triangulation};

type Bare = DelaunayTriangulation<Point2<f64>, (), (), (), LastUsedVertexHintGenerator>;

fn weyl(n: usize) -> Vec<Point> {
    // SplitMix64: uniform enough to time with.
    let mut state = 7_u64;
    let mut unit = || {
        state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = (state ^ (state >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    };
    (0..n).map(|_| [unit(), unit()]).collect()
}

fn flower(n: usize) -> Vec<Point> {
    let at = |i: usize| {
        let t = i as f64 / n as f64 * std::f64::consts::TAU;
        let r = 1000.0 * (1.0 + 0.3 * (5.0 * t).cos() + 0.1 * (13.0 * t).cos());
        [r * t.cos(), r * t.sin()]
    };
    (0..n).map(at).collect()
}

fn bulk(points: &[Point]) -> usize {
    Bare::bulk_load(points.iter().map(|p| Point2::new(p[0], p[1])).collect()).unwrap().num_inner_faces()
}

fn in_rounds(points: &[Point]) -> usize {
    let mut mesh = Bare::with_capacity(points.len(), 3 * points.len(), 2 * points.len());
    for row in insertion_order(points) {
        let p = points[row as usize];
        mesh.insert(Point2::new(p[0], p[1])).unwrap();
    }
    mesh.num_inner_faces()
}

fn ours(points: &[Point]) -> usize {
    diagram(points, Watch::default()).unwrap().triangles.len()
}

fn main() {
    let runs = 3;
    println!(
        "{:>8} {:>10} {:>12} {:>12} {:>12} {:>8}",
        "points", "data", "bulk ns/pt", "rounds ns/pt", "ours ns/pt", "ratio"
    );
    for n in [10_000, 100_000, 1_000_000] {
        for (name, points) in [("uniform", weyl(n)), ("curve", flower(n))] {
            // Bulk loading samples of a curve is quadratic: left out where it would take minutes.
            let with_bulk = name == "uniform" || n <= 10_000;
            let mut best = [f64::INFINITY; 3];
            for _ in 0..runs {
                for (which, work) in [bulk, in_rounds, ours].into_iter().enumerate() {
                    if which == 0 && !with_bulk {
                        continue;
                    }
                    let start = Instant::now();
                    std::hint::black_box(work(&points));
                    best[which] = best[which].min(start.elapsed().as_secs_f64() * 1e9 / n as f64);
                }
            }
            let ratio = best[2] / best[0].min(best[1]);
            println!("{n:>8} {name:>10} {:>12.0} {:>12.0} {:>12.0} {ratio:>8.2}", best[0], best[1], best[2]);
        }
    }
}
