//! Two-pass crust and edge filter without the second triangulation.
//!
//! An edge of the Delaunay triangulation of sites and Voronoi vertices is one with a circle through its ends that holds
//! none of them: a question about one pencil of circles, independent of all others. Nearly always the smallest circle
//! that is allowed answers it with one look at the neighbourhood.

use super::boxes::{Boxes, Disc};
use super::one_step::{one_step, opposite};
use super::pencil::Pencil;
use crate::diagram::scale::{Scale, largest};
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
    Ok(Places::of(view).crust(&one_step))
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
    let mut places = Places::of(view);
    let sites: Vec<Point> = (0..view.sites.len() as i32).map(|site| places.site(site)).collect();
    places.sites = Boxes::new(along_curve(&sites));
    Ok(Local { crust: places.crust(&one_step), axis: places.axis(&one_step) })
}

/// Sites and distinct Voronoi vertices near 1, and where to find them.
struct Places<'a> {
    view: DiagramView<'a>,
    scale: Scale,
    /// Vertices among the sites, and those far from all of them: these would spoil the boxes of the others.
    near: Boxes,
    far: Boxes,
    /// For the axis only.
    sites: Boxes,
}

impl<'a> Places<'a> {
    fn of(view: DiagramView<'a>) -> Self {
        let scale = Scale::of(largest(view.sites));
        let mut places = Self { view, scale, near: Boxes::default(), far: Boxes::default(), sites: Boxes::default() };
        let [low, high] = places.frame();
        let representative = representatives(view);
        let distinct = (0..view.vertices.len()).filter(|&t| representative[t] as usize == t);
        let inside = |v: &Point| (0..2).all(|axis| low[axis] <= v[axis] && v[axis] <= high[axis]);
        let (near, far): (Vec<Point>, Vec<Point>) = distinct.map(|t| places.vertex(t as i32)).partition(inside);
        // In an order of their own: along a curve, vertices of neighbouring triangles lie on both sides of it, far apart.
        (places.near, places.far) = (Boxes::new(along_curve(&near)), Boxes::new(along_curve(&far)));
        places
    }

    /// The bounding box of the sites, grown by half its size.
    fn frame(&self) -> [Point; 2] {
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for &p in self.view.sites {
            let p = self.scale.down(p);
            low = [low[0].min(p[0]), low[1].min(p[1])];
            high = [high[0].max(p[0]), high[1].max(p[1])];
        }
        let margin = 0.5 * (high[0] - low[0]).max(high[1] - low[1]);
        [low.map(|x| x - margin), high.map(|x| x + margin)]
    }

    fn site(&self, i: i32) -> Point {
        self.scale.down(self.view.sites[i as usize])
    }

    fn vertex(&self, t: i32) -> Point {
        pulled_in(self.scale.down(self.view.vertices[t as usize]))
    }

    fn crust(&self, one_step: &[bool]) -> Vec<bool> {
        parallel::map(one_step.len(), |k| one_step[k] && self.is_crust(k))
    }

    fn axis(&self, one_step: &[bool]) -> Vec<bool> {
        parallel::map(one_step.len(), |k| !one_step[k] && self.is_axis(k))
    }

    fn is_crust(&self, k: usize) -> bool {
        let [p, q] = self.view.edges[k];
        let mut pencil = Pencil::new(self.site(p), self.site(q));
        for t in self.view.dual_edges[k].into_iter().filter(|&t| t != -1) {
            // Circles empty of sites are those between the two triangles'; then the vertices of these.
            pencil.cut(self.site(opposite(self.view.triangles[t as usize], p, q)));
            pencil.cut(self.vertex(t));
        }
        leaves_some(pencil, |_, disc, wanted| self.find_vertex(disc, wanted))
    }

    fn is_axis(&self, k: usize) -> bool {
        let [right, left] = self.view.dual_edges[k];
        if right == -1 || left == -1 {
            return false;
        }
        let [from, to] = [right, left].map(|t| self.vertex(t));
        if from == to {
            return false;
        }
        let mut pencil = Pencil::new(from, to);
        self.view.edges[k].into_iter().for_each(|site| pencil.cut(self.site(site)));
        // The middle of a dual edge is on the border of two cells: no site is nearer to it than theirs, which are outside
        // the smallest circle.
        leaves_some(pencil, |tau, disc, wanted| {
            let site = || if tau == 0.0 { None } else { self.sites.find(disc, wanted) };
            self.find_vertex(disc, wanted).or_else(site)
        })
    }

    fn find_vertex(&self, disc: Disc, wanted: &dyn Fn(Point) -> bool) -> Option<Point> {
        self.near.find(disc, wanted).or_else(|| self.far.find(disc, wanted))
    }
}

fn along_curve(points: &[Point]) -> Vec<Point> {
    curve_order(points).into_iter().map(|row| points[row as usize]).collect()
}

/// Cuts a pencil by the points that `find` finds in its circles until one is empty or none is left.
fn leaves_some(mut pencil: Pencil, find: impl Fn(f64, Disc, &dyn Fn(Point) -> bool) -> Option<Point>) -> bool {
    for _ in 0..CUTS {
        if pencil.is_empty() {
            return false;
        }
        let tau = pencil.choose();
        match find(tau, pencil.disc(tau), &|v| pencil.holds(tau, v)) {
            None => return true,
            Some(v) => pencil.cut(v),
        }
    }
    !pencil.is_empty()
}

/// Vertices beyond this are moved in to it along their direction: for circles of any smaller radius a vertex that far
/// is a half-plane all the same.
const FAR: f64 = 1e60;
/// Vertex coordinates below this are zero: they are rounded far coarser than that.
const SMALL: f64 = 1e-42;

/// A scaled vertex within the range of exact arithmetic.
pub(super) fn pulled_in(v: Point) -> Point {
    let size = v[0].abs().max(v[1].abs());
    let v = if size > FAR { v.map(|x| x / size * FAR) } else { v };
    v.map(|x| if x.abs() < SMALL { 0.0 } else { x })
}
