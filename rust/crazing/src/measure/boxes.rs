//! Box dimension: how the number of boxes that a drawing meets falls as the boxes grow.

use super::network::Drawing;
use crate::error::Result;
use crate::graph::Point;
use crate::parallel;
use crate::watch::Watch;

/// Slope of log number over log size, for `levels` sizes from `smallest`, each twice the one before. Boxes stand from
/// the lower left of the bounds, of the drawing where it has none; those that do not lie whole within the bounds, or
/// within one period, are left out.
///
/// # Source
/// Falconer: Fractal Geometry, section 3.1.
pub(super) fn dimension(drawing: &Drawing<'_>, smallest: f64, levels: usize, watch: Watch<'_>) -> Result<f64> {
    let (corner, size) = window(drawing);
    let far = [0, 1].map(|i| ends(drawing, i).fold(0.0_f64, |far, x| far.max(x - corner[i])));
    let reach = if on_torus(drawing) { size } else { [0, 1].map(|i| far[i].min(size[i])) };
    let counts = match Grid::new(reach.map(|x| x / smallest), drawing.edges.len()) {
        Some(grid) => dense(drawing, corner, size.map(|x| x / smallest), smallest, levels, grid, watch)?,
        None => sparse(drawing, corner, size.map(|x| x / smallest), smallest, levels, watch)?,
    };
    Ok(slope(&counts))
}

fn on_torus(drawing: &Drawing<'_>) -> bool {
    !drawing.shifts.is_empty()
}

/// One coordinate of both ends of every edge: a vertex without one is not drawn.
fn ends(drawing: &Drawing<'_>, i: usize) -> impl Iterator<Item = f64> {
    drawing.edges.iter().flatten().map(move |&end| drawing.vertices[end as usize][i])
}

/// Lower left corner and size of where boxes stand.
fn window(drawing: &Drawing<'_>) -> (Point, Point) {
    let lowest = [0, 1].map(|i| ends(drawing, i).fold(f64::INFINITY, f64::min));
    match drawing.bounds {
        Some([xmin, ymin, xmax, ymax]) => ([xmin, ymin], [xmax - xmin, ymax - ymin]),
        None if on_torus(drawing) => (lowest, drawing.period),
        None => (lowest, [f64::INFINITY; 2]),
    }
}

/// Calls `visit` with column and row of every box that an edge passes, some of them often.
fn passed(
    drawing: &Drawing<'_>,
    corner: Point,
    smallest: f64,
    watch: Watch<'_>,
    mut visit: impl FnMut([i64; 2]),
) -> Result<()> {
    for k in 0..drawing.edges.len() {
        watch.poll_at(k)?;
        let vertex = drawing.vertices[drawing.edges[k][0] as usize];
        let way = drawing.step(2 * k as u32);
        for from in copies(drawing, [0, 1].map(|i| vertex[i] - corner[i]), way) {
            crossed(from.map(|x| x / smallest), way.map(|x| x / smallest), &mut visit);
        }
    }
    Ok(())
}

/// Where an edge begins: once, or, on a torus, for every period that it runs through, so that what leaves one side
/// comes in at the other.
fn copies(drawing: &Drawing<'_>, from: Point, way: Point) -> impl Iterator<Item = Point> {
    let period = if on_torus(drawing) { drawing.period } else { [f64::INFINITY; 2] };
    let turns = |x: f64, i: usize| if period[i].is_finite() { (x / period[i]).floor() as i64 } else { 0 };
    let first = [0, 1].map(|i| turns(from[i], i));
    let last = [0, 1].map(|i| turns(from[i] + way[i], i));
    let range = move |i: usize| first[i].min(last[i])..=first[i].max(last[i]);
    let place = move |x: f64, turn: i64, i: usize| if turn == 0 { x } else { x - turn as f64 * period[i] };
    range(0).flat_map(move |x| range(1).map(move |y| [place(from[0], x, 0), place(from[1], y, 1)]))
}

