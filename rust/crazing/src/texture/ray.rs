//! The plate of a window's first pixel: a ray from there to the middle line next to it, wherever that is.

use super::Pattern;
use super::cut;
use super::grid::{Grid, UNIT, both};
use super::line::Line;
use super::scan::Axis;
use crate::error::Result;

/// A ray along a row (`axis` 0) or a column (1) from a place, first to its left or up; if it meets nothing there without
/// a period, the other way.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ray {
    grid: Grid,
    axes: [Axis; 2],
    place: [i64; 2],
    axis: usize,
    before: Option<Line>,
    behind: Option<Line>,
}

impl Ray {
    /// Along the row of a place.
    pub(super) fn new(grid: Grid, axes: [Axis; 2], place: [i64; 2]) -> Self {
        Self { grid, axes, place, axis: 0, before: None, behind: None }
    }

    /// Looks whether a line is met, on a torus whether one of its images is.
    #[inline(always)]
    pub(super) fn offer(&mut self, line: &Line) {
        let (across, at) = (1 - self.axis, self.place[1 - self.axis]);
        let ([low, high], period) = (line.span(across), self.grid.period[across] * UNIT);
        if period == 0 {
            if low <= at && at < high {
                self.meet(*line);
            }
            return;
        }
        for image in (at - high).div_euclid(period) + 1..=(at - low).div_euclid(period) {
            self.meet(line.moved(both(|axis| if axis == across { image * period } else { 0 })));
        }
    }

    fn meet(&mut self, line: Line) {
        let (axis, at) = (self.axis, self.place[1 - self.axis]);
        let (period, passed) = (self.grid.period[axis] * UNIT, line.passed(axis, at));
        let Axis { low, high, .. } = self.axes[axis];
        if period > 0 {
            let by = (self.place[axis] - passed).div_euclid(period) * period;
            let line = line.moved(both(|other| if other == axis { by } else { 0 }));
            if self.before.is_none_or(|before| line.order(&before, axis, at).is_gt()) {
                self.before = Some(line);
            }
        } else if low < passed && passed <= self.place[axis] {
            if self.before.is_none_or(|before| line.order(&before, axis, at).is_gt()) {
                self.before = Some(line);
            }
        } else if self.place[axis] < passed
            && passed <= high
            && self.behind.is_none_or(|behind| line.order(&behind, axis, at).is_lt())
        {
            self.behind = Some(line);
        }
    }

    /// The line that is met, and the side of it on which the place is.
    fn met(&self) -> Option<(Line, u32)> {
        let before = self.before.map(|line| (line, line.side(self.axis)));
        before.or(self.behind.map(|line| (line, 1 - line.side(self.axis))))
    }

    /// The same once all lines were offered. Where none crosses the row, all of it is on one plate: a column is followed
    /// from that row to a line that it surely meets.
    pub(super) fn end(mut self, pattern: &Pattern<'_>) -> Result<Option<(Line, u32)>> {
        if self.before.is_some() || self.behind.is_some() {
            return Ok(self.met());
        }
        self.axis = 1;
        let mut upright = None;
        for row in 0..pattern.edges.len() {
            let line = cut::line(pattern, &self.grid, row)?;
            if let Some(column) = self.column(&line) {
                self.place[0] = column;
                for row in 0..pattern.edges.len() {
                    self.offer(&cut::line(pattern, &self.grid, row)?);
                }
                return Ok(self.met());
            }
            upright = upright.or(self.is_upright(&line).then_some(line));
        }
        // No column meets anything: what is to the right of one line is the whole plate.
        Ok(upright.map(|line| (line, line.side(0))))
    }

    /// A column that meets a line within the bounds, if there is one.
    fn column(&self, line: &Line) -> Option<i64> {
        let (mut first, mut last) = (0.0_f64, 1.0_f64);
        let step = both(|axis| (line.end[axis] - line.start[axis]) as f64);
        for axis in [0, 1].into_iter().filter(|&axis| self.grid.period[axis] == 0) {
            let Axis { low, high, .. } = self.axes[axis];
            let at = |wall: i64| (wall - line.start[axis]) as f64 / step[axis];
            if step[axis] != 0.0 {
                (first, last) = (first.max(at(low).min(at(high))), last.min(at(low).max(at(high))));
            }
        }
        let column = line.start[0] + (step[0] * (first + last) / 2.0) as i64;
        let [columns, rows] = &self.axes;
        let is_in = columns.low <= column && column <= columns.high && line.is_crossed(1, column);
        let meets = |passed: i64| rows.low < passed && passed <= rows.high;
        (is_in && meets(line.passed(1, column))).then_some(column)
    }

    /// Whether a line runs straight up within the bounds.
    fn is_upright(&self, line: &Line) -> bool {
        let ([left, right], [top, bottom]) = (line.span(0), line.span(1));
        let [columns, rows] = &self.axes;
        let inside = columns.low <= left && left <= columns.high && rows.low < bottom && top <= rows.high;
        left == right && top < bottom && inside
    }
}
