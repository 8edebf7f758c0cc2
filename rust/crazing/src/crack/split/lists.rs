//! The corners of each cell, in one table: cells grow and part, and each is read as a whole.

use std::ops::Range;

use crate::graph::Point;

/// Corners that a cell gets from its neighbours before it must move, usually.
const SPARE: usize = 4;

/// A half-edge of a cell, and beside it what is looked at again and again of the vertex where it starts: cells are
/// split in no order of place, and to look it up elsewhere takes longer than all else.
#[derive(Clone, Copy, Default)]
pub(super) struct Corner {
    pub(super) at: Point,
    pub(super) half: u32,
    /// Periods crossed along the half-edge.
    pub(super) shift: [i8; 2],
    /// Whether a junction or a corner of the bounds is there.
    pub(super) is_node: bool,
}

#[derive(Clone, Copy)]
struct Row {
    start: usize,
    count: u32,
    room: u32,
}

impl Row {
    fn range(&self) -> Range<usize> {
        self.start..self.start + self.count as usize
    }
}

/// A list a cell, each with some room behind it; one that needs more moves to the end of the table.
pub(super) struct Lists {
    table: Vec<Corner>,
    rows: Vec<Row>,
}

impl Lists {
    /// Of one cell.
    pub(super) fn of(corners: impl Iterator<Item = Corner>) -> Self {
        let table: Vec<Corner> = corners.collect();
        let count = table.len() as u32;
        Self { table, rows: vec![Row { start: 0, count, room: count }] }
    }

    /// How many cells there are.
    pub(super) fn len(&self) -> usize {
        self.rows.len()
    }

    #[inline]
    pub(super) fn list(&self, cell: usize) -> &[Corner] {
        &self.table[self.rows[cell].range()]
    }

    #[inline]
    pub(super) fn list_mut(&mut self, cell: usize) -> &mut [Corner] {
        &mut self.table[self.rows[cell].range()]
    }

    pub(super) fn insert(&mut self, cell: usize, place: usize, corner: Corner) {
        self.want(cell, 1);
        let row = &mut self.rows[cell];
        let Range { start, end } = row.range();
        self.table.copy_within(start + place..end, start + place + 1);
        self.table[start + place] = corner;
        row.count += 1;
    }

    /// A new cell with those from `end` on, and `two`; the others and `one` stay.
    pub(super) fn share(
        &mut self,
        cell: usize,
        end: usize,
        one: impl ExactSizeIterator<Item = Corner>,
        two: impl ExactSizeIterator<Item = Corner>,
    ) -> usize {
        let old = self.rows[cell].range();
        let start = self.table.len();
        self.table.extend_from_within(old.start + end..old.end);
        self.table.extend(two);
        let count = self.table.len() - start;
        self.table.resize(start + count + SPARE, Corner::default());
        self.rows.push(Row { start, count: count as u32, room: (count + SPARE) as u32 });
        self.rows[cell].count = end as u32;
        self.want(cell, one.len());
        let row = &mut self.rows[cell];
        let free = &mut self.table[row.range().end..];
        row.count += one.len() as u32;
        free.iter_mut().zip(one).for_each(|(slot, corner)| *slot = corner);
        self.rows.len() - 1
    }

    /// Makes room for so many more corners of a cell.
    fn want(&mut self, cell: usize, more: usize) {
        let row = &mut self.rows[cell];
        let wanted = row.count as usize + more;
        if wanted <= row.room as usize {
            return;
        }
        let start = self.table.len();
        self.table.extend_from_within(row.range());
        (row.start, row.room) = (start, (wanted + SPARE) as u32);
        self.table.resize(start + wanted + SPARE, Corner::default());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Rng, stream};

    fn corner(half: u32) -> Corner {
        Corner { half, ..Corner::default() }
    }

    #[test]
    fn lists_are_those_of_their_own_memory() {
        let mut rng = Rng::new([1, 2], stream::SPLIT);
        let (mut lists, mut wanted) = (Lists::of((0..4).map(corner)), vec![vec![0, 1, 2, 3]]);
        for step in 0..3000_u32 {
            let cell = rng.below(wanted.len() as u32) as usize;
            let place = rng.below(wanted[cell].len() as u32 + 1) as usize;
            if step % 3 > 0 {
                lists.insert(cell, place, corner(1000 + step));
                wanted[cell].insert(place, 1000 + step);
                continue;
            }
            let mut given = wanted[cell].split_off(place);
            let (one, two) = (rng.below(12), rng.below(12));
            wanted[cell].extend(0..one);
            given.extend(100..100 + two);
            wanted.push(given);
            let fresh = lists.share(
                cell,
                place,
                (0..one as usize).map(|i| corner(i as u32)),
                (100..100 + two as usize).map(|i| corner(i as u32)),
            );
            assert_eq!((fresh, lists.len()), (wanted.len() - 1, wanted.len()));
        }
        for (cell, wanted) in wanted.iter().enumerate() {
            assert_eq!(&lists.list(cell).iter().map(|corner| corner.half).collect::<Vec<_>>(), wanted);
        }
    }
}
