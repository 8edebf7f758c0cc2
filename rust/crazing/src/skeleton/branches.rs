//! Short branches taken off an axis, the least one first.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::cost::distance;
use crate::error::{Error, Result};
use crate::graph::{Point, degrees};
use crate::incidence::Incidence;
use crate::watch::Watch;

/// How a branch, from its tip to the junction it hangs on, is measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Measure {
    /// By its length.
    Length,
    /// By how far the discs about it reach beyond the one at its junction: length plus radius at the tip, over the
    /// radius at the junction. 1 where it adds nothing.
    Radius,
}

/// Which edges are left when branches that measure less than `least` are taken off, the least one first, each time
/// measuring anew what has grown together. Lines without a junction stay.
///
/// # Errors
/// [`Error::BadIndex`], [`Error::BadLength`], [`Error::Interrupted`].
pub fn branches(
    vertices: &[Point],
    edges: &[[i32; 2]],
    radius: &[f64],
    measure: Measure,
    least: f64,
    watch: Watch<'_>,
) -> Result<Vec<bool>> {
    let degrees = degrees(vertices.len(), edges, watch)?;
    if radius.len() != vertices.len() {
        return Err(Error::BadLength { array: "radius", found: radius.len(), wanted: vertices.len() });
    }
    let about = Incidence::of(vertices.len(), edges);
    let mut tree = Tree { vertices, edges, radius, about, degrees, kept: vec![true; edges.len()] };
    let tips = (0..vertices.len()).filter(|&v| tree.degrees[v] == 1);
    let mut queue: BinaryHeap<Reverse<(u64, usize)>> =
        tips.filter_map(|tip| tree.measure(tip, measure)).filter(|m| m.0 < least).map(queued).collect();
    let mut steps = 0;
    while let Some(Reverse((bits, tip))) = queue.pop() {
        watch.poll_at(steps)?;
        steps += 1;
        // Measured when it was queued: it may have grown or gone since.
        match tree.measure(tip, measure) {
            Some(now) if now.0.to_bits() == bits => {
                let junction = tree.cut(tip);
                let grown = if tree.degrees[junction] == 2 { tree.tips_from(junction) } else { Vec::new() };
                let again = grown.into_iter().filter_map(|tip| tree.measure(tip, measure));
                queue.extend(again.filter(|m| m.0 < least).map(queued));
            }
            _ => {}
        }
    }
    Ok(tree.kept)
}

/// Sizes are not negative, and the bits of such numbers are in their order.
fn queued((size, tip): (f64, usize)) -> Reverse<(u64, usize)> {
    Reverse((size.to_bits(), tip))
}

struct Tree<'a> {
    vertices: &'a [Point],
    edges: &'a [[i32; 2]],
    radius: &'a [f64],
    about: Incidence,
    degrees: Vec<i32>,
    kept: Vec<bool>,
}

impl Tree<'_> {
    fn other(&self, k: u32, v: usize) -> usize {
        let [a, b] = self.edges[k as usize].map(|end| end as usize);
        if a == v { b } else { a }
    }

    /// The edges from `v` by its edge `k` on to the next vertex that has not two, and that vertex.
    fn walk(&self, v: usize, k: u32) -> (Vec<u32>, usize) {
        let (mut way, mut at) = (vec![k], self.other(k, v));
        while self.degrees[at] == 2 && at != v {
            let last = way[way.len() - 1];
            let Some(next) = self.about.at(at).iter().find(|&&k| self.kept[k as usize] && k != last) else { break };
            way.push(*next);
            at = self.other(*next, at);
        }
        (way, at)
    }

    fn leaving(&self, v: usize) -> impl Iterator<Item = u32> {
        self.about.at(v).iter().copied().filter(|&k| self.kept[k as usize])
    }

    /// The branch that ends in a tip, measured; None when the tip is gone or there is no junction.
    fn measure(&self, tip: usize, measure: Measure) -> Option<(f64, usize)> {
        let k = self.leaving(tip).next().filter(|_| self.degrees[tip] == 1)?;
        let (way, junction) = self.walk(tip, k);
        let ends = |&k: &u32| self.edges[k as usize].map(|end| self.vertices[end as usize]);
        let length: f64 = way.iter().map(ends).map(|[a, b]| distance(a, b)).sum();
        let size = match measure {
            Measure::Length => length,
            Measure::Radius => (length + self.radius[tip]) / self.radius[junction],
        };
        (self.degrees[junction] > 2).then_some((size, tip))
    }

    /// Takes the branch off; gives its junction.
    fn cut(&mut self, tip: usize) -> usize {
        let Some(k) = self.leaving(tip).next() else { return tip };
        let (way, junction) = self.walk(tip, k);
        for k in way {
            self.kept[k as usize] = false;
            self.edges[k as usize].iter().for_each(|&end| self.degrees[end as usize] -= 1);
        }
        junction
    }

    /// The tips at the ends of the line through a vertex that is no junction any more.
    fn tips_from(&self, v: usize) -> Vec<usize> {
        self.leaving(v).map(|k| self.walk(v, k).1).filter(|&end| self.degrees[end] == 1).collect()
    }
}
