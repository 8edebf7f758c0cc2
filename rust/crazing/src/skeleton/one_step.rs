//! The one-step crust: every edge is crust, or its dual is anti-crust.

use std::ops::Range;

use pulp::Arch;

use super::corners::{Corners, SURE, Slack, TOGETHER};
use crate::diagram::scale::{Scale, largest};
use crate::diagram::{DiagramView, shares};
use crate::error::Result;
use crate::graph::Point;
use crate::parallel;
use crate::predicates::{apex_sign, one_step_sign};

/// Whether each edge is crust: some circle through its ends contains neither end of its dual.
///
/// An edge of the hull is crust when the angle opposite it is acute. Signs are exact; a tie is crust, but for the
/// hull, where the circle would have to be a line.
///
/// # Errors
/// [`crate::Error::TooFewSites`] or [`crate::Error::Collinear`].
///
/// # Source
/// Gold, Snoeyink: A One-Step Crust and Skeleton Extraction Algorithm (2001); thesis, section 5.3.
pub fn one_step(view: DiagramView<'_>) -> Result<Vec<bool>> {
    Ok(judged(view)?.0)
}

/// What there is to draw among some rows.
#[derive(Debug, Default)]
pub(super) struct Tally {
    pub(super) crust: usize,
    /// Dual edges of the others that are finite and have a length.
    pub(super) axis: usize,
    /// Dual edges of the others that have none of the two.
    pub(super) not_drawn: usize,
    /// Dual edges without length, of all rows.
    pub(super) short: Vec<[i32; 2]>,
    /// Rows whose sign is sure only if no vertex was moved to another's place.
    doubtful: Vec<usize>,
    /// Whether an index of an edge or a dual edge points nowhere: then the rest means nothing.
    is_astray: bool,
}

/// The mask of [`one_step`], and what there is to draw in each of the [`ranges`](parallel::ranges) of rows.
pub(super) fn judged(view: DiagramView<'_>) -> Result<(Vec<bool>, Vec<Tally>)> {
    view.check_lengths()?;
    view.check_triangle()?;
    let largest = largest(view.sites);
    let judge = Judge { view, scaled: &Scale::of(largest).all_down(view.sites), slack: Slack::of(view, largest) };
    let (mut mask, arch) = (vec![false; view.edges.len()], Arch::new());
    let mut tallies = parallel::fill(&mut mask, |rows, mask| arch.dispatch(|| judge.judge(rows, mask)));
    if tallies.iter().any(|tally| tally.is_astray) {
        // Which one it is.
        view.check()?;
    }
    if !tallies.iter().all(|tally| tally.short.is_empty()) {
        judge.settle(&mut mask, &mut tallies);
    }
    Ok((mask, tallies))
}

/// Signs that are looked through at once.
const CHUNK: usize = 16;

struct Judge<'a> {
    view: DiagramView<'a>,
    /// The sites near 1, for exact signs.
    scaled: &'a [Point],
    slack: Slack,
}

impl Judge<'_> {
    /// Decides a range of rows.
    #[inline(always)]
    fn judge(&self, rows: Range<usize>, mask: &mut [bool]) -> Tally {
        let (mut tally, mut corners) = (Tally::default(), Corners::new());
        corners.gather(self.view, rows.start..rows.start, rows.start..rows.end.min(rows.start + TOGETHER));
        for (i, mask) in mask.chunks_mut(TOGETHER).enumerate() {
            self.decide(rows.start + i * TOGETHER, rows.end, mask, &mut corners, &mut tally);
        }
        tally
    }

    /// Decides some rows and tallies them; those after them, up to `end`, come next.
    #[inline(always)]
    fn decide(&self, first: usize, end: usize, mask: &mut [bool], corners: &mut Corners, tally: &mut Tally) {
        let rows = first..first + mask.len();
        let next = rows.end..end.min(rows.end + TOGETHER);
        corners.gather(self.view, rows.clone(), next);
        if !self.view.fits(rows.clone()) {
            tally.is_astray = true;
            return;
        }
        let is_short = corners.sign(self.slack);
        mask.iter_mut().zip(&corners.signs).for_each(|(kept, &sign)| *kept = sign < 0);
        let mut not_drawn = 0;
        for (i, signs) in corners.signs[..mask.len()].chunks(CHUNK).enumerate() {
            // Few are not sure: their chunk is found at once.
            if signs.iter().fold(false, |open, &sign| open | (sign.unsigned_abs() < SURE)) {
                for i in (CHUNK * i..mask.len()).take(CHUNK) {
                    match corners.signs[i] {
                        0 => {
                            mask[i] = self.is_crust(first + i);
                            not_drawn += usize::from(!mask[i] & self.view.dual_edges[first + i].contains(&-1));
                        }
                        -1 | 1 => tally.doubtful.push(first + i),
                        _ => {}
                    }
                }
            }
        }
        if is_short {
            for k in rows.clone().filter(|&k| shares(self.view, k)) {
                not_drawn += usize::from(!mask[k - first]);
                tally.short.push(self.view.dual_edges[k]);
            }
        }
        let crust = mask.iter().map(|&kept| u32::from(kept)).sum::<u32>() as usize;
        tally.crust += crust;
        tally.axis += rows.len() - crust - not_drawn;
        tally.not_drawn += not_drawn;
    }

    /// Decides again what may be wrong where vertices were moved.
    fn settle(&self, mask: &mut [bool], tallies: &mut [Tally]) {
        let len = mask.len();
        let masks = parallel::shared(mask, parallel::all_ranges(len).map(|rows| rows.len()));
        let parts = parallel::all_ranges(len).zip(masks.zip(tallies)).collect();
        parallel::parts(len, parts, |(rows, (mask, tally))| {
            for k in std::mem::take(&mut tally.doubtful) {
                let (was, is) = (mask[k - rows.start], self.is_crust(k));
                mask[k - rows.start] = is;
                // Their dual edges have a length.
                tally.crust = tally.crust + usize::from(is) - usize::from(was);
                tally.axis = tally.axis + usize::from(was) - usize::from(is);
            }
        });
    }

    #[cold]
    fn is_crust(&self, k: usize) -> bool {
        let (view, ends) = (self.view, self.view.edges[k]);
        let [p, q] = ends.map(|site| self.scaled[site as usize]);
        // Arrays of others may leave no site at all.
        let apex = |triangle| self.scaled.get(apex(view, ends, triangle) as usize).copied().unwrap_or(p);
        match view.dual_edges[k] {
            [-1, -1] => false,
            [t, -1] | [-1, t] => apex_sign(p, q, apex(t)) > 0.0,
            [right, left] => one_step_sign(p, q, apex(right), apex(left)) >= 0.0,
        }
    }
}

/// What is left of a triangle's corners when the two ends are taken out.
#[inline]
fn apex(view: DiagramView<'_>, ends: [i32; 2], triangle: i32) -> i32 {
    let [a, b, c] = view.triangles.get(triangle as usize).copied().unwrap_or_default();
    a ^ b ^ c ^ ends[0] ^ ends[1]
}

/// The corner that is neither `p` nor `q`.
#[inline]
pub(super) fn opposite(corners: [i32; 3], p: i32, q: i32) -> i32 {
    let other = |c: i32| c != p && c != q;
    if other(corners[0]) {
        corners[0]
    } else if other(corners[1]) {
        corners[1]
    } else {
        corners[2]
    }
}
