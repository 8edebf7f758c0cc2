//! Textures: aligned maps of a crack pattern, every pixel from the geometry of the edges nearest to it.
//!
//! All places are whole parts of a pixel (`grid`), edges are cut into short pieces (`piece`), and the nearest piece of
//! every pixel is found by a search that cannot change the answer (`nearest`). A pixel's values depend on nothing but
//! exact differences of places and on its nearest piece. So they are the same in every window, for every tile and
//! number of threads, on every processor, and move with the pattern by whole pixels without a trace.

mod around;
mod bands;
mod bins;
mod coverage;
mod faces;
mod fans;
mod finish;
mod grid;
mod look;
mod maps;
mod material;
mod nearest;
mod noise;
mod piece;
mod plates;
mod profile;
mod rays;

use std::sync::OnceLock;

pub use faces::{Plates, plates};
pub use grid::{View, Window};
pub use maps::Maps;
pub use material::{Material, Rgb};
pub use plates::Sides;

use crate::crew::{self, Poll};
use crate::error::{Error, Result};
use crate::graph::{Point, check_indices};
use crate::rng::Key;
use crate::watch::Watch;
use around::{LEVELS, around};
use bands::Bands;
use fans::Fans;
use finish::{Part, Rows};
use grid::{Grid, UNIT};
use look::Look;
use nearest::{Found, PAGE, Search, Set};
use noise::{Ground, Noise};
use plates::Plate;
use profile::Profile;

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

/// What every thread reads.
struct Scene<'a> {
    pattern: Pattern<'a>,
    sides: Sides<'a>,
    grid: Grid,
    window: Window,
    near: Set,
    /// What covers the mask, where it is wanted.
    bands: Option<Bands>,
    /// Ever more of what lies around, made when what lies nearer is not enough.
    far: [OnceLock<Result<Set>>; LEVELS],
    profile: Profile,
    look: Look,
    plates: Vec<Plate>,
    /// Where there is more than one plate.
    fans: Option<Fans>,
    grain: Vec<Noise>,
    mottle: Vec<Noise>,
    chip: Vec<Noise>,
    chip_depth: f32,
    grain_height: f32,
    level: f32,
    tilt: f32,
    curl_spread: f32,
    /// Data units a pixel.
    data: f32,
    wants_spots: bool,
    /// Whether plates are level and alike.
    plain: bool,
    wants_profile: bool,
    wants_look: bool,
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
    let scene = Scene::new(pattern, sides, grid, window, material, key, &maps, watch)?;
    let threads = if pixels <= 1 << 14 { 1 } else { crew::size(threads, window.height.div_ceil(BAND)) };
    let bands = maps.bands(window.width, window.height, BAND).into_iter().enumerate();
    let state = || Ok(Hand { search: Search::new(), rows: Rows::new(), mask: Vec::new() });
    crew::share(bands, threads, watch, state, |hand, (band, maps), poll| scene.band(band, maps, hand, poll))
}

/// The buffers of one thread.
struct Hand {
    search: Search,
    rows: Rows,
    mask: Vec<u8>,
}

