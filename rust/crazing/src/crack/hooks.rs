//! Hooks: where a crack turns back on itself, as the wall about a plate does and no crack that grew.

use super::aged::Aged;
use super::fence::{Fence, FenceView};
use super::net::{self, Ends, NONE, Net, NetView};
use crate::error::{Error, Result};
use crate::graph::Point;
use crate::parallel;
use crate::watch::Watch;

/// A crack is looked at over its reach, and over these parts of it: one that turns back and forth within the reach comes
/// out straight over all of it.
const PARTS: [f64; 3] = [0.25, 0.5, 1.0];

/// Edges along a crack that are looked at on either side, however short they are beside the reach. Those of plates are
/// some, those of a traced line some tens.
const MOST: usize = 128;

/// Turns that are looked at between two looks at whether to go on.
const AT_ONCE: usize = 1 << 18;

/// How sharply cracks may turn, and over which way.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Turning {
    /// The sharpest turn that stays, radians.
    pub sharpest: f64,
    /// How far along the crack it is looked for, over 128 edges at most.
    pub reach: f64,
    /// How far apart the anchors on both sides of an edge are for which that holds: where they are farther apart, plates
    /// are larger, and the reach longer in proportion. 0 if it is one everywhere.
    pub spacing: f64,
}

/// Which edges stay when cracks are parted where they turn back; `partner` is what [`super::pairs`] gives.
///
/// At every vertex that a crack passes the ways to the places a reach, a half and a quarter of it along the crack on both
/// sides are compared: where one of them turns by more than the sharpest turn, the shorter of the two edges is left out,
/// or, where others meet them, two cracks end there. Sharpest turns first; a crack with a gap is two. Of three edges that
/// meet, two that stay are one crack, which is looked at again.
///
/// # Errors
/// [`Error::BadValue`], [`Error::Interrupted`].
///
/// # Source
/// Ours: cracks that run side by side overlap with free tips.
pub fn parted(
    net: NetView<'_>,
    partner: &[i32],
    fence: FenceView<'_>,
    turn: Turning,
    watch: Watch<'_>,
) -> Result<Vec<bool>> {
    Ok(Parting::of(net, Ends::of(net), partner, fence, turn, watch)?.stays)
}

/// A drawing while its cracks are parted.
struct Parting<'a> {
    net: NetView<'a>,
    /// The reach of every edge, or the one of all.
    reaches: Vec<f64>,
    /// The longest of them.
    farthest: f64,
    /// From the first end of each edge to the second, and its length.
    spans: Vec<(Point, f64)>,
    ends: Ends,
    partner: Vec<i32>,
    stays: Vec<bool>,
    degrees: Vec<u32>,
    /// Ends, at vertices that cracks pass, whose turns are to be looked at; of a pair the lower one.
    suspects: Vec<u32>,
    /// Whether an end is one of them, and not as it was when it was last looked at.
    has_changed: Vec<bool>,
}

impl<'a> Parting<'a> {
    /// See [`parted`].
    fn of(
        net: NetView<'a>,
        ends: Ends,
        partner: &[i32],
        fence: FenceView<'_>,
        turn: Turning,
        watch: Watch<'_>,
    ) -> Result<Self> {
        let Turning { sharpest, reach, spacing } = turn;
        for (name, value) in [("hairpin", sharpest), ("reach", reach), ("spacing", spacing)] {
            if !(value.is_finite() && value >= 0.0) {
                return Err(Error::BadValue { name, value, wanted: "a finite number of at least 0 is wanted" });
            }
        }
        let limit = if sharpest < std::f64::consts::PI { -libm::cos(sharpest) } else { f64::INFINITY };
        let reaches = reaches(net, fence, reach, spacing);
        let mut parting = Self {
            net,
            farthest: reaches.iter().copied().fold(0.0, f64::max),
            reaches,
            spans: parallel::map(net.edges.len(), |edge| (net.along(2 * edge as u32), net.length(edge))),
            ends,
            partner: partner.to_vec(),
            stays: vec![true; net.edges.len()],
            degrees: net.degrees(),
            suspects: parallel::compact(partner.len(), |end| (partner[end] > end as i32).then_some(end as u32)),
            has_changed: vec![false; partner.len()],
        };
        let mut hooks = Vec::new();
        while !parting.suspects.is_empty() {
            for suspects in std::mem::take(&mut parting.suspects).chunks(AT_ONCE) {
                watch.poll()?;
                suspects.iter().for_each(|&end| parting.has_changed[end as usize] = false);
                let found = parallel::ranges(suspects.len(), |range| {
                    suspects[range].iter().filter_map(|&end| parting.hook(end, limit)).collect::<Vec<_>>()
                });
                hooks.extend(found.into_iter().flatten());
            }
            hooks.sort_by(|p, q| q.0.total_cmp(&p.0).then(p.1.cmp(&q.1)));
            for (step, (_, a, b)) in hooks.drain(..).enumerate() {
                watch.poll_at(step)?;
                // A gap that was made since may have left no turn.
                let is_one = parting.partner[a as usize] == b as i32;
                if is_one && (!parting.has_changed[a as usize] || parting.cosine(a, b) > limit) {
                    parting.part(a, b);
                }
            }
            parting.suspects.sort_unstable();
            parting.suspects.dedup();
        }
        Ok(parting)
    }

