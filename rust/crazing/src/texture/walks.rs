//! Walks around the faces of a crack, and which of them go round one and the same face.

use super::faces::{Net, add, less, rank, turn};
use super::halves::Halves;
use super::rays::Rows;
use super::slabs::Slabs;
use crate::error::Result;
use crate::graph::Point;
use crate::parallel;
use crate::watch::Watch;

/// Walks around faces, in the order of their first half-edges.
pub(super) struct Walks<'a> {
    halves: &'a Halves,
    /// Where each half-edge of the row starts, from the start of its walk.
    ats: Vec<Point>,
    walks: Vec<Walk>,
}

impl std::ops::Deref for Walks<'_> {
    type Target = [Walk];

    fn deref(&self) -> &[Walk] {
        &self.walks
    }
}

impl Walks<'_> {
    pub(super) fn walk_of(&self, half: usize) -> usize {
        self.halves.seats[half][0] as usize
    }

    /// Where in its walk a half-edge starts, from the start of the walk.
    pub(super) fn at(&self, half: usize) -> Point {
        self.ats[self.halves.seats[half][1] as usize]
    }

    /// The first half-edge of a walk.
    pub(super) fn first(&self, walk: usize) -> usize {
        self.halves.row[self.halves.starts[walk] as usize] as usize
    }

    /// Where the half-edges of a walk start.
    pub(super) fn along(&self, walk: usize) -> &[Point] {
        &self.ats[self.halves.part(walk)]
    }
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
    pub(super) fn walks<'a>(&self, halves: &'a Halves) -> Walks<'a> {
        let mut ats = vec![[0.0; 2]; halves.row.len()];
        let count = halves.starts.len() - 1;
        parallel::grouped(
            count,
            |walk| halves.starts[walk] as usize,
            &mut ats,
            |walks, mut rest| {
                for walk in walks {
                    let (own, mut at);
                    (own, rest) = rest.split_at_mut(halves.part(walk).len());
                    at = [0.0; 2];
                    for (slot, &half) in own.iter_mut().zip(&halves.row[halves.part(walk)]) {
                        *slot = at;
                        at = add(at, self.vector(half as usize));
                    }
                }
            },
        );
        let walk = |walk: usize| self.walk(&halves.row[halves.part(walk)], &ats[halves.part(walk)]);
        let walks = parallel::ranges(count, |range| range.map(walk).collect::<Vec<_>>()).concat();
        Walks { halves, ats, walks }
    }

    /// What a walk along some half-edges is, which start where `ats` says.
    fn walk(&self, halves: &[u32], ats: &[Point]) -> Walk {
        let last = halves.len() - 1;
        let end = add(ats[last], self.vector(halves[last] as usize));
        let wraps = self.period.map_or([0.0; 2], |period| [0, 1].map(|axis| (end[axis] / period[axis]).round()));
        let lean = self.lean(wraps);
        let (mut area, mut sum, mut mean) = (0.0, [0.0; 2], [0.0; 2]);
        let (mut left, mut aside) = (0, f64::INFINITY);
        for (i, &at) in ats.iter().enumerate() {
            let to = ats.get(i + 1).copied().unwrap_or(end);
            let slice = cross(at, to);
            area += slice;
            sum = add(sum, [slice * (at[0] + to[0]), slice * (at[1] + to[1])]);
            mean = add(mean, at);
            let own = at[0] - lean * at[1];
            if own < aside {
                (left, aside) = (i, own);
            }
        }
        // What closes a face from outside has it to the right of its leftmost vertex.
        let closes = wraps == [0.0; 2] && !self.opens_left(halves, ats, left);
        let middle = if closes && area > 0.0 {
            sum.map(|part| part / (3.0 * area))
        } else {
            mean.map(|part| part / halves.len() as f64)
        };
        Walk { closes, wraps, middle, left: halves[left] as usize }
    }

    /// Whether a walk passes the start of one of its half-edges so that what lies straight to the left of there is to
    /// the left of the walk.
    fn opens_left(&self, halves: &[u32], ats: &[Point], left: usize) -> bool {
        let (vertex, there) = (self.start(halves[left] as usize), ats[left]);
        let place = |half: usize| (turn(self.vector(half)), rank(half));
        // A walk may pass a vertex several times, and on a torus several images of it.
        let is_there = |i: usize| {
            let apart = less(ats[i], there);
            let far = |axis: usize| self.period.is_some_and(|period| apart[axis].abs() > period[axis] / 2.0);
            self.start(halves[i] as usize) == vertex && !far(0) && !far(1)
        };
        let before = |i: usize| halves[if i == 0 { halves.len() } else { i } - 1] as usize;
        (0..halves.len()).any(|i| is_there(i) && place(halves[i] as usize) >= place(before(i) ^ 1))
    }

    /// How far to the right a way round the torus leads for every unit up.
    fn lean(&self, wraps: Point) -> f64 {
        let period = self.period.unwrap_or([1.0; 2]);
        if wraps[1] == 0.0 { 0.0 } else { wraps[0] * period[0] / (wraps[1] * period[1]) }
    }

    /// For every walk around something that floats the walk around the face it floats in, and where that starts; for one
    /// up round the torus, likewise that on the other side of its strip.
    pub(super) fn parents(&self, walks: &Walks<'_>, watch: Watch<'_>) -> Result<Vec<Option<(usize, Point)>>> {
        let floats = walks.iter().filter(|walk| walk.looks_left());
        let rays = floats.map(|walk| self.places[self.start(walk.left)][1]);
        let left_of: Box<dyn Fn(usize) -> Option<(usize, Point)>> = if self.period.is_some() {
            let rows = Rows::new(self, rays);
            Box::new(move |vertex| rows.left_of(self, vertex))
        } else {
            let slabs = Slabs::new(self, rays, watch)?;
            Box::new(move |vertex| slabs.left_of(self, vertex))
        };
        let mut parents = Vec::with_capacity(walks.len());
        for (id, walk) in walks.iter().enumerate() {
            watch.poll_at(id)?;
            let hit = walk.looks_left().then(|| left_of(self.start(walk.left))).flatten();
            // The start of the parent's walk, seen from the start of this one.
            let seen =
                |(half, to_start)| (walks.walk_of(half), less(add(walks.at(walk.left), to_start), walks.at(half)));
            parents.push(hit.map(seen));
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
