//! Which older strands a strand meets at its ends: its parent is among them, and its generation follows.

use super::Strands;
use crate::crack::net::{Ends, NONE, NetView};
use crate::parallel;

/// The older strands that each run meets at its ends.
pub(in crate::crack) struct Older {
    /// Where those of each run start, and the end.
    starts: Vec<u32>,
    strands: Vec<i32>,
}

/// Finds who meets whom, in the order of the runs, where memory is near.
pub(super) fn met(net: NetView<'_>, ends: Option<&Ends>, found: &mut Strands) -> Older {
    let tips = |run: usize| match found.entries_of(run) {
        [first, .., last] => [*first, last ^ 1],
        [only] => [*only, only ^ 1],
        [] => [0, 0],
    };
    let runs = found.strand.len();
    let own = ends.is_none().then(|| {
        let mut is_tip = vec![false; net.vertices.len()];
        (0..runs).flat_map(tips).for_each(|end| is_tip[net.vertex(end)] = true);
        Ends::at_some(net, |vertex| is_tip[vertex])
    });
    let Some(ends) = ends.or(own.as_ref()) else {
        return Older { starts: vec![0; runs + 1], strands: Vec::new() };
    };
    let mut alone = vec![[false; 2]; runs];
    let met = parallel::fill(&mut alone, |range, alone| {
        let (mut older, mut starts) = (Vec::new(), Vec::with_capacity(range.len()));
        for (run, alone) in range.zip(alone) {
            starts.push(older.len() as u32);
            let here = tips(run).map(|tip| ends.at(net.vertex(tip)));
            *alone = here.map(|here| here.len() == 1);
            let all = here.into_iter().flatten().map(|&end| found.of_edge[end as usize / 2]);
            older.extend(all.filter(|&other| other < found.strand[run] as i32));
        }
        (older, starts)
    });
    let (mut older, mut starts) = (Vec::new(), Vec::with_capacity(runs + 1));
    for (some, from) in met {
        starts.extend(from.into_iter().map(|start| older.len() as u32 + start));
        older.extend(some);
    }
    starts.push(older.len() as u32);
    found.alone = alone;
    Older { starts, strands: older }
}

impl Older {
    /// The generation and the parent of every strand; `run` is that of each.
    pub(in crate::crack) fn descend(&self, run: &[u32]) -> (Vec<i32>, Vec<i32>) {
        let (mut generation, mut parents): (Vec<i32>, _) =
            (Vec::with_capacity(run.len()), Vec::with_capacity(run.len()));
        for &run in run {
            let older = &self.strands[self.starts[run as usize] as usize..self.starts[run as usize + 1] as usize];
            // Older strands have their generation already.
            let parent = older.iter().max_by_key(|&&other| (generation[other as usize], std::cmp::Reverse(other)));
            generation.push(parent.map_or(0, |&other| generation[other as usize] + 1));
            parents.push(parent.map_or(NONE, |&other| other));
        }
        (generation, parents)
    }
}
