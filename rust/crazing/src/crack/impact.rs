//! An impact on glass: straight spokes first, then arcs between them, and new spokes where the old ones lie far apart.

mod aside;
mod drawn;
mod meet;
mod parting;
mod room;

use std::collections::VecDeque;

use super::aged::Aged;
use super::net::NONE;
use crate::clip::{Bounds, check_bounds};
use crate::error::{Error, Result};
use crate::graph::Point;
use crate::quantile;
use crate::rng::{Key, Rng, open_unit, stream};
use crate::watch::Watch;

/// Speed of the impact in km/h, and the spokes it made in 1 mm acrylic: Vandenberghe 2013.
const MEASURED: [f64; 2] = [70.0, 4.0];
/// The first arcs lie this near, the last no farther than the whole reach.
const CRUSHED: f64 = 0.025;
/// On a torus no crack leaves the period about the source before spokes grow on.
const OWN: f64 = 0.96;
/// There, how much nearer to the source than that they may end, as a part of the way.
const EARLY: f64 = 0.3;
/// The narrowest and the widest angle between the first spokes, before they are scaled to a full turn.
const GAPS: [f64; 2] = [0.45, 1.75];
/// Two of three later spokes get all the way: those that draw more than minus this.
const ENDS: f64 = 0.43;
/// Radians of arc a piece.
const PIECE: f64 = 0.2;
/// How far, as a part of the distance to the source, an arc is off at a spoke.
const OFF: f64 = 0.12;
/// Arcs are as straight as they can be: their middle is nearer to the source by no more than this part of their
/// distance.
const SAG: f64 = 0.06;
/// The next arc of a wedge is at least this many times as far: more than (1 + OFF) / (1 - OFF - SAG), so that arcs stay
/// in order.
const STEP: f64 = 1.4;
/// An arc as long as this many sides of a piece is too long: a new spoke leaves its middle, or a spoke forks.
const LONG: f64 = 2.2;
/// The crushed zone: within this part of the reach a piece is broken up by a short spoke, as often as this.
const CORE: f64 = 0.16;
const CHIPPED: f64 = 0.6;

/// What hits, and how finely it shatters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Impact {
    /// Where.
    pub source: Point,
    /// Speed, km/h: spokes grow as its square root.
    pub speed: f64,
    /// The more, the finer the pieces; some hundreds at most.
    pub cells: usize,
    /// The share of arcs that are there near the source; fewer farther out.
    pub arcs: f64,
}

/// The number of spokes at a speed: 4 at 70 km/h, 8 at 280 km/h.
///
/// # Source
/// Vandenberghe, Vermorel, Villermaux: Star-Shaped Crack Pattern of Broken Windows (PRL 2013).
pub fn spokes(speed: f64) -> usize {
    let [measured, count] = MEASURED;
    (count * (speed / measured).sqrt()).round().clamp(2.0, 4096.0) as usize
}

/// Spokes and arcs about an impact, within bounds or on a torus.
///
/// # Errors
/// [`Error::BadValue`], [`Error::Interrupted`].
pub fn impact(bounds: Bounds, on_torus: bool, how: Impact, key: Key, watch: Watch<'_>) -> Result<Aged> {
    check_bounds(bounds)?;
    for (name, value) in [("speed", how.speed), ("source", how.source[0]), ("source", how.source[1])] {
        if !value.is_finite() || (name == "speed" && value <= 0.0) {
            return Err(Error::BadValue { name, value, wanted: "a finite number, of speed a positive one, is wanted" });
        }
    }
    let mut star = Star::of(bounds, on_torus, how, key);
    while let Some(wedge) = star.wedges.pop_front() {
        watch.poll_at(star.ages as usize)?;
        star.fill(&wedge);
    }
    let aged = star.finish();
    if on_torus { Ok(aged) } else { aged.trimmed(bounds) }
}

