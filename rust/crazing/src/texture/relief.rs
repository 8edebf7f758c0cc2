//! Height, normal and occlusion, some pixels of a row at a time.

use super::finish::{Row, Rows, stretch, unit};
use super::grid::{PART, UNIT};
use super::maps::Maps;
use super::near::CODES;
use super::noise::Value;
use super::piece::Foot;
use super::plates::Plate;
use super::scene::Scene;

/// Pixels done together.
const LANES: usize = 8;

type Lanes = [f32; LANES];

/// The normal of level ground.
const UP: [f32; 3] = [0.0, 0.0, 1.0];

/// The nearest discs of some pixels, and what stands on them.
#[derive(Default)]
struct Ground {
    distance: Lanes,
    radius: Lanes,
    /// How the distance changes a pixel to the right and a pixel down.
    by_place: [Lanes; 2],
    /// How the radius does.
    grows: [Lanes; 2],
    /// How much higher than usual the plate is, and how that changes.
    rise: Lanes,
    slope: [Lanes; 2],
    curl: Lanes,
}

/// What the maps get.
#[derive(Default)]
struct Relief {
    height: Lanes,
    sky: Lanes,
    normal: [Lanes; 3],
}

impl Scene<'_> {
    /// Writes height, normal and occlusion of a row.
    #[inline(always)]
    pub(super) fn relief(&self, row: &Row<'_>, rows: &Rows, maps: &mut Maps<'_>) {
        let mut height = stretch(&mut maps.height, row, 1);
        let mut normal = stretch(&mut maps.normal, row, 3).map(|out| out.as_chunks_mut().0);
        let mut sky = stretch(&mut maps.ao, row, 1);
        let reach = if self.plain { self.profile.reach } else { f32::INFINITY };
        if !is_near(row.distance, reach) {
            // Beyond the rims all is level.
            height.iter_mut().for_each(|out| out.fill(self.profile.top));
            normal.iter_mut().for_each(|out| out.fill(UP));
            sky.iter_mut().for_each(|out| out.fill(1.0));
            return;
        }
        let (mut ground, mut relief) = (Ground::default(), Relief::default());
        for first in (0..row.width()).step_by(LANES) {
            let distances = lanes(&row.distance[first..], f32::INFINITY);
            if is_near(&distances, reach) {
                ground.distance = distances;
                find(row, first, &mut ground, normal.is_some());
                self.chip(first, rows, &mut ground);
                self.raise(row, first, rows, &mut ground);
                self.stand(&ground, &mut relief, sky.is_some(), normal.is_some());
                if self.plain {
                    relief.flatten(&distances, reach, self.profile.top);
                }
            } else {
                relief = Relief::level(self.profile.top);
            }
            if let Some(out) = &mut height {
                put(&mut out[first..], |lane| relief.height[lane]);
            }
            if let Some(out) = &mut sky {
                put(&mut out[first..], |lane| relief.sky[lane]);
            }
            if let Some(out) = &mut normal {
                let [x, y, z] = &relief.normal;
                put(&mut out[first..], |lane| [x[lane], y[lane], z[lane]]);
            }
        }
    }

    /// Widens the crack by its chips.
    #[inline(always)]
    fn chip(&self, first: usize, rows: &Rows, ground: &mut Ground) {
        if self.chip.is_empty() {
            return;
        }
        for (lane, chip) in rows.chip[first..].iter().take(LANES).enumerate() {
            let deep = 2.0 * self.chip_depth * if chip.value > 0.0 { chip.value } else { 0.0 };
            ground.distance[lane] = self.chipped(ground.distance[lane], chip.value);
            ground.by_place[0][lane] -= deep * chip.slope[0];
            ground.by_place[1][lane] -= deep * chip.slope[1];
        }
    }

    /// How much higher than usual the plates are.
    #[inline(always)]
    fn raise(&self, row: &Row<'_>, first: usize, rows: &Rows, ground: &mut Ground) {
        ground.curl = [self.profile.curl; LANES];
        if self.plain {
            return;
        }
        for (lane, x) in (first..row.width().min(first + LANES)).enumerate() {
            let plate = self.plate(row, x);
            let rise = self.rise(plate, rows.grain[x]);
            ground.rise[lane] = rise.value;
            (ground.slope[0][lane], ground.slope[1][lane]) = (rise.slope[0], rise.slope[1]);
            ground.curl[lane] = self.profile.curl * plate.map_or(1.0, |(plate, _)| 1.0 - self.curl_spread * plate.curl);
        }
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

    /// What stands on the ground.
    #[inline(always)]
    fn stand(&self, ground: &Ground, relief: &mut Relief, sky: bool, normal: bool) {
        let (mut by_distance, mut by_radius, mut by_plate) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
        if ground.distance.iter().fold(true, |all, &distance| all & (distance >= 0.0)) {
            for (lane, by_distance) in by_distance.iter_mut().enumerate() {
                let (distance, rise, curl) = (ground.distance[lane], ground.rise[lane], ground.curl[lane]);
                (relief.height[lane], *by_distance) = self.profile.beside(distance, rise, curl);
            }
            by_plate = [1.0; LANES];
        } else {
            for lane in 0..LANES {
                let (distance, radius) = (ground.distance[lane], ground.radius[lane]);
                let found = self.profile.at(distance, radius, ground.rise[lane], ground.curl[lane]);
                relief.height[lane] = found.height;
                by_distance[lane] = found.by_distance;
                by_radius[lane] = found.by_radius;
                by_plate[lane] = found.by_plate;
            }
        }
        if sky {
            for lane in 0..LANES {
                let (distance, radius) = (ground.distance[lane], ground.radius[lane]);
                relief.sky[lane] = self.profile.sky(distance, radius, relief.height[lane], ground.rise[lane]);
            }
        }
        for height in &mut relief.height {
            *height = unit(*height);
        }
        if normal {
            for lane in 0..LANES {
                let slope = |axis: usize| {
                    let sum = by_distance[lane] * ground.by_place[axis][lane]
                        + by_radius[lane] * ground.grows[axis][lane]
                        + by_plate[lane] * ground.slope[axis][lane];
                    sum * self.profile.relief
                };
                let (x, y) = (slope(0), slope(1));
                let length = 1.0 / (x * x + y * y + 1.0).sqrt();
                relief.normal[0][lane] = -x * length;
                relief.normal[1][lane] = y * length;
                relief.normal[2][lane] = length;
            }
        }
    }
}

