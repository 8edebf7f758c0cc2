//! The corners of the cells, as half-edges that know the next of their cell and the one before.

use super::BORDER;
use crate::crack::net::NONE;
use crate::graph::Point;

/// A half-edge, and beside it what is looked at again and again of the vertex where it starts: cells are split in no
/// order of place, and to look it up elsewhere takes longer than all else.
#[derive(Clone, Copy)]
pub(super) struct Corner {
    pub(super) at: Point,
    /// Half-edges, counter-clockwise about the cell.
    pub(super) next: u32,
    pub(super) before: u32,
    /// On the left; -1 outside.
    pub(super) cell: i32,
    /// Periods crossed along the half-edge.
    pub(super) shift: [i8; 2],
    /// Whether a junction or a corner of the bounds is there.
    pub(super) is_node: bool,
    /// Whether its cell is told from here on.
    pub(super) is_first: bool,
}

impl Corner {
    /// Of no cell.
    pub(super) const OUTSIDE: Self =
        Self { at: [0.0; 2], next: 0, before: 0, cell: NONE, shift: [0; 2], is_node: false, is_first: false };
}

/// Two a wall, each at the end where it starts. Those of a wall lie together, and those of a crack do: whoever goes around
/// a cell finds most beside the one before, and to put a junction on a wall nothing else of its cells must be read.
#[derive(Default)]
pub(super) struct Corners {
    pub(super) walls: Vec<Corner>,
    border: Vec<Corner>,
}

impl Corners {
    #[inline]
    pub(super) fn get(&self, half: u32) -> &Corner {
        // One look: numbers of the border are larger than any of these.
        self.walls.get(half as usize).unwrap_or_else(|| &self.border[half as usize - 2 * BORDER as usize])
    }

    #[inline]
    pub(super) fn get_mut(&mut self, half: u32) -> &mut Corner {
        match self.walls.get_mut(half as usize) {
            Some(corner) => corner,
            None => &mut self.border[half as usize - 2 * BORDER as usize],
        }
    }

    /// Those of a new wall, a crack like wall `k` or none like it.
    pub(super) fn push_like(&mut self, k: u32, pair: [Corner; 2]) {
        if k < BORDER { &mut self.walls } else { &mut self.border }.extend(pair);
    }

    /// Lets one half-edge follow another.
    #[inline]
    pub(super) fn link(&mut self, half: u32, next: u32) {
        self.get_mut(half).next = next;
        self.get_mut(next).before = half;
    }

    /// Makes a ring of half-edges, the first of them the first of its cell.
    pub(super) fn close(&mut self, halves: impl Iterator<Item = u32>) {
        let mut halves = halves.peekable();
        let Some(&first) = halves.peek() else { return };
        self.get_mut(first).is_first = true;
        while let Some(half) = halves.next() {
            self.link(half, halves.peek().copied().unwrap_or(first));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rings_of_walls_and_of_the_border_are_closed() {
        let mut corners = Corners::default();
        for k in [0, 1, 2, BORDER, BORDER + 1] {
            corners.push_like(k, [Corner { at: [f64::from(k), 0.0], ..Corner::OUTSIDE }, Corner::OUTSIDE]);
        }
        let ring = [3, 2 * BORDER, 4, 2 * BORDER + 2];
        corners.close(ring.into_iter());
        corners.link(4, 1);
        corners.link(1, 2 * BORDER + 2);
        let wanted = [3, 2 * BORDER, 4, 1, 2 * BORDER + 2];
        for (i, &half) in wanted.iter().enumerate() {
            let corner = corners.get(half);
            assert_eq!((corner.next, corner.before), (wanted[(i + 1) % 5], wanted[(i + 4) % 5]));
            assert_eq!(corner.is_first, i == 0);
        }
        assert_eq!([2, 2 * BORDER].map(|half| corners.get(half).at[0]), [1.0, f64::from(BORDER)]);
    }
}
