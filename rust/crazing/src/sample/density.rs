//! Points by the brightness of an image.

use super::{check_box, reserved};
use crate::error::{Error, Result};
use crate::graph::Point;
use crate::rng::{Key, block, open_unit, stream};
use crate::watch::Watch;

/// A density over bounds, one number a pixel; row 0 is the top.
#[derive(Debug, Clone, Copy)]
pub struct Density<'a> {
    /// Row by row.
    pub values: &'a [f64],
    /// Pixels in a row.
    pub columns: usize,
    /// xmin, ymin, xmax, ymax of the picture.
    pub bounds: [f64; 4],
}

impl Density<'_> {
    /// Checks that the picture is one and holds no negative number.
    ///
    /// # Errors
    /// [`Error::BadLength`], [`Error::BadEntry`], [`Error::BadValue`].
    pub fn check(&self) -> Result<()> {
        check_box(self.bounds)?;
        let found = self.values.len();
        if self.columns == 0 || found == 0 || !found.is_multiple_of(self.columns) {
            return Err(Error::BadLength {
                array: "density",
                found,
                wanted: found.next_multiple_of(self.columns.max(1)),
            });
        }
        match self.values.iter().position(|value| !(value.is_finite() && *value >= 0.0)) {
            Some(row) => {
                let wanted = "a finite number of at least 0 is wanted";
                Err(Error::BadEntry { array: "density", row, value: self.values[row], wanted })
            }
            None => Ok(()),
        }
    }

    fn rows(&self) -> usize {
        self.values.len() / self.columns
    }

    /// Of the pixel at a place; beyond the bounds that of the picture's copy there.
    pub fn at(&self, p: Point) -> f64 {
        let [xmin, ymin, xmax, ymax] = self.bounds;
        let part = |x: f64, low: f64, high: f64| {
            let t = (x - low) / (high - low);
            t - t.floor()
        };
        let pixel = |part: f64, count: usize| ((part * count as f64) as usize).min(count - 1);
        let row = self.rows() - 1 - pixel(part(p[1], ymin, ymax), self.rows());
        self.values[row * self.columns + pixel(part(p[0], xmin, xmax), self.columns)]
    }
}

/// `n` points, each pixel as likely as it is bright, evenly within a pixel. Point i depends on the key and i alone.
///
/// # Errors
/// [`Error::BadValue`] when the whole picture is black, and as [`Density::check`]; [`Error::OutOfMemory`],
/// [`Error::Interrupted`].
pub fn from_density(density: Density<'_>, n: usize, key: Key, watch: Watch<'_>) -> Result<Vec<Point>> {
    density.check()?;
    let mut sums = Vec::with_capacity(density.values.len());
    let mut total = 0.0;
    for &value in density.values {
        total += value;
        sums.push(total);
    }
    if !(total > 0.0 && total.is_finite()) {
        let wanted = "a positive, finite number is wanted";
        return Err(Error::BadValue { name: "the sum of the density", value: total, wanted });
    }
    let [xmin, ymin, xmax, ymax] = density.bounds;
    let (wide, high) = ((xmax - xmin) / density.columns as f64, (ymax - ymin) / density.rows() as f64);
    let mut points = reserved(n)?;
    for i in 0..n {
        watch.poll_at(i)?;
        let words = block(key, [i as u64, 0, stream::DENSITY, 0]);
        let [wanted, u, v] = [0, 1, 2].map(|word| open_unit(words[word]));
        // Never a black pixel: its sum is that of the pixel before.
        let pixel = sums.partition_point(|&sum| sum <= wanted * total).min(sums.len() - 1);
        let (row, column) = (pixel / density.columns, pixel % density.columns);
        let (x, y) = (xmin + wide * (column as f64 + u), ymax - high * (row as f64 + v));
        points.push([x.clamp(xmin, xmax), y.clamp(ymin, ymax)]);
    }
    Ok(points)
}
