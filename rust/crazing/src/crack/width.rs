//! Width: old and long cracks are wide, free tips run out to a point.

mod uneven;

use super::net::{NetView, length};
use super::noise::power;
use super::strand::Strands;
use crate::error::{Error, Result};
use crate::graph::Point;
use crate::parallel;
use crate::quantile;
use crate::rng::{Key, block, open_unit, stream};
use uneven::{Knots, Uneven};

/// How wide cracks are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Profile {
    /// Width of the longest strand, data units.
    pub width: f64,
    /// Width grows with this power of the strand's length: 0 makes all alike, 1/2 is what real cracks show.
    pub hierarchy: f64,
    /// Width is this part of the parent generation's.
    pub shrink: f64,
    /// The part of a strand over which a free tip runs out: 0 leaves it blunt.
    pub taper: f64,
    /// Width of an abutting end, relative to the strand's own.
    pub abutting: f64,
    /// Standard deviation of the logarithm of width, from strand to strand; half of it along a strand.
    pub unevenness: f64,
    /// The length over which width changes along a strand, data units.
    pub unit: f64,
    /// Where width is full; it falls to `1 / (1 + (distance / reach)^2)^(fade / 2)` of it elsewhere.
    pub source: Point,
    /// See `source`.
    pub reach: f64,
    /// See `source`; 0 is no source.
    pub fade: f64,
}

impl Default for Profile {
    fn default() -> Self {
        Self {
            width: 0.0,
            hierarchy: 0.5,
            shrink: 1.0,
            taper: 0.5,
            abutting: 0.6,
            unevenness: 0.0,
            unit: 1.0,
            source: [0.0; 2],
            reach: 1.0,
            fade: 0.0,
        }
    }
}

/// Width at the two ends of each edge.
///
/// # Errors
/// [`Error::BadValue`].
pub fn widths(net: NetView<'_>, strands: &Strands, profile: Profile, key: Key) -> Result<Vec<[f64; 2]>> {
    let starts: Vec<usize> = (0..=net.edges.len()).collect();
    widen(net, net, &starts, strands, &profile, key)
}

/// Widths of pieces: `whole` has the edges that `starts` says the pieces of, equal parts of each, and `net` the pieces.
///
/// Edge by edge in the order of memory: how far along its strand an edge is entered is known.
pub(super) fn widen(
    net: NetView<'_>,
    whole: NetView<'_>,
    starts: &[usize],
    strands: &Strands,
    profile: &Profile,
    key: Key,
) -> Result<Vec<[f64; 2]>> {
    check(profile)?;
    let longest = strands.length.iter().fold(f64::MIN_POSITIVE, |longest, &length| longest.max(length));
    let shapes = parallel::map(strands.run.len(), |run| Shape::of(whole, strands, profile, key, longest, run));
    let knots = Knots::of(strands, profile, key, starts[whole.edges.len()]);
    let mut widths = vec![[0.0; 2]; starts[whole.edges.len()]];
    parallel::grouped(
        whole.edges.len(),
        |edge| starts[edge],
        &mut widths,
        |edges, widths| {
            let mut rest = widths;
            for edge in edges {
                let own;
                (own, rest) = rest.split_at_mut(starts[edge + 1] - starts[edge]);
                let run = strands.run_of[edge] as usize;
                let way =
                    Way { before: strands.before[edge], turned: strands.turned[edge], length: whole.length(edge) };
                way.along(&shapes[run], knots.along(strands, run), own);
                if profile.fade != 0.0 {
                    fade(net, profile, starts[edge], own);
                }
            }
        },
    );
    Ok(widths)
}

/// The way along an edge, as a part of its run.
struct Way {
    /// How far along the run the edge is entered.
    before: f64,
    /// Whether that is at its second end.
    turned: bool,
    length: f64,
}

impl Way {
    /// Writes the widths of the pieces of the edge, in equal parts of it however far they wander: where an edge is cut more
    /// finely, it is as wide as before.
    fn along(&self, shape: &Shape, mut uneven: Uneven<'_>, pieces: &mut [[f64; 2]]) {
        // Exact where there are a power of two.
        let step = 1.0 / pieces.len() as f64;
        let mut at = |node: usize| {
            let part = node as f64 * step;
            let run = self.before + self.length * if self.turned { 1.0 - part } else { part };
            shape.at(run) * uneven.at(run)
        };
        let mut before = at(0);
        for (piece, node) in pieces.iter_mut().zip(1..) {
            let after = at(node);
            *piece = [before, after];
            before = after;
        }
    }
}

