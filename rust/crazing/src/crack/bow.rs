//! Bows: edges bent so that a crack turns smoothly where they meet.

use super::net::NetView;

/// The steepest that an edge may leave a vertex, against its own direction.
const STEEPEST: f64 = 1.2;

/// An edge bent into a cubic: how steeply it leaves its first vertex and comes to its last, counter-clockwise.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Bow {
    slopes: [f64; 2],
}

impl Bow {
    /// Follows the direction of the crack at both vertices: there it runs along the chord of its neighbours on both
    /// sides, so that of two edges the shorter one does more of the turn. Where no crack goes on, an edge is straight.
    ///
    /// # Source
    /// Catmull, Rom: A class of local interpolating splines (1974), for the directions.
    pub(super) fn of(net: NetView<'_>, partner: &[i32], edge: usize, rounding: f64) -> Self {
        if rounding == 0.0 {
            return Self::default();
        }
        let [x, y] = net.along(2 * edge as u32);
        let slope = |side: usize| {
            let Ok(other) = u32::try_from(partner[2 * edge + side]) else { return 0.0 };
            let [u, v] = net.along(other);
            // Away from the vertex on both sides: the crack comes in against the one and leaves along the other.
            let sign = if side == 0 { -1.0 } else { 1.0 };
            let [s, t] = [x + sign * u, y + sign * v];
            let (along, across) = (s * x + t * y, t * x - s * y);
            let steep = if along > 0.0 { across / along } else { STEEPEST.copysign(across) };
            if steep.is_finite() { rounding * steep.clamp(-STEEPEST, STEEPEST) } else { 0.0 }
        };
        Self { slopes: [slope(0), slope(1)] }
    }

    /// Whether the edge stays as it is.
    pub(super) fn is_straight(&self) -> bool {
        self.slopes == [0.0; 2]
    }

    /// No less than how far the middle of the chord of the whole edge lies off it, in its lengths; a part of the edge lies
    /// off its own chord by no more than this times the square of the part.
    pub(super) fn most(&self) -> f64 {
        // The second derivative is linear along the edge: it is largest at one of its ends.
        let [a, b] = self.slopes;
        (4.0 * a + 2.0 * b).abs().max((2.0 * a + 4.0 * b).abs()) / 8.0
    }

    /// How far to the left the edge lies at a part of its way, in its lengths.
    pub(super) fn height(&self, part: f64) -> f64 {
        let rest = 1.0 - part;
        part * rest * (self.slopes[0] * rest - self.slopes[1] * part)
    }
}
