//! Where a new wall runs through a cell.

use std::cmp::Ordering;

use super::band::Band;
use super::draws::Draws;
use super::mesh::{Mesh, Turn};
use super::{Splitting, moments};
use crate::graph::Point;
use crate::predicates::orientation;

/// Tries to find a wall that ends far from other junctions.
const TRIES: usize = 6;
/// Far enough, in roots of the cell's area.
const APART: f64 = 0.16;
/// How far off the middle a wall may lie, in roots of the area, and how far it may turn, radians (both standard
/// deviations).
const OFF: f64 = 0.13;
const TURN: f64 = 0.2;
/// Pieces of a bent wall.
const PIECES: usize = 8;
/// A wall that leaves straighter than this (cosine) is not bent.
const EVEN: f64 = 0.9995;
/// No wall ends nearer to a corner of a side than this part of the side.
const CORNER: f64 = 1e-3;

/// A new wall: the sides of the cell it joins, and its points from the one to the other.
pub(super) struct Wall {
    /// Positions in the list of the cell's corners.
    pub(super) sides: [usize; 2],
    /// In the frame of the cell's polygon.
    pub(super) line: Line,
}

/// The points of a wall; of a straight one the ends.
#[derive(Clone, Copy)]
pub(super) struct Line {
    points: [Point; PIECES + 1],
    count: usize,
}

impl Line {
    fn straight(a: Point, b: Point) -> Self {
        let mut points = [b; PIECES + 1];
        points[0] = a;
        Self { points, count: 2 }
    }

    pub(super) fn points(&self) -> &[Point] {
        &self.points[..self.count]
    }
}

/// A cell as one piece, laid out for those who look at all of it several times; made once and filled again.
#[derive(Default)]
pub(super) struct Outline {
    /// Its corners counter-clockwise, the first once more at the end.
    pub(super) ring: Vec<Point>,
    /// Those where junctions are.
    pub(super) nodes: Vec<Point>,
    /// The half-edges of the ring, and the periods between where each starts and its vertex.
    pub(super) sides: Vec<(u32, Turn)>,
    /// For each of the ring, how far it is off a line.
    off: Vec<f64>,
}

impl Outline {
    /// Whether two sides are the two faces of one wall.
    fn are_one(&self, a: usize, b: usize) -> bool {
        self.sides[a].0 / 2 == self.sides[b].0 / 2
    }

    /// Distance from a place to the nearest junction.
    fn gap(&self, at: Point) -> f64 {
        let square = |p: &Point| (p[0] - at[0]) * (p[0] - at[0]) + (p[1] - at[1]) * (p[1] - at[1]);
        self.nodes.iter().map(square).fold(f64::INFINITY, f64::min).sqrt()
    }
}

/// A wall through the middle of a cell, across its long axis; None where no wall fits.
pub(super) fn across(
    mesh: &Mesh,
    cell: usize,
    how: Splitting,
    draws: &mut Draws,
    outline: &mut Outline,
) -> Option<Wall> {
    mesh.lay_out(cell, outline);
    let (area, middle, spread) = moments(&outline.ring);
    if area <= 0.0 || !area.is_finite() {
        return None;
    }
    let size = area.sqrt();
    let along = long_axis(spread, how, draws);
    let mut best: Option<(f64, Wall)> = None;
    for _ in 0..TRIES {
        let (off, turn) = (OFF * size * draws.normal(), TURN * draws.normal());
        let from = [middle[0] + off * along[0], middle[1] + off * along[1]];
        let (sin, cos) = (libm::sin(turn), libm::cos(turn));
        let way = [-(sin * along[0] + cos * along[1]), cos * along[0] - sin * along[1]];
        let Some([a, b]) = hits(outline, from, way) else { continue };
        let gap = outline.gap(a.at).min(outline.gap(b.at)) / size;
        if best.as_ref().is_some_and(|(most, _)| gap <= *most) || outline.are_one(a.side, b.side) {
            continue;
        }
        if let Some(line) = bent(&outline.ring, [a, b], how.bend) {
            best = Some((gap, Wall { sides: [a.side, b.side], line }));
            if gap >= APART {
                break;
            }
        }
    }
    best.map(|(_, wall)| wall)
}

/// Unit vector along the cell's long axis, as it is when the direction of anisotropy is shrunk.
fn long_axis([xx, xy, yy]: [f64; 3], how: Splitting, draws: &mut Draws) -> Point {
    let (sin, cos) = (libm::sin(how.angle), libm::cos(how.angle));
    // In the frame of the anisotropy.
    let a = (xx * cos * cos + 2.0 * xy * sin * cos + yy * sin * sin) / (how.anisotropy * how.anisotropy);
    let b = ((yy - xx) * sin * cos + xy * (cos * cos - sin * sin)) / how.anisotropy;
    let c = xx * sin * sin - 2.0 * xy * sin * cos + yy * cos * cos;
    let half = 0.5 * libm::atan2(2.0 * b, a - c);
    // A cell as wide as long has no long axis.
    let round = libm::hypot(a - c, 2.0 * b) < 0.05 * (a + c);
    let half = if round { std::f64::consts::PI * draws.unit() } else { half };
    // The normal of the wall is what is stretched back: a wall lies across the axis in the shrunken frame.
    let (u, v) = (libm::cos(half) / how.anisotropy, libm::sin(half));
    let length = libm::hypot(u, v);
    [(u * cos - v * sin) / length, (u * sin + v * cos) / length]
}

/// Where a line meets the outline.
#[derive(Clone, Copy)]
pub(super) struct Hit {
    pub(super) side: usize,
    pub(super) at: Point,
}

