//! Lloyd's relaxation: every point to the centroid of its cell.

use super::check_box;
use crate::diagram::halves::{Site, Stars};
use crate::diagram::scale::{Scale, cleared};
use crate::diagram::{DiagramView, check_points, distinct, periodic};
use crate::error::{Error, Result};
use crate::graph::Point;
use crate::incidence::Incidence;
use crate::parallel;
use crate::watch::Watch;

/// Where the sines of the angles between neighbours are no smaller, the centre of their circle is exact to some
/// roundings; cells with others are clipped by one neighbour after the other, which needs no centres.
const WIDE: f64 = 1e-3;

/// The points after rounds of Lloyd's relaxation within `bounds`, or on a torus whose period starts at the corner of
/// the bounds.
///
/// Cells are clipped to the bounds; their centroids are exact up to rounding. Equal points move together. A point
/// whose cell has no area in the bounds goes to the nearest place of the bounds.
///
/// # Errors
/// [`crate::Error::NotFinite`], [`crate::Error::BadValue`], [`crate::Error::Interrupted`].
///
/// # Source
/// Lloyd: Least Squares Quantization in PCM (1982).
pub fn relax(
    points: Vec<Point>,
    iterations: usize,
    bounds: [f64; 4],
    period: Option<Point>,
    watch: Watch<'_>,
) -> Result<Vec<Point>> {
    check_box(bounds)?;
    let Some(period) = period else { return in_plane(points, iterations, bounds, watch) };
    let mut points = points;
    for _ in 0..iterations {
        points = round_on_torus(&points, [bounds[0], bounds[1]], period, watch)?;
    }
    Ok(points)
}

/// Points are kept in the order of the last triangulation from round to round, equal ones as one.
fn in_plane(points: Vec<Point>, iterations: usize, bounds: [f64; 4], watch: Watch<'_>) -> Result<Vec<Point>> {
    check_points(&points)?;
    let rows = points.len();
    let mut stars = Stars::of(parallel::map(rows, |row| Site::new(points[row], row as u32)));
    drop(points);
    let mut of_row: Vec<u32> = (0..rows as u32).collect();
    let mut moved = Vec::new();
    for _ in 0..iterations {
        let scale = triangulated(&mut stars, &mut of_row, watch)?;
        watch.poll()?;
        let up = |p: Point| if scale.is_one() { p } else { scale.up(p) };
        moved.resize(stars.sites.len(), [0.0; 2]);
        parallel::fill(&mut moved, |range, places| {
            let mut clipped = Clipped::default();
            let places = places.iter_mut().zip(range);
            places.for_each(|(place, site)| *place = clipped.centroid(&stars, site, bounds, up));
        });
        parallel::alter_both(&mut stars.sites, &mut moved, |site, &mut place| site.place = place);
    }
    let mut places = vec![[0.0; 2]; stars.sites.len()];
    stars.sites.iter().for_each(|site| places[site.row as usize] = site.place);
    if places.len() == rows {
        return Ok(places);
    }
    Ok(of_row.into_iter().map(|row| places[row as usize]).collect())
}

/// Triangulates the sites in a unit that brings them near 1; equal ones become one, which their rows share.
fn triangulated(stars: &mut Stars, of_row: &mut [u32], watch: Watch<'_>) -> Result<Scale> {
    let size = |range: std::ops::Range<usize>| {
        stars.sites[range].iter().fold(0.0, |most: f64, site| most.max(site.place[0].abs()).max(site.place[1].abs()))
    };
    let most = parallel::ranges(stars.sites.len(), size).into_iter().fold(0.0, f64::max);
    let scale = Scale::of(most);
    parallel::alter(&mut stars.sites, |site| site.place = scale.down(cleared(site.place, most)));
    if stars.triangulate(watch)? {
        return Ok(scale);
    }
    let mut places = vec![[0.0; 2]; stars.sites.len()];
    stars.sites.iter().for_each(|site| places[site.row as usize] = site.place);
    let (places, site_of, _) = distinct(&places);
    of_row.iter_mut().for_each(|row| *row = site_of[*row as usize] as u32);
    *stars = Stars::of(places.into_iter().zip(0..).map(|(p, row)| Site::new(p, row)).collect());
    if stars.triangulate(watch)? { Ok(scale) } else { Err(Error::Internal("distinct points were found equal")) }
}

/// A cell that is clipped, seen from its site; the memory is used again for the next.
#[derive(Default)]
struct Clipped {
    cell: Vec<Point>,
    spare: Vec<Point>,
}

impl Clipped {
    /// The centroid of a cell within the bounds. Seen from the site, so that cells far from the origin lose nothing.
    fn centroid(&mut self, stars: &Stars, site: usize, bounds: [f64; 4], up: impl Fn(Point) -> Point) -> Point {
        let p = up(stars.sites[site].place);
        let from = |q: Point| [q[0] - p[0], q[1] - p[1]];
        let (low, high) = (from([bounds[0], bounds[1]]), from([bounds[2], bounds[3]]));
        let step = |other: &Site| from(up(other.place));
        let whole =
            stars.last_around(site).and_then(|last| of_whole(step(last), stars.around(site).map(step), low, high));
        let found = whole.unwrap_or_else(|| {
            self.cell.clear();
            self.cell.extend([low, [high[0], low[1]], high, [low[0], high[1]]]);
            stars.around(site).map(step).for_each(|step| cut(&mut self.cell, step, &mut self.spare));
            Sums::of(&self.cell).centroid()
        });
        let [x, y] = found.unwrap_or([0.0; 2]);
        [(p[0] + x).clamp(bounds[0], bounds[2]), (p[1] + y).clamp(bounds[1], bounds[3])]
    }
}

