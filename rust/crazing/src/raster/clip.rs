//! Convex outlines cut to a square (Sutherland and Hodgman 1974).

use crate::graph::Point;

/// Cuts the convex outline in `corners` to `0 <= x, y <= side`. `spare` is working space.
pub(super) fn to_square(corners: &mut Vec<Point>, spare: &mut Vec<Point>, side: f64) {
    for axis in 0..2 {
        keep(corners, spare, axis, |value| value, 0.0);
        keep(spare, corners, axis, |value| side - value, side);
    }
    for value in corners.iter_mut().flatten() {
        // Rounding in the cuts may leave a corner a hair outside.
        *value = value.clamp(0.0, side);
    }
}

/// Copies the part of an outline where `depth` of one coordinate is not negative; `wall` is where it is 0.
fn keep(from: &[Point], to: &mut Vec<Point>, axis: usize, depth: impl Fn(f64) -> f64, wall: f64) {
    to.clear();
    let Some(mut last) = from.last().copied() else { return };
    for &corner in from {
        let (before, after) = (depth(last[axis]), depth(corner[axis]));
        if (before < 0.0) != (after < 0.0) {
            let t = before / (before - after);
            let mut cut = [last[0] + t * (corner[0] - last[0]), last[1] + t * (corner[1] - last[1])];
            cut[axis] = wall;
            to.push(cut);
        }
        if after >= 0.0 {
            to.push(corner);
        }
        last = corner;
    }
}

/// Whether an outline that was cut to the square fills it.
pub(super) fn fills_square(corners: &[Point], side: f64) -> bool {
    let turns = corners.iter().zip(corners.iter().cycle().skip(1));
    let twice: f64 = turns.map(|(p, q)| p[0] * q[1] - q[0] * p[1]).sum();
    twice.abs() >= 2.0 * side * side
}
