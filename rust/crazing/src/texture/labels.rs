//! Maps of labels: of pixels on the crack the strand and its generation; of all of them the direction of the crack.

use super::cut::line;
use super::finish::{Row, stretch};
use super::grid::{PART, both};
use super::maps::Maps;
use super::near::{BEHIND_END, BEHIND_START, RIGHT, behind};
use super::nearest::{Page, Set};
use super::piece::Piece;
use super::scene::Scene;

/// Pixels looked at together.
const LANES: usize = 8;

/// Half a pixel around the middle line of an edge's side: what belongs to a crack.
pub(super) const REACH: f32 = 0.5;

/// Codes of a pixel that have the same label: to the left and to the right.
const ALIKE: u32 = RIGHT + 1;

/// The labels of a page's pieces, where they are wanted: of each for all codes in turn, [`ALIKE`] of them together.
#[derive(Debug, Default)]
pub(super) struct Labels {
    strands: Vec<i32>,
    generations: Vec<i32>,
    directions: Vec<[f32; 2]>,
}

impl Scene<'_> {
    /// Looks up the labels of a page.
    #[inline(always)]
    pub(super) fn turn(&self, set: &Set, page: &Page, labels: &mut Labels, maps: &Maps<'_>) {
        let Labels { strands, generations, directions } = labels;
        let pieces = || page.ids.iter().map(|&id| &set.pieces[id as usize]);
        let Some(ties) = &self.ties else { return };
        let edges = |piece: &Piece| {
            let [own, first, second] = ties.edges(piece.edge);
            [0, BEHIND_START, BEHIND_END].map(|code| match behind(code, piece) {
                None => own,
                Some(0) => first,
                Some(_) => second,
            })
        };
        let labels = [
            (strands, self.pattern.strand, maps.strand.is_some()),
            (generations, self.pattern.generation, maps.generation.is_some()),
        ];
        for (labels, given, wanted) in labels {
            labels.clear();
            if wanted {
                let label = |edge: u32| given[edge as usize];
                pieces().for_each(|piece| labels.extend(four(edges(piece), label)));
            }
        }
        directions.clear();
        if maps.direction.is_some() {
            pieces().for_each(|piece| directions.extend(four(edges(piece), |edge| self.direction(edge))));
        }
    }

    /// The direction of an edge, y up; to the right where it has none.
    fn direction(&self, edge: u32) -> [f32; 2] {
        let Ok(line) = line(&self.pattern, &self.grid, edge as usize) else { return [1.0, 0.0] };
        let [x, y] = both(|axis| (line.end[axis] - line.start[axis]) as f64 * f64::from(PART));
        let length = (x * x + y * y).sqrt();
        if length > 0.0 { [(x / length) as f32, (-y / length) as f32] } else { [1.0, 0.0] }
    }

    /// Writes the labels of a row.
    #[inline(always)]
    pub(super) fn labels(&self, row: &Row<'_>, labels: &Labels, maps: &mut Maps<'_>) {
        let Labels { strands, generations, directions } = labels;
        let labels = [(&mut maps.strand, strands), (&mut maps.generation, generations)];
        for (map, labels) in labels {
            let Some(out) = stretch(map, row, 1) else { continue };
            if labels.is_empty() {
                out.fill(-1);
                continue;
            }
            let ((outs, out), (chunks, distances)) = (out.as_chunks_mut::<LANES>(), row.distance.as_chunks::<LANES>());
            let (codes_of, codes) = row.code.as_chunks::<LANES>();
            for (nth, out) in outs.iter_mut().enumerate() {
                mark(&chunks[nth], &codes_of[nth], labels, out);
            }
            mark(distances, codes, labels, out);
        }
        if let Some(out) = stretch(&mut maps.direction, row, 2) {
            for (out, code) in out.as_chunks_mut().0.iter_mut().zip(row.code) {
                *out = directions.get((code / ALIKE) as usize).copied().unwrap_or_default();
            }
        }
    }
}

/// What belongs to the codes of a piece; the last are of no pixel.
#[inline(always)]
fn four<T: Copy>(edges: [u32; 3], of: impl Fn(u32) -> T) -> [T; 4] {
    let [own, first, second] = edges.map(of);
    [own, first, second, own]
}

/// The labels of some pixels: of those on the crack that of the nearest piece.
#[inline(always)]
fn mark(distances: &[f32], codes: &[u32], labels: &[i32], out: &mut [i32]) {
    let mut near = false;
    for (lane, out) in out.iter_mut().enumerate() {
        near |= distances[lane] < REACH;
        *out = -1;
    }
    if near {
        for (lane, out) in out.iter_mut().enumerate() {
            let label = labels[(codes[lane] / ALIKE) as usize];
            *out = if distances[lane] < REACH { label } else { -1 };
        }
    }
}
