//! Discs that are asked what comes into them.

use crate::graph::Point;

/// Segments that pass a disc at a tangent, and those from far away, are rounded: what comes this near is looked at
/// rather than missed. A part of squared lengths.
const GRAZE: f64 = 1e-9;
/// The same for the direction of a segment that begins on the border.
const TANGENT: f64 = 1e-6;

/// A disc, its radius rounded up.
#[derive(Debug, Clone, Copy)]
pub(super) struct Disc {
    pub(super) centre: Point,
    pub(super) square_radius: f64,
}

/// A point as seen from the centre of a disc.
#[derive(Clone, Copy)]
pub(super) struct Place {
    x: f64,
    y: f64,
    square: f64,
}

impl Disc {
    /// A disc of at least the radius whose square is given: by so much more that no rounding of its centre, nor of
    /// where another point is seen from there, puts a point outside that is inside.
    pub(super) fn new(centre: Point, square_radius: f64) -> Self {
        let coarse = 4.0 * f64::EPSILON * (centre[0].abs() + centre[1].abs());
        let radius = square_radius.sqrt() * (1.0 + 1e-12) + coarse;
        Self { centre, square_radius: radius * radius }
    }

    #[inline]
    pub(super) fn place(&self, v: Point) -> Place {
        let (x, y) = (v[0] - self.centre[0], v[1] - self.centre[1]);
        Place { x, y, square: x * x + y * y }
    }

    #[inline]
    pub(super) fn holds(&self, place: Place) -> bool {
        place.square <= self.square_radius
    }

    /// Whether the segment between two points that are not inside comes into the disc.
    #[inline]
    pub(super) fn meets_segment(&self, a: Place, b: Place) -> bool {
        let (along, least) = (a.x * b.x + a.y * b.y, a.square.min(b.square));
        // Nearly always the nearest point of the segment is one of its ends.
        along < least * (1.0 + TANGENT) && self.meets_line(a, [b.x - a.x, b.y - a.y], least)
    }

    /// The same for the ray from a point that is not inside.
    pub(super) fn meets_ray(&self, a: Place, step: Point) -> bool {
        let along = a.x * step[0] + a.y * step[1];
        let size = a.x.abs().max(a.y.abs()) * step[0].abs().max(step[1].abs());
        along < TANGENT * size && self.meets_line(a, step, a.square)
    }

    /// Whether the line through a place comes into the disc, or as near as rounding can tell; `least` is how far
    /// away, squared, the nearer end is.
    #[inline]
    fn meets_line(&self, a: Place, step: Point, least: f64) -> bool {
        let cross = a.x * step[1] - a.y * step[0];
        cross * cross <= (self.square_radius + GRAZE * least) * (step[0] * step[0] + step[1] * step[1])
    }
}
