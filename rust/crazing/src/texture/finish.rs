//! From the nearest piece of every pixel to the maps, row by row of a page.

use super::Scene;
use super::grid::UNIT;
use super::look::Place;
use super::maps::Maps;
use super::nearest::{PAGE, Page, Set};
use super::noise::Value;
use super::piece::Piece;
use super::plates::Plate;

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
struct Row<'a> {
    set: &'a Set,
    page: &'a Page,
    /// Its first pixel, from the top left corner of the picture.
    corner: [i64; 2],
    /// Where it starts in the maps of the band.
    start: usize,
    distance: &'a [f32],
    code: &'a [u32],
    /// The plate of every code.
    cells: &'a [i32],
}

/// Rows of noise, one a kind.
#[derive(Debug)]
pub(super) struct Rows {
    pub(super) grain: Vec<Value>,
    pub(super) mottle: Vec<Value>,
    pub(super) chip: Vec<Value>,
}

impl Rows {
    pub(super) fn new() -> Self {
        let row = || vec![Value::default(); PAGE];
        Self { grain: row(), mottle: row(), chip: row() }
    }
}

impl Row<'_> {
    fn width(&self) -> usize {
        self.distance.len()
    }

    /// The nearest piece of a pixel, if there is any.
    fn piece(&self, x: usize) -> Option<&Piece> {
        let id = *self.page.ids.get((self.code[x] / 2) as usize)?;
        self.set.pieces.get(id as usize)
    }

    /// Where a pixel lies from the start of a piece, in pixels.
    #[inline(always)]
    fn offset(&self, x: usize, piece: &Piece) -> [f32; 2] {
        let middle = |pixel: i64| pixel * UNIT + UNIT / 2;
        piece.offset(middle(self.corner[0] + x as i64), middle(self.corner[1]))
    }

    /// To which side of its nearest edge a pixel lies: 0 left, 1 right.
    fn side(&self, x: usize) -> usize {
        (self.code[x] & 1) as usize
    }
}

/// The stretch of a map that belongs to a row, if the map is wanted.
fn stretch<'b, T>(map: &'b mut Option<&mut [T]>, row: &Row<'_>, channels: usize) -> Option<&'b mut [T]> {
    map.as_mut().map(|map| &mut map[row.start * channels..(row.start + row.width()) * channels])
}

