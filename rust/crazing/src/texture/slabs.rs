//! The edges that rays to the left may meet, in the plane: slabs between rays, and in each the edges in their order.
//!
//! Edges that do not cross keep their order from ray to ray, so that the one a ray meets first is found by halving. A
//! slab holds the edges that pass all of its rays; slabs of one ray, two, four and so on hold every edge in few of them.

use super::faces::{Net, less};
use super::rays::{ASIDE, Hit, better, crossing};
use crate::error::Result;
use crate::graph::Point;
use crate::watch::Watch;

/// Slabs of rays: slab `p` is made of slabs `2 p` and `2 p + 1`, those of one ray begin at `count`.
pub(super) struct Slabs {
    /// Where the rays run, from the bottom up.
    rays: Vec<f64>,
    /// A power of two, no less than the number of rays.
    count: usize,
    starts: Vec<usize>,
    /// The edges of every slab, from the right to the left.
    edges: Vec<u32>,
    /// Of slabs whose edges have no order, since they cross, how far to the right each or any behind it reaches.
    reaches: Vec<Option<Box<[f64]>>>,
    /// How far an edge may seem to be from where it is.
    aside: f64,
}

impl Slabs {
    /// The slabs of rays at some heights. `O(n log² n)` time, `O(n log n)` memory.
    pub(super) fn new(net: &Net, rays: impl Iterator<Item = f64>, watch: Watch<'_>) -> Result<Self> {
        let mut rays: Vec<f64> = rays.collect();
        rays.sort_unstable_by(f64::total_cmp);
        rays.dedup();
        let columns = net.places.iter().map(|place| place[0]);
        let (low, high) = columns.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
        let count = rays.len().next_power_of_two();
        let mut starts = vec![0; 2 * count + 2];
        let mut slabs = Self {
            rays,
            count,
            starts: Vec::new(),
            edges: Vec::new(),
            reaches: Vec::new(),
            aside: ASIDE * (high - low),
        };
        for k in 0..net.edges.len() {
            slabs.each(net, k, |slab| starts[slab + 2] += 1);
        }
        for i in 2..starts.len() {
            starts[i] += starts[i - 1];
        }
        slabs.edges = vec![0; starts[2 * count + 1]];
        let mut held = Vec::new();
        for k in 0..net.edges.len() {
            watch.poll_at(k)?;
            slabs.each(net, k, |slab| held.push(slab));
            for slab in held.drain(..) {
                slabs.edges[starts[slab + 1]] = k as u32;
                starts[slab + 1] += 1;
            }
        }
        slabs.starts = starts;
        for slab in 0..2 * count {
            watch.poll_at(slab)?;
            let reaches = slabs.sort(net, slab);
            slabs.reaches.push(reaches);
        }
        Ok(slabs)
    }

    /// Calls back with the slabs that are wholly between the ends of an edge.
    fn each(&self, net: &Net, k: usize, mut call: impl FnMut(usize)) {
        let from = |y: f64| self.count + self.rays.partition_point(|&ray| ray < y);
        let [a, b] = net.edges[k].map(|vertex| net.places[vertex as usize][1]);
        let (mut first, mut last) = (from(a.min(b)), from(a.max(b)));
        while first < last {
            if first % 2 == 1 {
                call(first);
                first += 1;
            }
            if last % 2 == 1 {
                last -= 1;
                call(last);
            }
            (first, last) = (first / 2, last / 2);
        }
    }

    /// Puts the edges of a slab in order; where they have none, by their left ends.
    fn sort(&mut self, net: &Net, slab: usize) -> Option<Box<[f64]>> {
        let held = self.starts[slab]..self.starts[slab + 1];
        if held.len() < 2 {
            return None;
        }
        let mut rows: Vec<(f64, [f64; 2], u32)> = self.edges[held.clone()]
            .iter()
            .map(|&edge| {
                let [low, high] = self.span(net, slab, edge);
                (f64::midpoint(low, high), [low, high], edge)
            })
            .collect();
        rows.sort_unstable_by(|p, q| q.0.total_cmp(&p.0).then(p.2.cmp(&q.2)));
        let mut most = [f64::NEG_INFINITY; 2];
        let in_order = rows.iter().rev().all(|(_, ends, _)| {
            let keeps = (0..2).all(|i| ends[i] >= most[i] - self.aside);
            most = [0, 1].map(|i| most[i].max(ends[i]));
            keeps
        });
        let reaches = (!in_order).then(|| {
            let left = |ends: [f64; 2]| ends[0].min(ends[1]);
            rows.sort_unstable_by(|p, q| left(q.1).total_cmp(&left(p.1)).then(p.2.cmp(&q.2)));
            let mut to = f64::NEG_INFINITY;
            let mut reaches: Vec<f64> = rows
                .iter()
                .rev()
                .map(|(_, ends, _)| {
                    to = to.max(ends[0]).max(ends[1]);
                    to
                })
                .collect();
            reaches.reverse();
            reaches.into_boxed_slice()
        });
        self.edges[held].iter_mut().zip(rows).for_each(|(slot, (.., edge))| *slot = edge);
        reaches
    }

    /// Where an edge meets the lowest and the highest ray of a slab.
    fn span(&self, net: &Net, slab: usize, edge: u32) -> [f64; 2] {
        let level = self.count.ilog2() - slab.ilog2();
        let first = (slab << level) - self.count;
        let last = first + (1 << level) - 1;
        [first, last].map(|ray| at(net, [0.0, self.rays[ray]], edge))
    }

    /// The half-edge whose face a ray to the left of a vertex runs through, and from the vertex to its start.
    pub(super) fn left_of(&self, net: &Net, vertex: usize) -> Option<(usize, Point)> {
        let place = net.places[vertex];
        let mut slab = self.count + self.rays.partition_point(|&ray| ray < place[1]);
        let mut best = None;
        while slab > 0 {
            self.look(net, place, slab, &mut best);
            slab /= 2;
        }
        best.map(|hit| (hit.half, hit.start))
    }

    /// Looks for what a ray meets first in a slab.
    fn look(&self, net: &Net, place: Point, slab: usize, best: &mut Option<Hit>) {
        let edges = &self.edges[self.starts[slab]..self.starts[slab + 1]];
        let reaches = self.reaches[slab].as_deref();
        let left = |&edge: &u32| {
            let [low, high] = self.span(net, slab, edge);
            low.min(high) - place[0]
        };
        let seen = match reaches {
            Some(_) => edges.partition_point(|edge| left(edge) >= 2.0 * self.aside),
            None => edges.partition_point(|&edge| at(net, place, edge) >= 2.0 * self.aside),
        };
        for (i, &edge) in edges.iter().enumerate().skip(seen) {
            let to = reaches.map_or_else(|| at(net, place, edge), |reaches| reaches[i] - place[0]);
            if best.as_ref().is_some_and(|best| best.at > to + 2.0 * self.aside) {
                // What comes behind lies farther to the left.
                break;
            }
            *best = better(best.take(), Hit::new(edge as usize, ends(net, place, edge), None));
        }
    }
}

/// The ends of an edge as seen from a place.
fn ends(net: &Net, place: Point, edge: u32) -> [Point; 2] {
    net.edges[edge as usize].map(|end| less(net.places[end as usize], place))
}

/// How far to the right of a place an edge passes its height.
fn at(net: &Net, place: Point, edge: u32) -> f64 {
    let [a, b] = ends(net, place, edge);
    if a[1] <= b[1] { crossing(a, b) } else { crossing(b, a) }
}