    /// The turn of the crack that passes the vertex of an end, if it is sharper than the limit: its cosine, and both ends.
    fn hook(&self, a: u32, limit: f64) -> Option<(f64, u32, u32)> {
        // What is cut goes on outside.
        let other = u32::try_from(self.partner[a as usize]).ok();
        let pair = other.filter(|&b| a < b && !self.net.cut[self.net.vertex(a)]);
        let hook = pair.map(|b| (self.cosine(a, b), a, b));
        hook.filter(|&(cosine, ..)| cosine > limit)
    }

    /// The largest cosine between the ways on both sides of a vertex.
    fn cosine(&self, a: u32, b: u32) -> f64 {
        let reach = self.reach(a).max(self.reach(b));
        let (first, second) = (self.ways(a, reach), self.ways(b, reach));
        first.into_iter().zip(second).map(|(a, b)| cosine(a, b)).fold(-1.0, f64::max)
    }

    fn reach(&self, end: u32) -> f64 {
        self.reaches[if self.reaches.len() > 1 { end as usize / 2 } else { 0 }]
    }

    /// Ends by which edges are entered, from one along its crack for a reach, each with the run before it.
    fn along(&self, end: u32, reach: f64) -> impl Iterator<Item = (u32, f64)> {
        let (mut next, mut run, mut steps) = (end as i32, 0.0, 0);
        std::iter::from_fn(move || {
            // A crack in a ring ends where it began.
            if next == NONE || run >= reach.max(f64::MIN_POSITIVE) || steps > self.spans.len().min(MOST - 1) {
                return None;
            }
            let found = (next as u32, run);
            run += self.spans[next as usize / 2].1;
            steps += 1;
            next = self.partner[(next ^ 1) as usize];
            Some(found)
        })
    }

    /// From an end to the places at all parts of the reach along its crack, or to where it ends.
    fn ways(&self, end: u32, reach: f64) -> [Point; PARTS.len()] {
        let (mut at, mut ways, mut found) = ([0.0; 2], [[0.0; 2]; PARTS.len()], 0);
        for (entry, run) in self.along(end, reach) {
            let (step, length) = self.spans[entry as usize / 2];
            let step = if entry.is_multiple_of(2) { step } else { step.map(|part| -part) };
            while found < PARTS.len() && reach > 0.0 && run + length > PARTS[found] * reach {
                let part = (PARTS[found] * reach - run) / length;
                ways[found] = [0, 1].map(|i| at[i] + part * step[i]);
                found += 1;
            }
            at = [0, 1].map(|i| at[i] + step[i]);
        }
        ways[found..].fill(at);
        ways
    }

