//! How far what has settled beside cracks reaches: less beside narrow ones, and falling slowly where they leave wide ones.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::Pattern;
use super::grid::{Grid, UNIT, both};
use super::material::Material;
use crate::error::Result;
use crate::incidence::Incidence;

/// How fast the reach falls along a crack, pixels a pixel. Where two cracks meet, pixels next to either are beside each
/// other: of reaches that differed there at once a step would be seen.
const FALL: f64 = 0.12;

/// The reach along every edge.
#[derive(Debug)]
pub(super) struct Dust {
    /// At the first end, and by how much it grows a pixel.
    reaches: Vec<[f32; 2]>,
    /// Nothing reaches farther.
    pub(super) most: f32,
}

impl Dust {
    /// The reaches beside a pattern, where they differ.
    pub(super) fn of(pattern: &Pattern<'_>, grid: &Grid, material: &Material) -> Result<Option<Self>> {
        let [taper, full] = [material.dirt_taper, material.dirt_width].map(f64::from);
        let widest = f64::from(material.widest);
        if !(taper > 0.0 && full > 0.0 && widest > 0.0 && material.dirt_amount > 0.0) {
            return Ok(None);
        }
        let full = full * grid.scale;
        let mut reach = vec![0.0_f64; pattern.vertices.len()];
        for (edge, widths) in pattern.edges.iter().zip(pattern.widths) {
            for (&vertex, width) in edge.iter().zip(widths) {
                let own = full * (1.0 - taper + taper * (width / widest).min(1.0));
                reach[vertex as usize] = reach[vertex as usize].max(own);
            }
        }
        let lengths = lengths(pattern, grid)?;
        spread(pattern, &lengths, &mut reach);
        let along = |(edge, length): (&[i32; 2], f64)| {
            let [first, second] = edge.map(|vertex| reach[vertex as usize]);
            [first as f32, if length > 0.0 { ((second - first) / length) as f32 } else { 0.0 }]
        };
        let reaches = pattern.edges.iter().zip(lengths.iter().copied()).map(along).collect();
        let most = reach.iter().fold(0.0, |most: f64, &reach| most.max(reach)) as f32;
        Ok(Some(Self { reaches, most }))
    }

    /// The reach so many pixels along an edge.
    pub(super) fn reach(&self, edge: u32, along: f32) -> f32 {
        let [first, grows] = self.reaches[edge as usize];
        first + grows * along
    }
}

/// The length of every edge, pixels.
fn lengths(pattern: &Pattern<'_>, grid: &Grid) -> Result<Vec<f64>> {
    let length = |(row, edge): (usize, &[i32; 2])| {
        let [a, b] = edge.map(|vertex| grid.place(pattern.vertices[vertex as usize], vertex as usize));
        let (a, b) = (a?, b?);
        let shift = pattern.shifts.get(row).map_or([0; 2], |shift| grid.shift(both(|axis| i64::from(shift[axis]))));
        let [x, y] = both(|axis| (b[axis] - a[axis] + shift[axis]) as f64 / UNIT as f64);
        Ok((x * x + y * y).sqrt())
    };
    pattern.edges.iter().enumerate().map(length).collect()
}

/// Raises reaches so that none falls faster along the edges than [`FALL`]: the farthest first, each once and for all.
fn spread(pattern: &Pattern<'_>, lengths: &[f64], reach: &mut [f64]) {
    let about = Incidence::of(reach.len(), pattern.edges);
    // Positive floats lie in the order of their bits.
    let mut heap: BinaryHeap<(u64, Reverse<usize>)> =
        (0..reach.len()).map(|vertex| (reach[vertex].to_bits(), Reverse(vertex))).collect();
    while let Some((bits, Reverse(vertex))) = heap.pop() {
        if bits != reach[vertex].to_bits() {
            continue;
        }
        for &row in about.at(vertex) {
            let [a, b] = pattern.edges[row as usize].map(|end| end as usize);
            let (other, left) = (a + b - vertex, reach[vertex] - FALL * lengths[row as usize]);
            if left > reach[other] {
                reach[other] = left;
                heap.push((left.to_bits(), Reverse(other)));
            }
        }
    }
}
