//! The one-step crust: every edge is crust, or its dual is anti-crust.

use std::hint::select_unpredictable;
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
    /// Dual edges of the others that have none of the two.
    pub(super) not_drawn: usize,
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
        corners.gather(view, rows.start..rows.start, rows.start..rows.end.min(rows.start + TOGETHER));
        for (i, mask) in mask.chunks_mut(TOGETHER).enumerate() {
            judge.decide(rows.start + i * TOGETHER, rows.end, mask, &mut corners, &mut tally);
        }
        tally
    });
    Ok((mask, tallies))
}

/// Edges looked at together: the sites of all of them are waited for at once, and then several signs are found at a
/// time. As many as a byte can number.
const TOGETHER: usize = 256;
/// Signs that are looked through at once.
const CHUNK: usize = 16;

struct Judge<'a> {
    view: DiagramView<'a>,
    /// The sites near 1, for exact signs.
    scaled: &'a [Point],
    slack: Slack,
}

impl Judge<'_> {
    /// Decides some rows and tallies them; those after them, up to `end`, come next.
    fn decide(&self, first: usize, end: usize, mask: &mut [bool], corners: &mut Corners, tally: &mut Tally) {
        let rows = first..first + mask.len();
        let next = rows.end..end.min(rows.end + TOGETHER);
        corners.gather(self.view, rows.clone(), next);
        let is_short = corners.sign(self.slack);
        mask.iter_mut().zip(&corners.signs).for_each(|(kept, &sign)| *kept = sign < 0);
        let mut not_drawn = 0;
        for (i, signs) in corners.signs[..mask.len()].chunks(CHUNK).enumerate() {
            // Few are open: their chunk is found at once.
            if signs.iter().fold(false, |open, &sign| open | (sign == 0)) {
                for i in (CHUNK * i..mask.len()).take(CHUNK).filter(|&i| corners.signs[i] == 0) {
                    mask[i] = self.is_crust(first + i);
                    not_drawn += usize::from(!mask[i] & self.view.dual_edges[first + i].contains(&-1));
                }
            }
        }
        if is_short {
            for k in rows.clone().filter(|&k| shares(self.view, k)) {
                not_drawn += usize::from(!mask[k - first]);
                tally.short.push(self.view.dual_edges[k]);
            }
        }
        let crust = mask.iter().map(|&kept| u32::from(kept)).sum::<u32>() as usize;
        tally.crust += crust;
        tally.axis += rows.len() - crust - not_drawn;
        tally.not_drawn += not_drawn;
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

/// One end of some edges and both ends of their duals.
///
/// All circles through both ends of an edge have their centres on its dual or beyond, and the ends of the dual exclude
/// each other exactly when an end of the edge sees the dual under an acute angle. So one site and two vertices are
/// enough, and vertices lie in memory as edges do; sites may be in any order.
struct Corners {
    sites: [Point; TOGETHER],
    rights: [Point; TOGETHER],
    lefts: [Point; TOGETHER],
    /// Of the angle at each site: -1 when it is certainly obtuse, 1 when it is certainly acute, else 0.
    signs: [i8; TOGETHER],
    ahead: Ahead,
}

/// The sites of the edges that come next: they are on their way while those before them are looked at.
struct Ahead {
    places: [Point; TOGETHER],
    which: [u8; TOGETHER],
}

impl Corners {
    fn new() -> Self {
        let nowhere = [[0.0; 2]; TOGETHER];
        let ahead = Ahead { places: nowhere, which: [0; TOGETHER] };
        Self { sites: nowhere, rights: nowhere, lefts: nowhere, signs: [0; TOGETHER], ahead }
    }

    /// Takes up the sites that were on their way, finds the vertices, and sends for the sites of other rows.
    fn gather(&mut self, view: DiagramView<'_>, rows: Range<usize>, next: Range<usize>) {
        let none = [f64::NAN; 2];
        let Ahead { places, which } = &mut self.ahead;
        for (site, &which) in self.sites.iter_mut().zip(&*which) {
            *site = places[usize::from(which)];
        }
        let wanted = distinct(&view.edges[next], which);
        let corners = self.rights.iter_mut().zip(&mut self.lefts).zip(places.iter_mut().zip(&wanted));
        let mut duals = view.dual_edges[rows].iter();
        for ((right, left), (place, &site)) in corners {
            let dual = duals.next().copied().unwrap_or([-1; 2]);
            *right = *view.vertices.get(dual[0] as usize).unwrap_or(&none);
            *left = *view.vertices.get(dual[1] as usize).unwrap_or(&none);
            *place = *view.sites.get(site as usize).unwrap_or(&none);
        }
    }

    /// Finds the signs. Whether there may be dual edges without length.
    fn sign(&mut self, slack: Slack) -> bool {
        let mut is_short = false;
        for i in 0..TOGETHER {
            let [x, y] = self.sites[i];
            let (ax, ay) = (self.rights[i][0] - x, self.rights[i][1] - y);
            let (bx, by) = (self.lefts[i][0] - x, self.lefts[i][1] - y);
            let (a, b) = (ax.abs() + ay.abs(), bx.abs() + by.abs());
            let (value, error) = (ax * bx + ay * by, slack.part * (a * b) + slack.least * (a + b) + TINY);
            let is_near = a + b < HUGE;
            self.signs[i] = i8::from(is_near & (value > error)) - i8::from(is_near & (value < -error));
            is_short |= (ax == bx) & (ay == by);
        }
        is_short
    }
}

/// Sites, one of every edge, and which of them is the edge's own: edges come in runs that share one, and it is taken
/// once. After them stands the last one again.
fn distinct(edges: &[[i32; 2]], which: &mut [u8; TOGETHER]) -> [i32; TOGETHER] {
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
    found[count.min(TOGETHER)..].fill(last);
    found
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
