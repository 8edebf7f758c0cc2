//! The room that a rough edge has: its kite, which no other edge enters.

use super::fence::FenceView;
use super::net::{self, NetView};
use crate::graph::Point;

/// The part of its kite that an edge may wander in.
const ROOM: f64 = 0.6;

/// The kite of an edge in its own frame: how far along and how far across the apexes lie, left and right.
pub(super) struct Room {
    pub(super) length: f64,
    pub(super) sides: [Point; 2],
}

impl Room {
    pub(super) fn of(net: NetView<'_>, fence: FenceView<'_>, edge: usize) -> Self {
        let [a, b] = net.ends(edge);
        let (x, y) = (b[0] - a[0], b[1] - a[1]);
        let length = net::length([x, y]);
        let side = |side: usize, sign: f64| {
            let corner = fence.kites[edge][2 + side];
            if corner < 0 || length == 0.0 {
                return [0.0; 2];
            }
            let at = corner as usize;
            let place = if at < net.vertices.len() { net.vertices[at] } else { fence.anchors[at - net.vertices.len()] };
            let shift = fence.shifts.get(edge).map_or([0; 2], |s| [s[2 + 2 * side], s[3 + 2 * side]]);
            let apex = net.moved(place, shift);
            let mut away = [apex[0] - a[0], apex[1] - a[1]];
            if at < net.vertices.len() {
                // A triangle between vertices may be about three edges: each has the third up to the middle.
                away = [(away[0] + x) / 3.0, (away[1] + y) / 3.0];
            }
            let [u, v] = away;
            [(u * x + v * y) / length, (sign * (x * v - y * u) / length).max(0.0)]
        };
        Self { length, sides: [side(0, 1.0), side(1, -1.0)] }
    }

    /// How far off an edge a place at `x` along it is that is to lie `bent` off and `height` off that: bent as far as the
    /// kite allows, and thrown back by its sides where the height goes on beyond.
    ///
    /// Kept at the sides instead, it would run along them: of a kite with one thin half, straight along the edge.
    pub(super) fn within(&self, x: f64, bent: f64, height: f64) -> f64 {
        let (left, right) = (self.most(x, 0), self.most(x, 1));
        let bent = bent.clamp(-right, left);
        let (low, high) = (-right - bent, left - bent);
        if (low..=high).contains(&height) {
            return bent + height;
        }
        let across = high - low;
        if !(across > 0.0 && height.is_finite()) {
            return (bent + height).clamp(-right, left);
        }
        let off = (height - low).rem_euclid(2.0 * across);
        (bent + low + if off > across { 2.0 * across - off } else { off }).clamp(-right, left)
    }

    /// How far off the edge the kite allows at `x` along it, to one side.
    fn most(&self, x: f64, side: usize) -> f64 {
        let [along, across] = self.sides[side];
        // Of the two sides up to the apex and down from it, the one that `x` is under.
        let part = if x < along {
            x / along
        } else if x > along && along < self.length {
            (self.length - x) / (self.length - along)
        } else {
            1.0
        };
        ROOM * across * part.min(1.0)
    }
}
