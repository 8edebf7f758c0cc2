//! Tapered edges as pixels; the only place that names tiny-skia.
//!
//! Every edge is the convex hull of two discs. A picture is cut into square tiles of one fixed size; the outlines
//! that meet a tile are clipped to it in `f64` and filled, all wound the same way, by the non-zero rule: a union,
//! so joints neither blend twice nor leave seams. tiny-skia fills a mask of 8 x 8 yes-or-no samples a pixel. Its own
//! anti-aliasing takes 4 x 4, costs more, and ends the process when it meets a coordinate it cannot hold.

mod blend;
mod clip;
mod frame;
mod spans;
mod taper;
mod tile;

pub use blend::Colors;
pub use frame::Frame;

use crate::crew;
use crate::error::{Error, Result};
use crate::graph::{Point, check_indices};
use crate::watch::Watch;
use spans::{Span, Spans};
use taper::Taper;
use tile::{TILE, Tile};

/// Pixels and edges below which starting a thread costs more than it saves.
const SMALL: (usize, usize) = (1 << 17, 1 << 9);

/// Edges with a width at both ends, borrowed from whoever owns them.
#[derive(Debug, Clone, Copy)]
pub struct Edges<'a> {
    /// Positions in data units; only those that an edge names need be finite.
    pub vertices: &'a [Point],
    /// Two rows of `vertices` an edge.
    pub edges: &'a [[i32; 2]],
    /// Full width at the two ends of every edge, data units.
    pub widths: &'a [[f64; 2]],
}

/// How edges become pixels.
#[derive(Debug, Clone, Copy)]
pub struct Style {
    /// Ink over ground.
    pub colors: Colors,
    /// No end is drawn thinner than this, in pixels. At 0, edges without any width are left out, and others are
    /// at least 1/8 pixel wide: faint but unbroken.
    pub min_width: f64,
}

/// Draws `edges` into `out`: straight RGBA, 4 bytes a pixel, top row first, y up in the data.
///
/// Every byte of `out` is written. The picture is the same for every number of `threads` (0 = all cores).
///
/// # Errors
/// [`Error::BadIndex`], [`Error::BadLength`], [`Error::BadEntry`] or [`Error::BadValue`] for arrays, widths, bounds
/// or sizes that cannot be drawn; [`Error::Interrupted`], with `out` in part written.
pub fn render(
    edges: Edges<'_>,
    frame: &Frame,
    style: &Style,
    threads: usize,
    watch: Watch<'_>,
    out: &mut [u8],
) -> Result<()> {
    let mapping = frame.mapping(out.len())?;
    if !style.min_width.is_finite() || style.min_width < 0.0 {
        let wanted = "a finite number of pixels, at least 0, is wanted";
        return Err(Error::BadValue { name: "min_width", value: style.min_width, wanted });
    }
    check_indices("edges", edges.edges, 0, edges.vertices.len())?;
    let tapers = taper::tapers(edges, &mapping, style.min_width, watch)?;
    let rows = Spans::new(tapers.iter().enumerate().filter_map(|(id, taper)| row_span(id, taper, frame)));
    let table = style.colors.table();
    let scene = Scene { tapers: &tapers, rows: &rows, width: frame.width, table: &table };
    let small = frame.height * frame.width <= SMALL.0 && tapers.len() <= SMALL.1;
    let threads = if small { 1 } else { crew::size(threads, frame.height.div_ceil(TILE)) };
    let bands = out.chunks_mut(TILE * frame.width * 4).enumerate();
    crew::share(bands, threads, watch, Tile::new, |tile, (row, pixels), poll| scene.band(row, pixels, tile, poll))
}

/// What every thread reads.
struct Scene<'a> {
    tapers: &'a [Taper],
    /// The rows of tiles that each taper meets.
    rows: &'a Spans,
    width: usize,
    table: &'a blend::Table,
}

impl Scene<'_> {
    /// Draws one row of tiles into its rows of pixels.
    fn band(&self, row: usize, pixels: &mut [u8], tile: &mut Tile, poll: &dyn Fn() -> Result<()>) -> Result<()> {
        let top = (row * TILE) as f64;
        let columns = Spans::new(self.rows.meeting(row).filter_map(|id| {
            let [low, high] = self.tapers[id].extent_between(top, top + TILE as f64);
            Span::of_pixels(id, low, high, self.width)
        }));
        for column in 0..self.width.div_ceil(TILE) {
            poll()?;
            tile.open([(column * TILE) as f64, top]);
            for id in columns.meeting(column) {
                tile.add(&self.tapers[id], poll)?;
            }
            tile.close(pixels, self.width, column * TILE, self.table);
        }
        Ok(())
    }
}

fn row_span(id: usize, taper: &Taper, frame: &Frame) -> Option<Span> {
    let [low, high] = taper.extent(1);
    Span::of_pixels(id, low, high, frame.height)
}
