//! Dual edges that bounds surely cut nothing off.

use super::Bounds;
use crate::diagram::DiagramView;
use crate::diagram::scale::largest;
use crate::graph::Point;

/// What lies within the bounds by more than all roundings.
pub(super) struct Inner {
    bounds: Bounds,
    /// Lengths above this are beyond roundings; none is where numbers are too large or small for products.
    sure: f64,
}

impl Inner {
    /// Coordinates and their products are exact to some 1e-15 of the largest: this is far above.
    const SURE: f64 = 1e-9;

    pub(super) fn of(view: DiagramView<'_>, [xmin, ymin, xmax, ymax]: Bounds) -> Self {
        let size = largest(view.sites).max(largest(&[[xmin, ymin], [xmax, ymax]]));
        let sure = if (1e-100..1e100).contains(&size) { Self::SURE * size } else { f64::INFINITY };
        Self { bounds: [xmin + sure, ymin + sure, xmax - sure, ymax - sure], sure }
    }

    /// Whether [`super::Bisector::within`] would cut nothing off a dual edge and find a length: its ends lie within, near the
    /// bisector, and apart. No division is needed to be sure of that, which nearly all allow.
    #[inline]
    pub(super) fn holds(&self, view: DiagramView<'_>, k: usize) -> bool {
        let [right, left] = view.dual_edges[k];
        if right == -1 || left == -1 {
            return false;
        }
        let [v, w] = [right, left].map(|triangle| view.vertices[triangle as usize]);
        let [p, q] = view.edges[k].map(|site| view.sites[site as usize]);
        let step = [q[0] - p[0], q[1] - p[1]];
        let size = step[0].abs().max(step[1].abs());
        let [xmin, ymin, xmax, ymax] = self.bounds;
        let within = |[x, y]: Point| (xmin <= x) & (x <= xmax) & (ymin <= y) & (y <= ymax);
        let is_near = |v: Point| {
            let from = [0, 1].map(|i| v[i] - (p[i] + 0.5 * step[i]));
            (from[0] * step[0] + from[1] * step[1]).abs() <= 0.25 * self.sure * size
        };
        let apart = (w[1] - v[1]) * step[0] - (w[0] - v[0]) * step[1];
        within(v) & within(w) & is_near(v) & is_near(w) & (apart > self.sure * size)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::clip::Bisector;
    use crate::diagram::diagram;
    use crate::diagram::scale::Scale;
    use crate::graph::Point;
    use crate::sample::uniform;
    use crate::watch::Watch;

    #[test]
    fn of_what_is_held_the_bisector_cuts_nothing() {
        let random = uniform(4000, [0.0, 0.0, 1.0, 1.0], [3, 1], Watch::default()).unwrap_or_default();
        // Edges across the squares of a grid have lengths down to roundings.
        let near = |i: usize, size: f64| [0, 1].map(|k| [i % 60, i / 60][k] as f64 / 60.0 + size * random[i][k]);
        let grids = [1e-6, 1e-9, 1e-12, 1e-15].map(|size| (0..3600).map(|i| near(i, size)).collect::<Vec<_>>());
        for points in grids.iter().chain([&random]) {
            for unit in [1.0, 3e-7, 2e90, 1e-140, 1e140] {
                let points: Vec<Point> = points.iter().map(|p| p.map(|x| unit * (x - 0.3))).collect();
                let diagram = diagram(&points, Watch::default()).unwrap_or_default();
                let (view, bounds) = (diagram.view(), [-0.2, -0.25, 0.5, 0.6].map(|x| unit * x));
                let (inner, scale) = (Inner::of(view, bounds), Scale::of(largest(view.sites)));
                let [low, high] = [0, 2].map(|i| scale.down([bounds[i], bounds[i + 1]]));
                let held: Vec<usize> = (0..view.edges.len()).filter(|&k| inner.holds(view, k)).collect();
                for &k in &held {
                    let line = Bisector::of(view, k, scale, scale);
                    assert_eq!(line.within(low, high), Some(line.ends));
                }
                assert_eq!(held.len() > view.edges.len() / 3, (1e-100..1e100).contains(&unit));
            }
        }
    }
}
