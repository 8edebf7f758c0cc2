//! What is made once for a window, and then read by every thread.

use std::sync::OnceLock;

use pulp::Arch;

use super::around::{LEVELS, Wanted, cut};
use super::bands::Bands;
use super::bins::Bins;
use super::dust::Dust;
use super::fans::Fans;
use super::grid::{Grid, UNIT, Window};
use super::look::Look;
use super::maps::Maps;
use super::material::Material;
use super::nearest::Set;
use super::noise::{self, Ground, Noise};
use super::piece::Piece;
use super::plates::{self, Plate, Sides};
use super::profile::Profile;
use super::scan::Scan;
use super::ties::Ties;
use super::{Pattern, labels};
use crate::crew;
use crate::error::Result;
use crate::rng::Key;
use crate::watch::Watch;

/// Edges from which on they are sorted by several threads.
const WORTHWHILE: usize = 1 << 13;

/// What is to be drawn.
#[derive(Clone, Copy)]
pub(super) struct Asked<'a> {
    pub(super) pattern: Pattern<'a>,
    pub(super) sides: Sides<'a>,
    pub(super) grid: Grid,
    pub(super) window: Window,
    pub(super) key: Key,
}

/// What the wanted maps depend on.
#[derive(Clone, Copy)]
pub(super) struct Wants {
    pub(super) distance: bool,
    cell: bool,
    pub(super) profile: bool,
    pub(super) look: bool,
    pub(super) mask: bool,
    direction: bool,
    labels: bool,
}

impl Wants {
    fn new(maps: &Maps<'_>) -> Self {
        let look = maps.color.is_some() || maps.roughness.is_some() || maps.wear.is_some();
        Self {
            distance: maps.distance.is_some(),
            cell: maps.cell.is_some(),
            profile: maps.height.is_some() || maps.normal.is_some() || maps.ao.is_some(),
            look,
            mask: look || maps.mask.is_some(),
            direction: maps.direction.is_some(),
            labels: maps.strand.is_some() || maps.generation.is_some(),
        }
    }

    /// Whether the nearest edges are to be found, if only on the crack.
    pub(super) fn nearest(&self) -> bool {
        self.everywhere() || self.profile || self.labels
    }

    /// Whether they are wanted for every pixel.
    fn everywhere(&self) -> bool {
        self.look || self.distance || self.direction
    }

    /// Whether it matters which plate a pixel is on.
    fn plates(&self, material: &Material) -> bool {
        self.cell || self.differ(material)
    }

    /// Whether plates differ.
    fn differ(&self, material: &Material) -> bool {
        (self.profile && !is_plain(material)) || (self.look && material.tint != 0.0)
    }

    fn grain(&self, material: &Material) -> bool {
        let shown = [material.speckle, material.roughness_spread, material.debris] != [0.0; 3];
        let frayed = (self.profile || self.look) && material.fray != 0.0;
        (self.profile && material.grain != 0.0) || (self.look && shown) || frayed
    }
}

/// Whether plates are level and alike, and cracks raise nothing beyond a reach that is known.
fn is_plain(material: &Material) -> bool {
    let Material { grain, level, tilt, fray, .. } = *material;
    [grain, level, tilt, fray, material.curl * material.curl_spread] == [0.0; 5]
}

/// What every thread reads.
pub(super) struct Scene<'a> {
    pub(super) pattern: Pattern<'a>,
    pub(super) sides: Sides<'a>,
    pub(super) grid: Grid,
    pub(super) window: Window,
    /// What is searched; nothing where no map needs that.
    pub(super) near: Set,
    /// The pieces in parts, where they are not searched.
    parts: Vec<Vec<Piece>>,
    /// What covers the mask, where it is wanted: by parts.
    bands: Vec<Bands>,
    /// Ever more of what lies around, made when what lies nearer is not enough.
    pub(super) far: [OnceLock<Result<Set>>; LEVELS],
    pub(super) profile: Profile,
    pub(super) look: Look,
    /// How far dirt reaches, where that differs.
    pub(super) dust: Option<Dust>,
    pub(super) plates: Vec<Plate>,
    /// Where there is more than one plate.
    pub(super) scan: Option<Scan>,
    /// Where such plates tilt.
    pub(super) fans: Option<Fans>,
    /// Where labels or directions are wanted.
    pub(super) ties: Option<Ties>,
    pub(super) grain: Vec<Noise>,
    pub(super) mottle: Vec<Noise>,
    pub(super) chip: Vec<Noise>,
    pub(super) chip_depth: f32,
    pub(super) fray: f32,
    pub(super) grain_height: f32,
    pub(super) level: f32,
    pub(super) tilt: f32,
    pub(super) curl_spread: f32,
    /// Data units a pixel.
    pub(super) data: f32,
    /// Pixels that are no nearer to the crack than this are all alike.
    pub(super) reach: f32,
    /// How the processor does several numbers at a time.
    pub(super) arch: Arch,
    /// Whether plates are level and alike.
    pub(super) plain: bool,
    pub(super) wants: Wants,
}

