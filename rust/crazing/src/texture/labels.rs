//! Maps of labels: the plate of every pixel, and of those on the crack the strand and its generation.

use super::fans::Fans;
use super::finish::{Row, behind, stretch};
use super::grid::{PART, UNIT};
use super::maps::Maps;
use super::near::{BEHIND_START, CODES, RIGHT};
use super::nearest::{Page, Set};
use super::piece::Piece;
use super::scene::Scene;

/// The plate of a code that was not yet looked at.
const UNKNOWN: i32 = -1;

/// That of a code whose pixels lie on several plates.
const SEVERAL: i32 = -2;

/// Pixels looked at together.
const LANES: usize = 8;

/// Half a pixel around the middle line of an edge's side: what belongs to a crack.
pub(super) const REACH: f32 = 0.5;

/// How near to a pixel's middle an end of an edge may be, in pixels, and how long a piece, for `f32` to tell on which
/// side of other edges all pixels behind the end are.
const BLUR: f32 = 1.0 / 64.0;
const LONG: f32 = 4096.0;

/// The labels of a page's pieces.
#[derive(Debug, Default)]
pub(super) struct Labels {
    /// The plate of every code of the page, where it is known.
    cells: Vec<i32>,
    /// The strand and the generation of every piece of the page, where they are wanted.
    strands: Vec<i32>,
    generations: Vec<i32>,
}

impl Scene<'_> {
    /// Looks up the labels of a page, and forgets the plates of the last one.
    #[inline(always)]
    pub(super) fn turn(&self, set: &Set, page: &Page, labels: &mut Labels, maps: &Maps<'_>) {
        let Labels { cells, strands, generations } = labels;
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
        cells.clear();
        // A lone plate has the number 0.
        if self.wants.cell && self.sides.reaches.len() > 1 {
            cells.resize(page.ids.len() * CODES as usize, UNKNOWN);
        }
    }

    /// Writes the labels of a row.
    #[inline(always)]
    pub(super) fn labels(&self, row: &Row<'_>, labels: &mut Labels, maps: &mut Maps<'_>) {
        if let Some(out) = stretch(&mut maps.cell, row, 1) {
            self.plates_of(row, &mut labels.cells, out);
        }
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

    #[inline(always)]
    fn plates_of(&self, row: &Row<'_>, cells: &mut [i32], out: &mut [i32]) {
        if cells.is_empty() {
            return out.fill(0);
        }
        let ((outs, out), (chunks, codes)) = (out.as_chunks_mut::<LANES>(), row.code.as_chunks::<LANES>());
        let first = LANES * chunks.len();
        for (nth, out) in outs.iter_mut().enumerate() {
            let codes = &chunks[nth];
            let cell = cells[codes[0] as usize];
            if is_one(codes) && cell >= 0 {
                *out = [cell; LANES];
            } else {
                self.several_plates(row, nth * LANES, codes, cells, out);
            }
        }
        self.several_plates(row, first, codes, cells, out);
    }

    /// The plates of some pixels from the one numbered `first` on.
    #[inline(always)]
    fn several_plates(&self, row: &Row<'_>, first: usize, codes: &[u32], cells: &mut [i32], out: &mut [i32]) {
        let mut least = 0;
        for (lane, out) in out.iter_mut().enumerate() {
            *out = cells[codes[lane] as usize];
            least = if *out < least { *out } else { least };
        }
        if least < 0 {
            for (lane, out) in out.iter_mut().enumerate() {
                if *out < 0 {
                    *out = self.cell(row, first + lane, cells);
                }
            }
        }
    }

    /// The plate of one pixel; learns that of its code.
    fn cell(&self, row: &Row<'_>, x: usize, cells: &mut [i32]) -> i32 {
        let (code, Some(piece)) = (row.code[x], row.piece(x)) else { return 0 };
        let known = &mut cells[code as usize];
        if *known == UNKNOWN {
            *known = self.plate_of_code(code, piece).unwrap_or(SEVERAL);
        }
        if *known == SEVERAL { self.plate_of(row, x, piece).0 } else { *known }
    }

    /// The plate of all pixels of a code, if it is one.
    fn plate_of_code(&self, code: u32, piece: &Piece) -> Option<i32> {
        let (edge, right) = (piece.edge as usize, (code & RIGHT) as usize);
        let beside = Some(self.sides.plate(edge, right));
        let (Some(fans), Some(end)) = (&self.fans, behind(code, piece)) else { return beside };
        let along = if code & BEHIND_START != 0 { 0.0 } else { piece.length };
        let from_middle = [0, 1].map(|axis| {
            let part = (piece.start[axis].rem_euclid(UNIT) - UNIT / 2) as f32 * PART + along * piece.along[axis];
            (part - part.round()).abs()
        });
        if piece.length > LONG || from_middle.iter().all(|&part| part < BLUR) {
            return None;
        }
        let half = 2 * piece.edge + end as u32;
        // Left of the half-edge that leaves the first end is left of the edge; of that which leaves the second, right.
        let beyond = fans.one_sector(self.pattern.edges[edge][end], half, right == end, piece.lean.abs());
        let plate = |half: u32| self.sides.plate(half as usize / 2, half as usize % 2);
        beyond.and_then(|half| half.map_or(beside, |half| Some(plate(half))))
    }
}

impl Fans {
    /// Among the places that lie straight or obliquely beyond an edge's end, on one side of it: the half-edge to whose
    /// left all of them are, as [`Fans::beyond`] finds it for each; None if they may be apart. No half-edge at all where
    /// no other edge meets the end.
    ///
    /// `own` is the half-edge that leaves the end, and the places are to its left or not; the cone of places is opened
    /// beyond a right angle by what the edge's taper leans.
    fn one_sector(&self, vertex: i32, own: u32, left: bool, lean: f32) -> Option<Option<u32>> {
        const NEAR: f64 = 0.01;
        let around = self.around(vertex);
        if around.len() < 2 {
            return Some(None);
        }
        let unit = |[x, y]: [f64; 2]| {
            let length = (x * x + y * y).sqrt();
            (length > 0.0).then(|| [x / length, y / length])
        };
        let [x, y] = unit(self.leaves(own))?;
        // Ahead of the end, and across to the side in question.
        let (ahead, across) = ([-x, -y], if left { [-y, x] } else { [y, -x] });
        let dot = |a: [f64; 2], b: [f64; 2]| a[0] * b[0] + a[1] * b[1];
        for &half in around.iter().filter(|&&half| half != own) {
            let other = unit(self.leaves(half))?;
            let (ahead, across) = (dot(other, ahead), dot(other, across));
            if across > -NEAR && ahead > -NEAR - f64::from(lean) * across.max(0.0) {
                return None;
            }
        }
        let amid = [0, 1].map(|axis| ahead[axis] + across[axis]);
        self.beyond(vertex, amid).map(|(half, _)| Some(half))
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

/// Whether pixels are alike.
#[inline(always)]
fn is_one(codes: &[u32; LANES]) -> bool {
    let mut all = true;
    for code in codes {
        all &= *code == codes[0];
    }
    all
}
