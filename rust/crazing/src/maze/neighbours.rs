//! The doors of every cell in one row.

use super::Passage;

/// The neighbours of every cell and the doors to them, in one row.
///
/// Cells are renumbered by first appearance in `sides`: the edges of a diagram follow a curve through the plane, so
/// cells that are neighbours come to lie close in memory, which makes the search several times faster.
pub(super) struct Neighbours {
    pub(super) cell_of: Vec<i32>,
    pub(super) rank_of: Vec<u32>,
    /// Where the entries of each cell start, and the end.
    pub(super) starts: Vec<u32>,
    /// Rank of the neighbour, and the door.
    pub(super) entries: Vec<[u32; 2]>,
}

impl Neighbours {
    pub(super) fn of(cells: usize, sides: &[[i32; 2]], door: &[bool]) -> Self {
        let doors = || (0..sides.len()).filter(|&k| door[k] && !sides[k].contains(&-1));
        let mut cell_of = Vec::with_capacity(cells);
        let mut rank_of = vec![u32::MAX; cells];
        let mut starts = vec![0_u32; cells + 2];
        // Kept, since cells in the user's order are all over the memory: looking their ranks up is most of the work.
        let mut ranks = Vec::with_capacity(sides.len());
        for (first, block) in sides.chunks(BLOCK).enumerate().map(|(i, block)| (i * BLOCK, block)) {
            // Many at once, so that memory is waited for once.
            let mut seen = [[u32::MAX; 2]; BLOCK];
            for (seen, ends) in seen.iter_mut().zip(block) {
                *seen = ends.map(|cell| rank_of.get(cell as usize).copied().unwrap_or(u32::MAX));
            }
            for (i, ends) in block.iter().enumerate().filter(|&(i, ends)| door[first + i] && !ends.contains(&-1)) {
                let ends = [0, 1].map(|side| match seen[i][side] {
                    u32::MAX => ranked(ends[side], &mut rank_of, &mut cell_of),
                    rank => rank,
                });
                ends.iter().for_each(|&rank| starts[rank as usize + 2] += 1);
                ranks.push(ends);
            }
        }
        // Cells without a door come last.
        (0..cells as i32).for_each(|cell| _ = ranked(cell, &mut rank_of, &mut cell_of));
        for i in 2..starts.len() {
            starts[i] += starts[i - 1];
        }
        let mut entries = vec![[0; 2]; starts[cells + 1] as usize];
        for (k, [a, b]) in doors().zip(ranks) {
            for (from, to) in [(a, b), (b, a)] {
                // Counted two places on, filled one place on: what is left at the end are the starts.
                let place = &mut starts[from as usize + 1];
                entries[*place as usize] = [to, k as u32];
                *place += 1;
            }
        }
        Self { cell_of, rank_of, starts, entries }
    }

    /// The passage between two ranks.
    pub(super) fn passage(&self, from: u32, to: u32, door: u32) -> Passage {
        ([from, to].map(|rank| self.cell_of[rank as usize]), door)
    }

    pub(super) fn entries_of(&self, cell: u32) -> &[[u32; 2]] {
        &self.entries[self.starts[cell as usize] as usize..self.starts[cell as usize + 1] as usize]
    }
}

/// Rows that are looked up together.
const BLOCK: usize = 32;

/// The rank of a cell, the next one if it has none.
fn ranked(cell: i32, rank_of: &mut [u32], cell_of: &mut Vec<i32>) -> u32 {
    let rank = &mut rank_of[cell as usize];
    if *rank == u32::MAX {
        *rank = cell_of.len() as u32;
        cell_of.push(cell);
    }
    *rank
}
