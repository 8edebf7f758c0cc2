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
    visited: Vec<bool>,
    /// Entries of each cell that were not drawn yet.
    left: Vec<u32>,
    stack: Vec<u32>,
    passages: Vec<Passage>,
}

impl Search {
    fn new(graph: Neighbours, rng: Rng) -> Self {
        let cells = graph.cell_of.len();
        let left = graph.starts.windows(2).take(cells).map(|pair| pair[1] - pair[0]).collect();
        let passages = Vec::with_capacity(cells.saturating_sub(1));
        Self { graph, rng, visited: vec![false; cells], left, stack: Vec::new(), passages }
    }

    fn run(mut self, start: u32, watch: Watch<'_>) -> Result<Vec<Passage>> {
        for root in std::iter::once(start).chain(0..self.visited.len() as u32) {
            if !self.visited[root as usize] {
                self.visit(root);
                self.explore(watch)?;
            }
        }
        Ok(self.passages)
    }

    fn visit(&mut self, cell: u32) {
        self.visited[cell as usize] = true;
        self.stack.push(cell);
    }

    fn explore(&mut self, watch: Watch<'_>) -> Result<()> {
        let mut step = 0;
        while let Some(&cell) = self.stack.last() {
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
        let start = self.graph.starts[cell as usize] as usize;
        let left = &mut self.left[cell as usize];
        while *left > 0 {
            let drawn = start + self.rng.below(*left) as usize;
            *left -= 1;
            let last = start + *left as usize;
            self.graph.entries.swap(drawn, last);
            let entry = self.graph.entries[last];
            if !self.visited[entry[0] as usize] {
                return Some(entry);
            }
        }
        None
    }
}
