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
    pub(super) edges: Vec<[usize; 2]>,
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
    let (starts, leaving) = net.leaving();
    watch.poll()?;
    let after = after(&starts, &leaving);
    let mut walks = net.walks(&after);
    watch.poll()?;
    let is_level = walks.walks.iter().any(Walk::is_level);
    if is_level {
        net.tip();
        walks = net.walks(&after);
    }
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

/// Behind every half-edge: at its end the next one clockwise from the way back.
fn after(starts: &[usize], leaving: &[usize]) -> Vec<usize> {
    let mut after = vec![0; leaving.len()];
    for vertex in starts.windows(2) {
        let around = &leaving[vertex[0]..vertex[1]];
        let before = around.last().into_iter().chain(around);
        around.iter().zip(before).for_each(|(&half, &before)| after[half ^ 1] = before);
    }
    after
}

impl Net {
    fn new(pattern: &Pattern<'_>, bounds: [f64; 4], period: Option<Point>) -> Self {
        let places = pattern.vertices.to_vec();
        let edges: Vec<[usize; 2]> = pattern.edges.iter().map(|edge| edge.map(|vertex| vertex as usize)).collect();
        let turn =
            |k: usize| pattern.shifts.get(k).filter(|_| period.is_some()).map_or([0.0; 2], |by| by.map(f64::from));
        let turns: Vec<Point> = (0..edges.len()).map(turn).collect();
        let [width, height] = period.unwrap_or_default();
        let step = |(edge, turn): (&[usize; 2], &Point)| {
            add(less(places[edge[1]], places[edge[0]]), [turn[0] * width, turn[1] * height])
        };
        let steps = edges.iter().zip(&turns).map(step).collect();
        let own = edges.len();
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

    /// Where a half-edge starts, and its vector.
    pub(super) fn half(&self, half: usize) -> (usize, Point) {
        let (edge, step) = (self.edges[half / 2], self.steps[half / 2]);
        if half.is_multiple_of(2) { (edge[0], step) } else { (edge[1], [-step[0], -step[1]]) }
    }

    /// The half-edges that leave every vertex, counter-clockwise; those of vertex `v` from `starts[v]` on.
    fn leaving(&self) -> (Vec<usize>, Vec<usize>) {
        let mut starts = vec![0; self.places.len() + 1];
        self.edges.as_flattened().iter().for_each(|&vertex| starts[vertex + 1] += 1);
        (0..self.places.len()).for_each(|vertex| starts[vertex + 1] += starts[vertex]);
        let (mut next, mut leaving) = (starts.clone(), vec![0; 2 * self.edges.len()]);
        for half in 0..leaving.len() {
            let vertex = self.half(half).0;
            leaving[next[vertex]] = half;
            next[vertex] += 1;
        }
        let turns = parallel::map(leaving.len(), |half| turn(self.half(half).1));
        for vertex in starts.windows(2) {
            leaving[vertex[0]..vertex[1]].sort_by(|&a, &b| turns[a].total_cmp(&turns[b]).then(rank(a).cmp(&rank(b))));
        }
        (starts, leaving)
    }

    fn number(&self, walks: &Walks, outermost: &[(usize, Point)]) -> Plates {
        let mut number = vec![-1; walks.walks.len()];
        let mut found = Plates::default();
        let mut outside = None;
        let mut see = |half: usize, found: &mut Plates| {
            let (walk, at) = walks.of[half];
            let (outer, from) = outermost[walk];
            let shared = !walks.walks[outer].is_alone();
            if number[outer] < 0 {
                number[outer] = outside.filter(|_| shared).unwrap_or(found.reaches.len() as i32);
                if number[outer] as usize == found.reaches.len() {
                    found.reaches.push(0.0);
                }
                outside = if shared { Some(number[outer]) } else { outside };
            }
            (number[outer], less(add(from, walks.walks[outer].middle), at))
        };
        for k in 0..self.own {
            let step = self.steps[k];
            let mut seen = [2 * k, 2 * k + 1].map(|half| see(half, &mut found));
            // Both as seen from the first end.
            seen[1].1 = add(seen[1].1, step);
            found.plates.push(seen.map(|(plate, _)| plate));
            found.middles.push(seen.map(|(_, middle)| middle));
        }
        for &(k, lead) in &self.leads {
            found.middles[k] = found.middles[k].map(|middle| add(middle, lead));
        }
        self.reach(walks, outermost, &number, &mut found);
        found
    }

    /// How far the corners of the numbered plates are from their middles, those at the bounds as well.
    fn reach(&self, walks: &Walks, outermost: &[(usize, Point)], number: &[i32], found: &mut Plates) {
        for &(walk, at) in &walks.of {
            let (outer, from) = outermost[walk];
            // What is not closed has no middle of its own: around a torus one that tilts would meet itself in a step.
            if number[outer] >= 0 && walks.walks[outer].closes {
                let [x, y] = less(add(from, walks.walks[outer].middle), at);
                let reach = &mut found.reaches[number[outer] as usize];
                *reach = reach.max((x * x + y * y).sqrt());
            }
        }
    }
}
