//! Curves through all samples: the one-step crust made a manifold that takes corners.
//!
//! A curve is a choice of candidate edges, at most two at a site, none across another. Its cost is small when edges are
//! short beside their surroundings, go straight on or turn in few places, and leave no end; see [`cost`](super::cost).
//! The search starts from the one-step crust. Where that is amiss, the sites about first agree on what would be cheapest
//! for all of them, see [`beliefs`](super::beliefs); then edges are exchanged along short trails, each of which begins
//! where something is amiss still.

use super::beliefs::beliefs;
use super::candidates::Candidates;
use super::cost::{self, End, Turning};
use super::{one_step, spacing};
use crate::diagram::DiagramView;
use crate::diagram::scale::{Scale, largest};
use crate::error::{Error, Result};
use crate::graph::Point;
use crate::incidence::Incidence;
use crate::watch::Watch;

/// Most edges of a trail. Longer ones find little more for twice the time.
const TRAIL: usize = 8;
/// What a trail may have lost while it goes on, beside what the site at its end costs.
const SLACK: f64 = 1.0;
/// Edges from a site that is amiss to those that have a say.
const REACH: usize = 6;
/// Gains below this are rounding.
const GAIN: f64 = 1e-9;
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
    Ok(Draft::of(view, &crust, Candidates::of_diagram(view), cost::NOISY).finished(watch)?.chosen)
}

/// The edges of a curve that may also pass between two sites across one edge of the diagram, as it does in narrow straits
/// with few samples: those of the diagram in its order, then those across. No two of them cross.
///
/// # Errors
/// [`crate::Error::TooFewSites`], [`crate::Error::Collinear`], [`crate::Error::Interrupted`].
pub fn curve_edges(view: DiagramView<'_>, watch: Watch<'_>) -> Result<Vec<[i32; 2]>> {
    let crust = one_step(view)?;
    let draft = Draft::of(view, &crust, Candidates::with_across(view), cost::SPARSE).finished(watch)?;
    let each = draft.net.edges.iter().zip(&draft.chosen);
    Ok(each.filter(|(_, chosen)| **chosen).map(|(&edge, _)| edge).collect())
}

/// A choice of edges that is being improved.
struct Draft {
    sites: Vec<Point>,
    net: Candidates,
    turning: Turning,
    /// Cost of every edge, were it chosen.
    price: Vec<f64>,
    chosen: Vec<bool>,
    /// How many edges are chosen at every site.
    degrees: Vec<u32>,
    /// Cost of every site as it was before the trail at hand.
    before: Vec<f64>,
    /// Sites with a change near them since a search began there.
    fresh: Vec<bool>,
    /// Exchanges left to every site.
    left: Vec<usize>,
}

/// Edges exchanged in turn, from one site on, and the sites they pass.
struct Trail<'a> {
    watch: Watch<'a>,
    /// Whether to go on; where not, nothing is put back.
    go_on: bool,
    edges: Vec<u32>,
    sites: Vec<usize>,
    /// Cost of the small ring it begins on, which it may open.
    credit: f64,
}

impl Draft {
    fn of(view: DiagramView<'_>, crust: &[bool], net: Candidates, turning: Turning) -> Self {
        let scale = Scale::of(largest(view.sites));
        let sites: Vec<Point> = view.sites.iter().map(|&p| scale.down(p)).collect();
        let spacing = spacing::spacing(view, &sites, &Incidence::of(sites.len(), view.edges), crust);
        let price = |&[a, b]: &[i32; 2]| {
            let (a, b) = (a as usize, b as usize);
            cost::edge(cost::distance(sites[a], sites[b]), spacing[a], spacing[b])
        };
        let mut price: Vec<f64> = net.edges.iter().map(price).collect();
        price[view.edges.len()..].iter_mut().for_each(|price| *price += cost::ACROSS);
        let mut chosen = crust.to_vec();
        chosen.resize(net.edges.len(), false);
        let count = sites.len();
        Self {
            sites,
            net,
            turning,
            price,
            chosen,
            degrees: vec![0; count],
            before: vec![0.0; count],
            fresh: vec![true; count],
            left: vec![EXCHANGES; count],
        }
    }

