//! Height across a crack and its rims, with its exact slope.

use super::lanes::Number;
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
pub(super) struct Height<N> {
    pub(super) height: N,
    pub(super) by_distance: N,
    pub(super) by_radius: N,
    /// How it changes with the plate's own height.
    pub(super) by_plate: N,
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
        let top = (1.0 - above).clamp(0.0, 1.0);
        Self {
            top,
            // Deeper ones would be cut off at height 0, grain and all.
            depth: material.depth.min((top - material.grain).max(0.0)),
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
    pub(super) fn at<N: Number>(&self, distance: N, radius: N, plate: N, curl: N) -> Height<N> {
        let (zero, one) = (distance.like(0.0), distance.like(1.0));
        let level = distance.like(self.top) + plate;
        let beside = self.beside(distance, plate, curl);
        let edge = level - distance.like(self.rim) + curl;
        let (share, by_share) = root_of_share(radius * distance.like(self.widest));
        let bottom = distance.like(self.top) - distance.like(self.depth) * share;
        // Chips reach beyond the middle of thin cracks: there the floor is level.
        let slanting = (-distance).is_below(radius);
        let (u, inverse) = ((-distance / radius).where_(slanting, one), (one / radius).where_(slanting, zero));
        let rest = one - u;
        let rest_cubed = rest * rest * rest;
        let (straight, round) = (distance.like(1.0 - self.roundness), distance.like(self.roundness));
        let wall = straight * u + round * (one - rest_cubed * rest);
        let by_u = straight + distance.like(4.0 * self.roundness) * rest_cubed;
        let fall = bottom - edge;
        let by_radius =
            distance.like(-self.depth) * by_share * distance.like(self.widest) * wall - fall * by_u * u * inverse;
        let inside = distance.is_below(zero);
        Height {
            height: (edge + fall * wall).where_(inside, beside.height),
            by_distance: (-fall * by_u * inverse).where_(inside, beside.by_distance),
            by_radius: by_radius.where_(inside, zero),
            by_plate: (one - wall).where_(inside, one),
        }
    }

    /// The same beside the crack.
    #[inline(always)]
    pub(super) fn beside<N: Number>(&self, distance: N, plate: N, curl: N) -> Height<N> {
        let (zero, one) = (distance.like(0.0), distance.like(1.0));
        let level = distance.like(self.top) + plate;
        let (a, b) = (rest(distance, self.rim_rate), rest(distance, self.curl_rate));
        let height = level - distance.like(self.rim) * a * a + curl * b * b;
        let by_distance = distance.like(2.0)
            * (distance.like(self.rim) * a * distance.like(self.rim_rate) - curl * b * distance.like(self.curl_rate));
        Height { height, by_distance, by_radius: zero, by_plate: one }
    }

    /// The part of the sky that is seen from a place: that of the middle between two long straight rims.
    ///
    /// A wall that rises by `z` at the distance `x` hides what lies below its rim; the rest, weighted by the cosine,
    /// is `x / hypot(x, z)` on that side.
    #[inline(always)]
    pub(super) fn sky<N: Number>(&self, distance: N, radius: N, height: N, level: N) -> N {
        let (zero, one) = (distance.like(0.0), distance.like(1.0));
        let near = distance.like(self.rim_width) - distance;
        let below = (distance.like(self.top) + level - height) * distance.like(self.relief);
        let far = distance.like(2.0) * (radius + distance.like(self.rim_width)) - near;
        let part = distance.like(0.5) * (seen(near, below) + seen(far.at_least(near), below));
        part.where_(zero.is_below(near), one).where_(zero.is_below(below), one)
    }
}

/// The part of the sky above a wall that is so far away, and whose rim is so far up, on its side.
#[inline(always)]
fn seen<N: Number>(far: N, below: N) -> N {
    far / (far * far + below * below).root()
}

/// What is left of 1 after so many parts, `rate` of them a pixel, if anything is, and if there is a rate at all.
#[inline(always)]
fn rest<N: Number>(distance: N, rate: f32) -> N {
    let (zero, one) = (distance.like(0.0), distance.like(1.0));
    if rate > 0.0 { (one - distance * distance.like(rate)).at_least(zero) } else { zero }
}

/// How deep a crack of a share of the largest width is: the root of the share; and its derivative.
#[inline(always)]
fn root_of_share<N: Number>(share: N) -> (N, N) {
    let (zero, one) = (share.like(0.0), share.like(1.0));
    let root = share.at_least(zero).root();
    let by_share = (share.like(0.5) / root).where_(zero.is_below(root), zero);
    let slanting = share.is_below(one);
    (root.where_(slanting, one), by_share.where_(slanting, zero))
}
