//! What lies in and around a window.

use super::bands::Bands;
use super::bins::{self, Bins};
use super::cut::pieces;
use super::grid::{Grid, UNIT, Window};
use super::nearest::Set;
use super::piece::Piece;
use super::{BAND, Pattern};
use crate::crew;
use crate::error::{Error, Result};
use crate::watch::Watch;

/// Levels of ever wider surroundings: the last holds all that can be placed at all.
pub(super) const LEVELS: usize = 11;

/// Edges that are cut at a time.
const AT_ONCE: usize = 1 << 14;

/// The pieces in a region, before they are sorted into bins.
#[derive(Debug)]
pub(super) struct Cut {
    /// In the order of the edges, in parts that are the same for any number of threads.
    pub(super) parts: Vec<Vec<Piece>>,
    /// What covers the rows of the window, where that is wanted; one a part.
    pub(super) bands: Vec<Bands>,
    region: [i64; 4],
    /// Where one of the bins begins.
    corner: [i64; 2],
    /// Whether nothing lies outside, or nothing that is nearer than what lies inside.
    whole: bool,
}

/// What is to be cut.
#[derive(Clone, Copy)]
pub(super) struct Wanted<'a> {
    pub(super) pattern: Pattern<'a>,
    pub(super) grid: Grid,
    pub(super) window: Window,
    /// How far around the window: on level 0 as far as the next cracks should be, on each other 8 times as far.
    pub(super) level: u32,
    /// Whether to sort the pieces by rows.
    pub(super) bands: bool,
}

/// The pieces of some edges, whether these are all, and what they cover.
type Share = (Vec<Piece>, bool, Option<Bands>);

/// The pieces in and around a window.
pub(super) fn cut(wanted: Wanted<'_>, threads: usize, watch: Watch<'_>) -> Result<Cut> {
    let Wanted { pattern, grid, window, level, bands } = wanted;
    let [left, top] = [window.left, window.top].map(|pixel| pixel * UNIT);
    let (right, bottom) = (left + window.width as i64 * UNIT, top + window.height as i64 * UNIT);
    let area = window.width as f64 * window.height as f64;
    let count = pattern.edges.len();
    let spacing = (area / count.max(1) as f64).sqrt();
    let mut margin = ((4.0 * spacing).clamp(64.0, 1024.0) as i64 * UNIT) << (3 * level);
    // On a torus some image of every edge is nearer to any place than this.
    let enough = 2 * (grid.period[0] + grid.period[1]) * UNIT;
    if enough > 0 {
        margin = margin.min(enough);
    }
    let region = [left - margin, top - margin, right + margin, bottom + margin];
    let mut found: Vec<Option<Share>> = Vec::new();
    found.resize_with(count.div_ceil(AT_ONCE), || None);
    let shares = (0..).step_by(AT_ONCE).map(|first| first..count.min(first + AT_ONCE)).zip(&mut found);
    crew::share(
        shares,
        threads.min(count.div_ceil(AT_ONCE)).max(1),
        watch,
        || Ok(()),
        |(), (rows, found), poll| {
            poll()?;
            let (own, all) = pieces(&pattern, &grid, rows, region)?;
            let bands = bands.then(|| Bands::new(&own, window, BAND)).transpose()?;
            *found = Some((own, all, bands));
            Ok(())
        },
    )?;
    let reaches = (enough > 0 && margin == enough) || level as usize == LEVELS;
    let mut cut = Cut { parts: Vec::new(), bands: Vec::new(), region, corner: [left, top], whole: true };
    for (pieces, all, bands) in found.into_iter().flatten() {
        cut.whole &= all || reaches;
        cut.parts.push(pieces);
        cut.bands.extend(bands);
    }
    Ok(cut)
}

/// The same, sorted into bins.
pub(super) fn around(pattern: &Pattern<'_>, grid: &Grid, window: Window, level: u32) -> Result<Set> {
    let wanted = Wanted { pattern: *pattern, grid: *grid, window, level, bands: false };
    cut(wanted, 1, Watch::default())?.set()
}

impl Cut {
    /// All pieces in bins.
    pub(super) fn set(&mut self) -> Result<Set> {
        let Self { parts, region, corner, whole, .. } = self;
        let pieces = joined(parts)?;
        let widest = pieces
            .iter()
            .fold(0.0_f32, |widest, piece| widest.max(piece.radius.max(piece.radius + piece.slope * piece.length)));
        let area = (region[2] - region[0]) as f64 / UNIT as f64 * ((region[3] - region[1]) as f64 / UNIT as f64);
        let side = bins::side(pieces.len(), area, widest);
        let step = side * UNIT;
        let low = |axis: usize| corner[axis] + (region[axis] - corner[axis]).div_euclid(step) * step;
        let high = |axis: usize| corner[axis] + ((region[axis + 2] - corner[axis]).div_euclid(step) + 1) * step;
        let bins = Bins::new(&pieces, [low(0), low(1), high(0), high(1)], side)?;
        Ok(Set { pieces, bins, whole: *whole, widest })
    }
}

/// All parts in one.
fn joined(parts: &mut Vec<Vec<Piece>>) -> Result<Vec<Piece>> {
    let count: usize = parts.iter().map(Vec::len).sum();
    let mut all = if parts.len() == 1 { parts.pop().unwrap_or_default() } else { Vec::new() };
    let bytes = (count - all.len()) as u128 * size_of::<Piece>() as u128;
    all.try_reserve_exact(count - all.len()).map_err(|_| Error::OutOfMemory { what: "the edges in pixels", bytes })?;
    parts.drain(..).for_each(|part| all.extend_from_slice(&part));
    Ok(all)
}
