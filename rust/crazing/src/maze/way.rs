//! Ways through open doors: the shortest, the longest, and how far every cell is.

use super::neighbours::Neighbours;
use crate::error::{Error, Result};
use crate::watch::Watch;

/// The cells along the shortest way from `source` to `target` through open doors, by breadth-first search; empty when
/// there is none.
///
/// # Errors
/// [`Error::BadIndex`] when either is no cell, [`Error::Interrupted`].
///
/// # Source
/// Thesis, section 7.1.
pub fn solve(
    cells: usize,
    sides: &[[i32; 2]],
    open: &[bool],
    source: usize,
    target: usize,
    watch: Watch<'_>,
) -> Result<Vec<i32>> {
    check_cell("source", source, cells)?;
    check_cell("target", target, cells)?;
    let graph = Neighbours::of(cells, sides, open);
    let [source, target] = [source, target].map(|cell| graph.rank_of[cell]);
    // From the target, so that following the links from the source gives the way in its order.
    let mut search = Search::new(&graph);
    search.run(target, Some(source), watch)?;
    Ok(search.way(source))
}

fn check_cell(array: &'static str, cell: usize, cells: usize) -> Result<()> {
    let bad = Error::BadIndex { array, row: 0, value: cell as i64, low: 0, limit: cells as i64 };
    if cell < cells { Ok(()) } else { Err(bad) }
}

/// How many open doors lie between `source` and every cell; -1 where no way leads.
///
/// # Errors
/// [`Error::BadIndex`] when the source is no cell, [`Error::Interrupted`].
pub fn distances(cells: usize, sides: &[[i32; 2]], open: &[bool], source: usize, watch: Watch<'_>) -> Result<Vec<i32>> {
    check_cell("source", source, cells)?;
    let graph = Neighbours::of(cells, sides, open);
    let mut search = Search::new(&graph);
    search.run(graph.rank_of[source], None, watch)?;
    let mut found = vec![-1; cells];
    for &cell in &search.queue {
        let (at, before) = (graph.cell_of[cell as usize], graph.cell_of[search.toward[cell as usize] as usize]);
        found[at as usize] = if at == before { 0 } else { found[before as usize] + 1 };
    }
    Ok(found)
}

/// The cells along the longest way that a maze has without a cycle among its open doors; empty without cells.
///
/// In a tree the cell farthest from any cell is an end of a longest way: two searches in every connected part.
///
/// # Errors
/// [`Error::Interrupted`].
pub fn longest(cells: usize, sides: &[[i32; 2]], open: &[bool], watch: Watch<'_>) -> Result<Vec<i32>> {
    let graph = Neighbours::of(cells, sides, open);
    let (mut first, mut second) = (Search::new(&graph), Search::new(&graph));
    let mut best = Vec::new();
    for root in 0..cells as u32 {
        if first.toward[root as usize] == UNSEEN {
            let end = first.run(root, None, watch)?;
            let other = second.run(end, None, watch)?;
            // A part of no more cells than the best way has cannot hold a longer one.
            if first.queue.len() > best.len() {
                let way = second.way(other);
                best = if way.len() > best.len() { way } else { best };
            }
        }
    }
    Ok(best)
}

/// Not reached by the search.
const UNSEEN: u32 = u32::MAX;

/// A breadth-first search, by ranks.
struct Search<'a> {
    graph: &'a Neighbours,
    /// The neighbour of each cell that is one door nearer to the root; the root's is itself.
    toward: Vec<u32>,
    /// The cells of the last run in the order they were reached.
    queue: Vec<u32>,
}

impl<'a> Search<'a> {
    fn new(graph: &'a Neighbours) -> Self {
        Self { graph, toward: vec![UNSEEN; graph.cell_of.len()], queue: Vec::new() }
    }

    /// Reaches all cells from `root`, or those up to the distance of `goal`; the last one reached.
    fn run(&mut self, root: u32, goal: Option<u32>, watch: Watch<'_>) -> Result<u32> {
        self.queue.clear();
        self.queue.push(root);
        self.toward[root as usize] = root;
        let mut next = 0;
        while next < self.queue.len() && goal.is_none_or(|goal| self.toward[goal as usize] == UNSEEN) {
            watch.poll_at(next)?;
            let cell = self.queue[next];
            next += 1;
            for &[neighbour, _] in self.graph.entries_of(cell) {
                if self.toward[neighbour as usize] == UNSEEN {
                    self.toward[neighbour as usize] = cell;
                    self.queue.push(neighbour);
                }
            }
        }
        Ok(self.queue.last().copied().unwrap_or(root))
    }

    /// The cells from `at` to the root; none when the search did not reach it.
    fn way(&self, mut at: u32) -> Vec<i32> {
        let mut way = Vec::new();
        while self.toward[at as usize] != UNSEEN {
            way.push(self.graph.cell_of[at as usize]);
            if self.toward[at as usize] == at {
                break;
            }
            at = self.toward[at as usize];
        }
        way
    }
}
