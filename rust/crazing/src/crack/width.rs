//! Width: long cracks are wide, free tips run out to a point.

use super::net::NetView;
use super::strand::Strands;
use crate::error::{Error, Result};

/// Width of an abutting end, relative to the strand's own.
const ABUTTING: f64 = 0.6;

/// How wide cracks are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Profile {
    /// Width of the longest strand, data units.
    pub width: f64,
    /// Width grows with this power of the strand's length: 0 makes all alike, 1/2 is what real cracks show.
    pub hierarchy: f64,
    /// The part of a strand over which a free tip runs out: 0 leaves it blunt.
    pub taper: f64,
}

/// Width at the two ends of each edge.
///
/// # Errors
/// [`Error::BadValue`].
pub fn widths(net: NetView<'_>, strands: &Strands, profile: Profile) -> Result<Vec<[f64; 2]>> {
    for (name, value) in [("width", profile.width), ("hierarchy", profile.hierarchy), ("taper", profile.taper)] {
        if !(value.is_finite() && value >= 0.0) {
            return Err(Error::BadValue { name, value, wanted: "a finite number of at least 0 is wanted" });
        }
    }
    let degree = net.degrees();
    let mut widths = vec![[0.0; 2]; net.edges.len()];
    for (strand, &length) in strands.length.iter().enumerate() {
        let entries = &strands.entries[strands.starts[strand]..strands.starts[strand + 1]];
        let tip = |end: u32| {
            let vertex = net.vertex(end);
            Tip::of(degree[vertex], !net.cut[vertex])
        };
        let (Some(&first), Some(&last)) = (entries.first(), entries.last()) else { continue };
        let full = profile.width * libm::pow(length / strands.length[0].max(f64::MIN_POSITIVE), profile.hierarchy);
        let shape = Shape { full, length, reach: profile.taper * length, tips: [tip(first), tip(last ^ 1)] };
        let mut run = 0.0;
        for &entry in entries {
            let edge = entry as usize / 2;
            widths[edge][entry as usize % 2] = shape.at(run);
            run += net.length(edge);
            widths[edge][1 - entry as usize % 2] = shape.at(run);
        }
    }
    Ok(widths)
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
    fn of(degree: u32, free: bool) -> Self {
        match (degree, free) {
            (1, true) => Self::Free,
            (1, false) => Self::Cut,
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
            Tip::Abutting => ABUTTING + (1.0 - ABUTTING) * distance / self.reach,
            Tip::Cut => 1.0,
        }
    }
}
