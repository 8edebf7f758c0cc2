//! Hairs that the noise of the samples explains, taken off an axis from their tips on.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::cost::distance;
use super::rings::{Line, Rings};
use super::rise::{Arc, Ring};
use super::tree::Tree;
use crate::error::Result;
use crate::graph::Point;
use crate::watch::Watch;

/// Fewest samples of a ring in which noise can be told from shape.
const FEWEST: usize = 100;
/// The part of the differences along a ring that noise alone is trusted with: corners make the largest ones.
const PART: f64 = 0.25;
/// That quantile of the size of a standard normal number.
const QUANTILE: f64 = 0.318_639_363_964_375_2;
/// Sites of an arc that are looked at.
const LOOKS: usize = 64;
/// Part of its ring beyond which an arc is no bump.
const BUMP: f64 = 0.25;

/// Noise of the samples across a line, one standard deviation; None for lines that are open or have few samples.
///
/// From the change of the curvature from each sample to the next, which is small on a smooth curve, however unevenly it
/// is sampled: of all of them the lower quartile, so that corners do not count.
pub(super) fn noise(line: &Line, sites: &[Point]) -> Option<f64> {
    let n = line.sites.len();
    if !line.closed || n < FEWEST {
        return None;
    }
    let place = |i: usize| sites[line.sites[i % n] as usize];
    let length = |i: usize| distance(place(i), place(i + 1));
    // Height of sample i + 1 over its neighbours, as it would be with even steps.
    let height = |i: usize| {
        let (a, b, c) = (place(i), place(i + 1), place(i + 2));
        let cross = (b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0]);
        cross / (length(i) * length(i + 1) * (length(i) + length(i + 1)))
    };
    let change = |i: usize| {
        let step = (length(i) + length(i + 1) + length(i + 2)) / 3.0;
        ((height(i + 1) - height(i)) * step * step).abs()
    };
    let mut changes: Vec<f64> = (0..n).map(change).filter(|change| change.is_finite()).collect();
    if changes.is_empty() {
        return Some(0.0);
    }
    let at = ((changes.len() - 1) as f64 * PART) as usize;
    let (_, &mut quartile, _) = changes.select_nth_unstable_by(at, f64::total_cmp);
    // Even steps: (-1, 3, -3, 1) / 2 of four samples, a variance of 5.
    Some(quartile / (QUANTILE * 5.0_f64.sqrt()))
}

/// A rise is sure if noise does not do that once in a whole line: by so many standard deviations more than the largest
/// of as many normal numbers as the line has samples is. 5 in all with 1000 samples; neither 4.5 nor 6 leave other tips
/// of noisy flowers.
const SURE: f64 = 1.3;

impl Rings<'_> {
    /// The axis, a mask of dual edges, without the tips that are bumps of the line: the one with the least residual
    /// goes first, as long as the line between the two sites of an edge rises above the circle about that end of it
    /// which is nearer to the rest of the axis by less than `least`.
    ///
    /// Edges whose sites are a quarter of their line apart stay, and so does all that is no tip: one component stays
    /// one.
    ///
    /// # Errors
    /// [`crate::Error::BadLength`], [`crate::Error::Interrupted`].
    pub fn without_bumps(&self, axis: &[bool], least: f64, watch: Watch<'_>) -> Result<Vec<bool>> {
        self.check("axis", axis)?;
        let least = self.scale.down([least, 0.0])[0];
        self.without_low(axis, |arc, centre| self.stays_below(arc, centre, least), watch)
    }

    /// The same by whether an arc is low over the circle about a place.
    pub(super) fn without_low(
        &self,
        axis: &[bool],
        is_low: impl Fn(&Arc, Point) -> bool,
        watch: Watch<'_>,
    ) -> Result<Vec<bool>> {
        let mut tree = Tree::of(self.view, axis);
        let queued = |k: u32| {
            let [p, q] = self.view.edges[k as usize].map(|site| site as usize);
            Reverse((self.residual(p, q).to_bits(), k))
        };
        let mut queue: BinaryHeap<_> = tree.tips().map(queued).collect();
        let mut steps = 0;
        while let Some(Reverse((bits, k))) = queue.pop() {
            watch.poll_at(steps)?;
            steps += 1;
            if !tree.kept[k as usize] {
                // The last edge of two is queued by both.
                continue;
            }
            let inner = tree.inner(k);
            let arc = self.arc(self.view.edges[k as usize]).filter(|_| f64::from_bits(bits) < BUMP);
            if arc.is_some_and(|arc| is_low(&arc, self.vertex(inner))) {
                tree.cut(k);
                queue.extend(tree.next_tip(inner).map(queued));
            }
        }
        Ok(tree.kept)
    }

    /// Whether noise may have raised an arc over the circle about `centre`; never where it is not known.
    pub(super) fn is_noise(&self, arc: &Arc, centre: Point, known: &[Option<Ring>]) -> bool {
        known[arc.line].as_ref().is_some_and(|ring| {
            let samples = self.lines[arc.line].sites.len() as f64;
            self.rise(arc, ring, centre) < SURE + (2.0 * libm::log(samples)).sqrt()
        })
    }

    /// Whether an arc stays within a height over the circle about `centre` through its ends. Looked at from its middle
    /// on: there it is highest as a rule.
    fn stays_below(&self, arc: &Arc, centre: Point, height: f64) -> bool {
        let line = &self.lines[arc.line].sites;
        let place = |steps: usize| self.sites[line[(arc.start + steps) % line.len()] as usize];
        let most = distance(centre, place(0)) + height;
        let looks = arc.count.min(LOOKS);
        (0..=looks + 1).all(|look| {
            // To both sides of the middle in turn: the answer is that of the arc the other way round.
            let off = look / 2 * arc.count / looks.max(1);
            let middle = arc.count / 2;
            let steps = if look % 2 == 0 { middle + arc.count % 2 + off } else { middle.saturating_sub(off) };
            distance(centre, place(steps.min(arc.count))) < most
        })
    }
}
