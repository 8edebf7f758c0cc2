//! What a crack is made of: its profile in depth, and its colours. Lengths are in data units, heights are parts of
//! the range from the deepest to the highest place.

use crate::error::{Error, Result};

/// Red, green, blue; sRGB.
pub type Rgb = [u8; 3];

/// A material; see the fields of `crazing.Material`, which says the same in units of the pattern.
#[derive(Debug, Clone, PartialEq)]
#[allow(missing_docs, reason = "named and explained as in the face")]
pub struct Material {
    pub relief: f32,
    pub widest: f32,
    pub depth: f32,
    pub roundness: f32,
    pub rim: f32,
    pub rim_width: f32,
    pub chip: f32,
    pub chip_size: f32,
    pub fray: f32,
    pub curl: f32,
    pub curl_width: f32,
    pub curl_spread: f32,
    pub tilt: f32,
    pub level: f32,
    pub grain: f32,
    pub grain_size: f32,
    pub plate: Vec<Rgb>,
    pub tint: f32,
    pub mottle: f32,
    pub mottle_size: f32,
    pub speckle: f32,
    pub stretch: f32,
    pub crack: Rgb,
    pub dirt: Rgb,
    pub dirt_amount: f32,
    pub dirt_width: f32,
    pub dirt_taper: f32,
    pub debris: f32,
    pub worn: Rgb,
    pub wear: f32,
    pub wear_width: f32,
    pub roughness: f32,
    pub roughness_spread: f32,
    pub crack_roughness: f32,
}

impl Material {
    /// Refuses what is not a number, and a ramp without a colour.
    pub(super) fn check(&self) -> Result<()> {
        let wrong = |value: f32, wanted| Err(Error::BadValue { name: "material", value: value.into(), wanted });
        match self.numbers().into_iter().find(|value| !value.is_finite()) {
            Some(value) => wrong(value, "finite numbers are wanted"),
            None if self.stretch <= 0.0 => wrong(self.stretch, "a positive stretch is wanted"),
            None if self.plate.is_empty() => Err(Error::BadLength { array: "material.plate", found: 0, wanted: 1 }),
            None => Ok(()),
        }
    }

    fn numbers(&self) -> [f32; 30] {
        [
            self.relief,
            self.widest,
            self.depth,
            self.roundness,
            self.rim,
            self.rim_width,
            self.chip,
            self.chip_size,
            self.fray,
            self.curl,
            self.curl_width,
            self.curl_spread,
            self.tilt,
            self.level,
            self.grain,
            self.grain_size,
            self.tint,
            self.mottle,
            self.mottle_size,
            self.speckle,
            self.stretch,
            self.dirt_amount,
            self.dirt_width,
            self.dirt_taper,
            self.debris,
            self.wear,
            self.wear_width,
            self.roughness,
            self.roughness_spread,
            self.crack_roughness,
        ]
    }
}
