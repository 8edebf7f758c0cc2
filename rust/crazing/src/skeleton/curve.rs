//! Curves through all samples: the one-step crust made a manifold that takes corners.
//!
//! A curve is a choice of Delaunay edges, at most two at a site. Its cost is small when edges are short beside their
//! surroundings, go straight on or turn in few places, and leave no end; see [`cost`](super::cost). The search starts
//! from the one-step crust and exchanges edges along short trails, each of which begins where something is amiss.

use super::cost::{self, End};
use super::{one_step, spacing};
use crate::diagram::DiagramView;
use crate::diagram::scale::{Scale, largest};
use crate::error::Result;
use crate::graph::Point;
use crate::incidence::Incidence;
use crate::watch::Watch;

/// Most edges of a trail. Longer ones found nothing more on the silhouettes the costs were set on.
const TRAIL: usize = 6;
/// Gains below this are rounding.
const GAIN: f64 = 1e-9;
/// Exchanges a site may start: costs only fall, so this is never met but where rounding goes in a circle.
const EXCHANGES: usize = 20;

/// Whether each edge is part of the curve; no site has more than two of them.
///
/// # Errors
/// [`crate::Error::TooFewSites`], [`crate::Error::Collinear`], [`crate::Error::Interrupted`].
///
/// # Source
/// The idea that each sample wants two edges, cheap ones, is that of Ohrhallinger, Mudur: An Efficient Algorithm for
/// Determining an Aesthetic Shape Connecting Unorganized 2D Points (2013); the exchange along trails is that of Lin,
/// Kernighan: An Effective Heuristic Algorithm for the Traveling-Salesman Problem (1973). The costs are our own.
pub fn curve(view: DiagramView<'_>, watch: Watch<'_>) -> Result<Vec<bool>> {
    let crust = one_step(view)?;
    let mut draft = Draft::of(view, &crust);
    let mut amiss: Vec<usize> = (0..draft.sites.len()).filter(|&v| draft.is_amiss(v)).collect();
    let doubtful: Vec<usize> = amiss.iter().copied().filter(|&v| draft.ends(v).count() != 2).collect();
    draft.thin(&crust);
    draft.settle();
    while !amiss.is_empty() {
        for &v in &amiss {
            watch.poll()?;
            draft.improve(v);
        }
        // Where nothing has changed since it was last looked at, nothing would be found.
        let fresh = |v: &usize| draft.fresh[*v];
        let again = (0..draft.sites.len()).filter(fresh).filter(|&v| draft.is_amiss(v));
        amiss = again.chain(doubtful.iter().copied().filter(fresh)).collect();
        amiss.sort_unstable();
        amiss.dedup();
    }
    Ok(draft.chosen)
}

/// A choice of edges that is being improved.
struct Draft<'a> {
    view: DiagramView<'a>,
    sites: Vec<Point>,
    about: Incidence,
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
struct Trail {
    edges: Vec<u32>,
    sites: Vec<usize>,
}

impl<'a> Draft<'a> {
    fn of(view: DiagramView<'a>, crust: &[bool]) -> Self {
        let scale = Scale::of(largest(view.sites));
        let sites: Vec<Point> = view.sites.iter().map(|&p| scale.down(p)).collect();
        let about = Incidence::of(sites.len(), view.edges);
        let spacing = spacing::spacing(view, &sites, &about, crust);
        let price = |&[a, b]: &[i32; 2]| {
            let (a, b) = (a as usize, b as usize);
            cost::edge(cost::distance(sites[a], sites[b]), spacing[a], spacing[b])
        };
        let price = view.edges.iter().map(price).collect();
        let count = sites.len();
        Self {
            view,
            sites,
            about,
            price,
            chosen: crust.to_vec(),
            degrees: vec![0; count],
            before: vec![0.0; count],
            fresh: vec![true; count],
            left: vec![EXCHANGES; count],
        }
    }

    /// Takes note of degrees and costs as they stand.
    fn settle(&mut self) {
        for v in 0..self.sites.len() {
            self.degrees[v] = self.ends(v).count() as u32;
            self.before[v] = self.cost_at(v);
        }
    }

    fn other(&self, k: u32, v: usize) -> usize {
        let [a, b] = self.view.edges[k as usize].map(|end| end as usize);
        if a == v { b } else { a }
    }

    /// The chosen edges at a site.
    fn ends(&self, v: usize) -> impl Iterator<Item = u32> {
        self.about.at(v).iter().copied().filter(|&k| self.chosen[k as usize])
    }

