//! The plates: the faces between the edges of a crack, as seen from either side of every edge.
//!
//! Half-edge `2k` runs from the first to the second end of edge `k`, `2k + 1` back; the face of a half-edge lies to its
//! left. A walk that turns as far left as it can, goes round a face. Where cracks float inside a plate, a ray to the
//! left of each finds the walk around it. Without a period the bounds close the plates along them (`border`).

use crate::error::Result;
use crate::graph::Point;
use crate::parallel;
use crate::watch::Watch;

use super::Pattern;
use super::halves::Halves;
use super::walks::{Walk, Walks};

/// The plates beside the edges.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Plates {
    /// For every edge the plates to its left and to its right.
    pub plates: Vec<[i32; 2]>,
    /// From the first end of every edge to the middles of these plates, data units.
    pub middles: Vec<[[f64; 2]; 2]>,
    /// The farthest corner of each plate from its middle, data units; 0 of one that nothing closes.
    pub reaches: Vec<f64>,
}

/// The edges of the crack, then those of the bounds, as vectors between vertices.
pub(super) struct Net {
    pub(super) places: Vec<Point>,
    pub(super) edges: Vec<[u32; 2]>,
    pub(super) steps: Vec<Point>,
    /// From the second vertex of each edge to its second end, in whole periods.
    pub(super) turns: Vec<Point>,
    pub(super) period: Option<Point>,
    /// From the first end of edges that enter the bounds to where they do.
    pub(super) leads: Vec<(usize, Point)>,
    /// Of the crack alone.
    own: usize,
}

/// The plates of a crack; `period` as for its shifts, `bounds` where there is none.
///
/// # Errors
/// [`crate::Error::BadIndex`] or [`crate::Error::BadLength`] for arrays that do not fit; [`crate::Error::Interrupted`].
pub fn plates(pattern: &Pattern<'_>, bounds: [f64; 4], period: Option<Point>, watch: Watch<'_>) -> Result<Plates> {
    pattern.check()?;
    let mut net = Net::new(pattern, bounds, period);
    watch.poll()?;
    let halves = Halves::of(&net);
    watch.poll()?;
    let mut walks = net.walks(&halves);
    let is_level = walks.iter().any(Walk::is_level);
    if is_level {
        net.tip();
        walks = net.walks(&halves);
    }
    watch.poll()?;
    let outermost = Net::outermost(&net.parents(&walks, watch)?);
    let mut found = net.number(&walks, &outermost);
    if is_level {
        found.middles.as_flattened_mut().iter_mut().for_each(|middle| *middle = [-middle[1], middle[0]]);
    }
    Ok(found)
}

pub(super) fn add(a: Point, b: Point) -> Point {
    [a[0] + b[0], a[1] + b[1]]
}

pub(super) fn less(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1]]
}

/// Grows with the angle of a vector, from -2 to 2.
pub(super) fn turn(v: Point) -> f64 {
    // Of no vector at all 0, on any processor.
    let part = v[1] / (v[0].abs() + v[1].abs()).max(f64::MIN_POSITIVE);
    if v[0] >= 0.0 {
        part
    } else if v[1] >= 0.0 {
        2.0 - part
    } else {
        -2.0 - part
    }
}

/// The order, counter-clockwise, of half-edges that lie on top of each other.
pub(super) fn rank(half: usize) -> isize {
    let edge = (half / 2) as isize;
    if half.is_multiple_of(2) { edge } else { -edge }
}

/// How the plates of a walk are numbered, and where the middle of its plate is, from the start of the walk.
struct Own {
    number: i32,
    middle: Point,
    closes: bool,
}

