//! Hooks: where a crack turns back on itself, as the wall about a plate does and no crack that grew.

use super::aged::Aged;
use super::fence::{Fence, FenceView};
use super::net::{Ends, NONE, Net, NetView};
use crate::error::{Error, Result};
use crate::graph::Point;
use crate::watch::Watch;

/// A crack is looked at over its reach, and over these parts of it: one that turns back and forth within the reach comes
/// out straight over all of it.
const SCALES: [f64; 3] = [1.0, 0.5, 0.25];

/// Which edges stay when cracks are parted where they turn back; `partner` is what [`super::pairs`] gives.
///
/// At every vertex that a crack passes the ways to the places `reach`, a half and a quarter of it along the crack on both
/// sides are compared: where one of them turns by more than `sharpest` radians, the shorter of the two edges is left out,
/// or, where others meet them, two cracks end there. Sharpest turns first; a crack with a gap is two. Of three edges that
/// meet, two that stay are one crack, which is looked at again.
///
/// # Errors
/// [`Error::BadValue`], [`Error::Interrupted`].
///
/// # Source
/// Ours: cracks that run side by side overlap with free tips.
pub fn parted(net: NetView<'_>, partner: &[i32], sharpest: f64, reach: f64, watch: Watch<'_>) -> Result<Vec<bool>> {
    Ok(Parting::of(net, partner, [sharpest, reach], watch)?.stays)
}

/// A drawing while its cracks are parted.
struct Parting<'a> {
    net: NetView<'a>,
    ends: Ends,
    partner: Vec<i32>,
    stays: Vec<bool>,
    degrees: Vec<u32>,
}

impl<'a> Parting<'a> {
    /// See [`parted`].
    fn of(net: NetView<'a>, partner: &[i32], [sharpest, reach]: [f64; 2], watch: Watch<'_>) -> Result<Self> {
        for (name, value) in [("hairpin", sharpest), ("reach", reach)] {
            if !(value.is_finite() && value >= 0.0) {
                return Err(Error::BadValue { name, value, wanted: "a finite number of at least 0 is wanted" });
            }
        }
        let limit = -libm::cos(sharpest.min(std::f64::consts::PI));
        let mut parting = Self {
            net,
            ends: Ends::of(net),
            partner: partner.to_vec(),
            stays: vec![true; net.edges.len()],
            degrees: net.degrees(),
        };
        loop {
            let mut hooks = Vec::new();
            for a in 0..parting.partner.len() as u32 {
                watch.poll_at(a as usize)?;
                let Ok(b) = u32::try_from(parting.partner[a as usize]) else { continue };
                // Each pair once; what is cut goes on outside.
                if a < b && !net.cut[net.vertex(a)] {
                    hooks.extend(Some((parting.cosine(a, b, reach), a, b)).filter(|&(cosine, ..)| cosine > limit));
                }
            }
            hooks.sort_by(|p, q| q.0.total_cmp(&p.0).then(p.1.cmp(&q.1)));
            if hooks.is_empty() {
                return Ok(parting);
            }
            for (_, a, b) in hooks {
                // A gap that was made since may have left no turn.
                if parting.partner[a as usize] == b as i32 && parting.cosine(a, b, reach) > limit {
                    parting.part(a, b);
                }
            }
        }
    }

    /// The largest cosine between the ways on both sides of a vertex.
    fn cosine(&self, a: u32, b: u32, reach: f64) -> f64 {
        let between = |part: f64| {
            let [a, b] = [a, b].map(|end| way(self.net, &self.partner, end, part * reach));
            cosine(a, b)
        };
        SCALES.map(between).into_iter().fold(-1.0, f64::max)
    }

    /// Leaves out the shorter of two edges where no other meets them; where one does, the cracks end.
    fn part(&mut self, a: u32, b: u32) {
        let net = self.net;
        if self.degrees[net.vertex(a)] > 2 {
            [self.partner[a as usize], self.partner[b as usize]] = [NONE; 2];
            return;
        }
        let end = if net.length(a as usize / 2) <= net.length(b as usize / 2) { a } else { b };
        self.stays[end as usize / 2] = false;
        for end in [end, end ^ 1] {
            let other = std::mem::replace(&mut self.partner[end as usize], NONE);
            if let Ok(other) = usize::try_from(other) {
                self.partner[other] = NONE;
            }
            let vertex = net.vertex(end);
            self.degrees[vertex] -= 1;
            let mut left = self.ends.at(vertex).iter().copied().filter(|&end| self.stays[end as usize / 2]);
            if let (2, Some(a), Some(b)) = (self.degrees[vertex], left.next(), left.next()) {
                [self.partner[a as usize], self.partner[b as usize]] = [b as i32, a as i32];
            }
        }
    }
}

/// The drawing without the edges that [`parted`] leaves out: `turn` is its sharpest turn and its reach. Their kites stay
/// as those of edges that are not drawn, and vertices that have no edge any more as the first anchors.
///
/// # Errors
/// Those of [`parted`].
pub fn part(
    net: NetView<'_>,
    partner: &[i32],
    fence: FenceView<'_>,
    age: &[i32],
    turn: [f64; 2],
    watch: Watch<'_>,
) -> Result<Aged> {
    let Parting { stays, partner, degrees, .. } = Parting::of(net, partner, turn, watch)?;
    let drawn: Vec<usize> = (0..stays.len()).filter(|&k| stays[k]).collect();
    let gone = (0..stays.len()).filter(|&k| !stays[k]);
    let rows: Vec<usize> = drawn.iter().copied().chain(gone).chain(stays.len()..fence.kites.len()).collect();
    let mut number = vec![NONE; stays.len()];
    drawn.iter().zip(0..).for_each(|(&k, place)| number[k] = place);
    let partner_of = |end: i32| match end {
        NONE => NONE,
        _ => 2 * number[end as usize / 2] + end % 2,
    };
    let (ends, bare): (Vec<usize>, Vec<usize>) = (0..degrees.len()).partition(|&vertex| degrees[vertex] > 0);
    let mut corner = vec![NONE; degrees.len()];
    ends.iter().chain(&bare).zip(0..).for_each(|(&vertex, place)| corner[vertex] = place);
    // The other anchors keep their numbers: there are as many points as there were.
    let corner_of = |old: i32| corner.get(old as usize).copied().unwrap_or(old);
    Ok(Aged {
        net: Net {
            vertices: ends.iter().map(|&vertex| net.vertices[vertex]).collect(),
            edges: drawn.iter().map(|&k| net.edges[k].map(corner_of)).collect(),
            shifts: drawn.iter().filter_map(|&k| net.shifts.get(k).copied()).collect(),
            period: net.period,
            cut: ends.iter().map(|&vertex| net.cut[vertex]).collect(),
        },
        fence: Fence {
            anchors: bare.iter().map(|&vertex| net.vertices[vertex]).chain(fence.anchors.iter().copied()).collect(),
            kites: rows.iter().map(|&row| fence.kites[row].map(corner_of)).collect(),
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

fn cosine(a: Point, b: Point) -> f64 {
    let sizes = libm::hypot(a[0], a[1]) * libm::hypot(b[0], b[1]);
    if sizes > 0.0 { (a[0] * b[0] + a[1] * b[1]) / sizes } else { -1.0 }
}
