//! Quantiles of standard distributions: what turns a uniform number into one of another law.
//!
//! Only + - * /, the square root and the logarithm of `libm`: the same bits on every platform.
#![expect(clippy::excessive_precision, reason = "the coefficients are as printed in their source")]

/// The number that a standard Laplace variable stays below with probability `p` of (0, 1).
pub fn laplace(p: f64) -> f64 {
    if p < 0.5 { libm::log(2.0 * p) } else { -libm::log(2.0 * (1.0 - p)) }
}

/// The number that a standard normal variable stays below with probability `p` of (0, 1).
///
/// Relative error about 1e-15.
///
/// # Source
/// Wichura: Algorithm AS 241: The Percentage Points of the Normal Distribution (Applied Statistics 1988), PPND16.
pub fn normal(p: f64) -> f64 {
    let q = p - 0.5;
    if q.abs() <= 0.425 {
        return q * rational(&CENTRE, 0.180_625 - q * q);
    }
    let tail = if q < 0.0 { p } else { 1.0 - p };
    let r = (-libm::log(tail)).sqrt();
    let distance = if r <= 5.0 { rational(&MIDDLE, r - 1.6) } else { rational(&FAR, r - 5.0) };
    if q < 0.0 { -distance } else { distance }
}

/// [`normal`] of every number, in place: the middle is worked out for all at once, and the tails again by themselves.
pub fn normal_each(numbers: &mut [f64]) {
    /// Few enough to stay in registers and the nearest cache.
    const TOGETHER: usize = 8;
    for some in numbers.chunks_mut(TOGETHER) {
        let mut given = [0.5; TOGETHER];
        given[..some.len()].copy_from_slice(some);
        let found = given.map(|p| {
            let q = p - 0.5;
            q * rational(&CENTRE, 0.180_625 - q * q)
        });
        for ((slot, p), centre) in some.iter_mut().zip(given).zip(found) {
            *slot = if (p - 0.5).abs() <= 0.425 { centre } else { normal(p) };
        }
    }
}

/// Numerator and denominator of a rational function, lowest power first.
type Rational = [[f64; 8]; 2];

fn rational([numerator, denominator]: &Rational, x: f64) -> f64 {
    polynomial(numerator, x) / polynomial(denominator, x)
}

fn polynomial(coefficients: &[f64; 8], x: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, &c| sum * x + c)
}

// The three pieces of PPND16, coefficients as printed: |p - 1/2| <= 0.425, then sqrt(-ln tail) up to 5, then beyond.
const CENTRE: Rational = [
    [
        3.387_132_872_796_366_608,
        1.331_416_678_917_843_774_5e+2,
        1.971_590_950_306_551_442_7e+3,
        1.373_169_376_550_946_112_5e+4,
        4.592_195_393_154_987_145_7e+4,
        6.726_577_092_700_870_085_3e+4,
        3.343_057_558_358_812_810_5e+4,
        2.509_080_928_730_122_672_7e+3,
    ],
    [
        1.0,
        4.231_333_070_160_091_125_2e+1,
        6.871_870_074_920_579_083e+2,
        5.394_196_021_424_751_107_7e+3,
        2.121_379_430_158_659_586_7e+4,
        3.930_789_580_009_271_061e+4,
        2.872_908_573_572_194_267_4e+4,
        5.226_495_278_852_854_561e+3,
    ],
];
const MIDDLE: Rational = [
    [
        1.423_437_110_749_683_577_34,
        4.630_337_846_156_545_295_9,
        5.769_497_221_460_691_405_5,
        3.647_848_324_763_204_605_04,
        1.270_458_252_452_368_382_58,
        2.417_807_251_774_506_117_7e-1,
        2.272_384_498_926_918_458_33e-2,
        7.745_450_142_783_414_076_4e-4,
    ],
    [
        1.0,
        2.053_191_626_637_758_821_87,
        1.676_384_830_183_803_849_4,
        6.897_673_349_851_000_045_5e-1,
        1.481_039_764_274_800_745_9e-1,
        1.519_866_656_361_645_719_66e-2,
        5.475_938_084_995_344_946e-4,
        1.050_750_071_644_416_843_24e-9,
    ],
];
const FAR: Rational = [
    [
        6.657_904_643_501_103_777_2,
        5.463_784_911_164_114_369_9,
        1.784_826_539_917_291_335_8,
        2.965_605_718_285_048_912_3e-1,
        2.653_218_952_657_612_309_3e-2,
        1.242_660_947_388_078_438_6e-3,
        2.711_555_568_743_487_578_15e-5,
        2.010_334_399_292_288_132_65e-7,
    ],
    [
        1.0,
        5.998_322_065_558_879_376_9e-1,
        1.369_298_809_227_358_053_1e-1,
        1.487_536_129_085_061_485_25e-2,
        7.868_691_311_456_132_591e-4,
        1.846_318_317_510_054_681_8e-5,
        1.421_511_758_316_445_888_7e-7,
        2.044_263_103_389_939_785_64e-15,
    ],
];

#[cfg(test)]
mod tests {
    use super::{normal, normal_each};
    use crate::rng::{block, open_unit};

    #[test]
    fn many_are_what_each_is() {
        for count in [0, 1, 7, 8, 9, 1000] {
            let words = (0..count).map(|i| open_unit(block([1, 2], [i, 0, 0, 0])[0]));
            let mut numbers: Vec<f64> = words.chain([0.075, 0.925, 1e-300]).collect();
            let wanted: Vec<u64> = numbers.iter().map(|&p| normal(p).to_bits()).collect();
            normal_each(&mut numbers);
            assert_eq!(numbers.iter().map(|x| x.to_bits()).collect::<Vec<_>>(), wanted);
        }
    }
}
