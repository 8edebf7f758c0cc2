//! Pixels as a PNG: whole, or band by band.

mod rows;

use std::io::Write;

use ::png::{BitDepth, ColorType, Encoder, EncodingError, PixelDimensions, SrgbRenderingIntent, Unit};

use crate::error::{Error, Result};
use crate::watch::Watch;
use crate::{deflate, parallel};
use rows::Rows;

/// Strips that are made side by side before they are written.
const CREW: usize = 32;

/// Bytes of the chunk that ends every PNG.
const END: usize = 12;

/// Pixels, top row first, without gaps.
#[derive(Debug, Clone, Copy)]
pub struct Image<'a> {
    /// `height * width * channels` samples; those of 16 bits as two bytes each, the lower first.
    pub pixels: &'a [u8],
    /// Rows.
    pub height: usize,
    /// Pixels a row.
    pub width: usize,
    /// 1 grey, 2 grey and alpha, 3 RGB, 4 RGBA; alpha is straight.
    pub channels: usize,
    /// Bits a sample, 8 or 16.
    pub depth: usize,
}

/// What a PNG says of its pixels.
#[derive(Debug, Clone, Default)]
pub struct About {
    /// Pairs of keyword and text: a tEXt chunk where Latin-1 holds both, else iTXt.
    pub text: Vec<(String, String)>,
    /// Whether the samples are sRGB colours; else they are numbers.
    pub srgb: bool,
    /// Pixels a metre, across and up; 0 for unknown.
    pub density: [u32; 2],
}

/// The checksum of no pixels.
pub const NOTHING: u32 = 1;

/// Writes `image`.
///
/// # Errors
/// [`Error::BadLength`] or [`Error::BadValue`] for a shape no PNG has, [`Error::Write`] with the reason of the writer
/// or of a keyword that is not 1 to 79 characters of Latin-1, [`Error::Interrupted`].
pub fn encode(mut writer: impl Write, image: Image<'_>, about: &About, watch: Watch<'_>) -> Result<()> {
    rows_of(image)?;
    put(&mut writer, &head(image, about)?)?;
    let adler = bands(&mut writer, image, NOTHING, watch)?;
    put(&mut writer, &tail(adler))
}

/// What stands before the pixels. Only the shape of `image` is looked at.
///
/// # Errors
/// As [`encode`].
pub fn head(image: Image<'_>, about: &About) -> Result<Vec<u8>> {
    checked_row(image)?;
    let mut out = Vec::new();
    // Its writer ends the file when it is dropped.
    drop(encoder(&mut out, image, about)?.write_header().map_err(|error| failed(&error))?);
    out.truncate(out.len() - END);
    out.extend(chunk(&deflate::HEAD));
    Ok(out)
}

/// Writes the next rows and gives the checksum of all so far, from that of the rows before.
///
/// # Errors
/// As [`encode`].
pub fn bands(mut writer: impl Write, image: Image<'_>, before: u32, watch: Watch<'_>) -> Result<u32> {
    let rows = rows_of(image)?;
    let mut adler = before;
    for first in (0..rows.strips()).step_by(CREW) {
        watch.poll()?;
        let crew = CREW.min(rows.strips() - first);
        for strip in parallel::several(crew, |index| rows.strip(first + index)) {
            put(&mut writer, &chunk(&strip.piece))?;
            adler = deflate::joined(adler, strip.adler, strip.len);
        }
    }
    Ok(adler)
}

/// What stands behind the pixels, whose checksum is `adler`.
pub fn tail(adler: u32) -> Vec<u8> {
    let mut out = chunk(&[&deflate::LAST[..], &adler.to_be_bytes()].concat());
    out.extend([0, 0, 0, 0, b'I', b'E', b'N', b'D', 0xAE, 0x42, 0x60, 0x82]);
    out
}

/// An IDAT chunk.
fn chunk(data: &[u8]) -> Vec<u8> {
    let mut out = Vec::with_capacity(data.len() + END);
    out.extend((data.len() as u32).to_be_bytes());
    out.extend(b"IDAT");
    out.extend(data);
    let sum = crc32fast::hash(&out[4..]);
    out.extend(sum.to_be_bytes());
    out
}

fn put(writer: &mut impl Write, bytes: &[u8]) -> Result<()> {
    writer.write_all(bytes).map_err(|error| Error::Write { reason: error.to_string() })
}

/// Bytes a row of a shape that a PNG can have.
fn checked_row(image: Image<'_>) -> Result<usize> {
    for (name, side) in [("height", image.height), ("width", image.width)] {
        if side == 0 || side > i32::MAX as usize {
            let wanted = "a PNG has from 1 to 2147483647 pixels a side";
            return Err(Error::BadValue { name, value: side as f64, wanted });
        }
    }
    color_type(image.channels)?;
    bit_depth(image.depth)?;
    let row = image.width.saturating_mul(image.channels * image.depth / 8);
    // A strip is at least one row, and a chunk holds no more than this.
    let limit = i32::MAX as usize / 2;
    if row > limit {
        return Err(Error::TooMany { what: "bytes a row", found: row, limit });
    }
    Ok(row)
}

/// The rows, all there.
fn rows_of(image: Image<'_>) -> Result<Rows<'_>> {
    let row = checked_row(image)?;
    let (found, wanted) = (image.pixels.len(), row.saturating_mul(image.height));
    if found != wanted {
        return Err(Error::BadLength { array: "pixels", found, wanted });
    }
    let sample = image.depth / 8;
    Ok(Rows { pixels: image.pixels, row, pixel: image.channels * sample, deep: sample == 2 })
}

fn encoder<'a, W: Write>(writer: W, image: Image<'_>, about: &About) -> Result<Encoder<'a, W>> {
    let mut encoder = Encoder::new(writer, image.width as u32, image.height as u32);
    encoder.set_color(color_type(image.channels)?);
    encoder.set_depth(bit_depth(image.depth)?);
    if about.srgb {
        encoder.set_source_srgb(SrgbRenderingIntent::Perceptual);
    }
    if about.density.iter().all(|&density| density > 0) {
        let [xppu, yppu] = about.density;
        encoder.set_pixel_dims(Some(PixelDimensions { xppu, yppu, unit: Unit::Meter }));
    }
    for (keyword, words) in &about.text {
        let (keyword, words) = (keyword.clone(), words.clone());
        let is_latin = keyword.chars().chain(words.chars()).all(|letter| u32::from(letter) < 256);
        let add = if is_latin { Encoder::add_text_chunk } else { Encoder::add_itxt_chunk };
        add(&mut encoder, keyword, words).map_err(|error| failed(&error))?;
    }
    Ok(encoder)
}

fn color_type(channels: usize) -> Result<ColorType> {
    Ok(match channels {
        1 => ColorType::Grayscale,
        2 => ColorType::GrayscaleAlpha,
        3 => ColorType::Rgb,
        4 => ColorType::Rgba,
        _ => {
            let wanted = "a PNG has 1, 2, 3 or 4 channels";
            return Err(Error::BadValue { name: "channels", value: channels as f64, wanted });
        }
    })
}

fn bit_depth(depth: usize) -> Result<BitDepth> {
    match depth {
        8 => Ok(BitDepth::Eight),
        16 => Ok(BitDepth::Sixteen),
        _ => Err(Error::BadValue { name: "depth", value: depth as f64, wanted: "a sample has 8 or 16 bits" }),
    }
}

fn failed(error: &EncodingError) -> Error {
    Error::Write { reason: error.to_string() }
}
