//! From data units to pixels cut into 2^16 parts: on that grid, moving by whole pixels is exact.

use crate::error::{Error, Result};
use crate::graph::Point;

/// Parts of a pixel.
pub(super) const UNIT: i64 = 1 << 16;

/// Pixels a part.
pub(super) const PART: f32 = 1.0 / UNIT as f32;

/// Pixels from the picture beyond which the grid is not kept: 2^52 parts are the integers that `f64` holds exactly.
const FAR: f64 = (1_i64 << 36) as f64;

/// How far a period may be from a whole number of pixels: what rounding the bounds and the period can amount to.
const WHOLE: f64 = 1e-6;

/// The data that a picture shows, its size, and whether it repeats.
///
/// One scale in both directions: where the shapes differ, the bounds lie centred and whole within the picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    /// xmin, ymin, xmax, ymax in data units.
    pub bounds: [f64; 4],
    /// Rows of pixels.
    pub height: usize,
    /// Pixels a row.
    pub width: usize,
    /// Width and height after which the pattern repeats, data units.
    pub period: Option<Point>,
}

/// A part of a picture, in pixels from its top left corner; it may reach beyond the picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Window {
    /// First row.
    pub top: i64,
    /// First column.
    pub left: i64,
    /// Rows.
    pub height: usize,
    /// Columns.
    pub width: usize,
}

/// A checked [`View`].
#[derive(Debug, Clone, Copy)]
pub(super) struct Grid {
    /// Pixels a data unit.
    pub(super) scale: f64,
    centre: Point,
    middle: Point,
    /// Whole pixels after which the pattern repeats; 0 where it does not.
    pub(super) period: [i64; 2],
}

impl View {
    /// Checks the view.
    pub(super) fn grid(&self) -> Result<Grid> {
        let [xmin, ymin, xmax, ymax] = self.bounds;
        let (height, width) = (self.height as f64, self.width as f64);
        let scale = (width / (xmax - xmin)).min(height / (ymax - ymin));
        let shape_is_good = xmin < xmax && ymin < ymax && self.bounds.iter().all(|value| value.is_finite());
        if !(shape_is_good && scale.is_normal()) {
            let wanted = "bounds with xmin < xmax and ymin < ymax, of a size that floats can scale, are wanted";
            return Err(Error::BadValue { name: "pixels a data unit", value: scale, wanted });
        }
        let centre = [xmin / 2.0 + xmax / 2.0, ymin / 2.0 + ymax / 2.0];
        let period = self.period.map_or(Ok([0; 2]), |period| whole(period, scale))?;
        Ok(Grid { scale, centre, middle: [width / 2.0, height / 2.0], period })
    }
}

/// A period in whole pixels.
fn whole(period: Point, scale: f64) -> Result<[i64; 2]> {
    let pixels = period.map(|length| length * scale);
    let is_whole = |length: &f64| (0.5..FAR).contains(length) && (length - length.round()).abs() <= WHOLE;
    match pixels.iter().find(|length| !is_whole(length)) {
        None => Ok(pixels.map(|length| length.round() as i64)),
        Some(&value) => {
            let wanted = "a whole number of pixels is wanted: choose a size in the proportions of the period";
            Err(Error::BadValue { name: "the period in pixels", value, wanted })
        }
    }
}

impl Grid {
    /// The place of a vertex in parts of a pixel from the top left corner, y down.
    pub(super) fn place(&self, point: Point, row: usize) -> Result<[i64; 2]> {
        let x = (point[0] - self.centre[0]) * self.scale + self.middle[0];
        let y = self.middle[1] - (point[1] - self.centre[1]) * self.scale;
        let is_good = |pixels: f64, value: f64| value.is_finite() && pixels.abs() <= FAR;
        if !is_good(x, point[0]) || !is_good(y, point[1]) {
            let value = if is_good(x, point[0]) { point[1] } else { point[0] };
            let wanted = "every coordinate that an edge uses must be finite, and within 2^36 pixels of the picture";
            return Err(Error::BadEntry { array: "vertices", row, value, wanted });
        }
        Ok([round(x * UNIT as f64), round(y * UNIT as f64)])
    }

    /// Bounds in parts of a pixel, y down, as far as the grid is kept: left, top, right, bottom.
    pub(super) fn region(&self, bounds: [f64; 4]) -> [i64; 4] {
        let [left, bottom, right, top] = bounds;
        let part = |pixels: f64| round(pixels.clamp(-FAR, FAR) * UNIT as f64);
        let x = |value: f64| part((value - self.centre[0]) * self.scale + self.middle[0]);
        let y = |value: f64| part(self.middle[1] - (value - self.centre[1]) * self.scale);
        [x(left), y(top), x(right), y(bottom)]
    }

    /// A shift in periods, in parts of a pixel, y down.
    pub(super) fn shift(&self, periods: [i64; 2]) -> [i64; 2] {
        [periods[0] * self.period[0] * UNIT, -periods[1] * self.period[1] * UNIT]
    }
}

/// What holds of both axes. Arrays have `map` for that, which is a call where this is none.
#[inline(always)]
pub(super) fn both<T>(of: impl Fn(usize) -> T) -> [T; 2] {
    [of(0), of(1)]
}

/// The nearest integer, halves away from zero: what `round` gives, which is slow where the processor has no such command.
#[inline(always)]
pub(super) fn round(value: f64) -> i64 {
    let whole = value as i64;
    let rest = value - whole as f64;
    whole + i64::from(rest >= 0.5) - i64::from(rest <= -0.5)
}

/// The least integer that is not below a number: what `ceil` gives, likewise.
#[inline(always)]
pub(super) fn ceil(value: f64) -> i64 {
    let whole = value as i64;
    whole + i64::from(value > whole as f64)
}
