//! Where rows and columns of pixels cross the middle line of an edge: exact, in whole parts of a pixel.
//!
//! No place lies on a line: a place is taken to lie a trace to the right of where it is, and below by a trace of that.

use std::cmp::Ordering;

/// The middle line of an edge, on a torus of one of its images.
#[derive(Debug, Clone, Copy)]
pub(super) struct Line {
    /// In parts of a pixel, y down.
    pub(super) start: [i64; 2],
    pub(super) end: [i64; 2],
    /// Row of the edge.
    pub(super) edge: u32,
}

/// A crossing: the last whole place before it or at it, and what is left of a part, as a fraction.
struct Crossing {
    whole: i64,
    rest: [i64; 2],
}

impl Line {
    /// The least and the most of an axis.
    pub(super) fn span(&self, axis: usize) -> [i64; 2] {
        let (start, end) = (self.start[axis], self.end[axis]);
        if start < end { [start, end] } else { [end, start] }
    }

    /// Whether a row (`axis` 0) or a column (1) at that place of the other axis crosses it.
    #[inline(always)]
    pub(super) fn is_crossed(&self, axis: usize, at: i64) -> bool {
        let [low, high] = self.span(1 - axis);
        low <= at && at < high
    }

    /// Steps of the line along a row or column, and across it, of which the latter is positive.
    #[inline(always)]
    fn steps(&self, axis: usize) -> [i64; 2] {
        let [along, across] = [axis, 1 - axis].map(|axis| self.end[axis] - self.start[axis]);
        if across < 0 { [-along, -across] } else { [along, across] }
    }

    #[inline(always)]
    fn crossing(&self, axis: usize, at: i64) -> Crossing {
        const SHORT: i64 = 1 << 31;
        let ([along, across], by) = (self.steps(axis), at - self.start[1 - axis]);
        let (whole, rest) = if along.abs() < SHORT && across < SHORT {
            ((by * along).div_euclid(across), (by * along).rem_euclid(across))
        } else {
            let (product, across) = (i128::from(by) * i128::from(along), i128::from(across));
            (product.div_euclid(across) as i64, product.rem_euclid(across) as i64)
        };
        Crossing { whole: self.start[axis] + whole, rest: [rest, across] }
    }

    /// The first whole place that lies beyond the line, of a row or column that crosses it.
    #[inline(always)]
    pub(super) fn passed(&self, axis: usize, at: i64) -> i64 {
        let Crossing { whole, rest } = self.crossing(axis, at);
        // A row lies a trace of a trace below; a column passes a trace to the right, where the line may lie lower.
        let is_later = rest[0] > 0 || (axis == 1 && self.steps(axis)[0] > 0);
        whole + i64::from(is_later)
    }

    /// On which side of the edge whoever crosses it arrives, downwards or to the right: 0 left, 1 right.
    #[inline(always)]
    pub(super) fn side(&self, axis: usize) -> u32 {
        let step = self.end[1 - axis] - self.start[1 - axis];
        u32::from(if axis == 0 { step < 0 } else { step > 0 })
    }

    /// Which of two lines a row or column crosses later. Lines on top of each other are in the order in which
    /// `faces` has them.
    pub(super) fn order(&self, other: &Self, axis: usize, at: i64) -> Ordering {
        let (own, others) = (self.crossing(axis, at), other.crossing(axis, at));
        let product = |a: i64, b: i64| i128::from(a) * i128::from(b);
        let fractions = |a: [i64; 2], b: [i64; 2]| product(a[0], b[1]).cmp(&product(b[0], a[1]));
        let rank = |line: &Self| if line.side(axis) == 1 { i64::from(line.edge) } else { -i64::from(line.edge) };
        own.whole
            .cmp(&others.whole)
            .then_with(|| fractions(own.rest, others.rest))
            .then_with(|| fractions(self.steps(axis), other.steps(axis)))
            .then_with(|| rank(other).cmp(&rank(self)))
    }

    /// The line moved.
    pub(super) fn moved(&self, by: [i64; 2]) -> Self {
        let [start, end] = [self.start, self.end].map(|place| [place[0] + by[0], place[1] + by[1]]);
        Self { start, end, edge: self.edge }
    }
}
