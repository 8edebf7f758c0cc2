//! Colour, roughness and wear of a pixel, from where it lies between the cracks.

use super::material::{Material, Rgb};

/// Steps of the ramp of colours between its ends.
const RAMP: usize = 255;

/// Steps of linear light for which the sRGB value is kept.
const LIGHT: usize = 4096;

/// Linear light, 0 to 1.
type Light = [f32; 3];

/// A material's colours, looked up once.
#[derive(Debug)]
pub(super) struct Look {
    ramp: Vec<Light>,
    srgb: Vec<u8>,
    crack: Light,
    dirt: Light,
    worn: Light,
    pub(super) tint: f32,
    mottle: f32,
    speckle: f32,
    dirt_amount: f32,
    pub(super) dirt_rate: f32,
    debris: f32,
    wear: f32,
    wear_rate: f32,
    roughness: f32,
    roughness_spread: f32,
    crack_roughness: f32,
}

/// What the look of a pixel depends on.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    /// Signed distance to the crack, pixels.
    pub(super) distance: f32,
    /// How much of the pixel is crack, 0 to 1.
    pub(super) crack: f32,
    /// The plate's own tint, -1 to 1.
    pub(super) tint: f32,
    /// 1 over how far what has settled beside the crack reaches here, pixels.
    pub(super) dirt_rate: f32,
    /// Noise, -1 to 1.
    pub(super) mottle: f32,
    /// Noise, -1 to 1.
    pub(super) grain: f32,
}

fn linear(color: Rgb) -> Light {
    color.map(|value| {
        let value = f64::from(value) / 255.0;
        let light = if value <= 0.04045 { value / 12.92 } else { libm::pow((value + 0.055) / 1.055, 2.4) };
        light as f32
    })
}

fn srgb(light: f64) -> u8 {
    let value = if light <= 0.003_130_8 { 12.92 * light } else { 1.055 * libm::pow(light, 1.0 / 2.4) - 0.055 };
    (value * 255.0).round() as u8
}

fn mix(a: Light, b: Light, part: f32) -> Light {
    [0, 1, 2].map(|channel| a[channel] + (b[channel] - a[channel]) * part)
}

fn unit(value: f32) -> f32 {
    let value = if value < 0.0 { 0.0 } else { value };
    if value > 1.0 { 1.0 } else { value }
}

/// 1 over a length, of none so much that any distance but 0 is beyond it: infinitely much would make that no number.
pub(super) fn rate(length: f32) -> f32 {
    if length > f32::MIN_POSITIVE { 1.0 / length } else { f32::MAX }
}

impl Look {
    /// Scales a material to pixels.
    pub(super) fn new(material: &Material, scale: f64) -> Self {
        let rate = |length: f32| if length > 0.0 { (1.0 / (f64::from(length) * scale)) as f32 } else { f32::MAX };
        let colors: Vec<Light> = material.plate.iter().copied().map(linear).collect();
        let step = |at: usize| {
            let place = at as f32 * (colors.len() - 1) as f32 / RAMP as f32;
            let first = (place as usize).min(colors.len() - 1);
            let second = (first + 1).min(colors.len() - 1);
            mix(colors[first], colors[second], place - first as f32)
        };
        Self {
            ramp: (0..=RAMP).map(step).collect(),
            srgb: (0..=LIGHT).map(|light| srgb(light as f64 / LIGHT as f64)).collect(),
            crack: linear(material.crack),
            dirt: linear(material.dirt),
            worn: linear(material.worn),
            tint: material.tint,
            mottle: material.mottle,
            speckle: material.speckle,
            dirt_amount: material.dirt_amount,
            dirt_rate: rate(material.dirt_width),
            debris: material.debris,
            wear: material.wear,
            wear_rate: rate(material.wear_width),
            roughness: material.roughness,
            roughness_spread: material.roughness_spread,
            crack_roughness: material.crack_roughness,
        }
    }

    /// How worn the plate is here: most at its edge, and where the noise is high.
    pub(super) fn wear(&self, place: &Place) -> f32 {
        let outside = if place.distance > 0.0 { place.distance } else { 0.0 };
        let near = unit(1.0 - outside * self.wear_rate);
        self.wear * near * near * unit(0.5 + 0.5 * place.mottle) * (1.0 - place.crack)
    }

    /// The colour, without light or shadow.
    pub(super) fn color(&self, place: &Place) -> [u8; 3] {
        let at = self.tint * place.tint + self.mottle * place.mottle + self.speckle * place.grain;
        let plate = self.ramp[(unit(0.5 + 0.5 * at) * RAMP as f32 + 0.5) as usize];
        let outside = if place.distance > 0.0 { place.distance } else { 0.0 };
        let near = unit(1.0 - outside * place.dirt_rate);
        let dirty = mix(plate, self.dirt, unit(self.dirt_amount * near * near * (0.75 + 0.5 * place.mottle)));
        let worn = mix(dirty, self.worn, unit(self.wear(place)));
        let littered = unit(self.debris * (0.5 + place.grain + 0.5 * place.mottle));
        let floor = if littered > 0.0 { mix(self.crack, self.dirt, littered) } else { self.crack };
        mix(worn, floor, place.crack).map(|light| self.srgb[(unit(light) * LIGHT as f32 + 0.5) as usize])
    }

    /// The roughness, 0 to 1.
    pub(super) fn roughness(&self, place: &Place) -> f32 {
        let plate = self.roughness + self.roughness_spread * 0.5 * (place.grain + place.mottle);
        unit(plate + (self.crack_roughness - plate) * place.crack)
    }
}
