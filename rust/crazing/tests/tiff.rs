//! Tiles, undone by the definition of their predictors.

use std::io::Read;

use crazing::tiff::{Tiles, compress};
use crazing::{Error, Watch};
use flate2::read::ZlibDecoder;

fn inflated(stream: &[u8]) -> std::io::Result<Vec<u8>> {
    let mut out = Vec::new();
    ZlibDecoder::new(stream).read_to_end(&mut out)?;
    Ok(out)
}

/// Samples from differences along a row, as the text of TIFF 6.0 has it: each added to the one `channels` before.
fn summed(row: &[u8], channels: usize, sample: usize) -> Vec<u8> {
    let mut numbers: Vec<u64> = row
        .chunks_exact(sample)
        .map(|bytes| bytes.iter().rev().fold(0, |number, &byte| (number << 8) | u64::from(byte)))
        .collect();
    for i in channels..numbers.len() {
        numbers[i] = (numbers[i] + numbers[i - channels]) & (u64::MAX >> (64 - 8 * sample));
    }
    numbers.iter().flat_map(|number| number.to_le_bytes()[..sample].to_vec()).collect()
}

fn undone(row: &[u8], channels: usize, sample: usize, float: bool) -> Vec<u8> {
    if !float {
        return summed(row, channels, sample);
    }
    let planes = summed(row, channels, 1);
    let count = row.len() / sample;
    (0..count)
        .flat_map(|i| (0..sample).map(|place| planes[(sample - 1 - place) * count + i]).collect::<Vec<_>>())
        .collect()
}

#[test]
fn tiles_come_back() -> Result<(), Box<dyn std::error::Error>> {
    let (height, width) = (16, 32);
    for (sample, float) in [(1, false), (2, false), (4, false), (2, true), (4, true)] {
        for channels in 1..=3 {
            let row = width * channels * sample;
            let bytes: Vec<u8> = (0..3 * height * row).map(|i| (i * i / 11 + i) as u8).collect();
            let tiles = Tiles { bytes: &bytes, height, width, channels, sample, float };
            let mut found = Vec::new();
            for stream in compress(tiles, Watch::default())? {
                let tile = inflated(&stream)?;
                assert_eq!(tile.len(), height * row);
                found.extend(tile.chunks_exact(row).flat_map(|row| undone(row, channels, sample, float)));
            }
            assert!(found == bytes, "{channels} channels, {sample} bytes, float {float}");
        }
    }
    Ok(())
}

#[test]
fn what_is_no_tile_is_named() {
    let good = Tiles { bytes: &[0; 24], height: 2, width: 3, channels: 1, sample: 2, float: false };
    let refused = |tiles| compress(tiles, Watch::default());
    assert!(refused(good).is_ok());
    assert!(matches!(refused(Tiles { sample: 3, ..good }), Err(Error::BadValue { name: "sample", .. })));
    assert!(matches!(refused(Tiles { width: 5, ..good }), Err(Error::BadLength { .. })));
    assert!(matches!(refused(Tiles { width: 0, ..good }), Err(Error::BadLength { .. })));
    assert_eq!(compress(good, Watch::new(&|| false)), Err(Error::Interrupted));
}
