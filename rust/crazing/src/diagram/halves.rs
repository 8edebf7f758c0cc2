//! Delaunay triangulation by halves: who lies around whom, without triangles, numbers or a table of edges.
//!
//! For work that triangulates points again and again and wants only neighbours: it needs no order but its own, which
//! it finds nearly done the next time, and halves are done on threads of their own. Where four points lie on one
//! circle any of their two diagonals may be there.
//!
//! # Source
//! Guibas, Stolfi: Primitives for the Manipulation of General Subdivisions (1985); cuts in turn across x and y after
//! Dwyer: A Faster Divide-and-Conquer Algorithm for Constructing Delaunay Triangulations (1987).

mod weave;

use crate::error::{Error, Result};
use crate::graph::Point;
use crate::parallel;
use crate::watch::Watch;
use weave::{Free, Weaver, order};

/// Halves no larger than this have numbers of their own for their edges: those about a site are near each other.
const GRAIN: usize = 1 << 11;
/// More sites than this are cut by the median of so many of them: within some hundredths of the middle.
const MANY: usize = 512;
const ASKED: usize = 63;
/// So often halves are given to threads: eight threads in all.
const THREADED: u32 = 3;
/// Half-edges a site that there is room for: a triangulation has fewer.
const ROOM: usize = 6;

/// A point, the row it is of, and one half-edge that leaves it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Site {
    pub(crate) place: Point,
    pub(crate) row: u32,
    edge: u32,
}

impl Site {
    /// A site that has no neighbours yet.
    pub(crate) fn new(place: Point, row: u32) -> Self {
        Self { place, row, edge: NONE }
    }
}

const NONE: u32 = u32::MAX;

/// Half-edges 2 k and 2 k + 1 are one edge from its two ends; `next` is the next one counter-clockwise about `origin`.
#[derive(Debug, Clone, Copy)]
struct Half {
    next: u32,
    prev: u32,
    origin: u32,
}

/// Sites, and who lies around each of them. Kept from one triangulation to the next: memory and order are used again.
#[derive(Debug, Default)]
pub(crate) struct Stars {
    /// In the order of the cuts: neighbours in the plane are near.
    pub(crate) sites: Vec<Site>,
    halves: Vec<Half>,
}

impl Stars {
    pub(crate) fn of(sites: Vec<Site>) -> Self {
        Self { sites, halves: Vec::new() }
    }

    /// Triangulates the sites, wherever they are now: near 1, without -0. Whether no two of them are at one place; if
    /// two are, who is around whom is not known.
    ///
    /// # Errors
    /// [`Error::Interrupted`].
    pub(crate) fn triangulate(&mut self, watch: Watch<'_>) -> Result<bool> {
        let blank = Half { next: NONE, prev: NONE, origin: NONE };
        if self.halves.len() != ROOM * self.sites.len() {
            self.halves = parallel::map(ROOM * self.sites.len(), |_| blank);
        }
        self.sites.iter_mut().for_each(|site| site.edge = NONE);
        let whole = Part { sites: &mut self.sites, halves: &mut self.halves, first: 0 };
        match whole.triangulated(0, watch) {
            Ok(_) => Ok(true),
            Err(Stop::Equal) => Ok(false),
            Err(Stop::Interrupted) => Err(Error::Interrupted),
        }
    }

    /// The neighbours of a site, counter-clockwise.
    pub(crate) fn around(&self, site: usize) -> impl Iterator<Item = &Site> {
        let first = self.sites[site].edge;
        let mut next = first;
        std::iter::from_fn(move || {
            let half = self.halves.get(next as usize)?;
            let other = self.halves[next as usize ^ 1].origin;
            next = if half.next == first { NONE } else { half.next };
            Some(&self.sites[other as usize])
        })
    }

    /// The last of the neighbours.
    pub(crate) fn last_around(&self, site: usize) -> Option<&Site> {
        let first = self.halves.get(self.sites[site].edge as usize)?;
        Some(&self.sites[self.halves[first.prev as usize ^ 1].origin as usize])
    }
}

/// Why there is no triangulation.
enum Stop {
    Interrupted,
    /// Two sites are at one place.
    Equal,
}

/// Some sites in a row, and the half-edges between them.
struct Part<'a> {
    sites: &'a mut [Site],
    halves: &'a mut [Half],
    /// The number of the first site; that of the first half-edge follows.
    first: u32,
}

/// A half-edge of the hull that has all sites on its left, and the numbers of edges that are free.
struct Done {
    hull: u32,
    free: Free,
}

