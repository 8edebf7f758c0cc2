//! How finely rough edges are cut: no more than is seen.

use super::Roughness;
use crate::crack::bow::Bow;
use crate::crack::room::Room;

/// Most halvings of one edge.
pub(super) const DEEPEST: u32 = 12;
/// An edge is not subdivided when its kite is thinner than this part of its length: roundings could leave it.
const THIN: f64 = 1e-6;
/// Pieces whose middle lies off their chord by less than these parts of the grain are not halved: as far as they wander,
/// and as far as they are bent. A curve shows its corners sooner than a crack its lack of wandering.
const CALM: f64 = 1.0 / 25.0;
const FLAT: f64 = 1.0 / 40.0;

/// When the pieces of an edge are short enough, and when straight enough.
pub(super) struct Fineness {
    pub(super) grain: f64,
    /// How far off its chord a bow may lie in the middle of a piece.
    flat: f64,
    /// Pieces no longer than this do not wander far off their chords.
    calm: f64,
    is_rough: bool,
}

impl Fineness {
    pub(super) fn of(how: Roughness) -> Self {
        let Roughness { amplitude, hurst, unit, grain, .. } = how;
        // Where the deviation, which grows with a power of the length, has grown to its limit.
        let part = CALM * grain / (amplitude * unit);
        let calm = if amplitude * unit > 0.0 { unit * libm::pow(part, 1.0 / hurst) } else { f64::INFINITY };
        Self { grain, flat: FLAT * grain, calm, is_rough: amplitude != 0.0 }
    }

    /// How often an edge is halved that wanders on so many levels; one at a tip down to the grain, since there its width
    /// runs out in a curve.
    pub(super) fn halvings(&self, room: &Room, bow: &Bow, is_tip: bool, levels: u32) -> u32 {
        let across = room.sides[0][1].max(room.sides[1][1]);
        if !(self.grain > 0.0 && room.length.is_finite() && across > THIN * room.length)
            || (!self.is_rough && bow.is_straight())
        {
            return 0;
        }
        let (mut depth, mut piece, mut off) = (0, room.length, room.length * bow.most());
        let wanders = |depth: u32, piece: f64| depth < levels && piece > self.calm;
        while depth < DEEPEST && piece > self.grain && (is_tip || off > self.flat || wanders(depth, piece)) {
            (depth, piece, off) = (depth + 1, 0.5 * piece, 0.25 * off);
        }
        depth
    }
}

/// On how many levels an edge of that width wanders: on its own, and where there is more detail, on more as long as pieces
/// are longer than it is wide. What is finer would turn the sides of wide cracks into strings of beads, for both follow
/// one line.
pub(super) fn levels(own: u32, length: f64, width: f64) -> u32 {
    let (mut levels, mut piece) = (own, length * libm::exp2(-f64::from(own)));
    while levels < DEEPEST && piece > width {
        (levels, piece) = (levels + 1, 0.5 * piece);
    }
    levels
}
