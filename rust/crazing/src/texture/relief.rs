//! Height, normal and occlusion, some pixels of a row at a time.

use pulp::Simd;

use super::beneath::{Beneath, Discs, GROUP, Group, group};
use super::finish::{Row, Rows, stretch, unit};
use super::lanes::{Number, Several};
use super::maps::Maps;
use super::noise::Value;
use super::plates::Plate;
use super::profile::Height;
use super::scene::Scene;

/// The normal of level ground.
const UP: [f32; 3] = [0.0, 0.0, 1.0];

/// What is done for some pixels of a row.
#[derive(Default)]
struct Ground {
    beneath: Beneath,
    /// Without the chips, and with them.
    bare: Group,
    distance: Group,
    /// How the chips change it a pixel to the right and a pixel down.
    chips: [Group; 2],
    /// How far the crack is frayed, in radii, and how that changes.
    fray: Group,
    frays: [Group; 2],
    /// How much higher than usual the plate is, and how that changes.
    rise: Group,
    slope: [Group; 2],
    /// The grain, of plates and cracks alike.
    grain: Group,
    grain_slope: [Group; 2],
    curl: Group,
}

/// What the maps get.
#[derive(Default)]
struct Relief {
    height: Group,
    sky: Group,
    normal: [Group; 3],
}

