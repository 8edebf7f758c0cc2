//! Two-pass crust and edge filter without the second triangulation.
//!
//! An edge of the Delaunay triangulation of sites and Voronoi vertices is one with a circle through its ends that holds
//! none of them: a question about one pencil of circles, independent of all others. Nearly always the smallest circle
//! that is allowed answers it with one look at the neighbourhood.

use super::boxes::{Boxes, Disc};
use super::flood::{Cells, Found};
use super::one_step::{one_step, opposite};
use super::pencil::Pencil;
use crate::diagram::{DiagramView, curve_order, representatives};
use crate::error::Result;
use crate::graph::Point;
use crate::parallel;

/// Cuts before a pencil is judged by what is left: each at least halves the interval, so that nothing but a tie is.
const CUTS: usize = 64;

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
    Ok(crust(&Cells::of(view), &one_step))
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
    Ok(Local { crust: crust(&cells, &one_step), axis: axis(&cells, &one_step) })
}

/// Whether edges are crust: by walks, and by search where a walk gives up.
fn crust(cells: &Cells<'_>, one_step: &[bool]) -> Vec<bool> {
    decide(cells, one_step.len(), |k| if one_step[k] { Some(crust_pencil(cells, k)) } else { None })
}

/// Whether dual edges are axis.
fn axis(cells: &Cells<'_>, one_step: &[bool]) -> Vec<bool> {
    decide(cells, one_step.len(), |k| if one_step[k] { None } else { axis_pencil(cells, k) })
}

/// The circles through the ends of an edge that are empty of sites, which are those between the circumcircles of its
/// triangles, and of its own two Voronoi vertices.
fn crust_pencil(cells: &Cells<'_>, k: usize) -> Pencil {
    let [p, q] = cells.view.edges[k];
    let mut pencil = Pencil::new(cells.sites[p as usize], cells.sites[q as usize]);
    for t in cells.view.dual_edges[k].into_iter().filter(|&t| t != -1) {
        pencil.cut(cells.sites[opposite(cells.view.triangles[t as usize], p, q) as usize]);
        pencil.cut(cells.vertices[t as usize]);
    }
    pencil
}

/// The circles through the ends of a dual edge that do not hold its own two sites; None without two different ends.
fn axis_pencil(cells: &Cells<'_>, k: usize) -> Option<Pencil> {
    let [right, left] = cells.view.dual_edges[k];
    if right == -1 || left == -1 {
        return None;
    }
    let [from, to] = [right, left].map(|t| cells.vertices[t as usize]);
    let mut pencil = Pencil::new(from, to);
    cells.view.edges[k].into_iter().for_each(|site| pencil.cut(cells.sites[site as usize]));
    (from != to).then_some(pencil)
}

/// Whether the pencil of each row, where it has one, leaves a circle.
fn decide(cells: &Cells<'_>, rows: usize, pencil: impl Fn(usize) -> Option<Pencil> + Sync) -> Vec<bool> {
    let walked = parallel::map(rows, |k| match pencil(k) {
        None => Some(false),
        // Both cells of the edge meet every circle of either pencil: the dual edge is a chord of it, or goes through
        // its centre.
        Some(pencil) => leaves_some(pencil, |disc, inside| match cells.find(k, disc, inside) {
            Found::Nothing => Some(None),
            Found::Inside(v) => Some(Some(v)),
            Found::TooMany => None,
        }),
    });
    let hard: Vec<usize> = (0..rows).filter(|&k| walked[k].is_none()).collect();
    let mut decided: Vec<bool> = walked.into_iter().map(|found| found == Some(true)).collect();
    if !hard.is_empty() {
        let places = Places::of(cells);
        let searched = parallel::map(hard.len(), |i| {
            let pencil = pencil(hard[i])?;
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
