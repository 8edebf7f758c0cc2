//! From the nearest piece of every pixel to the maps, row by row of a page.

use std::ops::Range;

use pulp::Simd;

use super::grid::UNIT;
use super::labels::Labels;
use super::look::{Place, rate};
use super::maps::{Line, Maps};
use super::near::CODES;
use super::nearest::{PAGE, Page, Set};
use super::noise::{Held, Stretch, Values};
use super::piece::Piece;
use super::plates::Plate;
use super::scene::Scene;

/// A page as a part of its run.
#[derive(Debug)]
pub(super) struct Leaf {
    pub(super) page: Page,
    pub(super) labels: Labels,
    /// What is kept of the noises, octave by octave.
    pub(super) held: Vec<Held>,
    /// The first pixel, from the top left corner of the picture.
    pub(super) corner: [i64; 2],
    /// The first column within the run.
    pub(super) at: usize,
    pub(super) width: usize,
    /// Whether all its pixels are beyond reach of any crack.
    pub(super) is_level: bool,
}

/// Pages beside each other, whose rows are written together.
pub(super) struct Run<'a> {
    pub(super) leaves: &'a mut [Leaf],
    /// The first column within the window.
    pub(super) left: usize,
    pub(super) width: usize,
    pub(super) height: usize,
    /// The coverage of the band, where it is known.
    pub(super) mask: Option<&'a [u8]>,
    /// Which plates its pixels are on, where that is known.
    pub(super) plates: Option<&'a [u32]>,
}

/// One row of a page.
pub(super) struct Row<'a> {
    pub(super) set: &'a Set,
    pub(super) page: &'a Page,
    /// Which row it is.
    pub(super) y: usize,
    /// Its first pixel, from the top left corner of the picture.
    pub(super) corner: [i64; 2],
    /// Where it starts in the rows of its run.
    pub(super) start: usize,
    /// How much of its pixels is covered, where that is known.
    mask: Option<&'a [u8]>,
    /// Of which line they are on which side, where that is known.
    pub(super) plates: Option<&'a [u32]>,
    pub(super) distance: &'a [f32],
    pub(super) code: &'a [u32],
}

/// Coverage and plates of a row, where they are known.
type Known<'a> = (Option<&'a [u8]>, Option<&'a [u32]>);

/// What one thread keeps from row to row.
#[derive(Debug)]
pub(super) struct Rows {
    pub(super) grain: Values,
    pub(super) mottle: Values,
    pub(super) chip: Values,
    pub(super) line: Line,
}

impl Rows {
    pub(super) fn new() -> Self {
        let row = || Values::new(PAGE);
        Self { grain: row(), mottle: row(), chip: row(), line: Line::default() }
    }
}

impl Row<'_> {
    pub(super) fn width(&self) -> usize {
        self.distance.len()
    }

    /// The nearest piece of a pixel, if there is any.
    pub(super) fn piece(&self, x: usize) -> Option<&Piece> {
        let id = *self.page.ids.get((self.code[x] / CODES) as usize)?;
        self.set.pieces.get(id as usize)
    }

    /// Where a pixel lies from the start of a piece, in pixels.
    #[inline(always)]
    pub(super) fn offset(&self, x: usize, piece: &Piece) -> [f32; 2] {
        let middle = |pixel: i64| pixel * UNIT + UNIT / 2;
        piece.offset(middle(self.corner[0] + x as i64), middle(self.corner[1]))
    }
}

/// The stretch of a map that belongs to a row, if the map is wanted.
pub(super) fn stretch<'b, T>(map: &'b mut Option<&mut [T]>, row: &Row<'_>, channels: usize) -> Option<&'b mut [T]> {
    map.as_mut().map(|map| &mut map[row.start * channels..(row.start + row.width()) * channels])
}