/// Numbers of boxes by sorting them.
fn sparse(
    drawing: &Drawing<'_>,
    corner: Point,
    size: Point,
    smallest: f64,
    levels: usize,
    watch: Watch<'_>,
) -> Result<Vec<f64>> {
    let mut keys = Vec::new();
    passed(drawing, corner, smallest, watch, |[column, row]| keys.push(key(column, row)))?;
    let count = |level: usize| {
        watch.poll()?;
        parallel::sort(&mut keys);
        keys.dedup();
        let side = f64::from(1_u32 << level);
        let fits = |at: i64, size: f64| at >= 0 && (at + 1) as f64 * side <= size;
        let whole = |&&key: &&u64| (0..2).all(|i| fits(place(key, level)[i], size[i]));
        let found = keys.iter().filter(whole).count() as f64;
        keys.iter_mut().for_each(|key| *key = halved(*key));
        Ok(found)
    };
    (0..levels).map(count).collect()
}

/// Numbers of boxes by marking them.
fn dense(
    drawing: &Drawing<'_>,
    corner: Point,
    size: Point,
    smallest: f64,
    levels: usize,
    mut grid: Grid,
    watch: Watch<'_>,
) -> Result<Vec<f64>> {
    passed(drawing, corner, smallest, watch, |at| grid.mark(at))?;
    let count = |level: usize| {
        let side = f64::from(1_u32 << level);
        let found = grid.count(size.map(|x| (x / side).floor()));
        grid = grid.halved();
        found
    };
    Ok((0..levels).map(count).collect())
}

/// Boxes that are marked, one bit each.
struct Grid {
    columns: usize,
    rows: usize,
    /// Words a row.
    stride: usize,
    words: Vec<u64>,
}

/// Boxes an edge for which a grid is still better than sorting.
const ROOM: f64 = 1024.0;

impl Grid {
    /// A grid of that size in boxes, unless it would be much larger than what is drawn on it.
    fn new(size: Point, edges: usize) -> Option<Self> {
        let [columns, rows] = size.map(|x| x.floor() + 1.0);
        // Comparisons that a NaN fails.
        let fits = columns >= 1.0 && rows >= 1.0 && columns * rows <= ROOM * (edges as f64 + 64.0);
        fits.then(|| Self::empty(columns as usize, rows as usize))
    }

    fn empty(columns: usize, rows: usize) -> Self {
        let stride = columns.div_ceil(64);
        Self { columns, rows, stride, words: vec![0; stride * rows] }
    }

    fn mark(&mut self, [column, row]: [i64; 2]) {
        if (0..self.columns as i64).contains(&column) && (0..self.rows as i64).contains(&row) {
            self.words[row as usize * self.stride + column as usize / 64] |= 1 << (column % 64);
        }
    }

    /// Marked boxes among the first columns and rows.
    fn count(&self, [columns, rows]: Point) -> f64 {
        let (columns, rows) = (columns.min(self.columns as f64) as usize, rows.min(self.rows as f64) as usize);
        let inside = |word: usize| {
            let left = columns.saturating_sub(64 * word);
            if left >= 64 { u64::MAX } else { (1 << left) - 1 }
        };
        let row = |row: &[u64]| {
            row.iter().enumerate().map(|(i, word)| f64::from((word & inside(i)).count_ones())).sum::<f64>()
        };
        self.words.chunks(self.stride.max(1)).take(rows).map(row).sum()
    }

    /// The grid of boxes twice the size: marked where one of four was.
    fn halved(&self) -> Self {
        let mut half = Self::empty(self.columns.div_ceil(2), self.rows.div_ceil(2));
        for (at, words) in self.words.chunks(self.stride.max(1)).enumerate() {
            for (i, &word) in words.iter().enumerate() {
                half.words[at / 2 * half.stride + i / 2] |= squeezed(word | word >> 1) << (32 * (i % 2));
            }
        }
        half
    }
}

