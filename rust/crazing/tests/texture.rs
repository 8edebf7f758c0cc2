//! Textures: one hash for every build and processor, and distances against a plain computation.
#![allow(clippy::unwrap_used, missing_docs)]

use crazing::texture::{Maps, Material, Pattern, Sides, View, Window, plates, texture};
use crazing::{Error, Watch};

/// Of all maps below, by any compiler, profile, processor and number of threads.
const GOLDEN: u64 = 14_702_045_137_166_987_124;

const BOUNDS: [f64; 4] = [0.0, 0.0, 1.0, 1.0];

/// A spoked wheel of tapers, some of them crossing the edge of the period.
struct Wheel {
    vertices: Vec<[f64; 2]>,
    edges: Vec<[i32; 2]>,
    shifts: Vec<[i8; 2]>,
    widths: Vec<[f64; 2]>,
    labels: Vec<i32>,
}

impl Wheel {
    fn new(spokes: i32) -> Self {
        let mut wheel =
            Self { vertices: vec![[0.4, 0.6]], edges: vec![], shifts: vec![], widths: vec![], labels: vec![] };
        for spoke in 0..spokes {
            let angle = f64::from(spoke) * std::f64::consts::TAU / f64::from(spokes);
            let (sine, cosine) = libm::sincos(angle);
            let tip = [0.4 + 0.45 * cosine, 0.6 + 0.45 * sine];
            let wrapped = tip.map(|value| value - value.floor());
            wheel.vertices.push(wrapped);
            wheel.edges.push([0, spoke + 1]);
            wheel.shifts.push([0, 1].map(|axis| (tip[axis] - wrapped[axis]) as i8));
            wheel.widths.push([0.03, 0.002 * f64::from(spoke % 4)]);
            wheel.labels.push(spoke);
        }
        wheel
    }

    fn pattern(&self) -> Pattern<'_> {
        let Self { vertices, edges, shifts, widths, labels } = self;
        Pattern { vertices, edges, shifts, widths, strand: labels, generation: labels }
    }
}

fn material() -> Material {
    Material {
        relief: 0.05,
        widest: 0.03,
        depth: 0.7,
        roundness: 0.5,
        rim: 0.05,
        rim_width: 0.01,
        chip: 0.01,
        fray: 0.6,
        chip_size: 0.03,
        curl: 0.1,
        curl_width: 0.1,
        curl_spread: 0.5,
        tilt: 0.05,
        level: 0.05,
        grain: 0.02,
        grain_size: 0.01,
        plate: vec![[120, 90, 60], [220, 200, 170]],
        tint: 0.5,
        mottle: 0.3,
        mottle_size: 0.3,
        speckle: 0.2,
        stretch: 1.0,
        crack: [30, 20, 10],
        dirt: [90, 70, 50],
        dirt_amount: 0.5,
        dirt_width: 0.05,
        dirt_taper: 0.0,
        debris: 0.3,
        worn: [250, 250, 240],
        wear: 0.4,
        wear_width: 0.03,
        roughness: 0.6,
        roughness_spread: 0.2,
        crack_roughness: 0.9,
    }
}

/// Every map of a window as bytes.
fn all(wheel: &Wheel, side: usize, window: Window, threads: usize) -> Vec<u8> {
    let found = plates(&wheel.pattern(), BOUNDS, Some([1.0; 2]), Watch::default()).unwrap();
    let sides = Sides { plates: &found.plates, middles: &found.middles, reaches: &found.reaches, bounds: BOUNDS };
    let pixels = window.height * window.width;
    let mut bytes = vec![vec![0_u8; pixels], vec![0; 3 * pixels]];
    let mut floats: Vec<Vec<f32>> = [1, 3, 1, 1, 1, 1, 2].iter().map(|channels| vec![0.0; channels * pixels]).collect();
    let mut numbers = vec![vec![0_i32; pixels]; 3];
    let [mask, color] = &mut bytes[..] else { return Vec::new() };
    let [height, normal, ao, roughness, wear, distance, direction] = &mut floats[..] else { return Vec::new() };
    let [cell, strand, generation] = &mut numbers[..] else { return Vec::new() };
    let maps = Maps {
        mask: Some(mask),
        color: Some(color),
        height: Some(height),
        normal: Some(normal),
        ao: Some(ao),
        roughness: Some(roughness),
        wear: Some(wear),
        distance: Some(distance),
        direction: Some(direction),
        cell: Some(cell),
        strand: Some(strand),
        generation: Some(generation),
    };
    let view = View { bounds: BOUNDS, height: side, width: side, period: Some([1.0; 2]) };
    texture(wheel.pattern(), sides, &view, window, &material(), [7, 9], threads, Watch::default(), maps).unwrap();
    let floats = floats.into_iter().flatten().flat_map(f32::to_le_bytes);
    let numbers = numbers.into_iter().flatten().flat_map(i32::to_le_bytes);
    bytes.into_iter().flatten().chain(floats).chain(numbers).collect()
}

