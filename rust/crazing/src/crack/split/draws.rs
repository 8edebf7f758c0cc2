//! Random numbers by which cells are split.

use crate::quantile;
use crate::rng::{Rng, open_unit, unit};

/// So many are made together.
const MANY: usize = 64;

/// The words of a stream in turn, each as a number of one law or of another. All are made normal ahead, which most will
/// be: together that takes half as long.
pub(super) struct Draws {
    rng: Rng,
    words: [u64; MANY],
    normals: [f64; MANY],
    next: usize,
}

impl Draws {
    pub(super) fn of(rng: Rng) -> Self {
        Self { rng, words: [0; MANY], normals: [0.0; MANY], next: MANY }
    }

    /// Of the standard normal law.
    #[inline]
    pub(super) fn normal(&mut self) -> f64 {
        let place = self.step();
        self.normals[place]
    }

    /// A multiple of 2^-53 in [0, 1).
    #[inline]
    pub(super) fn unit(&mut self) -> f64 {
        let place = self.step();
        unit(self.words[place])
    }

    #[inline]
    fn step(&mut self) -> usize {
        if self.next == MANY {
            self.words = std::array::from_fn(|_| self.rng.next_u64());
            self.normals = self.words.map(open_unit);
            quantile::normal_each(&mut self.normals);
            self.next = 0;
        }
        self.next += 1;
        self.next - 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::stream;

    #[test]
    fn numbers_are_those_of_the_stream() {
        let mut rng = Rng::new([1, 2], stream::SPLIT);
        let mut draws = Draws::of(rng.clone());
        for i in 0..10 * MANY {
            if i % 7 == 3 {
                assert_eq!(draws.unit().to_bits(), rng.unit().to_bits());
            } else {
                assert_eq!(draws.normal().to_bits(), quantile::normal(open_unit(rng.next_u64())).to_bits());
            }
        }
    }
}