struct Spoke {
    angle: f64,
    /// Distance from the source at its ends.
    to: f64,
    age: i32,
    /// The vertices along it, by distance.
    at: Vec<(f64, i32)>,
    /// Whether it gets as far as it can.
    reaches: bool,
    /// The vertices where it has grown on, by distance, and the copy of the period about the source that each is in.
    beyond: Vec<(f64, i32, [i8; 2])>,
}

/// Between two spokes, from a distance outward.
struct Wedge {
    spokes: [usize; 2],
    from: f64,
    /// Where it ends, if a younger crack closes it.
    to: f64,
    /// Radians between the spokes.
    wide: f64,
    /// The share of arcs between these two, of what there are on average.
    busy: f64,
}

struct Star {
    how: Impact,
    /// What is repeated, on a torus.
    period: Option<Point>,
    reach: f64,
    /// Each arc is about this many times as far as the one before.
    growth: f64,
    /// An arc about this long is too long.
    side: f64,
    rng: Rng,
    points: Vec<Point>,
    spokes: Vec<Spoke>,
    wedges: VecDeque<Wedge>,
    arcs: Vec<(Vec<i32>, i32, f64)>,
    /// Vertices where a spoke forks, and the radians between the two.
    forks: Vec<(i32, f64)>,
    ages: i32,
}

impl Star {
    fn of(bounds: Bounds, on_torus: bool, how: Impact, key: Key) -> Self {
        let [xmin, ymin, xmax, ymax] = bounds;
        let [x, y] = how.source;
        let size = [xmax - xmin, ymax - ymin];
        let corner = libm::hypot((x - xmin).abs().max((xmax - x).abs()), (y - ymin).abs().max((ymax - y).abs()));
        let period = on_torus.then_some(size);
        let reach = period.map_or(corner, |[wide, high]| OWN * wide.max(high) / 2.0);
        let count = spokes(how.speed);
        let rings = (how.cells as f64 / (1.6 * count as f64)).max(2.0);
        let growth = libm::pow(1.0 / CRUSHED, 1.0 / rings).max(1.3);
        let side = LONG * reach * (std::f64::consts::PI / how.cells.max(1) as f64).sqrt();
        let rng = Rng::new(key, stream::IMPACT);
        let mut star = Self {
            how,
            period,
            reach,
            growth,
            side,
            rng,
            points: vec![how.source],
            spokes: Vec::new(),
            wedges: VecDeque::new(),
            arcs: Vec::new(),
            forks: Vec::new(),
            ages: 0,
        };
        let gaps: Vec<f64> = (0..count).map(|_| GAPS[0] + (GAPS[1] - GAPS[0]) * star.rng.unit()).collect();
        let scale = std::f64::consts::TAU / gaps.iter().sum::<f64>();
        let mut angle = std::f64::consts::TAU * star.rng.unit();
        if on_torus {
            angle -= aside::clearest(&gaps, angle, scale);
        }
        for gap in &gaps {
            star.add_spoke(angle, (0.0, 0));
            angle += scale * gap;
        }
        for (i, gap) in gaps.into_iter().enumerate() {
            let from = CRUSHED * star.reach * (0.5 + star.rng.unit());
            let busy = star.rng.unit();
            let spokes = [i, (i + 1) % count];
            star.wedges.push_back(Wedge { spokes, from, to: f64::INFINITY, wide: scale * gap, busy: 0.3 + 1.4 * busy });
        }
        star
    }

    fn normal(&mut self) -> f64 {
        quantile::normal(open_unit(self.rng.next_u64()))
    }

    fn place(&self, angle: f64, far: f64) -> Point {
        [self.how.source[0] + far * libm::cos(angle), self.how.source[1] + far * libm::sin(angle)]
    }

    fn add_point(&mut self, angle: f64, far: f64) -> i32 {
        let place = self.place(angle, far);
        self.points.push(place);
        self.points.len() as i32 - 1
    }

