//! Bridges: segments without which the drawing would fall into more pieces.

use super::network::Network;
use crate::error::Result;
use crate::incidence::Incidence;
use crate::watch::Watch;

/// Marks the segments that lie on no loop. Linear.
///
/// # Source
/// Tarjan: A note on finding the bridges of a graph (1974).
pub(super) fn bridges(network: &Network, at: &Incidence, watch: Watch<'_>) -> Result<Vec<bool>> {
    let mut search = Search {
        network,
        at,
        number: vec![0; network.degree.len()],
        low: vec![0; network.degree.len()],
        is_bridge: vec![false; network.count()],
        count: 0,
    };
    for segment in 0..network.count() {
        watch.poll_at(segment)?;
        let root = network.ends[segment][0];
        if search.number[root as usize] == 0 {
            search.from(root, watch)?;
        }
    }
    Ok(search.is_bridge)
}

struct Search<'a> {
    network: &'a Network,
    at: &'a Incidence,
    /// Order of first visit, from 1; 0 is unseen.
    number: Vec<u32>,
    /// The first visited vertex that can be reached from here without the way that led here.
    low: Vec<u32>,
    is_bridge: Vec<bool>,
    count: u32,
}

impl Search<'_> {
    /// Visits all that hangs together with `root`, on a stack of its own: cracks are deep.
    fn from(&mut self, root: u32, watch: Watch<'_>) -> Result<()> {
        self.visit(root);
        // Vertex, segment that led here, next of its ends to look at.
        let mut stack = vec![(root, u32::MAX, 0_usize)];
        while let Some((vertex, entered, next)) = stack.last_mut() {
            let (vertex, entered) = (*vertex, *entered);
            let Some(&end) = self.at.at(vertex as usize).get(*next) else {
                stack.pop();
                self.leave(vertex, entered, stack.last().map(|&(above, ..)| above));
                continue;
            };
            *next += 1;
            watch.poll_at(*next)?;
            let segment = end / 2;
            let other = self.network.ends[segment as usize][1 - end as usize % 2];
            if segment == entered {
                continue;
            }
            if self.number[other as usize] == 0 {
                self.visit(other);
                stack.push((other, segment, 0));
            } else {
                self.low[vertex as usize] = self.low[vertex as usize].min(self.number[other as usize]);
            }
        }
        Ok(())
    }

    fn visit(&mut self, vertex: u32) {
        self.count += 1;
        self.number[vertex as usize] = self.count;
        self.low[vertex as usize] = self.count;
    }

    fn leave(&mut self, vertex: u32, entered: u32, above: Option<u32>) {
        let Some(above) = above else { return };
        let low = self.low[vertex as usize];
        self.low[above as usize] = self.low[above as usize].min(low);
        self.is_bridge[entered as usize] = low > self.number[above as usize];
    }
}
