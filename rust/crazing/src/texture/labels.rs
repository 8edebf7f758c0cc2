//! Maps of labels: of pixels on the crack the strand and its generation.

use super::finish::{Row, stretch};
use super::maps::Maps;
use super::near::CODES;
use super::nearest::{Page, Set};
use super::scene::Scene;

/// Pixels looked at together.
const LANES: usize = 8;

/// Half a pixel around the middle line of an edge's side: what belongs to a crack.
pub(super) const REACH: f32 = 0.5;

/// The labels of a page's pieces.
#[derive(Debug, Default)]
pub(super) struct Labels {
    /// The strand and the generation of every piece of the page, where they are wanted.
    strands: Vec<i32>,
    generations: Vec<i32>,
}

impl Scene<'_> {
    /// Looks up the labels of a page.
    #[inline(always)]
    pub(super) fn turn(&self, set: &Set, page: &Page, labels: &mut Labels, maps: &Maps<'_>) {
        let Labels { strands, generations } = labels;
        let labels = [
            (strands, self.pattern.strand, maps.strand.is_some()),
            (generations, self.pattern.generation, maps.generation.is_some()),
        ];
        for (labels, given, wanted) in labels {
            labels.clear();
            if wanted {
                labels.extend(page.ids.iter().map(|&id| given[set.pieces[id as usize].edge as usize]));
            }
        }
    }

    /// Writes the labels of a row.
    #[inline(always)]
    pub(super) fn labels(&self, row: &Row<'_>, labels: &Labels, maps: &mut Maps<'_>) {
        let labels = [(&mut maps.strand, &labels.strands), (&mut maps.generation, &labels.generations)];
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
            for (x, out) in out.as_chunks_mut().0.iter_mut().enumerate() {
                *out = row.piece(x).map_or([0.0; 2], |piece| [piece.along[0], -piece.along[1]]);
            }
        }
    }
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
            let label = labels[(codes[lane] / CODES) as usize];
            *out = if distances[lane] < REACH { label } else { -1 };
        }
    }
}
