//! Curves through all samples: the one-step crust made a manifold that takes corners.
//!
//! A curve is a choice of candidate edges, at most two at a site, none across another. Its cost is small when edges are
//! short beside their surroundings, go straight on or turn in few places, and leave no end; see [`cost`](super::cost).
//! The search starts from the one-step crust. Where that is amiss, the sites about first agree on what would be cheapest
//! for all of them, see [`beliefs`](super::beliefs); then edges are exchanged along short trails, each of which begins
//! where something is amiss still.

use std::cmp::Ordering;

use super::beliefs::beliefs;
use super::candidates::Candidates;
use super::cost::{self, End, Turning};
use super::{one_step, spacing};
use crate::diagram::DiagramView;
use crate::diagram::scale::{Scale, largest};
use crate::error::Result;
use crate::graph::Point;
use crate::incidence::Incidence;
use crate::parallel;
use crate::watch::Watch;

/// Edges from a site that is amiss to those that have a say.
const REACH: usize = 6;
/// Exchanges a site may start: costs only fall, so this is never met but where rounding goes in a circle.
const EXCHANGES: usize = 20;

/// Whether each edge is part of the curve; no site has more than two of them. Turns weigh less than in [`curve_edges`]:
/// the rings of skeletons are to stay closed when samples are noisy.
///
/// # Errors
/// [`crate::Error::TooFewSites`], [`crate::Error::Collinear`], [`crate::Error::Interrupted`].
///
/// # Source
/// The idea that each sample wants two edges, cheap ones, is that of Ohrhallinger, Mudur: An Efficient Algorithm for
/// Determining an Aesthetic Shape Connecting Unorganized 2D Points (2013). That sites tell each other what an edge is
/// worth is the max-product algorithm of Bayati, Shah, Sharma: Max-Product for Maximum Weight Matching (2008); the
/// exchange along trails is that of Lin, Kernighan: An Effective Heuristic Algorithm for the Traveling-Salesman Problem
/// (1973). The costs are our own.
pub fn curve(view: DiagramView<'_>, watch: Watch<'_>) -> Result<Vec<bool>> {
    let crust = one_step(view)?;
    Ok(Draft::of(view, &crust, Candidates::of_diagram(view), cost::NOISY, watch)?.finished(watch)?.chosen)
}

/// The edges of a curve that may also pass between two sites across one edge of the diagram, as it does in narrow straits
/// with few samples: those of the diagram in its order, then those across. No two of them cross.
///
/// # Errors
/// [`crate::Error::TooFewSites`], [`crate::Error::Collinear`], [`crate::Error::Interrupted`].
pub fn curve_edges(view: DiagramView<'_>, watch: Watch<'_>) -> Result<Vec<[i32; 2]>> {
    let crust = one_step(view)?;
    let draft = Draft::of(view, &crust, Candidates::with_across(view, watch)?, cost::SPARSE, watch)?.finished(watch)?;
    let each = draft.net.edges.iter().zip(&draft.chosen);
    Ok(each.filter(|(_, chosen)| **chosen).map(|(&edge, _)| edge).collect())
}

/// A choice of edges that is being improved.
pub(super) struct Draft {
    sites: Vec<Point>,
    pub(super) net: Candidates,
    turning: Turning,
    lengths: Vec<f64>,
    /// Cost of every edge, were it chosen.
    pub(super) price: Vec<f64>,
    pub(super) chosen: Vec<bool>,
    /// How many edges are chosen at every site.
    pub(super) degrees: Vec<u32>,
    /// Cost of every site as it was before the trail at hand.
    pub(super) before: Vec<f64>,
    /// Sites with a change near them since a search began there.
    fresh: Vec<bool>,
    /// Exchanges left to every site.
    left: Vec<usize>,
    /// The round in which every site was last met by one that went about some.
    met: Vec<usize>,
    round: usize,
}

impl Draft {
    fn of(
        view: DiagramView<'_>,
        crust: &[bool],
        mut net: Candidates,
        turning: Turning,
        watch: Watch<'_>,
    ) -> Result<Self> {
        let scale = Scale::of(largest(view.sites));
        let sites: Vec<Point> = view.sites.iter().map(|&p| scale.down(p)).collect();
        watch.poll()?;
        let spacing = spacing::spacing(view, &sites, &Incidence::of(sites.len(), view.edges), crust, watch)?;
        let ends = |k: usize| net.edges[k].map(|end| end as usize);
        let length = |k: usize| {
            let [a, b] = ends(k);
            cost::distance(sites[a], sites[b])
        };
        let lengths = parallel::map_watched(net.edges.len(), length, watch)?;
        let price = |k: usize| {
            let [a, b] = ends(k);
            cost::edge(lengths[k], spacing[a], spacing[b])
        };
        let mut price = parallel::map_watched(net.edges.len(), price, watch)?;
        price[view.edges.len()..].iter_mut().for_each(|price| *price += cost::ACROSS);
        watch.poll()?;
        // The first exchange that helps is made, so what is tried first must not hang on how the sites are numbered.
        let sign = if turning.dearest_first { -1.0 } else { 1.0 };
        net.about.sort_by_value(|k| sign * price[k as usize]);
        let mut chosen = crust.to_vec();
        chosen.resize(net.edges.len(), false);
        let count = sites.len();
        Ok(Self {
            sites,
            net,
            turning,
            lengths,
            price,
            chosen,
            degrees: vec![0; count],
            before: vec![0.0; count],
            fresh: vec![true; count],
            left: vec![EXCHANGES; count],
            met: vec![0; count],
            round: 0,
        })
    }

