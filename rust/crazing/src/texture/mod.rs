//! Textures: aligned maps of a crack pattern, every pixel from the geometry of the edges nearest to it.
//!
//! All places are whole parts of a pixel (`grid`), edges are cut into short pieces (`piece`), and the nearest piece of
//! every pixel is found by a search that cannot change the answer (`nearest`); its plate by a scan of rows (`scan`). A
//! pixel's values depend on nothing but exact differences of places, its nearest piece and its plate. So they are the
//! same in every window, for every tile and number of threads, on every processor, and move with the pattern by whole
//! pixels without a trace.

mod around;
mod bands;
mod beneath;
mod bins;
mod border;
mod coverage;
mod cut;
mod dust;
mod extent;
mod faces;
mod fans;
mod finish;
mod grid;
mod halves;
mod labels;
mod lanes;
mod line;
mod look;
mod maps;
mod material;
mod near;
mod nearest;
mod noise;
mod page;
mod piece;
mod plates;
mod profile;
mod ray;
mod rays;
mod relief;
mod scan;
mod scene;
mod slabs;
mod squares;
mod ties;
mod tilt;
mod walks;

pub use extent::{Extent, extent};
pub use faces::{Plates, plates};
pub use grid::{View, Window};
pub use maps::Maps;
pub use material::{Material, Rgb};
pub use plates::Sides;

use crate::crew;
use crate::error::{Error, Result};
use crate::graph::{Point, check_indices};
use crate::rng::Key;
use crate::watch::Watch;
use page::Hand;
use scene::{Asked, Scene};

/// Rows of a band, which one thread works on at a time.
const BAND: usize = 64;

/// A crack pattern, borrowed from whoever owns it.
#[derive(Debug, Clone, Copy)]
pub struct Pattern<'a> {
    /// Positions in data units; only those that an edge names need be finite.
    pub vertices: &'a [Point],
    /// Two rows of `vertices` an edge.
    pub edges: &'a [[i32; 2]],
    /// Periods from the second vertex of each edge to its second end; may be empty without a period.
    pub shifts: &'a [[i8; 2]],
    /// Full width at the two ends of every edge, data units.
    pub widths: &'a [[f64; 2]],
    /// The strand of every edge.
    pub strand: &'a [i32],
    /// The generation of every edge.
    pub generation: &'a [i32],
}

impl Pattern<'_> {
    fn check(&self) -> Result<()> {
        let wanted = self.edges.len();
        let length =
            |array, found| if found == wanted { Ok(()) } else { Err(Error::BadLength { array, found, wanted }) };
        length("widths", self.widths.len())?;
        length("strand", self.strand.len())?;
        length("generation", self.generation.len())?;
        if !self.shifts.is_empty() {
            length("shifts", self.shifts.len())?;
        }
        check_indices("edges", self.edges, 0, self.vertices.len())
    }
}

/// Writes the wanted maps of a window of a texture.
///
/// # Errors
/// [`Error::BadIndex`], [`Error::BadLength`], [`Error::BadEntry`] or [`Error::BadValue`] for arrays, widths, bounds,
/// periods or materials that cannot be drawn; [`Error::OutOfMemory`]; [`Error::Interrupted`], with the maps in part
/// written.
#[allow(clippy::too_many_arguments, reason = "each is a part of the question")]
pub fn texture(
    pattern: Pattern<'_>,
    sides: Sides<'_>,
    view: &View,
    window: Window,
    material: &Material,
    key: Key,
    threads: usize,
    watch: Watch<'_>,
    maps: Maps<'_>,
) -> Result<()> {
    pattern.check()?;
    sides.check(pattern.edges.len())?;
    material.check()?;
    let grid = view.grid()?;
    let pixels = window.height.checked_mul(window.width).filter(|&pixels| pixels > 0);
    let pixels =
        pixels.ok_or(Error::BadValue { name: "pixels", value: 0.0, wanted: "a window with pixels is wanted" })?;
    maps.check(pixels)?;
    let threads = if pixels <= 1 << 14 { 1 } else { crew::size(threads, window.height.div_ceil(BAND)) };
    let scene = Scene::new(Asked { pattern, sides, grid, window, key }, material, &maps, threads, watch)?;
    let bands = maps.bands(window.width, window.height, BAND).into_iter().enumerate();
    let state = || Ok(Hand::new());
    crew::share(bands, threads, watch, state, |hand, (band, maps), poll| scene.band(band, maps, hand, poll))
}
