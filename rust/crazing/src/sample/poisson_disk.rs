//! Points no nearer to each other than a radius, as many as fit.

use super::check_box;
use crate::error::{Error, Result};
use crate::graph::Point;
use crate::rng::{Key, Rng, stream};
use crate::watch::Watch;

/// Places tried about a point before it is given up; Bridson's own number.
const TRIES: usize = 30;
/// Most cells of the grid, each of which holds at most one point.
const MOST_CELLS: f64 = 268_435_456.0;
const EMPTY: u32 = u32::MAX;

/// Points in `bounds`, no two nearer than `radius`; on a torus copies count too.
///
/// Points are tried in the ring from one radius to two about points that are there, until none has room.
///
/// # Errors
/// [`Error::BadValue`] for a radius that is not positive or too small for the bounds, [`Error::Interrupted`].
///
/// # Source
/// Bridson: Fast Poisson Disk Sampling in Arbitrary Dimensions (SIGGRAPH sketches 2007).
pub fn poisson_disk(radius: f64, bounds: [f64; 4], on_torus: bool, key: Key, watch: Watch<'_>) -> Result<Vec<Point>> {
    check_box(bounds)?;
    let mut grid = Grid::of(radius, bounds, on_torus)?;
    let mut rng = Rng::new(key, stream::POISSON_DISK);
    let [xmin, ymin, xmax, ymax] = bounds;
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
            let p = grid.inside_bounds(about(centre, radius, &mut rng));
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
struct Grid {
    radius: f64,
    bounds: [f64; 4],
    on_torus: bool,
    counts: [usize; 2],
    sides: Point,
    /// How many cells on either side hold points that may be too near.
    reach: [usize; 2],
    cells: Vec<u32>,
    points: Vec<Point>,
}

impl Grid {
    fn of(radius: f64, bounds: [f64; 4], on_torus: bool) -> Result<Self> {
        let sides = [bounds[2] - bounds[0], bounds[3] - bounds[1]];
        let wanted = sides.map(|side| (side / radius * std::f64::consts::SQRT_2).ceil().max(1.0));
        let refused = |wanted| Err(Error::BadValue { name: "radius", value: radius, wanted });
        // Distances are compared by their squares: if all of these were zero or infinite, there would always be room.
        if !(radius > 0.0 && (radius * radius).is_normal()) {
            return refused("a positive number whose square is a float is wanted");
        }
        if wanted[0] * wanted[1] > MOST_CELLS {
            return refused("so near to each other, more than 90 million points have room; a larger radius is wanted");
        }
        let counts = wanted.map(|count| count as usize);
        let sides = [0, 1].map(|i| sides[i] / counts[i] as f64);
        let reach = [0, 1].map(|i| ((radius / sides[i]).ceil() as usize).min(counts[i]));
        let cells = vec![EMPTY; counts[0] * counts[1]];
        Ok(Self { radius, bounds, on_torus, counts, sides, reach, cells, points: Vec::new() })
    }

    fn inside_bounds(&self, p: Point) -> Option<Point> {
        let size = [self.bounds[2] - self.bounds[0], self.bounds[3] - self.bounds[1]];
        let mut inside = p;
        for i in 0..2 {
            let (low, high) = (self.bounds[i], self.bounds[i + 2]);
            if self.on_torus {
                inside[i] = p[i] - ((p[i] - low) / size[i]).floor() * size[i];
                inside[i] = if inside[i] < high { inside[i].max(low) } else { low };
            } else if !(low..=high).contains(&p[i]) {
                return None;
            }
        }
        Some(inside)
    }

    fn cell(&self, p: Point) -> [usize; 2] {
        [0, 1].map(|i| (((p[i] - self.bounds[i]) / self.sides[i]) as usize).min(self.counts[i] - 1))
    }

    fn add(&mut self, p: Point) {
        let [x, y] = self.cell(p);
        self.cells[y * self.counts[0] + x] = self.points.len() as u32;
        self.points.push(p);
    }

    fn is_free(&self, p: Point) -> bool {
        let here = self.cell(p);
        let row = |i: usize| {
            let (reach, count) = (self.reach[i] as isize, self.counts[i] as isize);
            (-reach..=reach).filter_map(move |step| {
                let at = here[i] as isize + step;
                let inside = (0..count).contains(&at);
                (inside || self.on_torus).then_some(at.rem_euclid(count) as usize)
            })
        };
        row(1).all(|y| row(0).all(|x| self.apart(p, self.cells[y * self.counts[0] + x])))
    }

    fn apart(&self, p: Point, other: u32) -> bool {
        let Some(&q) = self.points.get(other as usize) else { return true };
        let step = [0, 1].map(|i| {
            let (apart, side) = (p[i] - q[i], self.bounds[i + 2] - self.bounds[i]);
            if self.on_torus { apart - (apart / side).round() * side } else { apart }
        });
        step[0] * step[0] + step[1] * step[1] >= self.radius * self.radius
    }
}
