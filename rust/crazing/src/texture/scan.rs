//! On which plate every pixel lies: rows of pixels are scanned for the middle lines that they cross.
//!
//! Between two crossings a row stays on one plate, which is the one on that side of the edge it crossed last. So plates
//! are those between the middle lines, however wide the cracks are. Where the plates end, at the bounds of a crack
//! without a period, a pixel is on the plate of the nearest place within.

use super::BAND;
use super::Pattern;
use super::bands::Sorted;
use super::cut::{self, images};
use super::grid::{Grid, UNIT, Window, both};
use super::line::Line;
use super::plates::Sides;
use super::ray::Ray;
use crate::error::{Error, Result};

/// Where no line is crossed, and where it is not known which.
pub(super) const NONE: u32 = u32::MAX;

/// Pixels looked at together.
const LANES: usize = 8;

/// The middles of a window's pixels along one axis, each at the nearest place within the bounds.
#[derive(Debug, Clone, Copy)]
pub(super) struct Axis {
    first: i64,
    pub(super) count: usize,
    /// First and last place within.
    pub(super) low: i64,
    pub(super) high: i64,
}

impl Axis {
    pub(super) fn place(&self, pixel: usize) -> i64 {
        (self.first + pixel as i64 * UNIT).min(self.high).max(self.low)
    }

    /// How many pixels lie before a place.
    #[inline(always)]
    pub(super) fn before(&self, place: i64) -> usize {
        if place <= self.low {
            0
        } else if place > self.high {
            self.count
        } else {
            (place - self.first + UNIT - 1).div_euclid(UNIT).clamp(0, self.count as i64) as usize
        }
    }
}

/// The lines that the rows of a window cross.
#[derive(Debug)]
pub(super) struct Scan {
    lines: Vec<Line>,
    /// By bands of rows.
    bands: Sorted,
    /// The code of the first pixel of every row: twice the line last crossed, and the side on which it is.
    firsts: Vec<u32>,
    axes: [Axis; 2],
}

impl Scan {
    /// Looks for the lines in a window; the plates end at `bounds` if there is no period.
    pub(super) fn new(pattern: &Pattern<'_>, grid: &Grid, window: Window, bounds: [f64; 4]) -> Result<Self> {
        let axes = axes(grid, window, bounds);
        let region = [axes[0].place(0), axes[1].place(0), last(&axes[0]), last(&axes[1])];
        let mut lines = Vec::new();
        let mut ray = Ray::new(*grid, axes, [region[0], region[1]]);
        for row in 0..pattern.edges.len() {
            let line = cut::line(pattern, grid, row)?;
            ray.offer(&line);
            let ([left, right], [top, bottom]) = (line.span(0), line.span(1));
            let [columns, rows] =
                both(|axis| images([left, top, right, bottom], region, grid.period[axis] * UNIT, axis));
            for i in columns.0..=columns.1 {
                for j in rows.0..=rows.1 {
                    lines.push(line.moved([i * grid.period[0] * UNIT, j * grid.period[1] * UNIT]));
                }
            }
        }
        let first = ray.end(pattern)?;
        lines.extend(first.map(|(line, _)| line));
        if lines.len() >= NONE as usize / 2 {
            return Err(Error::TooMany { what: "middle lines", found: lines.len(), limit: NONE as usize / 2 });
        }
        let spans = lines.iter().map(|line| {
            let (first, last) = (axes[1].before(line.span(1)[0]), axes[1].before(line.span(1)[1]));
            if first < last { (first / BAND) as u32..((last - 1) / BAND) as u32 + 1 } else { 0..0 }
        });
        let bands = Sorted::new(spans.collect(), axes[1].count.div_ceil(BAND))?;
        let first = first.map_or(NONE, |(_, side)| 2 * (lines.len() as u32 - 1) + side);
        let mut scan = Self { lines, bands, firsts: vec![NONE; axes[1].count], axes };
        scan.descend(first);
        Ok(scan)
    }

