//! A window band by band, these run by run, and these page by page.

use pulp::{Simd, WithSimd};

use super::BAND;
use super::around::around;
use super::coverage::Ink;
use super::finish::{Leaf, Rows, Run};
use super::labels::Labels;
use super::maps::Maps;
use super::nearest::{PAGE, Page, Search, Set};
use super::scene::Scene;
use crate::crew::Poll;
use crate::error::{Error, Result};

/// Pages of a run at most. Their rows go to memory in one piece each: for long ones the system has faster ways than to
/// read what is going to be written over.
const RUN: usize = 32;

/// The buffers of one thread.
pub(super) struct Hand {
    search: Search,
    leaves: Vec<Leaf>,
    rows: Rows,
    mask: Vec<u8>,
    plates: Vec<u32>,
}

impl Hand {
    pub(super) fn new() -> Self {
        Self { search: Search::new(), leaves: Vec::new(), rows: Rows::new(), mask: Vec::new(), plates: Vec::new() }
    }
}

impl Scene<'_> {
    /// Writes one band of the window.
    pub(super) fn band(&self, band: usize, mut maps: Maps<'_>, hand: &mut Hand, poll: Poll<'_>) -> Result<()> {
        let (width, height) = (self.window.width, BAND.min(self.window.height - band * BAND));
        let Hand { search, leaves, rows, mask, plates } = hand;
        let mut covered: Option<&mut [u8]> = maps.mask.take();
        if covered.is_none() && self.wants.look {
            mask.resize(width * BAND, 0);
            covered = Some(&mut mask[..width * height]);
        }
        let corner = [self.window.left, self.window.top + (band * BAND) as i64];
        if let Some(mask) = &mut covered {
            mask.fill(0);
            for (pieces, ids) in self.covering(band) {
                self.arch.dispatch(Ink { pieces, ids, corner, width, rows: mask });
            }
        }
        let plates = self.scan.as_ref().map(|scan| {
            plates.resize(width * BAND, 0);
            let codes = &mut plates[..width * height];
            scan.band(band, codes);
            &*codes
        });
        if let Some(cell) = maps.cell.take() {
            cell.fill(0);
            if let (Some(scan), Some(codes)) = (&self.scan, plates) {
                scan.plates(&self.sides, codes, cell);
            }
        }
        if !self.wants.nearest() {
            return Ok(());
        }
        rows.line.resize(&maps, width.min(RUN * PAGE));
        leaves.resize_with(width.div_ceil(PAGE).min(RUN), Leaf::new);
        for left in (0..width).step_by(RUN * PAGE) {
            let width = (width - left).min(RUN * PAGE);
            let leaves = &mut leaves[..width.div_ceil(PAGE)];
            for (at, leaf) in (0..).step_by(PAGE).zip(leaves.iter_mut()) {
                poll()?;
                leaf.at = at;
                leaf.corner = [corner[0] + (left + at) as i64, corner[1]];
                leaf.width = PAGE.min(width - at);
                self.page(leaf, height, search)?;
            }
            let run = Run { leaves, left, width, height, mask: covered.as_deref(), plates };
            self.arch.dispatch(Draw { scene: self, run, rows, maps: &mut maps });
        }
        Ok(())
    }

    /// Finds the nearest pieces of a page.
    fn page(&self, leaf: &mut Leaf, height: usize, search: &mut Search) -> Result<()> {
        let (mut set, page) = (&self.near, &mut leaf.page);
        page.level = 0;
        while !search.open(page, set, leaf.corner, self.reach) {
            let far = self.far.get(page.level).ok_or(Error::Internal("no end of the surroundings"))?;
            page.level += 1;
            let wider = || around(&self.pattern, &self.grid, self.window, page.level as u32);
            set = far.get_or_init(wider).as_ref().map_err(Clone::clone)?;
        }
        leaf.is_level = self.reach < f32::INFINITY && page.ids.is_empty();
        if !leaf.is_level {
            let (corner, size) = (leaf.corner, [leaf.width, height]);
            self.arch.dispatch(Fill { search, page, set, corner, size, reach: self.reach });
        }
        Ok(())
    }

    /// The pieces of that level of surroundings, of which a page was found to be.
    pub(super) fn set(&self, level: usize) -> &Set {
        let far = level.checked_sub(1).and_then(|far| self.far.get(far)?.get()?.as_ref().ok());
        far.unwrap_or(&self.near)
    }
}

impl Leaf {
    fn new() -> Self {
        Self {
            page: Page::new(),
            labels: Labels::default(),
            held: Vec::new(),
            corner: [0; 2],
            at: 0,
            width: 0,
            is_level: false,
        }
    }
}

/// A page whose nearest pieces are to be found: compiled once for any processor, and once for those that do twice as
/// many numbers at a time, to the same bits.
struct Fill<'a> {
    search: &'a mut Search,
    page: &'a mut Page,
    set: &'a Set,
    corner: [i64; 2],
    size: [usize; 2],
    reach: f32,
}

impl WithSimd for Fill<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        self.search.fill(self.page, self.set, self.corner, self.size, self.reach);
    }
}

/// A run that is to be written, likewise.
struct Draw<'a, 'b, 'c> {
    scene: &'a Scene<'b>,
    run: Run<'a>,
    rows: &'a mut Rows,
    maps: &'a mut Maps<'c>,
}

impl WithSimd for Draw<'_, '_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        self.scene.finish(simd, self.run, self.rows, self.maps);
    }
}
