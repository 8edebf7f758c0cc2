//! Hierarchical cracks: the largest cell is split, and again, every new crack meeting the older ones at right angles.

mod band;
mod chord;
mod corners;
mod drawn;
mod draws;
mod founders;
mod mesh;
mod queue;

use super::aged::Aged;
use crate::clip::{Bounds, check_bounds};
use crate::error::{Error, Result};
use crate::graph::Point;
use crate::quantile;
use crate::rng::{Key, Rng, stream};
use crate::sample::Density;
use crate::watch::Watch;
use chord::Outline;
use draws::Draws;
use founders::Founders;
use mesh::{Mesh, TOGETHER};
use queue::Queue;

/// On a torus the first cells meet themselves: where a wall would join a side to itself another is tried, so often.
const AGAIN: usize = 32;
/// From here on walls are numbered that are no cracks, the outline of the bounds.
const BORDER: u32 = 1 << 30;

/// How cells are split.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Splitting {
    /// How many cells there are in the end.
    pub cells: usize,
    /// Standard deviation of the logarithm of the size that decides which cell is next: 0 makes all alike.
    pub jitter: f64,
    /// How far new walls bend to meet old ones at right angles, 0 to 1.
    pub bend: f64,
    /// Cells are this many times as long, along `angle`, as they are wide.
    pub anisotropy: f64,
    /// Radians from the x axis.
    pub angle: f64,
}

/// Splits the bounds, or one period of a torus, into cells.
///
/// The cell with the largest product of area, density and a lognormal factor is next. It is split near its middle,
/// across its long axis; the new wall leaves both old ones at a right angle as far as `bend` says.
///
/// # Errors
/// [`Error::BadValue`], [`Error::Interrupted`].
///
/// # Source
/// After Bohn, Pauchard, Couder: Hierarchical crack pattern as formed by successive domain divisions (2005).
pub fn split(
    bounds: Bounds,
    on_torus: bool,
    how: Splitting,
    density: Option<Density<'_>>,
    key: Key,
    watch: Watch<'_>,
) -> Result<Aged> {
    check_bounds(bounds)?;
    for (name, value) in [("jitter", how.jitter), ("bend", how.bend), ("anisotropy", how.anisotropy - 1e-9)] {
        if !(value.is_finite() && value >= 0.0) {
            return Err(Error::BadValue { name, value, wanted: "a finite number of at least 0 is wanted" });
        }
    }
    let mut rng = Rng::new(key, stream::SPLIT);
    let mut mesh = if on_torus {
        let period = [bounds[2] - bounds[0], bounds[3] - bounds[1]];
        Mesh::of_founders(&Founders::of([bounds[0], bounds[1]], period, how, &mut rng), period)
    } else {
        Mesh::of_box(bounds)
    };
    let mut queue = Queue::new();
    let mut draws = Draws::of(rng);
    let enqueue = |mesh: &Mesh, cell: usize, draws: &mut Draws, queue: &mut Queue| {
        let size = match density {
            Some(density) => {
                let (area, middle) = measure(mesh.ring(cell));
                area * density.at(middle)
            }
            None => area(mesh.ring(cell)),
        };
        queue.push(size * libm::exp(how.jitter * draws.normal()), cell);
    };
    enqueue(&mesh, 0, &mut draws, &mut queue);
    let attempts = if on_torus { AGAIN } else { 1 };
    let mut outline = Outline::default();
    while mesh.firsts.len() < how.cells {
        watch.poll_at(mesh.firsts.len())?;
        mesh.fetch(queue.ahead(TOGETHER));
        let Some(cell) = queue.pop() else { break };
        if let Some(wall) = (0..attempts).find_map(|_| chord::across(&mesh, cell, how, &mut draws, &mut outline)) {
            let other = mesh.divide(cell, &wall, &outline);
            enqueue(&mesh, cell, &mut draws, &mut queue);
            enqueue(&mesh, other, &mut draws, &mut queue);
        }
    }
    // Of a long torus no cell may be found that a wall can part: better nothing than a few cells for thousands.
    if on_torus && 2 * mesh.firsts.len() < how.cells {
        let sides = [bounds[2] - bounds[0], bounds[3] - bounds[1]];
        let value = sides[0].max(sides[1]) / sides[0].min(sides[1]);
        let wanted = "a period that is less long for its width is wanted: its cells cannot be split";
        return Err(Error::BadValue { name: "length over width of the period", value, wanted });
    }
    Ok(mesh.finish())
}

fn normal(rng: &mut Rng) -> f64 {
    quantile::normal(crate::rng::open_unit(rng.next_u64()))
}

/// The area of a polygon, to the bit that of [`measure`]: there most of the time is for the centroid.
fn area(mut polygon: impl Iterator<Item = Point>) -> f64 {
    let Some(origin) = polygon.next() else { return 0.0 };
    let (mut area, mut p) = (0.0, [0.0; 2]);
    for corner in polygon {
        let q = [corner[0] - origin[0], corner[1] - origin[1]];
        area += (p[0] * q[1] - p[1] * q[0]) / 2.0;
        p = q;
    }
    area
}

/// Area and centroid of a polygon.
fn measure(mut polygon: impl Iterator<Item = Point>) -> (f64, Point) {
    let Some(origin) = polygon.next() else { return (0.0, [0.0; 2]) };
    let (mut area, mut first) = (0.0, [0.0; 2]);
    // The first and the last side are at the origin, and add nothing.
    let mut p = [0.0; 2];
    for corner in polygon {
        let q = [corner[0] - origin[0], corner[1] - origin[1]];
        let cross = p[0] * q[1] - p[1] * q[0];
        area += cross / 2.0;
        first = [first[0] + cross * (p[0] + q[0]) / 6.0, first[1] + cross * (p[1] + q[1]) / 6.0];
        p = q;
    }
    let safe = if area > 0.0 { area } else { 1.0 };
    (area, [origin[0] + first[0] / safe, origin[1] + first[1] / safe])
}

/// Area, centroid and second moments (xx, xy, yy) of a polygon, about its centroid. The ring ends where it starts.
fn moments(ring: &[Point]) -> (f64, Point, [f64; 3]) {
    let origin = ring[0];
    let (mut area, mut first, mut second) = (0.0, [0.0; 2], [0.0; 3]);
    for side in ring.windows(2) {
        let [p, q] = [0, 1].map(|i| [side[i][0] - origin[0], side[i][1] - origin[1]]);
        let cross = p[0] * q[1] - p[1] * q[0];
        area += cross / 2.0;
        first = [first[0] + cross * (p[0] + q[0]) / 6.0, first[1] + cross * (p[1] + q[1]) / 6.0];
        second[0] += cross * (p[0] * p[0] + p[0] * q[0] + q[0] * q[0]) / 12.0;
        second[1] += cross * (2.0 * p[0] * p[1] + p[0] * q[1] + q[0] * p[1] + 2.0 * q[0] * q[1]) / 24.0;
        second[2] += cross * (p[1] * p[1] + p[1] * q[1] + q[1] * q[1]) / 12.0;
    }
    let safe = if area > 0.0 { area } else { 1.0 };
    let [x, y] = first.map(|sum| sum / safe);
    let about = [second[0] - area * x * x, second[1] - area * x * y, second[2] - area * y * y];
    (area, [origin[0] + x, origin[1] + y], about)
}
