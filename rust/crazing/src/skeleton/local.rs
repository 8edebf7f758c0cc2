//! Two-pass crust and edge filter without the second triangulation.
//!
//! An edge of the Delaunay triangulation of sites and Voronoi vertices is one with a circle through its ends that holds
//! none of them: a question about one pencil of circles, independent of all others. Nearly always the first circle that
//! suggests itself is empty, and a walk past some four vertices shows it; only otherwise the interval of circles is
//! narrowed, point by point.
//!
//! # What is exact
//! The Voronoi vertices are taken as they are in the diagram: rounded to doubles, coincident neighbours made one. For
//! these points, as if they had been given, all is exact: whether one lies inside a circle is the sign of a polynomial,
//! and so is which of two cuts lies farther (a filter with a bound on its error, then expansions). An edge is dropped
//! when two cuts exclude each other, and kept when a circle is found that holds nothing. Between the two there is the
//! tie: an interval shorter than 1e-9 half lengths of the edge, in which rounded vertices mean nothing, counts as kept.
//! The one-step test, which is exact for the samples themselves, has the first word: no other edge is asked about.

use super::circle::Circle;
use super::doors::Many;
use super::flood::{Cells, Found};
use super::links::links;
use super::one_step::{one_step, opposite};
use super::outer::Outer;
use super::pencil::Pencil;
use super::places::Places;
use crate::diagram::DiagramView;
use crate::error::{Error, Result};
use crate::graph::Point;
use crate::parallel;

/// Cuts before a pencil is judged by what is left: each at least halves the interval, so that nothing but a tie is.
const CUTS: usize = 64;
/// Cells that a walk may enter at first.
const NEAR: usize = 24;
/// Walks that are too short are made again among so many times the cells...
const FARTHER: usize = 8;
/// ... as long as all of them together enter no more than so many cells an edge of the diagram: a search costs as much.
const WALKED: usize = 4;
/// Edges whose sites are waited for at once.
const TOGETHER: usize = 256;
/// Searches that are not worth sorting for.
const FEW: usize = 100;

/// Masks over the edges of a diagram.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Local {
    /// Two-pass crust.
    pub crust: Vec<bool>,
    /// Edge-filtered axis.
    pub axis: Vec<bool>,
}

/// What the methods here begin with.
#[derive(Debug, Clone, Copy)]
pub struct Known<'a> {
    /// The one-step crust.
    pub one_step: &'a [bool],
    /// [`links`] between the triangles.
    pub links: &'a [u32],
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
    two_pass_among(view, Known { one_step: &one_step(view)?, links: &links(view) })
}

/// [`two_pass`] where the one-step crust and the links are known.
///
/// # Errors
/// As there, or [`crate::Error::BadLength`].
pub fn two_pass_among(view: DiagramView<'_>, known: Known<'_>) -> Result<Vec<bool>> {
    let cells = known.cells(view)?;
    let one_step = known.one_step;
    Ok(decide(&cells, |k| one_step[k], |k| Edge::crust(&cells, k)))
}

/// The axis of [`edge_filter`] where the one-step crust and the links are known.
///
/// # Errors
/// As there, or [`crate::Error::BadLength`].
pub fn filtered_among(view: DiagramView<'_>, known: Known<'_>) -> Result<Vec<bool>> {
    let cells = known.cells(view)?;
    let one_step = known.one_step;
    Ok(decide(&cells, |k| !one_step[k], |k| Edge::axis(&cells, k)))
}

