//! Philox against the known answers of its authors, and the stream against the blocks it is made of.

use crazing::rng::{Rng, block, open_unit, stream};
use proptest::prelude::*;

const MAX: u64 = u64::MAX;

/// Random123 1.14, `kat_vectors`, philox4x64 with 10 rounds; NumPy's Philox gives the same.
#[test]
fn known_answers_of_random123() {
    let zeros = [0x16554d9eca36314c, 0xdb20fe9d672d0fdc, 0xd7e772cee186176b, 0x7e68b68aec7ba23b];
    let ones = [0x87b092c3013fe90b, 0x438c3c67be8d0224, 0x9cc7d7c69cd777b6, 0xa09caebf594f0ba0];
    let pi = [0xa528f45403e61d95, 0x38c72dbd566e9788, 0xa5a1610e72fd18b5, 0x57bd43b5e52b7fe6];
    let counter = [0x243f6a8885a308d3, 0x13198a2e03707344, 0xa4093822299f31d0, 0x082efa98ec4e6c89];
    assert_eq!(block([0; 2], [0; 4]), zeros);
    assert_eq!(block([MAX; 2], [MAX; 4]), ones);
    assert_eq!(block([0x452821e638d01377, 0xbe5466cf34e90c6c], counter), pi);
}

#[test]
fn words_are_the_blocks_in_turn() {
    let key = [5, 6];
    let mut rng = Rng::new(key, stream::MAZE);
    let words: Vec<u64> = (0..8).map(|_| rng.next_u64()).collect();
    let blocks = [block(key, [0, 0, stream::MAZE, 0]), block(key, [1, 0, stream::MAZE, 0])];
    assert_eq!(words, blocks.concat());
}

#[test]
fn an_item_has_words_of_its_own() {
    let mut rng = Rng::of_item([5, 6], stream::POISSON_DISK, 7);
    let words: Vec<u64> = (0..8).map(|_| rng.next_u64()).collect();
    assert_eq!(words, [0, 1].map(|i| block([5, 6], [i, 7, stream::POISSON_DISK, 0])).concat());
}

#[test]
fn halves_are_the_lower_then_the_upper() {
    let (mut halves, mut words) = (Rng::new([1, 2], 3), Rng::new([1, 2], 3));
    for _ in 0..9 {
        let (low, high) = (halves.next_u32(), halves.next_u32());
        assert_eq!(u64::from(low) | u64::from(high) << 32, words.next_u64());
    }
}

#[test]
fn a_word_never_holds_a_half_given_before() {
    let (mut mixed, mut words) = (Rng::new([1, 2], 3), Rng::new([1, 2], 3));
    let expected: Vec<u64> = (0..6).map(|_| words.next_u64()).collect();
    assert_eq!(mixed.next_u32(), expected[0] as u32);
    assert_eq!(mixed.next_u64(), expected[1]);
    mixed.next_u64();
    assert_eq!(mixed.next_u32(), expected[3] as u32);
    assert_eq!(mixed.next_u64(), expected[4]);
}

#[test]
fn streams_and_keys_differ() {
    let first = |key, purpose| Rng::new(key, purpose).next_u64();
    let words = [first([0, 0], 0), first([0, 0], 1), first([1, 0], 0), first([0, 1], 0)];
    for (i, word) in words.iter().enumerate() {
        assert!(!words[..i].contains(word));
    }
}

#[test]
fn purposes_have_streams_of_their_own() {
    use stream::*;
    let mut numbers = [SAMPLE, POISSON_DISK, DENSITY, MAZE, OPENING, SOURCE, WIDTH, ROUGHNESS];
    numbers.sort_unstable();
    assert!(numbers.windows(2).all(|pair| pair[0] < pair[1]));
}

#[test]
fn ends_of_the_unit_intervals() {
    assert!(open_unit(0) > 0.0);
    assert!(open_unit(MAX) < 1.0);
    assert_eq!(open_unit(0) + open_unit(MAX), 1.0);
    assert_eq!(1.0 - open_unit(0), open_unit(MAX));
    for word in (0..1000).flat_map(|i| block([7, 8], [i, 0, 0, 0])).chain([0, 1, 1 << 12, MAX]) {
        assert_eq!(open_unit(word), ((word >> 12) as f64 + 0.5) / (1_u64 << 52) as f64);
    }
}

/// Chi-squared over 3 and over 100 classes; the bound is the 99.9 % quantile.
#[test]
fn below_is_even() {
    for (n, bound) in [(3_u32, 13.82), (100, 148.23)] {
        let mut rng = Rng::new([7, 7], 0);
        let draws = 100_000;
        let mut counts = vec![0_u32; n as usize];
        for _ in 0..draws {
            counts[rng.below(n) as usize] += 1;
        }
        let expected = f64::from(draws) / f64::from(n);
        let chi: f64 = counts.iter().map(|&c| (f64::from(c) - expected).powi(2) / expected).sum();
        assert!(chi < bound, "chi-squared {chi} over {n} classes");
    }
}

#[test]
fn below_zero_and_one_are_zero() {
    let mut rng = Rng::new([0, 0], 0);
    assert_eq!((rng.below(0), rng.below(1)), (0, 0));
}

/// Half of all 32-bit values are surplus for n = 2^31 + 1: without drawing again, the lower half would come twice as often.
#[test]
fn below_draws_again() {
    let n = (1 << 31) + 1;
    let mut rng = Rng::new([3, 1], 4);
    let low = (0..20_000).filter(|_| rng.below(n) < n / 2).count();
    assert!((9_600..10_400).contains(&low), "{low} of 20000 in the lower half");
}

proptest! {
    #[test]
    fn numbers_stay_in_range(key: [u64; 2], purpose: u64, n in 1_u32..) {
        let mut rng = Rng::new(key, purpose);
        prop_assert!(rng.below(n) < n);
        prop_assert!((0.0..1.0).contains(&rng.unit()));
    }
}