impl<'a> Scene<'a> {
    #[allow(clippy::too_many_arguments, reason = "called from one place")]
    fn new(
        pattern: Pattern<'a>,
        sides: Sides<'a>,
        grid: Grid,
        window: Window,
        material: &Material,
        key: Key,
        maps: &Maps<'_>,
        watch: Watch<'_>,
    ) -> Result<Self> {
        let scale = grid.scale;
        let wants_profile = maps.height.is_some() || maps.normal.is_some() || maps.ao.is_some();
        let wants_look = maps.color.is_some() || maps.roughness.is_some() || maps.wear.is_some();
        let wants_labels =
            maps.cell.is_some() || maps.strand.is_some() || maps.generation.is_some() || maps.direction.is_some();
        let ground = Ground { key, period: grid.period, pin: pin(&pattern, &grid)? };
        let octaves = |on: bool, kind: u64, pitch: f32, count: u64| {
            if on { noise::octaves(ground, kind, f64::from(pitch) * scale, count) } else { Vec::new() }
        };
        let wants_grain = (wants_profile && material.grain != 0.0)
            || (wants_look && (material.speckle != 0.0 || material.roughness_spread != 0.0));
        let wants_nearest = wants_profile || wants_look || wants_labels || maps.distance.is_some();
        let near = around(&pattern, &grid, window, (0, wants_nearest), watch)?;
        let bands = (wants_look || maps.mask.is_some()).then(|| {
            let Window { top, left, height, width } = window;
            Bands::new(&near.pieces, left, width, top, BAND, height.div_ceil(BAND))
        });
        let bands = bands.transpose()?;
        let plates = plates::plates(sides.reaches.len(), sides.reaches, key);
        Ok(Self {
            pattern,
            sides,
            grid,
            window,
            near,
            bands,
            far: Default::default(),
            profile: Profile::new(material, scale),
            look: Look::new(material, scale),
            plates,
            fans: (sides.reaches.len() > 1).then(|| Fans::new(&pattern, &grid)).transpose()?,
            grain: octaves(wants_grain, 0, material.grain_size, 2),
            mottle: octaves(wants_look, 1, material.mottle_size, 3),
            chip: octaves(material.chip > 0.0 && (wants_profile || wants_look), 2, material.chip_size, 2),
            chip_depth: (f64::from(material.chip) * scale) as f32,
            grain_height: material.grain,
            level: material.level,
            tilt: material.tilt,
            curl_spread: material.curl_spread,
            data: (1.0 / scale) as f32,
            plain: [material.grain, material.level, material.tilt, material.curl * material.curl_spread] == [0.0; 4],
            wants_spots: wants_profile || wants_look || wants_labels,
            wants_profile,
            wants_look,
        })
    }

    /// Writes one band of the window.
    fn band(&self, band: usize, maps: Maps<'_>, hand: &mut Hand, poll: Poll<'_>) -> Result<()> {
        let height = BAND.min(self.window.height - band * BAND);
        let Hand { search, rows, mask } = hand;
        let mut maps = maps;
        if maps.mask.is_none() && self.wants_look {
            mask.resize(self.window.width * BAND, 0);
            maps.mask = Some(&mut mask[..self.window.width * height]);
        }
        let corner = [self.window.left, self.window.top + (band * BAND) as i64];
        if let Some(mask) = &mut maps.mask {
            mask.fill(0);
            for &id in self.bands.iter().flat_map(|bands| bands.of(band)) {
                coverage::ink(&self.near.pieces[id as usize], corner, self.window.width, mask);
            }
        }
        if maps.distance.is_none() && !self.wants_spots {
            return Ok(());
        }
        let side = (2 * self.near.bins.side as usize).min(PAGE);
        for y in (0..height).step_by(side) {
            for x in (0..self.window.width).step_by(side) {
                poll()?;
                let first = [corner[0] + x as i64, corner[1] + y as i64];
                let part = Part {
                    corner: first,
                    at: [x, y],
                    width: side.min(self.window.width - x),
                    height: side.min(height - y),
                };
                self.page(part, side, search, rows, &mut maps)?;
            }
        }
        Ok(())
    }

    /// Writes the part of the window that a page holds.
    fn page(&self, part: Part, side: usize, search: &mut Search, rows: &mut Rows, maps: &mut Maps<'_>) -> Result<()> {
        let (mut set, mut level) = (&self.near, 0);
        while search.open(set, part.corner, side) == Found::TooFar {
            let far = self.far.get(level).ok_or(Error::Internal("no end of the surroundings"))?;
            level += 1;
            let wider = || around(&self.pattern, &self.grid, self.window, (level as u32, true), Watch::default());
            set = far.get_or_init(wider).as_ref().map_err(Clone::clone)?;
        }
        search.fill(set, part.corner, side);
        self.finish(set, &search.page, part, rows, maps);
        Ok(())
    }
}

/// The pixel that noise is pinned to: that of the first edge, so that noise moves with the pattern.
fn pin(pattern: &Pattern<'_>, grid: &Grid) -> Result<[i64; 2]> {
    let Some(edge) = pattern.edges.first() else { return Ok([0; 2]) };
    let vertex = edge[0] as usize;
    Ok(grid.place(pattern.vertices[vertex], vertex)?.map(|part| part.div_euclid(UNIT)))
}
