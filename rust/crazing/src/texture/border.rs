//! The bounds of a crack without a period: its edges end there, and the bounds close the plates along them.

use super::faces::{Net, less};
use crate::graph::Point;
use crate::parallel;

/// How near to the bounds a vertex lies on them, as a part of their size.
const ON_BORDER: f64 = 1e-9;

/// A rectangle: its least and its greatest corner, and how near to it is on it.
struct Border {
    low: Point,
    high: Point,
    near: f64,
}

impl Border {
    fn new([xmin, ymin, xmax, ymax]: [f64; 4]) -> Self {
        Self { low: [xmin, ymin], high: [xmax, ymax], near: ON_BORDER * (xmax - xmin).max(ymax - ymin) }
    }

    fn holds(&self, place: Point) -> bool {
        (0..2).all(|axis| (self.low[axis] - self.near..=self.high[axis] + self.near).contains(&place[axis]))
    }

    /// How far along the border a place on it lies, counter-clockwise from its least corner.
    fn along(&self, [x, y]: Point) -> Option<f64> {
        let Self { low: [xmin, ymin], high: [xmax, ymax], near } = *self;
        let (width, height) = (xmax - xmin, ymax - ymin);
        let (right, up) = ((x - xmin).clamp(0.0, width), (y - ymin).clamp(0.0, height));
        if !self.holds([x, y]) {
            None
        } else if (y - ymin).abs() <= near {
            Some(right)
        } else if (x - xmax).abs() <= near {
            Some(width + up)
        } else if (y - ymax).abs() <= near {
            Some(width + height + (width - right))
        } else if (x - xmin).abs() <= near {
            Some(2.0 * width + height + (height - up))
        } else {
            None
        }
    }

    /// Where along a straight way the border is met, as parts of it; None if it stays outside.
    fn cut(&self, start: Point, step: Point) -> Option<[f64; 2]> {
        let (mut first, mut last) = (0.0_f64, 1.0_f64);
        for axis in 0..2 {
            let at = |wall: f64| (wall - start[axis]) / step[axis];
            if step[axis] != 0.0 {
                let (a, b) = (at(self.low[axis]), at(self.high[axis]));
                (first, last) = (first.max(a.min(b)), last.min(a.max(b)));
            } else if !(self.low[axis]..=self.high[axis]).contains(&start[axis]) {
                return None;
            }
        }
        // What touches the border from outside, ends there.
        let long = (step[0] * step[0] + step[1] * step[1]).sqrt() * (last - first);
        (long > self.near).then_some([first, last])
    }
}

impl Net {
    /// Ends the edges at the bounds, and adds these as edges, from vertex to vertex on them. Edges wholly outside stay.
    pub(super) fn close(&mut self, bounds: [f64; 4]) {
        let border = Border::new(bounds);
        let inside = |k: usize| self.edges[k].map(|vertex| border.holds(self.places[vertex as usize]));
        let leaving =
            parallel::compact(self.edges.len(), |k| Some((k, inside(k))).filter(|found| found.1 != [true; 2]));
        for (k, inside) in leaving {
            let (ends, step) = (self.edges[k], self.steps[k]);
            let start = self.places[ends[0] as usize];
            let Some(parts) = border.cut(start, step) else { continue };
            for end in (0..2).filter(|&end| !inside[end]) {
                let at = [0, 1].map(|axis| start[axis] + parts[end] * step[axis]);
                self.edges[k][end] = self.places.len() as u32;
                self.places.push([0, 1].map(|axis| at[axis].clamp(border.low[axis], border.high[axis])));
            }
            let [from, to] = self.edges[k].map(|vertex| self.places[vertex as usize]);
            self.steps[k] = less(to, from);
            self.leads.push((k, less(from, start)));
        }
        self.frame(&border);
    }

    /// Adds the edges of the border, but for those along which the crack runs.
    fn frame(&mut self, border: &Border) {
        let mut used = vec![false; self.places.len()];
        self.edges.as_flattened().iter().for_each(|&vertex| used[vertex as usize] = true);
        let first = self.places.len();
        let ([xmin, ymin], [xmax, ymax]) = (border.low, border.high);
        self.places.extend([[xmin, ymin], [xmax, ymin], [xmax, ymax], [xmin, ymax]]);
        used.extend([true; 4]);
        // Counter-clockwise; the corner comes before a vertex in it.
        let on = |vertex: usize| {
            border.along(self.places[vertex]).filter(|_| used[vertex]).map(|at| (at, vertex < first, vertex as u32))
        };
        let mut around = parallel::compact(self.places.len(), on);
        around.sort_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
        // What ends in one place of the border, ends in one vertex.
        let mut same: Vec<u32> = (0..self.places.len() as u32).collect();
        for at in 1..around.len() {
            if around[at].0 - around[at - 1].0 <= border.near {
                same[around[at].2 as usize] = same[around[at - 1].2 as usize];
            }
        }
        parallel::alter(&mut self.edges, |ends| *ends = ends.map(|vertex| same[vertex as usize]));
        around.retain(|&(_, _, vertex)| same[vertex as usize] == vertex);
        let is_on = |vertex: &u32| border.along(self.places[*vertex as usize]).is_some();
        let along = |k: usize| Some(self.edges[k]).filter(|ends| ends.iter().all(is_on)).map(sorted);
        let mut taken = parallel::compact(self.edges.len(), along);
        taken.sort_unstable();
        for (from, to) in around.iter().zip(around.iter().cycle().skip(1)).map(|(from, to)| (from.2, to.2)) {
            if taken.binary_search(&sorted([from, to])).is_err() {
                self.edges.push([from, to]);
                self.steps.push(less(self.places[to as usize], self.places[from as usize]));
                self.turns.push([0.0; 2]);
            }
        }
    }
}

/// The lesser vertex first.
fn sorted([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}
