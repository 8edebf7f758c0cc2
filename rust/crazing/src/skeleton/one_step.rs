//! The one-step crust: every edge is crust, or its dual is anti-crust.

use std::ops::Range;

use crate::diagram::scale::{Scale, largest};
use crate::diagram::{COINCIDENT, DiagramView, shares};
use crate::error::Result;
use crate::graph::Point;
use crate::parallel;
use crate::predicates::{apex_sign, one_step_sign};

/// Whether each edge is crust: some circle through its ends contains neither end of its dual.
///
/// An edge of the hull is crust when the angle opposite it is acute. Signs are exact; a tie is crust, but for the
/// hull, where the circle would have to be a line.
///
/// # Errors
/// [`crate::Error::TooFewSites`] or [`crate::Error::Collinear`].
///
/// # Source
/// Gold, Snoeyink: A One-Step Crust and Skeleton Extraction Algorithm (2001); thesis, section 5.3.
pub fn one_step(view: DiagramView<'_>) -> Result<Vec<bool>> {
    Ok(judged(view)?.0)
}

/// What there is to draw among some rows.
#[derive(Debug, Default)]
pub(super) struct Tally {
    pub(super) crust: usize,
    /// Dual edges of the others that are finite and have a length.
    pub(super) axis: usize,
    /// Dual edges without length, of all rows.
    pub(super) short: Vec<[i32; 2]>,
}

/// The mask of [`one_step`], and what there is to draw in each of the [`ranges`](parallel::ranges) of rows.
pub(super) fn judged(view: DiagramView<'_>) -> Result<(Vec<bool>, Vec<Tally>)> {
    view.check_triangle()?;
    let largest = largest(view.sites);
    let judge = Judge { view, scaled: &Scale::of(largest).all_down(view.sites), slack: Slack::of(view, largest) };
    let mut mask = vec![false; view.edges.len()];
    let tallies = parallel::fill(&mut mask, |rows, mask| {
        let (mut tally, mut corners) = (Tally::default(), Corners::new());
        for (i, mask) in mask.chunks_mut(TOGETHER).enumerate() {
            judge.decide(rows.start + i * TOGETHER, mask, &mut corners, &mut tally);
        }
        tally
    });
    Ok((mask, tallies))
}

/// Edges looked at together: the sites of all of them are waited for at once, and then several signs are found at a
/// time. As many as a byte can number.
const TOGETHER: usize = 256;

struct Judge<'a> {
    view: DiagramView<'a>,
    /// The sites near 1, for exact signs.
    scaled: &'a [Point],
    slack: Slack,
}

impl Judge<'_> {
    fn decide(&self, first: usize, mask: &mut [bool], corners: &mut Corners, tally: &mut Tally) {
        let rows = first..first + mask.len();
        corners.gather(self.view, rows.clone());
        corners.sign(self.slack);
        let mut infinite = 0;
        for (i, (kept, &sign)) in mask.iter_mut().zip(&corners.signs).enumerate() {
            *kept = sign < 0;
            if sign == 0 {
                *kept = self.is_crust(first + i);
                infinite += usize::from(!*kept & self.view.dual_edges[first + i].contains(&-1));
            }
        }
        let crust = mask.iter().map(|&kept| u32::from(kept)).sum::<u32>() as usize;
        let mut short = 0;
        if corners.shortest() == 0.0 {
            for k in rows.clone().filter(|&k| shares(self.view, k)) {
                short += usize::from(!mask[k - first]);
                tally.short.push(self.view.dual_edges[k]);
            }
        }
        tally.crust += crust;
        tally.axis += rows.len() - crust - infinite - short;
    }

    #[cold]
    fn is_crust(&self, k: usize) -> bool {
        let (view, ends) = (self.view, self.view.edges[k]);
        let [p, q] = ends.map(|site| self.scaled[site as usize]);
        // Arrays of others may leave no site at all.
        let apex = |triangle| self.scaled.get(apex(view, ends, triangle) as usize).copied().unwrap_or(p);
        match view.dual_edges[k] {
            [-1, -1] => false,
            [t, -1] | [-1, t] => apex_sign(p, q, apex(t)) > 0.0,
            [right, left] => one_step_sign(p, q, apex(right), apex(left)) >= 0.0,
        }
    }
}

/// One end of some edges and both ends of their duals, one coordinate a row.
///
/// All circles through both ends of an edge have their centres on its dual or beyond, and the ends of the dual exclude
/// each other exactly when an end of the edge sees the dual under an acute angle. So one site and two vertices are
/// enough, and vertices lie in memory as edges do; sites may be in any order.
struct Corners {
    places: [Point; TOGETHER],
    sites: [[f64; TOGETHER]; 2],
    rights: [[f64; TOGETHER]; 2],
    lefts: [[f64; TOGETHER]; 2],
    /// Of the angle at each site: -1 when it is certainly obtuse, 1 when it is certainly acute, else 0.
    signs: [i8; TOGETHER],
}

