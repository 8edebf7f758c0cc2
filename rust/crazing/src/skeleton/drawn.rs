//! The edges of a crust and of an axis, read off the table of edges.

use super::one_step::{Tally, judged};
use crate::diagram::{DiagramView, lowest_of, shares};
use crate::error::Result;
use crate::parallel;

/// The one-step crust, and what is to be drawn of it and of its axis.
#[derive(Debug)]
pub struct OneStep {
    mask: Vec<bool>,
    tallies: Vec<Tally>,
}

/// [`one_step`](super::one_step) with what is to be drawn, which is counted on the way.
///
/// # Errors
/// As there.
pub fn one_step_drawn(view: DiagramView<'_>) -> Result<OneStep> {
    let (mask, tallies) = judged(view)?;
    Ok(OneStep { mask, tallies })
}

impl OneStep {
    /// Whether each edge is crust.
    pub fn into_mask(self) -> Vec<bool> {
        self.mask
    }

    /// How many edges are crust, and how many dual edges of the others are drawn.
    pub fn counts(&self) -> [usize; 2] {
        let count = |of: fn(&Tally) -> usize| self.tallies.iter().map(of).sum();
        [count(|tally| tally.crust), count(|tally| tally.axis)]
    }

    /// Writes the edges of the crust, and the dual edges of the others as [`axis_edges`] gives them: so many as
    /// [`counts`](Self::counts) says.
    pub fn draw(&self, view: DiagramView<'_>, crust: &mut [[i32; 2]], axis: &mut [[i32; 2]]) {
        let pairs: Vec<[i32; 2]> = self.tallies.iter().flat_map(|tally| &tally.short).copied().collect();
        if pairs.is_empty() {
            return self.part(view, [crust, axis], |dual| dual);
        }
        let lowest = lowest_of(view.vertices.len(), &pairs);
        self.part(view, [crust, axis], |dual| dual.map(|t| lowest.get(t as usize).map_or(-1, |&t| t)));
    }

    /// The edges in the mask and the dual edges of the others, by representatives.
    fn part(
        &self,
        view: DiagramView<'_>,
        [crust, axis]: [&mut [[i32; 2]]; 2],
        represented: impl Fn([i32; 2]) -> [i32; 2] + Sync + Send,
    ) {
        let (mask, tallies) = (&self.mask, &self.tallies);
        let crusts = parallel::shared(crust, tallies.iter().map(|tally| tally.crust));
        let axes = parallel::shared(axis, tallies.iter().map(|tally| tally.axis));
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
    }
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