fn check(profile: &Profile) -> Result<()> {
    let values = [
        ("width", profile.width),
        ("hierarchy", profile.hierarchy),
        ("shrink", profile.shrink),
        ("taper", profile.taper),
        ("abutting", profile.abutting),
        ("unevenness", profile.unevenness),
        ("fade", profile.fade),
    ];
    match values.into_iter().find(|(_, value)| !(value.is_finite() && *value >= 0.0)) {
        Some((name, value)) => Err(Error::BadValue { name, value, wanted: "a finite number of at least 0 is wanted" }),
        None => Ok(()),
    }
}

/// A lognormal factor of its own for every strand and knot along it.
fn factor(spread: f64, key: Key, strand: usize, knot: u64) -> f64 {
    if spread == 0.0 {
        return 1.0;
    }
    let word = block(key, [strand as u64, knot, stream::WIDTH, 0])[0];
    libm::exp(spread * quantile::normal(open_unit(word)))
}

/// Takes from the widths of pieces of one edge, of which `first` is the first, what is lost far from the source.
fn fade(net: NetView<'_>, profile: &Profile, first: usize, pieces: &mut [[f64; 2]]) {
    let mut left = faded(net, profile, net.edges[first][0]);
    for (widths, &[_, end]) in pieces.iter_mut().zip(&net.edges[first..]) {
        widths[0] *= left;
        left = faded(net, profile, end);
        widths[1] *= left;
    }
}

/// The part of the width that is left at a vertex.
fn faded(net: NetView<'_>, profile: &Profile, vertex: i32) -> f64 {
    let p = net.vertices[vertex as usize];
    let nearest = |i: usize| {
        let (apart, period) = (p[i] - profile.source[i], net.period[i]);
        if period > 0.0 { apart - (apart / period).round() * period } else { apart }
    };
    let far = length([nearest(0), nearest(1)]) / profile.reach;
    power(1.0 + far * far, -0.5 * profile.fade)
}

/// How a strand ends.
#[derive(Clone, Copy, PartialEq)]
enum Tip {
    Free,
    Abutting,
    /// Cut at the bounds: it goes on outside.
    Cut,
}

impl Tip {
    fn of(alone: bool, free: bool) -> Self {
        match (alone, free) {
            (true, true) => Self::Free,
            (true, false) => Self::Cut,
            _ => Self::Abutting,
        }
    }
}

/// Width along one strand.
struct Shape {
    full: f64,
    length: f64,
    /// How far from its tips it is as wide as it gets, and 1 over that.
    reach: f64,
    rate: f64,
    tips: [Tip; 2],
    abutting: f64,
}

impl Shape {
    fn of(net: NetView<'_>, strands: &Strands, profile: &Profile, key: Key, longest: f64, run: usize) -> Self {
        let (strand, entries) = (strands.strand[run] as usize, strands.entries_of(run));
        let length = strands.long[run];
        let [first, last] = [entries[0], entries[entries.len() - 1]];
        let [here, there] = strands.alone[run];
        let tip = |end: u32, alone: bool| Tip::of(alone, !net.cut[net.vertex(end)]);
        // Any power of 1 is 1.
        let shrunk = if profile.shrink == 1.0 {
            1.0
        } else {
            libm::pow(profile.shrink, f64::from(strands.generation[first as usize / 2]))
        };
        let full = profile.width * power(length / longest, profile.hierarchy) * shrunk;
        let reach = profile.taper * length;
        Self {
            full: full * factor(profile.unevenness, key, strand, 0),
            length,
            reach,
            rate: 1.0 / reach,
            tips: [tip(first, here), tip(last ^ 1, there)],
            abutting: profile.abutting,
        }
    }

    fn at(&self, run: f64) -> f64 {
        let from = [run, (self.length - run).max(0.0)];
        self.full * self.factor(self.tips[0], from[0]).min(self.factor(self.tips[1], from[1]))
    }

    /// A free tip opens with the square root of the distance, an abutting end linearly from its share.
    fn factor(&self, tip: Tip, distance: f64) -> f64 {
        if distance >= self.reach {
            return 1.0;
        }
        match tip {
            Tip::Free => self.part(distance).sqrt(),
            Tip::Abutting => self.abutting + (1.0 - self.abutting) * self.part(distance),
            Tip::Cut => 1.0,
        }
    }

    /// The part of the reach. Where that is next to none, its inverse is infinite.
    fn part(&self, distance: f64) -> f64 {
        if distance > 0.0 { (distance * self.rate).min(1.0) } else { 0.0 }
    }
}
