//! The first two cracks of a torus, which has no outline that a crack could run across: one closes on itself around the
//! period, the other runs from it to itself the other way.

use super::chord::{self, Hit};
use super::{Splitting, normal};
use crate::graph::Point;
use crate::predicates::orientation;
use crate::rng::Rng;

/// Ways around, in periods, and what leads from one turn of them to the next, on their left.
const WAYS: [[[i32; 2]; 2]; 4] = [[[1, 0], [0, 1]], [[0, 1], [-1, 0]], [[1, 1], [0, 1]], [[1, -1], [0, 1]]];
/// Standard deviation of the logarithm of the length by which one of them is chosen.
const CHOICE: f64 = 0.3;
/// Waves along the first crack, one more in each than in the one before: standard deviations in parts of the way between
/// two of its turns, where walls bend all the way. They fall as those of a line of Hurst exponent .7 do: with a long one
/// far above the others the crack is a sine, and every tile shows it.
const WAVES: [f64; 6] = [0.028, 0.013, 0.006, 0.003, 0.0016, 0.0009];
/// Pieces of it between the ends of the second.
const PIECES: usize = 16;
/// Where a period is so many times as long as wide, pieces of the second crack are cut into more: a wall across the narrow
/// way would else join one of them to itself. And arcs and waves, which grow with the length, are those of one so many
/// times as long: the middle of what lies between the cracks would else lie outside.
const LONG: f64 = 6.0;
const ARC: f64 = 3.0;
/// No more pieces than this of each: what is longer is no period that anybody fills.
const MOST: usize = 1 << 12;
/// How far from opposite each other the ends of the second crack are, in parts of the first: at least, and at most.
const ASIDE: [f64; 2] = [0.12, 0.3];

/// The first crack of a torus from a vertex around to itself, and the second from vertex 0 of it to vertex `PIECES`.
pub(super) struct Founders {
    /// Unwrapped, from the vertex that the second crack leaves.
    pub(super) ring: Vec<Point>,
    /// The periods that the first crack goes around.
    pub(super) way: [i32; 2],
    /// The inner vertices of the second.
    pub(super) across: Vec<Point>,
    /// The periods from `ring[PIECES]` to where the second ends.
    pub(super) shift: [i32; 2],
}

impl Founders {
    /// Where on the ring the second crack ends.
    pub(super) const END: usize = PIECES;

    /// For the period of a torus whose origin is at `corner`.
    pub(super) fn of(corner: Point, period: Point, how: Splitting, rng: &mut Rng) -> Self {
        let [way, next] = way(period, how, rng);
        let [along, over] = [way, next].map(|turns| [0, 1].map(|i| f64::from(turns[i]) * period[i]));
        let square = square_of(along);
        let long = (square_of(over).max(square) / square_of(over).min(square)).sqrt();
        let bend = if long > LONG { how.bend * ARC / long } else { how.bend };
        let origin = [0, 1].map(|i| corner[i] + period[i] * rng.unit());
        let waves = WAVES.map(|size| [bend * size * normal(rng), rng.unit()]);
        let aside = ASIDE[0] + (ASIDE[1] - ASIDE[0]) * rng.unit();
        let aside = if rng.unit() < 0.5 { aside } else { -aside };
        // Opposite in the frame of the first crack, and so much aside.
        let end = aside - (over[0] * along[0] + over[1] * along[1]) / square;
        let turns = end.floor();
        let shift = [0, 1].map(|i| next[i] + turns as i32 * way[i]);
        let part = end - turns;
        let at = |t: f64, size: f64| {
            let wave = |(k, [high, phase]): (usize, &[f64; 2])| {
                high * libm::sin(std::f64::consts::TAU * ((k + 1) as f64 * t + phase))
            };
            // Across by so much of the way to the next turn.
            let off =
                size * waves.iter().enumerate().map(wave).sum::<f64>() * (over[1] * along[0] - over[0] * along[1])
                    / square;
            [origin[0] + t * along[0] - off * along[1], origin[1] + t * along[1] + off * along[0]]
        };
        let place = |i: usize| {
            let (i, pieces) = (i as f64, PIECES as f64);
            if i <= pieces { part * i / pieces } else { part + (1.0 - part) * (i - pieces) / pieces }
        };
        let drawn = |size: f64, bend: f64| {
            let ring: Vec<Point> = (0..2 * PIECES).map(|i| at(place(i), size)).collect();
            let moved = |p: Point| [0, 1].map(|i| p[i] + f64::from(shift[i]) * period[i]);
            let sides = [ring[0], ring[1], moved(ring[PIECES + 1]), moved(ring[PIECES])];
            let line = chord::curve(&sides, [Hit { side: 0, at: sides[0] }, Hit { side: 2, at: sides[3] }], bend);
            let line = match *line.points() {
                [a, b] => pieces([a, b]),
                ref bent => bent.to_vec(),
            };
            (is_free(&ring, &line, along), ring, line)
        };
        // The less it bends the surer the second crack has room; straight ones always have.
        let bends = [(1.0, bend), (0.5, bend / 2.0)];
        let fitting = bends.into_iter().map(|(size, bend)| drawn(size, bend)).find(|(is_free, ..)| *is_free);
        let (_, ring, line) = fitting.unwrap_or_else(|| drawn(0.0, 0.0));
        let line = if long > LONG { finer(&line, ((long / 2.0).ceil() as usize).min(MOST)) } else { line };
        Self { ring, way, across: line[1..line.len() - 1].to_vec(), shift }
    }
}

