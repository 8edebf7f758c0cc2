//! A power of two that brings coordinates near 1, so that exact arithmetic neither over- nor underflows.

use std::borrow::Cow;

use crate::graph::Point;
use crate::parallel;

/// Coordinates smaller than this part of the largest one count as zero: what the triangulation can hold.
const RESOLUTION: f64 = 1.0 / ((1_u64 << 63) as f64 * (1_u64 << 63) as f64); // 2^-126

/// An exact change of unit by a power of two, as two factors: their product may be out of range.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scale {
    down: [f64; 2],
    up: [f64; 2],
}

impl Scale {
    /// The unit for points whose largest coordinate is `largest` in size: 1 for all ordinary data.
    pub fn of(largest: f64) -> Self {
        let exponent = if largest > 0.0 { libm::ilogb(largest) } else { 0 };
        let exponent = if (-16..=64).contains(&exponent) { 0 } else { exponent };
        let halves = [exponent / 2, exponent - exponent / 2];
        Self { down: halves.map(|e| libm::ldexp(1.0, -e)), up: halves.map(|e| libm::ldexp(1.0, e)) }
    }

    /// Whether the unit is 1.
    pub fn is_one(self) -> bool {
        self.up == [1.0; 2]
    }

    /// From data to the scaled unit.
    pub fn down(self, p: Point) -> Point {
        p.map(|x| x * self.down[0] * self.down[1])
    }

    /// All of them; as they are where the unit is 1.
    pub fn all_down(self, points: &[Point]) -> Cow<'_, [Point]> {
        if self.is_one() { Cow::Borrowed(points) } else { points.iter().map(|&p| self.down(p)).collect() }
    }

    /// Back to data, exactly for every coordinate that came from there; never infinite.
    pub fn up(self, p: Point) -> Point {
        p.map(|x| (x * self.up[0] * self.up[1]).clamp(-f64::MAX, f64::MAX))
    }
}

/// Size of the largest coordinate.
pub fn largest(points: &[Point]) -> f64 {
    parallel::ranges(points.len(), |range| largest_of(&points[range])).into_iter().fold(0.0, f64::max)
}

fn largest_of(points: &[Point]) -> f64 {
    // Eight at a time: one running maximum would wait for itself.
    let (eights, rest) = points.as_flattened().as_chunks::<8>();
    let larger = |found: f64, x: &f64| if x.abs() > found { x.abs() } else { found };
    let mut lanes = [0.0; 8];
    for eight in eights {
        lanes.iter_mut().zip(eight).for_each(|(found, x)| *found = larger(*found, x));
    }
    lanes.iter().chain(rest).fold(0.0, larger)
}

/// Sets a coordinate too small to matter beside `largest` to zero, and -0 to 0.
pub fn cleared(p: Point, largest: f64) -> Point {
    let floor = RESOLUTION * largest;
    p.map(|x| if x.abs() < floor { 0.0 } else { x + 0.0 })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_and_back_is_exact_at_both_ends_of_the_range() {
        for size in [5e-324, 1e-300, 1e-9, 1.0, 1e9, 1e300, f64::MAX] {
            let scale = Scale::of(size);
            let near_one = scale.down([size, -size]);
            assert!((1e-5..2e19).contains(&near_one[0]), "{size}");
            assert_eq!(scale.up(near_one), [size, -size]);
        }
    }
}
