//! Pixels as a PNG, row by row.

use std::io::{self, Write};

use ::png::{BitDepth, ColorType, Compression, Encoder, EncodingError, SrgbRenderingIntent};

use crate::error::{Error, Result};
use crate::watch::Watch;

/// Bytes an IDAT chunk, and between two calls of the writer.
const CHUNK: usize = 1 << 20;

/// Bytes between two questions to the watch: about a millisecond of work.
const STEP: usize = 1 << 20;

/// 8-bit pixels, top row first, without gaps.
#[derive(Debug, Clone, Copy)]
pub struct Image<'a> {
    /// `height * width * channels` bytes.
    pub pixels: &'a [u8],
    /// Rows.
    pub height: usize,
    /// Pixels a row.
    pub width: usize,
    /// 1 grey, 2 grey and alpha, 3 RGB, 4 RGBA; colours are sRGB, alpha is straight.
    pub channels: usize,
}

/// Writes `image` with `text` as pairs of keyword and text: a tEXt chunk where Latin-1 holds both, else iTXt.
///
/// # Errors
/// [`Error::BadLength`] or [`Error::BadValue`] for a shape no PNG has, [`Error::Write`] with the reason of the writer
/// or of a keyword that is not 1 to 79 characters of Latin-1, [`Error::Interrupted`].
pub fn encode(writer: impl Write, image: Image<'_>, text: &[(String, String)], watch: Watch<'_>) -> Result<()> {
    let mut writer = Remembering { writer, failure: None };
    let outcome = stream(&mut writer, image, text, watch);
    match writer.failure {
        Some(reason) => Err(Error::Write { reason }),
        None => outcome,
    }
}

/// A writer that stays failed. The stream writer of png 0.18.1 drops the error of its last chunk.
struct Remembering<W> {
    writer: W,
    failure: Option<String>,
}

impl<W: Write> Write for Remembering<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if self.failure.is_some() {
            return Err(io::ErrorKind::BrokenPipe.into());
        }
        let outcome = self.writer.write(bytes);
        if let Err(error) = &outcome
            && error.kind() != io::ErrorKind::Interrupted
        {
            self.failure = Some(error.to_string());
        }
        outcome
    }

    fn flush(&mut self) -> io::Result<()> {
        self.writer.flush()
    }
}

fn stream(writer: impl Write, image: Image<'_>, text: &[(String, String)], watch: Watch<'_>) -> Result<()> {
    let row = row_bytes(image)?;
    let mut writer = encoder(writer, image, text)?.write_header().map_err(failed)?;
    let mut stream = writer.stream_writer_with_size(CHUNK).map_err(failed)?;
    for rows in image.pixels.chunks(row * (STEP / row).max(1)) {
        watch.poll()?;
        stream.write_all(rows).map_err(failed)?;
    }
    stream.finish().map_err(failed)?;
    writer.finish().map_err(failed)
}

/// Bytes a row of a shape that was checked.
fn row_bytes(image: Image<'_>) -> Result<usize> {
    for (name, side) in [("height", image.height), ("width", image.width)] {
        if side == 0 || side > i32::MAX as usize {
            let wanted = "a PNG has from 1 to 2147483647 pixels a side";
            return Err(Error::BadValue { name, value: side as f64, wanted });
        }
    }
    let row = image.width.saturating_mul(image.channels);
    let (found, wanted) = (image.pixels.len(), row.saturating_mul(image.height));
    if found == wanted { Ok(row) } else { Err(Error::BadLength { array: "pixels", found, wanted }) }
}

fn encoder<W: Write>(writer: W, image: Image<'_>, text: &[(String, String)]) -> Result<Encoder<'static, W>> {
    let mut encoder = Encoder::new(writer, image.width as u32, image.height as u32);
    encoder.set_color(color_type(image.channels)?);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_compression(Compression::Fastest);
    encoder.set_source_srgb(SrgbRenderingIntent::Perceptual);
    for (keyword, words) in text {
        let (keyword, words) = (keyword.clone(), words.clone());
        let is_latin = keyword.chars().chain(words.chars()).all(|letter| u32::from(letter) < 256);
        let add = if is_latin { Encoder::add_text_chunk } else { Encoder::add_itxt_chunk };
        add(&mut encoder, keyword, words).map_err(failed)?;
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

fn failed(error: impl Into<EncodingError>) -> Error {
    Error::Write { reason: error.into().to_string() }
}
