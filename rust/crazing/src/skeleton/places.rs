//! Sites and Voronoi vertices to be searched for what a disc holds, where walks from cell to cell are too long.

use super::boxes::Boxes;
use super::circle::Circle;
use super::flood::Cells;
use crate::diagram::curve_order;
use crate::graph::Point;

/// Sites and Voronoi vertices, boxed.
pub(super) struct Places {
    /// Vertices among the sites, and those far from all of them: these would spoil the boxes of the others.
    near: Boxes,
    far: Boxes,
    sites: Boxes,
}

impl Places {
    /// For many questions the points are put in an order of their own: along a curve, vertices of neighbouring
    /// triangles lie on both sides of it, far apart.
    pub(super) fn of(cells: &Cells<'_>, many: bool) -> Self {
        let [low, high] = frame(&cells.sites);
        let inside = |v: &Point| (0..2).all(|axis| low[axis] <= v[axis] && v[axis] <= high[axis]);
        let (near, far): (Vec<Point>, Vec<Point>) = cells.vertices.iter().partition(|&v| inside(v));
        let boxes = |points: Vec<Point>| {
            if !many {
                return Boxes::new(points);
            }
            let mut sorted: Vec<Point> = curve_order(&points).into_iter().map(|row| points[row as usize]).collect();
            // About the centre of an arc, one vertex is that of very many triangles.
            sorted.dedup();
            Boxes::new(sorted)
        };
        Self { near: boxes(near), far: boxes(far), sites: boxes(cells.sites.to_vec()) }
    }

    pub(super) fn find(&self, circle: &Circle<'_>) -> Option<Point> {
        [&self.near, &self.far, &self.sites].into_iter().find_map(|boxes| boxes.find(circle))
    }
}

/// The bounding box of the sites, grown by half its size.
fn frame(sites: &[Point]) -> [Point; 2] {
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for p in sites {
        low = [low[0].min(p[0]), low[1].min(p[1])];
        high = [high[0].max(p[0]), high[1].max(p[1])];
    }
    let margin = 0.5 * (high[0] - low[0]).max(high[1] - low[1]);
    [low.map(|x| x - margin), high.map(|x| x + margin)]
}
