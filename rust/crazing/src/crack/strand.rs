//! Strands: at every vertex the edges that continue each other best are one crack.

mod older;

use std::sync::atomic::{AtomicI32, AtomicU64, Ordering::Relaxed};

use super::net::{Ends, NONE, NetView, length};
use crate::graph::Point;
use crate::parallel;
pub(super) use older::Older;
use older::met;

/// Beyond the first pair of a vertex, edges are joined only while the cosine between them is below this.
const STRAIGHT: f64 = -0.2;
/// Vertices with more edges than this are stars: only edges half a turn apart in their order are compared, since all
/// pairs would be quadratic (the centre of a regular polygon is a vertex of every cell).
const STAR: usize = 8;

/// The strands of a graph. Ends are numbered 2 edge + side.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Strands {
    /// The strand of each edge; strand 0 is the oldest.
    pub of_edge: Vec<i32>,
    /// The strand that each strand abuts: of the older ones at its ends the youngest, or -1.
    pub parent: Vec<i32>,
    /// The generation of each edge's strand: 0 abuts no older strand, others are one more than the youngest older
    /// strand they abut.
    pub generation: Vec<i32>,
    /// The ends of the edges along each run in turn: an end to enter an edge by. A run is the edges of a strand; runs
    /// stand as they were found, so that neighbours in the drawing are near.
    pub entries: Vec<u32>,
    /// Where each run starts in `entries`, and the end.
    pub starts: Vec<usize>,
    /// The strand of each run.
    pub strand: Vec<u32>,
    /// The run of each strand.
    pub run: Vec<u32>,
    /// Whether no other edge ends where each run starts, and where it ends.
    pub alone: Vec<[bool; 2]>,
    /// Length of each strand.
    pub length: Vec<f64>,
    /// Length of each run.
    pub(super) long: Vec<f64>,
    /// The run of each edge.
    pub(super) run_of: Vec<u32>,
    /// How far along its run each edge is entered.
    pub(super) before: Vec<f64>,
    /// Whether each edge is entered by its second end.
    pub(super) turned: Vec<bool>,
}

impl Strands {
    /// The ends of the edges along a strand in turn.
    pub fn along(&self, strand: usize) -> &[u32] {
        self.entries_of(self.run[strand] as usize)
    }

    /// The strand of each edge; all else is let go.
    pub(super) fn into_of_edge(self) -> Vec<i32> {
        self.of_edge
    }

    pub(super) fn entries_of(&self, run: usize) -> &[u32] {
        &self.entries[self.starts[run]..self.starts[run + 1]]
    }
}

/// Follows the best-aligned pairs of edges through a drawing; `partner` is what [`pairs`] gives.
///
/// `age` of every edge, low is old, orders the strands; where there is none the longer is the older.
pub fn strands(net: NetView<'_>, partner: &[i32], age: &[i32]) -> Strands {
    let (mut found, older) = followed(net, None, Runs::of(partner), age);
    let (generation, parent) = older.descend(&found.run);
    found.generation = parallel::map(net.edges.len(), |edge| generation[found.of_edge[edge] as usize]);
    Strands { parent, ..found }
}

/// The same of runs; `ends` where it is known who meets where. Parents and generations are left to be found.
pub(super) fn followed(net: NetView<'_>, ends: Option<&Ends>, runs: Runs, age: &[i32]) -> (Strands, Older) {
    let Runs { of_edge, turned, entries, starts, lowest } = runs;
    let mut found = Strands { run_of: of_edge, turned, entries, starts, ..Strands::default() };
    let mut runs = measured(net, &mut found, &lowest, age);
    found.long = parallel::map(runs.len(), |run| f64::from_bits(!runs[run].shortness));
    found.length = vec![0.0; runs.len()];
    // Oldest first, then longest; equal lengths by their first edge.
    parallel::sort(&mut runs);
    found.run = runs.iter().map(|run| run.number).collect();
    found.strand = vec![0; runs.len()];
    for (strand, run) in runs.iter().enumerate() {
        found.strand[run.number as usize] = strand as u32;
        found.length[strand] = f64::from_bits(!run.shortness);
    }
    found.of_edge = parallel::map(net.edges.len(), |edge| found.strand[found.run_of[edge] as usize] as i32);
    let older = met(net, ends, &mut found);
    (found, older)
}

/// Unit vector from an end along its edge.
fn direction(net: NetView<'_>, end: u32) -> Point {
    let [x, y] = net.along(end);
    let length = length([x, y]);
    if length > 0.0 { [x / length, y / length] } else { [0.0; 2] }
}

/// The end that each end of an edge continues into, or -1. Ends are numbered 2 edge + side.
///
/// Two edges at a vertex of degree 2 always pair, at degree 3 the two that are best aligned; above, further pairs
/// join while they are fairly straight. At vertices of degree 3 and above no pair turns by more than `sharpest` radians.
pub fn pairs(net: NetView<'_>, sharpest: f64) -> Vec<i32> {
    paired(net, &Ends::of(net), sharpest)
}

/// The same where it is known who meets where.
pub(super) fn paired(net: NetView<'_>, ends: &Ends, sharpest: f64) -> Vec<i32> {
    let limit = -libm::cos(sharpest.clamp(0.0, std::f64::consts::PI));
    // Every end is of one vertex: whoever comes to it writes, in any order.
    let partner = parallel::map(2 * net.edges.len(), |_| AtomicI32::new(NONE));
    parallel::ranges(net.vertices.len(), |range| {
        let mut found = Vec::new();
        for vertex in range {
            found.clear();
            pairs_at(net, ends.at(vertex), limit, &mut found);
            for &[a, b] in &found {
                partner[a as usize].store(b as i32, Relaxed);
                partner[b as usize].store(a as i32, Relaxed);
            }
        }
    });
    partner.into_iter().map(AtomicI32::into_inner).collect()
}

