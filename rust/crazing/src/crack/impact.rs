//! An impact on glass: straight spokes first, then arcs between them, and new spokes where the old ones lie far apart.

use std::collections::VecDeque;

use super::aged::{Aged, by_age};
use super::fence::Fence;
use super::net::{NONE, Net};
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
/// On a torus spokes end before they meet their copies.
const OWN: f64 = 0.96;
/// There, how much nearer to the source than that they may end, as a part of the way.
const EARLY: f64 = 0.3;
/// Radians of arc a piece.
const PIECE: f64 = 0.2;
/// How far, as a part of the distance to the source, an arc is off at a spoke; less than half the step to the next.
const OFF: f64 = 0.1;
/// Arcs are as straight as they can be: their middle is nearer to the source by no more than this part of their distance,
/// which with what they are off at their ends is less than half the step to the next.
const SAG: f64 = 0.02;
/// An arc as long as this many sides of a piece is too long: a new spoke leaves its middle.
const LONG: f64 = 2.2;
/// How near the room about an edge comes to its neighbours.
const ROOM: f64 = 0.25;

/// What hits, and how finely it shatters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Impact {
    /// Where.
    pub source: Point,
    /// Speed, km/h: spokes grow as its square root.
    pub speed: f64,
    /// About how many pieces there are in the end.
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
}

/// Between two spokes, from a distance outward.
struct Wedge {
    spokes: [usize; 2],
    from: f64,
    /// Radians between the spokes.
    wide: f64,
}

struct Star {
    how: Impact,
    half: Option<Point>,
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
    ages: i32,
}