impl<'a> Scene<'a> {
    pub(super) fn new(
        asked: Asked<'a>,
        material: &Material,
        maps: &Maps<'_>,
        threads: usize,
        watch: Watch<'_>,
    ) -> Result<Self> {
        let Asked { pattern, sides, grid, window, key } = asked;
        let (wants, plain, profile) = (Wants::new(maps), is_plain(material), Profile::new(material, grid.scale));
        let ground = Ground { key, period: grid.period, pin: pin(&pattern, &grid)? };
        let octaves = |on: bool, kind: u64, size: f32, stretch: f32, count: u64| {
            let size = f64::from(size) * grid.scale;
            if on { noise::octaves(ground, kind, size, stretch.into(), count) } else { Vec::new() }
        };
        let tilted = wants.profile && material.tilt != 0.0;
        let Sorted { near, parts, bands, scan, fans, ties } =
            asked.sort(wants, [wants.plates(material), tilted], threads, watch)?;
        Ok(Self {
            pattern,
            sides,
            grid,
            window,
            near,
            parts,
            bands,
            far: Default::default(),
            reach: if wants.everywhere() || !plain { f32::INFINITY } else { profile.reach.max(labels::REACH) },
            profile,
            look: Look::new(material, grid.scale),
            dust: if maps.color.is_some() { Dust::of(&pattern, &grid, material)? } else { None },
            plates: if wants.differ(material) { plates::plates(sides.reaches, key) } else { Vec::new() },
            scan,
            fans,
            ties,
            grain: octaves(wants.grain(material), 0, material.grain_size, material.stretch, 2),
            mottle: octaves(wants.look, 1, material.mottle_size, material.stretch, 3),
            chip: octaves(material.chip > 0.0 && (wants.profile || wants.look), 2, material.chip_size, 1.0, 2),
            chip_depth: (f64::from(material.chip) * grid.scale) as f32,
            fray: material.fray,
            grain_height: material.grain,
            level: material.level,
            tilt: material.tilt,
            curl_spread: material.curl_spread,
            data: (1.0 / grid.scale) as f32,
            plain,
            arch: Arch::new(),
            wants,
        })
    }
}

/// The edges as they are looked at.
struct Sorted {
    near: Set,
    parts: Vec<Vec<Piece>>,
    bands: Vec<Bands>,
    scan: Option<Scan>,
    fans: Option<Fans>,
    ties: Option<Ties>,
}

impl Scene<'_> {
    /// What covers the rows of a band: pieces, and which of them.
    pub(super) fn covering(&self, band: usize) -> impl Iterator<Item = (&[Piece], &[u32])> {
        let mut rest = &self.near.pieces[..];
        self.bands.iter().enumerate().map(move |(nth, bands)| {
            let own = self.parts.get(nth).map_or_else(
                || {
                    let (own, others) = rest.split_at(bands.count);
                    rest = others;
                    own
                },
                |part| &part[..],
            );
            (own, bands.of(band))
        })
    }
}

impl Asked<'_> {
    /// Sorts the edges: into bands where the mask is wanted, into bins, and by rows where plates are; around their
    /// vertices where these tilt.
    fn sort(&self, wants: Wants, [plates, tilted]: [bool; 2], threads: usize, watch: Watch<'_>) -> Result<Sorted> {
        let Self { pattern, sides, grid, window, .. } = self;
        let several = plates && sides.reaches.len() > 1;
        // Few edges are not worth waking a thread.
        let threads = if pattern.edges.len() < WORTHWHILE { 1 } else { threads };
        let wanted = Wanted { pattern: *pattern, grid: *grid, window: *window, level: 0, bands: wants.mask };
        let mut cut = cut(wanted, threads, watch)?;
        let empty = || Ok(Set { pieces: Vec::new(), bins: Bins::none(), whole: true, widest: 0.0 });
        let (near, rest) = crew::both(
            threads,
            || if wants.nearest() { cut.set() } else { empty() },
            || {
                let scan = several.then(|| Scan::new(pattern, grid, *window, sides.bounds)).transpose()?;
                let fans = (several && tilted).then(|| Fans::new(pattern, grid, sides)).transpose()?;
                Ok((scan, fans, (wants.labels || wants.direction).then(|| Ties::of(pattern))))
            },
        );
        let (scan, fans, ties) = rest?;
        Ok(Sorted { near: near?, parts: cut.parts, bands: cut.bands, scan, fans, ties })
    }
}

/// The pixel that noise is pinned to: that of the first edge, so that noise moves with the pattern.
fn pin(pattern: &Pattern<'_>, grid: &Grid) -> Result<[i64; 2]> {
    let Some(edge) = pattern.edges.first() else { return Ok([0; 2]) };
    let vertex = edge[0] as usize;
    Ok(grid.place(pattern.vertices[vertex], vertex)?.map(|part| part.div_euclid(UNIT)))
}