/// Adds the pairs of ends at one vertex; the best-aligned turns by a cosine of at most `limit`, but at degree 2.
fn pairs_at(net: NetView<'_>, here: &[u32], limit: f64, found: &mut Vec<[u32; 2]>) {
    match *here {
        [] | [_] => return,
        [a, b] => return found.push([a, b]),
        [a, b, c] => return found.extend(best_of(net, [a, b, c], limit)),
        _ => {}
    }
    let mut pairs = candidates(here.iter().map(|&end| (direction(net, end), end)).collect());
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
    // Candidates of a star have no end in common.
    let (before, is_star) = (found.len(), here.len() > STAR);
    for (rank, &(cosine, a, b)) in pairs.iter().enumerate() {
        let alone = is_star || found[before..].iter().flatten().all(|&end| end != a && end != b);
        let is_best = rank == 0 && (cosine <= limit || limit >= 1.0);
        if alone && (is_best || cosine < STRAIGHT.min(limit)) {
            found.push([a, b]);
        }
    }
}

/// The best-aligned of three ends, the first of equal ones, if they are aligned well enough.
fn best_of(net: NetView<'_>, ends: [u32; 3], limit: f64) -> Option<[u32; 2]> {
    let ways = ends.map(|end| direction(net, end));
    let cosine = |i: usize, j: usize| ways[i][0] * ways[j][0] + ways[i][1] * ways[j][1];
    let (mut best, mut least) = ([0, 1], cosine(0, 1));
    for [i, j] in [[0, 2], [1, 2]] {
        if cosine(i, j).total_cmp(&least).is_lt() {
            (best, least) = ([i, j], cosine(i, j));
        }
    }
    (least <= limit || limit >= 1.0).then(|| best.map(|i| ends[i]))
}

/// Pairs of ends at one vertex that may continue each other, with the cosine between them.
fn candidates(mut spokes: Vec<(Point, u32)>) -> Vec<(f64, u32, u32)> {
    let pair = |&(a, i): &(Point, u32), &(b, j): &(Point, u32)| (a[0] * b[0] + a[1] * b[1], i, j);
    if spokes.len() > STAR {
        spokes.sort_by(|(a, _), (b, _)| libm::atan2(a[1], a[0]).total_cmp(&libm::atan2(b[1], b[0])));
        let (near, far) = spokes.split_at(spokes.len() / 2);
        return near.iter().zip(far).map(|(a, b)| pair(a, b)).collect();
    }
    let later = |i: usize| spokes[i + 1..].iter();
    spokes.iter().enumerate().flat_map(|(i, a)| later(i).map(move |b| pair(a, b))).collect()
}

/// What a run is put in order by.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
struct Run {
    age: i32,
    /// The bits of its length, turned over: lengths are not negative, and then their bits have their order.
    shortness: u64,
    lowest: u32,
    number: u32,
}

/// No run has the edge yet.
const NOBODY: u32 = u32::MAX;

/// The runs of a drawing, whatever its edges are like; see [`Strands`].
pub(super) struct Runs {
    of_edge: Vec<u32>,
    turned: Vec<bool>,
    entries: Vec<u32>,
    starts: Vec<usize>,
    /// The lowest edge of each.
    lowest: Vec<u32>,
}

impl Runs {
    /// Those that have ends from there, then rings from their lowest edge.
    pub(super) fn of(partner: &[i32]) -> Self {
        let edges = partner.len() / 2;
        let (mut of_edge, mut turned) = (vec![NOBODY; edges], vec![false; edges]);
        let (mut entries, mut starts, mut all) = (Vec::with_capacity(edges), vec![0], Vec::new());
        let ends = 0..2 * edges as u32;
        let tips = ends.clone().filter(|&end| partner[end as usize] == NONE);
        for tip in tips.chain(ends) {
            if of_edge[tip as usize / 2] != NOBODY {
                continue;
            }
            let (mut lowest, mut entry) = (tip / 2, tip as i32);
            while entry != NONE && of_edge[entry as usize / 2] == NOBODY {
                let edge = entry as u32 / 2;
                of_edge[edge as usize] = all.len() as u32;
                turned[edge as usize] = entry % 2 == 1;
                entries.push(entry as u32);
                lowest = lowest.min(edge);
                entry = partner[(entry ^ 1) as usize];
            }
            all.push(lowest);
            starts.push(entries.len());
        }
        Self { of_edge, turned, entries, starts, lowest: all }
    }
}

/// Finds how far along its run each edge is entered, and what the runs are put in order by.
fn measured(net: NetView<'_>, found: &mut Strands, lowest: &[u32], age: &[i32]) -> Vec<Run> {
    // Every edge is of one run: whoever comes to it writes, in any order.
    let before = parallel::map(found.run_of.len(), |_| AtomicU64::new(0));
    let run = |number: usize| {
        let length = found.entries_of(number).iter().fold(0.0, |length: f64, &entry| {
            before[entry as usize / 2].store(length.to_bits(), Relaxed);
            length + net.length(entry as usize / 2)
        });
        let (lowest, number) = (lowest[number], number as u32);
        let age = age.get(lowest as usize).copied().unwrap_or(0);
        Run { age, shortness: !length.to_bits(), lowest, number }
    };
    let runs = parallel::map(lowest.len(), run);
    found.before = before.into_iter().map(|bits| f64::from_bits(bits.into_inner())).collect();
    runs
}
