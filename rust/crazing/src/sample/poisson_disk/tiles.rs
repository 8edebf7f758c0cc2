//! Many points, tile by tile on all cores.
//!
//! Bridson's method leaves open in which order points are taken up. Here each belongs to a tile, and tiles are worked on
//! in rounds of four colours: two of one colour are too far from each other to meet, whichever thread has them. A tile
//! takes up its own points only, but puts new ones wherever there is room, beyond its border too; these wait for the
//! turn of theirs. So borders are no walls, and in the end every point has had all its tries.

use pulp::{Arch, Simd, WithSimd};

use super::TRIES;
use super::frame::Frame;
use super::ring::Ring;
use super::window::Window;
use crate::error::Result;
use crate::graph::Point;
use crate::parallel;
use crate::rng::{Key, Rng, stream};
use crate::watch::Watch;

/// Cells along a tile: what a thread sees of it and about it fits the memory nearest to it but one.
const ACROSS: usize = 32;
/// Around a torus are two tiles at least, of so many cells that two of one colour are more than nine radii apart: in each
/// points lie up to two radii outside, places about them two more, and what is too near to these one more.
const LEAST: usize = 16;
/// Tiles between two questions whether to go on: tens of milliseconds.
const BATCH: usize = 128;
/// Places tried for the first point of a tile that nothing has grown into.
const DARTS: usize = 30;

/// How the cells are cut into tiles.
pub(super) struct Tiling<'a> {
    pub(super) frame: &'a Frame,
    /// Tiles along each axis.
    pub(super) counts: [usize; 2],
}

impl<'a> Tiling<'a> {
    /// None where a torus is too thin.
    pub(super) fn of(frame: &'a Frame) -> Option<Self> {
        let counts = [0, 1].map(|i| {
            let wide = ACROSS.max(ACROSS * ACROSS / frame.counts[1 - i]);
            let count = (frame.counts[i] / wide).max(1);
            // Colours take turns all around a torus.
            if frame.on_torus { count.next_multiple_of(2) } else { count }
        });
        let is_wide = (0..2).all(|i| frame.counts[i] >= LEAST * counts[i]);
        (is_wide || !frame.on_torus).then_some(Self { frame, counts })
    }

    /// The first cell of a tile along an axis, and the one after its last.
    pub(super) fn cells(&self, axis: usize, tile: usize) -> [usize; 2] {
        [tile, tile + 1].map(|i| (i * self.frame.counts[axis]).div_ceil(self.counts[axis]))
    }

    /// Along an axis, a tile and its neighbours.
    pub(super) fn beside(&self, axis: usize, tile: usize) -> impl Iterator<Item = usize> + use<> {
        let (count, on_torus) = (self.counts[axis], self.frame.on_torus);
        // The other one of two around a torus is a neighbour on both sides.
        let last = if on_torus && count == 2 { tile } else { tile + 1 };
        let is_there = move |i: &usize| on_torus || (count..2 * count).contains(i);
        (count + tile - 1..=count + last).filter(is_there).map(move |i| i % count)
    }

    /// The tile that a new point belongs to: that of another place in the ring about it, so that no border is sharp.
    fn home(&self, p: Point, step: Point) -> usize {
        let [xmin, ymin, xmax, ymax] = self.frame.bounds;
        let place = [p[0] + step[0], p[1] + step[1]];
        let clamped = [place[0].clamp(xmin, xmax), place[1].clamp(ymin, ymax)];
        let cell = self.frame.cell(self.frame.inside_bounds(place).unwrap_or(clamped));
        let [x, y] = [0, 1].map(|i| cell[i] * self.counts[i] / self.frame.counts[i]);
        y * self.counts[0] + x
    }

    /// A place in a tile.
    fn dart(&self, tile: usize, rng: &mut Rng) -> Point {
        let (at, frame) = ([tile % self.counts[0], tile / self.counts[0]], self.frame);
        [0, 1].map(|i| {
            let [first, last] = self.cells(i, at[i]).map(|cell| cell as f64);
            frame.bounds[i] + frame.sides[i] * (first + (last - first) * rng.unit())
        })
    }
}

