//! From data units to pixels.

use crate::error::{Error, Result};
use crate::graph::Point;

/// Pixels farther from the picture than this are pulled in, so that no arithmetic on them overflows.
const FAR: f64 = 1e100;

/// The window of data that a picture shows, and its size.
///
/// One scale in both directions: where the shapes differ, the bounds lie centred and whole within the picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// xmin, ymin, xmax, ymax in data units.
    pub bounds: [f64; 4],
    /// Rows of pixels.
    pub height: usize,
    /// Pixels a row.
    pub width: usize,
}

/// A checked [`Frame`].
#[derive(Debug, Clone, Copy)]
pub(super) struct Mapping {
    scale: f64,
    centre: Point,
    middle: Point,
}

impl Frame {
    /// Checks the frame against the bytes that are to hold its pixels.
    pub(super) fn mapping(&self, bytes: usize) -> Result<Mapping> {
        let [xmin, ymin, xmax, ymax] = self.bounds;
        let (height, width) = (self.height as f64, self.width as f64);
        let scale = (width / (xmax - xmin)).min(height / (ymax - ymin));
        let shape_is_good = xmin < xmax && ymin < ymax && self.bounds.iter().all(|value| value.is_finite());
        if !(shape_is_good && scale.is_normal()) {
            let wanted = "bounds with xmin < xmax and ymin < ymax, of a size that floats can scale, are wanted";
            return Err(Error::BadValue { name: "pixels a data unit", value: scale, wanted });
        }
        let wanted = self.height.checked_mul(self.width).and_then(|pixels| pixels.checked_mul(4));
        if wanted != Some(bytes) || bytes == 0 {
            return Err(Error::BadLength { array: "out", found: bytes, wanted: wanted.unwrap_or(usize::MAX) });
        }
        let centre = [xmin / 2.0 + xmax / 2.0, ymin / 2.0 + ymax / 2.0];
        Ok(Mapping { scale, centre, middle: [width / 2.0, height / 2.0] })
    }
}

impl Mapping {
    /// The place of a point of the data, in pixels from the top left corner, y down.
    pub(super) fn place(&self, point: Point) -> Point {
        let x = (point[0] - self.centre[0]) * self.scale + self.middle[0];
        let y = self.middle[1] - (point[1] - self.centre[1]) * self.scale;
        [x.clamp(-FAR, FAR), y.clamp(-FAR, FAR)]
    }

    /// A length of the data, in pixels.
    pub(super) fn length(&self, length: f64) -> f64 {
        (length * self.scale).min(FAR)
    }
}
