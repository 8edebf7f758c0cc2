//! Few points, or those of a thin torus: one after the other.

use super::TRIES;
use super::frame::Frame;
use crate::error::Result;
use crate::graph::Point;
use crate::rng::{Key, Rng, stream};
use crate::watch::Watch;

const EMPTY: u32 = u32::MAX;

/// See [`super::poisson_disk`]: by birth.
pub(super) fn in_one_piece(frame: &Frame, key: Key, watch: Watch<'_>) -> Result<Vec<Point>> {
    let mut grid = Grid::of(frame);
    let mut rng = Rng::new(key, stream::POISSON_DISK);
    let [xmin, ymin, xmax, ymax] = frame.bounds;
    let start = [xmin + (xmax - xmin) * rng.unit(), ymin + (ymax - ymin) * rng.unit()];
    grid.add(start);
    let mut active: Vec<u32> = vec![0];
    let mut step = 0;
    while !active.is_empty() {
        let place = rng.below(active.len() as u32) as usize;
        let centre = grid.points[active[place] as usize];
        let mut found = false;
        for _ in 0..TRIES {
            watch.poll_at(step)?;
            step += 1;
            let p = frame.inside_bounds(about(centre, frame.radius, &mut rng));
            if let Some(p) = p.filter(|&p| grid.is_free(p)) {
                active.push(grid.points.len() as u32);
                grid.add(p);
                found = true;
                break;
            }
        }
        if !found {
            active.swap_remove(place);
        }
    }
    Ok(grid.points)
}

/// A place in the ring from one radius to two, evenly by area: by rejection, so that no angle is computed.
fn about(centre: Point, radius: f64, rng: &mut Rng) -> Point {
    loop {
        let [x, y] = [0; 2].map(|_| 4.0 * rng.unit() - 2.0);
        if (1.0..=4.0).contains(&(x * x + y * y)) {
            return [centre[0] + radius * x, centre[1] + radius * y];
        }
    }
}

/// At most one point a cell.
struct Grid<'a> {
    frame: &'a Frame,
    /// How many cells on either side hold points that may be too near.
    reach: [usize; 2],
    /// To these cells and its own, the nearest first: most places are taken, and it is mostly these that tell.
    steps: Vec<[isize; 2]>,
    cells: Vec<u32>,
    points: Vec<Point>,
}

impl<'a> Grid<'a> {
    fn of(frame: &'a Frame) -> Self {
        let reach = frame.reach(1.0);
        let along = |i: usize| -(reach[i] as isize)..=reach[i] as isize;
        let mut steps: Vec<[isize; 2]> = along(1).flat_map(|y| along(0).map(move |x| [x, y])).collect();
        steps.sort_by_key(|[x, y]| x * x + y * y);
        let cells = vec![EMPTY; frame.counts[0] * frame.counts[1]];
        Self { frame, reach, steps, cells, points: Vec::new() }
    }

    fn add(&mut self, p: Point) {
        let [x, y] = self.frame.cell(p);
        self.cells[y * self.frame.counts[0] + x] = self.points.len() as u32;
        self.points.push(p);
    }

    fn is_free(&self, p: Point) -> bool {
        let (here, counts) = (self.frame.cell(p), self.frame.counts);
        let is_free = |x: isize, y: isize, on_torus: bool| {
            let other = self.points.get(self.cells[y as usize * counts[0] + x as usize] as usize);
            other.is_none_or(|&q| self.are_apart(p, q, on_torus))
        };
        // So far from the border that what is near is not seen around the torus.
        if (0..2).all(|i| here[i] > self.reach[i] && here[i] + self.reach[i] + 1 < counts[i]) {
            return self.steps.iter().all(|[x, y]| is_free(here[0] as isize + x, here[1] as isize + y, false));
        }
        let on_torus = self.frame.on_torus;
        self.steps.iter().all(|step| {
            let at = [0, 1].map(|i| here[i] as isize + step[i]);
            let is_inside = (0..2).all(|i| (0..counts[i] as isize).contains(&at[i]));
            let [x, y] = [0, 1].map(|i| at[i].rem_euclid(counts[i] as isize));
            !(is_inside || on_torus) || is_free(x, y, on_torus)
        })
    }

    fn are_apart(&self, p: Point, q: Point, on_torus: bool) -> bool {
        let size = self.frame.size();
        let step = [0, 1].map(|i| {
            let apart = p[i] - q[i];
            if on_torus { apart - (apart / size[i]).round() * size[i] } else { apart }
        });
        step[0] * step[0] + step[1] * step[1] >= self.frame.radius * self.frame.radius
    }
}
