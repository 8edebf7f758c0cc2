//! The corner where an edge sees its dual: whether it is obtuse, for many edges at a time.

use std::hint::select_unpredictable;
use std::ops::Range;

use crate::diagram::{COINCIDENT, DiagramView};
use crate::graph::Point;

/// Edges looked at together: the sites of all of them are waited for at once, and then several signs are found at a
/// time. As many as a byte can number.
pub(super) const TOGETHER: usize = 256;
/// A sign that holds wherever vertices were moved.
pub(super) const SURE: u8 = 2;

/// One end of some edges and both ends of their duals.
///
/// All circles through both ends of an edge have their centres on its dual or beyond, and the ends of the dual exclude
/// each other exactly when an end of the edge sees the dual under an acute angle. So one site and two vertices are
/// enough, and vertices lie in memory as edges do; sites may be in any order.
pub(super) struct Corners {
    sites: [Point; TOGETHER],
    rights: [Point; TOGETHER],
    lefts: [Point; TOGETHER],
    /// Of the angle at each site: negative when it is certainly obtuse, positive when it is certainly acute, else 0;
    /// of the size of [`SURE`] when that is so even for vertices that were moved.
    pub(super) signs: [i8; TOGETHER],
    ahead: Ahead,
}

/// The sites of the edges that come next: they are on their way while those before them are looked at.
struct Ahead {
    places: [Point; TOGETHER],
    which: [u8; TOGETHER],
}

impl Corners {
    pub(super) fn new() -> Self {
        let nowhere = [[0.0; 2]; TOGETHER];
        let ahead = Ahead { places: nowhere, which: [0; TOGETHER] };
        Self { sites: nowhere, rights: nowhere, lefts: nowhere, signs: [0; TOGETHER], ahead }
    }

    /// Takes up the sites that were on their way, finds the vertices, and sends for the sites of other rows.
    #[inline(always)]
    pub(super) fn gather(&mut self, view: DiagramView<'_>, rows: Range<usize>, next: Range<usize>) {
        let none = [f64::NAN; 2];
        let Ahead { places, which } = &mut self.ahead;
        for (site, &which) in self.sites.iter_mut().zip(&*which) {
            *site = places[usize::from(which)];
        }
        let (wanted, count) = distinct(&view.edges[next], which);
        for (place, &site) in places.iter_mut().zip(&wanted[..count]) {
            *place = *view.sites.get(site as usize).unwrap_or(&none);
        }
        let corners = self.rights.iter_mut().zip(&mut self.lefts);
        for ((right, left), dual) in corners.zip(&view.dual_edges[rows]) {
            *right = *view.vertices.get(dual[0] as usize).unwrap_or(&none);
            *left = *view.vertices.get(dual[1] as usize).unwrap_or(&none);
        }
    }

    /// Finds the signs. Whether there may be dual edges without length.
    #[inline(always)]
    pub(super) fn sign(&mut self, slack: Slack) -> bool {
        let mut is_short = false;
        for i in 0..TOGETHER {
            let [x, y] = self.sites[i];
            let (ax, ay) = (self.rights[i][0] - x, self.rights[i][1] - y);
            let (bx, by) = (self.lefts[i][0] - x, self.lefts[i][1] - y);
            let (a, b) = (ax.abs() + ay.abs(), bx.abs() + by.abs());
            let (value, product) = (ax * bx + ay * by, a * b);
            let error = slack.part * product + slack.least * (a + b) + TINY;
            let moved = error + slack.moved * product;
            let is_near = a + b < HUGE;
            let sign = |error| i8::from(is_near & (value > error)) - i8::from(is_near & (value < -error));
            self.signs[i] = sign(error) + sign(moved);
            is_short |= (ax == bx) & (ay == by);
        }
        is_short
    }
}

/// Sites, one of every edge, how many these are, and which of them is the edge's own: edges come in runs that share
/// one, and it is taken once.
#[inline(always)]
fn distinct(edges: &[[i32; 2]], which: &mut [u8; TOGETHER]) -> ([i32; TOGETHER], usize) {
    let (mut found, mut last, mut count) = ([0; TOGETHER], -1, 0_usize);
    for (i, (&[from, to], which)) in edges.iter().zip(which).enumerate() {
        let ends = edges[(i + 1).min(edges.len() - 1)];
        // Where a run ends cannot be foretold.
        let shared = select_unpredictable((ends[0] == to) | (ends[1] == to), to, from);
        let is_new = (from != last) & (to != last);
        last = select_unpredictable(is_new, shared, last);
        count += usize::from(is_new);
        found[count.wrapping_sub(1) % TOGETHER] = last;
        *which = count.wrapping_sub(1) as u8;
    }
    (found, count.min(TOGETHER))
}

/// Products below this may have lost bits.
const TINY: f64 = 1e-290;
/// Vertices farther away may have been brought back to where a number can hold them.
const HUGE: f64 = 1e300;

/// How far the product of the distances from a site to two vertices may be off.
///
/// A vertex is rounded by less than 1e-10 of its radius ([`circumcentre`](crate::predicates::circumcentre)) and by a
/// bit of its coordinates, and moved by 1e-9 of it for every triangle on the way to the one that lends it its place.
/// Whether any was moved is known when all dual edges have been seen: one is then without length.
#[derive(Clone, Copy)]
pub(super) struct Slack {
    /// Beside the product of both distances.
    part: f64,
    /// Beside it, where vertices were moved.
    moved: f64,
    /// Beside their sum.
    least: f64,
}

impl Slack {
    pub(super) fn of(view: DiagramView<'_>, largest: f64) -> Self {
        let moved = 4.0 * COINCIDENT * view.triangles.len() as f64;
        Self { part: 1e-8, moved, least: 4.0 * f64::EPSILON * largest }
    }
}
