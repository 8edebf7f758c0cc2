//! Streams read back by an independent decoder; the decoder of the png crate checks the rest.

use crazing::deflate::{HEAD, LAST, adler, joined, piece, zlib};
use flate2::read::ZlibDecoder;
use proptest::prelude::*;
use std::io::Read;

fn inflated(stream: &[u8]) -> std::io::Result<Vec<u8>> {
    let mut out = Vec::new();
    ZlibDecoder::new(stream).read_to_end(&mut out)?;
    Ok(out)
}

/// Runs of zeros of every length, bytes of every rarity, noise.
fn data() -> impl Strategy<Value = Vec<u8>> {
    let run = (0_usize..2000).prop_map(|len| vec![0; len]);
    let small = prop::collection::vec(0_u8..4, 0..600);
    let noise = prop::collection::vec(any::<u8>(), 0..600);
    // Counts that double from byte to byte ask for codes longer than any allowed.
    let steep = (1_u32..15).prop_map(|top| (0..top).flat_map(|i| vec![i as u8; 1 << i]).collect());
    prop::collection::vec(prop_oneof![run, small, noise, steep], 0..8).prop_map(|parts| parts.concat())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(128))]

    #[test]
    fn a_stream_comes_back(data in data()) {
        prop_assert_eq!(inflated(&zlib(&data))?, data);
    }

    #[test]
    fn joined_pieces_are_a_stream(first in data(), second in data()) {
        let sum = joined(adler(&first), adler(&second), second.len());
        let both = [first.clone(), second.clone()].concat();
        prop_assert_eq!(sum, adler(&both));
        let stream = [&HEAD[..], &piece(&first), &piece(&second), &LAST, &sum.to_be_bytes()].concat();
        prop_assert_eq!(inflated(&stream)?, both);
    }
}

#[test]
fn runs_of_every_length_come_back() -> std::io::Result<()> {
    for len in (0..1200).chain([65_535, 65_536, 300_000]) {
        let data = [vec![7; 3], vec![0; len], vec![9]].concat();
        assert!(inflated(&zlib(&data))? == data, "{len} zeros");
    }
    Ok(())
}

#[test]
fn noise_grows_by_less_than_a_thousandth() {
    let mut state = 1_u32;
    let noise: Vec<u8> = std::iter::repeat_with(|| {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 24) as u8
    })
    .take(1 << 18)
    .collect();
    assert!(zlib(&noise).len() < noise.len() + noise.len() / 1000);
}
