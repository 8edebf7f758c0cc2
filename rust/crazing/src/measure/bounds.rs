//! Which vertices lie where the drawing was cut: what is seen there is no node.

use super::network::Drawing;
use crate::graph::Point;

/// A cut end is clipped onto the bounds up to rounding, this part of their size.
const ROUNDING: f64 = 1e-9;

/// For every vertex, whether it lies within `border` of the bounds.
pub(super) fn on_border(drawing: &Drawing<'_>, border: f64) -> Vec<bool> {
    let Some([xmin, ymin, xmax, ymax]) = drawing.bounds else { return vec![false; drawing.vertices.len()] };
    let near = border.max(ROUNDING * (xmax - xmin).max(ymax - ymin));
    let depth = |&[x, y]: &Point| (x - xmin).min(xmax - x).min(y - ymin).min(ymax - y);
    drawing.vertices.iter().map(|p| depth(p) <= near).collect()
}
