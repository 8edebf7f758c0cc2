//! How much crack there is: what the lengths of a material are parts of.

use super::Pattern;
use crate::error::Result;
use crate::graph::Point;
use crate::parallel;

/// The part of all ends that are no wider than the width that stands for the widest ones.
const WIDE: f64 = 0.95;

/// Length and width of a pattern, data units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extent {
    /// All edges together.
    pub length: f64,
    /// The width that one end in twenty exceeds, between neighbouring ones in proportion; 0 without edges.
    pub widest: f64,
}

/// Measures a pattern; `period` as for its shifts.
///
/// # Errors
/// [`crate::Error::BadIndex`] or [`crate::Error::BadLength`] for arrays that do not fit.
pub fn extent(pattern: &Pattern<'_>, period: Option<Point>) -> Result<Extent> {
    pattern.check()?;
    let count = pattern.edges.len();
    let (length, widest) = parallel::join(
        count,
        || parallel::ranges(count, |rows| rows.map(|row| length(pattern, period, row)).sum::<f64>()),
        || wide(pattern.widths.as_flattened()),
    );
    Ok(Extent { length: length.iter().sum(), widest })
}

fn length(pattern: &Pattern<'_>, period: Option<Point>, row: usize) -> f64 {
    let [start, end] = pattern.edges[row].map(|vertex| pattern.vertices[vertex as usize]);
    let shift = pattern.shifts.get(row).copied().unwrap_or_default().map(f64::from);
    let period = period.unwrap_or_default();
    let [x, y] = [0, 1].map(|axis| end[axis] - start[axis] + shift[axis] * period[axis]);
    (x * x + y * y).sqrt()
}

fn wide(widths: &[f64]) -> f64 {
    if widths.is_empty() {
        return 0.0;
    }
    let at = (widths.len() - 1) as f64 * WIDE;
    let (below, part) = (at as usize, at - at.floor());
    // Positive floats lie in the order of their bits: a count by the first of them leaves few to be sorted.
    let key = |width: f64| (width.to_bits() >> 48) as usize;
    let mut counts = vec![0_usize; 1 << 16];
    widths.iter().for_each(|&width| counts[key(width)] += 1);
    let (mut first, mut before) = (0, 0);
    while before + counts[first] <= below {
        before += counts[first];
        first += 1;
    }
    let mut upper: Vec<f64> = widths.iter().copied().filter(|&width| key(width) >= first).collect();
    let (_, &mut low, above) = upper.select_nth_unstable_by_key(below - before, |width| width.to_bits());
    let high = above.iter().copied().min_by_key(|width| width.to_bits()).unwrap_or(low);
    if part < 0.5 { low + (high - low) * part } else { high - (high - low) * (1.0 - part) }
}