    fn cost_at(&self, v: usize) -> f64 {
        let place = |k: u32| End::of(self.sites[v], self.sites[self.other(k, v)]);
        let mut ends = self.ends(v);
        cost::site([ends.next().map(place), ends.next().map(place)])
    }

    fn is_amiss(&self, v: usize) -> bool {
        self.ends(v).count() != 2 || self.cost_at(v) > cost::SUSPECT
    }

    /// Drops the dearest edges between sites that have too many, then those at either one.
    fn thin(&mut self, crust: &[bool]) {
        let mut order: Vec<usize> = (0..crust.len()).filter(|&k| crust[k]).collect();
        order.sort_by(|&a, &b| self.price[b].total_cmp(&self.price[a]));
        for both in [true, false] {
            for &k in &order {
                let [a, b] = self.view.edges[k].map(|end| self.ends(end as usize).count() > 2);
                self.chosen[k] &= !(if both { a && b } else { a || b });
            }
        }
    }

    /// Makes exchanges that begin at a site until none helps.
    fn improve(&mut self, v: usize) {
        self.fresh[v] = false;
        while self.left[v] > 0 && (self.exchange(v, true) || self.exchange(v, false)) {
            self.left[v] -= 1;
        }
    }

    fn exchange(&mut self, v: usize, add: bool) -> bool {
        let mut trail = Trail { edges: Vec::with_capacity(TRAIL), sites: vec![v] };
        let found = self.walk(v, add, -self.before[v], &mut trail);
        if found {
            for &v in &trail.sites {
                self.before[v] = self.cost_at(v);
            }
            self.freshen(&trail);
            self.fresh[v] = false;
        }
        found
    }

    /// Marks all sites from which a trail could pass those of this one.
    fn freshen(&mut self, trail: &Trail) {
        let mut reached = trail.sites.clone();
        reached.sort_unstable();
        reached.dedup();
        let mut seen: std::collections::BTreeSet<usize> = reached.iter().copied().collect();
        for _ in 0..TRAIL {
            let around = reached.iter().flat_map(|&v| self.about.at(v).iter().map(move |&k| (k, v)));
            let ahead: Vec<usize> = around.map(|(k, v)| self.other(k, v)).collect();
            reached = ahead.into_iter().filter(|&u| seen.insert(u)).collect();
        }
        seen.into_iter().for_each(|v| self.fresh[v] = true);
    }

    /// Goes on from the last site of the trail with an edge to add or to drop; true, with the edges exchanged, as soon
    /// as that makes the curve cheaper, false with everything as it was. `spent` is the price of the edges so far, less
    /// what the sites passed have cost.
    fn walk(&mut self, v: usize, add: bool, spent: f64, trail: &mut Trail) -> bool {
        if trail.edges.len() == TRAIL {
            return false;
        }
        for i in 0..self.about.at(v).len() {
            let k = self.about.at(v)[i];
            if self.chosen[k as usize] == add || trail.edges.contains(&k) {
                continue;
            }
            let u = self.other(k, v);
            let price = if add { self.price[k as usize] } else { -self.price[k as usize] };
            let spent = spent + price - if trail.sites.contains(&u) { 0.0 } else { self.before[u] };
            self.switch(k);
            trail.edges.push(k);
            trail.sites.push(u);
            let full = self.degrees[u];
            if self.helps(spent, trail) || (full <= 3 && self.walk(u, !add, spent, trail)) {
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
        for end in self.view.edges[k as usize] {
            self.degrees[end as usize] = self.degrees[end as usize].wrapping_add_signed(if chosen { 1 } else { -1 });
        }
    }

    /// Whether the exchange leaves no site with three edges and costs less than it saves.
    fn helps(&mut self, spent: f64, trail: &Trail) -> bool {
        if spent >= -GAIN || trail.sites.iter().any(|&v| self.degrees[v] > 2) {
            return false;
        }
        let mut sum = spent;
        for (i, &v) in trail.sites.iter().enumerate() {
            if !trail.sites[..i].contains(&v) {
                sum += self.cost_at(v);
                // Costs are positive: what is lost by now stays lost.
                if sum >= -GAIN {
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
    fn turn(&mut self, trail: &Trail) {
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
            at = self.other(last, at);
            if at == v {
                return Some(ring);
            }
            ring.push(at);
        }
        None
    }
}
