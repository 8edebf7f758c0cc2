//! Width: old and long cracks are wide, free tips run out to a point.

use super::net::NetView;
use super::strand::Strands;
use crate::error::{Error, Result};
use crate::graph::Point;
use crate::parallel;
use crate::quantile;
use crate::rng::{Key, block, open_unit, stream};

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
    check(&profile)?;
    let longest = strands.length.iter().fold(f64::MIN_POSITIVE, |longest, &length| longest.max(length));
    let found = parallel::ranges(strands.run.len(), |range| {
        let mut found = Vec::with_capacity(strands.starts[range.end] - strands.starts[range.start]);
        range.for_each(|run| along(net, strands, &profile, key, longest, run, &mut found));
        found
    });
    let mut widths = vec![[0.0; 2]; net.edges.len()];
    let mut entries = strands.entries.iter();
    for some in &found {
        for (&[before, after], &entry) in some.iter().zip(entries.by_ref()) {
            widths[entry as usize / 2] = if entry.is_multiple_of(2) { [before, after] } else { [after, before] };
        }
    }
    Ok(widths)
}

/// Adds the widths before and after each edge of a run, in the order of its entries.
fn along(
    net: NetView<'_>,
    strands: &Strands,
    profile: &Profile,
    key: Key,
    longest: f64,
    run: usize,
    found: &mut Vec<[f64; 2]>,
) {
    let (strand, entries) = (strands.strand[run] as usize, strands.entries_of(run));
    let length = strands.length[strand];
    let (Some(&first), Some(&last)) = (entries.first(), entries.last()) else { return };
    let [here, there] = strands.alone[run];
    let tip = |end: u32, alone: bool| Tip::of(alone, !net.cut[net.vertex(end)]);
    let generation = strands.generation[first as usize / 2];
    let full = profile.width
        * libm::pow(length / longest, profile.hierarchy)
        * libm::pow(profile.shrink, f64::from(generation));
    let shape = Shape {
        full: full * factor(profile.unevenness, key, strand, 0),
        length,
        reach: profile.taper * length,
        tips: [tip(first, here), tip(last ^ 1, there)],
        abutting: profile.abutting,
    };
    let mut uneven = Uneven::of(profile, key, strand);
    let mut at = |run: f64, end: u32| shape.at(run) * uneven.at(run) * faded(net, profile, end);
    let (mut run, mut before) = (0.0, at(0.0, first));
    for &entry in entries {
        run += strands.spans[entry as usize / 2];
        let after = at(run, entry ^ 1);
        found.push([before, after]);
        before = after;
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

/// How width changes along a strand: even between knots one unit apart.
struct Uneven {
    spread: f64,
    unit: f64,
    key: Key,
    strand: usize,
    knot: u64,
    /// The factors at the knot and the next.
    ends: [f64; 2],
}

impl Uneven {
    fn of(profile: &Profile, key: Key, strand: usize) -> Self {
        let spread = if profile.unit > 0.0 { 0.5 * profile.unevenness } else { 0.0 };
        let ends = [1, 2].map(|knot| factor(spread, key, strand, knot));
        Self { spread, unit: profile.unit, key, strand, knot: 0, ends }
    }

    fn at(&mut self, run: f64) -> f64 {
        if self.spread == 0.0 {
            return 1.0;
        }
        let whole = (run / self.unit).floor();
        let knot = whole as u64;
        if knot != self.knot {
            let at = |next: u64| factor(self.spread, self.key, self.strand, knot.saturating_add(next));
            self.ends = [if self.knot.checked_add(1) == Some(knot) { self.ends[1] } else { at(1) }, at(2)];
            self.knot = knot;
        }
        self.ends[0] + (run / self.unit - whole) * (self.ends[1] - self.ends[0])
    }
}

/// The part of the width that is left at the vertex of an end.
fn faded(net: NetView<'_>, profile: &Profile, end: u32) -> f64 {
    if profile.fade == 0.0 {
        return 1.0;
    }
    let p = net.vertices[net.vertex(end)];
    let nearest = |i: usize| {
        let (apart, period) = (p[i] - profile.source[i], net.period[i]);
        if period > 0.0 { apart - (apart / period).round() * period } else { apart }
    };
    let far = libm::hypot(nearest(0), nearest(1)) / profile.reach;
    libm::pow(1.0 + far * far, -0.5 * profile.fade)
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
    reach: f64,
    tips: [Tip; 2],
    abutting: f64,
}

impl Shape {
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
            Tip::Free => (distance / self.reach).sqrt(),
            Tip::Abutting => self.abutting + (1.0 - self.abutting) * distance / self.reach,
            Tip::Cut => 1.0,
        }
    }
}
