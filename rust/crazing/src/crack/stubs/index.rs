//! Which kite is about two points.

use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

use crate::parallel;

/// Rows of kites by their two ends, whichever is first: lists of rows that share a hash.
pub(super) struct Index {
    /// The last row of every list; there are a power of two.
    last: Vec<u32>,
    /// The row before each in its list.
    before: Vec<u32>,
}

impl Index {
    const END: u32 = u32::MAX;

    /// Kites are looked for by an apex of another and one of its ends: rows of which no end is an apex are left out,
    /// in a maze all. What grows is inserted.
    pub(super) fn of(kites: &[[i32; 4]], points: usize) -> Self {
        let is_apex = parallel::map(points, |_| AtomicBool::new(false));
        parallel::each(kites.len(), |row| {
            let [_, _, left, right] = kites[row];
            [left, right]
                .iter()
                .filter_map(|&apex| is_apex.get(apex as usize))
                .for_each(|slot| slot.store(true, Relaxed));
        });
        let is_one = |end: i32| is_apex[end as usize].load(Relaxed);
        let wanted = |row: usize| (is_one(kites[row][0]) || is_one(kites[row][1])).then_some(row as u32);
        let wanted = parallel::compact(kites.len(), wanted);
        let lists = (wanted.len() + kites.len() / 4).next_power_of_two().max(16);
        let before = if wanted.is_empty() { Vec::new() } else { vec![Self::END; kites.len()] };
        let mut index = Self { last: vec![Self::END; lists], before };
        wanted.iter().for_each(|&row| index.insert([kites[row as usize][0], kites[row as usize][1]], row as usize));
        index
    }

    /// Points that are near have numbers that are near, and so have their lists: in any other order memory is waited for.
    /// Both ends count, or all edges of a star would share a list, but not alike, or those across a strip would; and
    /// 1 + 6 is odd, so that those of a row of points have all lists.
    fn list(&self, [a, b]: [i32; 2]) -> usize {
        let both = a.min(b) as u64 + 6 * a.max(b) as u64;
        both as usize & (self.last.len() - 1)
    }

    pub(super) fn insert(&mut self, ends: [i32; 2], row: usize) {
        let list = self.list(ends);
        if row >= self.before.len() {
            self.before.resize(row + 1, Self::END);
        }
        self.before[row] = std::mem::replace(&mut self.last[list], row as u32);
    }

    pub(super) fn remove(&mut self, ends: [i32; 2], row: usize) {
        let list = self.list(ends);
        let (mut at, next) = (self.last[list], self.before.get(row).copied().unwrap_or(Self::END));
        if at as usize == row {
            self.last[list] = next;
            return;
        }
        while at != Self::END {
            let before = self.before[at as usize];
            if before as usize == row {
                self.before[at as usize] = next;
                return;
            }
            at = before;
        }
    }

    /// The last row about two ends.
    pub(super) fn find(&self, ends: [i32; 2], kites: &[[i32; 4]]) -> Option<usize> {
        let mut row = self.last[self.list(ends)];
        while let Some(kite) = kites.get(row as usize) {
            if [kite[0], kite[1]] == ends || [kite[1], kite[0]] == ends {
                return Some(row as usize);
            }
            row = self.before[row as usize];
        }
        None
    }
}
