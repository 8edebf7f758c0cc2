//! The sides through which a walk has entered cells, each once.

/// Marks in one number.
const WORD: usize = u64::BITS as usize;

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

/// So many that they are marked, a bit each side of the diagram: those of neighbouring cells lie near each other.
#[derive(Default)]
pub(super) struct Many {
    sides: Vec<u32>,
    marks: Vec<u64>,
    most: usize,
}

impl Many {
    /// For walks in a diagram of so many sides.
    pub(super) fn of(sides: usize) -> Self {
        Self { sides: Vec::new(), marks: vec![0; sides.div_ceil(WORD)], most: 0 }
    }

    /// None of them, ready for `most`.
    pub(super) fn emptied(&mut self, most: usize) -> &mut Self {
        // Whole words: what else is marked in them goes, too.
        self.sides.drain(..).for_each(|side| self.marks[side as usize / WORD] = 0);
        self.most = most;
        self
    }
}

impl Doors for &mut Many {
    fn at(&self, place: usize) -> Option<u32> {
        self.sides.get(place).copied()
    }

    #[inline]
    fn note(&mut self, _: i32, side: u32) -> Noted {
        let (word, bit) = (&mut self.marks[side as usize / WORD], 1 << (side as usize % WORD));
        if *word & bit != 0 {
            return Noted::Known;
        }
        if self.sides.len() == self.most {
            return Noted::TooMany;
        }
        *word |= bit;
        self.sides.push(side);
        Noted::Cell
    }
}

#[cfg(test)]
mod tests {
    use super::{Doors, Many, Noted};

    #[test]
    fn a_walk_knows_nothing_of_the_one_before() {
        let mut many = Many::of(200);
        for sides in [[3, 64, 199], [199, 3, 65]] {
            let mut doors = many.emptied(2);
            assert!(doors.at(0).is_none());
            assert!(matches!(doors.note(0, sides[0]), Noted::Cell));
            assert!(matches!(doors.note(7, sides[0]), Noted::Known));
            assert!(matches!(doors.note(0, sides[1]), Noted::Cell));
            assert!(matches!(doors.note(0, sides[2]), Noted::TooMany));
            assert!(matches!(doors.note(0, sides[1]), Noted::Known));
            assert_eq!([0, 1, 2].map(|place| doors.at(place)), [Some(sides[0]), Some(sides[1]), None]);
        }
    }
}