impl Net {
    fn new(pattern: &Pattern<'_>, bounds: [f64; 4], period: Option<Point>) -> Self {
        let own = pattern.edges.len();
        let places = pattern.vertices.to_vec();
        let edges: Vec<[u32; 2]> = parallel::map(own, |k| pattern.edges[k].map(|vertex| vertex as u32));
        let turn =
            |k: usize| pattern.shifts.get(k).filter(|_| period.is_some()).map_or([0.0; 2], |by| by.map(f64::from));
        let turns = parallel::map(own, turn);
        let [width, height] = period.unwrap_or_default();
        let steps = parallel::map(own, |k| {
            let [from, to] = edges[k].map(|vertex| places[vertex as usize]);
            add(less(to, from), [turns[k][0] * width, turns[k][1] * height])
        });
        let mut net = Self { places, edges, steps, turns, period, leads: Vec::new(), own };
        if period.is_none() {
            net.close(bounds);
        }
        net
    }

    /// Turns all by a right angle clockwise: what runs around a torus from side to side then runs up or down.
    fn tip(&mut self) {
        let vectors = self.places.iter_mut().chain(&mut self.steps).chain(&mut self.turns);
        vectors.for_each(|vector| *vector = [vector[1], -vector[0]]);
        self.period = self.period.map(|[width, height]| [height, width]);
    }

    /// Where a half-edge starts.
    #[inline]
    pub(super) fn start(&self, half: usize) -> usize {
        self.edges[half / 2][half % 2] as usize
    }

    /// The vector of a half-edge.
    #[inline]
    pub(super) fn vector(&self, half: usize) -> Point {
        let step = self.steps[half / 2];
        if half.is_multiple_of(2) { step } else { [-step[0], -step[1]] }
    }

    fn number(&self, walks: &Walks<'_>, outermost: &[(usize, Point)]) -> Plates {
        let (owns, count) = self.owns(walks, outermost);
        let both = |k: usize| [2 * k, 2 * k + 1];
        let plates = parallel::map(self.own, |k| both(k).map(|half| owns[walks.walk_of(half)].number));
        let mut middles = parallel::map(self.own, |k| {
            let [left, right] = both(k).map(|half| less(owns[walks.walk_of(half)].middle, walks.at(half)));
            // Both as seen from the first end.
            [left, add(right, self.steps[k])]
        });
        for &(k, lead) in &self.leads {
            middles[k] = middles[k].map(|middle| add(middle, lead));
        }
        Plates { plates, middles, reaches: reaches(walks, &owns, count) }
    }

    /// What each walk goes round, and the number of plates: in the order of their first half-edges, which is that of the
    /// walks. What goes round no edge of the crack has a number only where it is the outermost of others.
    fn owns(&self, walks: &Walks<'_>, outermost: &[(usize, Point)]) -> (Vec<Own>, usize) {
        let (mut number, mut count, mut outside) = (vec![-1; walks.iter().len()], 0, None);
        let seen = (0..number.len()).take_while(|&walk| walks.first(walk) < 2 * self.own);
        for outer in seen.map(|walk| outermost[walk].0) {
            if number[outer] < 0 {
                let shared = !walks[outer].is_alone();
                number[outer] = outside.filter(|_| shared).unwrap_or(count);
                count = count.max(number[outer] + 1);
                outside = if shared { Some(number[outer]) } else { outside };
            }
        }
        let own = |&(outer, from): &(usize, Point)| Own {
            number: number[outer],
            middle: add(from, walks[outer].middle),
            closes: walks[outer].closes,
        };
        (outermost.iter().map(own).collect(), count as usize)
    }
}

/// How far the corners of the numbered plates are from their middles, those at the bounds as well.
fn reaches(walks: &Walks<'_>, owns: &[Own], count: usize) -> Vec<f64> {
    let reach = |walk: usize| {
        let own = &owns[walk];
        // What is not closed has no middle of its own: around a torus one that tilts would meet itself in a step.
        let corners = if own.number >= 0 && own.closes { walks.along(walk) } else { &[] };
        corners.iter().fold(0.0_f64, |reach, &at| {
            let [x, y] = less(own.middle, at);
            reach.max((x * x + y * y).sqrt())
        })
    };
    let mut reaches = vec![0.0_f64; count];
    for (own, reach) in owns.iter().zip(parallel::map(owns.len(), reach)).filter(|(own, _)| own.number >= 0) {
        let most = &mut reaches[own.number as usize];
        *most = most.max(reach);
    }
    reaches
}
