//! What noise does to the lines of a crust, undone as far as sides and arc lengths need it.
//!
//! Ends of lines a few steps apart are joined, rings of a few samples that hug a long line are taken for a part of it,
//! and samples beside a line stand where the nearest sample on it stands. Lines of clean samples stay as they are.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};

use super::cost::distance;
use super::rings::{Line, Stand};
use crate::diagram::DiagramView;
use crate::error::Result;
use crate::graph::Point;
use crate::incidence::Incidence;
use crate::watch::Watch;

/// Widest gap, in mean steps of the line.
const REACH: f64 = 12.0;
/// Part of a line that closing it may add.
const SHARE: f64 = 0.1;
/// Lines of fewer sites than this may be a splinter of one with ten times as many.
const SPLINTER: usize = 13;
/// Sites looked at from an end: all within reach of it, but in a crowd.
const CROWD: usize = 500;

/// Lines with their gaps closed.
pub(super) struct Closed {
    pub(super) lines: Vec<Line>,
    pub(super) stands: Vec<Stand>,
    pub(super) bridges: Vec<Bridge>,
}

/// Edges over a gap, from a site on.
pub(super) struct Bridge {
    pub(super) from: u32,
    pub(super) edges: Vec<u32>,
}

/// The diagram as a net of ways.
struct Net<'a> {
    view: DiagramView<'a>,
    sites: &'a [Point],
    about: &'a Incidence,
}

/// Where the sites stand, if there is nothing to mend: every site is on one ring, and none of these is small, if that
/// may be a splinter.
pub(super) fn whole(count: usize, lines: &[Line], may_splinter: bool) -> Option<Vec<Stand>> {
    let least = if may_splinter { SPLINTER } else { 0 };
    let are_rings = lines.iter().all(|line| line.closed && line.sites.len() >= least);
    if !are_rings || lines.iter().map(|line| line.sites.len()).sum::<usize>() != count {
        return None;
    }
    Some(placed(count, lines)).filter(|stands| stands.iter().all(|stand| stand.line != -1))
}

pub(super) fn closed(
    view: DiagramView<'_>,
    sites: &[Point],
    about: &Incidence,
    mut lines: Vec<Line>,
    watch: Watch<'_>,
) -> Result<Closed> {
    let net = Net { view, sites, about };
    let mut stands = placed(sites.len(), &lines);
    lines = net.without_splinters(lines, &stands);
    let (lines, bridges) = net.joined(lines, watch)?;
    stands = placed(sites.len(), &lines);
    net.place_strays(&lines, &mut stands, watch)?;
    Ok(Closed { lines, stands, bridges })
}

/// Where the sites of the lines stand.
fn placed(count: usize, lines: &[Line]) -> Vec<Stand> {
    let mut stands = vec![Stand { line: -1, place: 0 }; count];
    for (number, line) in lines.iter().enumerate() {
        for (place, &site) in line.sites.iter().enumerate() {
            stands[site as usize] = Stand { line: number as i32, place: place as u32 };
        }
    }
    stands
}

