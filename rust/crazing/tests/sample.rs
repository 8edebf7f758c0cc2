//! Frozen points, accuracy of the quantiles, and the refusals.

use crazing::rng::{block, open_unit, stream};
use crazing::sample::{laplace, normal, uniform};
use crazing::{Error, Result, Watch, quantile};

const UNIT: [f64; 4] = [0.0, 0.0, 1.0, 1.0];
const KEY: [u64; 2] = [1, 2];

fn calm() -> Watch<'static> {
    Watch::default()
}

/// A change of one bit here changes what a seed gives: it asks for a new `algorithm_version`.
#[test]
fn frozen_points() -> Result<()> {
    let square = uniform(2, [-1.0, 2.0, 3.0, 2.5], KEY, calm())?;
    let bell = normal(2, [0.0, 1.0], [1.0, 2.0], KEY, calm())?;
    let peak = laplace(2, [0.0, 1.0], [1.0, 2.0], KEY, calm())?;
    let frozen_square = [[2.522219418064845, 2.2231720941588375], [1.6133573118691094, 2.0059654096854027]];
    let frozen_bell = [[1.1777650364816978, 0.7301935169998373], [0.3943517733900555, -3.518699461021769]];
    let frozen_peak = [[1.4317508660472684, 0.7729645573168067], [0.36626168731769515, -6.4709663662561585]];
    assert_eq!((square, bell, peak), (frozen_square.into(), frozen_bell.into(), frozen_peak.into()));
    Ok(())
}

#[test]
fn point_i_is_made_of_block_i() -> Result<()> {
    let points = uniform(3, UNIT, KEY, calm())?;
    for (i, point) in points.iter().enumerate() {
        let words = block(KEY, [i as u64, 0, stream::SAMPLE, 0]);
        assert_eq!(*point, [open_unit(words[0]), open_unit(words[1])]);
    }
    Ok(())
}

#[test]
fn more_points_begin_with_the_fewer() -> Result<()> {
    let few = normal(10, [0.0; 2], [1.0; 2], KEY, calm())?;
    let many = normal(5000, [0.0; 2], [1.0; 2], KEY, calm())?;
    assert_eq!(few, many[..10]);
    Ok(())
}

/// Values of `scipy.special.ndtri`, on both sides of the seams of the three pieces.
#[test]
fn quantile_of_the_normal_is_accurate() {
    let known = [
        (1.110_223_024_625_156_5e-16, -8.209_536_151_601_387),
        (1e-12, -7.034_483_825_301_131),
        (1.388_794_386_496_402_1e-11, -6.657_904_643_501_104),
        (1.4e-11, -6.656_723_091_518_184),
        (1e-6, -4.753_424_308_822_899),
        (0.01, -2.326_347_874_040_840_8),
        (0.074, -1.446_632_067_158_978_5),
        (0.075, -1.439_531_470_938_456_3),
        (0.076, -1.432_502_720_825_811_6),
        (0.3, -0.524_400_512_708_041),
        (0.9, 1.281_551_565_544_600_4),
    ];
    for (p, expected) in known {
        let found = quantile::normal(p);
        assert!((found - expected).abs() <= 2e-15 * expected.abs(), "quantile of {p} is {found}, not {expected}");
    }
    assert_eq!(quantile::normal(0.5), 0.0);
}

#[test]
fn quantiles_are_symmetric_to_the_bit() {
    for word in [0, 1 << 12, 1 << 30, 1 << 60, 0x9E37_79B9_7F4A_7C15] {
        let p = open_unit(word);
        assert_eq!(quantile::normal(p), -quantile::normal(1.0 - p));
        assert_eq!(quantile::laplace(p), -quantile::laplace(1.0 - p));
    }
}

#[test]
fn extreme_words_give_finite_points() {
    for word in [0, u64::MAX] {
        assert!(quantile::normal(open_unit(word)).abs() < 8.3);
        assert!(quantile::laplace(open_unit(word)).abs() < 36.1);
    }
}

/// An interval of three units in the last place: rounding puts points on its very ends.
#[test]
fn uniform_points_stay_in_bounds() -> Result<()> {
    let bounds = [1e15, -1e-300, 1e15 + 0.375, 1e-300];
    for [x, y] in uniform(2000, bounds, KEY, calm())? {
        assert!(bounds[0] <= x && x <= bounds[2] && bounds[1] <= y && y <= bounds[3]);
    }
    Ok(())
}

#[test]
fn bad_numbers_are_refused() {
    let bad = |result: Result<Vec<[f64; 2]>>| matches!(result, Err(Error::BadValue { .. }));
    let one = [1.0; 2];
    for bounds in
        [[0.0, 0.0, 0.0, 1.0], [0.0, 1.0, 1.0, 0.0], [f64::NAN, 0.0, 1.0, 1.0], [-f64::MAX, 0.0, f64::MAX, 1.0]]
    {
        assert!(bad(uniform(1, bounds, KEY, calm())), "{bounds:?}");
    }
    for scale in [[-1.0, 1.0], [1.0, f64::NAN], [f64::INFINITY, 1.0], [1.0, 1e308]] {
        assert!(bad(normal(1, one, scale, KEY, calm())), "{scale:?}");
        assert!(bad(laplace(1, one, scale, KEY, calm())), "{scale:?}");
    }
    assert!(bad(normal(1, [f64::NAN, 0.0], one, KEY, calm())));
}

#[test]
fn scale_zero_puts_every_point_at_loc() -> Result<()> {
    assert_eq!(laplace(3, [4.0, 5.0], [0.0; 2], KEY, calm())?, [[4.0, 5.0]; 3]);
    Ok(())
}

#[test]
fn too_many_points_are_out_of_memory() {
    let found = uniform(usize::MAX, UNIT, KEY, calm());
    assert!(matches!(found, Err(Error::OutOfMemory { bytes, .. }) if bytes == usize::MAX as u128 * 16));
}

#[test]
fn a_watch_stops_the_work() {
    let stop = || false;
    assert_eq!(uniform(1, UNIT, KEY, Watch::new(&stop)), Err(Error::Interrupted));
}
