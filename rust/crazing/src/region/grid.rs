//! The sides of a region in a grid of squares, of which most are wholly inside or wholly outside.

use super::{Crossing, crossing};
use crate::error::{Error, Result};
use crate::graph::Point;
use crate::watch::Watch;

/// Most squares along an axis: beyond it memory grows and nothing is won.
const MOST_SQUARES: usize = 1024;
/// Sides that the square of a side has in the mean, above which squares follow the corners.
const CROWD: u64 = 64;

/// Squares about an outline.
#[derive(Debug)]
pub(super) struct Grid {
    low: Point,
    /// Mean width and height of a square.
    step: Point,
    /// Squares along each axis.
    count: [usize; 2],
    /// Where squares begin along each axis, and the end; None where all are alike.
    lines: Option<[Vec<f64>; 2]>,
    /// Sides that may meet square `i` are `met[starts[i]..starts[i + 1]]`.
    starts: Vec<u32>,
    met: Vec<u32>,
    /// Whether the middle of each square is inside.
    inside: Vec<bool>,
}

impl Grid {
    pub(super) fn of(coords: &[Point], sides: &[[Point; 2]], queries: usize, watch: Watch<'_>) -> Result<Self> {
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for p in coords {
            low = [low[0].min(p[0]), low[1].min(p[1])];
            high = [high[0].max(p[0]), high[1].max(p[1])];
        }
        let wanted = (4.0 * sides.len() as f64).max(0.25 * queries as f64);
        let count = (wanted.sqrt() as usize).clamp(1, MOST_SQUARES);
        let step = [0, 1].map(|i| (high[i] - low[i]) / count as f64);
        if !(step[0] > 0.0 && step[1] > 0.0) {
            let wanted = "a positive width and height are wanted";
            return Err(Error::BadValue { name: "the extent of the region", value: step[0].min(step[1]), wanted });
        }
        let (starts, met, inside) = (Vec::new(), Vec::new(), Vec::new());
        let mut grid = Self { low, step, count: [count; 2], lines: None, starts, met, inside };
        grid.register(sides, watch)?;
        if grid.is_crowded() {
            grid.follow(coords);
            grid.register(sides, watch)?;
        }
        grid.colour(sides, watch)?;
        Ok(grid)
    }

    /// Whether sides share their squares with many others, as those of small shapes far apart.
    fn is_crowded(&self) -> bool {
        let pairs: u64 = self.starts.windows(2).map(|range| u64::from(range[1] - range[0]).pow(2)).sum();
        pairs > CROWD * self.met.len() as u64
    }

    /// Adds lines where the corners are, as many along each axis as there are squares.
    fn follow(&mut self, coords: &[Point]) {
        let lines = [0, 1].map(|axis| {
            let mut places: Vec<f64> = coords.iter().map(|p| p[axis]).collect();
            places.sort_unstable_by(f64::total_cmp);
            let count = self.count[axis];
            let mut lines: Vec<f64> = (0..=count).map(|i| places[i * (places.len() - 1) / count]).collect();
            lines.extend((1..count).map(|i| self.line(i, axis)));
            lines.sort_unstable_by(f64::total_cmp);
            lines.dedup();
            lines
        });
        self.count = [0, 1].map(|axis| lines[axis].len() - 1);
        self.lines = Some(lines);
    }

    /// Where a square begins along one axis.
    fn line(&self, i: usize, axis: usize) -> f64 {
        match &self.lines {
            None => self.low[axis] + self.step[axis] * i as f64,
            Some(lines) => lines[axis][i],
        }
    }

    fn high(&self, axis: usize) -> f64 {
        self.line(self.count[axis], axis)
    }

    /// Gives every side its place in `order`.
    pub(super) fn renumber(&mut self, order: &[(u32, bool)]) {
        let mut place = vec![0; order.len()];
        for (new, &(old, _)) in order.iter().enumerate() {
            place[old as usize] = new as u32;
        }
        self.met.iter_mut().for_each(|side| *side = place[*side as usize]);
    }

    /// Number of the square along one axis, those beyond the grid brought to its rim.
    fn square(&self, x: f64, axis: usize) -> usize {
        let at = match &self.lines {
            None => ((x - self.low[axis]) / self.step[axis]).max(0.0) as usize,
            Some(lines) => lines[axis].partition_point(|&line| line <= x).saturating_sub(1),
        };
        at.min(self.count[axis] - 1)
    }

