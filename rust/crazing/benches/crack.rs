//! `cargo bench --bench crack [-- sites]`: what each step of a crack costs, as ratios to the diagram in one run.

#![allow(clippy::print_stdout, clippy::unwrap_used, missing_docs)]

use std::hint::black_box;
use std::time::Instant;

use crazing::crack::{
    FenceView, Profile, Roughness, Splitting, Straightening, Stubs, pairs, roughen, split, straighten, strands, stubs,
    warp, widths, within,
};
use crazing::diagram::diagram;
use crazing::{Watch, sample};

/// Runs work some times; what it gives, and the seconds of the fastest.
fn timed<T>(name: &str, unit: f64, mut work: impl FnMut() -> T) -> (T, f64) {
    let mut least = f64::INFINITY;
    let mut found = None;
    for _ in 0..2 {
        let start = Instant::now();
        found = Some(black_box(work()));
        least = least.min(start.elapsed().as_secs_f64());
    }
    println!("{name:>12} {:>7.3} s {:>6.2} x", least, least / unit);
    (found.unwrap(), least)
}

fn main() {
    let n = std::env::args().find_map(|arg| arg.parse().ok()).unwrap_or(1_000_000);
    let (watch, bounds) = (Watch::default(), [0.0, 0.0, 1.0, 1.0]);
    let points = sample::uniform(n, bounds, [1, 2], watch).unwrap();
    let start = Instant::now();
    drop(black_box(diagram(&points, watch).unwrap()));
    let unit = start.elapsed().as_secs_f64();
    timed("diagram", unit, || diagram(&points, watch).unwrap());
    let (points, _) = timed("relax", unit, || sample::relax(points.clone(), 3, bounds, None, watch).unwrap());
    let (d, _) = timed("diagram", unit, || diagram(&points, watch).unwrap());
    let spacing = 1.0 / (n as f64).sqrt();
    // Not a maze, but as open as one.
    let open: Vec<bool> = (0..d.edges.len()).map(|k| (k * 7919) % 1000 < 150).collect();
    let (walls, _) = timed("walls", unit, || within(d.view(), &open, bounds).unwrap());
    let fence = walls.fence.view();
    let (partner, _) = timed("pairs", unit, || pairs(walls.net.view(), 1.0));
    let how = Straightening { rounds: 3, pull: 0.3, slide: 0.37, clamp: 0.1, unbend: 0 };
    let mut net = walls.net.clone();
    (net.vertices, _) =
        timed("straighten", unit, || straighten(walls.net.view(), &partner, fence, how, watch).unwrap());
    let straight = net.clone();
    let (bent, _) =
        timed("warp", unit, || warp(straight.view(), fence, 0.035 * spacing, bounds, [3, 4], watch).unwrap());
    net.vertices = bent.0;
    let fence = FenceView { anchors: &bent.1, ..fence };
    let how = Stubs { rate: 0.5 / spacing, length: 0.37 * spacing, spread: 0.06, lean: 0.14 };
    let (grown, _) = timed("stubs", unit, || stubs(net.view(), &partner, fence, bounds, how, [5, 6], watch).unwrap());
    let how = Roughness { amplitude: 0.01, hurst: 0.7, unit: spacing, grain: 0.2 * spacing, rounding: 0.0 };
    let (rough, _) = timed("roughen", unit, || {
        roughen(grown.net.view(), &grown.partner, grown.fence.view(), how, [7, 8], watch).unwrap()
    });
    let (net, profile) =
        (rough.net.view(), Profile { width: 0.05 * spacing, unevenness: 0.2, unit: spacing, ..Profile::default() });
    let (found, _) = timed("strands", unit, || strands(net, &rough.partner, &[]));
    timed("widths", unit, || widths(net, &found, profile, [9, 10]).unwrap());
    let how = Splitting { cells: n, jitter: 0.3, bend: 1.0, anisotropy: 1.0, angle: 0.0 };
    timed("split", unit, || split(bounds, false, how, None, [11, 12], watch).unwrap());
}
