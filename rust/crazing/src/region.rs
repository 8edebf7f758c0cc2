//! A polygon with holes, by the even-odd rule, and what of a drawing lies in it.

use crate::error::{Error, Result};
use crate::graph::{PlanarGraph, Point};
use crate::predicates::orientation;
use crate::watch::Watch;

/// The sides of one or more rings, in a grid.
#[derive(Debug)]
pub struct Region {
    sides: Vec<[Point; 2]>,
    low: Point,
    step: Point,
    /// Squares of the grid along each axis.
    count: usize,
    /// Sides that may meet each square, row by row.
    met: Vec<Vec<u32>>,
    /// Whether the middle of each square is inside.
    inside: Vec<bool>,
}

/// What of a drawing is inside.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Parts {
    /// The vertices given, then those on the outline where an edge was cut.
    pub graph: PlanarGraph,
    /// The edge that each part comes from.
    pub rows: Vec<i32>,
    /// Whether an edge was cut by the outline.
    pub cut: Vec<bool>,
}

/// Most squares along an axis: beyond it memory grows and nothing is won.
const MOST_SQUARES: usize = 512;

impl Region {
    /// Ring `i` is `coords[offsets[i]..offsets[i + 1]]`, its last point joined to its first.
    ///
    /// # Errors
    /// [`Error::BadIndex`] for offsets that do not rise within `coords`; [`Error::NotFinite`]; [`Error::BadValue`] for
    /// a region without an extent; [`Error::Interrupted`].
    pub fn of(coords: &[Point], offsets: &[i64], watch: Watch<'_>) -> Result<Self> {
        if let Some(row) = coords.iter().position(|p| !(p[0].abs() < 1e150 && p[1].abs() < 1e150)) {
            return Err(Error::NotFinite { row, x: coords[row][0], y: coords[row][1] });
        }
        let sides = sides(coords, offsets)?;
        let (low, high) = extent(coords);
        let count = ((sides.len() as f64).sqrt() as usize * 2).clamp(1, MOST_SQUARES);
        let step = [0, 1].map(|i| (high[i] - low[i]) / count as f64);
        if !(step[0] > 0.0 && step[1] > 0.0) {
            let wanted = "a positive width and height are wanted";
            return Err(Error::BadValue { name: "the extent of the region", value: step[0].min(step[1]), wanted });
        }
        let met = vec![Vec::new(); count * count];
        let mut region = Self { sides, low, step, count, met, inside: vec![false; count * count] };
        region.register();
        region.colour(watch)?;
        Ok(region)
    }

    /// Number of the square along one axis, those beyond the grid brought to its rim.
    fn square(&self, x: f64, axis: usize) -> usize {
        let at = (x - self.low[axis]) / self.step[axis];
        (at.max(0.0) as usize).min(self.count - 1)
    }

    /// Squares that the box around two points may meet, with room for rounding.
    fn squares(&self, [a, b]: [Point; 2]) -> impl Iterator<Item = usize> + use<> {
        let range = |axis: usize| {
            let room = 1e-9 * self.step[axis];
            self.square(a[axis].min(b[axis]) - room, axis)..=self.square(a[axis].max(b[axis]) + room, axis)
        };
        let (columns, rows, count) = (range(0), range(1), self.count);
        rows.flat_map(move |row| columns.clone().map(move |column| row * count + column))
    }

    fn register(&mut self) {
        for (k, &side) in self.sides.iter().enumerate() {
            for square in self.squares(side) {
                self.met[square].push(k as u32);
            }
        }
    }

    fn middle(&self, square: usize) -> Point {
        let at = [square % self.count, square / self.count];
        [0, 1].map(|i| self.low[i] + (at[i] as f64 + 0.5) * self.step[i])
    }

    /// Colours the middles of the squares, each by the sides between it and the one before.
    fn colour(&mut self, watch: Watch<'_>) -> Result<()> {
        for square in 0..self.inside.len() {
            watch.poll_at(square)?;
            let middle = self.middle(square);
            let is_first = square % self.count == 0;
            let (before, from) = if is_first {
                (false, [self.low[0] - self.step[0], middle[1]])
            } else {
                (self.inside[square - 1], self.middle(square - 1))
            };
            self.inside[square] = before ^ (self.crossings(from, middle).len() % 2 == 1);
        }
        Ok(())
    }

