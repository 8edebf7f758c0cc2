//! Intervals of tiles, found by a tile, in memory linear in their number.

use super::tile::TILE;

/// Tiles from `first` to `last` that one taper meets.
#[derive(Debug, Clone, Copy)]
pub(super) struct Span {
    first: u32,
    last: u32,
    id: u32,
}

impl Span {
    /// The tiles that pixels from `low` to `high` touch, if any lie within `size` pixels.
    pub(super) fn of_pixels(id: usize, low: f64, high: f64, size: usize) -> Option<Self> {
        // One pixel more on either side, for the rounding of far coordinates.
        let (low, high) = (low - 1.0, high + 1.0);
        if high < 0.0 || low >= size as f64 {
            return None;
        }
        let tile = |pixel: f64| (pixel.clamp(0.0, size as f64 - 1.0) as usize / TILE) as u32;
        Some(Self { first: tile(low), last: tile(high), id: id as u32 })
    }

    /// Buckets of level `l` are 2^l tiles wide; a span lies in one or two buckets of its own level.
    fn level(&self) -> usize {
        (u32::BITS - (self.last - self.first).leading_zeros()) as usize
    }

    fn meets(&self, tile: u32) -> bool {
        self.first <= tile && tile <= self.last
    }
}

/// Spans sorted by level and, within a level, by the bucket of their first tile.
///
/// A long span is listed once, not once a tile: a hundred thousand lines across a huge picture stay small.
#[derive(Debug)]
pub(super) struct Spans {
    levels: Vec<Vec<Span>>,
}

impl Spans {
    /// Sorts the spans.
    pub(super) fn new(spans: impl Iterator<Item = Span>) -> Self {
        let mut levels: Vec<Vec<Span>> = Vec::new();
        for span in spans {
            let level = span.level();
            if levels.len() <= level {
                levels.resize_with(level + 1, Vec::new);
            }
            levels[level].push(span);
        }
        for (level, spans) in levels.iter_mut().enumerate() {
            spans.sort_by_key(|span| span.first >> level);
        }
        Self { levels }
    }

    /// The ids of all spans that meet a tile.
    pub(super) fn meeting(&self, tile: usize) -> impl Iterator<Item = usize> {
        let tile = tile as u32;
        self.levels.iter().enumerate().flat_map(move |(level, spans)| {
            let bucket = tile >> level;
            let start = spans.partition_point(|span| (span.first >> level) + 1 < bucket);
            let near = spans[start..].iter().take_while(move |span| span.first >> level <= bucket);
            near.filter(move |span| span.meets(tile)).map(|span| span.id as usize)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_what_a_plain_search_finds() {
        let spans: Vec<Span> = (0..40)
            .flat_map(|first| (first..40).map(move |last| Span { first, last, id: first * 40 + last }))
            .collect();
        let index = Spans::new(spans.iter().copied());
        for tile in 0..40 {
            let mut found: Vec<usize> = index.meeting(tile).collect();
            found.sort_unstable();
            let wanted = spans.iter().filter(|span| span.meets(tile as u32)).map(|span| span.id as usize);
            assert_eq!(found, wanted.collect::<Vec<_>>());
        }
    }

    #[test]
    fn pixels_outside_have_no_tiles() {
        assert!(Span::of_pixels(0, -9.0, -2.0, 100).is_none());
        assert!(Span::of_pixels(0, 101.5, 1e100, 100).is_none());
        assert!(Span::of_pixels(0, -1e100, 1e100, 100).is_some());
    }
}
