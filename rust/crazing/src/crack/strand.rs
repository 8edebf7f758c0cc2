//! Strands: at every vertex the edges that continue each other best are one crack.

use super::net::{Ends, NONE, NetView};
use crate::graph::Point;
use crate::parallel;

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
    /// The ends of the edges along each strand in turn: an end to enter an edge by.
    pub entries: Vec<u32>,
    /// Length of the edge of each entry.
    pub spans: Vec<f64>,
    /// Where each strand starts in `entries`, and the end.
    pub starts: Vec<usize>,
    /// Length of each strand.
    pub length: Vec<f64>,
}

/// Follows the best-aligned pairs of edges through a drawing; `partner` is what [`pairs`] gives.
///
/// `age` of every edge, low is old, orders the strands; where there is none the longer is the older.
pub fn strands(net: NetView<'_>, partner: &[i32], age: &[i32]) -> Strands {
    let lengths = parallel::map(net.edges.len(), |edge| net.length(edge));
    let mut runs = follow(net, partner, &lengths);
    let age = |run: &Run| age.get(run.lowest as usize).copied().unwrap_or(0);
    // Oldest first, then longest; equal lengths by their first edge.
    runs.sort_by(|a, b| age(a).cmp(&age(b)).then(b.length.total_cmp(&a.length)).then(a.lowest.cmp(&b.lowest)));
    number(net, &Ends::of(net), &runs, &lengths)
}

/// Unit vector from an end along its edge.
fn direction(net: NetView<'_>, end: u32) -> Point {
    let [x, y] = net.along(end);
    let length = libm::hypot(x, y);
    if length > 0.0 { [x / length, y / length] } else { [0.0; 2] }
}

/// The end that each end of an edge continues into, or -1. Ends are numbered 2 edge + side.
///
/// Two edges at a vertex of degree 2 always pair, at degree 3 the two that are best aligned; above, further pairs
/// join while they are fairly straight. At vertices of degree 3 and above no pair turns by more than `sharpest` radians.
pub fn pairs(net: NetView<'_>, sharpest: f64) -> Vec<i32> {
    let ends = Ends::of(net);
    let limit = -libm::cos(sharpest.clamp(0.0, std::f64::consts::PI));
    let found = parallel::ranges(net.vertices.len(), |range| {
        let mut found = Vec::with_capacity(range.len());
        range.for_each(|vertex| pairs_at(net, ends.at(vertex), limit, &mut found));
        found
    });
    let mut partner = vec![NONE; 2 * net.edges.len()];
    for [a, b] in found.into_iter().flatten() {
        partner[a as usize] = b as i32;
        partner[b as usize] = a as i32;
    }
    partner
}

/// Adds the pairs of ends at one vertex; the best-aligned turns by a cosine of at most `limit`, but at degree 2.
fn pairs_at(net: NetView<'_>, here: &[u32], limit: f64, found: &mut Vec<[u32; 2]>) {
    match *here {
        [] | [_] => return,
        [a, b] => return found.push([a, b]),
        _ => {}
    }
    let mut pairs = candidates(here.iter().map(|&end| (direction(net, end), end)).collect());
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
    let before = found.len();
    for (rank, &(cosine, a, b)) in pairs.iter().enumerate() {
        let alone = found[before..].iter().flatten().all(|&end| end != a && end != b);
        let is_best = rank == 0 && (cosine <= limit || limit >= 1.0);
        if alone && (is_best || cosine < STRAIGHT.min(limit)) {
            found.push([a, b]);
        }
    }
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

/// The edges of one strand in turn.
struct Run {
    entries: Vec<u32>,
    length: f64,
    lowest: u32,
}

fn follow(net: NetView<'_>, partner: &[i32], lengths: &[f64]) -> Vec<Run> {
    let mut seen = vec![false; net.edges.len()];
    let ends = 0..2 * net.edges.len() as u32;
    // Open strands from their ends, then rings from their lowest edge.
    let tips = ends.clone().filter(|&end| partner[end as usize] == NONE);
    let mut runs = Vec::new();
    for tip in tips.chain(ends) {
        if !seen[tip as usize / 2] {
            runs.push(run(lengths, partner, tip, &mut seen));
        }
    }
    runs
}

fn run(lengths: &[f64], partner: &[i32], tip: u32, seen: &mut [bool]) -> Run {
    let mut run = Run { entries: Vec::new(), length: 0.0, lowest: tip / 2 };
    let mut entry = tip as i32;
    while entry != NONE && !std::mem::replace(&mut seen[entry as usize / 2], true) {
        let edge = entry as u32 / 2;
        run.entries.push(entry as u32);
        run.lowest = run.lowest.min(edge);
        run.length += lengths[edge as usize];
        entry = partner[(entry ^ 1) as usize];
    }
    run
}

fn number(net: NetView<'_>, ends: &Ends, runs: &[Run], lengths: &[f64]) -> Strands {
    let mut strands = Strands { of_edge: vec![-1; net.edges.len()], starts: vec![0], ..Strands::default() };
    for (strand, run) in runs.iter().enumerate() {
        for &entry in &run.entries {
            strands.of_edge[entry as usize / 2] = strand as i32;
        }
        strands.entries.extend(&run.entries);
        strands.spans.extend(run.entries.iter().map(|&entry| lengths[entry as usize / 2]));
        strands.starts.push(strands.entries.len());
        strands.length.push(run.length);
    }
    let mut generation: Vec<i32> = Vec::with_capacity(runs.len());
    for (strand, run) in runs.iter().enumerate() {
        // Both outer ends of the strand; older strands have their generation already.
        let tips = [run.entries.first().copied(), run.entries.last().map(|entry| entry ^ 1)];
        let met = tips.into_iter().flatten().flat_map(|tip| ends.at(net.vertex(tip)));
        let older = met.map(|&end| strands.of_edge[end as usize / 2] as usize).filter(|&other| other < strand);
        let parent = older.max_by_key(|&other| (generation[other], std::cmp::Reverse(other)));
        generation.push(parent.map_or(0, |other| generation[other] + 1));
        strands.parent.push(parent.map_or(NONE, |other| other as i32));
    }
    strands.generation = strands.of_edge.iter().map(|&strand| generation[strand as usize]).collect();
    strands
}