impl Scene<'_> {
    /// Writes height, normal and occlusion of a row.
    #[inline(always)]
    pub(super) fn relief<S: Simd>(&self, simd: S, row: &Row<'_>, rows: &Rows, maps: &mut Maps<'_>) {
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
        let (mut ground, mut relief) =
            (Ground { curl: [self.profile.curl; GROUP], ..Ground::default() }, Relief::default());
        for first in (0..row.width()).step_by(GROUP) {
            let distances = group(&row.distance[first..], f32::INFINITY);
            if is_near(&distances, reach) {
                (ground.bare, ground.distance) = (distances, distances);
                ground.beneath.find(row, first);
                self.chip(first, rows, &mut ground);
                self.fray(first, rows, &mut ground);
                self.raise(row, first, rows, &mut ground);
                for at in (0..GROUP).step_by(S::F32_LANES) {
                    self.stand(simd, at, &ground, &mut relief, [normal.is_some(), sky.is_some()]);
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
        for lane in 0..GROUP.min(rows.chip.value.len() - first) {
            let chip = rows.chip.at(first + lane);
            let deep = 2.0 * self.chip_depth * if chip.value < 1.0 { unit(chip.value) } else { 0.0 };
            ground.distance[lane] = self.chipped(ground.distance[lane], chip.value);
            ground.chips[0][lane] = deep * chip.slope[0];
            ground.chips[1][lane] = deep * chip.slope[1];
        }
    }

    /// How far the crack is frayed.
    #[inline(always)]
    fn fray(&self, first: usize, rows: &Rows, ground: &mut Ground) {
        if self.fray == 0.0 {
            return;
        }
        for lane in 0..GROUP.min(rows.grain.value.len() - first) {
            let grain = rows.grain.at(first + lane);
            ground.fray[lane] = self.frayed(grain.value);
            let steep = if grain.value.abs() < 0.5 { self.fray } else { 0.0 };
            ground.frays[0][lane] = steep * grain.slope[0];
            ground.frays[1][lane] = steep * grain.slope[1];
        }
    }

    /// How much higher than usual the plates are.
    #[inline(always)]
    fn raise(&self, row: &Row<'_>, first: usize, rows: &Rows, ground: &mut Ground) {
        if self.plain {
            return;
        }
        for (lane, x) in (first..row.width().min(first + GROUP)).enumerate() {
            let plate = self.plate(row, x);
            let place = if self.tilt == 0.0 { [0.0; 2] } else { self.on_own_plate(row, x) };
            let (rise, grain) = (self.rise(plate.map(|plate| (plate, place))), rows.grain.at(x));
            ground.rise[lane] = rise.value;
            (ground.slope[0][lane], ground.slope[1][lane]) = (rise.slope[0], rise.slope[1]);
            ground.grain[lane] = grain.value * self.grain_height;
            for axis in 0..2 {
                ground.grain_slope[axis][lane] = grain.slope[axis] * self.grain_height;
            }
            ground.curl[lane] = self.profile.curl * plate.map_or(1.0, |plate| 1.0 - self.curl_spread * plate.curl);
        }
    }

    /// How much higher than usual a plate is at a pixel.
    fn rise(&self, plate: Option<(&Plate, [f32; 2])>) -> Value {
        let Some((plate, place)) = plate else { return Value::default() };
        let mut rise = Value { value: plate.level * self.level, slope: [0.0; 2] };
        if self.tilt != 0.0 {
            let by = plate.tilt.map(|part| part * self.tilt);
            rise.value += place[0] * by[0] + place[1] * by[1];
            rise.slope = [by[0] * self.data, -by[1] * self.data];
        }
        rise
    }

    /// What stands on the ground; normals and occlusion only where they are wanted.
    #[inline(always)]
    fn stand<S: Simd>(&self, simd: S, at: usize, ground: &Ground, relief: &mut Relief, [normal, sky]: [bool; 2]) {
        let (distance, fray) = (Several::load(simd, &ground.distance, at), Several::load(simd, &ground.fray, at));
        let (rise, curl) = (Several::load(simd, &ground.rise, at), Several::load(simd, &ground.curl, at));
        let discs = ground.beneath.discs(simd, at);
        let radius = discs.foot.radius;
        let (zero, one) = (distance.like(0.0), distance.like(1.0));
        let (bare, half) = (distance, distance.like(0.5));
        let frayed = fray * radius - half * bare.at_least(zero);
        let distance = bare - frayed.at_least(zero);
        let found = if self.fray == 0.0 && is_outside(&ground.distance[at..at + S::F32_LANES]) {
            self.profile.beside(distance, rise, curl)
        } else {
            self.profile.at(distance, radius, rise, curl)
        };
        // Of plates that are all alike all is level from some distance on, to the last bit.
        let reach = distance.like(if self.plain { self.profile.reach } else { f32::INFINITY });
        let near = Several::load(simd, &ground.bare, at).is_below(reach);
        let height = found.height + Several::load(simd, &ground.grain, at);
        if sky {
            let sky = self.profile.sky(distance, radius, found.height, rise);
            sky.where_(near, one).store(&mut relief.sky, at);
        }
        height.unit().where_(near, distance.like(self.profile.top)).store(&mut relief.height, at);
        if normal {
            let (by_place, grows) = (discs.by_place(), discs.grows());
            let chips = [Several::load(simd, &ground.chips[0], at), Several::load(simd, &ground.chips[1], at)];
            let by_plate = [Several::load(simd, &ground.slope[0], at), Several::load(simd, &ground.slope[1], at)];
            // Where the range of heights ends, it is level.
            let pixels = distance.like(self.profile.relief);
            let pixels = pixels.where_(zero.is_below(height), zero).where_(height.is_below(one), zero);
            let grain = [0, 1].map(|axis| Several::load(simd, &ground.grain_slope[axis], at));
            let by_place = [0, 1].map(|axis| {
                let bare_by = by_place[axis] - chips[axis];
                let far = (half * bare_by).where_(zero.is_below(bare), zero);
                let frays = fray * grows[axis] + radius * Several::load(simd, &ground.frays[axis], at) - far;
                bare_by - frays.where_(zero.is_below(frayed), zero)
            });
            let x = (found.slope(by_place[0], grows[0], by_plate[0]) + grain[0]) * pixels;
            let y = (found.slope(by_place[1], grows[1], by_plate[1]) + grain[1]) * pixels;
            let length = one / (x * x + y * y + one).root();
            (-x * length).where_(near, zero).store(&mut relief.normal[0], at);
            (y * length).where_(near, zero).store(&mut relief.normal[1], at);
            length.where_(near, one).store(&mut relief.normal[2], at);
        }
    }
}

impl<N: Number> Height<N> {
    /// How it changes along an axis, along which distance, radius and plate change so.
    #[inline(always)]
    fn slope(&self, distance: N, radius: N, plate: N) -> N {
        self.by_distance * distance + self.by_radius * radius + self.by_plate * plate
    }
}

impl<N: Number> Discs<N> {
    /// How the distance changes a pixel to the right and a pixel down.
    #[inline(always)]
    fn by_place(&self) -> [N; 2] {
        let Self { foot, along: [u, v], .. } = self;
        let (zero, one) = (foot.centre.like(0.0), foot.centre.like(1.0));
        let inverse = (one / foot.centre).where_(zero.is_below(foot.centre), zero);
        [(foot.ahead * *u + foot.side * *v) * inverse, (foot.ahead * *v - foot.side * *u) * inverse]
    }

    /// How the radius does: it grows along the piece; beyond its ends the nearest disc stays the same.
    #[inline(always)]
    fn grows(&self) -> [N; 2] {
        let Self { foot, along: [u, v], length, slope, lean } = self;
        let zero = foot.s.like(0.0);
        let grows = slope.where_(zero.is_below(foot.s), zero).where_(foot.s.is_below(*length), zero);
        let lean = (-*lean).where_(foot.side.is_below(zero), *lean);
        [grows * (*u + lean * *v), grows * (*v - lean * *u)]
    }
}

impl Relief {
    /// Level ground of that height.
    #[inline(always)]
    fn level(height: f32) -> Self {
        let [x, y, z] = UP;
        Self { height: [height; GROUP], sky: [1.0; GROUP], normal: [[x; GROUP], [y; GROUP], [z; GROUP]] }
    }
}

/// Writes as many values as are done together, or fewer where the map ends.
#[inline(always)]
fn put<T>(out: &mut [T], of: impl Fn(usize) -> T) {
    if let Some(out) = out.first_chunk_mut::<GROUP>() {
        for (lane, out) in out.iter_mut().enumerate() {
            *out = of(lane);
        }
    } else {
        out.iter_mut().enumerate().for_each(|(lane, out)| *out = of(lane));
    }
}

/// Whether all places are beside the crack.
#[inline(always)]
fn is_outside(distances: &[f32]) -> bool {
    distances.iter().fold(true, |all, &distance| all & (distance >= 0.0))
}

/// Whether any place is nearer to the crack than `reach`.
#[inline(always)]
fn is_near(distances: &[f32], reach: f32) -> bool {
    distances.iter().fold(false, |any, &distance| any | (distance < reach))
}
