//! Moving vertices behind a fence.

mod clear;
mod sweep;

use super::fence::FenceView;
use super::net::{NONE, NetView};
use crate::diagram::scale::{Scale, largest};
use crate::error::Result;
use crate::graph::Point;
use crate::incidence::Incidence;
use crate::parallel;
use crate::watch::Watch;

/// Rounds in which vertices that were held back try again: more hardly ever bring one further.
const AGAIN: usize = 8;

/// A part of the way.
#[inline]
fn part_of(part: f64, from: Point, to: Point) -> Point {
    [from[0] + part * (to[0] - from[0]), from[1] + part * (to[1] - from[1])]
}

/// Vertices that others may hold back, in turn, and the kites that hold each of them.
pub(super) struct Held {
    in_turn: Vec<u32>,
    about: Incidence,
}

/// Vertices that move, and what keeps them from crossing.
pub(super) struct Guard<'a> {
    fence: FenceView<'a>,
    period: Point,
    scale: Scale,
    /// Vertices, then anchors, in the unit of exact work.
    points: Vec<Point>,
    /// Where vertices are to be; kept for its memory.
    goals: Vec<Point>,
    movable: usize,
    /// No coordinate is much larger than this.
    large: f64,
}

impl<'a> Guard<'a> {
    pub(super) fn of(net: NetView<'_>, fence: FenceView<'a>) -> Self {
        let large = largest(net.vertices).max(largest(fence.anchors)).max(net.period[0]).max(net.period[1]);
        let scale = Scale::of(large);
        let vertices = net.vertices.len();
        let place = |i: usize| net.vertices.get(i).unwrap_or_else(|| &fence.anchors[i - vertices]);
        let points = parallel::map(vertices + fence.anchors.len(), |i| scale.down(*place(i)));
        let [large, _] = scale.down([large, 0.0]);
        let period = scale.down(net.period);
        Self { fence, period, scale, points, goals: Vec::new(), movable: vertices, large }
    }

    pub(super) fn place(&self, vertex: usize) -> Point {
        self.points[vertex]
    }

    /// Where all vertices are.
    pub(super) fn places(&self) -> Vec<Point> {
        parallel::map(self.movable, |vertex| self.points[vertex])
    }

    pub(super) fn scale(&self) -> Scale {
        self.scale
    }

    pub(super) fn period(&self) -> Point {
        self.period
    }

    /// Positions of the vertices in the unit of the drawing.
    pub(super) fn into_vertices(mut self) -> Vec<Point> {
        self.points.truncate(self.movable);
        self.into_points()
    }

    /// Positions of the vertices, then of the anchors.
    pub(super) fn into_points(self) -> Vec<Point> {
        let Self { mut points, scale, .. } = self;
        if !scale.is_one() {
            parallel::alter(&mut points, |p| *p = scale.up(*p));
        }
        points
    }

    /// Where a vertex is after `step`, in the unit of the drawing.
    pub(super) fn shoved(&self, vertex: usize, step: Point) -> Point {
        let (from, step) = (self.points[vertex], self.scale.down(step));
        [from[0] + step[0], from[1] + step[1]]
    }

