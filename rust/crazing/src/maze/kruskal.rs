//! Kruskal's tree with random weights: doors in random order, opened where they join two parts.

use super::Passage;
use super::neighbours::Neighbours;
use crate::error::Result;
use crate::rng::Rng;
use crate::sets::DisjointSets;
use crate::watch::Watch;

/// Passages in the order of carving.
///
/// # Source
/// Kruskal: On the Shortest Spanning Subtree of a Graph and the Traveling Salesman Problem (1956).
pub(super) fn passages(graph: &Neighbours, mut rng: Rng, watch: Watch<'_>) -> Result<Vec<Passage>> {
    let cells = graph.cell_of.len();
    let mut doors: Vec<(u32, [u32; 2])> = (0..cells as u32)
        .flat_map(|cell| graph.entries_of(cell).iter().map(move |&entry| (cell, entry)))
        .filter(|&(cell, [neighbour, _])| cell < neighbour)
        .collect();
    let mut sets = DisjointSets::new(cells);
    let mut passages = Vec::with_capacity(cells.saturating_sub(1));
    for step in 0..doors.len() {
        watch.poll_at(step)?;
        let drawn = step + rng.below((doors.len() - step) as u32) as usize;
        doors.swap(step, drawn);
        let (cell, [neighbour, door]) = doors[step];
        if sets.unite(cell as usize, neighbour as usize) {
            passages.push(graph.passage(cell, neighbour, door));
        }
    }
    Ok(passages)
}