impl<'a> Known<'a> {
    fn cells(self, view: DiagramView<'a>) -> Result<Cells<'a>> {
        let (edges, sides) = (view.edges.len(), 3 * view.triangles.len());
        for (array, found, wanted) in [("one_step", self.one_step.len(), edges), ("links", self.links.len(), sides)] {
            if found != wanted {
                return Err(Error::BadLength { array, found, wanted });
            }
        }
        view.check_triangle()?;
        Ok(Cells::of(view, self.links))
    }
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
    edge_filter_among(view, Known { one_step: &one_step(view)?, links: &links(view) })
}

/// [`edge_filter`] where the one-step crust and the links are known.
///
/// # Errors
/// As there, or [`crate::Error::BadLength`].
pub fn edge_filter_among(view: DiagramView<'_>, known: Known<'_>) -> Result<Local> {
    let cells = known.cells(view)?;
    let one_step = known.one_step;
    let edge = |k: usize| if one_step[k] { Edge::crust(&cells, k) } else { Edge::axis(&cells, k) };
    let kept = decide(&cells, |_| true, edge);
    let (crust, axis) = kept.iter().zip(one_step).map(|(&kept, &one)| (kept & one, kept & !one)).unzip();
    Ok(Local { crust, axis })
}

/// Whether a circle of an edge's pencil is empty, found with room for doors.
type Answer<'a> = dyn Fn(&Edge, &mut Many) -> Option<bool> + Sync + 'a;

/// An edge that is in the one-step crust, or a dual edge that is not.
struct Edge {
    k: usize,
    ends: [Point; 2],
    /// The ends of the other one, twice the same where it has one end only.
    across: [Point; 2],
    is_crust: bool,
}

impl Edge {
    /// None for an edge without triangles.
    fn crust(cells: &Cells<'_>, k: usize) -> Option<Self> {
        let dual = cells.view.dual_edges[k];
        if dual == [-1; 2] {
            return None;
        }
        let across = dual.map(|t| cells.vertices[if t == -1 { dual[0].max(dual[1]) } else { t } as usize]);
        Some(Self { k, ends: cells.view.edges[k].map(|site| cells.sites[site as usize]), across, is_crust: true })
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

    /// What is inside one circle that suggests itself.
    ///
    /// Both cells of the edge meet every circle of either pencil: the dual edge is a chord of it, or goes through its
    /// centre. No site can be in the circle of a crust edge: it is between the circumcircles of the triangles.
    #[inline]
    fn glance(&self, cells: &Cells<'_>) -> Found {
        let pencil = Pencil::new(self.ends[0], self.ends[1]);
        let tau = if self.is_crust { self.middle() } else { 0.0 };
        let disc = pencil.disc(tau);
        let inside = |v: Point| pencil.holds(tau, v);
        // The disc is a little too large, and much cheaper to ask.
        match self.across.into_iter().find(|&v| disc.holds(disc.place(v)) && inside(v)) {
            Some(v) => Found::Inside(v),
            None => cells.find::<NEAR>(self.k, disc, inside),
        }
    }

    /// The smallest circle of all, if it does not hold the ends across, else the one in the middle of what they leave.
    /// For a dual edge it is always the first: its sites are mirror images.
    #[inline]
    fn middle(&self) -> f64 {
        let [p, q] = self.ends;
        let apex = |v: Point| {
            let (a, b) = ([p[0] - v[0], p[1] - v[1]], [q[0] - v[0], q[1] - v[1]]);
            (a[0] * b[0] + a[1] * b[1], a[0] * b[1] - a[1] * b[0])
        };
        let [(dot_low, cross_low), (dot_high, cross_high)] = self.across.map(apex);
        let both_sides = cross_low < 0.0 && cross_high > 0.0;
        if both_sides && dot_low.min(dot_high) < 0.0 {
            0.5 * (dot_low / cross_low + dot_high / cross_high)
        } else {
            0.0
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

    /// Whether some of the circles that are left is empty, by walks among a few cells; None when they are more.
    fn walk(&self, cells: &Cells<'_>, pencil: Pencil) -> Option<bool> {
        leaves_some(pencil, |circle| cells.find::<NEAR>(self.k, circle.disc, |v| circle.holds(v)).known())
    }

    /// The same among at most so many cells; not where the vertices beyond all sites tell.
    fn walk_far(&self, cells: &Cells<'_>, outer: Option<&Outer>, doors: &mut Many, most: usize) -> Option<bool> {
        leaves_some(self.pencil(cells), |circle| {
            let found = outer.and_then(|outer| outer.find(circle));
            if found.is_some() || outer.is_some_and(|outer| outer.is_all_in(circle)) {
                return Some(found);
            }
            cells.find_far(self.k, circle.disc, |v| circle.holds(v), (doors, most)).known()
        })
    }

    /// The first answer: None when the neighbourhood is too large for it.
    fn decide(&self, cells: &Cells<'_>) -> Option<bool> {
        match self.glance(cells) {
            Found::Nothing => Some(true),
            Found::Inside(v) => {
                let mut pencil = self.pencil(cells);
                pencil.cut(v);
                self.walk(cells, pencil)
            }
            Found::TooMany => None,
        }
    }
}

/// Whether the pencil of each row that is asked about, where it has an edge, leaves a circle: by walks, by longer ones
/// as long as these are few, and by search.
fn decide(
    cells: &Cells<'_>,
    asked: impl Fn(usize) -> bool + Sync + Send,
    edge: impl Fn(usize) -> Option<Edge> + Sync + Send,
) -> Vec<bool> {
    let rows = cells.view.edges.len();
    let mut decided = vec![false; rows];
    let hard = parallel::fill(&mut decided, |rows, decided| {
        let mut hard = Vec::new();
        for (i, decided) in decided.chunks_mut(TOGETHER).enumerate() {
            let first = rows.start + i * TOGETHER;
            let asked = (first..first + decided.len()).filter(|&k| asked(k));
            touch(cells, asked.clone());
            for k in asked {
                match edge(k).map_or(Some(false), |edge| edge.decide(cells)) {
                    Some(kept) => decided[k - first] = kept,
                    None => hard.push(k),
                }
            }
        }
        hard
    });
    let mut hard = hard.concat();
    let again = |hard: &mut Vec<usize>, decided: &mut [bool], each: usize, answer: &Answer<'_>| {
        let one = |doors: &mut Many, i: usize| edge(hard[i]).and_then(|edge| answer(&edge, doors));
        let answers = parallel::map_slow_with(hard.len(), each, || cells.doors(), one);
        hard.iter().zip(&answers).for_each(|(&k, &kept)| decided[k] = kept == Some(true));
        let mut left = answers.iter().map(Option::is_none);
        hard.retain(|_| left.next() == Some(true));
    };
    let (mut most, mut outer) = (NEAR * FARTHER, None);
    while !hard.is_empty() && hard.len().saturating_mul(most) <= WALKED * rows {
        again(&mut hard, &mut decided, most, &|edge, doors| edge.walk_far(cells, outer.as_ref(), doors, most));
        most *= FARTHER;
        if !hard.is_empty() {
            outer = outer.or_else(|| Some(Outer::of(cells)));
        }
    }
    if !hard.is_empty() {
        let places = Places::of(cells, hard.len() > FEW);
        again(&mut hard, &mut decided, cells.vertices.len(), &|edge, _| {
            leaves_some(edge.pencil(cells), |circle| Some(places.find(circle)))
        });
    }
    decided
}

/// Reads the sites of some edges, and nothing else: many reads are then under way at once, and what comes after waits
/// for none of them. Sites lie in memory in any order, all else as edges do.
fn touch(cells: &Cells<'_>, rows: impl Iterator<Item = usize>) {
    let ends = rows.flat_map(|k| cells.view.edges[k]).filter_map(|site| cells.sites.get(site as usize));
    std::hint::black_box(ends.map(|p| p[0].to_bits()).fold(0, std::ops::BitXor::bitxor));
}

/// Cuts a pencil by the points that `find` finds in its circles until one is empty or none is left. `find` gives None
/// when it cannot tell.
fn leaves_some(mut pencil: Pencil, mut find: impl FnMut(&Circle<'_>) -> Option<Option<Point>>) -> Option<bool> {
    for _ in 0..CUTS {
        if pencil.is_empty() {
            return Some(false);
        }
        match find(&Circle::of(&pencil, pencil.choose()))? {
            None => return Some(true),
            Some(v) => pencil.cut(v),
        }
    }
    Some(!pencil.is_empty())
}