    /// Follows the column of the first pixels down.
    fn descend(&mut self, first: u32) {
        let (at, mut firsts) = (self.axes[0].place(0), std::mem::take(&mut self.firsts));
        for (id, line) in (0..).zip(&self.lines).filter(|(_, line)| line.is_crossed(1, at)) {
            let pixel = self.axes[1].before(line.passed(1, at));
            if pixel > 0 && pixel < firsts.len() {
                self.cross(&mut firsts[pixel], id, 1, at);
            }
        }
        spread(first, &mut firsts);
        self.firsts = firsts;
    }

    /// Notes in front of a pixel that a line is crossed, if it is the last one there.
    #[inline(always)]
    fn cross(&self, code: &mut u32, id: u32, axis: usize, at: i64) {
        let line = &self.lines[id as usize];
        if *code == NONE || line.order(&self.lines[*code as usize / 2], axis, at).is_gt() {
            *code = 2 * id + line.side(axis);
        }
    }

    /// The codes of all pixels of a band.
    pub(super) fn band(&self, band: usize, codes: &mut [u32]) {
        let [columns, rows] = &self.axes;
        let top = band * BAND;
        codes.fill(NONE);
        for &id in self.bands.of(band) {
            let line = &self.lines[id as usize];
            let [low, high] = line.span(1);
            for row in rows.before(low).max(top)..rows.before(high).min(top + codes.len() / columns.count) {
                let at = rows.place(row);
                let pixel = columns.before(line.passed(0, at));
                // What lies before the first pixel of a row is known from the column.
                if pixel > 0 && pixel < columns.count {
                    self.cross(&mut codes[(row - top) * columns.count + pixel], id, 0, at);
                }
            }
        }
        for (row, codes) in codes.chunks_exact_mut(columns.count).enumerate() {
            spread(self.firsts[top + row], codes);
        }
    }

    /// The plate of a code.
    pub(super) fn plate(&self, sides: &Sides<'_>, code: u32) -> i32 {
        self.line(code).map_or(0, |line| sides.plate(line.edge as usize, code as usize % 2))
    }

    /// The line of a code.
    pub(super) fn line(&self, code: u32) -> Option<&Line> {
        self.lines.get(code as usize / 2)
    }

    /// Writes the plates of some codes.
    pub(super) fn plates(&self, sides: &Sides<'_>, codes: &[u32], out: &mut [i32]) {
        let (mut last, mut plate) = (NONE, 0);
        let mut look = |code: u32| {
            if code != last {
                (last, plate) = (code, self.plate(sides, code));
            }
            plate
        };
        let ((outs, out), (chunks, codes)) = (out.as_chunks_mut::<LANES>(), codes.as_chunks::<LANES>());
        for (out, codes) in outs.iter_mut().zip(chunks) {
            if codes.iter().fold(true, |all, code| all & (*code == codes[0])) {
                *out = [look(codes[0]); LANES];
            } else {
                out.iter_mut().zip(codes).for_each(|(out, code)| *out = look(*code));
            }
        }
        out.iter_mut().zip(codes).for_each(|(out, code)| *out = look(*code));
    }
}

/// Takes every code on to where another begins.
fn spread(first: u32, codes: &mut [u32]) {
    let mut last = first;
    let (chunks, rest) = codes.as_chunks_mut::<LANES>();
    for codes in chunks {
        if codes.iter().fold(true, |all, code| all & (*code == NONE)) {
            *codes = [last; LANES];
        } else {
            spread_one(&mut last, codes);
        }
    }
    spread_one(&mut last, rest);
}

fn spread_one(last: &mut u32, codes: &mut [u32]) {
    for code in codes {
        if *code == NONE {
            *code = *last;
        }
        *last = *code;
    }
}

fn last(axis: &Axis) -> i64 {
    axis.place(axis.count - 1)
}

/// The columns and the rows of a window.
fn axes(grid: &Grid, window: Window, bounds: [f64; 4]) -> [Axis; 2] {
    let within = grid.region(bounds);
    let firsts = [window.left, window.top].map(|pixel| pixel * UNIT + UNIT / 2);
    let counts = [window.width, window.height];
    both(|axis| {
        let ends = [within[axis], within[axis + 2] - 1];
        let [low, high] = if grid.period[axis] == 0 { ends } else { [i64::MIN, i64::MAX] };
        Axis { first: firsts[axis], count: counts[axis], low, high: high.max(low) }
    })
}
