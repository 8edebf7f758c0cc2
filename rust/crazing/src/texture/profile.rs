//! Height across a crack and its rims, with its exact slope.

use super::material::Material;

/// The profile in pixels.
#[derive(Debug, Clone, Copy)]
pub(super) struct Profile {
    /// Height of an undisturbed plate.
    pub(super) top: f32,
    depth: f32,
    roundness: f32,
    rim: f32,
    /// 1 over the width of the rim; 0 where there is none.
    rim_rate: f32,
    pub(super) curl: f32,
    curl_rate: f32,
    /// 1 over the radius of the widest crack.
    widest: f32,
    /// Nothing is raised or lowered farther from the crack than this; chips included.
    pub(super) reach: f32,
    /// Pixels a unit of height.
    pub(super) relief: f32,
    rim_width: f32,
}

/// A height and how it changes with the distance to the crack and with the crack's radius.
#[derive(Debug, Clone, Copy)]
pub(super) struct Height {
    pub(super) height: f32,
    pub(super) by_distance: f32,
    pub(super) by_radius: f32,
    /// How it changes with the plate's own height.
    pub(super) by_plate: f32,
}

impl Profile {
    /// Scales a material to pixels.
    pub(super) fn new(material: &Material, scale: f64) -> Self {
        let pixels = |length: f32| (f64::from(length) * scale) as f32;
        let reach = |width: f32, amount: f32| if amount == 0.0 { 0.0 } else { width };
        let rate = |length: f32| if length > 0.0 { 1.0 / pixels(length) } else { 0.0 };
        let (rim_width, curl_width) = (pixels(material.rim_width), pixels(material.curl_width));
        // Plates curl up or down; the highest place of all is at height 1.
        let above = material.curl.max(0.0) + material.tilt + material.level + material.grain;
        Self {
            top: (1.0 - above).clamp(0.0, 1.0),
            depth: material.depth,
            roundness: material.roundness,
            rim: if rim_width > 0.0 { material.rim } else { 0.0 },
            rim_rate: rate(material.rim_width),
            curl: if curl_width > 0.0 { material.curl } else { 0.0 },
            curl_rate: rate(material.curl_width),
            widest: 2.0 * rate(material.widest),
            reach: reach(rim_width, material.rim).max(reach(curl_width, material.curl)) + pixels(material.chip),
            relief: pixels(material.relief),
            rim_width,
        }
    }

    /// The height at a signed distance from a crack of that radius, where the plate lies `plate` above its usual
    /// level and curls by `curl`.
    #[inline(always)]
    pub(super) fn at(&self, distance: f32, radius: f32, plate: f32, curl: f32) -> Height {
        let level = self.top + plate;
        let (beside, beside_by_distance) = self.beside(distance, plate, curl);
        let edge = level - self.rim + curl;
        let (share, by_share) = root_of_share(radius * self.widest);
        let bottom = self.top - self.depth * share;
        // Chips reach beyond the middle of thin cracks: there the floor is level.
        let slanting = -distance < radius;
        let (u, inverse) = (-distance / radius, 1.0 / radius);
        let (u, inverse) = (if slanting { u } else { 1.0 }, if slanting { inverse } else { 0.0 });
        let rest = 1.0 - u;
        let rest_cubed = rest * rest * rest;
        let wall = (1.0 - self.roundness) * u + self.roundness * (1.0 - rest_cubed * rest);
        let by_u = (1.0 - self.roundness) + 4.0 * self.roundness * rest_cubed;
        let fall = bottom - edge;
        let by_radius = -self.depth * by_share * self.widest * wall - fall * by_u * u * inverse;
        let outside = distance >= 0.0;
        Height {
            height: if outside { beside } else { edge + fall * wall },
            by_distance: if outside { beside_by_distance } else { -fall * by_u * inverse },
            by_radius: if outside { 0.0 } else { by_radius },
            by_plate: if outside { 1.0 } else { 1.0 - wall },
        }
    }

    /// The same beside the crack: the height, and how it changes with the distance.
    #[inline(always)]
    pub(super) fn beside(&self, distance: f32, plate: f32, curl: f32) -> (f32, f32) {
        let level = self.top + plate;
        // Both without a branch, so that several places are done at a time.
        let (a, b) = (rest(distance * self.rim_rate, self.rim_rate), rest(distance * self.curl_rate, self.curl_rate));
        let height = level - self.rim * a * a + curl * b * b;
        (height, 2.0 * (self.rim * a * self.rim_rate - curl * b * self.curl_rate))
    }

    /// The part of the sky that is seen from a place: that of the middle between two long straight rims.
    ///
    /// A wall that rises by `z` at the distance `x` hides what lies below its rim; the rest, weighted by the cosine,
    /// is `x / hypot(x, z)` on that side.
    #[inline(always)]
    pub(super) fn sky(&self, distance: f32, radius: f32, height: f32, level: f32) -> f32 {
        let near = self.rim_width - distance;
        let below = (self.top + level - height) * self.relief;
        let far = 2.0 * (radius + self.rim_width) - near;
        let seen = |x: f32| x / (x * x + below * below).sqrt();
        let far = if far > near { far } else { near };
        let part = 0.5 * (seen(near) + seen(far));
        if (near <= 0.0) | (below <= 0.0) { 1.0 } else { part }
    }
}

/// What is left of 1 after `part`, if anything, and if there is a rate at all.
#[inline(always)]
fn rest(part: f32, rate: f32) -> f32 {
    if (part < 1.0) & (rate > 0.0) { 1.0 - part } else { 0.0 }
}

/// How deep a crack of a share of the largest width is: the root of the share; and its derivative.
#[inline(always)]
fn root_of_share(share: f32) -> (f32, f32) {
    let root = if share > 0.0 { share } else { 0.0 }.sqrt();
    let by_share = if root > 0.0 { 0.5 / root } else { 0.0 };
    let deep = share >= 1.0;
    (if deep { 1.0 } else { root }, if deep { 0.0 } else { by_share })
}
