//! The drawing that stubs grow in, and the triangles about its edges.

use super::Grown;
use super::index::Index;
use crate::crack::fence::Fence;
use crate::crack::net::{NONE, Net};
use crate::diagram::scale::{Scale, largest};
use crate::graph::Point;
use crate::parallel;
use crate::predicates::orientation;

/// A drawing while stubs grow. Points are numbered as before, those that are new after the anchors.
pub(super) struct Bed {
    pub(super) net: Net,
    anchors: Vec<Point>,
    new: Vec<Point>,
    pub(super) bounds: [f64; 4],
    partner: Vec<i32>,
    origin: Vec<i32>,
    /// Kites as before, then those that are new.
    pub(super) kites: Vec<[i32; 4]>,
    shifts: Vec<[i8; 6]>,
    /// The kite about every edge.
    pub(super) kite_of: Vec<u32>,
    /// The kite about two points.
    about: Index,
    /// Kites that were there before, and whether they were changed since the bed was settled.
    changed: Vec<bool>,
    /// To the unit of exact work.
    scale: Scale,
}

/// A point, and the periods at which it is seen.
type Seen = (i32, [i8; 2]);

/// Numbers of so many edges, with room for those that grow: to move all of them is dearer.
fn with_room<T>(edges: usize, numbers: impl Iterator<Item = T>) -> Vec<T> {
    let mut all = Vec::with_capacity(edges + edges / 2);
    all.extend(numbers);
    all
}

impl Bed {
    pub(super) fn of(mut net: Net, mut partner: Vec<i32>, mut fence: Fence, bounds: [f64; 4]) -> Self {
        let edges = net.edges.len();
        // Room for what grows: to move all when it is wanted would take one thread.
        let more = edges / 2;
        parallel::join(
            edges,
            || (net.edges.reserve(more), fence.kites.reserve(2 * more)),
            || partner.reserve(2 * more),
        );
        let large = largest(&net.vertices).max(largest(&fence.anchors)).max(net.period[0]).max(net.period[1]);
        Self {
            about: Index::of(&fence.kites, net.vertices.len() + fence.anchors.len()),
            net,
            anchors: fence.anchors,
            new: Vec::new(),
            bounds,
            partner,
            origin: with_room(edges, 0..edges as i32),
            changed: vec![false; fence.kites.len()],
            kites: fence.kites,
            shifts: fence.shifts,
            kite_of: with_room(edges, 0..edges as u32),
            scale: Scale::of(large),
        }
    }

    /// From now on it is noted which kites change.
    pub(super) fn settle(&mut self) {
        self.changed.fill(false);
    }

    /// Whether the kite about an edge is as it was when the bed was settled.
    pub(super) fn is_settled(&self, edge: usize) -> bool {
        !self.changed[self.kite_of[edge] as usize]
    }

    fn change(&mut self, kite: usize) {
        if let Some(changed) = self.changed.get_mut(kite) {
            *changed = true;
        }
    }

    fn point(&self, number: i32) -> Point {
        let (at, vertices, old) =
            (number as usize, self.net.vertices.len(), self.net.vertices.len() + self.anchors.len());
        match at {
            _ if at < vertices => self.net.vertices[at],
            _ if at < old => self.anchors[at - vertices],
            _ => self.new[at - old],
        }
    }

    /// Whether a point may have edges: triangles at others are about one edge only.
    pub(super) fn is_vertex(&self, number: i32) -> bool {
        let at = number as usize;
        at < self.net.vertices.len() || at >= self.net.vertices.len() + self.anchors.len()
    }

    fn add(&mut self, p: Point) -> i32 {
        self.new.push(p);
        (self.net.vertices.len() + self.anchors.len() + self.new.len()) as i32 - 1
    }

    fn shift(&self, kite: usize, corner: usize) -> [i8; 2] {
        match self.shifts.get(kite) {
            Some(shift) if corner > 0 => [shift[2 * corner - 2], shift[2 * corner - 1]],
            _ => [0, 0],
        }
    }

    /// A corner of a kite as seen from its first.
    pub(super) fn corner(&self, kite: usize, corner: usize) -> Point {
        let at = self.point(self.kites[kite][corner]);
        let shift = self.shift(kite, corner);
        [0, 1].map(|i| at[i] + f64::from(shift[i]) * self.net.period[i])
    }

    /// Whether the triangles that would take the place of a kite's two are all counter-clockwise.
    pub(super) fn paves(&self, kite: usize, side: usize, foot: Point, tip: Point) -> bool {
        let [a, b, near] = [0, 1, 2 + side].map(|corner| self.corner(kite, corner));
        let sense = if side == 0 { 1.0 } else { -1.0 };
        let [a, b, near, foot, tip] = [a, b, near, foot, tip].map(|p| self.scale.down(p));
        let own = [[a, foot, tip], [foot, b, tip], [b, near, tip], [near, a, tip]];
        let has_other = self.kites[kite][3 - side] >= 0;
        let beyond = if has_other { self.scale.down(self.corner(kite, 3 - side)) } else { a };
        let other = [[foot, a, beyond], [b, foot, beyond]];
        own.iter().chain(other.iter().filter(|_| has_other)).all(|&[p, q, r]| sense * orientation(p, q, r) > 0.0)
    }

