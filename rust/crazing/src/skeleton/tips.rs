//! Tips that pruning cut shorter than the noise of the samples asks for, let grow again.

use super::cost::distance;
use super::peel::peeled;
use super::rings::Rings;
use super::rise::Ring;
use super::tree::Tree;
use crate::error::Result;
use crate::watch::Watch;

/// Least rise, in standard deviations, above the circle about the end that an edge goes on from: one noise exceeds in
/// 1 of 160 cases. The way of a tip has a few of them, where whole lines are in question while bumps are cut.
const ON: f64 = 2.5;
/// The same about the vertex where a tip comes to rest: its circle has taken up most of the rise.
const REST: f64 = 1.0;
/// There also the least sine of half the angle at which a vertex sees its two sites: noise of the samples displaces it
/// sideways by the inverse, 2.5 times. On its way a tip passes no vertex of half of that: there sites of two sides of a
/// torn ring are near each other.
const SINE: f64 = 0.4;
/// Steps of the least arc over which a tip grows: the means over its ends are then of 3 samples, that over its middle
/// of 6. With 8 one of a hundred noisy curves has a tip that goes astray by ten times the noise, with 12 none.
const STEPS: usize = 12;

impl Rings<'_> {
    /// The axis, a mask of dual edges, without hairs: what spans less than a part of its line goes, then the tips that
    /// noise of the samples may have raised, and those that are left grow again as far as it lets them.
    ///
    /// What crosses a ring holds nothing together: it stays if it spans as much.
    ///
    /// # Errors
    /// [`crate::Error::BadLength`], [`crate::Error::Interrupted`].
    pub fn without_hairs(&self, axis: &[bool], least: f64, watch: Watch<'_>) -> Result<Vec<bool>> {
        self.check("axis", axis)?;
        let (worth, known) = (self.residuals(), self.known());
        let peel = |axis: &[bool]| -> Result<Vec<bool>> {
            let found = peeled(self.view, &self.open(axis), &worth, least, watch)?;
            let stays = |k: usize| found[k] || (axis[k] && self.wall[k] && worth[k] >= least);
            Ok((0..found.len()).map(stays).collect())
        };
        let kept = self.without_low(&peel(axis)?, |arc, centre| self.is_noise(arc, centre, &known), watch)?;
        // What a bump held on to may be a hair.
        self.longer(axis, &peel(&kept)?, &known, watch)
    }

    /// `kept`, a part of the axis, with every tip grown outwards, one way each, as long as the line rises above the
    /// circles of the axis by more than noise explains.
    ///
    /// At a fork the edge with the greatest residual is taken; what is kept already is not run into. So there is no new
    /// tip, cycle or component.
    ///
    /// # Errors
    /// [`crate::Error::BadLength`], [`crate::Error::Interrupted`].
    pub fn grown(&self, axis: &[bool], kept: &[bool], watch: Watch<'_>) -> Result<Vec<bool>> {
        self.check("axis", axis)?;
        self.check("kept", kept)?;
        self.longer(axis, kept, &self.known(), watch)
    }

    fn longer(&self, axis: &[bool], kept: &[bool], known: &[Option<Ring>], watch: Watch<'_>) -> Result<Vec<bool>> {
        let mut growth = Growth { rings: self, known, tree: Tree::of(self.view, &self.open(axis)) };
        for (k, kept) in kept.iter().enumerate() {
            if growth.tree.kept[k] && growth.tree.is_drawn(k) && !kept {
                growth.tree.cut(k as u32);
            }
        }
        let tips: Vec<u32> = growth.tree.tips().collect();
        for (step, &k) in tips.iter().enumerate() {
            watch.poll_at(step)?;
            for tip in growth.tree.duals[k as usize] {
                if growth.tree.is_tip(tip) {
                    growth.grow(tip);
                }
            }
        }
        let grown = |k: usize| growth.tree.is_drawn(k) && growth.tree.kept[k];
        Ok(kept.iter().enumerate().map(|(k, &kept)| kept || grown(k)).collect())
    }

    /// A mask without the edges between whose ends a ring passes.
    fn open(&self, axis: &[bool]) -> Vec<bool> {
        axis.iter().zip(&self.wall).map(|(axis, wall)| axis & !wall).collect()
    }

    /// The lines of which the noise is known.
    pub(super) fn known(&self) -> Vec<Option<Ring>> {
        self.lines.iter().zip(&self.along).map(|(line, along)| Ring::of(line, along, &self.sites)).collect()
    }
}

struct Growth<'a> {
    rings: &'a Rings<'a>,
    known: &'a [Option<Ring>],
    tree: Tree,
}

impl Growth<'_> {
    /// Lets one tip grow, and takes back what lies beyond the last vertex where it may come to rest.
    fn grow(&mut self, tip: i32) {
        let (mut way, mut good, mut at) = (Vec::new(), 0, tip);
        while let Some(k) = self.outward(at).filter(|&k| self.rise(k, at).is_some_and(|rise| rise >= ON)) {
            let [a, b] = self.tree.duals[k as usize];
            at = if a == at { b } else { a };
            self.tree.join(k);
            way.push(k);
            let sine = self.sine(k, at);
            if sine < SINE / 2.0 {
                break;
            }
            if sine >= SINE && self.rise(k, at).is_some_and(|rise| rise >= REST) {
                good = way.len();
            }
        }
        for &k in &way[good..] {
            self.tree.cut(k);
        }
    }

    /// Of the edges at a vertex that lead to where nothing is kept, the one with the greatest residual.
    fn outward(&self, v: i32) -> Option<u32> {
        let residual = |k: u32| {
            let [p, q] = self.rings.view.edges[k as usize];
            self.rings.residual(p as usize, q as usize)
        };
        let free = self.tree.left_out(v);
        free.reduce(|best, k| if residual(k) > residual(best) { k } else { best })
    }

    /// None over an arc that is too short to tell, or of a line whose noise is not known.
    fn rise(&self, k: u32, centre: i32) -> Option<f64> {
        let arc = self.rings.arc(self.rings.view.edges[k as usize]).filter(|arc| arc.count >= STEPS)?;
        let ring = self.known[arc.line].as_ref()?;
        Some(self.rings.rise(&arc, ring, self.rings.vertex(centre as usize)))
    }

    /// The sine of half the angle at which a vertex sees the two sites of an edge.
    fn sine(&self, k: u32, v: i32) -> f64 {
        let [p, q] = self.rings.view.edges[k as usize].map(|site| self.rings.sites[site as usize]);
        distance(p, q) / (2.0 * distance(p, self.rings.vertex(v as usize)))
    }
}