    /// The curve with nothing left to improve.
    fn finished(mut self, watch: Watch<'_>) -> Result<Self> {
        self.agree(watch)?;
        self.settle(watch)?;
        loop {
            // Where nothing has changed since it was last looked at, nothing would be found.
            let mut amiss = self.amiss(|v| self.fresh[v], watch)?;
            if amiss.is_empty() {
                return Ok(self);
            }
            amiss.sort_by(|&a, &b| self.urgency(a, b));
            for v in amiss {
                watch.poll()?;
                self.fresh[v] = false;
                while self.left[v] > 0 && (self.exchange(v, true, watch)? || self.exchange(v, false, watch)?) {
                    self.left[v] -= 1;
                }
            }
        }
    }

    /// Takes note of degrees and costs as they stand.
    fn settle(&mut self, watch: Watch<'_>) -> Result<()> {
        for v in 0..self.sites.len() {
            watch.poll_at(v)?;
            self.degrees[v] = self.ends(v).count() as u32;
            self.before[v] = self.cost_at(v);
        }
        Ok(())
    }

    /// The chosen edges at a site.
    pub(super) fn ends(&self, v: usize) -> impl Iterator<Item = u32> {
        self.net.about.at(v).iter().copied().filter(|&k| self.chosen[k as usize])
    }

    /// An edge as seen from a site.
    fn end(&self, k: u32, v: usize) -> End {
        End::of(self.sites[v], self.sites[self.net.other(k, v)], self.lengths[k as usize])
    }

    pub(super) fn cost_at(&self, v: usize) -> f64 {
        let mut ends = self.ends(v).map(|k| self.end(k, v));
        cost::site([ends.next(), ends.next()], self.turning)
    }

    /// Whether the site has not two edges, turns sharply, or is on a small ring.
    fn is_amiss(&self, v: usize) -> bool {
        self.ends(v).count() != 2 || self.cost_at(v) > cost::SUSPECT || self.ring(v).is_some()
    }

    /// The sites amiss among some.
    fn amiss(&self, among: impl Fn(usize) -> bool, watch: Watch<'_>) -> Result<Vec<usize>> {
        let mut amiss = Vec::new();
        for v in 0..self.sites.len() {
            watch.poll_at(v)?;
            if among(v) && self.is_amiss(v) {
                amiss.push(v);
            }
        }
        Ok(amiss)
    }

    /// Which of two sites is looked at first: the dearer one, then the one whose edges are cheaper, compared in turn.
    fn urgency(&self, a: usize, b: usize) -> Ordering {
        let prices = |v: usize| self.net.about.at(v).iter().map(|&k| self.price[k as usize]);
        let by_price = || prices(a).partial_cmp(prices(b)).unwrap_or(Ordering::Equal);
        self.before[b].total_cmp(&self.before[a]).then_with(by_price)
    }

    /// A search is to begin anew at all sites from which a trail could pass one of these, but for one.
    pub(super) fn refresh(&mut self, mut last: Vec<usize>, but: usize) {
        self.round += 1;
        let (met, round) = (&mut self.met, self.round);
        let mut is_new = |v: usize| std::mem::replace(&mut met[v], round) != round;
        last.retain(|&v| is_new(v));
        for step in 0..=REACH {
            last.iter().for_each(|&v| self.fresh[v] = true);
            if step < REACH {
                last = last.iter().flat_map(|&v| self.net.beside(v)).filter(|&u| is_new(u)).collect();
            }
        }
        self.fresh[but] = false;
    }

    /// Lets all sites about those amiss agree on their edges.
    fn agree(&mut self, watch: Watch<'_>) -> Result<()> {
        let amiss = self.amiss(|_| true, watch)?;
        let active = self.net.reached(self.sites.len(), amiss, REACH, watch)?;
        let pair = |v: usize, ends: [u32; 2]| cost::site(ends.map(|k| Some(self.end(k, v))), self.turning);
        let worth = beliefs(&self.net, &self.price, &active, &self.chosen, pair, watch)?;
        let is_open = |k: &usize| self.net.edges[*k].iter().any(|&end| active[end as usize]);
        let mut order: Vec<usize> = (0..worth.len()).filter(is_open).collect();
        order.iter().for_each(|&k| self.chosen[k] = false);
        order.retain(|&k| worth[k] < 0.0);
        order.sort_by(|&a, &b| worth[a].total_cmp(&worth[b]));
        for (step, k) in order.into_iter().enumerate() {
            watch.poll_at(step)?;
            let is_full = self.net.edges[k].iter().any(|&end| self.ends(end as usize).count() > 1);
            self.chosen[k] = !is_full && !self.net.is_barred(k as u32, &self.chosen);
        }
        Ok(())
    }
}
