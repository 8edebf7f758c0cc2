//! How width changes along a strand: even between knots one unit apart.

use super::{Profile, factor};
use crate::crack::strand::Strands;
use crate::parallel;
use crate::rng::Key;

/// Numbers from here on are whole.
const WHOLE: f64 = (1_u64 << 53) as f64;

/// The factors at the knots of all strands.
pub(super) struct Knots {
    spread: f64,
    unit: f64,
    key: Key,
    /// Where those of each run start, and the end; empty where there are too many to be kept.
    starts: Vec<u32>,
    factors: Vec<f64>,
}

impl Knots {
    /// Those of all strands are worked out once, unless there are more than `most`.
    pub(super) fn of(strands: &Strands, profile: &Profile, key: Key, most: usize) -> Self {
        let spread = if profile.unit > 0.0 { 0.5 * profile.unevenness } else { 0.0 };
        let mut knots = Self { spread, unit: profile.unit, key, starts: Vec::new(), factors: Vec::new() };
        if spread == 0.0 {
            return knots;
        }
        // One before the first part of its way, one behind the last.
        let count = |long: f64| (long / knots.unit).floor() as usize;
        let mut starts = Vec::with_capacity(strands.long.len() + 1);
        starts.push(0_u32);
        let mut all = 0_usize;
        for &long in &strands.long {
            all = all.saturating_add(count(long).saturating_add(2));
            if all > most.min(u32::MAX as usize) {
                return knots;
            }
            starts.push(all as u32);
        }
        let mut factors = vec![0.0; all];
        parallel::grouped(
            starts.len() - 1,
            |run| starts[run] as usize,
            &mut factors,
            |runs, mut rest| {
                for run in runs {
                    let own;
                    (own, rest) = rest.split_at_mut((starts[run + 1] - starts[run]) as usize);
                    let strand = strands.strand[run] as usize;
                    own.iter_mut().zip(1..).for_each(|(slot, knot)| *slot = factor(spread, key, strand, knot));
                }
            },
        );
        (knots.starts, knots.factors) = (starts, factors);
        knots
    }

    /// Those of one run.
    pub(super) fn along(&self, strands: &Strands, run: usize) -> Uneven<'_> {
        let known = match self.starts.get(run..run + 2) {
            Some(&[start, end]) => &self.factors[start as usize..end as usize],
            _ => &[],
        };
        Uneven { knots: self, known, strand: strands.strand[run] as usize, last: None, ends: [1.0; 2] }
    }
}

/// How width changes along one strand.
pub(super) struct Uneven<'a> {
    knots: &'a Knots,
    known: &'a [f64],
    strand: usize,
    /// The last knot that was passed.
    last: Option<u64>,
    /// The factors at it and the next.
    ends: [f64; 2],
}

impl Uneven<'_> {
    pub(super) fn at(&mut self, run: f64) -> f64 {
        let Knots { spread, unit, key, .. } = *self.knots;
        if spread == 0.0 {
            return 1.0;
        }
        let part = run / unit;
        let knot = part as u64;
        // What no whole number of 64 bits is near is whole itself.
        let whole = if part < WHOLE { knot as f64 } else { part.floor() };
        if self.last != Some(knot) {
            self.last = Some(knot);
            self.ends = match usize::try_from(knot).ok().and_then(|knot| self.known.get(knot..)?.get(..2)) {
                Some(&[here, next]) => [here, next],
                _ => [1, 2].map(|next| factor(spread, key, self.strand, knot.saturating_add(next))),
            };
        }
        self.ends[0] + (part - whole) * (self.ends[1] - self.ends[0])
    }
}
