//! Tiles, undone by the definition of their predictors.

use std::io::Read;

use crazing::tiff::{Band, compress};
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
    let (height, wide) = (16, 32);
    for (sample, float) in [(1, false), (2, false), (4, false), (2, true), (4, true)] {
        for (channels, rows, width) in [(1, 16, 96), (2, 16, 64), (3, 16, 33), (3, 5, 31), (1, 1, 1)] {
            let bytes: Vec<u8> = (0..rows * width * channels * sample).map(|i| (i * i / 11 + i) as u8).collect();
            let band = Band { bytes: &bytes, width, channels, sample, float, tile: [height, wide] };
            let mut file = Vec::new();
            let sizes = compress(&mut file, band, Watch::default())?;
            assert_eq!(sizes.len(), width.div_ceil(wide));
            assert_eq!(sizes.iter().sum::<usize>(), file.len());
            let pixel = channels * sample;
            let mut rest = &file[..];
            for (nth, size) in sizes.into_iter().enumerate() {
                let stream;
                (stream, rest) = rest.split_at(size);
                let tile = inflated(stream)?;
                assert_eq!(tile.len(), height * wide * pixel);
                for (y, row) in tile.chunks_exact(wide * pixel).enumerate() {
                    let row = undone(row, channels, sample, float);
                    for (x, found) in row.chunks_exact(pixel).enumerate() {
                        // Beyond the edges the last pixel goes on.
                        let at = y.min(rows - 1) * width + (nth * wide + x).min(width - 1);
                        assert_eq!(found, &bytes[at * pixel..][..pixel], "{band:?} at {x}, {y}");
                    }
                }
            }
        }
    }
    Ok(())
}

#[test]
fn what_are_no_rows_is_named() {
    let good = Band { bytes: &[0; 24], width: 6, channels: 1, sample: 2, float: false, tile: [2, 4] };
    let refused = |band| compress(Vec::new(), band, Watch::default());
    assert!(refused(good).is_ok());
    assert!(matches!(refused(Band { sample: 3, ..good }), Err(Error::BadValue { name: "sample", .. })));
    assert!(matches!(refused(Band { width: 5, ..good }), Err(Error::BadLength { .. })));
    assert!(matches!(refused(Band { width: 0, ..good }), Err(Error::BadLength { .. })));
    assert!(matches!(refused(Band { tile: [1, 4], ..good }), Err(Error::BadLength { .. })));
    assert!(matches!(refused(Band { tile: [2, 0], ..good }), Err(Error::BadLength { .. })));
    assert_eq!(compress(Vec::new(), good, Watch::new(&|| false)), Err(Error::Interrupted));
}
