//! Edges cut into short pieces.

use std::ops::Range;

use super::Pattern;
use super::grid::{Grid, UNIT, both, ceil, round};
use super::line::Line;
use super::piece::{Piece, Region};
use crate::error::{Error, Result};

/// The longest piece, in pixels, unless the edge is wider: short enough that `f32` tells its places apart.
const LONGEST: f64 = 64.0;

/// The pieces of some edges whose discs meet `region`, in the order of the edges; on a torus with all their images in
/// it; and whether these are all, without a period.
///
/// The order among the images of one edge is by place, so it does not change when the pattern is moved.
pub(super) fn pieces(
    pattern: &Pattern<'_>,
    grid: &Grid,
    rows: Range<usize>,
    region: Region,
) -> Result<(Vec<Piece>, bool)> {
    let (mut found, mut all) = (Vec::new(), grid.period == [0; 2]);
    // Most edges are one piece.
    let bytes = rows.len() as u128 * size_of::<Piece>() as u128;
    found.try_reserve(rows.len()).map_err(|_| Error::OutOfMemory { what: "the edges in pixels", bytes })?;
    for row in rows {
        let widths = pattern.widths[row];
        let Line { start, end, .. } = line(pattern, grid, row)?;
        if let Some(&value) = widths.iter().find(|width| !(width.is_finite() && **width >= 0.0)) {
            return Err(Error::BadEntry {
                array: "widths",
                row,
                value,
                wanted: "widths must be finite and at least 0",
            });
        }
        let radii = both(|end| (widths[end] * grid.scale / 2.0).min((1_i64 << 36) as f64));
        let far = ceil((radii[0].max(radii[1]) + 1.0) * UNIT as f64);
        let box_of = [
            start[0].min(end[0]) - far,
            start[1].min(end[1]) - far,
            start[0].max(end[0]) + far,
            start[1].max(end[1]) + far,
        ];
        all &= (0..2).all(|axis| region[axis] <= box_of[axis] && box_of[axis + 2] <= region[axis + 2]);
        let [columns, lines] = both(|axis| images(box_of, region, grid.period[axis] * UNIT, axis));
        for i in columns.0..=columns.1 {
            for j in lines.0..=lines.1 {
                let by = [i * grid.period[0] * UNIT, j * grid.period[1] * UNIT];
                let ends = [[start[0] + by[0], start[1] + by[1]], [end[0] + by[0], end[1] + by[1]]];
                cut(ends, radii, row as u32, region, &mut found)?;
            }
        }
    }
    Ok((found, all))
}

/// The middle line of an edge.
#[inline(always)]
pub(super) fn line(pattern: &Pattern<'_>, grid: &Grid, row: usize) -> Result<Line> {
    let [a, b] = both(|end| pattern.edges[row][end] as usize);
    let (start, end) = (grid.place(pattern.vertices[a], a)?, grid.place(pattern.vertices[b], b)?);
    let shift = pattern.shifts.get(row).map_or([0; 2], |shift| grid.shift(both(|axis| i64::from(shift[axis]))));
    Ok(Line { start, end: [end[0] + shift[0], end[1] + shift[1]], edge: row as u32 })
}

/// First and last multiple of `period` that brings the box into the region along one axis.
pub(super) fn images(box_of: Region, region: Region, period: i64, axis: usize) -> (i64, i64) {
    let (low, high) = (region[axis] - box_of[axis + 2], region[axis + 2] - box_of[axis]);
    if period == 0 {
        return if low <= 0 && 0 <= high { (0, 0) } else { (0, -1) };
    }
    (low.div_euclid(period) + i64::from(low.rem_euclid(period) != 0), high.div_euclid(period))
}

/// Cuts one edge into pieces and keeps those that meet the region.
fn cut(ends: [[i64; 2]; 2], radii: [f64; 2], edge: u32, region: Region, found: &mut Vec<Piece>) -> Result<()> {
    let [start, end] = ends;
    let step = both(|axis| (end[axis] - start[axis]) as f64);
    let length = (step[0] * step[0] + step[1] * step[1]).sqrt() / UNIT as f64;
    let widest = radii[0].max(radii[1]);
    if length <= LONGEST.max(widest) {
        // The same as below, of one piece.
        found.push(Piece::new(start, end, [radii[0], radii[0] + (radii[1] - radii[0])], edge, 0.0, [true; 2]));
        return Ok(());
    }
    let count = (length / LONGEST.max(widest)).ceil();
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
        let place = both(|axis| start[axis] + round(step[axis] * part));
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
