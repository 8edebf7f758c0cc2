//! Whether segments meet only where they may: a line sweeps over them and looks at neighbours only.

use crate::error::{Error, Result};
use crate::graph::Point;
use crate::predicates::orientation;
use crate::watch::Watch;

/// Checks that of `segments` no two cross or overlap. They may touch: share an end, or one may end on another; for every
/// corner within a segment, the segment and the corner, in their order. Signs are exact. n segments take n log n looks,
/// and n short moves of memory as long as what the line meets at once.
///
/// `what` names a segment in the error, beside the numbers of its two points.
///
/// # Errors
/// [`Error::Crossing`] naming two that cross or overlap; [`Error::Interrupted`].
///
/// # Source
/// Shamos, Hoey: Geometric Intersection Problems (FOCS 1976).
pub fn check_apart(
    points: &[Point],
    segments: &[[u32; 2]],
    what: &'static str,
    watch: Watch<'_>,
) -> Result<Vec<(u32, Point)>> {
    let mut sweep = Sweep::new(points, segments, what);
    let mut events: Vec<u32> = (0..2 * segments.len() as u32).collect();
    events.sort_unstable_by(|&a, &b| order(sweep.event(a), sweep.event(b)).then(a.cmp(&b)));
    let mut starts = Vec::new();
    let mut from = 0;
    while from < events.len() {
        watch.poll_at(from)?;
        let at = sweep.event(events[from]);
        let count = events[from..].iter().take_while(|&&event| sweep.event(event) == at).count();
        let here = &events[from..from + count];
        starts.clear();
        starts.extend(here.iter().filter(|&&event| event % 2 == 0).map(|event| event / 2));
        sweep.pass(at, &mut starts)?;
        from += count;
    }
    // Stable: the corners on one segment stay in the order in which the line met them.
    sweep.touched.sort_by_key(|&(segment, _)| segment);
    Ok(sweep.touched)
}

/// Along x, and along y where x is equal: no segment stands upright before a line that leans by next to nothing.
fn order(p: Point, q: Point) -> std::cmp::Ordering {
    // Coordinates are finite, and the two zeros are one place.
    p.partial_cmp(&q).unwrap_or(std::cmp::Ordering::Equal)
}

struct Sweep<'a> {
    /// The ends of each segment, first the one that the line meets first.
    ends: Vec<[Point; 2]>,
    given: &'a [[u32; 2]],
    what: &'static str,
    /// Segments that the line meets, upward.
    met: Vec<u32>,
    touched: Vec<(u32, Point)>,
}

impl<'a> Sweep<'a> {
    fn new(points: &[Point], given: &'a [[u32; 2]], what: &'static str) -> Self {
        let sorted = |[a, b]: [Point; 2]| if order(a, b).is_gt() { [b, a] } else { [a, b] };
        let ends = given.iter().map(|segment| sorted(segment.map(|end| points[end as usize]))).collect();
        Self { ends, given, what, met: Vec::new(), touched: Vec::new() }
    }

    /// Where the line meets the start (even) or the end (odd) of a segment.
    fn event(&self, event: u32) -> Point {
        self.ends[event as usize / 2][event as usize % 2]
    }

    /// Positive when `at` lies above a segment.
    fn height(&self, segment: u32, at: Point) -> f64 {
        let [a, b] = self.ends[segment as usize];
        orientation(a, b, at)
    }

    /// The line comes to `at`, where the segments `starts` begin.
    fn pass(&mut self, at: Point, starts: &mut Vec<u32>) -> Result<()> {
        let low = self.met.partition_point(|&s| self.height(s, at) > 0.0);
        let count = self.met[low..].iter().take_while(|&&s| self.height(s, at) == 0.0).count();
        let on = starts.len();
        starts.extend(self.met[low..low + count].iter().filter(|&&s| self.ends[s as usize][1] != at));
        if let [first, second, ..] = starts[on..] {
            return Err(self.error(first, second));
        }
        self.touched.extend(starts[on..].iter().map(|&segment| (segment, at)));
        // All of these go on from here: the steepest comes last.
        starts.sort_unstable_by(|&a, &b| {
            let turn = orientation(at, self.ends[b as usize][1], self.ends[a as usize][1]);
            turn.partial_cmp(&0.0).unwrap_or(std::cmp::Ordering::Equal).then(a.cmp(&b))
        });
        for pair in starts.windows(2) {
            if orientation(at, self.ends[pair[0] as usize][1], self.ends[pair[1] as usize][1]) == 0.0 {
                return Err(self.error(pair[0], pair[1]));
            }
        }
        self.met.splice(low..low + count, starts.iter().copied());
        // The new neighbours: below the lowest and above the highest, or of each other when nothing goes on.
        for upper in [low, low + starts.len()] {
            if upper > 0 && upper < self.met.len() {
                self.check_pair(self.met[upper - 1], self.met[upper])?;
            }
        }
        Ok(())
    }

    fn check_pair(&self, a: u32, b: u32) -> Result<()> {
        let parted = |a: u32, b: u32| {
            let [from, to] = self.ends[b as usize];
            let (from, to) = (self.height(a, from), self.height(a, to));
            (from > 0.0 && to < 0.0) || (from < 0.0 && to > 0.0)
        };
        if parted(a, b) && parted(b, a) { Err(self.error(a, b)) } else { Ok(()) }
    }

    fn error(&self, a: u32, b: u32) -> Error {
        let ends = |segment: u32| self.given[segment as usize].map(|end| end as usize);
        Error::Crossing { what: self.what, first: ends(a.min(b)), second: ends(a.max(b)) }
    }
}
