//! Triangles linked across their sides: all that a walk needs to know of a diagram.

use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

use crate::diagram::DiagramView;
use crate::parallel;

/// No triangle across: the outside.
pub(super) const NONE: u32 = u32::MAX;

/// For every side of every triangle the same side as seen from across. Side `3 t + j` runs from corner `j` of triangle
/// `t` to the next one, counter-clockwise; there are fewer than 2^32 of them.
pub(super) struct Links {
    /// Each is written once, by whoever comes to its edge: in any order, the table is the same.
    across: Vec<AtomicU32>,
}

impl Links {
    pub(super) fn of(view: DiagramView<'_>) -> Self {
        let across = parallel::map(3 * view.triangles.len(), |_| AtomicU32::new(NONE));
        parallel::each(view.edges.len(), |k| {
            let ([from, to], [right, left]) = (view.edges[k], view.dual_edges[k]);
            if let (Some(there), Some(back)) = (side(view, left, from), side(view, right, to)) {
                across[there as usize].store(back, Relaxed);
                across[back as usize].store(there, Relaxed);
            }
        });
        Self { across }
    }

    /// The side across, or [`NONE`].
    #[inline]
    pub(super) fn across(&self, side: u32) -> u32 {
        self.across[side as usize].load(Relaxed)
    }
}

/// The side of a triangle that begins at a corner; None for the outside, and for a triangle without that corner.
#[inline]
pub(super) fn side(view: DiagramView<'_>, triangle: i32, corner: i32) -> Option<u32> {
    let corners = view.triangles.get(usize::try_from(triangle).ok()?)?;
    let j = corners.iter().position(|&c| c == corner)?;
    Some(3 * triangle as u32 + j as u32)
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
