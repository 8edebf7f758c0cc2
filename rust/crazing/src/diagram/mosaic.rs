//! Voronoi cells as polygons, to be filled.

use super::DiagramView;
use super::scale::{Scale, largest};
use crate::clip::{Bounds, check_bounds};
use crate::error::{Error, Result};
use crate::graph::Point;
use crate::watch::Watch;

/// Convex polygons.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Mosaic {
    /// Corners, counter-clockwise, polygon after polygon.
    pub coords: Vec<Point>,
    /// Polygon `i` is `coords[offsets[i]..offsets[i + 1]]`: the cell of site `i`, empty where it does not meet the
    /// bounds.
    pub offsets: Vec<i64>,
}

/// The cell of every site: what of the bounds is no farther from it than from any neighbour. Edge `k` runs from its
/// first site to its second one moved by `steps[k]`, if there are any. With steps the bounds go with the site.
///
/// Corners are rounded, each cell by itself: fit for pictures.
///
/// # Errors
/// [`Error::BadLength`], [`Error::BadValue`] for bounds without an area, [`Error::Interrupted`].
pub fn mosaic(view: DiagramView<'_>, steps: Option<&[Point]>, bounds: Bounds, watch: Watch<'_>) -> Result<Mosaic> {
    check_bounds(bounds)?;
    if let Some(steps) = steps.filter(|steps| steps.len() != view.edges.len()) {
        return Err(Error::BadLength { array: "steps", found: steps.len(), wanted: view.edges.len() });
    }
    let corners = [[bounds[0], bounds[1]], [bounds[2], bounds[3]]];
    let scale = Scale::of(largest(view.sites).max(largest(&corners)));
    let (sites, [low, high]) = (scale.all_down(view.sites), corners.map(|corner| scale.down(corner)));
    let steps = steps.map(|steps| scale.all_down(steps));
    let (starts, neighbours) = neighbours(view, &sites, steps.as_deref());
    let mut found = Mosaic { coords: Vec::with_capacity(6 * sites.len()), offsets: vec![0] };
    let (mut polygon, mut spare) = (Vec::new(), Vec::new());
    for (site, &p) in sites.iter().enumerate() {
        watch.poll_at(site)?;
        let own = if steps.is_some() { [0.0; 2] } else { p };
        let [l, h] = [low, high].map(|corner| [corner[0] - own[0], corner[1] - own[1]]);
        polygon.clear();
        polygon.extend([l, [h[0], l[1]], h, [l[0], h[1]]]);
        for &away in &neighbours[starts[site]..starts[site + 1]] {
            cut(&polygon, away, &mut spare);
            std::mem::swap(&mut polygon, &mut spare);
        }
        if polygon.len() > 2 {
            found.coords.extend(polygon.iter().map(|corner| scale.up([corner[0] + p[0], corner[1] + p[1]])));
        }
        found.offsets.push(found.coords.len() as i64);
    }
    Ok(found)
}

/// Where the neighbours of every site are as seen from it.
fn neighbours(view: DiagramView<'_>, sites: &[Point], steps: Option<&[Point]>) -> (Vec<usize>, Vec<Point>) {
    let mut starts = vec![0; sites.len() + 2];
    for &site in view.edges.as_flattened() {
        starts[site as usize + 2] += 1;
    }
    for i in 2..starts.len() {
        starts[i] += starts[i - 1];
    }
    let mut found = vec![[0.0; 2]; starts[sites.len() + 1]];
    for (k, ends) in view.edges.iter().enumerate() {
        let [p, q] = ends.map(|end| sites[end as usize]);
        let step = steps.map_or([0.0; 2], |steps| steps[k]);
        let away = [q[0] + step[0] - p[0], q[1] + step[1] - p[1]];
        for (end, away) in [(ends[0], away), (ends[1], away.map(|x| -x))] {
            // Counted two places on, filled one place on: what is left at the end are the starts.
            let place = &mut starts[end as usize + 1];
            found[*place] = away;
            *place += 1;
        }
    }
    (starts, found)
}

/// The part of a polygon about the origin that is no farther from it than from `away` (Sutherland, Hodgman 1974).
fn cut(polygon: &[Point], away: Point, kept: &mut Vec<Point>) {
    let half = 0.5 * (away[0] * away[0] + away[1] * away[1]);
    let beyond = |p: Point| p[0] * away[0] + p[1] * away[1] - half;
    kept.clear();
    for (i, &p) in polygon.iter().enumerate() {
        let q = polygon[(i + 1) % polygon.len()];
        let (a, b) = (beyond(p), beyond(q));
        if a <= 0.0 {
            kept.push(p);
        }
        if (a < 0.0 && b > 0.0) || (a > 0.0 && b < 0.0) {
            let t = a / (a - b);
            kept.push([p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])]);
        }
    }
}
