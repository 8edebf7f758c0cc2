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

/// The least time of each way of loading, nanoseconds a point; the first is left out where it would take minutes.
fn least(points: &[Point], with_bulk: bool, runs: usize) -> [f64; 3] {
    let mut least = [f64::INFINITY; 3];
    for _ in 0..runs {
        for (which, work) in [bulk, in_rounds, ours].into_iter().enumerate().skip(usize::from(!with_bulk)) {
            let start = Instant::now();
            std::hint::black_box(work(points));
            least[which] = least[which].min(start.elapsed().as_secs_f64() * 1e9 / points.len() as f64);
        }
    }
    least
}

/// The numbers of points to time, from the command line.
fn sizes() -> Vec<usize> {
    // Cargo adds `--bench`.
    let given: Vec<usize> = std::env::args().skip(1).filter_map(|word| word.parse().ok()).collect();
    if given.is_empty() { vec![10_000, 100_000, 1_000_000] } else { given }
}

fn main() {
    println!(
        "{:>8} {:>10} {:>12} {:>12} {:>12} {:>8}",
        "points", "data", "bulk ns/pt", "rounds ns/pt", "ours ns/pt", "ratio"
    );
    for n in sizes() {
        for (name, points) in [("uniform", weyl(n)), ("curve", flower(n))] {
            // Small runs are over before a busy machine has let them run undisturbed once.
            let runs = if n <= 10_000 { 21 } else { 5 };
            // Bulk loading samples of a curve is quadratic.
            let [bulk, rounds, ours] = least(&points, name == "uniform" || n <= 10_000, runs);
            let ratio = ours / bulk.min(rounds);
            println!("{n:>8} {name:>10} {bulk:>12.0} {rounds:>12.0} {ours:>12.0} {ratio:>8.2}");
        }
    }
}
