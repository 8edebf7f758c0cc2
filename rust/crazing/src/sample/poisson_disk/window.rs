//! What a tile sees: its own cells and those about it, in memory of its own.

use super::frame::Frame;
use super::tiles::{Tile, Tiling};
use crate::graph::Point;

const NOWHERE: Point = [f64::NAN; 2];
/// How far a tile sees, in radii: its points lie up to two outside, the places about them two more, what is too near to
/// these one more.
const SIGHT: f64 = 5.0;
/// So far from a point lies what is too near to a place in its ring, in radii.
const NEAR: f64 = 3.0;
/// Distances that are found at a time.
const LANES: usize = 4;
/// More than discs of one radius have room about a point within [`NEAR`], and a multiple of the lanes.
const MOST: usize = 64;

/// Cells with the points in them, which on a torus are those copies that are near the tile.
#[derive(Default)]
pub(super) struct Window {
    /// The cell at its corner, counted from that of the bounds.
    first: [isize; 2],
    counts: [usize; 2],
    cells: Vec<Point>,
    near: Near,
}

impl Window {
    /// Looks at a tile.
    #[inline(always)]
    pub(super) fn look(&mut self, tiling: &Tiling<'_>, tile: usize, tiles: &[Tile]) {
        let (frame, columns) = (tiling.frame, tiling.counts[0]);
        let (at, reach) = ([tile % columns, tile / columns], frame.reach(SIGHT));
        for i in 0..2 {
            let [first, end] = tiling.cells(i, at[i]);
            self.first[i] = first as isize - reach[i] as isize;
            self.counts[i] = end - first + 2 * reach[i];
        }
        self.cells.clear();
        self.cells.resize(self.counts[0] * self.counts[1], NOWHERE);
        for row in tiling.beside(1, at[1]) {
            for column in tiling.beside(0, at[0]) {
                for &p in &tiles[row * columns + column].points {
                    if let Some((slot, image)) = self.slot(frame, p) {
                        self.cells[slot] = image;
                    }
                }
            }
        }
    }

    /// The place among the cells of a point within the bounds, and the point as it is seen from the tile; none if it is
    /// not seen.
    #[inline(always)]
    fn slot(&self, frame: &Frame, p: Point) -> Option<(usize, Point)> {
        let (cell, mut at, mut image) = (frame.cell(p), [0; 2], p);
        for i in 0..2 {
            let (count, size) = (frame.counts[i] as isize, frame.bounds[i + 2] - frame.bounds[i]);
            at[i] = cell[i] as isize - self.first[i];
            // A tile sees no farther than once around a torus.
            if frame.on_torus && at[i] < 0 {
                (at[i], image[i]) = (at[i] + count, p[i] + size);
            } else if frame.on_torus && at[i] >= count {
                (at[i], image[i]) = (at[i] - count, p[i] - size);
            }
            if !(0..self.counts[i] as isize).contains(&at[i]) {
                return None;
            }
        }
        Some((at[1] as usize * self.counts[0] + at[0] as usize, image))
    }

    /// Gets ready for places in the ring about a point, which it gives as it is seen from the tile.
    #[inline(always)]
    pub(super) fn gather(&mut self, frame: &Frame, p: Point) -> Point {
        let centre = self.slot(frame, p).map_or(p, |(_, image)| image);
        // Along each axis the cells that the circle reaches.
        let [columns, rows] = [0, 1].map(|i| {
            let middle = (centre[i] - frame.bounds[i]) / frame.sides[i] - self.first[i] as f64;
            let reach = NEAR * frame.radius / frame.sides[i];
            let end = ((middle + reach) as usize).saturating_add(1).min(self.counts[i]);
            ((middle - reach) as usize).min(end)..end
        });
        let rows = self.cells.chunks_exact(self.counts[0]).take(rows.end).skip(rows.start);
        self.near.gather(centre, NEAR * frame.radius, rows.map(|row| &row[columns.clone()]));
        centre
    }

    /// A place in the ring that was got ready for, as it lies within the bounds and from now on taken; none if it is not
    /// free.
    #[inline(always)]
    pub(super) fn take(&mut self, frame: &Frame, p: Point) -> Option<Point> {
        if !frame.is_well_inside(p) {
            return self.take_outside(frame, p);
        }
        if self.near.is_free(p, frame.radius) { self.settle(frame, p) } else { None }
    }

    #[inline(never)]
    fn take_outside(&mut self, frame: &Frame, p: Point) -> Option<Point> {
        let inside = frame.inside_bounds(p)?;
        let (_, image) = self.slot(frame, inside)?;
        if self.near.is_free(image, frame.radius) { self.settle(frame, inside) } else { None }
    }

    #[inline(never)]
    fn settle(&mut self, frame: &Frame, p: Point) -> Option<Point> {
        let (slot, image) = self.slot(frame, p)?;
        // A cell has room for two only where coordinates are rounded as coarsely as that.
        if !self.cells[slot][0].is_nan() {
            return None;
        }
        self.cells[slot] = image;
        Some(p)
    }
}

/// The points near a centre.
struct Near {
    x: [f64; MOST],
    y: [f64; MOST],
    len: usize,
}

impl Default for Near {
    fn default() -> Self {
        Self { x: [0.0; MOST], y: [0.0; MOST], len: 0 }
    }
}

impl Near {
    #[inline(always)]
    fn gather<'a>(&mut self, centre: Point, radius: f64, rows: impl Iterator<Item = &'a [Point]>) {
        let (most, mut len) = (radius * radius, 0);
        for row in rows {
            for p in row {
                // Every one is written, and the next over it if it is not near: whether it is cannot be foretold.
                (self.x[len % MOST], self.y[len % MOST]) = (p[0], p[1]);
                let (x, y) = (p[0] - centre[0], p[1] - centre[1]);
                len += usize::from(x * x + y * y < most);
            }
        }
        // Where coordinates are rounded as coarsely as the radius there may be more: the last stand for all.
        self.len = len.min(MOST);
        self.x[self.len..(self.len + LANES).min(MOST)].fill(f64::INFINITY);
    }

    /// Whether a place is no nearer to any of the points than the radius.
    #[inline(always)]
    fn is_free(&self, p: Point, radius: f64) -> bool {
        let mut least = [f64::INFINITY; LANES];
        let (x, y) = (self.x.as_chunks::<LANES>().0, self.y.as_chunks::<LANES>().0);
        for (x, y) in x.iter().zip(y).take(self.len.div_ceil(LANES)) {
            for lane in 0..LANES {
                let (x, y) = (p[0] - x[lane], p[1] - y[lane]);
                let apart = x * x + y * y;
                least[lane] = if apart < least[lane] { apart } else { least[lane] };
            }
        }
        least.into_iter().all(|apart| apart >= radius * radius)
    }
}
