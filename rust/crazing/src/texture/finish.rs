//! From the nearest piece of every pixel to the maps, row by row of a page.

use super::grid::UNIT;
use super::look::Place;
use super::maps::Maps;
use super::near::{BEHIND_END, BEHIND_START, CODES, RIGHT};
use super::nearest::{PAGE, Page, Set};
use super::noise::Value;
use super::piece::Piece;
use super::plates::Plate;
use super::scene::Scene;

/// The part of a page that lies in a window's band.
#[derive(Debug, Clone, Copy)]
pub(super) struct Part {
    /// The first pixel, from the top left corner of the picture.
    pub(super) corner: [i64; 2],
    /// The first pixel within the band.
    pub(super) at: [usize; 2],
    pub(super) width: usize,
    pub(super) height: usize,
}

/// One row of a page.
pub(super) struct Row<'a> {
    pub(super) set: &'a Set,
    pub(super) page: &'a Page,
    /// Which row it is.
    pub(super) y: usize,
    /// Its first pixel, from the top left corner of the picture.
    pub(super) corner: [i64; 2],
    /// Where it starts in the maps of the band.
    pub(super) start: usize,
    pub(super) distance: &'a [f32],
    pub(super) code: &'a [u32],
}

/// What one thread keeps from row to row.
#[derive(Debug)]
pub(super) struct Rows {
    pub(super) grain: Vec<Value>,
    pub(super) mottle: Vec<Value>,
    pub(super) chip: Vec<Value>,
    /// The plate of every code of the page, where it is known.
    pub(super) cells: Vec<i32>,
    /// The strand and the generation of every piece of the page, where they are wanted.
    pub(super) strands: Vec<i32>,
    pub(super) generations: Vec<i32>,
}

