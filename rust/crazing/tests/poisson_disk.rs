//! Poisson disks: the same few points as ever, and many that keep the same laws wherever they were cut into tiles.

use crazing::sample::poisson_disk;
use crazing::{Error, Point, Result, Watch, in_pool_of};
use proptest::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};

const UNIT: [f64; 4] = [0.0, 0.0, 1.0, 1.0];
const KEY: [u64; 2] = [1, 2];

fn made(radius: f64, bounds: [f64; 4], on_torus: bool) -> Result<Vec<Point>> {
    poisson_disk(radius, bounds, on_torus, KEY, Watch::default())
}

/// The radius of which about so many points come.
fn radius_of(count: f64, [xmin, ymin, xmax, ymax]: [f64; 4]) -> f64 {
    (0.62 * (xmax - xmin) * (ymax - ymin) / count).sqrt()
}

/// Of the bits of all coordinates.
fn hash(points: &[Point], seed: u64) -> u64 {
    let step = |hash: u64, x: &f64| {
        let mixed = (hash ^ x.to_bits()).wrapping_mul(0x0100_0000_01b3);
        mixed ^ (mixed >> 29)
    };
    points.as_flattened().iter().fold(seed ^ points.len() as u64, step)
}

/// The least distance of two points, over the radius: by looking along the longer side, on a torus at copies, too.
fn least_apart(points: &[Point], radius: f64, [xmin, ymin, xmax, ymax]: [f64; 4], on_torus: bool) -> f64 {
    let (wide, high) = (xmax - xmin, ymax - ymin);
    let mut all = points.to_vec();
    if on_torus {
        let turns = [-1.0, 0.0, 1.0].map(|x| [-1.0, 0.0, 1.0].map(|y| [x * wide, y * high]));
        let near = |p: &Point| p[0] > xmin - 2.0 * radius && p[0] < xmax + 2.0 * radius;
        let moved = |[x, y]: Point| points.iter().map(move |p| [p[0] + x, p[1] + y]);
        let copies = turns.into_iter().flatten().filter(|turn| *turn != [0.0; 2]).flat_map(moved);
        all.extend(copies.filter(near).filter(|p| p[1] > ymin - 2.0 * radius && p[1] < ymax + 2.0 * radius));
    }
    let along = usize::from(high > wide);
    all.sort_by(|p, q| p[along].total_cmp(&q[along]));
    let mut least = f64::INFINITY;
    for (i, p) in all.iter().enumerate() {
        for q in all[i + 1..].iter().take_while(|q| q[along] - p[along] < radius) {
            least = least.min((p[0] - q[0]).hypot(p[1] - q[1]) / radius);
        }
    }
    least
}

/// A change of one bit here changes what a seed gives: it asks for a new `algorithm_version`.
#[test]
fn frozen_few() -> Result<()> {
    let mut found = 0;
    for bounds in [UNIT, [-0.3, 7.0, 0.7, 9.0], [1e9, -1e9, 1e9 + 3.0, -1e9 + 0.1], [0.0, 0.0, 0.07, 5.0]] {
        for count in [0.3, 1.0, 2.0, 5.0, 20.0, 100.0, 400.0, 1500.0, 4000.0] {
            for on_torus in [false, true] {
                found = hash(&made(radius_of(count, bounds), bounds, on_torus)?, found);
            }
        }
    }
    assert_eq!(found, 0x72ce_008c_865e_9c7d);
    Ok(())
}

#[test]
fn frozen_many() -> Result<()> {
    let plane = made(radius_of(20_000.0, UNIT), UNIT, false)?;
    let torus = made(radius_of(20_000.0, UNIT), UNIT, true)?;
    assert_eq!([hash(&plane, 0), hash(&torus, 0)], [0xd568_efe1_9e5a_1b79, 0x5c5e_7e5d_4938_6811]);
    Ok(())
}

