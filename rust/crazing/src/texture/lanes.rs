//! One number, or several of as many pixels, to which the same is done: formulas are written once for both.

use std::ops::{Add, Div, Mul, Neg, Sub};

use pulp::Simd;

/// What the formulas of textures are written in. Every operation rounds by itself, so that all kinds give the same bits.
pub(super) trait Number:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
    /// For every number yes or no.
    type Mask: Copy;

    /// That value, of the same kind.
    fn like(self, value: f32) -> Self;
    fn size(self) -> Self;
    fn root(self) -> Self;
    fn is_below(self, other: Self) -> Self::Mask;
    /// These where the answer is yes, else the others.
    fn where_(self, mask: Self::Mask, other: Self) -> Self;
    /// `low` where that is more.
    fn at_least(self, low: Self) -> Self;
    /// `high` where that is less.
    fn at_most(self, high: Self) -> Self;

    /// Cut to 0 to 1.
    #[inline(always)]
    fn unit(self) -> Self {
        self.at_least(self.like(0.0)).at_most(self.like(1.0))
    }
}

impl Number for f32 {
    type Mask = bool;

    #[inline(always)]
    fn like(self, value: f32) -> Self {
        value
    }

    #[inline(always)]
    fn size(self) -> Self {
        self.abs()
    }

    #[inline(always)]
    fn root(self) -> Self {
        self.sqrt()
    }

    #[inline(always)]
    fn is_below(self, other: Self) -> bool {
        self < other
    }

    #[inline(always)]
    fn where_(self, mask: bool, other: Self) -> Self {
        if mask { self } else { other }
    }

    #[inline(always)]
    fn at_least(self, low: Self) -> Self {
        if self < low { low } else { self }
    }

    #[inline(always)]
    fn at_most(self, high: Self) -> Self {
        if self > high { high } else { self }
    }
}

/// As many numbers as the processor does at a time.
#[derive(Debug, Clone, Copy)]
pub(super) struct Several<S: Simd>(S, S::f32s);

/// Whether the greatest of two numbers is the second where they are equal or none, as in [`Number::at_least`].
const SECOND: bool = cfg!(any(target_arch = "x86", target_arch = "x86_64"));

impl<S: Simd> Several<S> {
    /// As many of some values from the one numbered `at` on, which must be there.
    #[inline(always)]
    pub(super) fn load(simd: S, values: &[f32], at: usize) -> Self {
        let values = S::as_simd_f32s(&values[at..at + S::F32_LANES]).0;
        Self(simd, values[0])
    }

    #[inline(always)]
    pub(super) fn all(simd: S, value: f32) -> Self {
        Self(simd, simd.splat_f32s(value))
    }

    #[inline(always)]
    pub(super) fn store(self, out: &mut [f32], at: usize) {
        S::as_mut_simd_f32s(&mut out[at..at + S::F32_LANES]).0[0] = self.1;
    }
}

impl<S: Simd> Number for Several<S> {
    type Mask = S::m32s;

    #[inline(always)]
    fn like(self, value: f32) -> Self {
        Self::all(self.0, value)
    }

    #[inline(always)]
    fn size(self) -> Self {
        Self(self.0, self.0.abs_f32s(self.1))
    }

    #[inline(always)]
    fn root(self) -> Self {
        Self(self.0, self.0.sqrt_f32s(self.1))
    }

    #[inline(always)]
    fn is_below(self, other: Self) -> S::m32s {
        self.0.less_than_f32s(self.1, other.1)
    }

    #[inline(always)]
    fn where_(self, mask: S::m32s, other: Self) -> Self {
        Self(self.0, self.0.select_f32s(mask, self.1, other.1))
    }

    #[inline(always)]
    fn at_least(self, low: Self) -> Self {
        if SECOND && S::F32_LANES > 1 {
            Self(self.0, self.0.max_f32s(low.1, self.1))
        } else {
            low.where_(self.is_below(low), self)
        }
    }

    #[inline(always)]
    fn at_most(self, high: Self) -> Self {
        if SECOND && S::F32_LANES > 1 {
            Self(self.0, self.0.min_f32s(high.1, self.1))
        } else {
            high.where_(high.is_below(self), self)
        }
    }
}

macro_rules! operate {
    ($($kind:ident, $name:ident, $of:ident;)*) => {
        $(impl<S: Simd> $kind for Several<S> {
            type Output = Self;

            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                Self(self.0, self.0.$of(self.1, other.1))
            }
        })*
    };
}

operate! {
    Add, add, add_f32s;
    Sub, sub, sub_f32s;
    Mul, mul, mul_f32s;
    Div, div, div_f32s;
}

impl<S: Simd> Neg for Several<S> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self(self.0, self.0.neg_f32s(self.1))
    }
}

#[cfg(test)]
mod tests {
    use pulp::{Arch, Scalar, Simd, WithSimd};

    use super::{Number, Several};

    const ASKED: [f32; 11] = [0.0, -0.0, 1.0, -1.0, 0.3, -0.7, 1e-41, 3e38, f32::INFINITY, f32::NEG_INFINITY, f32::NAN];

    /// As many as any processor does at a time.
    const MOST: usize = 16;

    fn all<N: Number>(a: N, b: N) -> [N; 11] {
        let below = a.is_below(b);
        let sums = [a + b, a - b, a * b, a / b, -a, a.size(), a.root()];
        let [add, sub, mul, div, neg, size, root] = sums;
        [add, sub, mul, div, neg, size, root, a.at_least(b), a.at_most(b), a.where_(below, b), a.unit()]
    }

    struct Ask(f32, f32);

    impl WithSimd for Ask {
        type Output = Vec<Vec<u32>>;

        fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
            let stored = |found: Several<S>| {
                let mut out = [0.0; MOST];
                found.store(&mut out, 0);
                out[..S::F32_LANES].iter().map(|&value| bits(value)).collect()
            };
            all(Several::load(simd, &[self.0; MOST], 0), Several::all(simd, self.1)).map(stored).into()
        }
    }

    /// What is no number has many names, of which processors choose freely.
    fn bits(value: f32) -> u32 {
        if value.is_nan() { f32::NAN.to_bits() } else { value.to_bits() }
    }

    #[test]
    fn one_number_and_several_give_the_same_bits() {
        for (a, b) in ASKED.into_iter().flat_map(|a| ASKED.map(|b| (a, b))) {
            let wanted = all(a, b).map(bits);
            for found in [Arch::new().dispatch(Ask(a, b)), Ask(a, b).with_simd(Scalar)] {
                for (found, wanted) in found.iter().zip(wanted) {
                    assert!(found.iter().all(|&found| found == wanted), "{a} {b}: {found:?}, {wanted}");
                }
            }
        }
    }
}