impl Rows {
    pub(super) fn new() -> Self {
        let row = || vec![Value::default(); PAGE];
        Self {
            grain: row(),
            mottle: row(),
            chip: row(),
            cells: Vec::new(),
            strands: Vec::new(),
            generations: Vec::new(),
        }
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

/// Behind which end of its edge a code lies, if behind any: 0 the first, 1 the second.
pub(super) fn behind(code: u32, piece: &Piece) -> Option<usize> {
    let end = usize::from(code & BEHIND_START == 0);
    (code & (BEHIND_START | BEHIND_END) != 0 && piece.ends[end]).then_some(end)
}

/// The stretch of a map that belongs to a row, if the map is wanted.
pub(super) fn stretch<'b, T>(map: &'b mut Option<&mut [T]>, row: &Row<'_>, channels: usize) -> Option<&'b mut [T]> {
    map.as_mut().map(|map| &mut map[row.start * channels..(row.start + row.width()) * channels])
}

impl Scene<'_> {
    /// Writes the part of a page into a band of the window.
    #[inline(always)]
    pub(super) fn finish(&self, set: &Set, page: &Page, part: Part, rows: &mut Rows, maps: &mut Maps<'_>) {
        self.turn(set, page, rows, maps);
        for y in 0..part.height {
            let at = y * PAGE..y * PAGE + part.width;
            let corner = [part.corner[0], part.corner[1] + y as i64];
            let start = (part.at[1] + y) * self.window.width + part.at[0];
            let (distance, code) = (&page.distance[at.clone()], &page.code[at]);
            let row = Row { set, page, y, corner, start, distance, code };
            if let Some(out) = stretch(&mut maps.distance, &row, 1) {
                out.iter_mut().zip(row.distance).for_each(|(out, distance)| *out = distance * self.data);
            }
            self.labels(&row, rows, maps);
            if self.wants.profile || self.wants.look {
                self.noises(corner, part.width, rows);
            }
            if self.wants.profile {
                self.relief(&row, rows, maps);
            }
            if self.wants.look {
                self.tones(&row, rows, maps);
            }
        }
    }

    /// Writes a part without any crack of a picture whose plates are all alike.
    pub(super) fn level(&self, part: Part, maps: &mut Maps<'_>) {
        for y in 0..part.height {
            let start = (part.at[1] + y) * self.window.width + part.at[0];
            let row = start..start + part.width;
            let at = |channels: usize| channels * row.start..channels * row.end;
            maps.height.iter_mut().for_each(|map| map[at(1)].fill(self.profile.top));
            maps.normal.iter_mut().for_each(|map| map[at(3)].as_chunks_mut().0.fill([0.0, 0.0, 1.0]));
            maps.ao.iter_mut().for_each(|map| map[at(1)].fill(1.0));
            maps.strand.iter_mut().for_each(|map| map[at(1)].fill(-1));
            maps.generation.iter_mut().for_each(|map| map[at(1)].fill(-1));
        }
    }

    fn noises(&self, corner: [i64; 2], width: usize, rows: &mut Rows) {
        let kinds = [(&self.grain, &mut rows.grain), (&self.mottle, &mut rows.mottle), (&self.chip, &mut rows.chip)];
        for (octaves, row) in kinds {
            for (nth, octave) in octaves.iter().enumerate() {
                octave.add(corner[1], corner[0], &mut row[..width], nth == 0);
            }
        }
    }

    pub(super) fn plate(&self, row: &Row<'_>, x: usize) -> Option<(&Plate, [f32; 2])> {
        let (plate, place) = self.plate_of(row, x, row.piece(x)?);
        Some((self.plates.get(plate as usize)?, place))
    }

    /// The plate of a pixel, and from its middle to the pixel, data units, y up.
    pub(super) fn plate_of(&self, row: &Row<'_>, x: usize, piece: &Piece) -> (i32, [f32; 2]) {
        let [dx, dy] = row.offset(x, piece);
        let (edge, end) = (piece.edge as usize, behind(row.code[x], piece));
        if let (Some(fans), Some(end)) = (&self.fans, end) {
            let along = if end == 0 { 0.0 } else { piece.length };
            let place = [f64::from(dx - along * piece.along[0]), f64::from(along * piece.along[1] - dy)];
            if let Some((half, from_first)) = fans.beyond(self.pattern.edges[edge][end], place) {
                let from_first = [from_first[0] as f32, from_first[1] as f32];
                return self.on_plate(half as usize / 2, half as usize % 2, from_first);
            }
        }
        let from_first = [dx + piece.before * piece.along[0], -dy - piece.before * piece.along[1]];
        self.on_plate(edge, (row.code[x] & RIGHT) as usize, from_first)
    }

    /// The plate on a side of an edge, and from its middle to a place known from the edge's first end, in pixels.
    fn on_plate(&self, edge: usize, side: usize, from_first: [f32; 2]) -> (i32, [f32; 2]) {
        let middle = self.sides.middles[edge][side];
        let place = [from_first[0] * self.data - middle[0] as f32, from_first[1] * self.data - middle[1] as f32];
        (self.sides.plates[edge][side], place)
    }

    /// Signed distance to the crack where chips have widened it.
    #[inline(always)]
    pub(super) fn chipped(&self, distance: f32, chip: f32) -> f32 {
        let deep = if chip > 0.0 { chip } else { 0.0 };
        distance - self.chip_depth * deep * deep
    }

    /// Colour, roughness and wear of a row.
    fn tones(&self, row: &Row<'_>, rows: &Rows, maps: &mut Maps<'_>) {
        let tinted = self.look.tint != 0.0;
        for (x, &distance) in row.distance.iter().enumerate() {
            let distance = self.chipped(distance, rows.chip[x].value);
            let covered = maps.mask.as_ref().map_or(0.0, |mask| f32::from(mask[row.start + x]) / 255.0);
            let chipped = unit(0.5 - distance);
            let crack = if self.chip_depth > 0.0 && chipped > covered { chipped } else { covered };
            let tint = if tinted { self.plate(row, x).map_or(0.0, |(plate, _)| plate.tint) } else { 0.0 };
            let place = Place { distance, crack, tint, mottle: rows.mottle[x].value, grain: rows.grain[x].value };
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
