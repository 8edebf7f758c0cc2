//! How far points are from a drawing.

use super::{Point, check};
use crate::error::Result;
use crate::parallel;
use crate::watch::Watch;

/// Most columns and rows of the grid.
const MOST: usize = 2048;

/// Segments by the squares of a grid that their boxes meet.
struct Grid {
    low: Point,
    /// Side of a square.
    side: f64,
    columns: usize,
    rows: usize,
    starts: Vec<u32>,
    held: Vec<u32>,
}

/// Distance of every point from the nearest edge, infinite when there is none.
///
/// # Errors
/// [`Error::BadIndex`](crate::Error::BadIndex) or [`Error::TooMany`](crate::Error::TooMany) for edges that do not fit;
/// [`Error::Interrupted`](crate::Error::Interrupted).
pub fn distances(vertices: &[Point], edges: &[[i32; 2]], points: &[Point], watch: Watch<'_>) -> Result<Vec<f64>> {
    check(vertices.len(), edges)?;
    let segment = |i: usize| edges[i].map(|v| vertices[v as usize]);
    let segments: Vec<[Point; 2]> = parallel::map_watched(edges.len(), segment, watch)?;
    let grid = Grid::of(&segments, watch)?;
    parallel::map_watched(points.len(), |i| grid.nearest(&segments, points[i]), watch)
}

/// Distance of a point from a segment.
fn apart([a, b]: [Point; 2], p: Point) -> f64 {
    let (step, to) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
    let square = step[0] * step[0] + step[1] * step[1];
    let part = if square > 0.0 { ((to[0] * step[0] + to[1] * step[1]) / square).clamp(0.0, 1.0) } else { 0.0 };
    libm::hypot(to[0] - part * step[0], to[1] - part * step[1])
}

impl Grid {
    fn of(segments: &[[Point; 2]], watch: Watch<'_>) -> Result<Self> {
        let ends = || segments.iter().flatten();
        let low = [0, 1].map(|i| ends().fold(f64::INFINITY, |low, p| low.min(p[i])));
        let high = [0, 1].map(|i| ends().fold(f64::NEG_INFINITY, |high, p| high.max(p[i])));
        let (width, height) = (high[0] - low[0], high[1] - low[1]);
        let across = (segments.len() as f64).sqrt().ceil().clamp(1.0, MOST as f64);
        // No smaller than segments are as a rule (the root of their mean square): then few squares hold each.
        let extent = |[a, b]: &[Point; 2]| (a[0] - b[0]).abs().max((a[1] - b[1]).abs()) / width.max(height);
        let square = segments.iter().map(extent).map(|part| part * part).sum::<f64>() / segments.len() as f64;
        let side = (width.max(height) * square.sqrt().max(1.0 / across)).max(f64::MIN_POSITIVE);
        let count = |length: f64| ((length / side) as usize).min(MOST) + 1;
        let (columns, rows) = (count(width), count(height));
        let mut grid = Self { low, side, columns, rows, starts: vec![0; columns * rows + 1], held: Vec::new() };
        let squares: Vec<[usize; 4]> = parallel::map_watched(segments.len(), |i| grid.box_of(segments[i]), watch)?;
        for (i, &corners) in squares.iter().enumerate() {
            watch.poll_at(i)?;
            for square in grid.within(corners) {
                grid.starts[square + 1] += 1;
            }
        }
        for i in 1..grid.starts.len() {
            grid.starts[i] += grid.starts[i - 1];
        }
        let mut next = grid.starts.clone();
        grid.held = vec![0; grid.starts[grid.starts.len() - 1] as usize];
        for (i, &b) in squares.iter().enumerate() {
            watch.poll_at(i)?;
            for square in grid.within(b) {
                grid.held[next[square] as usize] = i as u32;
                next[square] += 1;
            }
        }
        Ok(grid)
    }

    fn column_and_row(&self, p: Point) -> [usize; 2] {
        // Negative numbers become 0.
        let at = |i: usize| ((p[i] - self.low[i]) / self.side) as usize;
        [at(0).min(self.columns - 1), at(1).min(self.rows - 1)]
    }

    fn box_of(&self, [a, b]: [Point; 2]) -> [usize; 4] {
        let ([c, r], [d, s]) = (self.column_and_row(a), self.column_and_row(b));
        [c.min(d), r.min(s), c.max(d), r.max(s)]
    }

    fn within(&self, [left, low, right, high]: [usize; 4]) -> impl Iterator<Item = usize> + use<> {
        let columns = self.columns;
        (low..=high).flat_map(move |row| (left..=right).map(move |column| row * columns + column))
    }

    /// Looks at rings of squares about the point until what is beyond them is farther than the best.
    fn nearest(&self, segments: &[[Point; 2]], p: Point) -> f64 {
        let [column, row] = self.column_and_row(p);
        let mut best = f64::INFINITY;
        for ring in 0..self.columns.max(self.rows) {
            if ring > 0 && best <= (ring - 1) as f64 * self.side {
                break;
            }
            let (low, high) = (row.saturating_sub(ring), (row + ring).min(self.rows - 1));
            for r in low..=high {
                let whole = r.abs_diff(row) == ring;
                let (left, right) = (column.saturating_sub(ring), (column + ring).min(self.columns - 1));
                let step = if whole || ring == 0 { 1 } else { 2 * ring };
                let first = if whole || column >= ring { left } else { column + ring };
                for c in (first..=right).step_by(step) {
                    let square = r * self.columns + c;
                    let held = &self.held[self.starts[square] as usize..self.starts[square + 1] as usize];
                    best = held.iter().fold(best, |best, &i| best.min(apart(segments[i as usize], p)));
                }
            }
        }
        best
    }
}
