//! Numbers as levels of an unsigned type, as files of whole numbers hold them.

use pulp::Arch;

use crate::error::{Error, Result};
use crate::parallel;

/// Numbers of a stretch: they stay in the cache from one step to the next.
const STRETCH: usize = 1 << 14;

/// 2^23: added to a whole number from 0 to 65535, it leaves that in the lowest bits.
const LIFT: f32 = 8_388_608.0;

/// An unsigned type.
pub trait Level: Copy + Send {
    /// The highest level.
    const TOP: f32;

    /// The lowest bits of a word.
    fn of(word: u32) -> Self;
}

macro_rules! level {
    ($($kind:ty),*) => {
        $(impl Level for $kind {
            const TOP: f32 = Self::MAX as f32;

            #[inline(always)]
            fn of(word: u32) -> Self {
                word as Self
            }
        })*
    };
}

level!(u8, u16);

/// Which numbers the levels are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scale {
    /// The number of level 0.
    pub low: f32,
    /// Levels a unit.
    pub steep: f32,
}

impl Scale {
    /// Writes the nearest levels of some numbers, halves upwards; what is beyond the levels becomes the last of them.
    ///
    /// # Errors
    /// [`Error::BadLength`] when there is not a level for every number.
    pub fn levels<T: Level>(self, numbers: &[f32], out: &mut [T]) -> Result<()> {
        let (found, wanted) = (out.len(), numbers.len());
        if found != wanted {
            return Err(Error::BadLength { array: "levels", found, wanted });
        }
        let parts = numbers.chunks(STRETCH).zip(out.chunks_mut(STRETCH)).collect();
        // Compiled once for any processor, and once for those that do twice as many numbers at a time.
        parallel::parts(wanted, parts, |(numbers, out)| Arch::new().dispatch(|| self.stretch(numbers, out)));
        Ok(())
    }

    #[inline(always)]
    fn stretch<T: Level>(self, numbers: &[f32], out: &mut [T]) {
        for (&number, out) in numbers.iter().zip(out) {
            let level = (number - self.low) * self.steep + 0.5;
            let level = if level > 0.0 { level } else { 0.0 };
            let level = if level < T::TOP { level } else { T::TOP };
            // `as` would look at every number by itself.
            let near = level + LIFT - LIFT;
            let whole = if near > level { near - 1.0 } else { near };
            *out = T::of((whole + LIFT).to_bits());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_is_a_level_for_every_number() {
        let scale = Scale { low: 0.0, steep: 255.0 };
        let wanted = Error::BadLength { array: "levels", found: 1, wanted: 2 };
        assert_eq!(scale.levels(&[0.0, 1.0], &mut [0_u8]), Err(wanted));
    }
}