    /// Moves every vertex to its goal, in the unit of exact work, one after the other: all the way, or half of it, or a
    /// quarter, or not at all.
    ///
    /// Most may go whatever the others do; that is found out on all cores. The rest goes in turn, each seeing those
    /// before it moved and those behind it not: in the order of their numbers, or by `turns` where they are given. Gives
    /// those that went in turn.
    pub(super) fn advance(
        &mut self,
        goal: impl Fn(&Self, usize) -> Point + Sync,
        turns: Option<&[u32]>,
        watch: Watch<'_>,
    ) -> Result<Held> {
        let mut after = std::mem::take(&mut self.goals);
        if after.is_empty() {
            // Not grown: memory that is zero to begin with is first touched by the threads that fill it.
            after = vec![[0.0; 2]; self.movable];
        }
        parallel::fill(&mut after, |range, part| {
            let place = |vertex| part_of(1.0, self.points[vertex], goal(self, vertex));
            part.iter_mut().zip(range).for_each(|(slot, vertex)| *slot = place(vertex));
        });
        let waits = self.waiting(&after);
        watch.poll()?;
        let turn = |vertex: usize| turns.map_or(vertex as u32, |turns| turns[vertex]);
        let mut in_turn: Vec<u32> = (0..self.movable as u32).filter(|&vertex| waits[vertex as usize]).collect();
        in_turn.sort_by_key(|&vertex| turn(vertex as usize));
        let about = self.kites_about(&in_turn, &waits);
        for (i, &vertex) in in_turn.iter().enumerate() {
            watch.poll_at(i)?;
            let (vertex, to) = (vertex as usize, goal(self, vertex as usize));
            let is_before = |other: usize| other < self.movable && turn(other) < turn(vertex);
            let now = |other: usize| if is_before(other) { after[other] } else { self.points[other] };
            after[vertex] = self.farthest(about.at(i), vertex, to, now);
        }
        parallel::alter_both(&mut self.points[..self.movable], &mut after, |place, &mut goal| *place = goal);
        self.goals = after;
        Ok(Held { in_turn, about })
    }

    /// Moves those that were held back, in the unit of exact work, one after the other and each seeing where all others
    /// are; and again those about one that got on.
    ///
    /// A vertex that neighbours hold back may go once these have gone the same way.
    pub(super) fn settle(&mut self, held: &Held, goals: &[Point], watch: Watch<'_>) -> Result<()> {
        let Held { in_turn, about } = held;
        let mut waits = vec![true; if in_turn.is_empty() { 0 } else { self.movable }];
        for _ in 0..AGAIN {
            let mut has_moved = false;
            for (i, &vertex) in in_turn.iter().enumerate() {
                watch.poll_at(i)?;
                let (vertex, from) = (vertex as usize, self.points[vertex as usize]);
                if !std::mem::take(&mut waits[vertex]) || from == goals[vertex] {
                    continue;
                }
                let to = self.farthest(about.at(i), vertex, goals[vertex], |other| self.points[other]);
                if to != from {
                    (self.points[vertex], has_moved) = (to, true);
                    for &corner in about.at(i).iter().flat_map(|&row| &self.fence.kites[row as usize]) {
                        waits.get_mut(corner as usize).into_iter().for_each(|waits| *waits = true);
                    }
                }
            }
            if !has_moved {
                break;
            }
        }
        Ok(())
    }

    /// The kites that hold each of the vertices that move in turn.
    fn kites_about(&self, in_turn: &[u32], waits: &[bool]) -> Incidence {
        let is_one = |corner: &i32| waits.get(*corner as usize).copied().unwrap_or(false);
        let held = parallel::ranges(self.fence.kites.len(), |range| {
            let all = range.map(|row| (row as u32, self.fence.kites[row]));
            all.filter(|(_, kite)| kite.iter().any(is_one)).collect::<Vec<_>>()
        });
        let mut number = vec![NONE; if in_turn.is_empty() { 0 } else { self.movable }];
        in_turn.iter().zip(0..).for_each(|(&vertex, i)| number[vertex as usize] = i);
        let number_of = |corner: i32| number.get(corner as usize).copied().unwrap_or(NONE);
        Incidence::of_rows(in_turn.len(), || held.iter().flatten().map(|&(row, kite)| (row, kite.map(number_of))))
    }

    /// Which vertices have moves that may depend on others.
    fn waiting(&self, goals: &[Point]) -> Vec<bool> {
        let tight = parallel::ranges(self.fence.kites.len(), |range| {
            let mut tight = Vec::new();
            for row in range.filter(|&row| !self.is_free(row, goals)) {
                // None is -1, which is no vertex either.
                let corners = self.fence.kites[row].into_iter().filter(|&corner| (corner as usize) < self.movable);
                tight.extend(corners.filter(|&corner| goals[corner as usize] != self.points[corner as usize]));
            }
            tight
        });
        let mut waits = vec![false; self.movable];
        tight.into_iter().flatten().for_each(|corner| waits[corner as usize] = true);
        waits
    }
}