/// A straight line in pieces: a wall that joined its two turns would else join one edge to itself.
fn pieces(ends: [Point; 2]) -> Vec<Point> {
    finer(&ends, PIECES)
}

/// The same line, every piece of it in so many.
fn finer(line: &[Point], parts: usize) -> Vec<Point> {
    let part = |i: usize| i as f64 / parts as f64;
    let own = |ends: &[Point]| {
        let (a, b) = (ends[0], ends[1]);
        (0..parts).map(move |i| if i == 0 { a } else { [0, 1].map(|k| a[k] + part(i) * (b[k] - a[k])) })
    };
    line.windows(2).flat_map(own).chain(line.last().copied()).collect()
}

fn square_of([x, y]: Point) -> f64 {
    x * x + y * y
}

/// The way around that is the shortest where cells are as long as wide, but for chance.
fn way(period: Point, how: Splitting, rng: &mut Rng) -> [[i32; 2]; 2] {
    let (sin, cos) = (libm::sin(how.angle), libm::cos(how.angle));
    let mut best = (f64::INFINITY, WAYS[0]);
    for each in WAYS {
        let [x, y] = [0, 1].map(|i| f64::from(each[0][i]) * period[i]);
        let (u, v) = ((cos * x + sin * y) / how.anisotropy, cos * y - sin * x);
        let length = libm::hypot(u, v) * libm::exp(CHOICE * normal(rng));
        if length < best.0 {
            best = (length, each);
        }
    }
    best.1
}

/// Whether a line between two turns of a ring meets none of them but at its ends.
fn is_free(ring: &[Point], line: &[Point], along: Point) -> bool {
    let last = line.len() - 2;
    let over = [0, 1].map(|i| line[last + 1][i] - ring[PIECES][i]);
    let turns = (-2..=2).flat_map(|turn| [(turn, false), (turn, true)]);
    turns.flat_map(|turn| (0..ring.len()).map(move |i| (turn, i))).all(|((turn, is_end), i)| {
        let off = [0, 1].map(|k| f64::from(turn) * along[k] + if is_end { over[k] } else { 0.0 });
        let is_last = i + 1 == ring.len();
        let next = if is_last { [ring[0][0] + along[0], ring[0][1] + along[1]] } else { ring[i + 1] };
        let [p, q] = [ring[i], next].map(|p| [p[0] + off[0], p[1] + off[1]]);
        // The pieces about the vertices that it joins: it stays on their inner side.
        let is_start = !is_end && ((turn == 0 && i == 0) || (turn == -1 && is_last));
        let is_goal = is_end && turn == 0 && (i == PIECES || i + 1 == PIECES);
        line.windows(2).enumerate().all(|(k, piece)| {
            if is_start && k == 0 {
                orientation(p, q, piece[1]) > 0.0
            } else if is_goal && k == last {
                orientation(p, q, piece[0]) < 0.0
            } else {
                !chord::meet(piece[0], piece[1], p, q)
            }
        })
    })
}
