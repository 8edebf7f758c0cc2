//! On a torus, spokes keep aside of the directions along its sides: there they run on to the next copy of the source, where
//! four of them are a cross, and its tiles a grid.

use std::f64::consts::FRAC_PI_2;

/// How far into the widest gap between the first spokes such a direction lies: in its very middle a spoke and the mirrored
/// one of a copy would meet on a side, and where two cracks pass it is to be two places.
const BESIDE: f64 = 0.46;
/// Later spokes as near to such a direction, in radians, do not get all the way.
const ALONG: f64 = 0.1;

/// How far the first spokes, of which one is at an angle and each a gap on from the one before, are to be turned back for
/// the directions along the sides to lie in the widest gap that they leave of a quarter turn.
pub(super) fn clearest(gaps: &[f64], first: f64, scale: f64) -> f64 {
    let mut angle = first;
    let mut places: Vec<f64> = Vec::with_capacity(gaps.len() + 1);
    for gap in gaps {
        places.push(angle.rem_euclid(FRAC_PI_2));
        angle += scale * gap;
    }
    places.sort_by(f64::total_cmp);
    places.extend(places.first().map(|place| place + FRAC_PI_2));
    let widest = places.windows(2).max_by(|a, b| (a[1] - a[0]).total_cmp(&(b[1] - b[0])));
    widest.map_or(0.0, |pair| pair[0] + BESIDE * (pair[1] - pair[0]))
}

/// Whether an angle is next to a direction along a side.
pub(super) fn is_along(angle: f64) -> bool {
    let past = angle.rem_euclid(FRAC_PI_2);
    past.min(FRAC_PI_2 - past) < ALONG
}
