//! Growth: when a crack reaches each of its places.

use super::net::{Ends, NONE, NetView};

/// The last strand starts after this many times the time that the longest one takes.
const STAGGER: f64 = 1.5;

/// When the crack gets to both ends of every edge, 0 to 1; `strand` and `parent` are those of every edge.
///
/// Strands are due one after the other, the oldest first, and wait until their parent is there, which younger ones may
/// not have to; from the parent, or from their middle, tips advance at one speed.
pub fn arrivals(net: NetView<'_>, strand: &[i32], parent: &[i32]) -> Vec<[f64; 2]> {
    let ends = ByStrand { ends: Ends::of(net).sorted_by_key(|end| strand[end as usize / 2]), strand };
    let count = strand.iter().max().map_or(0, |&last| last as usize + 1);
    let runs = runs(net, strand, &ends, count);
    let longest = runs.iter().map(|run| run.length).fold(0.0, f64::max);
    let mut arrivals = vec![[f64::INFINITY; 2]; net.edges.len()];
    for (place, run) in runs.iter().enumerate() {
        let Some(&first) = run.entries.first() else { continue };
        let stagger = STAGGER * longest * place as f64 / count as f64;
        // When the parent is at either end of the strand.
        let met = |end: u32| {
            let there = ends.at(net.vertex(end), parent[first as usize / 2]).iter();
            there.map(|&end| arrivals[end as usize / 2][end as usize % 2]).fold(f64::INFINITY, f64::min)
        };
        let last = run.entries.last().map_or(first, |&entry| entry ^ 1);
        let (near, far) =
            if parent[first as usize / 2] == NONE { (f64::INFINITY, f64::INFINITY) } else { (met(first), met(last)) };
        let middle = || {
            let mut at = 0.0;
            let half = |entry: &u32| {
                at += net.length(*entry as usize / 2);
                at
            };
            // The vertex nearest the middle: tips leave it on both sides.
            run.entries.iter().map(half).find(|&at| at >= run.length / 2.0).unwrap_or(0.0)
        };
        let (origin, start) = if near.is_finite() {
            (0.0, near)
        } else if far.is_finite() {
            (run.length, far)
        } else {
            (middle(), 0.0)
        };
        let start = start.max(stagger);
        let mut at = 0.0;
        for &entry in &run.entries {
            let (edge, side) = (entry as usize / 2, entry as usize % 2);
            arrivals[edge][side] = start + (at - origin).abs();
            at += net.length(edge);
            arrivals[edge][1 - side] = start + (at - origin).abs();
        }
    }
    let end = arrivals.iter().flatten().fold(0.0_f64, |end, &time| end.max(time));
    arrivals.iter().map(|pair| pair.map(|time| if end > 0.0 { time / end } else { 0.0 })).collect()
}

/// The ends at every vertex by strand: of the many strands that may meet in one place each asks for one.
struct ByStrand<'a> {
    ends: Ends,
    strand: &'a [i32],
}

impl ByStrand<'_> {
    /// The ends of a strand at a vertex, ascending.
    fn at(&self, vertex: usize, strand: i32) -> &[u32] {
        let of = |end: &u32| self.strand[*end as usize / 2];
        let here = self.ends.at(vertex);
        let here = &here[here.partition_point(|end| of(end) < strand)..];
        &here[..here.partition_point(|end| of(end) == strand)]
    }
}

struct Run {
    entries: Vec<u32>,
    length: f64,
}

/// The edges of each strand in turn, as ends to enter them by.
fn runs(net: NetView<'_>, strand: &[i32], ends: &ByStrand<'_>, count: usize) -> Vec<Run> {
    let mut runs: Vec<Run> = (0..count).map(|_| Run { entries: Vec::new(), length: 0.0 }).collect();
    let mut seen = vec![false; net.edges.len()];
    let next = |end: u32, seen: &[bool]| {
        let here = ends.at(net.vertex(end), strand[end as usize / 2]).iter().copied();
        here.filter(|&other| other != end).find(|&other| !seen[other as usize / 2])
    };
    let all = 0..2 * net.edges.len() as u32;
    let is_tip = |end: &u32| ends.at(net.vertex(*end), strand[*end as usize / 2]).len() == 1;
    // From tips; what has none is a ring.
    for end in all.clone().filter(is_tip).chain(all) {
        let run = &mut runs[strand[end as usize / 2] as usize];
        let mut entry = Some(end).filter(|&end| !seen[end as usize / 2]);
        while let Some(end) = entry {
            seen[end as usize / 2] = true;
            run.entries.push(end);
            run.length += net.length(end as usize / 2);
            entry = next(end ^ 1, &seen);
        }
    }
    runs
}
