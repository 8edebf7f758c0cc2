//! Hooks: where a crack turns back on itself, as the wall about a plate does and no crack that grew.

use super::aged::Aged;
use super::fence::{Fence, FenceView};
use super::net::{Ends, NONE, Net, NetView};
use crate::error::{Error, Result};
use crate::graph::Point;
use crate::watch::Watch;

/// Which edges stay when cracks are parted where they turn back; `partner` is what [`super::pairs`] gives.
///
/// At a vertex inside a crack the ways to the places `reach` along it on both sides are compared: where the crack turns
/// by more than `sharpest` radians, the shorter of the two edges there is left out, or the other where the shorter one
/// holds a free tip. Sharpest turns first; a crack with a gap is two. No vertex loses all its edges.
///
/// # Errors
/// [`Error::BadValue`], [`Error::Interrupted`].
///
/// # Source
/// Ours: cracks that run side by side overlap with free tips.
pub fn parted(net: NetView<'_>, partner: &[i32], sharpest: f64, reach: f64, watch: Watch<'_>) -> Result<Vec<bool>> {
    for (name, value) in [("hairpin", sharpest), ("reach", reach)] {
        if !(value.is_finite() && value >= 0.0) {
            return Err(Error::BadValue { name, value, wanted: "a finite number of at least 0 is wanted" });
        }
    }
    let ends = Ends::of(net);
    let limit = -libm::cos(sharpest.min(std::f64::consts::PI));
    let mut stays = vec![true; net.edges.len()];
    let mut degrees = net.degrees();
    let mut hooks = Vec::new();
    for vertex in (0..net.vertices.len()).filter(|&vertex| !net.cut[vertex]) {
        watch.poll_at(vertex)?;
        if let &[a, b] = ends.at(vertex) {
            let cosine = cosine(way(net, partner, a, reach), way(net, partner, b, reach));
            if partner[a as usize] == b as i32 && cosine > limit {
                hooks.push((cosine, a, b));
            }
        }
    }
    hooks.sort_by(|p, q| q.0.total_cmp(&p.0).then(p.1.cmp(&q.1)));
    for (_, a, b) in hooks {
        // One gap is enough: within reach of it there is no turn any more.
        if !(is_whole(net, partner, &stays, a, reach) && is_whole(net, partner, &stays, b, reach)) {
            continue;
        }
        let (first, last) = if net.length(a as usize / 2) <= net.length(b as usize / 2) { (a, b) } else { (b, a) };
        if let Some(end) = [first, last].into_iter().find(|&end| degrees[net.vertex(end ^ 1)] > 1) {
            stays[end as usize / 2] = false;
            degrees[net.vertex(end)] -= 1;
            degrees[net.vertex(end ^ 1)] -= 1;
        }
    }
    Ok(stays)
}

/// The drawing without the edges that [`parted`] leaves out: `turn` is its sharpest turn and its reach. Their kites stay
/// as those of edges that are not drawn.
///
/// # Errors
/// Those of [`parted`].
pub fn part(
    net: NetView<'_>,
    partner: &[i32],
    fence: FenceView<'_>,
    age: &[i32],
    [sharpest, reach]: [f64; 2],
    watch: Watch<'_>,
) -> Result<Aged> {
    let stays = parted(net, partner, sharpest, reach, watch)?;
    let drawn: Vec<usize> = (0..stays.len()).filter(|&k| stays[k]).collect();
    let gone = (0..stays.len()).filter(|&k| !stays[k]);
    let rows: Vec<usize> = drawn.iter().copied().chain(gone).chain(stays.len()..fence.kites.len()).collect();
    let mut number = vec![NONE; stays.len()];
    drawn.iter().zip(0..).for_each(|(&k, place)| number[k] = place);
    let partner_of = |end: i32| match end {
        NONE => NONE,
        _ if !stays[end as usize / 2] => NONE,
        _ => 2 * number[end as usize / 2] + end % 2,
    };
    Ok(Aged {
        net: Net {
            vertices: net.vertices.to_vec(),
            edges: drawn.iter().map(|&k| net.edges[k]).collect(),
            shifts: drawn.iter().filter_map(|&k| net.shifts.get(k).copied()).collect(),
            period: net.period,
            cut: net.cut.to_vec(),
        },
        fence: Fence {
            anchors: fence.anchors.to_vec(),
            kites: rows.iter().map(|&row| fence.kites[row]).collect(),
            shifts: rows.iter().filter_map(|&row| fence.shifts.get(row).copied()).collect(),
        },
        partner: drawn.iter().flat_map(|&k| [partner[2 * k], partner[2 * k + 1]].map(partner_of)).collect(),
        age: drawn.iter().filter_map(|&k| age.get(k).copied()).collect(),
    })
}

/// Ends by which edges are entered, from `end` along its crack for a length, each with the run before it.
fn along(net: NetView<'_>, partner: &[i32], end: u32, reach: f64) -> impl Iterator<Item = (u32, f64)> {
    let (mut next, mut run, mut steps) = (end as i32, 0.0, 0);
    std::iter::from_fn(move || {
        // A crack in a ring ends where it began.
        if next == NONE || run >= reach.max(f64::MIN_POSITIVE) || steps > net.edges.len() {
            return None;
        }
        let found = (next as u32, run);
        run += net.length(next as usize / 2);
        steps += 1;
        next = partner[(next ^ 1) as usize];
        Some(found)
    })
}

/// From an end to the place `reach` along its crack.
fn way(net: NetView<'_>, partner: &[i32], end: u32, reach: f64) -> Point {
    let mut at = [0.0; 2];
    for (entry, run) in along(net, partner, end, reach) {
        let (step, length) = (net.along(entry), net.length(entry as usize / 2));
        let part = if run + length > reach && reach > 0.0 { (reach - run) / length } else { 1.0 };
        at = [0, 1].map(|i| at[i] + part * step[i]);
    }
    at
}

fn is_whole(net: NetView<'_>, partner: &[i32], stays: &[bool], end: u32, reach: f64) -> bool {
    along(net, partner, end, reach).all(|(entry, _)| stays[entry as usize / 2])
}

fn cosine(a: Point, b: Point) -> f64 {
    let sizes = libm::hypot(a[0], a[1]) * libm::hypot(b[0], b[1]);
    if sizes > 0.0 { (a[0] * b[0] + a[1] * b[1]) / sizes } else { -1.0 }
}
