//! PNGs read back, and writers that fail.

use std::io::{self, Cursor, Write};

use crazing::png::{About, Image, NOTHING, bands, encode, head, tail};
use crazing::{Error, Result, Watch};
use png::Decoder;

type Tested<T = ()> = std::result::Result<T, Box<dyn std::error::Error>>;

fn bytes(image: Image<'_>, about: &About) -> Result<Vec<u8>> {
    let mut out = Vec::new();
    encode(&mut out, image, about, Watch::default())?;
    Ok(out)
}

fn about(text: &[(&str, &str)]) -> About {
    let text = text.iter().map(|&(a, b)| (a.to_owned(), b.to_owned())).collect();
    About { text, srgb: true, density: [0, 0] }
}

/// Samples with runs, slopes and noise, and how a decoder gives them: those of 16 bits with the higher byte first.
fn samples(count: usize, depth: usize) -> (Vec<u8>, Vec<u8>) {
    let given: Vec<u8> =
        (0..count * depth / 8).map(|i| if i % 5000 < 3000 { (i / 700) as u8 } else { (i * i / 7) as u8 }).collect();
    let mut wanted = given.clone();
    if depth == 16 {
        wanted.chunks_exact_mut(2).for_each(<[u8]>::reverse);
    }
    (given, wanted)
}

fn decoded(file: Vec<u8>) -> Tested<(Vec<u8>, (usize, usize))> {
    let mut reader = Decoder::new(Cursor::new(file)).read_info()?;
    let mut found = vec![0; reader.output_buffer_size().unwrap_or(0)];
    let shape = reader.next_frame(&mut found)?;
    Ok((found, (shape.height as usize, shape.width as usize)))
}

#[test]
fn every_shape_comes_back() -> Tested {
    for (channels, depth) in (1..=4).flat_map(|channels| [(channels, 8), (channels, 16)]) {
        for (height, width) in [(1, 1), (3, 70_000), (700, 317)] {
            let (given, wanted) = samples(height * width * channels, depth);
            let file = bytes(Image { pixels: &given, height, width, channels, depth }, &about(&[]))?;
            let (found, shape) = decoded(file)?;
            assert_eq!(shape, (height, width));
            assert!(found == wanted, "{channels} channels of {depth} bits, {height} x {width}");
        }
    }
    Ok(())
}

#[test]
fn bands_make_the_same_pixels_as_the_whole() -> Tested {
    let (height, width, channels, depth) = (600, 500, 3, 16);
    let (given, wanted) = samples(height * width * channels, depth);
    let row = width * channels * depth / 8;
    for band in [1, 7, 64, 600] {
        let whole = Image { pixels: &[], height, width, channels, depth };
        let mut file = head(whole, &About::default())?;
        let mut adler = NOTHING;
        for rows in given.chunks(band * row) {
            let image = Image { pixels: rows, height: rows.len() / row, ..whole };
            adler = bands(&mut file, image, adler, Watch::default())?;
        }
        file.extend(tail(adler));
        assert!(decoded(file)?.0 == wanted, "bands of {band} rows");
    }
    Ok(())
}

#[test]
fn what_is_said_of_the_pixels_comes_back() -> Tested {
    let one = Image { pixels: &[0], height: 1, width: 1, channels: 1, depth: 8 };
    let text = [("Title", "Risse im Überzug"), ("Author", "釉")];
    let file = bytes(one, &About { density: [4000, 3000], ..about(&text) })?;
    let reader = Decoder::new(Cursor::new(file)).read_info()?;
    let info = reader.info();
    assert_eq!(info.uncompressed_latin1_text[0].text, text[0].1);
    assert_eq!(info.utf8_text[0].get_text()?, text[1].1);
    assert_eq!(info.pixel_dims.map(|dims| (dims.xppu, dims.yppu)), Some((4000, 3000)));
    assert!(info.srgb.is_some());
    let plain = Decoder::new(Cursor::new(bytes(one, &About::default())?)).read_info()?;
    assert!(plain.info().srgb.is_none() && plain.info().pixel_dims.is_none());
    Ok(())
}

#[test]
fn shapes_that_no_png_has_are_named() {
    let image = Image { pixels: &[0; 10], height: 1, width: 2, channels: 5, depth: 8 };
    let refused = |image| bytes(image, &About::default());
    assert!(matches!(refused(image), Err(Error::BadValue { name: "channels", .. })));
    assert!(matches!(refused(Image { channels: 3, ..image }), Err(Error::BadLength { .. })));
    assert!(matches!(refused(Image { height: 0, ..image }), Err(Error::BadValue { name: "height", .. })));
    assert!(matches!(refused(Image { channels: 3, depth: 4, ..image }), Err(Error::BadValue { name: "depth", .. })));
    let vast = Image { width: i32::MAX as usize, channels: 4, ..image };
    assert!(matches!(refused(vast), Err(Error::TooMany { .. })));
    let good = Image { pixels: &[0], height: 1, width: 1, channels: 1, depth: 8 };
    assert!(matches!(bytes(good, &about(&[(&"k".repeat(80), "")])), Err(Error::Write { .. })));
}

/// Takes some bytes, then no more.
struct FullDisk(usize);

impl Write for FullDisk {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0 = self.0.checked_sub(bytes.len()).ok_or_else(|| io::Error::other("disk full"))?;
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[test]
fn a_full_disk_is_an_error_at_every_byte() -> Result<()> {
    let pixels = [9; 64];
    let image = Image { pixels: &pixels, height: 8, width: 8, channels: 1, depth: 8 };
    let size = bytes(image, &About::default())?.len();
    for room in 0..size {
        let outcome = encode(FullDisk(room), image, &About::default(), Watch::default());
        assert!(matches!(outcome, Err(Error::Write { .. })), "{room} of {size}");
    }
    encode(FullDisk(size), image, &About::default(), Watch::default())
}

#[test]
fn the_watch_stops_the_work() {
    let pixels = vec![0; 4 << 20];
    let image = Image { pixels: &pixels, height: 2048, width: 2048, channels: 1, depth: 8 };
    let outcome = encode(Vec::new(), image, &About::default(), Watch::new(&|| false));
    assert_eq!(outcome, Err(Error::Interrupted));
}