    /// Whether a point is inside; on the outline, either may be found.
    pub fn contains(&self, p: Point) -> bool {
        let within = |i: usize| p[i] >= self.low[i] && p[i] <= self.low[i] + self.step[i] * self.count as f64;
        if !(within(0) && within(1)) {
            return false;
        }
        let square = self.square(p[1], 1) * self.count + self.square(p[0], 0);
        self.inside[square] ^ (self.crossings(p, self.middle(square)).len() % 2 == 1)
    }

    /// Where the way from `a` to `b` crosses the outline, as parts of the way, in order. Signs are exact: the number of
    /// crossings is right for the points as given.
    fn crossings(&self, a: Point, b: Point) -> Vec<f64> {
        let mut near: Vec<u32> = self.squares([a, b]).flat_map(|square| self.met[square].iter().copied()).collect();
        near.sort_unstable();
        near.dedup();
        let mut found: Vec<f64> = near.into_iter().filter_map(|k| crossing([a, b], self.sides[k as usize])).collect();
        found.sort_by(f64::total_cmp);
        found
    }

    /// The parts of a drawing inside.
    ///
    /// # Errors
    /// [`Error::Interrupted`].
    pub fn clip(&self, graph: &PlanarGraph, watch: Watch<'_>) -> Result<Parts> {
        let vertices = graph.vertices.clone();
        let mut parts = Parts { graph: PlanarGraph { vertices, edges: Vec::new() }, ..Parts::default() };
        for (k, &[a, b]) in graph.edges.iter().enumerate() {
            watch.poll_at(k)?;
            let [p, q] = [a, b].map(|end| graph.vertices[end as usize]);
            let crossings = self.crossings(p, q);
            let (mut from, mut is_inside) = (a, self.contains(p));
            parts.cut.push(!crossings.is_empty());
            for t in crossings {
                parts.graph.vertices.push([0, 1].map(|i| p[i] + t * (q[i] - p[i])));
                let at = parts.graph.vertices.len() as i32 - 1;
                parts.push([from, at], k, is_inside);
                (from, is_inside) = (at, !is_inside);
            }
            parts.push([from, b], k, is_inside);
        }
        Ok(parts)
    }
}

impl Parts {
    fn push(&mut self, ends: [i32; 2], row: usize, is_inside: bool) {
        let [p, q] = ends.map(|end| self.graph.vertices[end as usize]);
        if is_inside && p != q {
            self.graph.edges.push(ends);
            self.rows.push(row as i32);
        }
    }
}

fn sides(coords: &[Point], offsets: &[i64]) -> Result<Vec<[Point; 2]>> {
    let mut sides = Vec::with_capacity(coords.len());
    for (row, ends) in offsets.windows(2).enumerate() {
        let ring = usize::try_from(ends[0]).ok().zip(usize::try_from(ends[1]).ok()).and_then(|(a, b)| coords.get(a..b));
        let (low, limit) = (ends[0], coords.len() as i64 + 1);
        let ring = ring.ok_or(Error::BadIndex { array: "offsets", row: row + 1, value: ends[1], low, limit })?;
        let next = ring.iter().cycle().skip(1);
        sides.extend(ring.iter().zip(next).map(|(&a, &b)| [a, b]).filter(|[a, b]| a != b));
    }
    Ok(sides)
}

fn extent(coords: &[Point]) -> (Point, Point) {
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for p in coords {
        low = [low[0].min(p[0]), low[1].min(p[1])];
        high = [high[0].max(p[0]), high[1].max(p[1])];
    }
    (low, high)
}

/// Where a way `a b` crosses a side `u v`, as a part of the way.
///
/// All points asked about count as moved right by next to nothing and up by nothing beside that: then none lies on the
/// outline, and none of its corners on a way, whatever way is taken between two points.
fn crossing([a, b]: [Point; 2], [u, v]: [Point; 2]) -> Option<f64> {
    let tie = |value: f64, [x, y]: Point| match value {
        0.0 if y == 0.0 => x > 0.0,
        0.0 => y < 0.0,
        _ => value > 0.0,
    };
    let back = [a[0] - b[0], a[1] - b[1]];
    if a == b || tie(orientation(a, b, u), back) == tie(orientation(a, b, v), back) {
        return None;
    }
    let along = [v[0] - u[0], v[1] - u[1]];
    let (from, to) = (orientation(u, v, a), orientation(u, v, b));
    (tie(from, along) != tie(to, along)).then(|| from / (from - to))
}
