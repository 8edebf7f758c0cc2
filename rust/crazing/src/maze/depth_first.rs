//! The thesis' tree: a depth-first search.

use super::Passage;
use super::neighbours::Neighbours;
use crate::error::Result;
use crate::rng::Rng;
use crate::watch::Watch;

/// Passages, parent and child, in the order of carving.
///
/// # Source
/// Thesis, section 7.
pub(super) fn passages(graph: Neighbours, start: u32, rng: Rng, watch: Watch<'_>) -> Result<Vec<Passage>> {
    Search::new(graph, rng).run(start, watch)
}

/// A depth-first search with a stack of its own.
struct Search {
    graph: Neighbours,
    rng: Rng,
    /// A bit for every cell: all of them stay in the fastest memory.
    visited: Vec<u64>,
    unvisited: usize,
    /// Where the entries of each cell that were not drawn yet start and end.
    left: Vec<[u32; 2]>,
    stack: Vec<u32>,
    passages: Vec<Passage>,
}

impl Search {
    fn new(graph: Neighbours, rng: Rng) -> Self {
        let cells = graph.cell_of.len();
        let left = graph.starts.windows(2).take(cells).map(|pair| [pair[0], pair[1]]).collect();
        let passages = Vec::with_capacity(cells.saturating_sub(1));
        let visited = vec![0; cells.div_ceil(64)];
        Self { graph, rng, visited, unvisited: cells, left, stack: Vec::new(), passages }
    }

    fn run(mut self, start: u32, watch: Watch<'_>) -> Result<Vec<Passage>> {
        for root in std::iter::once(start).chain(0..self.left.len() as u32) {
            if !self.is_visited(root) {
                self.visit(root);
                self.explore(watch)?;
            }
        }
        Ok(self.passages)
    }

    fn is_visited(&self, cell: u32) -> bool {
        self.visited[cell as usize / 64] >> (cell % 64) & 1 == 1
    }

    fn visit(&mut self, cell: u32) {
        self.visited[cell as usize / 64] |= 1 << (cell % 64);
        self.unvisited -= 1;
        self.stack.push(cell);
    }

    fn explore(&mut self, watch: Watch<'_>) -> Result<()> {
        let mut step = 0;
        // On the way back from the last cell there is nothing to be found.
        while self.unvisited > 0
            && let Some(&cell) = self.stack.last()
        {
            watch.poll_at(step)?;
            step += 1;
            match self.draw(cell) {
                Some([next, door]) => {
                    self.passages.push(self.graph.passage(cell, next, door));
                    self.visit(next);
                }
                None => {
                    self.stack.pop();
                }
            }
        }
        Ok(())
    }

    /// One of the unvisited neighbours. Entries are drawn without return and those visited passed over, which makes
    /// every unvisited one as likely as the other and looks at each entry once in all.
    fn draw(&mut self, cell: u32) -> Option<[u32; 2]> {
        let [start, mut end] = self.left[cell as usize];
        let mut found = None;
        while end > start && found.is_none() {
            let drawn = start + self.rng.below(end - start);
            end -= 1;
            self.graph.entries.swap(drawn as usize, end as usize);
            let entry = self.graph.entries[end as usize];
            found = (!self.is_visited(entry[0])).then_some(entry);
        }
        self.left[cell as usize][1] = end;
        found
    }
}