/// The centroid of a cell that lies in the bounds whole, from the steps to its neighbours and the last of them; none when
/// it does not, or its corners are hard to tell.
fn of_whole(last: Point, steps: impl Iterator<Item = Point>, low: Point, high: Point) -> Option<Option<Point>> {
    let square = |[x, y]: Point| x * x + y * y;
    let (mut sums, mut a, mut size) = (Sums::default(), last, square(last));
    for b in steps {
        let next = square(b);
        let (p, q) = (a[0] * b[1], a[1] * b[0]);
        let cross = p - q;
        // Outside the hull neighbours turn by half a turn or more.
        let is_wide = cross > WIDE * (p.abs() + q.abs());
        if !is_wide {
            return None;
        }
        let part = 0.5 / cross;
        let corner = [part * (size * b[1] - next * a[1]), part * (next * a[0] - size * b[0])];
        if !(0..2).all(|i| low[i] <= corner[i] && corner[i] <= high[i]) {
            return None;
        }
        sums.add(corner);
        (a, size) = (b, next);
    }
    Some(sums.centroid())
}

fn round_on_torus(points: &[Point], corner: Point, period: Point, watch: Watch<'_>) -> Result<Vec<Point>> {
    let home: Vec<Point> = points.iter().map(|p| [p[0] - corner[0], p[1] - corner[1]]).collect();
    let torus = periodic(&home, period, watch)?;
    // A cell reaches no farther than half a period from its site: see the note on halos in `diagram::periodic`.
    let half = period.map(|side| side / 2.0);
    let about = |p: Point| [p[0] - half[0], p[1] - half[1], p[0] + half[0], p[1] + half[1]];
    let moved = centroids(torus.diagram.view(), &torus.shifts, period, about, watch)?;
    let inside = |x: f64, side: f64| (x - (x / side).floor() * side).clamp(0.0, side.next_down());
    let place = |&site: &i32| [0, 1].map(|i| corner[i] + inside(moved[site as usize][i], period[i]));
    Ok(torus.diagram.site_of.iter().map(place).collect())
}

fn centroids(
    view: DiagramView<'_>,
    shifts: &[[i8; 2]],
    period: Point,
    region: impl Fn(Point) -> [f64; 4] + Sync + Send,
    watch: Watch<'_>,
) -> Result<Vec<Point>> {
    watch.poll()?;
    let about = Incidence::of(view.sites.len(), view.edges);
    Ok(parallel::map(view.sites.len(), |site| {
        let p = view.sites[site];
        let [xmin, ymin, xmax, ymax] = region(p);
        // Seen from the site, so that cells far from the origin lose nothing.
        let mut cell = vec![
            [xmin - p[0], ymin - p[1]],
            [xmax - p[0], ymin - p[1]],
            [xmax - p[0], ymax - p[1]],
            [xmin - p[0], ymax - p[1]],
        ];
        let mut spare = Vec::with_capacity(12);
        for &row in about.at(site) {
            let [from, to] = view.edges[row as usize];
            let shift = shifts.get(row as usize).copied().unwrap_or_default();
            let step = [0, 1].map(|i| {
                let turn = f64::from(shift[i]) * period[i];
                view.sites[to as usize][i] + turn - view.sites[from as usize][i]
            });
            if from as usize == site {
                cut(&mut cell, step, &mut spare);
            }
            if to as usize == site {
                cut(&mut cell, step.map(|x| -x), &mut spare);
            }
        }
        let [x, y] = Sums::of(&cell).centroid().unwrap_or([0.0; 2]);
        [(p[0] + x).clamp(xmin, xmax), (p[1] + y).clamp(ymin, ymax)]
    }))
}

/// Keeps the part of a convex polygon that is nearer to the origin than to `other`.
fn cut(cell: &mut Vec<Point>, other: Point, spare: &mut Vec<Point>) {
    let half = 0.5 * (other[0] * other[0] + other[1] * other[1]);
    let beyond = |p: Point| p[0] * other[0] + p[1] * other[1] - half;
    if cell.iter().all(|&p| beyond(p) <= 0.0) {
        return;
    }
    spare.clear();
    for (i, &p) in cell.iter().enumerate() {
        let q = cell[(i + 1) % cell.len()];
        let (s, t) = (beyond(p), beyond(q));
        if s <= 0.0 {
            spare.push(p);
        }
        if (s < 0.0 && t > 0.0) || (s > 0.0 && t < 0.0) {
            let part = s / (s - t);
            spare.push([p[0] + part * (q[0] - p[0]), p[1] + part * (q[1] - p[1])]);
        }
    }
    std::mem::swap(cell, spare);
}

/// What the centroid of a polygon is found from, corner by corner.
#[derive(Default)]
struct Sums {
    /// The first corner, and from it the last.
    corners: Option<(Point, Point)>,
    area: f64,
    sum: Point,
}

impl Sums {
    fn of(cell: &[Point]) -> Self {
        let mut sums = Self::default();
        cell.iter().for_each(|&corner| sums.add(corner));
        sums
    }

    #[inline]
    fn add(&mut self, corner: Point) {
        let Some((origin, p)) = self.corners else {
            self.corners = Some((corner, [0.0; 2]));
            return;
        };
        let q = [corner[0] - origin[0], corner[1] - origin[1]];
        let cross = p[0] * q[1] - p[1] * q[0];
        self.area += cross;
        (0..2).for_each(|k| self.sum[k] += cross * (p[k] + q[k]));
        self.corners = Some((origin, q));
    }

    fn centroid(&self) -> Option<Point> {
        let (origin, _) = self.corners?;
        let place = [0, 1].map(|k| origin[k] + self.sum[k] / (3.0 * self.area));
        (self.area > 0.0 && place.iter().all(|x| x.is_finite())).then_some(place)
    }
}