impl Scene<'_> {
    /// Writes the rows of a run into a band of the window.
    #[inline(always)]
    pub(super) fn finish<S: Simd>(&self, simd: S, run: Run<'_>, rows: &mut Rows, maps: &mut Maps<'_>) {
        let Run { leaves, left, width, height, mask, plates } = run;
        for Leaf { page, labels, .. } in leaves.iter_mut().filter(|leaf| !leaf.is_level) {
            self.turn(self.set(page.level), page, labels, maps);
        }
        let all_level = leaves.iter().all(|leaf| leaf.is_level);
        let mut line = std::mem::take(&mut rows.line);
        for y in 0..height {
            let start = y * self.window.width + left;
            let known =
                (mask.map(|mask| &mask[start..start + width]), plates.map(|plates| &plates[start..start + width]));
            // What is level all over is written once, and copied to every row.
            if y == 0 || !all_level {
                let mut out = line.maps();
                // Not `for_each`, which is compiled apart, for any processor.
                for leaf in leaves.iter_mut() {
                    self.row(simd, leaf, y, known, rows, &mut out);
                }
            }
            maps.put(start, width, &line);
        }
        rows.line = line;
    }

    /// Writes a row of a page.
    #[inline(always)]
    fn row<S: Simd>(
        &self,
        simd: S,
        leaf: &mut Leaf,
        y: usize,
        (mask, plates): Known<'_>,
        rows: &mut Rows,
        maps: &mut Maps<'_>,
    ) {
        let Leaf { page, labels, held, corner, at, width, is_level } = leaf;
        let (start, width) = (*at, *width);
        if *is_level {
            return self.level(start..start + width, maps);
        }
        let own = y * PAGE..y * PAGE + width;
        let (distance, code) = (&page.distance[own.clone()], &page.code[own]);
        let corner = [corner[0], corner[1] + y as i64];
        let mask = mask.map(|mask| &mask[start..start + width]);
        let plates = plates.map(|plates| &plates[start..start + width]);
        let row = Row { set: self.set(page.level), page, y, corner, start, mask, plates, distance, code };
        if let Some(out) = stretch(&mut maps.distance, &row, 1) {
            out.iter_mut().zip(row.distance).for_each(|(out, distance)| *out = distance * self.data);
        }
        self.labels(&row, labels, maps);
        if self.wants.profile || self.wants.look {
            self.noises(corner, width, held, rows);
        }
        if self.wants.profile {
            self.relief(simd, &row, rows, maps);
        }
        if self.wants.look {
            self.tones(&row, rows, maps);
        }
    }

    /// Writes a part of a row, beyond reach of any crack, of a picture whose plates are all alike.
    fn level(&self, row: Range<usize>, maps: &mut Maps<'_>) {
        let at = |channels: usize| channels * row.start..channels * row.end;
        maps.height.iter_mut().for_each(|map| map[at(1)].fill(self.profile.top));
        maps.normal.iter_mut().for_each(|map| map[at(3)].as_chunks_mut().0.fill([0.0, 0.0, 1.0]));
        maps.ao.iter_mut().for_each(|map| map[at(1)].fill(1.0));
        maps.strand.iter_mut().for_each(|map| map[at(1)].fill(-1));
        maps.generation.iter_mut().for_each(|map| map[at(1)].fill(-1));
    }

    #[inline(always)]
    fn noises(&self, corner: [i64; 2], width: usize, held: &mut Vec<Held>, rows: &mut Rows) {
        let sloped = self.wants.profile;
        let kinds = [
            (&self.grain, &mut rows.grain, sloped),
            (&self.mottle, &mut rows.mottle, false),
            (&self.chip, &mut rows.chip, sloped),
        ];
        held.resize_with(kinds.iter().map(|kind| kind.0.len()).sum(), Held::default);
        let mut held = held.iter_mut();
        for (octaves, row, sloped) in kinds {
            row.clear();
            for (octave, held) in octaves.iter().zip(&mut held) {
                octave.add(Stretch { corner, width, sloped }, held, row);
            }
        }
    }

    /// The number of a pixel's plate: a lone one has the number 0.
    pub(super) fn number(&self, row: &Row<'_>, x: usize) -> i32 {
        let scan = self.scan.as_ref().zip(row.plates);
        scan.map_or(0, |(scan, plates)| scan.plate(&self.sides, plates[x]))
    }

    /// The plate of a pixel; none where there is no crack at all.
    pub(super) fn plate(&self, row: &Row<'_>, x: usize) -> Option<&Plate> {
        if self.sides.plates.is_empty() {
            row.piece(x)?;
        }
        self.plates.get(self.number(row, x) as usize)
    }

    /// Signed distance to the crack where chips have widened it.
    #[inline(always)]
    pub(super) fn chipped(&self, distance: f32, chip: f32) -> f32 {
        let deep = unit(chip);
        distance - self.chip_depth * deep * deep
    }

    /// How far the crack is frayed, in radii: farthest where the grain is high.
    #[inline(always)]
    pub(super) fn frayed(&self, grain: f32) -> f32 {
        self.fray * unit(0.5 + grain)
    }

    /// The radius of the crack nearest to a pixel.
    fn radius(&self, row: &Row<'_>, x: usize) -> f32 {
        row.piece(x).map_or(0.0, |piece| {
            let [dx, dy] = row.offset(x, piece);
            piece.foot(dx, dy).radius
        })
    }

    /// 1 over how far what has settled beside the crack reaches at a pixel.
    fn dirt_rate(&self, row: &Row<'_>, x: usize, distance: f32) -> f32 {
        match (&self.dust, row.piece(x)) {
            (Some(dust), Some(piece)) if distance < dust.most => {
                let [dx, dy] = row.offset(x, piece);
                rate(dust.reach(piece.edge, piece.before + piece.foot(dx, dy).s))
            }
            (Some(dust), _) => rate(dust.most),
            (None, _) => self.look.dirt_rate,
        }
    }

    /// Colour, roughness and wear of a row.
    fn tones(&self, row: &Row<'_>, rows: &Rows, maps: &mut Maps<'_>) {
        let tinted = self.look.tint != 0.0;
        for (x, &distance) in row.distance.iter().enumerate() {
            let mut distance = self.chipped(distance, rows.chip.value[x]);
            // Farther off nothing is frayed, nor asked how wide the crack is.
            if distance < 2.0 * self.fray * row.set.widest {
                let frayed = self.frayed(rows.grain.value[x]) * self.radius(row, x) - 0.5 * distance.max(0.0);
                distance -= frayed.max(0.0);
            }
            let covered = row.mask.map_or(0.0, |mask| f32::from(mask[x]) / 255.0);
            let chipped = unit(0.5 - distance);
            let crack = if self.chip_depth.max(self.fray) > 0.0 && chipped > covered { chipped } else { covered };
            let tint = if tinted { self.plate(row, x).map_or(0.0, |plate| plate.tint) } else { 0.0 };
            let (mottle, grain) = (rows.mottle.value[x], rows.grain.value[x]);
            let place = Place { distance, crack, tint, dirt_rate: self.dirt_rate(row, x, distance), mottle, grain };
            if let Some(out) = stretch(&mut maps.color, row, 3) {
                out[3 * x..3 * x + 3].copy_from_slice(&self.look.color(&place));
            }
            if let Some(out) = stretch(&mut maps.roughness, row, 1) {
                out[x] = self.look.roughness(&place);
            }
            if let Some(out) = stretch(&mut maps.wear, row, 1) {
                out[x] = self.look.wear(&place);
            }
        }
    }
}

#[inline(always)]
pub(super) fn unit(value: f32) -> f32 {
    let value = if value < 0.0 { 0.0 } else { value };
    if value > 1.0 { 1.0 } else { value }
}
