//! A short tapered piece of an edge on the grid of pixels.

use super::grid::{PART, UNIT, both, ceil, round};
use super::lanes::Number;

/// A rectangle in parts of a pixel: xmin, ymin, xmax, ymax.
pub(super) type Region = [i64; 4];

/// How fast radii may grow: of discs that nearly hold each other the smaller ones stand out by less than this leaves.
const STEEP: f64 = 1.0 - 1e-6;

/// A tapered piece of an edge: all discs along its middle line, whose radius grows by `slope` a pixel.
#[derive(Debug, Clone, Copy)]
pub(super) struct Piece {
    /// Where the middle line starts, in parts of a pixel.
    pub(super) start: [i64; 2],
    /// Its direction, a unit vector, y down.
    pub(super) along: [f32; 2],
    /// Its length, pixels.
    pub(super) length: f32,
    /// The radius at its start, pixels.
    pub(super) radius: f32,
    /// How fast the radius grows.
    pub(super) slope: f32,
    /// How far along the nearest disc lies ahead of the foot, a pixel from the middle line.
    pub(super) lean: f32,
    /// Row of the edge.
    pub(super) edge: u32,
    /// How much of the edge comes before the piece, pixels.
    pub(super) before: f32,
    /// Whether it holds the first and the second end of its edge.
    pub(super) ends: [bool; 2],
}

impl Piece {
    /// From one place to another.
    pub(super) fn new(
        start: [i64; 2],
        end: [i64; 2],
        radii: [f64; 2],
        edge: u32,
        before: f32,
        ends: [bool; 2],
    ) -> Self {
        let step = both(|axis| (end[axis] - start[axis]) as f64 / UNIT as f64);
        let length = (step[0] * step[0] + step[1] * step[1]).sqrt();
        let slope = (radii[1] - radii[0]) / length;
        let along = if length > 0.0 { both(|axis| (step[axis] / length) as f32) } else { [1.0, 0.0] };
        if slope.is_nan() || slope.abs() >= STEEP {
            // One disc holds the other, or as good as that.
            let is_second = radii[1] > radii[0];
            let (start, radius) = if is_second { (end, radii[1]) } else { (start, radii[0]) };
            let before = if is_second { before + length as f32 } else { before };
            let ends = [ends[0] && !is_second, ends[1] && is_second];
            let radius = radius as f32;
            return Self { start, along, length: 0.0, radius, slope: 0.0, lean: 0.0, edge, before, ends };
        }
        Self {
            start,
            along,
            length: length as f32,
            radius: radii[0] as f32,
            slope: slope as f32,
            lean: (slope / (1.0 - slope * slope).sqrt()) as f32,
            edge,
            before,
            ends,
        }
    }

    /// What the piece covers, grown by one pixel.
    pub(super) fn region(&self) -> Region {
        let far = self.radius.max(self.radius + self.slope * self.length) + 1.0;
        let far = ceil(f64::from(far) * UNIT as f64);
        let reach = both(|axis| round(f64::from(self.along[axis]) * f64::from(self.length) * UNIT as f64));
        let [x, y] = self.start;
        let (p, q) = (x + reach[0], y + reach[1]);
        [x.min(p) - far, y.min(q) - far, x.max(p) + far, y.max(q) + far]
    }

    /// Where a pixel lies from the start, in pixels. The difference is exact and rounded once, so that it does not
    /// depend on where the two are.
    #[inline(always)]
    pub(super) fn offset(&self, x: i64, y: i64) -> [f32; 2] {
        [(x - self.start[0]) as f32 * PART, (y - self.start[1]) as f32 * PART]
    }

    /// Signed distance to the piece, pixels.
    #[inline(always)]
    pub(super) fn distance(&self, x: i64, y: i64) -> f32 {
        let [dx, dy] = self.offset(x, y);
        self.foot(dx, dy).distance
    }

    /// The nearest disc of the piece.
    ///
    /// Among the discs at `s` along the middle line, `hypot(t - s, n) - radius(s)` is convex in `s` and least at
    /// `t + lean |n|`, where the foot of the pixel is at `t` along and `n` beside the line.
    #[inline(always)]
    pub(super) fn foot(&self, dx: f32, dy: f32) -> Foot<f32> {
        Foot::new(dx, dy, self.along, self.length, [self.radius, self.slope], self.lean)
    }
}

/// A pixel seen from the nearest disc of a piece.
#[derive(Debug, Clone, Copy)]
pub(super) struct Foot<N> {
    /// Where the disc would be if the piece had no ends.
    pub(super) raw: N,
    /// Where the disc is along the piece.
    pub(super) s: N,
    /// How far ahead of the disc's centre the pixel is.
    pub(super) ahead: N,
    /// How far beside the middle line it is: positive to the left, as one looks along the piece, y up.
    pub(super) side: N,
    /// Distance to the disc's centre.
    pub(super) centre: N,
    /// The disc's radius.
    pub(super) radius: N,
    /// `centre - radius`.
    pub(super) distance: N,
}

impl<N: Number> Foot<N> {
    /// The foot of a place, from the start of a piece that is known by its numbers.
    #[inline(always)]
    pub(super) fn new(dx: N, dy: N, [u, v]: [N; 2], length: N, widths: [N; 2], lean: N) -> Self {
        let t = dx * u + dy * v;
        let side = dx * v - dy * u;
        let n = side.size();
        let raw = t + lean * n;
        let s = raw.at_least(raw.like(0.0)).at_most(length);
        let ahead = t - s;
        let centre = (ahead * ahead + n * n).root();
        let radius = widths[0] + widths[1] * s;
        Self { raw, s, ahead, side, centre, radius, distance: centre - radius }
    }
}
