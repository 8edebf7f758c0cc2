//! Edges cut into short tapered pieces on the grid of pixels.

use super::Pattern;
use super::grid::{Grid, PART, UNIT, round};
use crate::error::{Error, Result};
use crate::watch::Watch;

/// The longest piece, in pixels, unless the edge is wider: short enough that `f32` tells its places apart.
const LONGEST: f64 = 64.0;

/// A rectangle in parts of a pixel: xmin, ymin, xmax, ymax.
pub(super) type Region = [i64; 4];

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
    fn new(start: [i64; 2], end: [i64; 2], radii: [f64; 2], edge: u32, before: f32, ends: [bool; 2]) -> Self {
        let step = [0, 1].map(|axis| (end[axis] - start[axis]) as f64 / UNIT as f64);
        let length = (step[0] * step[0] + step[1] * step[1]).sqrt();
        let slope = (radii[1] - radii[0]) / length;
        if slope.is_nan() || slope.abs() >= 0.999 {
            // One disc holds the other, or nearly so.
            let (start, radius) = if radii[0] >= radii[1] { (start, radii[0]) } else { (end, radii[1]) };
            let radius = radius as f32;
            return Self { start, along: [1.0, 0.0], length: 0.0, radius, slope: 0.0, lean: 0.0, edge, before, ends };
        }
        Self {
            start,
            along: step.map(|part| (part / length) as f32),
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
        let far = (f64::from(far) * UNIT as f64).ceil() as i64;
        let reach = self.along.map(|part| round(f64::from(part) * f64::from(self.length) * UNIT as f64));
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
    pub(super) fn foot(&self, dx: f32, dy: f32) -> Foot {
        Foot::new(dx, dy, self.along, self.length, [self.radius, self.slope], self.lean)
    }
}

/// A pixel seen from the nearest disc of a piece.
#[derive(Debug, Clone, Copy)]
pub(super) struct Foot {
    /// Where the disc would be if the piece had no ends.
    pub(super) raw: f32,
    /// Where the disc is along the piece.
    pub(super) s: f32,
    /// How far ahead of the disc's centre the pixel is.
    pub(super) ahead: f32,
    /// How far beside the middle line it is: positive to the left, as one looks along the piece, y up.
    pub(super) side: f32,
    /// Distance to the disc's centre.
    pub(super) centre: f32,
    /// The disc's radius.
    pub(super) radius: f32,
    /// `centre - radius`.
    pub(super) distance: f32,
}

impl Foot {
    /// The foot of a place, from the start of a piece that is known by its numbers.
    #[inline(always)]
    pub(super) fn new(dx: f32, dy: f32, [u, v]: [f32; 2], length: f32, widths: [f32; 2], lean: f32) -> Self {
        let t = dx * u + dy * v;
        let side = dx * v - dy * u;
        let n = side.abs();
        let raw = t + lean * n;
        let s = if raw < 0.0 { 0.0 } else { raw };
        let s = if s > length { length } else { s };
        let ahead = t - s;
        let centre = (ahead * ahead + n * n).sqrt();
        let radius = widths[0] + widths[1] * s;
        Self { raw, s, ahead, side, centre, radius, distance: centre - radius }
    }
}

/// The pieces whose discs meet `region`, in the order of their edges; on a torus with all their images in it;
/// and whether these are all, without a period.
///
/// The order among the images of one edge is by place, so it does not change when the pattern is moved.
pub(super) fn pieces(
    pattern: &Pattern<'_>,
    grid: &Grid,
    region: Region,
    watch: Watch<'_>,
) -> Result<(Vec<Piece>, bool)> {
    let (mut found, mut all) = (Vec::new(), grid.period == [0; 2]);
    for (row, (edge, widths)) in pattern.edges.iter().zip(pattern.widths).enumerate() {
        watch.poll_at(row)?;
        let [a, b] = edge.map(|vertex| vertex as usize);
        let start = grid.place(pattern.vertices[a], a)?;
        let mut end = grid.place(pattern.vertices[b], b)?;
        let shift = pattern.shifts.get(row).map_or([0; 2], |shift| grid.shift(shift.map(i64::from)));
        end = [end[0] + shift[0], end[1] + shift[1]];
        if let Some(&value) = widths.iter().find(|width| !(width.is_finite() && **width >= 0.0)) {
            return Err(Error::BadEntry {
                array: "widths",
                row,
                value,
                wanted: "widths must be finite and at least 0",
            });
        }
        let radii = widths.map(|width| (width * grid.scale / 2.0).min((1_i64 << 36) as f64));
        let far = ((radii[0].max(radii[1]) + 1.0) * UNIT as f64).ceil() as i64;
        let box_of = [
            start[0].min(end[0]) - far,
            start[1].min(end[1]) - far,
            start[0].max(end[0]) + far,
            start[1].max(end[1]) + far,
        ];
        all &= (0..2).all(|axis| region[axis] <= box_of[axis] && box_of[axis + 2] <= region[axis + 2]);
        let [columns, rows] = [0, 1].map(|axis| images(box_of, region, grid.period[axis] * UNIT, axis));
        for i in columns.0..=columns.1 {
            for j in rows.0..=rows.1 {
                let by = [i * grid.period[0] * UNIT, j * grid.period[1] * UNIT];
                let ends = [start, end].map(|place| [place[0] + by[0], place[1] + by[1]]);
                cut(ends, radii, row as u32, region, &mut found)?;
            }
        }
    }
    Ok((found, all))
}

/// First and last multiple of `period` that brings the box into the region along one axis.
fn images(box_of: Region, region: Region, period: i64, axis: usize) -> (i64, i64) {
    let (low, high) = (region[axis] - box_of[axis + 2], region[axis + 2] - box_of[axis]);
    if period == 0 {
        return if low <= 0 && 0 <= high { (0, 0) } else { (0, -1) };
    }
    (low.div_euclid(period) + i64::from(low.rem_euclid(period) != 0), high.div_euclid(period))
}

/// Cuts one edge into pieces and keeps those that meet the region.
fn cut(ends: [[i64; 2]; 2], radii: [f64; 2], edge: u32, region: Region, found: &mut Vec<Piece>) -> Result<()> {
    let [start, end] = ends;
    let step = [end[0] - start[0], end[1] - start[1]].map(|part| part as f64);
    let length = (step[0] * step[0] + step[1] * step[1]).sqrt() / UNIT as f64;
    let widest = radii[0].max(radii[1]);
    let count = (length / LONGEST.max(widest)).ceil().max(1.0);
    // The part of the middle line that can matter, with a piece to spare on either side.
    let far = (widest + 2.0) * UNIT as f64;
    let (mut first, mut last) = (0.0_f64, 1.0_f64);
    for axis in 0..2 {
        if step[axis] != 0.0 {
            let at = |wall: f64| (wall - start[axis] as f64) / step[axis];
            let (a, b) = (at(region[axis] as f64 - far), at(region[axis + 2] as f64 + far));
            (first, last) = (first.max(a.min(b)), last.min(a.max(b)));
        }
    }
    if first > last {
        return Ok(());
    }
    let (first, last) = ((first * count).floor() as i64 - 1, (last * count).ceil() as i64 + 1);
    let at = |k: i64| {
        let part = k as f64 / count;
        let place = [0, 1].map(|axis| start[axis] + round(step[axis] * part));
        (place, radii[0] + (radii[1] - radii[0]) * part)
    };
    let (first, last) = (first.max(0), last.min(count as i64));
    let bytes = (last - first) as u128 * size_of::<Piece>() as u128;
    found
        .try_reserve((last - first) as usize)
        .map_err(|_| Error::OutOfMemory { what: "the edges in pixels", bytes })?;
    for k in first..last {
        let ((a, r), (b, s)) = (at(k), at(k + 1));
        let before = (length * (k as f64 / count)) as f32;
        found.push(Piece::new(a, b, [r, s], edge, before, [k == 0, k + 1 == count as i64]));
    }
    Ok(())
}
