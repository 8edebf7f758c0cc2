//! Curves and skeletons of point samples, one method a file.

mod beliefs;
mod boxes;
mod branches;
mod bumps;
mod candidates;
mod cost;
mod curve;
mod disc;
mod doors;
mod far;
mod flood;
mod gabriel;
mod gaps;
mod links;
mod local;
mod longest;
mod nearest;
mod one_step;
mod peel;
mod pencil;
mod places;
mod poles;
mod rings;
mod second;
mod spacing;
mod tree;

pub use branches::{Measure, branches};
pub use curve::{curve, curve_edges};
pub use gabriel::gabriel;
pub use local::{Local, edge_filter, edge_filter_among, filtered_among, two_pass, two_pass_among};
pub use longest::longest;
pub use nearest::nearest;
pub use one_step::one_step;
pub use peel::peeled;
pub use poles::{Variant, poles, poles_axis};
pub use rings::Rings;
pub use second::{Second, second};

use crate::diagram::{DiagramView, lowest_of, shares};
use crate::parallel;

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