    /// Squares that a segment may meet, row by row, with room for rounding.
    fn along(&self, [a, b]: [Point; 2]) -> impl Iterator<Item = usize> + use<'_> {
        let room = self.step.map(|step| 1e-9 * step);
        let [low, high] = if a[1] <= b[1] { [a, b] } else { [b, a] };
        let rows = self.square(low[1] - room[1], 1)..=self.square(high[1] + room[1], 1);
        let is_one = rows.start() == rows.end();
        let rise = high[1] - low[1];
        rows.flat_map(move |row| {
            // The part of the segment in this row; beyond the grid, in the row at its rim.
            let bottom = if row == 0 { f64::NEG_INFINITY } else { self.line(row, 1) - room[1] };
            let is_last = row + 1 == self.count[1];
            let top = if is_last { f64::INFINITY } else { self.line(row + 1, 1) + 3.0 * room[1] };
            let at = |y: f64, otherwise: f64| {
                let part = ((y - low[1]) / rise).clamp(0.0, 1.0);
                if is_one || part.is_nan() { otherwise } else { low[0] + part * (high[0] - low[0]) }
            };
            let (from, to) = (at(bottom, low[0]), at(top, high[0]));
            let columns = self.square(from.min(to) - room[0], 0)..=self.square(from.max(to) + room[0], 0);
            columns.map(move |column| row * self.count[0] + column)
        })
    }

    fn register(&mut self, sides: &[[Point; 2]], watch: Watch<'_>) -> Result<()> {
        let squares = self.count[0] * self.count[1];
        (self.starts, self.inside) = (vec![0; squares + 2], vec![false; squares]);
        for (k, &side) in sides.iter().enumerate() {
            watch.poll_at(k)?;
            let squares: Vec<usize> = self.along(side).collect();
            squares.into_iter().for_each(|square| self.starts[square + 2] += 1);
        }
        for i in 2..self.starts.len() {
            self.starts[i] += self.starts[i - 1];
        }
        self.met = vec![0; self.starts[self.starts.len() - 1] as usize];
        for (k, &side) in sides.iter().enumerate() {
            let squares: Vec<usize> = self.along(side).collect();
            for square in squares {
                // Counted two places on, filled one place on: what is left are the starts.
                let next = &mut self.starts[square + 1];
                self.met[*next as usize] = k as u32;
                *next += 1;
            }
        }
        Ok(())
    }

    fn met_in(&self, square: usize) -> &[u32] {
        &self.met[self.starts[square] as usize..self.starts[square + 1] as usize]
    }

    fn middle(&self, square: usize) -> Point {
        let at = [square % self.count[0], square / self.count[0]];
        match &self.lines {
            None => [0, 1].map(|i| self.low[i] + (at[i] as f64 + 0.5) * self.step[i]),
            Some(lines) => [0, 1].map(|i| 0.5 * (lines[i][at[i]] + lines[i][at[i] + 1])),
        }
    }

    /// Colours the middles of the squares, each by the sides between it and the one before.
    fn colour(&mut self, sides: &[[Point; 2]], watch: Watch<'_>) -> Result<()> {
        for square in 0..self.inside.len() {
            watch.poll_at(square)?;
            let is_first = square % self.count[0] == 0;
            let before = !is_first && self.inside[square - 1];
            let is_clean = self.met_in(square).is_empty() && (is_first || self.met_in(square - 1).is_empty());
            if is_clean {
                self.inside[square] = before;
                continue;
            }
            let middle = self.middle(square);
            let from = if is_first { [self.low[0] - self.step[0], middle[1]] } else { self.middle(square - 1) };
            self.inside[square] = before ^ self.is_odd(sides, from, middle);
        }
        Ok(())
    }

    fn is_odd(&self, sides: &[[Point; 2]], a: Point, b: Point) -> bool {
        let mut odd = false;
        self.crossings(sides, a, b, |_| odd = !odd);
        odd
    }

    pub(super) fn contains(&self, sides: &[[Point; 2]], p: Point) -> bool {
        let within = |i: usize| p[i] >= self.low[i] && p[i] <= self.high(i);
        if !(within(0) && within(1)) {
            return false;
        }
        let square = self.square(p[1], 1) * self.count[0] + self.square(p[0], 0);
        self.inside[square] ^ (!self.met_in(square).is_empty() && self.is_odd(sides, p, self.middle(square)))
    }

    /// Whether both ends are inside, when no side comes near the way between them.
    pub(super) fn is_inside(&self, a: Point, b: Point) -> Option<bool> {
        let room = self.step.map(|step| 1e-9 * step);
        let range = |i: usize| {
            let (low, high) = (a[i].min(b[i]) - room[i], a[i].max(b[i]) + room[i]);
            let within = low > self.low[i] && high < self.high(i);
            within.then(|| (self.square(low, i), self.square(high, i)))
        };
        let ((left, right), (low, high)) = (range(0)?, range(1)?);
        // Long ways are looked at one by one.
        if right - left > 3 || high - low > 3 {
            return None;
        }
        for row in low..=high {
            let row = row * self.count[0];
            if self.starts[row + left] != self.starts[row + right + 1] {
                return None;
            }
        }
        Some(self.inside[low * self.count[0] + left])
    }

    /// Tells of every crossing of the way from `a` to `b` with a side, once.
    pub(super) fn crossings(&self, sides: &[[Point; 2]], a: Point, b: Point, mut tell: impl FnMut(Crossing)) {
        let mut near: [u32; 32] = [0; 32];
        let mut count = 0;
        let mut more: Vec<u32> = Vec::new();
        for &side in self.along([a, b]).flat_map(|square| self.met_in(square)) {
            if count < near.len() {
                near[count] = side;
                count += 1;
            } else {
                more.push(side);
            }
        }
        // Few sides as a rule: no memory is asked for.
        let near = if more.is_empty() {
            &mut near[..count]
        } else {
            more.extend_from_slice(&near[..count]);
            &mut more[..]
        };
        near.sort_unstable();
        for (i, &side) in near.iter().enumerate() {
            let is_new = i == 0 || near[i - 1] != side;
            if let Some(found) = crossing([a, b], sides[side as usize], side).filter(|_| is_new) {
                tell(found);
            }
        }
    }
}