impl Star {
    fn of(bounds: Bounds, on_torus: bool, how: Impact, key: Key) -> Self {
        let [xmin, ymin, xmax, ymax] = bounds;
        let [x, y] = how.source;
        let size = [xmax - xmin, ymax - ymin];
        let corner = libm::hypot((x - xmin).abs().max((xmax - x).abs()), (y - ymin).abs().max((ymax - y).abs()));
        let half = on_torus.then(|| size.map(|side| OWN * side / 2.0));
        let reach = half.map_or(corner, |half| half[0].max(half[1]));
        let count = spokes(how.speed);
        let rings = (how.cells as f64 / (1.6 * count as f64)).max(2.0);
        let growth = libm::pow(1.0 / CRUSHED, 1.0 / rings).max(1.3);
        let side = LONG * reach * (std::f64::consts::PI / how.cells.max(1) as f64).sqrt();
        let rng = Rng::new(key, stream::IMPACT);
        let (points, spokes, wedges, arcs) = (vec![how.source], Vec::new(), VecDeque::new(), Vec::new());
        let mut star = Self { how, half, reach, growth, side, rng, points, spokes, wedges, arcs, ages: 0 };
        let (turn, gap) = (star.rng.unit(), std::f64::consts::TAU / count as f64);
        for i in 0..count {
            let angle = gap * (i as f64 + turn + 0.5 * (star.rng.unit() - 0.5));
            star.add_spoke(angle, (0.0, 0));
        }
        for i in 0..count {
            let next = (i + 1) % count;
            let wide = star.spokes[next].angle - star.spokes[i].angle;
            let wide = if wide > 0.0 { wide } else { wide + std::f64::consts::TAU };
            star.wedges.push_back(Wedge { spokes: [i, next], from: CRUSHED * star.reach, wide });
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
        let chance = self.normal();
        // A square of tips would show the tile: on a torus they lie within an ellipse, none as far as the next.
        let most = self.half.map_or(2.0 * self.reach, |half| {
            let far = 1.0 / libm::hypot(libm::cos(angle) / half[0], libm::sin(angle) / half[1]);
            far * (1.0 - EARLY * libm::exp(-chance.abs()))
        });
        // Two of three get all the way, the first ones all: one that ended would leave half of its side empty.
        let to = if chance > -0.43 || start.1 == 0 {
            most
        } else {
            start.0 + (self.reach.min(most) - start.0).max(0.0) * libm::exp(0.6 * chance)
        };
        self.spokes.push(Spoke { angle, to: to.min(most), age: self.ages, at: vec![start] });
        self.ages += 1;
        self.spokes.len() - 1
    }

    fn fill(&mut self, wedge: &Wedge) {
        let most = self.spokes[wedge.spokes[0]].to.min(self.spokes[wedge.spokes[1]].to).min(self.reach);
        let mut far = wedge.from;
        loop {
            // At least (1 + OFF) / (1 - OFF) times as far, so that arcs stay in order.
            far *= 1.25 + (self.growth - 1.25).max(0.0) * (0.4 + 1.2 * self.rng.unit());
            if far * (1.0 + OFF) >= most {
                return;
            }
            let wide = far * wedge.wide > (0.8 + 0.5 * self.rng.unit()) * self.side;
            let kept = self.rng.unit() < self.how.arcs * (1.0 - far / self.reach).max(0.0).sqrt();
            if wide {
                let (middle, angle) = self.arc(wedge, far, true);
                let spoke = self.add_spoke(angle, middle);
                let [a, b] = wedge.spokes;
                let wide = 0.5 * wedge.wide;
                self.wedges.push_back(Wedge { spokes: [a, spoke], from: far * (1.0 + OFF), wide });
                self.wedges.push_back(Wedge { spokes: [spoke, b], from: far * (1.0 + OFF), wide });
                return;
            }
            if kept {
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

    fn finish(mut self) -> Aged {
        let (mut net, mut fence, mut age) = (Net::default(), Fence::default(), Vec::new());
        let mut lines = Vec::new();
        for i in 0..self.spokes.len() {
            let (angle, to) = (self.spokes[i].angle, self.spokes[i].to);
            let mut at = std::mem::take(&mut self.spokes[i].at);
            at.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            if at.last().is_some_and(|&(far, _)| far < to) {
                let tip = self.add_point(angle, to);
                at.push((to, tip));
            }
            lines.push((at.into_iter().map(|(_, vertex)| vertex).collect::<Vec<i32>>(), self.spokes[i].age));
        }
        lines.extend(self.arcs.iter().map(|(line, age, _)| (line.clone(), *age)));
        let narrowest = self.narrowest();
        for (line, born) in lines {
            for pair in line.windows(2) {
                net.edges.push([pair[0], pair[1]]);
                age.push(born);
            }
        }
        net.vertices = self.points;
        net.cut = vec![false; net.vertices.len()];
        for &[a, b] in &net.edges {
            let first = (net.vertices.len() + fence.anchors.len()) as i32;
            fence.anchors.extend(self::room(
                net.vertices[a as usize],
                net.vertices[b as usize],
                self.how.source,
                narrowest,
            ));
            fence.kites.push([a, b, first, first + 1]);
        }
        if let Some(half) = self.half {
            net.period = half.map(|side| 2.0 * side / OWN);
            net.shifts = vec![[0, 0]; net.edges.len()];
            fence.shifts = vec![[0; 6]; net.edges.len()];
        }
        let partner = by_age(&net, &age);
        Aged { net, fence, partner, age }
    }

    /// The least angle between neighbouring spokes.
    fn narrowest(&self) -> f64 {
        self.arcs.iter().map(|(_, _, wide)| *wide).fold(std::f64::consts::PI, f64::min)
    }
}

/// A place to the left and one to the right of an edge, nearer than any other edge: neighbours leave its ends at about
/// a right angle, other spokes are an angle away, other arcs a part of the distance to the source.
fn room(a: Point, b: Point, source: Point, narrowest: f64) -> [Point; 2] {
    let (x, y) = (b[0] - a[0], b[1] - a[1]);
    let middle = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
    let far = libm::hypot(middle[0] - source[0], middle[1] - source[1]);
    let most = ROOM * libm::hypot(x, y).min(far * narrowest).min(OFF * far);
    let part = most / libm::hypot(x, y).max(f64::MIN_POSITIVE);
    [[middle[0] - part * y, middle[1] + part * x], [middle[0] + part * y, middle[1] - part * x]]
}
