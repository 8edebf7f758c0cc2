//! Half-edges in the order in which they go round faces.

use super::faces::{Net, rank, turn};
use crate::parallel;

/// The half-edges of a net, walk after walk.
pub(super) struct Halves {
    /// The walk of every half-edge, and where in `row` it is.
    pub(super) seats: Vec<[u32; 2]>,
    pub(super) row: Vec<u32>,
    /// Where each walk starts in `row`, and the end.
    pub(super) starts: Vec<u32>,
}

/// No walk goes along a half-edge yet.
const FREE: u32 = u32::MAX;

impl Halves {
    /// Only links are followed here, one after the other; what the walks are is found from the row, on all cores.
    pub(super) fn of(net: &Net) -> Self {
        let after = after(net);
        let mut seats = vec![[FREE; 2]; after.len()];
        let (mut row, mut starts) = (Vec::with_capacity(after.len()), vec![0]);
        for first in 0..after.len() {
            let mut half = first;
            while seats[half][0] == FREE {
                seats[half] = [starts.len() as u32 - 1, row.len() as u32];
                row.push(half as u32);
                half = after[half] as usize;
            }
            if row.len() > starts[starts.len() - 1] as usize {
                starts.push(row.len() as u32);
            }
        }
        Self { seats, row, starts }
    }

    /// Where a walk is in `row`.
    pub(super) fn part(&self, walk: usize) -> std::ops::Range<usize> {
        self.starts[walk] as usize..self.starts[walk + 1] as usize
    }
}

/// Behind every half-edge: at its end the next one clockwise from the way back.
fn after(net: &Net) -> Vec<u32> {
    let (starts, leaving) = leaving(net);
    let mut after = vec![0; leaving.len()];
    for vertex in starts.windows(2) {
        let around = &leaving[vertex[0] as usize..vertex[1] as usize];
        let before = around.last().into_iter().chain(around);
        around.iter().zip(before).for_each(|(&half, &before)| after[half as usize ^ 1] = before);
    }
    after
}

/// The half-edges that leave every vertex, counter-clockwise; those of vertex `v` from `starts[v]` on.
fn leaving(net: &Net) -> (Vec<u32>, Vec<u32>) {
    let mut starts = vec![0; net.places.len() + 1];
    let mut leaving = vec![0; 2 * net.edges.len()];
    net.edges.as_flattened().iter().for_each(|&vertex| starts[vertex as usize + 1] += 1);
    (0..net.places.len()).for_each(|vertex| starts[vertex + 1] += starts[vertex]);
    let mut next = starts.clone();
    for (half, &vertex) in (0..).zip(net.edges.as_flattened()) {
        let place = &mut next[vertex as usize];
        leaving[*place as usize] = half;
        *place += 1;
    }
    let turns = parallel::map(leaving.len(), |half| turn(net.vector(half)));
    parallel::grouped(
        net.places.len(),
        |vertex| starts[vertex] as usize,
        &mut leaving,
        |vertices, mut rest| {
            for vertex in vertices {
                let around;
                (around, rest) = rest.split_at_mut((starts[vertex + 1] - starts[vertex]) as usize);
                around.sort_by(|&a, &b| {
                    let [a, b] = [a, b].map(|half| half as usize);
                    turns[a].total_cmp(&turns[b]).then(rank(a).cmp(&rank(b)))
                });
            }
        },
    );
    (starts, leaving)
}
