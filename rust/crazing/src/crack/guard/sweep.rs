//! Moving everything at once: what moves smoothly as a whole keeps its triangles counter-clockwise where one point after
//! the other would be in the way of those that have not moved yet.

use super::super::net::NONE;
use super::{Guard, Held, part_of};
use crate::error::Result;
use crate::graph::Point;
use crate::incidence::Incidence;
use crate::parallel;
use crate::predicates::orientation;
use crate::watch::Watch;

/// Steps in which points go back where triangles do not follow.
const STEPS: u8 = 8;

/// Times that kites about some points are looked for. Then those about all others are, too: where points go back one
/// after the other, along a comb or about a hub, there are about as many times as points.
const ASKED: usize = 24;

/// A corner of a triangle as its third one sees it: all cut ends are one, on the outline.
type Seen = Option<(i32, [i8; 2])>;

/// The kites about points, found when they are first asked for: that goes through all kites.
struct Around {
    /// Which of the lists is that of a point; the first is none.
    place: Vec<u32>,
    /// Where each list starts in `rows`, and the end.
    starts: Vec<usize>,
    rows: Vec<u32>,
    asked: usize,
}

impl Around {
    fn of_none(points: usize) -> Self {
        Self { place: vec![0; points], starts: vec![0, 0], rows: Vec::new(), asked: 0 }
    }

    fn learn(&mut self, guard: &Guard<'_>, points: &[u32]) {
        let is_new = |&point: &u32| self.place[point as usize] == 0;
        let mut new: Vec<u32> = points.iter().copied().filter(is_new).collect();
        if new.is_empty() {
            return;
        }
        self.asked += 1;
        if self.asked > ASKED {
            new = (0..self.place.len() as u32).filter(is_new).collect();
        }
        let mut are_these = vec![false; self.place.len()];
        new.iter().for_each(|&point| are_these[point as usize] = true);
        let about = guard.kites_about(&new, &are_these);
        for (i, &point) in new.iter().enumerate() {
            self.place[point as usize] = self.starts.len() as u32 - 1;
            self.rows.extend_from_slice(about.at(i));
            self.starts.push(self.rows.len());
        }
    }

    fn of(&self, point: u32) -> &[u32] {
        let list = self.place[point as usize] as usize;
        &self.rows[self.starts[list]..self.starts[list + 1]]
    }

    /// The rows about each of some points, which are ascending.
    fn about(&self, guard: &Guard<'_>, points: &[u32]) -> Incidence {
        let number_of = |corner: i32| points.binary_search(&(corner as u32)).map_or(NONE, |i| i as i32);
        let rows = self.rows(points);
        let kites = || rows.iter().map(|&row| (row, guard.fence.kites[row as usize].map(number_of)));
        Incidence::of_rows(points.len(), kites)
    }

    /// The rows about some points, ascending.
    fn rows(&self, points: &[u32]) -> Vec<u32> {
        let mut rows: Vec<u32> = points.iter().flat_map(|&point| self.of(point)).copied().collect();
        parallel::sort(&mut rows);
        rows.dedup();
        rows
    }
}

