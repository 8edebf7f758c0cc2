//! The maps that are wanted, and their rows.

use crate::error::{Error, Result};

macro_rules! maps {
    ($($(#[$doc:meta])* $name:ident: $kind:ty, $channels:literal;)*) => {
        /// Where the maps are to be written: rows of a window, top first, channels together.
        #[derive(Debug, Default)]
        pub struct Maps<'a> {
            $($(#[$doc])* pub $name: Option<&'a mut [$kind]>,)*
        }

        impl<'a> Maps<'a> {
            /// Refuses a map of another size.
            pub(super) fn check(&self, pixels: usize) -> Result<()> {
                $(if let Some(found) = self.$name.as_ref().map(|map| map.len()) {
                    let wanted = pixels.saturating_mul($channels);
                    if found != wanted {
                        return Err(Error::BadLength { array: stringify!($name), found, wanted });
                    }
                })*
                Ok(())
            }

            /// Bands of some rows of `width` pixels each; the last may be lower.
            pub(super) fn bands(self, width: usize, height: usize, rows: usize) -> Vec<Self> {
                let mut bands: Vec<Self> = (0..height.div_ceil(rows)).map(|_| Self::default()).collect();
                $(if let Some(map) = self.$name {
                    for (band, part) in bands.iter_mut().zip(map.chunks_mut(rows * width * $channels)) {
                        band.$name = Some(part);
                    }
                })*
                bands
            }

            /// Copies a row of some pixels, of which the first is the one numbered `start`.
            pub(super) fn put(&mut self, start: usize, width: usize, line: &Line) {
                $(if let Some(map) = &mut self.$name {
                    map[start * $channels..(start + width) * $channels].copy_from_slice(&line.$name[..width * $channels]);
                })*
            }
        }

        /// A row of every wanted map on its way to memory.
        #[derive(Debug, Default)]
        pub(super) struct Line {
            $($name: Vec<$kind>,)*
        }

        impl Line {
            /// As long as the rows of the wanted maps are to be.
            pub(super) fn resize(&mut self, wanted: &Maps<'_>, width: usize) {
                $(if wanted.$name.is_some() {
                    self.$name.resize(width * $channels, Default::default());
                })*
            }

            /// The row as maps that are one row high.
            pub(super) fn maps(&mut self) -> Maps<'_> {
                Maps { $($name: Some(&mut self.$name[..]).filter(|map| !map.is_empty()),)* }
            }
        }
    };
}

maps! {
    /// Coverage by the crack, 0 to 255.
    mask: u8, 1;
    /// sRGB.
    color: u8, 3;
    /// 0 to 1.
    height: f32, 1;
    /// Unit vectors: right, up, out.
    normal: f32, 3;
    /// 1 where nothing hides the sky.
    ao: f32, 1;
    /// 0 is a mirror.
    roughness: f32, 1;
    /// How worn the edges of plates are, 0 to 1.
    wear: f32, 1;
    /// Signed distance to the nearest crack edge, data units.
    distance: f32, 1;
    /// Unit vectors along the nearest crack: right, up.
    direction: f32, 2;
    /// The plate: the face between middle lines in which the pixel's middle lies.
    cell: i32, 1;
    /// The strand of the nearest edge; -1 off the crack.
    strand: i32, 1;
    /// Its generation; -1 off the crack.
    generation: i32, 1;
}
