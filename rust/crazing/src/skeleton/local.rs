//! Two-pass crust and edge filter without the second triangulation.
//!
//! An edge of the Delaunay triangulation of sites and Voronoi vertices is one with a circle through its ends that holds
//! none of them: a question about one pencil of circles, independent of all others. Nearly always the smallest circle
//! answers it with one look at the neighbourhood; only otherwise the interval of circles is narrowed, point by point.

use super::boxes::Boxes;
use super::disc::Disc;
use super::flood::{Cells, Found};
use super::one_step::{one_step, opposite};
use super::pencil::Pencil;
use crate::diagram::{DiagramView, curve_order, representatives};
use crate::error::Result;
use crate::graph::Point;
use crate::parallel;

/// Cuts before a pencil is judged by what is left: each at least halves the interval, so that nothing but a tie is.
const CUTS: usize = 64;
/// Cells that a walk may enter, for all edges and for few.
const NEAR: usize = 24;
const WIDE: usize = 512;

/// Masks over the edges of a diagram.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Local {
    /// Two-pass crust.
    pub crust: Vec<bool>,
    /// Edge-filtered axis.
    pub axis: Vec<bool>,
}

/// Whether each edge is in the two-pass crust.
///
/// Decided for the rounded Voronoi vertices; coincident ones are one, and a tie (an interval of circles shorter than
/// 1e-9 half lengths of the edge) counts as crust. A subset of the one-step crust, whose test is exact.
///
/// # Errors
/// [`crate::Error::TooFewSites`] or [`crate::Error::Collinear`].
///
/// # Source
/// Amenta, Bern, Eppstein: The Crust and the Beta-Skeleton (1998); thesis, section 4.1.
pub fn two_pass(view: DiagramView<'_>) -> Result<Vec<bool>> {
    let one_step = one_step(view)?;
    let cells = Cells::of(view);
    Ok(decide(&cells, one_step.len(), |k| if one_step[k] { Some(Edge::crust(&cells, k)) } else { None }))
}

/// Two-pass crust and edge-filtered axis at once.
///
/// A dual edge is kept when some circle through its two ends holds no site and no Voronoi vertex; ties as in
/// [`two_pass`]. A subset of the one-step axis. Edges without length or to infinity are never kept.
///
/// # Errors
/// [`crate::Error::TooFewSites`] or [`crate::Error::Collinear`].
///
/// # Source
/// Thesis, section 5.2.
pub fn edge_filter(view: DiagramView<'_>) -> Result<Local> {
    let one_step = one_step(view)?;
    let cells = Cells::of(view);
    let edge = |k: usize| if one_step[k] { Some(Edge::crust(&cells, k)) } else { Edge::axis(&cells, k) };
    let kept = decide(&cells, one_step.len(), edge);
    let (crust, axis) = kept.iter().zip(&one_step).map(|(&kept, &one)| (kept & one, kept & !one)).unzip();
    Ok(Local { crust, axis })
}

/// An edge that is in the one-step crust, or a dual edge that is not.
struct Edge {
    k: usize,
    ends: [Point; 2],
    /// The ends of the other one, twice the same where it has one end only.
    across: [Point; 2],
    is_crust: bool,
}

impl Edge {
    fn crust(cells: &Cells<'_>, k: usize) -> Self {
        let dual = cells.view.dual_edges[k];
        let across = dual.map(|t| cells.vertices[if t == -1 { dual[0].max(dual[1]) } else { t } as usize]);
        Self { k, ends: cells.view.edges[k].map(|site| cells.sites[site as usize]), across, is_crust: true }
    }

    /// None without two different ends.
    fn axis(cells: &Cells<'_>, k: usize) -> Option<Self> {
        let dual = cells.view.dual_edges[k];
        if dual.contains(&-1) {
            return None;
        }
        let ends = dual.map(|t| cells.vertices[t as usize]);
        let across = cells.view.edges[k].map(|site| cells.sites[site as usize]);
        (ends[0] != ends[1]).then_some(Self { k, ends, across, is_crust: false })
    }

    /// Whether the smallest of all circles through the ends is empty; None when that is too much to look at.
    ///
    /// Both cells of the edge meet every circle of either pencil: the dual edge is a chord of it, or goes through its
    /// centre. No site can be in the circle of a crust edge: its angles to both opposite corners are acute.
    #[inline]
    fn is_plain(&self, cells: &Cells<'_>) -> Option<bool> {
        let pencil = Pencil::new(self.ends[0], self.ends[1]);
        let inside = |v: Point| pencil.holds(0.0, v);
        if self.across.into_iter().any(inside) {
            return Some(false);
        }
        match cells.find::<NEAR>(self.k, pencil.disc(0.0), inside) {
            Found::Nothing => Some(true),
            Found::Inside(_) => Some(false),
            Found::TooMany => None,
        }
    }