    /// The curve with nothing left to improve.
    fn finished(mut self, watch: Watch<'_>) -> Result<Self> {
        self.agree(watch)?;
        self.settle();
        loop {
            // Where nothing has changed since it was last looked at, nothing would be found.
            let amiss = self.amiss(|v| self.fresh[v], watch)?;
            if amiss.is_empty() {
                return Ok(self);
            }
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
    fn settle(&mut self) {
        for v in 0..self.sites.len() {
            self.degrees[v] = self.ends(v).count() as u32;
            self.before[v] = self.cost_at(v);
        }
    }

    /// The chosen edges at a site.
    fn ends(&self, v: usize) -> impl Iterator<Item = u32> {
        self.net.about.at(v).iter().copied().filter(|&k| self.chosen[k as usize])
    }

    /// An edge as seen from a site.
    fn end(&self, k: u32, v: usize) -> End {
        End::of(self.sites[v], self.sites[self.net.other(k, v)])
    }

    fn cost_at(&self, v: usize) -> f64 {
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

    /// Makes an exchange that begins at a site, if one helps.
    fn exchange(&mut self, v: usize, add: bool, watch: Watch<'_>) -> Result<bool> {
        let credit = self.rings(&[v]);
        let mut trail = Trail { watch, go_on: true, edges: Vec::with_capacity(TRAIL), sites: vec![v], credit };
        let found = self.walk(v, add, -self.before[v], 0.0, &mut trail);
        if !trail.go_on {
            return Err(Error::Interrupted);
        }
        if found {
            for &v in &trail.sites {
                self.before[v] = self.cost_at(v);
            }
            // All sites from which a trail could pass those of this one.
            self.net.around(trail.sites, REACH).into_iter().for_each(|v| self.fresh[v] = true);
            self.fresh[v] = false;
        }
        Ok(found)
    }

    /// Goes on from the last site of the trail with an edge to add or to drop; true, with the edges exchanged, as soon
    /// as that makes the curve cheaper, false with everything as it was. `spent` is the price of the edges so far, less
    /// what the sites passed have cost.
    fn walk(&mut self, v: usize, add: bool, spent: f64, passed: f64, trail: &mut Trail<'_>) -> bool {
        if trail.edges.len() >= TRAIL {
            return false;
        }
        // Where samples are no curve, a site may begin seconds of trails.
        if trail.edges.len() == TRAIL / 4 && trail.watch.poll().is_err() {
            trail.go_on = false;
            return true;
        }
        for i in 0..self.net.about.at(v).len() {
            let k = self.net.about.at(v)[i];
            if self.chosen[k as usize] == add || trail.edges.contains(&k) {
                continue;
            }
            if add && self.net.is_barred(k, &self.chosen) {
                continue;
            }
            let u = self.net.other(k, v);
            let price = if add { self.price[k as usize] } else { -self.price[k as usize] };
            let spent = spent + price - if trail.sites.contains(&u) { 0.0 } else { self.before[u] };
            self.switch(k);
            trail.edges.push(k);
            trail.sites.push(u);
            let full = self.degrees[u];
            let passed = passed + self.cost_at(v);
            let hopeful = full <= 3 && spent + passed < trail.credit + SLACK;
            if self.helps(spent, trail) || (hopeful && self.walk(u, !add, spent, passed, trail)) {
                return true;
            }
            trail.sites.pop();
            trail.edges.pop();
            self.switch(k);
        }
        false
    }

    /// Chooses an edge, or drops it.
    fn switch(&mut self, k: u32) {
        let chosen = !self.chosen[k as usize];
        self.chosen[k as usize] = chosen;
        for end in self.net.edges[k as usize] {
            self.degrees[end as usize] = self.degrees[end as usize].wrapping_add_signed(if chosen { 1 } else { -1 });
        }
    }

    /// Whether the exchange leaves no site with three edges and costs less than it saves.
    fn helps(&mut self, spent: f64, trail: &Trail<'_>) -> bool {
        if spent >= trail.credit - GAIN || trail.sites.iter().any(|&v| self.degrees[v] > 2) {
            return false;
        }
        let mut sum = spent;
        for (i, &v) in trail.sites.iter().enumerate() {
            if !trail.sites[..i].contains(&v) {
                sum += self.cost_at(v);
                // Costs are positive: what is lost by now stays lost.
                if sum >= trail.credit - GAIN {
                    return false;
                }
            }
        }
        let after = self.rings(&trail.sites);
        self.turn(trail);
        let before = self.rings(&trail.sites);
        self.turn(trail);
        sum + after - before < -GAIN
    }

    /// Exchanges the edges of a trail, or takes that back.
    fn turn(&mut self, trail: &Trail<'_>) {
        for &k in &trail.edges {
            self.switch(k);
        }
    }

    /// Cost of the small rings through any of the sites.
    fn rings(&self, sites: &[usize]) -> f64 {
        let mut seen: Vec<usize> = Vec::new();
        let mut sum = 0.0;
        for &v in sites {
            if !seen.contains(&v)
                && let Some(ring) = self.ring(v)
            {
                sum += cost::ring(ring.len());
                seen.extend(ring);
            }
        }
        sum
    }

    /// The sites of the ring through `v`, if it is a small one.
    fn ring(&self, v: usize) -> Option<Vec<usize>> {
        let (mut ring, mut at, mut last) = (vec![v], v, u32::MAX);
        while ring.len() < cost::RING_FREE {
            last = self.ends(at).find(|&k| k != last)?;
            at = self.net.other(last, at);
            if at == v {
                return Some(ring);
            }
            ring.push(at);
        }
        None
    }
}
