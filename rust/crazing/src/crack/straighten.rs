//! Straight cracks: strands are pulled to their chords and slide along them, so that cracks that abut meet them at
//! right angles.

use super::fence::FenceView;
use super::guard::Guard;
use super::net::{Ends, NONE, NetView};
use crate::error::{Error, Result};
use crate::graph::Point;
use crate::parallel;
use crate::watch::Watch;

/// The part of the way to the chord that a bend goes in a round: a whole one would throw bends in a row past each other.
const HALF: f64 = 0.5;

/// How strands are straightened.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Straightening {
    /// Rounds that come first and pull at bends only: where two edges meet and no other crack. What opened doors leave
    /// of the walls about plates winds from plate to plate; a crack that nothing meets has no reason to.
    pub unbend: u32,
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
    straightened(net, &Ends::of(net), partner, fence, how, watch)
}

/// The same where it is known who meets where.
pub(super) fn straightened(
    net: NetView<'_>,
    ends: &Ends,
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
    let mut guard = Guard::of(net, fence);
    let bends = Straightening { rounds: how.unbend, pull: HALF, ..Straightening::default() };
    for (how, most) in [(bends, 2), (how, usize::MAX)].into_iter().filter(|(how, _)| how.rounds > 0) {
        let passes = Passes::of(net, ends, partner, most);
        for _ in 0..how.rounds {
            watch.poll()?;
            // Where to is decided for all at once, so that the order of moves leaves no trace; then one moves at a time.
            guard.advance(|guard, vertex| passes.target(guard, vertex, how), None, watch)?;
        }
    }
    Ok(guard.into_vertices())
}

/// The neighbours of every vertex that one strand passes, or two: on both sides along the first, on both along the
/// second, and along the one other edge; -1 for none.
struct Passes {
    far: Vec<[i32; 5]>,
    /// Periods to them; empty in the plane.
    turns: Vec<[[i16; 2]; 5]>,
}

/// The ends by which a vertex of at most so many is left: those of one strand, of a second, and the one other.
fn ends_of(net: NetView<'_>, ends: &Ends, partner: &[i32], most: usize, vertex: usize) -> [i32; 5] {
    let here = if net.cut[vertex] || ends.at(vertex).len() > most { &[] } else { ends.at(vertex) };
    let mut pairs = here.iter().filter_map(|&end| {
        let other = partner[end as usize];
        (other > end as i32).then_some([end as i32, other])
    });
    let Some([a, b]) = pairs.next() else { return [NONE; 5] };
    let [c, d] = pairs.next().unwrap_or([NONE; 2]);
    let alone = || here.iter().find(|&&end| partner[end as usize] == NONE).map_or(NONE, |&end| end as i32);
    [a, b, c, d, if here.len() == 3 { alone() } else { NONE }]
}

impl Passes {
    /// Of vertices with at most so many ends.
    fn of(net: NetView<'_>, ends: &Ends, partner: &[i32], most: usize) -> Self {
        let vertices = net.vertices.len();
        let far = |end: i32| if end == NONE { NONE } else { net.vertex(end as u32 ^ 1) as i32 };
        let turn = |end: i32| {
            let turn = if end == NONE { [0; 2] } else { net.shift(end as usize / 2).map(i16::from) };
            if end % 2 == 0 { turn } else { turn.map(|x| -x) }
        };
        let each = |vertex: usize| ends_of(net, ends, partner, most, vertex);
        Self {
            far: parallel::map(vertices, |vertex| each(vertex).map(far)),
            turns: parallel::map(if net.shifts.is_empty() { 0 } else { vertices }, |vertex| each(vertex).map(turn)),
        }
    }

    fn target(&self, guard: &Guard<'_>, vertex: usize, how: Straightening) -> Point {
        let (here, far) = (guard.place(vertex), self.far[vertex]);
        if far[0] == NONE {
            return here;
        }
        let place = |i: usize| {
            let p = guard.place(far[i] as usize);
            let Some(turns) = self.turns.get(vertex) else { return p };
            [0, 1].map(|k| p[k] + f64::from(turns[i][k]) * guard.period()[k])
        };
        let abutting = (far[4] != NONE).then(|| place(4));
        let first = on_chord(here, [place(0), place(1)], abutting, how);
        if far[2] == NONE {
            return first;
        }
        let second = on_chord(here, [place(2), place(3)], abutting, how);
        [0, 1].map(|i| 0.5 * (first[i] + second[i]))
    }
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
