//! A polygon with holes, by the even-odd rule, and what of a drawing lies in it.

pub mod cells;
mod chains;
mod doors;
mod grid;
mod rings;
mod route;

pub use doors::{Doors, doors};
pub use route::route;

use crate::error::{Error, Result};
use crate::graph::Point;
use crate::predicates::orientation;
use crate::watch::Watch;
use grid::Grid;

/// The sides of rings that cross neither each other nor themselves, the inside on their left, in a grid.
#[derive(Debug)]
pub struct Region {
    /// Ring after ring, each from the end of the one before.
    sides: Vec<[Point; 2]>,
    /// Ring `i` is `sides[rings[i]..rings[i + 1]]`.
    rings: Vec<usize>,
    grid: Grid,
}

/// Where a way crosses the outline.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Crossing {
    /// As a part of the way.
    along: f64,
    /// Which side, and as a part of it.
    side: u32,
    at: f64,
    /// Whether the side comes from the left of the way.
    from_left: bool,
}

impl Region {
    /// Ring `i` is `coords[offsets[i]..offsets[i + 1]]`, its last point joined to its first. A side that is there twice
    /// parts nothing, and counts as not there. `queries` is about how often the region will be asked.
    ///
    /// # Errors
    /// [`Error::BadIndex`] for offsets that do not rise within `coords`; [`Error::NotFinite`]; [`Error::BadValue`] for
    /// a region without an extent; [`Error::Crossing`] for sides that cross or overlap, by the rows of their ends;
    /// [`Error::Interrupted`].
    pub fn of(coords: &[Point], offsets: &[i64], queries: usize, watch: Watch<'_>) -> Result<Self> {
        if let Some(row) = coords.iter().position(|p| !(p[0].abs() < 1e150 && p[1].abs() < 1e150)) {
            let [x, y] = coords[row];
            if x.is_finite() && y.is_finite() {
                let (name, wanted) = ("a coordinate of the outline", "less than 1e150 is wanted");
                return Err(Error::BadValue { name, value: if x.abs() < y.abs() { y } else { x }, wanted });
            }
            return Err(Error::NotFinite { row, x, y });
        }
        let sides = rings::sides(coords, offsets, watch)?;
        let grid = Grid::of(coords, &sides, queries, watch)?;
        let mut region = Self { sides, rings: Vec::new(), grid };
        let (order, rings) = rings::traced(&region, watch)?;
        region.rings = rings;
        region.grid.renumber(&order);
        region.sides = order.iter().map(|&(k, back)| flipped(region.sides[k as usize], back)).collect();
        Ok(region)
    }

    /// The corners of the rings and where each ring starts: outer rings run counter-clockwise, holes clockwise, and
    /// rings that touch themselves are taken apart there.
    pub fn rings(&self) -> (Vec<Point>, Vec<i64>) {
        (self.sides.iter().map(|side| side[0]).collect(), self.rings.iter().map(|&start| start as i64).collect())
    }

    /// Whether a point is inside; on the outline, either may be found.
    pub fn contains(&self, p: Point) -> bool {
        self.grid.contains(&self.sides, p)
    }

    /// Where the way from `a` to `b` crosses the outline, in order. Signs are exact: the number of crossings is right
    /// for the points as given.
    fn crossings(&self, a: Point, b: Point, found: &mut Vec<Crossing>) {
        found.clear();
        self.grid.crossings(&self.sides, a, b, |crossing| found.push(crossing));
        if found.len() > 1 {
            found.sort_unstable_by(|x, y| x.along.total_cmp(&y.along).then(x.side.cmp(&y.side)));
            // Rounding may have exchanged neighbours. Not by a sort, which wants an order that rounding cannot give.
            for i in 1..found.len() {
                let mut j = i;
                while j > 0 && self.is_before([a, b], found[j], found[j - 1]) == Some(true) {
                    found.swap(j, j - 1);
                    j -= 1;
                }
            }
        }
    }

    /// Which of two crossings comes first on a way, where their sides share a corner and it can be told exactly.
    fn is_before(&self, way: [Point; 2], x: Crossing, y: Crossing) -> Option<bool> {
        let (a, b) = (self.sides[x.side as usize], self.sides[y.side as usize]);
        let (corner, p, q) = [(0, 0), (0, 1), (1, 0), (1, 1)]
            .into_iter()
            .find(|&(i, j)| a[i] == b[j])
            .map(|(i, j)| (a[i], a[1 - i], b[1 - j]))?;
        // Of two rays from the corner across the way: their far ends lie on the side that the corner does not.
        let turn = orientation(corner, q, p);
        let left = [(corner, -1.0), (p, 1.0), (q, 1.0)]
            .into_iter()
            .map(|(point, sign)| sign * orientation(way[0], way[1], point))
            .find(|&left| left != 0.0)?;
        (turn != 0.0).then_some((turn > 0.0) == (left > 0.0))
    }
}

fn flipped([a, b]: [Point; 2], back: bool) -> [Point; 2] {
    if back { [b, a] } else { [a, b] }
}

/// A point on the way from `p` to `q`.
fn on_way(p: Point, q: Point, along: f64) -> Point {
    [0, 1].map(|i| p[i] + along * (q[i] - p[i]))
}

/// Where a way `a b` crosses a side `u v`.
///
/// All points asked about count as moved right by next to nothing and up by nothing beside that: then none lies on the
/// outline, and none of its corners on a way, whatever way is taken between two points.
fn crossing([a, b]: [Point; 2], [u, v]: [Point; 2], side: u32) -> Option<Crossing> {
    let tie = |value: f64, [x, y]: Point| match value {
        0.0 if y == 0.0 => x > 0.0,
        0.0 => y < 0.0,
        _ => value > 0.0,
    };
    let apart = |i: usize| a[i].max(b[i]) < u[i].min(v[i]) || u[i].max(v[i]) < a[i].min(b[i]);
    if a == b || apart(0) || apart(1) {
        return None;
    }
    let back = [a[0] - b[0], a[1] - b[1]];
    let (start, end) = (orientation(a, b, u), orientation(a, b, v));
    let from_left = tie(start, back);
    if from_left == tie(end, back) {
        return None;
    }
    let forth = [v[0] - u[0], v[1] - u[1]];
    let (from, to) = (orientation(u, v, a), orientation(u, v, b));
    if tie(from, forth) == tie(to, forth) {
        return None;
    }
    Some(Crossing { along: from / (from - to), side, at: start / (start - end), from_left })
}
