//! A drawing as a mask: what a photograph's label of it would be.

use super::Mask;
use super::network::Drawing;
use crate::clip::Bounds;
use crate::error::{Error, Result};
use crate::graph::Point;
use crate::watch::Watch;

/// Pixels whose centre lies on a crack, and the line of pixels along every edge, so that none breaks up.
///
/// `bounds` is what the picture shows, `widths` in data units; a drawing with `shifts` is repeated where it runs over
/// its period.
///
/// # Errors
/// As [`Drawing::check`]; [`Error::BadValue`] for a picture without pixels; [`Error::Interrupted`].
pub fn stamp(drawing: &Drawing<'_>, bounds: Bounds, height: usize, width: usize, watch: Watch<'_>) -> Result<Mask> {
    drawing.check(watch)?;
    crate::clip::check_bounds(bounds)?;
    let limit = i32::MAX as usize / 2;
    let count = height.saturating_mul(width);
    if count == 0 || count > limit {
        return Err(Error::BadValue { name: "size", value: count as f64, wanted: "1 to 2^30 pixels are wanted" });
    }
    let mut mask = Mask::new(vec![false; count], height, width)?;
    let scale = [width as f64 / (bounds[2] - bounds[0]), height as f64 / (bounds[3] - bounds[1])];
    for k in 0..drawing.edges.len() {
        watch.poll_at(k)?;
        let from = drawing.vertices[drawing.edges[k][0] as usize];
        let way = drawing.step(2 * k as u32);
        let radius = drawing.widths.get(k).map_or([0.0; 2], |pair| pair.map(|w| w / 2.0 * scale[0]));
        for [right, up] in copies(drawing, k) {
            let start = [from[0] - bounds[0] + right, bounds[3] - from[1] - up];
            let a = [start[0] * scale[0], start[1] * scale[1]];
            let b = [(start[0] + way[0]) * scale[0], (start[1] - way[1]) * scale[1]];
            band(&mut mask, a, b, radius);
            line(&mut mask, a, b);
        }
    }
    Ok(mask)
}

/// Where an edge is drawn: once, or at all places a period apart that may reach into one period.
fn copies(drawing: &Drawing<'_>, k: usize) -> Vec<Point> {
    if drawing.shifts.is_empty() || drawing.shifts[k] == [0; 2] && drawing.widths.is_empty() {
        return vec![[0.0; 2]];
    }
    let steps = [-1.0, 0.0, 1.0];
    steps.into_iter().flat_map(|x| steps.map(|y| [x * drawing.period[0], y * drawing.period[1]])).collect()
}

fn clamped(from: f64, to: f64, limit: usize) -> std::ops::Range<usize> {
    let within = |x: f64| x.clamp(0.0, limit as f64) as usize;
    within(from.floor())..within(to.ceil() + 1.0)
}

/// Marks pixels with their centre within the radius, which runs from one end to the other.
fn band(mask: &mut Mask, a: Point, b: Point, radius: [f64; 2]) {
    let most = radius[0].max(radius[1]);
    if most <= 0.5 {
        return;
    }
    let way = [b[0] - a[0], b[1] - a[1]];
    let square = way[0] * way[0] + way[1] * way[1];
    for row in clamped(a[1].min(b[1]) - most, a[1].max(b[1]) + most, mask.height) {
        let [from, to] = beside(a, way, row as f64 + 0.5, most + 1.0);
        for column in clamped(from - most, to + most, mask.width) {
            let to = [column as f64 + 0.5 - a[0], row as f64 + 0.5 - a[1]];
            let along = if square > 0.0 { (to[0] * way[0] + to[1] * way[1]) / square } else { 0.0 }.clamp(0.0, 1.0);
            let off = [to[0] - along * way[0], to[1] - along * way[1]];
            if libm::hypot(off[0], off[1]) <= radius[0] + along * (radius[1] - radius[0]) {
                mask.pixels[row * mask.width + column] = true;
            }
        }
    }
}

/// Where a segment is no farther above or below a height than `away`, from the left to the right: not the whole box of a
/// long slanting one.
fn beside(a: Point, way: [f64; 2], height: f64, away: f64) -> [f64; 2] {
    let ends = match way[1] {
        0.0 => [0.0, 1.0],
        up => [height - away, height + away].map(|at| ((at - a[1]) / up).clamp(0.0, 1.0)),
    };
    let [p, q] = ends.map(|part| a[0] + part * way[0]);
    [p.min(q), p.max(q)]
}

/// Marks one pixel a step along the longer direction.
fn line(mask: &mut Mask, a: Point, b: Point) {
    let Some([a, b]) = inside(mask, a, b) else { return };
    let way = [b[0] - a[0], b[1] - a[1]];
    let steps = way[0].abs().max(way[1].abs()).ceil().max(1.0);
    for i in 0..=steps as usize {
        let part = i as f64 / steps;
        let [x, y] = [0, 1].map(|k| (a[k] + part * way[k]).floor());
        if x >= 0.0 && y >= 0.0 && x < mask.width as f64 && y < mask.height as f64 {
            mask.pixels[y as usize * mask.width + x as usize] = true;
        }
    }
}

/// The part of an edge in the picture, if there is one, so that far ends cost nothing.
fn inside(mask: &Mask, a: Point, b: Point) -> Option<[Point; 2]> {
    let way = [b[0] - a[0], b[1] - a[1]];
    let (mut from, mut to) = (0.0_f64, 1.0_f64);
    for (i, limit) in [(0, mask.width as f64), (1, mask.height as f64)] {
        if way[i] == 0.0 {
            if !(0.0..=limit).contains(&a[i]) {
                return None;
            }
            continue;
        }
        let meets = [-a[i] / way[i], (limit - a[i]) / way[i]];
        from = from.max(meets[0].min(meets[1]));
        to = to.min(meets[0].max(meets[1]));
    }
    (from <= to).then(|| [from, to].map(|part| [a[0] + part * way[0], a[1] + part * way[1]]))
}