impl Net<'_> {
    /// The edges at a site, each with its other end and its length.
    fn ways(&self, v: u32) -> impl Iterator<Item = (u32, u32, f64)> {
        self.about.at(v as usize).iter().map(move |&k| {
            let [a, b] = self.view.edges[k as usize].map(|end| end as u32);
            let u = if a == v { b } else { a };
            (k, u, distance(self.sites[v as usize], self.sites[u as usize]))
        })
    }

    /// Mean length of the steps of a line.
    fn step(&self, line: &Line) -> f64 {
        let steps =
            line.sites.windows(2).map(|pair| distance(self.sites[pair[0] as usize], self.sites[pair[1] as usize]));
        steps.sum::<f64>() / (line.sites.len() - 1) as f64
    }

    /// The lines but for short ones no farther than two of their steps from a long one.
    fn without_splinters(&self, lines: Vec<Line>, stands: &[Stand]) -> Vec<Line> {
        let sizes: Vec<usize> = lines.iter().map(|line| line.sites.len()).collect();
        let is_splinter = |line: &Line| {
            let size = line.sites.len();
            size < SPLINTER && {
                let reach = 2.0 * self.step(line);
                let of_long =
                    |u: u32| stands[u as usize].line != -1 && sizes[stands[u as usize].line as usize] >= 10 * size;
                line.sites.iter().any(|&v| self.ways(v).any(|(_, u, length)| length <= reach && of_long(u)))
            }
        };
        lines.into_iter().filter(|line| !is_splinter(line)).collect()
    }

    /// The lines with near ends joined, nearest first.
    fn joined(&self, lines: Vec<Line>, watch: Watch<'_>) -> Result<(Vec<Line>, Vec<Bridge>)> {
        let open: Vec<usize> = (0..lines.len()).filter(|&i| !lines[i].closed).collect();
        if open.is_empty() {
            return Ok((lines, Vec::new()));
        }
        let ends = |i: usize| [lines[i].sites[0], lines[i].sites[lines[i].sites.len() - 1]];
        let line_of = free(open.iter().flat_map(|&i| ends(i).map(|end| (end, i))));
        let steps: Vec<f64> = lines.iter().map(|line| self.step(line)).collect();
        let mut found: Vec<(u64, u32, u32, Vec<u32>)> = Vec::new();
        for (&end, &line) in &line_of {
            watch.poll()?;
            let whole = steps[line] * (lines[line].sites.len() - 1) as f64;
            for (far, other, way) in self.reached(end, REACH * steps[line], &line_of) {
                let most = REACH * steps[line_of[&other]];
                if end < other && far <= most && (line_of[&other] != line || far <= SHARE * whole) {
                    found.push((far.to_bits(), end, other, way));
                }
            }
        }
        found.sort_unstable();
        let mut chains = Chains { lines: lines.into_iter().map(Some).collect(), line_of };
        let bridges = found.into_iter().filter(|&(_, a, b, _)| chains.join(a, b));
        let bridges = bridges.map(|(_, from, _, edges)| Bridge { from, edges }).collect();
        Ok((chains.lines.into_iter().flatten().collect(), bridges))
    }

    /// The other ends within reach, how far each is, and the edges of the way to it.
    fn reached(&self, end: u32, reach: f64, ends: &BTreeMap<u32, usize>) -> Vec<(f64, u32, Vec<u32>)> {
        let mut by: BTreeMap<u32, (u32, u32)> = BTreeMap::new();
        let mut done: BTreeMap<u32, f64> = BTreeMap::new();
        let mut queue = BinaryHeap::from([Reverse((0_u64, end, u32::MAX, end))]);
        let mut found = Vec::new();
        while let Some(Reverse((bits, v, k, before))) = queue.pop() {
            if done.len() == CROWD || done.contains_key(&v) {
                continue;
            }
            let far = f64::from_bits(bits);
            done.insert(v, far);
            by.insert(v, (k, before));
            if v != end && ends.contains_key(&v) {
                found.push((far, v, way(&by, v)));
            }
            let ahead = self.ways(v).filter(|&(_, u, length)| far + length <= reach && !done.contains_key(&u));
            queue.extend(ahead.map(|(k, u, length)| Reverse(((far + length).to_bits(), u, k, v))));
        }
        found
    }

    /// Lets sites on no line stand where the nearest site on one stands, if that is within reach.
    fn place_strays(&self, lines: &[Line], stands: &mut [Stand], watch: Watch<'_>) -> Result<()> {
        let strays: Vec<u32> = (0..stands.len() as u32).filter(|&v| stands[v as usize].line == -1).collect();
        let mut queue: BinaryHeap<Reverse<(u64, u32, u32)>> = BinaryHeap::new();
        for &v in &strays {
            let on = self.ways(v).filter(|&(_, u, _)| stands[u as usize].line != -1);
            queue.extend(on.map(|(_, u, length)| Reverse((length.to_bits(), v, u))));
        }
        let steps: Vec<f64> = lines.iter().map(|line| self.step(line)).collect();
        let mut seen = 0;
        while let Some(Reverse((bits, v, u))) = queue.pop() {
            watch.poll_at(seen)?;
            seen += 1;
            let far = f64::from_bits(bits);
            if stands[v as usize].line != -1 || far > REACH * steps[stands[u as usize].line as usize] {
                continue;
            }
            stands[v as usize] = stands[u as usize];
            let ahead = self.ways(v).filter(|&(_, next, _)| stands[next as usize].line == -1);
            queue.extend(ahead.map(|(_, next, length)| Reverse(((far + length).to_bits(), next, v))));
        }
        Ok(())
    }
}

/// The line of every end that is the end of one line only.
fn free(ends: impl Iterator<Item = (u32, usize)>) -> BTreeMap<u32, usize> {
    let mut lines: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
    ends.for_each(|(end, line)| lines.entry(end).or_default().push(line));
    lines.into_iter().filter(|(_, of)| of.len() == 1).map(|(end, of)| (end, of[0])).collect()
}

/// The edges by which a site was reached.
fn way(by: &BTreeMap<u32, (u32, u32)>, mut v: u32) -> Vec<u32> {
    let mut edges = Vec::new();
    while let Some(&(k, before)) = by.get(&v).filter(|step| step.0 != u32::MAX) {
        edges.push(k);
        v = before;
    }
    edges
}

/// Lines that grow together at their ends.
struct Chains {
    lines: Vec<Option<Line>>,
    /// The line of every free end.
    line_of: BTreeMap<u32, usize>,
}

impl Chains {
    /// Joins two ends, if both are still free; a chain of fewer than three sites is not closed.
    fn join(&mut self, a: u32, b: u32) -> bool {
        let (Some(&i), Some(&j)) = (self.line_of.get(&a), self.line_of.get(&b)) else { return false };
        if i == j {
            let Some(line) = self.lines[i].as_mut().filter(|line| line.sites.len() > 2) else { return false };
            line.closed = true;
        } else {
            let (Some(mut first), Some(mut second)) = (self.lines[i].take(), self.lines[j].take()) else {
                return false;
            };
            if first.sites.last() != Some(&a) {
                first.sites.reverse();
            }
            if second.sites.first() != Some(&b) {
                second.sites.reverse();
            }
            first.sites.append(&mut second.sites);
            if let Some(&last) = first.sites.last() {
                self.line_of.insert(last, i);
            }
            self.lines[i] = Some(first);
        }
        self.line_of.remove(&a);
        self.line_of.remove(&b);
        true
    }
}
