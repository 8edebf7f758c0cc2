//! Hairs that the noise of the samples explains, taken off an axis from their tips on.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::cost::distance;
use super::rings::{Line, Rings};
use super::tree::Tree;
use crate::diagram::scale::{Scale, largest};
use crate::error::{Error, Result};
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

/// Noise of the samples across each line, one standard deviation; 0 for lines that are open or have few samples.
///
/// From the change of the curvature from each sample to the next, which is small on a smooth curve, however unevenly it
/// is sampled: of all of them the lower quartile, so that corners do not count.
pub(super) fn noise(line: &Line, sites: &[Point]) -> f64 {
    let n = line.sites.len();
    if !line.closed || n < FEWEST {
        return 0.0;
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
        return 0.0;
    }
    let at = ((changes.len() - 1) as f64 * PART) as usize;
    let (_, &mut quartile, _) = changes.select_nth_unstable_by(at, f64::total_cmp);
    // Even steps: (-1, 3, -3, 1) / 2 of four samples, a variance of 5.
    quartile / (QUANTILE * 5.0_f64.sqrt())
}

impl Rings<'_> {
    /// The axis, a mask of dual edges, without the tips that are bumps of the line: the one with the least residual
    /// goes first, as long as the line between the two sites of an edge rises above the circle about that end of it
    /// which is nearer to the rest of the axis by less than `least`, or than `levels` times the noise of the line.
    ///
    /// Edges whose sites are a quarter of their line apart stay, and so does all that is no tip: one component stays
    /// one.
    ///
    /// # Errors
    /// [`Error::BadLength`], [`Error::Interrupted`].
    pub fn without_bumps(&self, axis: &[bool], least: f64, levels: f64, watch: Watch<'_>) -> Result<Vec<bool>> {
        let (found, wanted) = (axis.len(), self.view.edges.len());
        if found != wanted {
            return Err(Error::BadLength { array: "axis", found, wanted });
        }
        let scale = Scale::of(largest(self.view.sites));
        let least = scale.down([least, 0.0])[0];
        let heights: Vec<f64> = self.lines.iter().map(|line| least.max(levels * noise(line, &self.sites))).collect();
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
            let inner = tree.inner(k);
            let centre = scale.down(self.view.vertices[inner]);
            if f64::from_bits(bits) < BUMP && self.is_bump(self.view.edges[k as usize], centre, &heights) {
                tree.cut(k);
                queue.extend(tree.next_tip(inner).map(queued));
            }
        }
        Ok(tree.kept)
    }

    /// Whether the shorter arc between two sites of a line stays within its height over the circle about `centre`
    /// through both. Looked at from its middle on: there it is highest as a rule.
    fn is_bump(&self, [p, q]: [i32; 2], centre: Point, heights: &[f64]) -> bool {
        let (a, b) = (self.stands[p as usize], self.stands[q as usize]);
        let line = &self.lines[a.line as usize].sites;
        let (from, to) = (a.place.min(b.place) as usize, a.place.max(b.place) as usize);
        let along = &self.along[a.line as usize];
        // The other way round begins at the later one.
        let round = self.lines[a.line as usize].closed && 2.0 * (along[to] - along[from]) > along[along.len() - 1];
        let (start, count) = if round { (to, line.len() - to + from) } else { (from, to - from) };
        let most = distance(centre, self.sites[p as usize]) + heights[a.line as usize];
        let looks = count.min(LOOKS);
        (0..=looks).all(|look| {
            // 0, 1, -1, 2, -2 steps from the middle.
            let off = look.div_ceil(2) * count / looks.max(1);
            let place = if look % 2 == 0 { count / 2 + count % 2 + off } else { (count / 2).saturating_sub(off) };
            distance(centre, self.sites[line[(start + place.min(count)) % line.len()] as usize]) < most
        })
    }
}
