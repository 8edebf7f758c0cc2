//! On a torus, spokes that got all the way grow on until they meet the cracks about a copy of their source.
//!
//! All grow as fast, so of two that cross the one that comes later stops: a motorcycle graph. What was there before
//! they grew on stops all.
//!
//! # Source
//! Eppstein, Erickson: Raising Roofs, Crashing Cycles, and Playing Pool (1999), for the graph.

use super::Star;
use crate::graph::Point;
use crate::parallel;

/// No more spokes than this grow on, the oldest.
const GROWING: usize = 48;
/// They grow no farther than the longer side of the period, nor than so many of the shorter.
const SLENDER: f64 = 8.0;
/// A crack is met no nearer to the ends of its edges than this part of them.
const BESIDE: f64 = 1e-3;

/// An edge that was there before.
struct Wall {
    owner: Owner,
    ends: [Point; 2],
}

#[derive(Clone, Copy)]
enum Owner {
    /// A spoke, from one distance of the source to another.
    Spoke(usize, [f64; 2]),
    /// An arc, and which of its edges.
    Arc(usize, usize),
    /// A spoke where it has grown on.
    Growing(usize),
}

/// Where a spoke meets a crack of a copy.
#[derive(Clone, Copy)]
struct Meeting {
    /// How far from the source.
    far: f64,
    owner: Owner,
    /// Which part of the edge, or how far from its source if that grows, too.
    part: f64,
    /// Where, on an edge that was there before, in the period about its source.
    place: Point,
    copy: [i8; 2],
}

/// A spoke that grows.
struct Ray {
    spoke: usize,
    from: f64,
    along: Point,
}

impl Star {
    /// Lets spokes grow on. Their lines end at vertices of others then.
    pub(super) fn grow_on(&mut self, period: Point) {
        let [short, long] = [period[0].min(period[1]), period[0].max(period[1])];
        let most = long.min(SLENDER * short);
        let reached = |spoke: &usize| self.spokes[*spoke].reaches && self.spokes[*spoke].to < most;
        let rays: Vec<Ray> = (0..self.spokes.len()).filter(reached).take(GROWING).map(|k| self.ray(k)).collect();
        let walls = self.walls();
        let around = period.map(|side| (2.0 * most / side).ceil() as i8);
        let copies: Vec<[i8; 2]> = (-around[0]..=around[0])
            .flat_map(|x| (-around[1]..=around[1]).map(move |y| [x, y]))
            .filter(|copy| *copy != [0, 0])
            .collect();
        let offset = |copy: [i8; 2]| [f64::from(copy[0]) * period[0], f64::from(copy[1]) * period[1]];
        let at_walls: Vec<Option<Meeting>> = parallel::several(rays.len(), |k| {
            let of_copy = |&copy: &[i8; 2]| self.nearest_wall(&rays[k], &walls, offset(copy), copy);
            copies.iter().filter_map(of_copy).filter(|found| found.far < most).min_by(|a, b| a.far.total_cmp(&b.far))
        });
        let mut meetings = Vec::new();
        for (k, ray) in rays.iter().enumerate() {
            for (other, near) in rays.iter().enumerate() {
                for &copy in &copies {
                    if let Some([far, by]) = crossing(ray.along, near.along, offset(copy))
                        && far > ray.from
                        && by > near.from
                        && (by, other) < (far, k)
                    {
                        let owner = Owner::Growing(near.spoke);
                        meetings.push((k, other, Meeting { far, owner, part: by, place: [0.0; 2], copy }));
                    }
                }
            }
        }
        meetings.sort_by(|a, b| a.2.far.total_cmp(&b.2.far));
        let mut ends: Vec<(f64, Option<Meeting>)> =
            at_walls.into_iter().map(|found| (found.map_or(most, |found| found.far), found)).collect();
        for (k, other, meeting) in meetings {
            if meeting.far < ends[k].0 && meeting.part <= ends[other].0 {
                ends[k] = (meeting.far, Some(meeting));
            }
        }
        let low = [0, 1].map(|i| self.how.source[i] - period[i] / 2.0);
        self.join(&rays, &ends, Tile { low, period });
    }

    fn ray(&self, spoke: usize) -> Ray {
        let angle = self.spokes[spoke].angle;
        Ray { spoke, from: self.spokes[spoke].to, along: [libm::cos(angle), libm::sin(angle)] }
    }

    /// All edges as they are.
    fn walls(&self) -> Vec<Wall> {
        let mut walls = Vec::new();
        for (k, spoke) in self.spokes.iter().enumerate() {
            let mut at: Vec<(f64, Point)> =
                spoke.at.iter().map(|&(far, vertex)| (far, self.points[vertex as usize])).collect();
            at.sort_by(|a, b| a.0.total_cmp(&b.0));
            at.push((spoke.to, self.place(spoke.angle, spoke.to)));
            let pairs = at.windows(2).filter(|pair| pair[0].0 < pair[1].0);
            walls.extend(
                pairs.map(|pair| Wall { owner: Owner::Spoke(k, [pair[0].0, pair[1].0]), ends: [pair[0].1, pair[1].1] }),
            );
        }
        for (k, (line, _, _)) in self.arcs.iter().enumerate() {
            let ends = line.windows(2).map(|pair| [0, 1].map(|i| self.points[pair[i] as usize]));
            walls.extend(ends.enumerate().map(|(nth, ends)| Wall { owner: Owner::Arc(k, nth), ends }));
        }
        walls
    }