    /// A spoke from a vertex outward; some reach the bounds, others end on the way.
    fn add_spoke(&mut self, angle: f64, start: (f64, i32)) -> usize {
        let mut chance = self.normal();
        if self.period.is_some() && start.1 != 0 && aside::is_along(angle) {
            chance = -chance.abs() - ENDS;
        }
        // A square of tips would show the tile: on a torus they lie within an ellipse, none as far as the next.
        let most = self.period.map_or(2.0 * self.reach, |[wide, high]| {
            let far = OWN / (2.0 * libm::hypot(libm::cos(angle) / wide, libm::sin(angle) / high));
            far * (1.0 - EARLY * libm::exp(-chance.abs()))
        });
        // Two of three get all the way, the first ones all: one that ended would leave half of its side empty.
        let reaches = chance > -ENDS || start.1 == 0;
        let to =
            if reaches { most } else { start.0 + (self.reach.min(most) - start.0).max(0.0) * libm::exp(0.6 * chance) };
        self.spokes.push(Spoke {
            angle,
            to: to.min(most),
            age: self.ages,
            at: vec![start],
            reaches,
            beyond: Vec::new(),
        });
        self.ages += 1;
        self.spokes.len() - 1
    }

    fn fill(&mut self, wedge: &Wedge) {
        let [a, b] = wedge.spokes;
        let most = self.spokes[a].to.min(self.spokes[b].to).min(self.reach).min(wedge.to);
        let mut far = wedge.from;
        loop {
            far *= STEP
                + (self.growth - STEP).max(0.0) * self.rng.unit()
                + 0.2 * -libm::log(open_unit(self.rng.next_u64()));
            if far * (1.0 + OFF) >= most {
                return;
            }
            let is_wide = far * wedge.wide > (0.8 + 0.5 * self.rng.unit()) * self.side;
            let share = self.how.arcs * wedge.busy * (1.0 - far / self.reach).max(0.0).sqrt();
            let (is_kept, is_chipped) = (self.rng.unit() < share, self.rng.unit() < CHIPPED * self.how.arcs);
            // A spoke would run on through what closes a wedge.
            if is_wide && wedge.to.is_infinite() {
                return self.part(wedge, far, most);
            }
            if far < CORE * self.reach && is_chipped && self.chip(wedge, far, most) {
                return;
            }
            if is_kept {
                self.arc(wedge, far, false);
            }
        }
    }

    /// An arc across a wedge; its middle vertex, and the angle it lies at.
    fn arc(&mut self, wedge: &Wedge, far: f64, even: bool) -> ((f64, i32), f64) {
        let ends = [0; 2].map(|_| far * (1.0 + OFF * (2.0 * self.rng.unit() - 1.0)));
        let mut pieces = (wedge.wide / PIECE).ceil().max(1.0) as usize;
        if even {
            pieces += pieces % 2;
        }
        let from = self.spokes[wedge.spokes[0]].angle;
        let half = 0.5 * wedge.wide.min(2.0);
        // The part of the way from a circle to its chord.
        let flat = (SAG / (1.0 - libm::cos(half)).max(f64::MIN_POSITIVE)).min(1.0);
        let mut line = Vec::new();
        let mut middle = ((far, NONE), from);
        for i in 0..=pieces {
            let part = i as f64 / pieces as f64;
            let (angle, far) = (from + part * wedge.wide, ends[0] + part * (ends[1] - ends[0]));
            let chord = libm::cos(half) / libm::cos(half * (2.0 * part - 1.0));
            let far = far * (1.0 - flat + flat * chord);
            let vertex = self.add_point(angle, far);
            line.push(vertex);
            if 2 * i == pieces {
                middle = ((far, vertex), angle);
            }
            if i == 0 || i == pieces {
                self.spokes[wedge.spokes[usize::from(i > 0)]].at.push((far, vertex));
            }
        }
        self.arcs.push((line, self.ages, wedge.wide));
        self.ages += 1;
        middle
    }
}
