//! Numbers that cracks wander by.

use crate::quantile;
use crate::rng::{Key, block, open_unit, stream};

/// A power of a number that is not negative, within some 1e-15 of it for powers that lengths grow by: half the time of
/// one that is exact to the last bit.
pub(super) fn power(base: f64, exponent: f64) -> f64 {
    if exponent == 0.0 { 1.0 } else { libm::exp2(exponent * libm::log2(base)) }
}

/// Standard normal numbers, one of its own for every place on an edge.
pub(super) struct Noise {
    key: Key,
    edge: u64,
    level: u64,
    block: u64,
    words: [u64; 4],
}

impl Noise {
    pub(super) fn of(key: Key, edge: usize, level: u64) -> Self {
        let words = block(key, [edge as u64, 0, stream::ROUGHNESS, level]);
        Self { key, edge: edge as u64, level, block: 0, words }
    }

    /// Those of the first places, the same that [`Noise::at`] gives.
    pub(super) fn fill(key: Key, edge: usize, level: u64, numbers: &mut [f64]) {
        for (numbers, count) in numbers.chunks_mut(4).zip(0..) {
            let words = block(key, [edge as u64, count, stream::ROUGHNESS, level]);
            numbers.iter_mut().zip(words).for_each(|(number, word)| *number = open_unit(word));
        }
        quantile::normal_each(numbers);
    }

    pub(super) fn at(&mut self, index: usize) -> f64 {
        if index as u64 / 4 != self.block {
            self.block = index as u64 / 4;
            self.words = block(self.key, [self.edge, self.block, stream::ROUGHNESS, self.level]);
        }
        quantile::normal(open_unit(self.words[index % 4]))
    }
}

#[cfg(test)]
mod tests {
    use super::power;

    #[test]
    fn powers_are_those_of_the_library() {
        for base in [1e-12, 0.003, 0.5, 1.0, 1.7, 40.0, 1e9] {
            for exponent in [0.0, 0.15, 0.5, 0.7, 1.0, 1.2] {
                assert!((power(base, exponent) / libm::pow(base, exponent) - 1.0).abs() < 1e-14, "{base} {exponent}");
            }
        }
        assert_eq!([power(0.0, 0.5), power(0.0, 0.0), power(f64::INFINITY, 0.0)], [0.0, 1.0, 1.0]);
    }
}
