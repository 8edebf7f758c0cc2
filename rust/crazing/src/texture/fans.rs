//! The edges around every vertex in turn: which plate lies where beyond the end of an edge.

use super::Pattern;
use super::cut::line;
use super::grid::{Grid, PART, both};
use super::plates::Sides;
use crate::error::Result;

/// Half-edges that leave each vertex, counter-clockwise; see `faces` for their numbers.
#[derive(Debug)]
pub(super) struct Fans {
    starts: Vec<u32>,
    halves: Vec<u32>,
    /// From the first to the second end of every edge, pixels, y up.
    steps: Vec<[f64; 2]>,
    /// The first half-edge beside every plate.
    pub(super) owners: Vec<u32>,
}

impl Fans {
    /// Sorts the edges around their vertices.
    pub(super) fn new(pattern: &Pattern<'_>, grid: &Grid, sides: &Sides<'_>) -> Result<Self> {
        let mut steps = Vec::with_capacity(pattern.edges.len());
        for row in 0..pattern.edges.len() {
            steps.push(step(pattern, grid, row)?);
        }
        let mut starts = vec![0; pattern.vertices.len() + 1];
        pattern.edges.as_flattened().iter().for_each(|&vertex| starts[vertex as usize + 1] += 1);
        (0..pattern.vertices.len()).for_each(|vertex| starts[vertex + 1] += starts[vertex]);
        let (mut next, mut halves) = (starts.clone(), vec![0; 2 * pattern.edges.len()]);
        for (half, &vertex) in (0..).zip(pattern.edges.as_flattened()) {
            halves[next[vertex as usize] as usize] = half;
            next[vertex as usize] += 1;
        }
        let mut owners = vec![0; sides.reaches.len()];
        for (half, &plate) in sides.plates.as_flattened().iter().enumerate().rev() {
            owners[plate as usize] = half as u32;
        }
        let mut fans = Self { starts, halves: Vec::new(), steps, owners };
        let turns: Vec<f64> = (0..halves.len() as u32).map(|half| super::faces::turn(fans.leaves(half))).collect();
        for around in fans.starts.windows(2) {
            let turn = |half: &u32| turns[*half as usize];
            halves[around[0] as usize..around[1] as usize].sort_by(|a, b| turn(a).total_cmp(&turn(b)));
        }
        fans.halves = halves;
        Ok(fans)
    }

    /// The half-edges that leave a vertex.
    pub(super) fn around(&self, vertex: i32) -> &[u32] {
        &self.halves[self.starts[vertex as usize] as usize..self.starts[vertex as usize + 1] as usize]
    }

    /// The vector of a half-edge.
    pub(super) fn leaves(&self, half: u32) -> [f64; 2] {
        let step = self.steps[half as usize / 2];
        if half.is_multiple_of(2) { step } else { [-step[0], -step[1]] }
    }

    /// The half-edge to whose left a place lies, as seen from a vertex where several edges meet; and from the first end
    /// of its edge to the place.
    pub(super) fn beyond(&self, vertex: i32, place: [f64; 2]) -> Option<(u32, [f64; 2])> {
        let around = self.around(vertex);
        if around.len() < 2 {
            return None;
        }
        let cross = |a: [f64; 2], b: [f64; 2]| a[0] * b[1] - a[1] * b[0];
        let holds = |&(&a, &b): &(&u32, &u32)| {
            let (a, b) = (self.leaves(a), self.leaves(b));
            let (after, before) = (cross(a, place) >= 0.0, cross(place, b) > 0.0);
            if cross(a, b) > 0.0 { after && before } else { after || before }
        };
        let (&half, _) = around.iter().zip(around.iter().cycle().skip(1)).find(holds)?;
        let step = self.steps[half as usize / 2];
        let first = if half.is_multiple_of(2) { place } else { [place[0] + step[0], place[1] + step[1]] };
        Some((half, first))
    }
}

/// The vector of an edge, from places on the grid: moving the pattern by whole pixels does not change it.
fn step(pattern: &Pattern<'_>, grid: &Grid, row: usize) -> Result<[f64; 2]> {
    let line = line(pattern, grid, row)?;
    let parts = both(|axis| (line.end[axis] - line.start[axis]) as f64 * f64::from(PART));
    Ok([parts[0], -parts[1]])
}
