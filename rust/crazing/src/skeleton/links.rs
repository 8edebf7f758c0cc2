//! Triangles linked across their sides: all that a walk needs to know of a diagram.

use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

use crate::diagram::DiagramView;
use crate::parallel;

/// No triangle across: the outside.
pub(super) const NONE: u32 = u32::MAX;

/// For every side of every triangle the same side as seen from across, or the largest number. Side `3 t + j` runs from
/// corner `j` of triangle `t` to the next one, counter-clockwise; there are fewer than 2^32 of them.
///
/// Several methods walk along these links; whoever calls more than one of them makes them once.
pub fn links(view: DiagramView<'_>) -> Vec<u32> {
    // Each is written once, by whoever comes to its edge: in any order, the table is the same.
    let across = parallel::map(3 * view.triangles.len(), |_| AtomicU32::new(NONE));
    parallel::each(view.edges.len(), |k| {
        let ([from, to], [right, left]) = (view.edges[k], view.dual_edges[k]);
        if let (Some(there), Some(back)) = (side(view, left, from), side(view, right, to)) {
            across[there as usize].store(back, Relaxed);
            across[back as usize].store(there, Relaxed);
        }
    });
    across.into_iter().map(AtomicU32::into_inner).collect()
}

/// The side of a triangle that begins at a corner; None for the outside, and for a triangle without that corner.
#[inline]
pub(super) fn side(view: DiagramView<'_>, triangle: i32, corner: i32) -> Option<u32> {
    let corners = view.triangles.get(triangle as usize)?;
    // Which one it is cannot be foretold: no branches.
    let j = usize::from(corners[1] == corner) + 2 * usize::from((corners[2] == corner) & (corners[1] != corner));
    (corners[j] == corner).then_some(3 * triangle as u32 + j as u32)
}

/// The next side of the same triangle, counter-clockwise.
#[inline]
pub(super) fn after(side: u32) -> u32 {
    if side % 3 == 2 { side - 2 } else { side + 1 }
}

/// The side before.
#[inline]
pub(super) fn before(side: u32) -> u32 {
    if side.is_multiple_of(3) { side + 2 } else { side - 1 }
}
