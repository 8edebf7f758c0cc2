//! Exchanges that make a curve cheaper: along short trails, an edge added and the next dropped in turn.

use super::cost;
use super::curve::Draft;
use crate::error::{Error, Result};
use crate::watch::Watch;

/// Most edges of a trail. Longer ones find little more for twice the time.
const TRAIL: usize = 8;
/// What a trail may have lost while it goes on, beside what the site at its end costs.
const SLACK: f64 = 1.0;
/// Gains below this are rounding.
const GAIN: f64 = 1e-9;

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
    /// Makes an exchange that begins at a site, if one helps.
    pub(super) fn exchange(&mut self, v: usize, add: bool, watch: Watch<'_>) -> Result<bool> {
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
            self.refresh(trail.sites, v);
        }
        Ok(found)
    }

    /// Goes on from the last site of the trail with an edge to add or to drop; true, with the edges exchanged, as soon
    /// as that makes the curve cheaper, false with everything as it was. `spent` is the price of the edges so far, less
    /// what the sites passed have cost.
    fn walk(&mut self, v: usize, add: bool, spent: f64, passed: f64, trail: &mut Trail<'_>) -> bool {
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
            // Costs are positive: the site left behind need not be looked at where all is lost without it.
            let mut hopeful = trail.edges.len() < TRAIL && self.degrees[u] <= 3;
            let mut passed = passed;
            if hopeful && spent + passed < trail.credit + SLACK {
                passed += self.cost_at(v);
            }
            hopeful &= spent + passed < trail.credit + SLACK;
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
    pub(super) fn ring(&self, v: usize) -> Option<Vec<usize>> {
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
