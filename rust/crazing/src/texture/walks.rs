//! Walks around the faces of a crack, and which of them go round one and the same face.

use super::faces::{Net, add, less, rank, turn};
use super::rays::Rows;
use super::slabs::Slabs;
use crate::error::Result;
use crate::graph::Point;
use crate::watch::Watch;

/// Walks around faces.
pub(super) struct Walks {
    /// The walk of every half-edge, and where in it the half-edge starts, from the start of the walk.
    pub(super) of: Vec<(usize, Point)>,
    pub(super) walks: Vec<Walk>,
}

/// A walk around a face, or around a part of one.
#[derive(Debug, Clone, Copy)]
pub(super) struct Walk {
    /// Whether it closes a face from outside; it does not around what floats in one, nor round a torus.
    pub(super) closes: bool,
    /// The way round the torus that it ends by, in whole periods.
    wraps: Point,
    pub(super) middle: Point,
    /// The half-edge that starts farthest to the left; of a walk round the torus, as seen along that way.
    left: usize,
}

impl Walk {
    /// Whether a ray to the left of it runs in its face.
    fn looks_left(&self) -> bool {
        !self.closes && (self.wraps == [0.0; 2] || self.wraps[1] > 0.0)
    }

    /// Whether its face has a number of its own: all that is neither closed nor a strip round the torus is one.
    pub(super) fn is_alone(&self) -> bool {
        self.closes || self.wraps != [0.0; 2]
    }

    /// Whether it runs round the torus from side to side, neither up nor down.
    pub(super) fn is_level(&self) -> bool {
        self.wraps[0] != 0.0 && self.wraps[1] == 0.0
    }
}

fn cross(a: Point, b: Point) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

impl Net {
    /// Walks around every face, from half-edge to half-edge.
    pub(super) fn walks(&self, after: &[usize]) -> Walks {
        let mut walks = Walks { of: vec![(usize::MAX, [0.0; 2]); after.len()], walks: Vec::new() };
        let mut halves = Vec::new();
        for first in 0..after.len() {
            if walks.of[first].0 != usize::MAX {
                continue;
            }
            let (mut half, mut at) = (first, [0.0; 2]);
            halves.clear();
            while walks.of[half].0 == usize::MAX {
                walks.of[half] = (walks.walks.len(), at);
                halves.push(half);
                (half, at) = (after[half], add(at, self.half(half).1));
            }
            let wraps = self.period.map_or([0.0; 2], |period| [0, 1].map(|axis| (at[axis] / period[axis]).round()));
            walks.walks.push(self.walk(&halves, &walks.of, wraps));
        }
        walks
    }

    /// What a walk along some half-edges is.
    fn walk(&self, halves: &[usize], of: &[(usize, Point)], wraps: Point) -> Walk {
        let lean = self.lean(wraps);
        let (mut area, mut sum, mut mean) = (0.0, [0.0; 2], [0.0; 2]);
        let (mut left, mut aside) = (halves[0], f64::INFINITY);
        for &half in halves {
            let at = of[half].1;
            let to = add(at, self.half(half).1);
            let slice = cross(at, to);
            area += slice;
            sum = add(sum, [slice * (at[0] + to[0]), slice * (at[1] + to[1])]);
            mean = add(mean, at);
            let own = at[0] - lean * at[1];
            if own < aside {
                (left, aside) = (half, own);
            }
        }
        // What closes a face from outside has it to the right of its leftmost vertex.
        let closes = wraps == [0.0; 2] && !self.opens_left(halves, of, left);
        let middle = if closes && area > 0.0 {
            sum.map(|part| part / (3.0 * area))
        } else {
            mean.map(|part| part / halves.len() as f64)
        };
        Walk { closes, wraps, middle, left }
    }

    /// Whether a walk passes the start of one of its half-edges so that what lies straight to the left of there is to
    /// the left of the walk.
    fn opens_left(&self, halves: &[usize], of: &[(usize, Point)], left: usize) -> bool {
        let (vertex, there) = (self.half(left).0, of[left].1);
        let place = |half: usize| (turn(self.half(half).1), rank(half));
        // A walk may pass a vertex several times, and on a torus several images of it.
        let is_there = |half: usize| {
            let apart = less(of[half].1, there);
            let far = |axis: usize| self.period.is_some_and(|period| apart[axis].abs() > period[axis] / 2.0);
            self.half(half).0 == vertex && !far(0) && !far(1)
        };
        let mut corners = halves.last().into_iter().chain(halves).zip(halves);
        corners.any(|(&before, &half)| is_there(half) && place(half) >= place(before ^ 1))
    }

    /// How far to the right a way round the torus leads for every unit up.
    fn lean(&self, wraps: Point) -> f64 {
        let period = self.period.unwrap_or([1.0; 2]);
        if wraps[1] == 0.0 { 0.0 } else { wraps[0] * period[0] / (wraps[1] * period[1]) }
    }

    /// For every walk around something that floats the walk around the face it floats in, and where that starts; for one
    /// up round the torus, likewise that on the other side of its strip.
    pub(super) fn parents(&self, walks: &Walks, watch: Watch<'_>) -> Result<Vec<Option<(usize, Point)>>> {
        let floats = walks.walks.iter().filter(|walk| walk.looks_left());
        let rays = floats.map(|walk| self.places[self.half(walk.left).0][1]);
        let left_of: Box<dyn Fn(usize) -> Option<(usize, Point)>> = if self.period.is_some() {
            let rows = Rows::new(self, rays);
            Box::new(move |vertex| rows.left_of(self, vertex))
        } else {
            let slabs = Slabs::new(self, rays, watch)?;
            Box::new(move |vertex| slabs.left_of(self, vertex))
        };
        let mut parents = Vec::with_capacity(walks.walks.len());
        for (id, walk) in walks.walks.iter().enumerate() {
            watch.poll_at(id)?;
            let start = walks.of[walk.left].1;
            let hit = walk.looks_left().then(|| left_of(self.half(walk.left).0)).flatten();
            parents.push(hit.map(|(half, to_start)| {
                let (parent, at) = walks.of[half];
                // The start of the parent's walk, seen from the start of this one.
                (parent, less(add(start, to_start), at))
            }));
        }
        Ok(parents)
    }

    /// The outermost walk of every walk's face, and where that starts as seen from there.
    pub(super) fn outermost(parents: &[Option<(usize, Point)>]) -> Vec<(usize, Point)> {
        let mut known: Vec<Option<(usize, Point)>> = vec![None; parents.len()];
        let mut chain = Vec::new();
        for walk in 0..parents.len() {
            let mut at = walk;
            while let (None, Some((parent, by))) = (known[at], parents[at]) {
                // On a torus without any crack around it the chain may close: its first walk then speaks for all.
                known[at] = Some((at, [0.0; 2]));
                chain.push((at, by));
                at = parent;
            }
            let mut end = *known[at].get_or_insert((at, [0.0; 2]));
            while let Some((link, by)) = chain.pop() {
                if link != end.0 {
                    end = (end.0, add(end.1, by));
                    known[link] = Some(end);
                } else {
                    end = (link, [0.0; 2]);
                }
            }
        }
        known.into_iter().enumerate().map(|(walk, end)| end.unwrap_or((walk, [0.0; 2]))).collect()
    }
}