#[test]
fn as_many_threads_as_there_are_change_nothing() -> Result<()> {
    for on_torus in [false, true] {
        let of = |threads| in_pool_of(threads, || made(radius_of(30_000.0, UNIT), UNIT, on_torus));
        let alone = of(1)?;
        assert!(alone.len() > 25_000);
        assert_eq!(alone, of(2)?);
        assert_eq!(alone, of(3)?);
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    #[test]
    fn none_is_nearer_than_the_radius(
        count in 4000.0..25_000.0_f64,
        long in -4.0..4.0_f64,
        corner in prop::array::uniform2(-1e3..1e3_f64),
        far in prop::sample::select(vec![0.0, 1.0, 1e6]),
        on_torus in any::<bool>(),
        key in any::<[u64; 2]>(),
    ) {
        let [x, y] = corner.map(|x| x * far);
        let bounds = [x, y, x + long.exp2(), y + (-long).exp2()];
        let radius = radius_of(count, bounds);
        let points = poisson_disk(radius, bounds, on_torus, key, Watch::default()).expect("nothing is wrong with it");
        let is_inside = |i: usize, x: f64| bounds[i] <= x && x <= bounds[i + 2] && (x < bounds[i + 2] || !on_torus);
        prop_assert!(points.iter().all(|p| is_inside(0, p[0]) && is_inside(1, p[1])));
        // A copy is rounded where it lies.
        let rounded = 8.0 * f64::EPSILON * (x.abs().max(y.abs()) + 32.0) / radius;
        prop_assert!(least_apart(&points, radius, bounds, on_torus) >= 1.0 - rounded);
        prop_assert!((points.len() as f64 / count - 1.0).abs() < 0.1);
    }
}

/// Radii beyond the box, strips thinner than a cell, coordinates as coarse as the radius, tori of few cells.
#[test]
fn nothing_is_too_odd() -> Result<()> {
    let boxes = [
        (5.0, UNIT),
        (1e30, UNIT),
        (1e-3, [0.0, 0.0, 20.0, 1e-3]),
        (1.0, [0.0, 0.0, 3e4, 1e-9]),
        (1.0, [0.0, 0.0, 0.1, 2e4]),
        (1.0, [0.0, 0.0, 1e4, 1.2]),
        (1.0, [0.0, 0.0, 2.1, 1e4]),
        (1.0, [0.0, 0.0, 3e2, 60.0]),
        (1.0, [0.0, 0.0, 3e3, 22.0]),
        (1.0, [0.0, 0.0, 3e3, 23.0]),
        (1e-4, [1e9, -1e9, 1e9 + 0.02, -1e9 + 0.02]),
        (0.5, [1e16, 1e16, 1e16 + 100.0, 1e16 + 100.0]),
        (0.5, [-1e16, 1e15, -1e16 + 100.0, 1e15 + 100.0]),
        (1e-60, [0.0, 0.0, 1e-58, 2e-58]),
        (1e60, [-1e62, 0.0, 1e62, 1e62]),
    ];
    for (radius, bounds) in boxes {
        for on_torus in [false, true] {
            let points = made(radius, bounds, on_torus)?;
            assert!(!points.is_empty());
            let is_inside = |p: &Point| (0..2).all(|i| bounds[i] <= p[i] && p[i] <= bounds[i + 2]);
            assert!(points.iter().all(is_inside), "{radius} {bounds:?}");
            if bounds[0].abs() < 1e15 || radius > 1.0 {
                let least = least_apart(&points, radius, bounds, on_torus && radius < 1.0 && bounds[3] < 1e3);
                assert!(least >= 1.0 - 1e-2, "{radius} {bounds:?}: {least}");
            }
        }
    }
    Ok(())
}

#[test]
fn a_watch_stops_few_and_many() {
    for count in [10.0, 60_000.0] {
        let asked = AtomicUsize::new(0);
        let stop = || asked.fetch_add(1, Ordering::Relaxed) < if count < 100.0 { 0 } else { 2 };
        let found = poisson_disk(radius_of(count, UNIT), UNIT, false, KEY, Watch::new(&stop));
        assert_eq!(found, Err(Error::Interrupted));
    }
}