/// Fowler, Noll and Vo's hash.
fn hash(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xCBF2_9CE4_8422_2325, |hash, byte| (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01B3))
}

#[test]
fn one_hash_for_every_build_and_number_of_threads() {
    let wheel = Wheel::new(13);
    let whole = Window { top: 0, left: 0, height: 200, width: 200 };
    for threads in [1, 3] {
        assert_eq!(hash(&all(&wheel, 200, whole, threads)), GOLDEN, "{threads} threads");
    }
}

#[test]
fn a_window_beyond_the_picture_is_the_next_period() {
    let wheel = Wheel::new(13);
    let window = |top, left| Window { top, left, height: 70, width: 90 };
    assert_eq!(all(&wheel, 128, window(5, 100), 1), all(&wheel, 128, window(5 - 128, 100 + 256), 1));
}

#[test]
fn distances_are_those_of_every_disc() {
    let wheel = Wheel::new(7);
    let (side, pixels) = (64, 64 * 64);
    let mut distance = vec![0.0_f32; pixels];
    let view = View { bounds: BOUNDS, height: side, width: side, period: Some([1.0; 2]) };
    let maps = Maps { distance: Some(&mut distance), ..Maps::default() };
    let sides = Sides { plates: &[[0; 2]; 7], middles: &[[[0.0; 2]; 2]; 7], reaches: &[1.0], bounds: BOUNDS };
    let window = Window { top: 0, left: 0, height: side, width: side };
    texture(wheel.pattern(), sides, &view, window, &material(), [7, 9], 1, Watch::default(), maps).unwrap();
    for (pixel, found) in distance.iter().enumerate().step_by(7) {
        let [x, y] =
            [(pixel % side) as f64 + 0.5, side as f64 - 0.5 - (pixel / side) as f64].map(|at| at / side as f64);
        let mut least = f64::INFINITY;
        for (edge, (shift, widths)) in wheel.edges.iter().zip(wheel.shifts.iter().zip(&wheel.widths)) {
            let (a, b) = (wheel.vertices[edge[0] as usize], wheel.vertices[edge[1] as usize]);
            for disc in 0..=2000 {
                let t = f64::from(disc) / 2000.0;
                let centre = [0, 1].map(|axis| a[axis] + t * (b[axis] + f64::from(shift[axis]) - a[axis]));
                let radius = (widths[0] + t * (widths[1] - widths[0])) / 2.0;
                for image in 0..9 {
                    let (i, j) = (f64::from(image % 3 - 1), f64::from(image / 3 - 1));
                    least = least.min((x - centre[0] - i).hypot(y - centre[1] - j) - radius);
                }
            }
        }
        assert!((f64::from(*found) - least).abs() < 2e-5, "pixel {pixel}: {found} for {least}");
    }
}

#[test]
fn a_period_of_broken_pixels_is_refused() {
    let wheel = Wheel::new(3);
    let view = View { bounds: BOUNDS, height: 10, width: 10, period: Some([0.33, 1.0]) };
    let window = Window { top: 0, left: 0, height: 1, width: 1 };
    let sides = Sides { plates: &[[0; 2]; 3], middles: &[[[0.0; 2]; 2]; 3], reaches: &[1.0], bounds: BOUNDS };
    let mut mask = [0];
    let maps = Maps { mask: Some(&mut mask), ..Maps::default() };
    let refused = texture(wheel.pattern(), sides, &view, window, &material(), [0, 0], 1, Watch::default(), maps);
    assert!(matches!(refused, Err(Error::BadValue { name: "the period in pixels", .. })), "{refused:?}");
}