impl Scene<'_> {
    /// Writes the part of a page into a band of the window.
    pub(super) fn finish(&self, set: &Set, page: &Page, part: Part, rows: &mut Rows, maps: &mut Maps<'_>) {
        let cells = if maps.cell.is_some() { self.cells(set, page) } else { Vec::new() };
        for y in 0..part.height {
            let at = y * PAGE..y * PAGE + part.width;
            let corner = [part.corner[0], part.corner[1] + y as i64];
            let start = (part.at[1] + y) * self.window.width + part.at[0];
            let (distance, code) = (&page.distance[at.clone()], &page.code[at]);
            let row = Row { set, page, corner, start, distance, code, cells: &cells };
            if let Some(out) = stretch(&mut maps.distance, &row, 1) {
                out.iter_mut().zip(distance).for_each(|(out, distance)| *out = distance * self.data);
            }
            self.labels(&row, maps);
            if self.wants_profile || self.wants_look {
                self.noises(corner, part.width, rows);
            }
            if self.wants_profile {
                self.relief(&row, rows, maps);
            }
            if self.wants_look {
                self.tones(&row, rows, maps);
            }
        }
    }

    /// The plates of every code: to the left and to the right of each candidate.
    fn cells(&self, set: &Set, page: &Page) -> Vec<i32> {
        page.ids.iter().flat_map(|&id| self.sides.plates[set.pieces[id as usize].edge as usize]).collect()
    }

    fn labels(&self, row: &Row<'_>, maps: &mut Maps<'_>) {
        if let Some(out) = stretch(&mut maps.cell, row, 1) {
            let several = self.fans.is_some();
            for (x, out) in out.iter_mut().enumerate() {
                let Some(piece) = row.piece(x) else {
                    *out = 0;
                    continue;
                };
                // Beyond the ends of edges others may lie between.
                let [dx, dy] = row.offset(x, piece);
                let beyond = several && piece.behind(dx, dy).is_some();
                *out = if beyond { self.plate_of(row, x, piece).0 } else { row.cells[row.code[x] as usize] };
            }
        }
        let labels = [(&mut maps.strand, self.pattern.strand), (&mut maps.generation, self.pattern.generation)];
        for (map, label) in labels {
            let Some(out) = stretch(map, row, 1) else { continue };
            for (x, (out, &distance)) in out.iter_mut().zip(row.distance).enumerate() {
                *out = -1;
                if distance < 0.5 {
                    *out = row.piece(x).map_or(-1, |piece| label[piece.edge as usize]);
                }
            }
        }
        if let Some(out) = stretch(&mut maps.direction, row, 2) {
            for (x, out) in out.as_chunks_mut().0.iter_mut().enumerate() {
                *out = row.piece(x).map_or([0.0; 2], |piece| [piece.along[0], -piece.along[1]]);
            }
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

    fn plate(&self, row: &Row<'_>, x: usize) -> Option<(&Plate, [f32; 2])> {
        let (plate, place) = self.plate_of(row, x, row.piece(x)?);
        Some((self.plates.get(plate as usize)?, place))
    }

    /// The plate of a pixel, and from its middle to the pixel, data units, y up.
    fn plate_of(&self, row: &Row<'_>, x: usize, piece: &Piece) -> (i32, [f32; 2]) {
        let [dx, dy] = row.offset(x, piece);
        let (edge, end) = (piece.edge as usize, piece.behind(dx, dy));
        if let (Some(fans), Some(end)) = (&self.fans, end) {
            let along = if end == 0 { 0.0 } else { piece.length };
            let place = [f64::from(dx - along * piece.along[0]), f64::from(along * piece.along[1] - dy)];
            if let Some((half, from_first)) = fans.beyond(self.pattern.edges[edge][end], place) {
                let from_first = [from_first[0] as f32, from_first[1] as f32];
                return self.on_plate(half as usize / 2, half as usize % 2, from_first);
            }
        }
        let from_first = [dx + piece.before * piece.along[0], -dy - piece.before * piece.along[1]];
        self.on_plate(edge, row.side(x), from_first)
    }

    /// The plate on a side of an edge, and from its middle to a place known from the edge's first end, in pixels.
    fn on_plate(&self, edge: usize, side: usize, from_first: [f32; 2]) -> (i32, [f32; 2]) {
        let middle = self.sides.middles[edge][side];
        let place = [from_first[0] * self.data - middle[0] as f32, from_first[1] * self.data - middle[1] as f32];
        (self.sides.plates[edge][side], place)
    }

    /// Signed distance to the crack where chips have widened it.
    fn chipped(&self, distance: f32, chip: f32) -> f32 {
        let deep = if chip > 0.0 { chip } else { 0.0 };
        distance - self.chip_depth * deep * deep
    }

    /// Height, normal and occlusion of a row.
    fn relief(&self, row: &Row<'_>, rows: &Rows, maps: &mut Maps<'_>) {
        if self.plain {
            // Beyond the rims all is level.
            if let Some(out) = stretch(&mut maps.height, row, 1) {
                out.fill(self.profile.top);
            }
            if let Some(out) = stretch(&mut maps.normal, row, 3) {
                out.as_chunks_mut().0.fill([0.0, 0.0, 1.0]);
            }
            if let Some(out) = stretch(&mut maps.ao, row, 1) {
                out.fill(1.0);
            }
        }
        for (x, &distance) in row.distance.iter().enumerate() {
            if self.plain && distance >= self.profile.reach {
                continue;
            }
            if let Some(piece) = row.piece(x) {
                let plate = if self.plain { None } else { self.plate(row, x) };
                self.relieve(row, x, piece, plate, rows, maps);
            } else {
                self.level(row, x, maps);
            }
        }
    }

    /// A pixel of a picture without any crack.
    fn level(&self, row: &Row<'_>, x: usize, maps: &mut Maps<'_>) {
        if let Some(out) = stretch(&mut maps.height, row, 1) {
            out[x] = self.profile.top;
        }
        if let Some(out) = stretch(&mut maps.normal, row, 3) {
            out[3 * x..3 * x + 3].copy_from_slice(&[0.0, 0.0, 1.0]);
        }
        if let Some(out) = stretch(&mut maps.ao, row, 1) {
            out[x] = 1.0;
        }
    }

    fn relieve(
        &self,
        row: &Row<'_>,
        x: usize,
        piece: &Piece,
        plate: Option<(&Plate, [f32; 2])>,
        rows: &Rows,
        maps: &mut Maps<'_>,
    ) {
        let [dx, dy] = row.offset(x, piece);
        let foot = piece.foot(dx, dy);
        let distance = self.chipped(row.distance[x], rows.chip[x].value);
        let rise = self.rise(plate, rows.grain[x]);
        let curl = self.profile.curl * plate.map_or(1.0, |(plate, _)| 1.0 - self.curl_spread * plate.curl);
        let found = self.profile.at(distance, foot.radius, rise.value, curl);
        if let Some(out) = stretch(&mut maps.height, row, 1) {
            out[x] = unit(found.height);
        }
        if let Some(out) = stretch(&mut maps.ao, row, 1) {
            out[x] = self.profile.sky(distance, foot.radius, found.height, rise.value);
        }
        let Some(out) = stretch(&mut maps.normal, row, 3) else { return };
        let [u, v] = piece.along;
        let inverse = if foot.centre > 0.0 { 1.0 / foot.centre } else { 0.0 };
        let chip = rows.chip[x];
        let chips = 2.0 * self.chip_depth * if chip.value > 0.0 { chip.value } else { 0.0 };
        let by_place = [
            (foot.ahead * u + foot.side * v) * inverse - chips * chip.slope[0],
            (foot.ahead * v - foot.side * u) * inverse - chips * chip.slope[1],
        ];
        // The radius grows along the piece; beyond its ends the nearest disc stays the same.
        let grows = if foot.s > 0.0 && foot.s < piece.length { piece.slope } else { 0.0 };
        let lean = if foot.side < 0.0 { -piece.lean } else { piece.lean };
        let radius = [grows * (u + lean * v), grows * (v - lean * u)];
        let slope = [0, 1].map(|axis| {
            let sum =
                found.by_distance * by_place[axis] + found.by_radius * radius[axis] + found.by_plate * rise.slope[axis];
            sum * self.profile.relief
        });
        let length = 1.0 / (slope[0] * slope[0] + slope[1] * slope[1] + 1.0).sqrt();
        out[3 * x..3 * x + 3].copy_from_slice(&[-slope[0] * length, slope[1] * length, length]);
    }

    /// How much higher than usual a plate is at a pixel.
    fn rise(&self, plate: Option<(&Plate, [f32; 2])>, grain: Value) -> Value {
        let mut rise =
            Value { value: grain.value * self.grain_height, slope: grain.slope.map(|by| by * self.grain_height) };
        let Some((plate, place)) = plate else { return rise };
        rise.value += plate.level * self.level;
        if self.tilt != 0.0 {
            let by = plate.tilt.map(|part| part * self.tilt);
            rise.value += place[0] * by[0] + place[1] * by[1];
            rise.slope = [rise.slope[0] + by[0] * self.data, rise.slope[1] - by[1] * self.data];
        }
        rise
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

fn unit(value: f32) -> f32 {
    let value = if value < 0.0 { 0.0 } else { value };
    if value > 1.0 { 1.0 } else { value }
}
