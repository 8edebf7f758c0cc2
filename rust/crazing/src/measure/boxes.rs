//! Box dimension: how the number of boxes that a drawing meets falls as the boxes grow.

use super::network::Drawing;
use crate::graph::Point;
use crate::parallel;

/// Slope of log number over log size, for `levels` sizes from `smallest`, each twice the one before. Boxes stand from
/// the lower left `corner` on; those that do not lie whole within `size` of it are left out.
///
/// # Source
/// Falconer: Fractal Geometry, section 3.1.
pub(super) fn dimension(drawing: &Drawing<'_>, corner: Point, size: Point, smallest: f64, levels: usize) -> f64 {
    let mut keys = Vec::new();
    for k in 0..drawing.edges.len() {
        let from = drawing.vertices[drawing.edges[k][0] as usize];
        let way = drawing.step(2 * k as u32);
        crossed([0, 1].map(|i| (from[i] - corner[i]) / smallest), way.map(|x| x / smallest), &mut keys);
    }
    let mut counts = Vec::new();
    for level in 0..levels {
        parallel::sort(&mut keys);
        keys.dedup();
        let side = smallest * f64::from(1_u32 << level);
        let whole = |&&key: &&u64| (0..2).all(|i| (place(key, level)[i] + 1) as f64 * side <= size[i]);
        counts.push(keys.iter().filter(whole).count() as f64);
        keys.iter_mut().for_each(|key| *key = halved(*key));
    }
    slope(&counts)
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
fn crossed(from: Point, way: Point, keys: &mut Vec<u64>) {
    let mut at = from.map(|x| x.floor() as i64);
    let end = [0, 1].map(|i| (from[i] + way[i]).floor() as i64);
    let sign = way.map(|x| if x > 0.0 { 1 } else { -1 });
    // Where along the way, from 0 to 1, the next side is met, for both directions.
    let side = |i: usize| if way[i] > 0.0 { from[i].floor() + 1.0 - from[i] } else { from[i].floor() - from[i] };
    let mut meets = [0, 1].map(|i| if way[i] == 0.0 { f64::INFINITY } else { side(i) / way[i] });
    let steps = ((end[0] - at[0]).abs() + (end[1] - at[1]).abs()).min(MOST as i64);
    push(keys, key(at[0], at[1]));
    for _ in 0..steps {
        let i = usize::from(meets[1] < meets[0]);
        at[i] += sign[i];
        meets[i] += 1.0 / way[i].abs();
        push(keys, key(at[0], at[1]));
    }
}

fn push(keys: &mut Vec<u64>, key: u64) {
    if keys.last() != Some(&key) {
        keys.push(key);
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