impl Guard<'_> {
    /// Moves all points to their goals, in the unit of exact work, all at once. Where triangles are turned over
    /// that way, anchors move along to where `anchor` has them, if they have room all around or as far as the cut ends;
    /// what is left of such triangles goes back step by step, and then on again as far as others let it.
    ///
    /// Only the triangles at the end matter: if they are counter-clockwise they pave what they paved, see
    /// [`super::super::Fence`].
    pub(in super::super) fn sweep(
        &mut self,
        goals: Vec<Point>,
        cut: &[bool],
        anchor: impl Fn(usize) -> Option<Point>,
        watch: Watch<'_>,
    ) -> Result<()> {
        let from = std::mem::replace(&mut self.points, goals);
        let mut bad = self.turned(&from);
        if bad.is_empty() {
            return Ok(());
        }
        watch.poll()?;
        self.movable = from.len();
        let mut around = Around::of_none(from.len());
        let mut moved = self.corners_of(&bad, |_| true);
        around.learn(self, &moved);
        moved.retain(|&corner| {
            let is_free = corner as usize >= cut.len() && self.is_enclosed(around.of(corner), corner as i32, cut);
            let goal = if is_free { anchor(corner as usize) } else { None };
            goal.into_iter().for_each(|goal| self.points[corner as usize] = goal);
            goal.is_some()
        });
        bad.extend(around.rows(&moved));
        self.keep_bad(&mut bad, &from);
        let goals = parallel::map(from.len(), |point| self.points[point]);
        let (mut steps, mut held) = (vec![0_u8; from.len()], Vec::new());
        while !bad.is_empty() {
            watch.poll()?;
            moved = self.corners_of(&bad, |corner| self.points[corner] != from[corner]);
            for &corner in &moved {
                let corner = corner as usize;
                if steps[corner] == 0 {
                    held.push(corner as u32);
                }
                steps[corner] += 1;
                let left = f64::from(STEPS - steps[corner]) / f64::from(STEPS);
                self.points[corner] = part_of(left, from[corner], goals[corner]);
            }
            around.learn(self, &moved);
            bad = around.rows(&moved);
            self.keep_bad(&mut bad, &from);
        }
        held.sort_unstable();
        let about = around.about(self, &held);
        self.settle(&Held { in_turn: held, about }, &goals, watch)
    }

    /// The rows that hold a triangle which is not counter-clockwise, or too flat.
    fn turned(&self, from: &[Point]) -> Vec<u32> {
        let found = parallel::ranges(self.fence.kites.len(), |range| {
            range.filter(|&row| !self.holds(row, from)).map(|row| row as u32).collect::<Vec<_>>()
        });
        found.concat()
    }

    /// Of some rows those, each once.
    fn keep_bad(&self, rows: &mut Vec<u32>, from: &[Point]) {
        parallel::sort(rows);
        rows.dedup();
        let bad = parallel::ranges(rows.len(), |range| {
            rows[range].iter().copied().filter(|&row| !self.holds(row as usize, from)).collect::<Vec<_>>()
        });
        *rows = bad.concat();
    }

    /// The corners of some kites that `wanted` names, ascending.
    fn corners_of(&self, rows: &[u32], wanted: impl Fn(usize) -> bool) -> Vec<u32> {
        let corners = rows.iter().flat_map(|&row| self.fence.kites[row as usize]);
        let mut found: Vec<u32> =
            corners.filter(|&corner| corner >= 0 && wanted(corner as usize)).map(|corner| corner as u32).collect();
        parallel::sort(&mut found);
        found.dedup();
        found
    }

    /// Whether both triangles of a kite are counter-clockwise, and as far from flat as they must be.
    fn holds(&self, row: usize, from: &[Point]) -> bool {
        let kite = self.fence.kites[row];
        if kite[2] < 0 || kite[3] < 0 {
            return kite.iter().all(|&corner| corner < 0 || self.points[corner as usize] == from[corner as usize]);
        }
        let now = |corner: usize| self.points[corner];
        self.is_clear(row, NONE, [0.0; 2], now)
            || [[0, 1, 2], [1, 0, 3]].into_iter().all(|triangle| self.follows(row, triangle, from))
    }

    /// The same of one triangle, exactly.
    fn follows(&self, row: usize, triangle: [usize; 3], from: &[Point]) -> bool {
        let corners =
            |points: &[Point]| triangle.map(|i| self.moved(row, i, points[self.fence.kites[row][i] as usize]));
        let ([a, b, c], [p, q, r]) = (corners(&self.points), corners(from));
        let area = orientation(a, b, c);
        area > 0.0 && (area >= super::clear::floor([a, b, c]) || area >= orientation(p, q, r))
    }

    /// Whether the triangles about an anchor close around it, cut ends taken as one: from one to the next is the outline.
    fn is_enclosed(&self, rows: &[u32], anchor: i32, cut: &[bool]) -> bool {
        let (mut nexts, mut lasts): (Vec<Seen>, Vec<Seen>) = (Vec::new(), Vec::new());
        for &row in rows {
            let kite = self.fence.kites[row as usize];
            for triangle in [[0, 1, 2], [1, 0, 3]] {
                for i in (0..3).filter(|&i| kite[triangle[i]] == anchor) {
                    let seen = |corner: usize| self.seen(row as usize, triangle[i], corner, cut);
                    nexts.push(seen(triangle[(i + 1) % 3]));
                    lasts.push(seen(triangle[(i + 2) % 3]));
                }
            }
        }
        nexts.sort_unstable();
        lasts.sort_unstable();
        nexts == lasts
    }

    /// A corner of a kite as another one of it sees it.
    fn seen(&self, row: usize, from: usize, corner: usize, cut: &[bool]) -> Seen {
        let id = self.fence.kites[row][corner];
        let turns = |corner: usize| match self.fence.shifts.get(row) {
            Some(shift) if corner > 0 => [shift[2 * corner - 2], shift[2 * corner - 1]],
            _ => [0; 2],
        };
        let (here, there) = (turns(from), turns(corner));
        let is_cut = cut.get(id as usize).copied().unwrap_or(false);
        (!is_cut).then(|| (id, [0, 1].map(|i| there[i].wrapping_sub(here[i]))))
    }
}
