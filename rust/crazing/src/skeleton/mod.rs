//! Curves and skeletons of point samples, one method a file.

mod boxes;
mod branches;
mod bumps;
mod cost;
mod curve;
mod disc;
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
mod poles;
mod rings;
mod second;
mod spacing;
mod tree;

pub use branches::{Measure, branches};
pub use curve::curve;
pub use gabriel::gabriel;
pub use local::{Local, edge_filter, two_pass};
pub use longest::longest;
pub use nearest::nearest;
pub use one_step::one_step;
pub use peel::peeled;
pub use poles::{Variant, poles, poles_axis};
pub use rings::Rings;
pub use second::{Second, second};

use crate::diagram::{DiagramView, shared};

/// Dual edges of the rows in `mask` that join two different finite vertices, coincident vertices represented by the
/// lowest triangle.
pub fn axis_edges(view: DiagramView<'_>, mask: &[bool]) -> Vec<[i32; 2]> {
    let kept = view.dual_edges.iter().zip(mask).filter(|(dual, kept)| **kept && !dual.contains(&-1));
    let kept = kept.map(|(dual, _)| *dual);
    match shared(view) {
        None => kept.collect(),
        Some(lowest) => kept.map(|dual| dual.map(|t| lowest[t as usize])).filter(|[a, b]| a != b).collect(),
    }
}
