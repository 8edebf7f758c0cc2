//! Lloyd's relaxation: every point to the centroid of its cell.

use super::check_box;
use crate::diagram::{DiagramView, diagram, periodic};
use crate::error::Result;
use crate::graph::Point;
use crate::incidence::Incidence;
use crate::parallel;
use crate::watch::Watch;

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
    let mut points = points;
    for _ in 0..iterations {
        points = match period {
            None => round(&points, bounds, watch)?,
            Some(period) => round_on_torus(&points, [bounds[0], bounds[1]], period, watch)?,
        };
    }
    Ok(points)
}

fn round(points: &[Point], bounds: [f64; 4], watch: Watch<'_>) -> Result<Vec<Point>> {
    let d = diagram(points, watch)?;
    let moved = centroids(d.view(), &[], [0.0; 2], |_| bounds, &whole(d.view(), bounds), watch)?;
    Ok(d.site_of.iter().map(|&site| moved[site as usize]).collect())
}

fn round_on_torus(points: &[Point], corner: Point, period: Point, watch: Watch<'_>) -> Result<Vec<Point>> {
    let home: Vec<Point> = points.iter().map(|p| [p[0] - corner[0], p[1] - corner[1]]).collect();
    let torus = periodic(&home, period, watch)?;
    // A cell reaches no farther than half a period from its site: see the note on halos in `diagram::periodic`.
    let half = period.map(|side| side / 2.0);
    let about = |p: Point| [p[0] - half[0], p[1] - half[1], p[0] + half[0], p[1] + half[1]];
    let moved = centroids(torus.diagram.view(), &torus.shifts, period, about, &[], watch)?;
    let inside = |x: f64, side: f64| (x - (x / side).floor() * side).clamp(0.0, side.next_down());
    let place = |&site: &i32| [0, 1].map(|i| corner[i] + inside(moved[site as usize][i], period[i]));
    Ok(torus.diagram.site_of.iter().map(place).collect())
}

/// The centroids of the cells that lie in the bounds whole, by the triangles between a site and its walls; None of
/// those that must be clipped.
fn whole(view: DiagramView<'_>, bounds: [f64; 4]) -> Vec<Option<Point>> {
    let is_inside = |p: Point| (0..2).all(|i| (bounds[i]..=bounds[i + 2]).contains(&p[i]));
    let inside = parallel::map(view.vertices.len(), |v| is_inside(view.vertices[v]));
    let mut sums = vec![[0.0; 3]; view.sites.len()];
    for (&[p, q], &[right, left]) in view.edges.iter().zip(view.dual_edges) {
        if right < 0 || left < 0 || !inside[right as usize] || !inside[left as usize] {
            // No number: what it is added to is none either.
            for site in [p, q] {
                sums[site as usize][0] = f64::NAN;
            }
            continue;
        }
        let [right, left] = [right, left].map(|v| view.vertices[v as usize]);
        for (site, [from, to]) in [(p, [right, left]), (q, [left, right])] {
            let s = view.sites[site as usize];
            let (u, v) = ([from[0] - s[0], from[1] - s[1]], [to[0] - s[0], to[1] - s[1]]);
            let cross = u[0] * v[1] - u[1] * v[0];
            let sum = &mut sums[site as usize];
            *sum = [sum[0] + cross, sum[1] + cross * (u[0] + v[0]), sum[2] + cross * (u[1] + v[1])];
        }
    }
    let place = |(s, sum): (&Point, &[f64; 3])| {
        let [x, y] = [s[0] + sum[1] / (3.0 * sum[0]), s[1] + sum[2] / (3.0 * sum[0])];
        (sum[0] > 0.0 && is_inside([x, y])).then_some([x, y])
    };
    view.sites.iter().zip(&sums).map(place).collect()
}

fn centroids(
    view: DiagramView<'_>,
    shifts: &[[i8; 2]],
    period: Point,
    region: impl Fn(Point) -> [f64; 4] + Sync + Send,
    known: &[Option<Point>],
    watch: Watch<'_>,
) -> Result<Vec<Point>> {
    watch.poll()?;
    let about = Incidence::of(view.sites.len(), view.edges);
    Ok(parallel::map(view.sites.len(), |site| {
        if let Some(&Some(place)) = known.get(site) {
            return place;
        }
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
        let [x, y] = centroid(&cell).unwrap_or([0.0; 2]);
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

fn centroid(cell: &[Point]) -> Option<Point> {
    let origin = cell.first()?;
    let (mut area, mut sum) = (0.0, [0.0; 2]);
    for i in 1..cell.len() {
        let [p, q] = [cell[i - 1], cell[i]].map(|p| [p[0] - origin[0], p[1] - origin[1]]);
        let cross = p[0] * q[1] - p[1] * q[0];
        area += cross;
        (0..2).for_each(|k| sum[k] += cross * (p[k] + q[k]));
    }
    let place = [0, 1].map(|k| origin[k] + sum[k] / (3.0 * area));
    (area > 0.0 && place.iter().all(|x| x.is_finite())).then_some(place)
}
