//! A window band by band, and these page by page.

use pulp::{Simd, WithSimd};

use super::BAND;
use super::around::around;
use super::coverage::Ink;
use super::finish::{Part, Rows};
use super::maps::Maps;
use super::nearest::{PAGE, Search, Set};
use super::scene::Scene;
use crate::crew::Poll;
use crate::error::{Error, Result};

/// The buffers of one thread.
pub(super) struct Hand {
    search: Search,
    rows: Rows,
    mask: Vec<u8>,
}

impl Hand {
    pub(super) fn new() -> Self {
        Self { search: Search::new(), rows: Rows::new(), mask: Vec::new() }
    }
}

impl Scene<'_> {
    /// Writes one band of the window.
    pub(super) fn band(&self, band: usize, maps: Maps<'_>, hand: &mut Hand, poll: Poll<'_>) -> Result<()> {
        let height = BAND.min(self.window.height - band * BAND);
        let Hand { search, rows, mask } = hand;
        let mut maps = maps;
        if maps.mask.is_none() && self.wants.look {
            mask.resize(self.window.width * BAND, 0);
            maps.mask = Some(&mut mask[..self.window.width * height]);
        }
        let corner = [self.window.left, self.window.top + (band * BAND) as i64];
        if let Some(mask) = &mut maps.mask {
            mask.fill(0);
            for (pieces, ids) in self.covering(band) {
                self.arch.dispatch(Ink { pieces, ids, corner, width: self.window.width, rows: mask });
            }
        }
        if !self.wants.nearest() {
            return Ok(());
        }
        for y in (0..height).step_by(PAGE) {
            for x in (0..self.window.width).step_by(PAGE) {
                poll()?;
                let first = [corner[0] + x as i64, corner[1] + y as i64];
                let part = Part {
                    corner: first,
                    at: [x, y],
                    width: PAGE.min(self.window.width - x),
                    height: PAGE.min(height - y),
                };
                self.page(part, search, rows, &mut maps)?;
            }
        }
        Ok(())
    }

    /// Writes the part of the window that a page holds.
    fn page(&self, part: Part, search: &mut Search, rows: &mut Rows, maps: &mut Maps<'_>) -> Result<()> {
        let (mut set, mut level) = (&self.near, 0);
        while !search.open(set, part.corner, self.reach) {
            let far = self.far.get(level).ok_or(Error::Internal("no end of the surroundings"))?;
            level += 1;
            let wider = || around(&self.pattern, &self.grid, self.window, level as u32);
            set = far.get_or_init(wider).as_ref().map_err(Clone::clone)?;
        }
        if self.reach < f32::INFINITY && search.page.ids.is_empty() {
            self.level(part, maps);
        } else {
            self.arch.dispatch(Draw { scene: self, set, part, search, rows, maps });
        }
        Ok(())
    }
}

/// A page that is to be drawn: compiled once for any processor, and once for those that do twice as many numbers at a
/// time, to the same bits.
struct Draw<'a, 'b, 'c> {
    scene: &'a Scene<'b>,
    set: &'a Set,
    part: Part,
    search: &'a mut Search,
    rows: &'a mut Rows,
    maps: &'a mut Maps<'c>,
}

impl WithSimd for Draw<'_, '_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Part { corner, width, height, .. } = self.part;
        self.search.fill(self.set, corner, [width, height], self.scene.reach);
        self.scene.finish(self.set, &self.search.page, self.part, self.rows, self.maps);
    }
}
