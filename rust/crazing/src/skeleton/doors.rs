//! The sides through which a walk has entered cells, each once.

use super::links::NONE;

/// What a side turns out to be when it is noted.
pub(super) enum Noted {
    /// It has been entered through.
    Known,
    /// It leads into a cell that has been entered through another.
    Door,
    /// It leads into another cell; of [`Many`], into any.
    Cell,
    /// There is no room for it.
    TooMany,
}

/// Sides in the order in which they were noted.
pub(super) trait Doors {
    /// The side that was noted after so many others.
    fn at(&self, place: usize) -> Option<u32>;

    /// Makes a note of a side that begins at a site.
    fn note(&mut self, site: i32, side: u32) -> Noted;
}

/// So few that all are looked at.
pub(super) struct Few<const MOST: usize> {
    entered: [(i32, u32); MOST],
    count: usize,
}

impl<const MOST: usize> Default for Few<MOST> {
    fn default() -> Self {
        Self { entered: [(0, 0); MOST], count: 0 }
    }
}

impl<const MOST: usize> Doors for Few<MOST> {
    #[inline]
    fn at(&self, place: usize) -> Option<u32> {
        self.entered[..self.count].get(place).map(|&(_, side)| side)
    }

    #[inline]
    fn note(&mut self, site: i32, side: u32) -> Noted {
        let mut is_new = true;
        for &(known, from) in &self.entered[..self.count] {
            if from == side {
                return Noted::Known;
            }
            is_new &= known != site;
        }
        let Some(slot) = self.entered.get_mut(self.count) else { return Noted::TooMany };
        *slot = (site, side);
        self.count += 1;
        if is_new { Noted::Cell } else { Noted::Door }
    }
}

/// A table of them, twice as large as they are many.
pub(super) struct Many {
    sides: Vec<u32>,
    most: usize,
    slots: Vec<u32>,
}

impl Many {
    pub(super) fn new(most: usize) -> Self {
        Self { sides: Vec::new(), most, slots: vec![NONE; 256] }
    }

    /// Where a side stands, or would.
    fn slot(&self, side: u32) -> usize {
        let last = self.slots.len() - 1;
        // Fibonacci hashing: the odd number next to 2^32 over the golden ratio.
        let mut slot = (side.wrapping_mul(0x9E37_79B9) >> 8) as usize & last;
        while self.slots[slot] != NONE && self.slots[slot] != side {
            slot = (slot + 1) & last;
        }
        slot
    }

    fn grow(&mut self) {
        self.slots = vec![NONE; 2 * self.slots.len()];
        for i in 0..self.sides.len() {
            let slot = self.slot(self.sides[i]);
            self.slots[slot] = self.sides[i];
        }
    }
}

impl Doors for Many {
    fn at(&self, place: usize) -> Option<u32> {
        self.sides.get(place).copied()
    }

    fn note(&mut self, _: i32, side: u32) -> Noted {
        let slot = self.slot(side);
        if self.slots[slot] == side {
            return Noted::Known;
        }
        if self.sides.len() == self.most {
            return Noted::TooMany;
        }
        self.slots[slot] = side;
        self.sides.push(side);
        if 2 * self.sides.len() > self.slots.len() {
            self.grow();
        }
        Noted::Cell
    }
}