    /// Leaves out the shorter of two edges where no other meets them; where one does, the cracks end.
    fn part(&mut self, a: u32, b: u32) {
        let net = self.net;
        if self.degrees[net.vertex(a)] > 2 {
            [self.partner[a as usize], self.partner[b as usize]] = [NONE; 2];
            [a, b].into_iter().for_each(|end| self.suspect(end));
            return;
        }
        let end = if self.spans[a as usize / 2].1 <= self.spans[b as usize / 2].1 { a } else { b };
        self.stays[end as usize / 2] = false;
        let others = [end, end ^ 1].map(|end| std::mem::replace(&mut self.partner[end as usize], NONE));
        for other in others.into_iter().filter_map(|other| u32::try_from(other).ok()) {
            self.partner[other as usize] = NONE;
            self.suspect(other);
        }
        for vertex in [end, end ^ 1].map(|end| net.vertex(end)) {
            self.degrees[vertex] -= 1;
            let mut left = self.ends.at(vertex).iter().copied().filter(|&end| self.stays[end as usize / 2]);
            if let (2, Some(a), Some(b)) = (self.degrees[vertex], left.next(), left.next()) {
                [self.partner[a as usize], self.partner[b as usize]] = [b as i32, a as i32];
                self.doubt(a.min(b));
                [a, b].into_iter().for_each(|end| self.suspect(end));
            }
        }
    }

    /// What lies within reach along the crack from an end turns otherwise now.
    fn suspect(&mut self, end: u32) {
        let entries: Vec<u32> = self.along(end, self.farthest).map(|(entry, _)| entry).collect();
        for entry in entries {
            let out = entry ^ 1;
            if let Ok(other) = u32::try_from(self.partner[out as usize]) {
                self.doubt(other.min(out));
            }
        }
    }

    fn doubt(&mut self, end: u32) {
        self.suspects.push(end);
        self.has_changed[end as usize] = true;
    }
}

/// The reach of every edge, or one for all.
fn reaches(net: NetView<'_>, fence: FenceView<'_>, reach: f64, spacing: f64) -> Vec<f64> {
    if spacing == 0.0 {
        return vec![reach];
    }
    let of_edge = |row: usize| {
        let place = |corner: usize| {
            let anchor = fence.anchors.get((fence.kites[row][corner] as usize).wrapping_sub(net.vertices.len()));
            let turns = fence.shifts.get(row).map_or([0; 2], |shift| [shift[2 * corner - 2], shift[2 * corner - 1]]);
            anchor.map(|&anchor| net.moved(anchor, turns))
        };
        let apart = place(2).zip(place(3)).map_or(0.0, |([x, y], [u, v])| net::length([u - x, v - y]));
        reach * (apart / spacing).max(1.0)
    };
    parallel::map(net.edges.len(), of_edge)
}

/// The drawing without the edges that [`parted`] leaves out. Their kites stay
/// as those of edges that are not drawn, and vertices that have no edge any more as the first anchors.
///
/// # Errors
/// Those of [`parted`].
pub fn part(
    net: NetView<'_>,
    partner: &[i32],
    fence: FenceView<'_>,
    age: &[i32],
    turn: Turning,
    watch: Watch<'_>,
) -> Result<Aged> {
    apart(net, Ends::of(net), partner, fence, age, turn, watch)
}

/// The same where it is known who meets where.
pub(super) fn apart(
    net: NetView<'_>,
    ends: Ends,
    partner: &[i32],
    fence: FenceView<'_>,
    age: &[i32],
    turn: Turning,
    watch: Watch<'_>,
) -> Result<Aged> {
    let Parting { stays, partner, degrees, .. } = Parting::of(net, ends, partner, fence, turn, watch)?;
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
            vertices: parallel::map(ends.len(), |i| net.vertices[ends[i]]),
            edges: parallel::map(drawn.len(), |i| net.edges[drawn[i]].map(corner_of)),
            shifts: drawn.iter().filter_map(|&k| net.shifts.get(k).copied()).collect(),
            period: net.period,
            cut: ends.iter().map(|&vertex| net.cut[vertex]).collect(),
        },
        fence: Fence {
            anchors: bare.iter().map(|&vertex| net.vertices[vertex]).chain(fence.anchors.iter().copied()).collect(),
            kites: parallel::map(rows.len(), |i| fence.kites[rows[i]].map(corner_of)),
            shifts: rows.iter().filter_map(|&row| fence.shifts.get(row).copied()).collect(),
        },
        partner: parallel::map(2 * drawn.len(), |end| partner_of(partner[2 * drawn[end / 2] + end % 2])),
        age: drawn.iter().filter_map(|&k| age.get(k).copied()).collect(),
    })
}

fn cosine(a: Point, b: Point) -> f64 {
    let sizes = net::length(a) * net::length(b);
    if sizes > 0.0 { (a[0] * b[0] + a[1] * b[1]) / sizes } else { -1.0 }
}