/// Every second bit, moved together.
fn squeezed(word: u64) -> u64 {
    let masks =
        [0x3333_3333_3333_3333, 0x0F0F_0F0F_0F0F_0F0F, 0x00FF_00FF_00FF_00FF, 0x0000_FFFF_0000_FFFF, 0xFFFF_FFFF];
    (0..5).fold(word & 0x5555_5555_5555_5555, |word, i| (word | word >> (1 << i)) & masks[i])
}

/// Coordinates are kept away from zero, so that halving them rounds all one way.
const OFFSET: i64 = 1 << 30;
/// An edge longer than this many boxes is no edge of a pattern; it counts with its beginning.
const MOST: f64 = 1e6;

fn key(column: i64, row: i64) -> u64 {
    let within = |x: i64| (x + OFFSET).clamp(0, 2 * OFFSET) as u64;
    within(row) << 32 | within(column)
}

/// Column and row of a box of a level.
fn place(key: u64, level: usize) -> [i64; 2] {
    [key & 0xFFFF_FFFF, key >> 32].map(|x| x as i64 - (OFFSET >> level))
}

fn halved(key: u64) -> u64 {
    (key >> 1) & 0x7FFF_FFFF_7FFF_FFFF
}

/// The boxes of side 1 that a segment passes, in turn.
fn crossed(from: Point, way: Point, visit: &mut impl FnMut([i64; 2])) {
    let mut at = from.map(|x| x.floor() as i64);
    let end = [0, 1].map(|i| (from[i] + way[i]).floor() as i64);
    let sign = way.map(|x| if x > 0.0 { 1 } else { -1 });
    // Where along the way, from 0 to 1, the next side is met, for both directions.
    let side = |i: usize| if way[i] > 0.0 { from[i].floor() + 1.0 - from[i] } else { from[i].floor() - from[i] };
    let mut meets = [0, 1].map(|i| if way[i] == 0.0 { f64::INFINITY } else { side(i) / way[i] });
    let steps = ((end[0] - at[0]).abs() + (end[1] - at[1]).abs()).min(MOST as i64);
    visit(at);
    for _ in 0..steps {
        let i = usize::from(meets[1] < meets[0]);
        at[i] += sign[i];
        meets[i] += 1.0 / way[i].abs();
        visit(at);
    }
}

/// Least squares of log2 count over level, with its sign turned.
fn slope(counts: &[f64]) -> f64 {
    let middle = (counts.len() as f64 - 1.0) / 2.0;
    let (mut above, mut below) = (0.0, 0.0);
    for (level, &count) in counts.iter().enumerate() {
        let x = level as f64 - middle;
        above -= x * libm::log2(count);
        below += x * x;
    }
    above / below
}

#[cfg(test)]
mod tests {
    use super::{Drawing, Grid, Watch, dense, sparse};

    #[test]
    fn marking_counts_as_sorting_does() {
        let vertices: Vec<[f64; 2]> = (0..60).map(|i| [f64::from(i * 37 % 61), f64::from(i * 53 % 59) / 2.0]).collect();
        let edges: Vec<[i32; 2]> = (0..59).map(|i| [i, i + 1]).collect();
        let drawing = Drawing { vertices: &vertices, edges: &edges, ..Drawing::default() };
        for size in [[61.0, 30.0], [200.0, 100.0], [20.5, 7.5]] {
            let boxes = size.map(|x: f64| x / 0.3);
            let watch = Watch::default();
            let grid = Grid::new([61.0 / 0.3, 30.0 / 0.3], 1000);
            let marked = grid.map(|grid| dense(&drawing, [0.0; 2], boxes, 0.3, 5, grid, watch));
            assert_eq!(marked, Some(sparse(&drawing, [0.0; 2], boxes, 0.3, 5, watch)));
        }
    }
}