    /// The circles that are left by what is next to the edge. Of a crust edge these are the ones between the
    /// circumcircles of its triangles, and so empty of sites.
    fn pencil(&self, cells: &Cells<'_>) -> Pencil {
        let mut pencil = Pencil::new(self.ends[0], self.ends[1]);
        self.across.into_iter().for_each(|v| pencil.cut(v));
        if self.is_crust {
            let [p, q] = cells.view.edges[self.k];
            for t in cells.view.dual_edges[self.k].into_iter().filter(|&t| t != -1) {
                pencil.cut(cells.sites[opposite(cells.view.triangles[t as usize], p, q) as usize]);
            }
        }
        pencil
    }

    /// Whether some circle is empty, by walks among at most so many cells; None when they are more.
    #[cold]
    fn walk<const MOST: usize>(&self, cells: &Cells<'_>) -> Option<bool> {
        leaves_some(self.pencil(cells), |disc, inside| match cells.find::<MOST>(self.k, disc, inside) {
            Found::Nothing => Some(None),
            Found::Inside(v) => Some(Some(v)),
            Found::TooMany => None,
        })
    }
}

/// Whether the pencil of each row, where it has an edge, leaves a circle: by the smallest, by walks, by long walks as
/// long as these are few, and by search.
fn decide(cells: &Cells<'_>, rows: usize, edge: impl Fn(usize) -> Option<Edge> + Sync) -> Vec<bool> {
    let walked = parallel::map(rows, |k| {
        let Some(edge) = edge(k) else { return Some(false) };
        if edge.is_plain(cells)? { Some(true) } else { edge.walk::<NEAR>(cells) }
    });
    let mut hard: Vec<usize> = (0..rows).filter(|&k| walked[k].is_none()).collect();
    let mut decided: Vec<bool> = walked.into_iter().map(|found| found == Some(true)).collect();
    if hard.len() * WIDE <= rows {
        hard.retain(|&k| {
            let found = edge(k).map_or(Some(false), |edge| edge.walk::<WIDE>(cells));
            decided[k] = found == Some(true);
            found.is_none()
        });
    }
    if !hard.is_empty() {
        let places = Places::of(cells);
        let searched = parallel::map(hard.len(), |i| {
            let pencil = edge(hard[i])?.pencil(cells);
            leaves_some(pencil, |disc, inside| Some(places.find(disc, inside)))
        });
        for (k, found) in hard.into_iter().zip(searched) {
            decided[k] = found == Some(true);
        }
    }
    decided
}

/// Cuts a pencil by the points that `find` finds in its circles until one is empty or none is left. `find` gives None
/// when it cannot tell.
fn leaves_some(
    mut pencil: Pencil,
    find: impl Fn(Disc, &dyn Fn(Point) -> bool) -> Option<Option<Point>>,
) -> Option<bool> {
    for _ in 0..CUTS {
        if pencil.is_empty() {
            return Some(false);
        }
        let tau = pencil.choose();
        match find(pencil.disc(tau), &|v| pencil.holds(tau, v))? {
            None => return Some(true),
            Some(v) => pencil.cut(v),
        }
    }
    Some(!pencil.is_empty())
}

/// Sites and distinct Voronoi vertices, boxed.
struct Places {
    /// Vertices among the sites, and those far from all of them: these would spoil the boxes of the others.
    near: Boxes,
    far: Boxes,
    sites: Boxes,
}

impl Places {
    fn of(cells: &Cells<'_>) -> Self {
        let [low, high] = frame(&cells.sites);
        let representative = representatives(cells.view);
        let distinct = (0..cells.vertices.len()).filter(|&t| representative[t] as usize == t);
        let inside = |v: &Point| (0..2).all(|axis| low[axis] <= v[axis] && v[axis] <= high[axis]);
        let (near, far): (Vec<Point>, Vec<Point>) = distinct.map(|t| cells.vertices[t]).partition(inside);
        // In an order of their own: along a curve, vertices of neighbouring triangles lie on both sides of it, far apart.
        let boxes =
            |points: &[Point]| Boxes::new(curve_order(points).into_iter().map(|row| points[row as usize]).collect());
        Self { near: boxes(&near), far: boxes(&far), sites: boxes(&cells.sites) }
    }

    fn find(&self, disc: Disc, wanted: &dyn Fn(Point) -> bool) -> Option<Point> {
        [&self.near, &self.far, &self.sites].into_iter().find_map(|boxes| boxes.find(disc, wanted))
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
