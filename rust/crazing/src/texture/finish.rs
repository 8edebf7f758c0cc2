//! From the nearest piece of every pixel to the maps.

use super::Scene;
use super::grid::UNIT;
use super::look::Place;
use super::maps::Maps;
use super::nearest::{PAGE, Page, Set};
use super::noise::Value;
use super::piece::{Foot, Piece};
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

/// A pixel and what is nearest to it.
struct Spot<'a> {
    piece: &'a Piece,
    foot: Foot,
    /// Signed distance, pixels, chipped.
    distance: f32,
    /// How the distance changes to the right and down.
    slope: [f32; 2],
    sides: usize,
    plate: Option<&'a Plate>,
    /// How much higher than usual the plate is here, and its slope.
    rise: Value,
    mottle: f32,
    grain: Value,
}

/// Rows of noise, one a kind.
#[derive(Debug)]
pub(super) struct Rows {
    grain: Vec<Value>,
    mottle: Vec<Value>,
    chip: Vec<Value>,
}

impl Rows {
    pub(super) fn new() -> Self {
        let row = || vec![Value::default(); PAGE];
        Self { grain: row(), mottle: row(), chip: row() }
    }
}

impl Scene<'_> {
    /// Writes the part of a page into a band of the window.
    pub(super) fn finish(&self, set: &Set, page: &Page, part: Part, rows: &mut Rows, maps: &mut Maps<'_>) {
        for y in 0..part.height {
            let start = (part.at[1] + y) * self.window.width + part.at[0];
            let (distance, code) = (&page.distance[y * PAGE..][..part.width], &page.code[y * PAGE..][..part.width]);
            if let Some(out) = &mut maps.distance {
                let out = &mut out[start..start + part.width];
                out.iter_mut().zip(distance).for_each(|(out, distance)| *out = distance * self.data);
            }
            if !self.wants_spots {
                continue;
            }
            let corner = [part.corner[0], part.corner[1] + y as i64];
            self.noises(corner, part.width, rows);
            for (x, (distance, code)) in distance.iter().zip(code).enumerate() {
                let pixel = [corner[0] + x as i64, corner[1]];
                let Some(&id) = page.ids.get((code / 2) as usize) else {
                    self.write_empty(maps, start + x);
                    continue;
                };
                let spot = self.spot(&set.pieces[id as usize], pixel, *distance, x, rows);
                self.write(maps, start + x, &spot);
            }
        }
    }

    fn noises(&self, corner: [i64; 2], width: usize, rows: &mut Rows) {
        for (noise, row) in
            [(&self.grain, &mut rows.grain), (&self.mottle, &mut rows.mottle), (&self.chip, &mut rows.chip)]
        {
            let mut weight = 1.0;
            let sum: f32 = (0..noise.len()).map(|octave| 0.5_f32.powi(octave as i32)).sum();
            let row = &mut row[..width];
            row.fill(Value::default());
            let mut one = [Value::default(); PAGE];
            for octave in noise {
                octave.row(corner[1], corner[0], &mut one[..width]);
                for (value, add) in row.iter_mut().zip(&one) {
                    let by = weight / sum;
                    value.value += by * add.value;
                    value.slope = [value.slope[0] + by * add.slope[0], value.slope[1] + by * add.slope[1]];
                }
                weight *= 0.5;
            }
        }
    }

    fn spot<'a>(&'a self, piece: &'a Piece, pixel: [i64; 2], distance: f32, x: usize, rows: &Rows) -> Spot<'a> {
        let [dx, dy] = piece.from_start(pixel[0] * UNIT + UNIT / 2, pixel[1] * UNIT + UNIT / 2);
        let foot = piece.foot(dx, dy);
        let [u, v] = piece.along;
        let inverse = if foot.centre > 0.0 { 1.0 / foot.centre } else { 0.0 };
        let mut slope = [(foot.ahead * u + foot.side * v) * inverse, (foot.ahead * v - foot.side * u) * inverse];
        let mut distance = distance;
        if self.chip_depth > 0.0 {
            let chip = rows.chip[x];
            let deep = if chip.value > 0.0 { chip.value } else { 0.0 };
            distance -= self.chip_depth * deep * deep;
            let by = 2.0 * self.chip_depth * deep;
            slope = [slope[0] - by * chip.slope[0], slope[1] - by * chip.slope[1]];
        }
        let side = usize::from(foot.side.to_bits() >> 31 == 1);
        let sides = 2 * piece.edge as usize + side;
        let plate = self.sides.plates.get(sides / 2).and_then(|pair| self.plates.get(pair[side] as usize));
        let grain = rows.grain[x];
        let rise = self.rise(plate, sides, piece, [dx, dy], grain);
        Spot { piece, foot, distance, slope, sides, plate, rise, mottle: rows.mottle[x].value, grain }
    }

    /// How much higher than usual a plate is at a place.
    fn rise(&self, plate: Option<&Plate>, sides: usize, piece: &Piece, from_start: [f32; 2], grain: Value) -> Value {
        let mut rise =
            Value { value: grain.value * self.grain_height, slope: grain.slope.map(|by| by * self.grain_height) };
        let Some(plate) = plate else { return rise };
        rise.value += plate.level * self.level;
        if let Some(middles) = self.sides.middles.get(sides / 2).filter(|_| self.tilt != 0.0) {
            // The pixel from the plate's middle, data units: through the start of the edge, which knows both.
            let [x, y] = [0, 1].map(|axis| (from_start[axis] + piece.before * piece.along[axis]) * self.data);
            let middle = middles[sides % 2];
            let [x, y] = [x - middle[0] as f32, -y - middle[1] as f32];
            let by = plate.tilt.map(|part| part * self.tilt);
            rise.value += x * by[0] + y * by[1];
            rise.slope = [rise.slope[0] + by[0] * self.data, rise.slope[1] - by[1] * self.data];
        }
        rise
    }

    /// Writes every map but the mask and the distance at one pixel.
    fn write(&self, maps: &mut Maps<'_>, at: usize, spot: &Spot<'_>) {
        let (foot, piece) = (&spot.foot, spot.piece);
        let edge = piece.edge as usize;
        let on_crack = foot.distance < 0.5;
        if let Some(out) = &mut maps.strand {
            out[at] = if on_crack { self.pattern.strand[edge] } else { -1 };
        }
        if let Some(out) = &mut maps.generation {
            out[at] = if on_crack { self.pattern.generation[edge] } else { -1 };
        }
        if let Some(out) = &mut maps.cell {
            out[at] = self.sides.plates.get(edge).map_or(0, |pair| pair[spot.sides % 2]);
        }
        if let Some(out) = &mut maps.direction {
            out[2 * at..2 * at + 2].copy_from_slice(&[piece.along[0], -piece.along[1]]);
        }
        if self.wants_profile {
            self.write_profile(maps, at, spot);
        }
        if self.wants_look {
            self.write_look(maps, at, spot);
        }
    }

    fn write_profile(&self, maps: &mut Maps<'_>, at: usize, spot: &Spot<'_>) {
        let (foot, profile) = (&spot.foot, &self.profile);
        let curl = profile.curl * spot.plate.map_or(1.0, |plate| 1.0 - self.curl_spread * plate.curl);
        let found = profile.at(spot.distance, foot.radius, spot.rise.value, curl);
        if let Some(out) = &mut maps.height {
            out[at] = unit(found.height);
        }
        if let Some(out) = &mut maps.ao {
            out[at] = profile.sky(spot.distance, foot.radius, found.height, spot.rise.value);
        }
        if let Some(out) = &mut maps.normal {
            let [u, v] = spot.piece.along;
            // The radius grows along the piece; at its ends the nearest disc stays the same.
            let moves = if foot.s > 0.0 && foot.s < spot.piece.length { spot.piece.slope } else { 0.0 };
            let lean = if foot.side < 0.0 { -spot.piece.lean } else { spot.piece.lean };
            let by_radius = [moves * (u + lean * v), moves * (v - lean * u)];
            // The plate's own slope ends where the crack's floor begins.
            let own = if spot.distance < 0.0 { 1.0 - unit(-spot.distance / foot.radius) } else { 1.0 };
            let slope = [0, 1].map(|axis| {
                let by = found.by_distance * spot.slope[axis]
                    + found.by_radius * by_radius[axis]
                    + own * spot.rise.slope[axis];
                by * profile.relief
            });
            let length = (slope[0] * slope[0] + slope[1] * slope[1] + 1.0).sqrt();
            out[3 * at..3 * at + 3].copy_from_slice(&[-slope[0] / length, slope[1] / length, 1.0 / length]);
        }
    }

    fn write_look(&self, maps: &mut Maps<'_>, at: usize, spot: &Spot<'_>) {
        let covered = maps.mask.as_ref().map_or(0.0, |mask| f32::from(mask[at]) / 255.0);
        let chipped = unit(0.5 - spot.distance);
        let crack = if self.chip_depth > 0.0 && chipped > covered { chipped } else { covered };
        let tint = spot.plate.map_or(0.0, |plate| plate.tint);
        let place = Place { distance: spot.distance, crack, tint, mottle: spot.mottle, grain: spot.grain.value };
        if let Some(out) = &mut maps.color {
            out[3 * at..3 * at + 3].copy_from_slice(&self.look.color(&place));
        }
        if let Some(out) = &mut maps.roughness {
            out[at] = self.look.roughness(&place);
        }
        if let Some(out) = &mut maps.wear {
            out[at] = self.look.wear(&place);
        }
    }

    /// Writes a pixel of a picture without any crack.
    fn write_empty(&self, maps: &mut Maps<'_>, at: usize) {
        for map in [&mut maps.strand, &mut maps.generation].into_iter().flatten() {
            map[at] = -1;
        }
        if let Some(out) = &mut maps.cell {
            out[at] = 0;
        }
        if let Some(out) = &mut maps.direction {
            out[2 * at..2 * at + 2].fill(0.0);
        }
        if let Some(out) = &mut maps.height {
            out[at] = self.profile.top;
        }
        if let Some(out) = &mut maps.ao {
            out[at] = 1.0;
        }
        if let Some(out) = &mut maps.normal {
            out[3 * at..3 * at + 3].copy_from_slice(&[0.0, 0.0, 1.0]);
        }
        let place = Place { distance: f32::INFINITY, crack: 0.0, tint: 0.0, mottle: 0.0, grain: 0.0 };
        if let Some(out) = &mut maps.color {
            out[3 * at..3 * at + 3].copy_from_slice(&self.look.color(&place));
        }
        if let Some(out) = &mut maps.roughness {
            out[at] = self.look.roughness(&place);
        }
        if let Some(out) = &mut maps.wear {
            out[at] = 0.0;
        }
    }
}

fn unit(value: f32) -> f32 {
    let value = if value < 0.0 { 0.0 } else { value };
    if value > 1.0 { 1.0 } else { value }
}
