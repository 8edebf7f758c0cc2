//! Prim's tree in the form of maze makers: the part carved so far grows through any one of the doors out of it.

use super::Passage;
use super::neighbours::Neighbours;
use crate::error::Result;
use crate::rng::Rng;
use crate::watch::Watch;

/// Passages, parent and child, in the order of carving. Every door on the rim is as likely as the other.
///
/// # Source
/// Prim: Shortest Connection Networks and Some Generalizations (1957).
pub(super) fn passages(graph: &Neighbours, start: u32, mut rng: Rng, watch: Watch<'_>) -> Result<Vec<Passage>> {
    let cells = graph.cell_of.len() as u32;
    let mut visited = vec![false; cells as usize];
    let mut passages = Vec::with_capacity(visited.len().saturating_sub(1));
    for root in std::iter::once(start).chain(0..cells) {
        let mut rim = vec![(root, [root, 0])];
        let mut step = 0;
        while !rim.is_empty() {
            watch.poll_at(step)?;
            step += 1;
            let (cell, [next, door]) = rim.swap_remove(rng.below(rim.len() as u32) as usize);
            if std::mem::replace(&mut visited[next as usize], true) {
                continue;
            }
            if next != root {
                passages.push(graph.passage(cell, next, door));
            }
            let out = graph.entries_of(next).iter().filter(|[to, _]| !visited[*to as usize]);
            rim.extend(out.map(|&entry| (next, entry)));
        }
    }
    Ok(passages)
}
