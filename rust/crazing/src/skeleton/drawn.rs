//! The edges of a crust and of an axis, read off the table of edges.

use super::one_step::{Tally, judged};
use crate::diagram::{DiagramView, lowest_of, shares};
use crate::error::Result;
use crate::parallel;

/// The one-step crust, and what is drawn of it and of its axis.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct OneStep {
    /// Whether each edge is crust.
    pub mask: Vec<bool>,
    /// The edges that are.
    pub crust: Vec<[i32; 2]>,
    /// The dual edges of the others, as [`axis_edges`] gives them.
    pub axis: Vec<[i32; 2]>,
}

/// [`one_step`](super::one_step) with the edges of crust and axis: what is to be drawn is counted on the way.
///
/// # Errors
/// As there.
pub fn one_step_drawn(view: DiagramView<'_>) -> Result<OneStep> {
    let (mask, tallies) = judged(view)?;
    let pairs: Vec<[i32; 2]> = tallies.iter().flat_map(|tally| &tally.short).copied().collect();
    let lowest = (!pairs.is_empty()).then(|| lowest_of(view.vertices.len(), &pairs));
    let (crust, axis) = match &lowest {
        None => parted(view, &mask, &tallies, |dual| dual),
        Some(lowest) => parted(view, &mask, &tallies, |dual| dual.map(|t| lowest.get(t as usize).map_or(-1, |&t| t))),
    };
    Ok(OneStep { mask, crust, axis })
}

type Rows = Vec<[i32; 2]>;

/// The edges in the mask and the dual edges of the others, by representatives.
fn parted(
    view: DiagramView<'_>,
    mask: &[bool],
    tallies: &[Tally],
    represented: impl Fn([i32; 2]) -> [i32; 2] + Sync + Send,
) -> (Rows, Rows) {
    let count = |of: fn(&Tally) -> usize| tallies.iter().map(of).sum::<usize>();
    let (mut crust, mut axis) = (vec![[0; 2]; count(|tally| tally.crust)], vec![[0; 2]; count(|tally| tally.axis)]);
    let crusts = parallel::shared(&mut crust, tallies.iter().map(|tally| tally.crust));
    let axes = parallel::shared(&mut axis, tallies.iter().map(|tally| tally.axis));
    // Where every dual edge can be drawn, none has to be looked at.
    let none_is_short = tallies.iter().all(|tally| tally.short.is_empty());
    let parts = parallel::all_ranges(mask.len()).zip(tallies).zip(crusts.zip(axes)).collect();
    parallel::parts(mask.len(), parts, |((range, tally), (crust, axis))| {
        let mut next = [0; 2];
        if none_is_short && tally.not_drawn == 0 {
            for ((&is_crust, &edge), &dual) in
                mask[range.clone()].iter().zip(&view.edges[range.clone()]).zip(&view.dual_edges[range])
            {
                put(crust, &mut next[0], edge, is_crust);
                put(axis, &mut next[1], dual, !is_crust);
            }
            return;
        }
        for k in range {
            let (is_crust, dual) = (mask[k], represented(view.dual_edges[k]));
            let is_axis = !is_crust & (dual[0] != -1) & (dual[1] != -1) & (dual[0] != dual[1]);
            put(crust, &mut next[0], view.edges[k], is_crust);
            put(axis, &mut next[1], dual, is_axis);
        }
    });
    (crust, axis)
}

/// Writes a row, and the next over it where it is none: which ones are cannot be foretold.
#[inline]
fn put(rows: &mut [[i32; 2]], next: &mut usize, row: [i32; 2], is_one: bool) {
    if let Some(slot) = rows.get_mut(*next) {
        *slot = row;
    }
    *next += usize::from(is_one);
}

/// Dual edges of the rows in `mask` that join two different finite vertices, coincident vertices represented by the
/// lowest triangle.
pub fn axis_edges(view: DiagramView<'_>, mask: &[bool]) -> Vec<[i32; 2]> {
    let rows = mask.len().min(view.dual_edges.len());
    let kept = |k: usize| Some(view.dual_edges[k]).filter(|dual| mask[k] & (dual[0] != -1) & (dual[1] != -1));
    // How many there are, and which vertices coincide, at once.
    let found = parallel::ranges(rows, |range| {
        let pairs = range.clone().filter(|&k| shares(view, k)).map(|k| view.dual_edges[k]).collect::<Vec<_>>();
        (range.filter(|&k| kept(k).is_some()).count(), pairs)
    });
    let (counts, pairs): (Vec<usize>, Vec<_>) = found.into_iter().unzip();
    if pairs.iter().all(Vec::is_empty) {
        return parallel::compact_counted(rows, &counts, kept);
    }
    let lowest = lowest_of(view.vertices.len(), &pairs.concat());
    parallel::compact(rows, |k| {
        let ends = kept(k)?.map(|t| lowest[t as usize]);
        (ends[0] != ends[1]).then_some(ends)
    })
}
