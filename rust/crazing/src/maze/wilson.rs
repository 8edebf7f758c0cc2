//! Wilson's tree: random walks without their loops make every spanning tree as likely as the other.

use super::Passage;
use super::neighbours::Neighbours;
use crate::error::Result;
use crate::rng::Rng;
use crate::sets::DisjointSets;
use crate::watch::Watch;

/// Passages, parent and child, each walk from the tree outward.
///
/// # Source
/// Wilson: Generating Random Spanning Trees More Quickly than the Cover Time (STOC 1996).
pub(super) fn passages(graph: &Neighbours, start: u32, mut rng: Rng, watch: Watch<'_>) -> Result<Vec<Passage>> {
    let mut done = roots(graph, start);
    // The last door by which the walk left each cell: taking the last one erases the loops.
    let mut left_by = vec![[0; 2]; done.len()];
    let mut passages = Vec::with_capacity(done.len().saturating_sub(1));
    let mut step = 0;
    for origin in 0..done.len() as u32 {
        let mut at = origin;
        while !done[at as usize] {
            watch.poll_at(step)?;
            step += 1;
            let doors = graph.entries_of(at);
            left_by[at as usize] = doors[rng.below(doors.len() as u32) as usize];
            at = left_by[at as usize][0];
        }
        let (first, mut at) = (passages.len(), origin);
        while !std::mem::replace(&mut done[at as usize], true) {
            let [next, door] = left_by[at as usize];
            passages.push(graph.passage(next, at, door));
            at = next;
        }
        passages[first..].reverse();
    }
    Ok(passages)
}

/// One cell of each connected part, the start in its own: where walks may end. A walk elsewhere would never end.
fn roots(graph: &Neighbours, start: u32) -> Vec<bool> {
    let cells = graph.cell_of.len();
    let mut sets = DisjointSets::new(cells);
    for cell in 0..cells {
        for &[neighbour, _] in graph.entries_of(cell as u32) {
            sets.unite(cell, neighbour as usize);
        }
    }
    let own = sets.lowest(start as usize);
    (0..cells).map(|cell| cell == start as usize || (cell != own && sets.lowest(cell) == cell)).collect()
}
