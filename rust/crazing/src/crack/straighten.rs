//! Straight cracks: strands are pulled to their chords and slide along them, so that cracks that abut meet them at
//! right angles.

use std::ops::Range;

use super::fence::{FenceView, Guard};
use super::net::{Ends, NONE, NetView};
use crate::error::{Error, Result};
use crate::graph::Point;
use crate::parallel;
use crate::watch::Watch;

/// How strands are straightened.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Straightening {
    /// Rounds; 2 to 5 measure like paint, 40 are too straight.
    pub rounds: u32,
    /// The part of the way to the chord in a round, 0 to 1.
    pub pull: f64,
    /// The part of the way along the chord to where the abutting crack meets it at 90 degrees, 0 to 1.
    pub slide: f64,
    /// The part of the chord at both ends that sliding keeps out of, 0 to 1/2.
    pub clamp: f64,
}

/// The vertices of a drawing after straightening; `partner` is what [`super::pairs`] gives.
///
/// A vertex that a strand passes moves toward the chord between its neighbours on the strand, and slides along it
/// toward the foot of the one other edge there. No move lets edges cross or change sides: moves that would are halved
/// twice, then left out. Cut ends stay.
///
/// # Errors
/// [`Error::BadValue`], [`Error::Interrupted`].
///
/// # Source
/// Ours, after measurements of paint; the law of the fence: see [`super::Fence`].
pub fn straighten(
    net: NetView<'_>,
    partner: &[i32],
    fence: FenceView<'_>,
    how: Straightening,
    watch: Watch<'_>,
) -> Result<Vec<Point>> {
    for (name, value, most) in [("pull", how.pull, 1.0), ("slide", how.slide, 1.0), ("clamp", how.clamp, 0.5)] {
        if !(0.0..=most).contains(&value) {
            return Err(Error::BadValue { name, value, wanted: "0 to 1 is wanted, of clamp 0 to 0.5" });
        }
    }
    let passes = passes(net, partner);
    let mut guard = Guard::of(net, fence);
    for _ in 0..how.rounds {
        watch.poll()?;
        // Where to is decided for all at once, so that the order of moves leaves no trace; then one moves at a time.
        let moves = parallel::map(passes.len(), |i| (passes[i].vertex, target(net, &guard, &passes[i], how)));
        guard.advance(&moves, watch)?;
    }
    Ok(guard.into_vertices())
}

/// A vertex that one strand passes, or two: the ends of edges there that continue each other.
struct Pass {
    vertex: u32,
    through: [i32; 2],
    second: [i32; 2],
    /// The one other edge.
    abutting: i32,
}

fn passes(net: NetView<'_>, partner: &[i32]) -> Vec<Pass> {
    let ends = Ends::of(net);
    let pass = |vertex: usize| {
        let here = ends.at(vertex);
        let mut pairs = here.iter().filter_map(|&end| {
            let other = partner[end as usize];
            (other > end as i32).then_some([end as i32, other])
        });
        let through = pairs.next()?;
        let alone = || here.iter().find(|&&end| partner[end as usize] == NONE).map_or(NONE, |&end| end as i32);
        let abutting = if here.len() == 3 { alone() } else { NONE };
        Some(Pass { vertex: vertex as u32, through, second: pairs.next().unwrap_or([NONE; 2]), abutting })
    };
    let of_range =
        |range: Range<usize>| -> Vec<Pass> { range.filter(|&vertex| !net.cut[vertex]).filter_map(pass).collect() };
    parallel::ranges(net.vertices.len(), of_range).into_iter().flatten().collect()
}

fn target(net: NetView<'_>, guard: &Guard<'_>, pass: &Pass, how: Straightening) -> Point {
    let here = guard.place(pass.vertex as usize);
    // Where the edge at an end leads, seen from here.
    let far = |end: i32| {
        let (edge, period) = (end as usize / 2, guard.period());
        let sign = if end % 2 == 0 { 1.0 } else { -1.0 };
        let shift = net.shift(edge);
        let p = guard.place(net.vertex(end as u32 ^ 1));
        [0, 1].map(|i| p[i] + sign * f64::from(shift[i]) * period[i])
    };
    let on_chord =
        |[a, b]: [i32; 2]| on_chord(here, [far(a), far(b)], (pass.abutting != NONE).then(|| far(pass.abutting)), how);
    if pass.second[0] == NONE {
        return on_chord(pass.through);
    }
    let (first, second) = (on_chord(pass.through), on_chord(pass.second));
    [0, 1].map(|i| 0.5 * (first[i] + second[i]))
}

/// Where a vertex on the strand from `a` to `b` goes.
fn on_chord(here: Point, [a, b]: [Point; 2], abutting: Option<Point>, how: Straightening) -> Point {
    let chord = [b[0] - a[0], b[1] - a[1]];
    let square = chord[0] * chord[0] + chord[1] * chord[1];
    let along = |p: Point| ((p[0] - a[0]) * chord[0] + (p[1] - a[1]) * chord[1]) / square;
    let foot = along(here);
    if !foot.is_finite() {
        return here;
    }
    // Along the chord only where an edge abuts; across it always.
    let slid = abutting.map_or(foot, |c| foot + how.slide * (along(c).clamp(how.clamp, 1.0 - how.clamp) - foot));
    [0, 1].map(|i| here[i] + (slid - foot) * chord[i] + how.pull * (a[i] + foot * chord[i] - here[i]))
}