    /// Divides a piece at the foot of a stub; the piece beyond.
    pub(super) fn grow(&mut self, piece: usize, side: usize, foot: Point, tip: Point) -> usize {
        let kite = self.kite_of[piece] as usize;
        let ([a, b, left, right], end) = (self.kites[kite], self.shift(kite, 1));
        let near = [left, right][side];
        let (near_shift, other, other_shift) =
            (self.shift(kite, 2 + side), [right, left][side], self.shift(kite, 3 - side));
        let (foot, tip) = (self.add(foot), self.add(tip));
        let one_sided = |row: [i32; 2], [near, far]: [(i32, [i8; 2]); 2]| {
            let [left, right] = if side == 0 { [near, far] } else { [far, near] };
            ([row[0], row[1], left.0, right.0], left.1, right.1)
        };
        self.about.remove([a, b], kite);
        // Points with the periods at which they are seen from the first end; new ones are seen from there.
        let (from, to) = ((a, [0, 0]), (b, end));
        for (apex, new) in [((near, near_shift), tip), ((other, other_shift), foot)] {
            self.replace([to, apex], from, new);
            self.replace([apex, from], to, new);
        }
        let first = one_sided([a, foot], [(tip, [0, 0]), (other, other_shift)]);
        let rest = one_sided([foot, b], [(tip, [0, 0]), (other, other_shift)]);
        let stub = one_sided([foot, tip], [(a, [0, 0]), (b, end)]);
        let open = one_sided([tip, near], [(a, [0, 0]), (b, end)]);
        self.set(kite, first, [0, 0]);
        let beyond = self.edge([foot, b], end, self.origin[piece], rest);
        self.edge([foot, tip], [0, 0], NONE, stub);
        self.set(self.kites.len(), open, near_shift);
        self.net.edges[piece] = [a, foot];
        if let Some(shift) = self.net.shifts.get_mut(piece) {
            *shift = [0, 0];
        }
        self.join(piece, beyond);
        beyond
    }

    /// The crack goes on from a piece into the new one beyond it.
    fn join(&mut self, piece: usize, beyond: usize) {
        let (old, near, far) = (2 * piece + 1, 2 * beyond, 2 * beyond + 1);
        let next = self.partner[old];
        self.partner[far] = next;
        if next != NONE {
            self.partner[next as usize] = far as i32;
        }
        self.partner[old] = near as i32;
        self.partner[near] = old as i32;
    }

    fn edge(&mut self, ends: [i32; 2], shift: [i8; 2], origin: i32, kite: ([i32; 4], [i8; 2], [i8; 2])) -> usize {
        self.net.edges.push(ends);
        if !self.net.shifts.is_empty() {
            self.net.shifts.push(shift);
        }
        self.origin.push(origin);
        self.partner.extend([NONE; 2]);
        self.kite_of.push(self.kites.len() as u32);
        self.set(self.kites.len(), kite, shift);
        self.net.edges.len() - 1
    }

    fn set(&mut self, row: usize, (kite, left, right): ([i32; 4], [i8; 2], [i8; 2]), end: [i8; 2]) {
        let shift = [end[0], end[1], left[0], left[1], right[0], right[1]];
        self.about.insert([kite[0], kite[1]], row);
        if row == self.kites.len() {
            self.kites.push(kite);
            if !self.shifts.is_empty() {
                self.shifts.push(shift);
            }
        } else {
            self.change(row);
            self.kites[row] = kite;
            if let Some(old) = self.shifts.get_mut(row) {
                *old = shift;
            }
        }
    }

    /// The triangle on the kite about two points that has its apex at `old` has it at `new` now.
    fn replace(&mut self, [a, b]: [Seen; 2], old: Seen, new: i32) {
        let Some(row) = self.about.find([a.0, b.0], &self.kites) else { return };
        let first = if self.kites[row][0] == a.0 { a.1 } else { b.1 };
        for corner in 2..4 {
            let apart = self.shift(row, corner);
            // As seen from the first corner of this kite: another copy of the point is another triangle.
            let same = (0..2).all(|i| i16::from(old.1[i]) - i16::from(first[i]) == i16::from(apart[i]));
            if self.kites[row][corner] != old.0 || !same {
                continue;
            }
            self.change(row);
            self.kites[row][corner] = new;
            if let Some(shift) = self.shifts.get_mut(row) {
                shift[2 * corner - 2] = first[0].wrapping_neg();
                shift[2 * corner - 1] = first[1].wrapping_neg();
            }
        }
    }

    /// The drawing with vertices before anchors, and the kites of its edges before the others.
    pub(super) fn finish(self) -> Grown {
        let new = self.new.len() as i32;
        let (vertices, anchors) = (self.net.vertices.len() as i32, self.anchors.len() as i32);
        let numbered = |number: i32| match number {
            _ if number < vertices => number,
            _ if number < vertices + anchors => number + new,
            _ => number - anchors,
        };
        let mut net = self.net;
        net.vertices.extend(&self.new);
        net.cut.resize(net.vertices.len(), false);
        parallel::alter(&mut net.edges, |edge| *edge = edge.map(numbered));
        let mut is_own = vec![false; self.kites.len()];
        self.kite_of.iter().for_each(|&row| is_own[row as usize] = true);
        let others = parallel::compact(is_own.len(), |row| (!is_own[row]).then_some(row as u32));
        let (own, count) = (&self.kite_of, self.kite_of.len() + others.len());
        let row = |i: usize| *own.get(i).unwrap_or_else(|| &others[i - own.len()]) as usize;
        let shifts = if self.shifts.is_empty() { Vec::new() } else { parallel::map(count, |i| self.shifts[row(i)]) };
        let kites = parallel::map(count, |i| self.kites[row(i)].map(numbered));
        let fence = Fence { anchors: self.anchors, kites, shifts };
        Grown { net, fence, partner: self.partner, origin: self.origin }
    }
}
