//! `cargo bench --bench skeleton`: what each method costs on top of a diagram, as ratios to the diagram in one run.

#![allow(clippy::print_stdout, clippy::unwrap_used, missing_docs)]

use std::hint::black_box;
use std::time::Instant;

use crazing::diagram::diagram;
use crazing::sample;
use crazing::skeleton::{edge_filter, one_step, second, two_pass};
use crazing::{DiagramView, Point, Watch};

fn flower(n: usize) -> Vec<Point> {
    let at = |i: usize| {
        let t = i as f64 / n as f64 * std::f64::consts::TAU;
        let r = 1000.0 * (1.0 + 0.3 * (5.0 * t).cos() + 0.1 * (13.0 * t).cos());
        [r * t.cos(), r * t.sin()]
    };
    (0..n).map(at).collect()
}

/// Seconds of the fastest of some runs.
fn least(runs: usize, mut work: impl FnMut()) -> f64 {
    let time = |_| {
        let start = Instant::now();
        work();
        start.elapsed().as_secs_f64()
    };
    (0..runs).map(time).fold(f64::INFINITY, f64::min)
}

type Method = fn(DiagramView<'_>) -> usize;

const METHODS: [(&str, Method); 4] = [
    ("one-step", |view| one_step(view).unwrap().len()),
    ("two-pass", |view| two_pass(view).unwrap().len()),
    ("edge-filter", |view| edge_filter(view).unwrap().axis.len()),
    ("literal", |view| second(view, Watch::default()).unwrap().axis.len()),
];

fn main() {
    println!("{:>8} {:>8} {:>14} {:>12}", "points", "data", "diagram ns/pt", "ratios");
    let most = std::env::args().filter_map(|arg| arg.parse().ok()).next().unwrap_or(1_000_000);
    for n in [10_000, 100_000, 1_000_000].into_iter().filter(|&n| n <= most) {
        let uniform = sample::uniform(n, [0.0, 0.0, 1.0, 1.0], [1, 2], Watch::default()).unwrap();
        for (name, points) in [("uniform", uniform), ("curve", flower(n))] {
            let whole = least(3, || drop(black_box(diagram(&points, Watch::default()).unwrap())));
            let d = diagram(&points, Watch::default()).unwrap();
            print!("{n:>8} {name:>8} {:>14.0}", whole * 1e9 / n as f64);
            for (method, run) in METHODS {
                print!(
                    "   {method} {:.3}",
                    least(3, || {
                        black_box(run(d.view()));
                    }) / whole
                );
            }
            println!();
        }
    }
}
