//! Discs that are asked what comes into them.

use crate::graph::Point;

/// Segments that pass a disc at a tangent, and those from far away, are rounded: what comes this near is looked at
/// rather than missed. A part of the squared distance of their ends.
const GRAZE: f64 = 1e-13;
/// The same for the direction of a segment that begins on the border.
const TANGENT: f64 = 1e-6;
/// A segment through a cell is clear of a disc only by so much more, in parts of the squared radius and distance: the
/// vertices beyond it are rounded, too.
const CLEAR: [f64; 2] = [1e-5, 1e-9];

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
    pub(super) square: f64,
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
        along < least * (1.0 + TANGENT) && Self::near_line(a, between(a, b), self.square_radius + GRAZE * least)
    }

    /// Whether a segment through a cell leaves all of the disc on one side.
    #[inline]
    pub(super) fn is_clear_of(&self, a: Place, b: Place) -> bool {
        let (along, least) = (a.x * b.x + a.y * b.y, a.square.min(b.square));
        let clear = self.square_radius * (1.0 + CLEAR[0]);
        least > clear
            && (along >= least * (1.0 + TANGENT) || !Self::near_line(a, between(a, b), clear + CLEAR[1] * least))
    }

    /// Whether the ray from a point that is not inside comes into the disc.
    pub(super) fn meets_ray(&self, a: Place, step: Point) -> bool {
        let size = a.x.abs().max(a.y.abs()) * step[0].abs().max(step[1].abs());
        a.x * step[0] + a.y * step[1] < TANGENT * size
            && Self::near_line(a, step, self.square_radius + CLEAR[1] * a.square)
    }

    /// Whether the line through a place comes nearer than the root of `square`.
    #[inline]
    fn near_line(a: Place, step: Point, square: f64) -> bool {
        let cross = a.x * step[1] - a.y * step[0];
        cross * cross <= square * (step[0] * step[0] + step[1] * step[1])
    }
}

#[inline]
fn between(a: Place, b: Place) -> Point {
    [b.x - a.x, b.y - a.y]
}
