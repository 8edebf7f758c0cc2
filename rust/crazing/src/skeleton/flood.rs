//! Points inside a disc, found by walking from Voronoi cell to Voronoi cell.
//!
//! The cells that meet a disc hang together through the Voronoi edges that meet it, and every vertex inside belongs to
//! one of them, so nothing but the diagram itself is needed. Nearly all discs meet two or three cells.

use std::borrow::Cow;

use super::boxes::Disc;
use super::far::near;
use crate::diagram::DiagramView;
use crate::diagram::scale::{Scale, largest};
use crate::graph::Point;
use crate::incidence::Incidence;

/// Cells a walk may enter, and edges it may look at: a cell with very many neighbours, asked about by each of them,
/// would make the whole quadratic.
const MOST_CELLS: usize = 24;
const MOST_EDGES: usize = 160;

/// What a walk found.
pub(super) enum Found {
    Nothing,
    Inside(Point),
    /// It gave up.
    TooMany,
}

/// Sites and Voronoi vertices near 1, and the edges at every site.
pub(super) struct Cells<'a> {
    pub(super) view: DiagramView<'a>,
    pub(super) sites: Cow<'a, [Point]>,
    pub(super) vertices: Cow<'a, [Point]>,
    /// The edges at every site.
    incident: Incidence,
}

impl<'a> Cells<'a> {
    pub(super) fn of(view: DiagramView<'a>) -> Self {
        let scale = Scale::of(largest(view.sites));
        let (sites, vertices) = if scale.is_one() && largest(view.vertices) < 1e30 {
            (Cow::Borrowed(view.sites), Cow::Borrowed(view.vertices))
        } else {
            let close = |&v: &Point| near(scale.down(v));
            (view.sites.iter().map(|&p| scale.down(p)).collect(), view.vertices.iter().map(close).collect())
        };
        let incident = Incidence::of(view.sites.len(), view.edges);
        Self { view, sites, vertices, incident }
    }

    /// The first vertex or site met for which `inside` holds, on a walk through the cells that `disc` meets; the cells
    /// of the two sites of edge `k` must be among them.
    pub(super) fn find(&self, k: usize, disc: Disc, inside: impl Fn(Point) -> bool) -> Found {
        let mut cells = [-1; MOST_CELLS];
        cells[..2].copy_from_slice(&self.view.edges[k]);
        let (mut count, mut next, mut looked) = (2, 0, 0);
        while next < count {
            let cell = cells[next];
            next += 1;
            if inside(self.sites[cell as usize]) {
                return Found::Inside(self.sites[cell as usize]);
            }
            let row = self.incident.at(cell as usize);
            looked += row.len();
            if looked > MOST_EDGES {
                return Found::TooMany;
            }
            for &edge in row {
                let (other, ahead) = self.turn(edge as usize, cell);
                if ahead != -1 && inside(self.vertices[ahead as usize]) {
                    return Found::Inside(self.vertices[ahead as usize]);
                }
                if self.meets(edge as usize, &disc) && !cells[..count].contains(&other) {
                    if count == MOST_CELLS {
                        return Found::TooMany;
                    }
                    cells[count] = other;
                    count += 1;
                }
            }
        }
        Found::Nothing
    }

    /// The cell across an edge, and the triangle on the left of the way there: each triangle once about a cell.
    fn turn(&self, edge: usize, cell: i32) -> (i32, i32) {
        let ([from, to], [right, left]) = (self.view.edges[edge], self.view.dual_edges[edge]);
        if from == cell { (to, left) } else { (from, right) }
    }

    /// Whether the dual edge, a segment or a ray, comes into the disc.
    fn meets(&self, edge: usize, disc: &Disc) -> bool {
        let [right, left] = self.view.dual_edges[edge];
        if right == -1 {
            // Not in a diagram of ours: look rather than miss.
            return true;
        }
        let from = self.vertices[right as usize];
        let step = if left == -1 {
            let [p, q] = self.view.edges[edge].map(|site| self.sites[site as usize]);
            [p[1] - q[1], q[0] - p[0]]
        } else {
            let to = self.vertices[left as usize];
            [to[0] - from[0], to[1] - from[1]]
        };
        let most = if left == -1 { f64::INFINITY } else { 1.0 };
        let (x, y) = (disc.centre[0] - from[0], disc.centre[1] - from[1]);
        let square = step[0] * step[0] + step[1] * step[1];
        let along = ((x * step[0] + y * step[1]) / square.max(f64::MIN_POSITIVE)).clamp(0.0, most);
        let (dx, dy) = (x - along * step[0], y - along * step[1]);
        // Far ends are rounded coarsely; a distance lost altogether is looked at.
        let slack = 1e-9 * (x * x + y * y);
        let distance = dx * dx + dy * dy;
        distance <= disc.square_radius + slack || distance.is_nan()
    }
}