/// The nearest sides before and behind `from`.
fn hits(outline: &mut Outline, from: Point, way: Point) -> Option<[Hit; 2]> {
    let Outline { ring, off, .. } = outline;
    off.clear();
    off.extend(ring.iter().map(|p| way[0] * (p[1] - from[1]) - way[1] * (p[0] - from[0])));
    let mut behind: Option<(f64, Hit)> = None;
    let mut before: Option<(f64, Hit)> = None;
    for (side, (ends, off)) in ring.windows(2).zip(off.windows(2)).enumerate() {
        let (s, t) = (off[0], off[1]);
        if (s > 0.0) == (t > 0.0) {
            continue;
        }
        let (p, q) = (ends[0], ends[1]);
        let part = s / (s - t);
        let at = [p[0] + part * (q[0] - p[0]), p[1] + part * (q[1] - p[1])];
        let far = way[0] * (at[0] - from[0]) + way[1] * (at[1] - from[1]);
        let fits = (CORNER..1.0 - CORNER).contains(&part);
        let hit = (far, Hit { side: if fits { side } else { usize::MAX }, at });
        if far > 0.0 && before.is_none_or(|(least, _)| far < least) {
            before = Some(hit);
        } else if far <= 0.0 && behind.is_none_or(|(least, _)| far > least) {
            behind = Some(hit);
        }
    }
    let (a, b) = (behind?.1, before?.1);
    (a.side != b.side && a.side != usize::MAX && b.side != usize::MAX).then_some([a, b])
}

/// The points of a wall between two hits, as bent as fits into the cell.
fn bent(ring: &[Point], hits: [Hit; 2], bend: f64) -> Option<Line> {
    [bend, bend / 2.0, bend / 4.0, 0.0]
        .into_iter()
        .map(|bend| curve(ring, hits, bend))
        .find(|line| fits(ring, hits, line.points()))
}

/// A wall between two hits on a ring that leaves both sides at right angles as far as `bend` says.
pub(super) fn curve(ring: &[Point], [a, b]: [Hit; 2], bend: f64) -> Line {
    let chord = [b.at[0] - a.at[0], b.at[1] - a.at[1]];
    let length = libm::hypot(chord[0], chord[1]);
    // Sides run counter-clockwise: the inside is on their left. The wall leaves the first and runs into the second.
    let tangent = |side: usize, sign: f64| {
        let (p, q) = (ring[side], ring[side + 1]);
        let (x, y) = (q[0] - p[0], q[1] - p[1]);
        let size = libm::hypot(x, y);
        let mixed = [0, 1].map(|i| {
            let normal = sign * [-y, x][i] / size;
            bend * normal + (1.0 - bend) * chord[i] / length
        });
        let size = libm::hypot(mixed[0], mixed[1]);
        mixed.map(|x| if size > 0.0 { x * length / size } else { 0.0 })
    };
    let (start, end) = (tangent(a.side, 1.0), tangent(b.side, -1.0));
    let even = |t: Point| t[0] * chord[0] + t[1] * chord[1] > EVEN * length * length;
    if bend == 0.0 || (even(start) && even(end)) {
        return Line::straight(a.at, b.at);
    }
    let point = |i: usize| {
        let t = i as f64 / PIECES as f64;
        let (s, u) = (1.0 - t, t * (1.0 - t));
        let (first, second) = (s * s * (1.0 + 2.0 * t), t * t * (3.0 - 2.0 * t));
        [0, 1].map(|k| first * a.at[k] + u * s * start[k] + second * b.at[k] - u * t * end[k])
    };
    let points = std::array::from_fn(|i| match i {
        0 => a.at,
        PIECES => b.at,
        _ => point(i),
    });
    Line { points, count: PIECES + 1 }
}

/// Whether a wall meets the outline at its ends only.
fn fits(ring: &[Point], [a, b]: [Hit; 2], points: &[Point]) -> bool {
    let last = points.len() - 2;
    let clears = |side: usize, p: Point, q: Point| {
        // Most often all is on the inner side of where the wall starts or ends, and has nothing in common with it.
        if side == a.side && points[1..].iter().all(|&r| orientation(p, q, r) > 0.0) {
            return true;
        }
        if side == b.side && points[..=last].iter().all(|&r| orientation(p, q, r) > 0.0) {
            return true;
        }
        points.windows(2).enumerate().all(|(i, piece)| {
            // At the sides it joins the wall must stay on the inner side.
            if side == a.side && i == 0 {
                return orientation(p, q, piece[1]) > 0.0;
            }
            if side == b.side && i == last {
                return orientation(p, q, piece[0]) > 0.0;
            }
            !meet(piece[0], piece[1], p, q)
        })
    };
    let band = Band::of(points);
    let mut here = band.place(ring[0]);
    ring.windows(2).enumerate().all(|(side, ends)| {
        let before = here;
        here = band.place(ends[1]);
        let is_beside = before == here && here != Ordering::Equal && side != a.side && side != b.side;
        is_beside || clears(side, ends[0], ends[1])
    })
}

/// Whether two segments have a point in common; exact.
pub(super) fn meet(a: Point, b: Point, p: Point, q: Point) -> bool {
    let apart = |i: usize| a[i].max(b[i]) < p[i].min(q[i]) || p[i].max(q[i]) < a[i].min(b[i]);
    if apart(0) || apart(1) {
        return false;
    }
    let beside = |a: Point, b: Point, p: Point, q: Point| {
        let (s, t) = (orientation(a, b, p), orientation(a, b, q));
        (s > 0.0 && t > 0.0) || (s < 0.0 && t < 0.0)
    };
    !beside(a, b, p, q) && !beside(p, q, a, b)
}