    /// The first of some edges, all moved, that a ray meets beyond where it is.
    fn nearest_wall(&self, ray: &Ray, walls: &[Wall], offset: Point, copy: [i8; 2]) -> Option<Meeting> {
        let [x, y] = self.how.source;
        // Along the ray, and across it to the left.
        let seen = |p: Point| {
            let (dx, dy) = (p[0] + offset[0] - x, p[1] + offset[1] - y);
            [dx * ray.along[0] + dy * ray.along[1], dy * ray.along[0] - dx * ray.along[1]]
        };
        let mut found: Option<Meeting> = None;
        for wall in walls {
            let [a, b] = wall.ends.map(seen);
            if (a[1] > 0.0) == (b[1] > 0.0) {
                continue;
            }
            let part = a[1] / (a[1] - b[1]);
            let far = a[0] + part * (b[0] - a[0]);
            if far > ray.from && found.is_none_or(|found| far < found.far) {
                let part = part.clamp(BESIDE, 1.0 - BESIDE);
                let place = [0, 1].map(|i| wall.ends[0][i] + part * (wall.ends[1][i] - wall.ends[0][i]));
                found = Some(Meeting { far, owner: wall.owner, part, place, copy });
            }
        }
        found
    }

    /// Adds the vertices where rays end, to those they meet and to themselves, and where they leave a period about the
    /// source.
    fn join(&mut self, rays: &[Ray], ends: &[(f64, Option<Meeting>)], tile: Tile) {
        let mut on_arcs = Vec::new();
        for (ray, &(far, meeting)) in rays.iter().zip(ends) {
            for (far, place, frame) in tile.left(self.how.source, ray, far) {
                let vertex = self.add(place);
                self.spokes[ray.spoke].beyond.push((far, vertex, frame));
            }
            let (vertex, frame) = match meeting {
                None => {
                    let (place, frame) = tile.within(self.place(self.spokes[ray.spoke].angle, far));
                    (self.add(place), frame)
                }
                Some(Meeting { owner: Owner::Growing(other), part, copy, .. }) => {
                    let (place, frame) = tile.within(self.place(self.spokes[other].angle, part));
                    let vertex = self.add(place);
                    self.spokes[other].beyond.push((part, vertex, frame));
                    (vertex, [copy[0] + frame[0], copy[1] + frame[1]])
                }
                Some(Meeting { owner: Owner::Spoke(other, [from, to]), part, place, copy, .. }) => {
                    let vertex = self.add(place);
                    self.spokes[other].at.push((from + part * (to - from), vertex));
                    (vertex, copy)
                }
                Some(Meeting { owner: Owner::Arc(arc, nth), part, place, copy, .. }) => {
                    let vertex = self.add(place);
                    on_arcs.push((arc, nth, part, vertex));
                    (vertex, copy)
                }
            };
            self.spokes[ray.spoke].beyond.push((far, vertex, frame));
        }
        // From the last: places of those before stay as they are.
        on_arcs.sort_by(|a, b| (b.0, b.1).cmp(&(a.0, a.1)).then(b.2.total_cmp(&a.2)));
        for (arc, nth, _, vertex) in on_arcs {
            self.arcs[arc].0.insert(nth + 1, vertex);
        }
    }

    fn add(&mut self, place: Point) -> i32 {
        self.points.push(place);
        self.points.len() as i32 - 1
    }
}

/// The period about the source.
#[derive(Clone, Copy)]
struct Tile {
    low: Point,
    period: Point,
}

impl Tile {
    /// A place moved into it, and the periods it was away.
    fn within(self, p: Point) -> (Point, [i8; 2]) {
        let frame = [0, 1].map(|i| ((p[i] - self.low[i]) / self.period[i]).floor());
        (self.moved(p, frame), frame.map(|turns| turns as i8))
    }

    fn moved(self, p: Point, frame: Point) -> Point {
        [0, 1].map(|i| {
            let high = (self.low[i] + self.period[i]).next_down();
            (p[i] - frame[i] * self.period[i]).clamp(self.low[i], high)
        })
    }

    /// Where a ray crosses sides of copies of the period on its way: how far from the source, the place on the left or
    /// lower side, and the copy that this is the side of.
    fn left(self, source: Point, ray: &Ray, to: f64) -> Vec<(f64, Point, [i8; 2])> {
        let mut found = Vec::new();
        for axis in [0, 1] {
            let step = ray.along[axis].signum();
            let first = if step > 0.0 { 1.0 } else { 0.0 };
            for nth in 0..i8::MAX {
                let side = first + step * f64::from(nth);
                let far = (self.low[axis] + side * self.period[axis] - source[axis]) / ray.along[axis];
                if far.is_nan() || far >= to {
                    break;
                }
                if far > ray.from {
                    let p = [0, 1].map(|i| source[i] + far * ray.along[i]);
                    let mut frame = [0, 1].map(|i| ((p[i] - self.low[i]) / self.period[i]).floor());
                    frame[axis] = side;
                    let mut place = self.moved(p, frame);
                    place[axis] = self.low[axis];
                    found.push((far, place, frame.map(|turns| turns as i8)));
                }
            }
        }
        found
    }
}

/// How far two rays from one source have come where they cross, the second moved by an offset.
fn crossing(ray: Point, other: Point, offset: Point) -> Option<[f64; 2]> {
    let cross = |a: Point, b: Point| a[0] * b[1] - a[1] * b[0];
    let turn = cross(ray, other);
    (turn != 0.0).then(|| [cross(offset, other) / turn, cross(offset, ray) / turn])
}