impl Corners {
    fn new() -> Self {
        let nowhere = [[0.0; TOGETHER]; 2];
        Self { places: [[0.0; 2]; TOGETHER], sites: nowhere, rights: nowhere, lefts: nowhere, signs: [0; TOGETHER] }
    }

    fn gather(&mut self, view: DiagramView<'_>, rows: Range<usize>) {
        let none = [f64::NAN; 2];
        let (ends, count, which) = distinct(&view.edges[rows.clone()]);
        // Nothing but these reads: many are then under way at once.
        for (place, &site) in self.places.iter_mut().zip(&ends[..count]) {
            *place = view.sites.get(site as usize).copied().unwrap_or(none);
        }
        for (i, dual) in view.dual_edges[rows].iter().enumerate() {
            let [right, left] = dual.map(|t| view.vertices.get(t as usize).copied().unwrap_or(none));
            [self.sites[0][i], self.sites[1][i]] = self.places[usize::from(which[i])];
            [self.rights[0][i], self.rights[1][i]] = right;
            [self.lefts[0][i], self.lefts[1][i]] = left;
        }
    }

    fn sign(&mut self, slack: Slack) {
        for i in 0..TOGETHER {
            let (x, y) = (self.sites[0][i], self.sites[1][i]);
            let (ax, ay) = (self.rights[0][i] - x, self.rights[1][i] - y);
            let (bx, by) = (self.lefts[0][i] - x, self.lefts[1][i] - y);
            let (a, b) = (ax.abs() + ay.abs(), bx.abs() + by.abs());
            let (value, error) = (ax * bx + ay * by, slack.part * (a * b) + slack.least * (a + b) + TINY);
            let is_near = a + b < HUGE;
            self.signs[i] = i8::from(is_near & (value > error)) - i8::from(is_near & (value < -error));
        }
    }

    /// Zero when one of the dual edges has no length.
    fn shortest(&self) -> f64 {
        let length = |i: usize| {
            let apart = |axis: usize| (self.rights[axis][i] - self.lefts[axis][i]).abs();
            apart(0) + apart(1)
        };
        let mut least = [f64::INFINITY; 4];
        for i in (0..TOGETHER).step_by(4) {
            for (j, least) in least.iter_mut().enumerate() {
                *least = if length(i + j) < *least { length(i + j) } else { *least };
            }
        }
        least.into_iter().fold(f64::INFINITY, f64::min)
    }
}

/// Sites, one of every edge, how many, and which of them is the edge's own: edges come in runs that share one, and it is
/// taken once.
fn distinct(edges: &[[i32; 2]]) -> ([i32; TOGETHER], usize, [u8; TOGETHER]) {
    let (mut found, mut count, mut which) = ([0; TOGETHER], 0, [0; TOGETHER]);
    let mut last = -1;
    for (i, &[from, to]) in edges.iter().enumerate().take(TOGETHER) {
        if from != last && to != last {
            last = match edges.get(i + 1) {
                Some(next) if next.contains(&to) => to,
                _ => from,
            };
            found[count] = last;
            count += 1;
        }
        which[i] = (count - 1) as u8;
    }
    (found, count, which)
}

/// Products below this may have lost bits.
const TINY: f64 = 1e-290;
/// Vertices farther away may have been brought back to where a number can hold them.
const HUGE: f64 = 1e300;

/// How far the product of the distances from a site to two vertices may be off.
///
/// A vertex is rounded by less than 1e-10 of its radius ([`circumcentre`](crate::predicates::circumcentre)) and by a
/// bit of its coordinates, and moved by 1e-9 of it for every triangle on the way to the one that lends it its place.
#[derive(Clone, Copy)]
struct Slack {
    /// Beside the product of both distances.
    part: f64,
    /// Beside their sum.
    least: f64,
}

impl Slack {
    fn of(view: DiagramView<'_>, largest: f64) -> Self {
        Self { part: 1e-8 + 4.0 * COINCIDENT * view.triangles.len() as f64, least: 4.0 * f64::EPSILON * largest }
    }
}

/// What is left of a triangle's corners when the two ends are taken out.
#[inline]
fn apex(view: DiagramView<'_>, ends: [i32; 2], triangle: i32) -> i32 {
    let [a, b, c] = view.triangles.get(triangle as usize).copied().unwrap_or_default();
    a ^ b ^ c ^ ends[0] ^ ends[1]
}

/// The corner that is neither `p` nor `q`.
#[inline]
pub(super) fn opposite(corners: [i32; 3], p: i32, q: i32) -> i32 {
    let other = |c: i32| c != p && c != q;
    if other(corners[0]) {
        corners[0]
    } else if other(corners[1]) {
        corners[1]
    } else {
        corners[2]
    }
}