impl Relief {
    /// Level ground of that height.
    #[inline(always)]
    fn level(height: f32) -> Self {
        let [x, y, z] = UP;
        Self { height: [height; LANES], sky: [1.0; LANES], normal: [[x; LANES], [y; LANES], [z; LANES]] }
    }

    /// Levels what is not nearer to the crack than `reach`.
    #[inline(always)]
    fn flatten(&mut self, distances: &Lanes, reach: f32, top: f32) {
        let [x, y, z] = &mut self.normal;
        for (values, level) in [(&mut self.height, top), (&mut self.sky, 1.0), (x, 0.0), (y, 0.0), (z, 1.0)] {
            for lane in 0..LANES {
                values[lane] = if distances[lane] < reach { values[lane] } else { level };
            }
        }
    }
}

/// The first of some values, as many as are done together; what is missing is `pad`.
#[inline(always)]
fn lanes<T: Copy>(values: &[T], pad: T) -> [T; LANES] {
    values.first_chunk().copied().unwrap_or_else(|| {
        let mut lanes = [pad; LANES];
        lanes[..values.len()].copy_from_slice(values);
        lanes
    })
}

/// Writes as many values as are done together, or fewer where the map ends.
#[inline(always)]
fn put<T>(out: &mut [T], of: impl Fn(usize) -> T) {
    if let Some(out) = out.first_chunk_mut::<LANES>() {
        for (lane, out) in out.iter_mut().enumerate() {
            *out = of(lane);
        }
    } else {
        out.iter_mut().enumerate().for_each(|(lane, out)| *out = of(lane));
    }
}

