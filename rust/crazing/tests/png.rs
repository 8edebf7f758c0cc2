//! PNGs read back, and writers that fail.

use std::io::{self, Cursor, Write};

use crazing::png::{Image, encode};
use crazing::{Error, Result, Watch};
use png::Decoder;

fn bytes(image: Image<'_>, text: &[(String, String)]) -> Result<Vec<u8>> {
    let mut out = Vec::new();
    encode(&mut out, image, text, Watch::default())?;
    Ok(out)
}

#[test]
fn every_shape_comes_back() -> std::result::Result<(), Box<dyn std::error::Error>> {
    for channels in 1..=4 {
        for (height, width) in [(1, 1), (3, 70_000), (300, 17)] {
            let pixels: Vec<u8> = (0..height * width * channels).map(|i| (i * i / 7) as u8).collect();
            let file = bytes(Image { pixels: &pixels, height, width, channels }, &[])?;
            let mut reader = Decoder::new(Cursor::new(file)).read_info()?;
            let mut found = vec![0; reader.output_buffer_size().unwrap_or(0)];
            let shape = reader.next_frame(&mut found)?;
            assert_eq!((shape.height as usize, shape.width as usize), (height, width));
            assert!(found == pixels && reader.info().srgb.is_some());
        }
    }
    Ok(())
}

#[test]
fn texts_take_the_chunk_that_holds_them() -> std::result::Result<(), Box<dyn std::error::Error>> {
    let text = [("Title", "Risse im Überzug"), ("Author", "釉")].map(|(a, b)| (a.to_owned(), b.to_owned()));
    let file = bytes(Image { pixels: &[0], height: 1, width: 1, channels: 1 }, &text)?;
    let reader = Decoder::new(Cursor::new(file)).read_info()?;
    let info = reader.info();
    assert_eq!(info.uncompressed_latin1_text[0].text, text[0].1);
    assert_eq!(info.utf8_text[0].get_text()?, text[1].1);
    Ok(())
}

#[test]
fn shapes_that_no_png_has_are_named() {
    let image = Image { pixels: &[0; 10], height: 1, width: 2, channels: 5 };
    assert!(matches!(bytes(image, &[]), Err(Error::BadValue { name: "channels", .. })));
    assert!(matches!(bytes(Image { channels: 3, ..image }, &[]), Err(Error::BadLength { .. })));
    assert!(matches!(bytes(Image { height: 0, ..image }, &[]), Err(Error::BadValue { name: "height", .. })));
    let long = [("k".repeat(80), String::new())];
    let good = Image { pixels: &[0], height: 1, width: 1, channels: 1 };
    assert!(matches!(bytes(good, &long), Err(Error::Write { .. })));
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
    let image = Image { pixels: &pixels, height: 8, width: 8, channels: 1 };
    let size = bytes(image, &[])?.len();
    for room in 0..size {
        let outcome = encode(FullDisk(room), image, &[], Watch::default());
        assert!(matches!(outcome, Err(Error::Write { .. })), "{room} of {size}");
    }
    encode(FullDisk(size), image, &[], Watch::default())
}

#[test]
fn the_watch_stops_the_work() {
    let pixels = vec![0; 4 << 20];
    let image = Image { pixels: &pixels, height: 2048, width: 2048, channels: 1 };
    let outcome = encode(Vec::new(), image, &[], Watch::new(&|| false));
    assert_eq!(outcome, Err(Error::Interrupted));
}