/// The points that belong to one tile, by birth.
pub(super) struct Tile {
    pub(super) points: Vec<Point>,
    /// How many of them have had their tries.
    done: usize,
    rng: Rng,
}

/// See [`super::poisson_disk`].
pub(super) fn by_tiles(tiling: &Tiling<'_>, key: Key, watch: Watch<'_>) -> Result<Vec<Point>> {
    let [columns, rows] = tiling.counts;
    // Item 0 of the stream is for what is made in one piece.
    let new = |item| Tile { points: Vec::new(), done: 0, rng: Rng::of_item(key, stream::POISSON_DISK, item) };
    let mut tiles: Vec<Tile> = (1..=columns as u64 * rows as u64).map(new).collect();
    let mut turn: Vec<usize> = (0..tiles.len()).collect();
    while !turn.is_empty() {
        for colour in 0..4 {
            let is_of_colour = |&i: &usize| (i % columns) % 2 + 2 * ((i / columns) % 2) == colour;
            let round: Vec<usize> = turn.iter().copied().filter(is_of_colour).collect();
            for batch in round.chunks(BATCH) {
                watch.poll()?;
                visit(tiling, &mut tiles, batch);
            }
        }
        turn = (0..tiles.len()).filter(|&i| tiles[i].done < tiles[i].points.len()).collect();
    }
    let mut points = Vec::with_capacity(tiles.iter().map(|tile| tile.points.len()).sum());
    tiles.into_iter().for_each(|tile| points.extend(tile.points));
    Ok(points)
}

/// Visits tiles that do not meet, all at the same time.
fn visit(tiling: &Tiling<'_>, tiles: &mut [Tile], batch: &[usize]) {
    // Compiled once for any processor, and once for those that compare twice as many distances at a time.
    let (all, arch) = (&*tiles, Arch::new());
    let one = |window: &mut Window, i: usize| arch.dispatch(Visit { tiling, tiles: all, tile: batch[i], window });
    let born = parallel::several_with(batch.len(), Window::default, one);
    for (&tile, (born, rng)) in batch.iter().zip(born) {
        born.into_iter().for_each(|(home, p)| tiles[home].points.push(p));
        tiles[tile].rng = rng;
        tiles[tile].done = tiles[tile].points.len();
    }
}

/// All points of a tile have their tries: the points born, each after the tile it belongs to.
struct Visit<'a> {
    tiling: &'a Tiling<'a>,
    tiles: &'a [Tile],
    tile: usize,
    window: &'a mut Window,
}

impl WithSimd for Visit<'_> {
    type Output = (Vec<(usize, Point)>, Rng);

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Self::Output {
        let Self { tiling, tiles, tile, window } = self;
        let (frame, Tile { points, done, rng }) = (tiling.frame, &tiles[tile]);
        window.look(tiling, tile, tiles);
        let mut ring = Ring::new(frame.radius, rng.clone());
        let mut born = Vec::new();
        if points.is_empty() {
            let first = (0..DARTS).find_map(|_| {
                let place = tiling.dart(tile, &mut ring.rng);
                window.gather(frame, place);
                window.take(frame, place)
            });
            born.extend(first.map(|p| (tile, p)));
        }
        let mut active: Vec<Point> = points[*done..].iter().copied().chain(born.iter().map(|&(_, p)| p)).collect();
        while !active.is_empty() {
            let place = ring.rng.below(active.len() as u32) as usize;
            let centre = window.gather(frame, active[place]);
            let found = (0..TRIES).find_map(|_| {
                let [x, y] = ring.step();
                window.take(frame, [centre[0] + x, centre[1] + y])
            });
            let Some(p) = found else {
                active.swap_remove(place);
                continue;
            };
            let home = tiling.home(p, ring.step());
            born.push((home, p));
            if home == tile {
                active.push(p);
            }
        }
        (born, ring.rng)
    }
}