impl Part<'_> {
    /// Cuts the sites in two; on either side of the cut are those before it. None where sites are equal.
    fn cut(&mut self, upright: bool) -> std::result::Result<usize, Stop> {
        let about = if self.sites.len() > MANY { self.parted(upright) } else { 0 };
        // Those that were asked may all lie at one end.
        if about > self.sites.len() / 8 && about < self.sites.len() / 8 * 7 {
            return Ok(about);
        }
        let middle = self.sites.len() / 2;
        let (before, pivot, _) = if upright {
            self.sites.select_nth_unstable_by(middle, |a, b| order(a.place, b.place, true))
        } else {
            self.sites.select_nth_unstable_by(middle, |a, b| order(a.place, b.place, false))
        };
        if before.iter().any(|site| site.place == pivot.place) { Err(Stop::Equal) } else { Ok(middle) }
    }

    /// Cuts the sites near their middle, in one go: by the median of some of them. How many are before it.
    fn parted(&mut self, upright: bool) -> usize {
        let step = self.sites.len() / ASKED;
        let mut asked: [Point; ASKED] = std::array::from_fn(|i| self.sites[i * step + step / 2].place);
        let (_, pivot, _) = asked.select_nth_unstable_by(ASKED / 2, |a, b| order(*a, *b, upright));
        if upright {
            parted(self.sites, |site| order(site.place, *pivot, true).is_lt())
        } else {
            parted(self.sites, |site| order(site.place, *pivot, false).is_lt())
        }
    }

    /// The triangulation of the sites; large halves on threads of their own.
    fn triangulated(mut self, depth: u32, watch: Watch<'_>) -> std::result::Result<Done, Stop> {
        let (count, upright) = (self.sites.len(), depth.is_multiple_of(2));
        watch.poll().map_err(|_| Stop::Interrupted)?;
        if count <= GRAIN {
            let edge = ROOM as u32 / 2 * self.first;
            let fresh = std::iter::once(edge..edge + (ROOM / 2 * count) as u32).collect();
            let mut weaver = Weaver { part: self, free: Free { fresh, used: Vec::new() } };
            let hull = weaver.woven(0..count, upright)?;
            return Ok(Done { hull, free: weaver.free });
        }
        let middle = self.cut(upright)?;
        let (left, right) = self.sites.split_at_mut(middle);
        let (left_halves, right_halves) = self.halves.split_at_mut(ROOM * middle);
        let left = Part { sites: left, halves: left_halves, first: self.first };
        let right = Part { sites: right, halves: right_halves, first: self.first + middle as u32 };
        let (left, right) = parallel::join(
            if depth < THREADED { count } else { 0 },
            || left.triangulated(depth + 1, watch),
            || right.triangulated(depth + 1, watch),
        );
        let (mut left, right) = (left?, right?);
        left.free.fresh.extend(right.free.fresh);
        left.free.used.extend(right.free.used);
        let mut weaver = Weaver { part: self, free: left.free };
        let hull = weaver.sewn(left.hull, right.hull, upright);
        Ok(Done { hull, free: weaver.free })
    }
}

/// Puts those first that are before; how many they are.
fn parted(sites: &mut [Site], is_before: impl Fn(&Site) -> bool) -> usize {
    let mut count = 0;
    for i in 0..sites.len() {
        // Without a branch: which side a site is on cannot be foretold.
        let is_first = is_before(&sites[i]);
        sites.swap(i, count);
        count += usize::from(is_first);
    }
    count
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagram::diagram;
    use crate::predicates::{in_circle, orientation};
    use crate::sample::uniform;

    fn stars(points: &[Point]) -> Stars {
        let mut stars = Stars::of(points.iter().zip(0..).map(|(&p, row)| Site::new(p, row)).collect());
        assert!(stars.triangulate(Watch::default()).unwrap_or(false));
        stars
    }

    fn edges(stars: &Stars) -> Vec<[u32; 2]> {
        let of = |i: usize| stars.around(i).map(move |other| [stars.sites[i].row, other.row]);
        let mut edges: Vec<[u32; 2]> = (0..stars.sites.len()).flat_map(of).filter(|[a, b]| a < b).collect();
        edges.sort_unstable();
        edges
    }

    #[test]
    fn edges_are_those_of_the_diagram() {
        // More points than go to one thread.
        for n in [0, 1, 2, 3, 4, 5, 7, 50, 3000, 150_000] {
            let points = uniform(n, [0.0, 0.0, 1.0, 1.0], [n as u64, 1], Watch::default()).unwrap_or_default();
            let mut wanted: Vec<[u32; 2]> = diagram(&points, Watch::default())
                .unwrap_or_default()
                .edges
                .iter()
                .map(|&[a, b]| [a.min(b) as u32, a.max(b) as u32])
                .collect();
            wanted.sort_unstable();
            assert!(edges(&stars(&points)) == wanted, "{n}");
        }
    }

    #[test]
    fn circles_are_empty_where_many_points_lie_on_one() {
        let grid = (0..400).map(|i| [f64::from(i % 20), f64::from(i / 20)]);
        let line = (0..50).map(|i| [f64::from(i) / 8.0, 3.0]);
        let ring =
            [[5.0, 0.0], [4.0, 3.0], [3.0, 4.0], [0.0, 5.0], [-3.0, 4.0], [-4.0, -3.0], [0.0, -5.0], [3.0, -4.0]];
        for (points, wanted) in [(grid.collect::<Vec<Point>>(), 722.0), (line.collect(), 0.0), (ring.to_vec(), 132.0)] {
            let stars = stars(&points);
            let place = |site: &Site| site.place;
            let mut twice_the_area = 0.0;
            for site in 0..stars.sites.len() {
                let (own, around) = (stars.sites[site].place, stars.around(site).map(place).collect::<Vec<_>>());
                for (i, &a) in around.iter().enumerate() {
                    let b = around[(i + 1) % around.len()];
                    let area = orientation(own, a, b);
                    if area > 0.0 {
                        twice_the_area += area / 3.0;
                        assert!(points.iter().all(|&p| in_circle(own, a, b, p) <= 0.0));
                    }
                }
            }
            assert!((twice_the_area - wanted).abs() < 1e-9, "{twice_the_area}");
        }
    }

    #[test]
    fn equal_points_are_found_wherever_they_stand() {
        for n in [2, 3, 9, 1000] {
            let points = uniform(n, [0.0, 0.0, 1.0, 1.0], [7, 1], Watch::default()).unwrap_or_default();
            for i in 0..n.min(40) {
                let mut twice = points.clone();
                twice.push(points[i]);
                let sites = twice.iter().map(|&p| Site::new(p, 0)).collect();
                assert!(!Stars::of(sites).triangulate(Watch::default()).unwrap_or(true));
            }
        }
    }
}
