//! One edge in pixels: the convex hull of two discs.

use std::f64::consts::{FRAC_PI_2, TAU};

use super::Edges;
use super::frame::Mapping;
use super::tile::THINNEST;
use crate::error::{Error, Result};
use crate::graph::Point;
use crate::watch::Watch;

/// How far an outline may lie inside its arc, in pixels.
const SAG: f64 = 0.03;

/// Corners of the finest outline: enough for [`SAG`] on discs up to 50,000 pixels wide.
const MOST_CORNERS: f64 = 4096.0;

/// An edge with its two radii.
#[derive(Debug, Clone, Copy)]
pub(super) struct Taper {
    ends: [Point; 2],
    radii: [f64; 2],
}

/// The edges in pixels, without those that have no width at all.
pub(super) fn tapers(edges: Edges<'_>, mapping: &Mapping, min_width: f64, watch: Watch<'_>) -> Result<Vec<Taper>> {
    let (found, wanted) = (edges.widths.len(), edges.edges.len());
    if found != wanted {
        return Err(Error::BadLength { array: "widths", found, wanted });
    }
    let mut tapers = Vec::new();
    let bytes = wanted as u128 * size_of::<Taper>() as u128;
    tapers.try_reserve_exact(wanted).map_err(|_| Error::OutOfMemory { what: "the edges in pixels", bytes })?;
    for (row, (edge, widths)) in edges.edges.iter().zip(edges.widths).enumerate() {
        watch.poll_at(row)?;
        let places = edge.map(|vertex| edges.vertices[vertex as usize]);
        check(row, *edge, &places, widths)?;
        let widths = widths.map(|width| mapping.length(width).max(min_width));
        if widths != [0.0; 2] {
            let radii = widths.map(|width| width.max(THINNEST) / 2.0);
            tapers.push(Taper { ends: places.map(|place| mapping.place(place)), radii });
        }
    }
    Ok(tapers)
}

fn check(row: usize, edge: [i32; 2], places: &[Point; 2], widths: &[f64; 2]) -> Result<()> {
    if let Some(&value) = widths.iter().find(|width| !(width.is_finite() && **width >= 0.0)) {
        return Err(Error::BadEntry { array: "widths", row, value, wanted: "widths must be finite and at least 0" });
    }
    for (vertex, place) in edge.iter().zip(places) {
        if let Some(&value) = place.iter().find(|value| !value.is_finite()) {
            let wanted = "every coordinate that an edge uses must be finite";
            return Err(Error::BadEntry { array: "vertices", row: *vertex as usize, value, wanted });
        }
    }
    Ok(())
}

impl Taper {
    /// Lowest and highest value along one axis.
    pub(super) fn extent(&self, axis: usize) -> [f64; 2] {
        let [a, b] = self.ends.map(|end| end[axis]);
        let [r, s] = self.radii;
        [(a - r).min(b - s), (a + r).max(b + s)]
    }

    /// Bounds on x within a horizontal strip; an empty interval where the taper misses it.
    pub(super) fn extent_between(&self, top: f64, bottom: f64) -> [f64; 2] {
        let reach = self.radii[0].max(self.radii[1]);
        let [a, b] = self.ends;
        // The part of the middle line that is near enough to reach the strip.
        let at = |y: f64| ((y - a[1]) / (b[1] - a[1])).clamp(0.0, 1.0);
        let (t, u) = if a[1] == b[1] { (0.0, 1.0) } else { (at(top - reach), at(bottom + reach)) };
        let [p, q] = [t, u].map(|t| a[0] + t * (b[0] - a[0]));
        [p.min(q) - reach, p.max(q) + reach]
    }

    /// Appends the corners, seen from `origin`, always in the same turning direction.
    pub(super) fn outline(&self, origin: Point, corners: &mut Vec<Point>) {
        let [a, b] = self.ends.map(|end| [end[0] - origin[0], end[1] - origin[1]]);
        let [r, s] = self.radii;
        let step = [b[0] - a[0], b[1] - a[1]];
        let length = (step[0] * step[0] + step[1] * step[1]).sqrt();
        if length <= (r - s).abs() {
            let (centre, radius) = if r >= s { (a, r) } else { (b, s) };
            return arc(centre, radius, [1.0, 0.0], TAU, corners);
        }
        // Both tangent points lie at this angle from the edge, seen from either centre.
        let cosine = (r - s) / length;
        let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
        let angle = libm::atan2(sine, cosine);
        let [u, v] = step.map(|part| part / length);
        arc(b, s, [cosine * u + sine * v, cosine * v - sine * u], 2.0 * angle, corners);
        arc(a, r, [cosine * u - sine * v, cosine * v + sine * u], TAU - 2.0 * angle, corners);
    }
}

/// Appends points on an arc, both its ends among them.
fn arc(centre: Point, radius: f64, start: Point, sweep: f64, corners: &mut Vec<Point>) {
    if radius == 0.0 {
        return corners.push(centre);
    }
    // A chord over the angle t lies r (1 - cos(t / 2)) <= r t^2 / 8 inside its arc.
    let finest = (8.0 * SAG / radius).sqrt().clamp(TAU / MOST_CORNERS, FRAC_PI_2);
    let count = (sweep / finest).ceil().max(1.0);
    let (sine, cosine) = libm::sincos(sweep / count);
    let mut spoke = start;
    for _ in 0..=count as usize {
        corners.push([centre[0] + radius * spoke[0], centre[1] + radius * spoke[1]]);
        spoke = [cosine * spoke[0] - sine * spoke[1], cosine * spoke[1] + sine * spoke[0]];
    }
}