/// Whether any place is nearer to the crack than `reach`.
#[inline(always)]
fn is_near(distances: &[f32], reach: f32) -> bool {
    distances.iter().fold(false, |any, &distance| any | (distance < reach))
}

/// The nearest discs of some pixels; how they change only where that is wanted.
#[inline(always)]
fn find(row: &Row<'_>, first: usize, ground: &mut Ground, slopes: bool) {
    let (mut dx, mut dy) = ([0.0_f32; LANES], [0.0_f32; LANES]);
    let (mut along, mut length) = ([[0.0_f32; LANES]; 2], [0.0_f32; LANES]);
    let (mut widths, mut lean) = ([[0.0_f32; LANES]; 2], [0.0_f32; LANES]);
    let codes = lanes(&row.code[first..], row.code[first]);
    let middle = |pixel: usize| pixel as i32 * UNIT as i32 + UNIT as i32 / 2;
    let one = codes[0] / CODES;
    if let (true, Some(near)) = (is_one(&codes, one), row.page.near.get(one as usize)) {
        // Most pixels beside each other have the same nearest piece.
        dy = [middle(row.y).wrapping_sub(near.start[1]) as f32 * PART; LANES];
        for (lane, dx) in dx.iter_mut().enumerate() {
            *dx = middle(first + lane).wrapping_sub(near.start[0]) as f32 * PART;
        }
        (along, length) = ([[near.along[0]; LANES], [near.along[1]; LANES]], [near.length; LANES]);
        (widths, lean) = ([[near.radius; LANES], [near.slope; LANES]], [near.lean; LANES]);
    } else {
        for lane in 0..LANES.min(row.width() - first) {
            let x = first + lane;
            if let Some(near) = row.page.near.get((codes[lane] / CODES) as usize) {
                dx[lane] = middle(x).wrapping_sub(near.start[0]) as f32 * PART;
                dy[lane] = middle(row.y).wrapping_sub(near.start[1]) as f32 * PART;
                (along[0][lane], along[1][lane], length[lane]) = (near.along[0], near.along[1], near.length);
                (widths[0][lane], widths[1][lane], lean[lane]) = (near.radius, near.slope, near.lean);
            } else if let Some(piece) = row.piece(x) {
                [dx[lane], dy[lane]] = row.offset(x, piece);
                (along[0][lane], along[1][lane], length[lane]) = (piece.along[0], piece.along[1], piece.length);
                (widths[0][lane], widths[1][lane], lean[lane]) = (piece.radius, piece.slope, piece.lean);
            }
        }
    }
    for lane in 0..LANES {
        let [u, v] = [along[0][lane], along[1][lane]];
        let foot = Foot::new(dx[lane], dy[lane], [u, v], length[lane], [widths[0][lane], widths[1][lane]], lean[lane]);
        ground.radius[lane] = foot.radius;
        if !slopes {
            continue;
        }
        let inverse = if foot.centre > 0.0 { 1.0 / foot.centre } else { 0.0 };
        ground.by_place[0][lane] = (foot.ahead * u + foot.side * v) * inverse;
        ground.by_place[1][lane] = (foot.ahead * v - foot.side * u) * inverse;
        // The radius grows along the piece; beyond its ends the nearest disc stays the same.
        let between = (foot.s > 0.0) & (foot.s < length[lane]);
        let grows = if between { widths[1][lane] } else { 0.0 };
        let lean = if foot.side < 0.0 { -lean[lane] } else { lean[lane] };
        ground.grows[0][lane] = grows * (u + lean * v);
        ground.grows[1][lane] = grows * (v - lean * u);
    }
}

/// Whether all codes are those of one piece.
#[inline(always)]
fn is_one(codes: &[u32; LANES], place: u32) -> bool {
    let mut all = true;
    for code in codes {
        all &= code / CODES == place;
    }
    all
}
