//! What lies in and around a window.

use super::Pattern;
use super::bins::{self, Bins};
use super::grid::{Grid, UNIT, Window};
use super::nearest::Set;
use super::piece::{self, Piece};
use crate::error::Result;
use crate::watch::Watch;

/// Levels of ever wider surroundings: the last holds all that can be placed at all.
pub(super) const LEVELS: usize = 11;

/// The pieces in a region, before they are sorted into bins.
#[derive(Debug)]
pub(super) struct Cut {
    pub(super) pieces: Vec<Piece>,
    region: [i64; 4],
    /// Where one of the bins begins.
    corner: [i64; 2],
    /// Whether nothing lies outside, or nothing that is nearer than what lies inside.
    pub(super) whole: bool,
}

/// The pieces in and around a window: on level 0 as far as the next cracks should be, on each other 8 times as far.
pub(super) fn cut(pattern: &Pattern<'_>, grid: &Grid, window: Window, level: u32, watch: Watch<'_>) -> Result<Cut> {
    let [left, top] = [window.left, window.top].map(|pixel| pixel * UNIT);
    let (right, bottom) = (left + window.width as i64 * UNIT, top + window.height as i64 * UNIT);
    let area = window.width as f64 * window.height as f64;
    let spacing = (area / pattern.edges.len().max(1) as f64).sqrt();
    let mut margin = ((4.0 * spacing).clamp(64.0, 1024.0) as i64 * UNIT) << (3 * level);
    // On a torus some image of every edge is nearer to any place than this.
    let enough = 2 * (grid.period[0] + grid.period[1]) * UNIT;
    if enough > 0 {
        margin = margin.min(enough);
    }
    let region = [left - margin, top - margin, right + margin, bottom + margin];
    let (pieces, all) = piece::pieces(pattern, grid, region, watch)?;
    let whole = all || (enough > 0 && margin == enough) || level as usize == LEVELS;
    Ok(Cut { pieces, region, corner: [left, top], whole })
}

/// The same, sorted into bins.
pub(super) fn around(pattern: &Pattern<'_>, grid: &Grid, window: Window, level: u32) -> Result<Set> {
    let cut = cut(pattern, grid, window, level, Watch::default())?;
    Ok(Set { bins: cut.bins(true)?, pieces: cut.pieces, whole: cut.whole })
}

impl Cut {
    /// Bins of the pieces; empty ones where they are not to be searched.
    pub(super) fn bins(&self, searched: bool) -> Result<Bins> {
        let Self { pieces, region, corner, .. } = self;
        let widest = pieces
            .iter()
            .fold(0.0_f32, |widest, piece| widest.max(piece.radius.max(piece.radius + piece.slope * piece.length)));
        let area = (region[2] - region[0]) as f64 / UNIT as f64 * ((region[3] - region[1]) as f64 / UNIT as f64);
        let listed = if searched { &pieces[..] } else { &[] };
        let side = bins::side(listed.len(), area, widest);
        let step = side * UNIT;
        let low = |axis: usize| corner[axis] + (region[axis] - corner[axis]).div_euclid(step) * step;
        let high = |axis: usize| corner[axis] + ((region[axis + 2] - corner[axis]).div_euclid(step) + 1) * step;
        Bins::new(listed, [low(0), low(1), high(0), high(1)], side)
    }
}
