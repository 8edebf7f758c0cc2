//! The bounds of a crack without a period: its edges end there, and the bounds close the plates along them.

use super::faces::{Net, less};
use crate::graph::Point;

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
        for k in 0..self.edges.len() {
            let (ends, step) = (self.edges[k], self.steps[k]);
            let start = self.places[ends[0]];
            let inside = ends.map(|vertex| border.holds(self.places[vertex]));
            if inside == [true; 2] {
                continue;
            }
            let Some(parts) = border.cut(start, step) else { continue };
            for end in (0..2).filter(|&end| !inside[end]) {
                let at = [0, 1].map(|axis| start[axis] + parts[end] * step[axis]);
                self.edges[k][end] = self.places.len();
                self.places.push([0, 1].map(|axis| at[axis].clamp(border.low[axis], border.high[axis])));
            }
            let [from, to] = self.edges[k].map(|vertex| self.places[vertex]);
            self.steps[k] = less(to, from);
            self.leads.push((k, less(from, start)));
        }
        self.frame(&border);
    }

    /// Adds the edges of the border, but for those along which the crack runs.
    fn frame(&mut self, border: &Border) {
        let mut used = vec![false; self.places.len()];
        self.edges.as_flattened().iter().for_each(|&vertex| used[vertex] = true);
        let first = self.places.len();
        let ([xmin, ymin], [xmax, ymax]) = (border.low, border.high);
        self.places.extend([[xmin, ymin], [xmax, ymin], [xmax, ymax], [xmin, ymax]]);
        used.extend([true; 4]);
        // Counter-clockwise; the corner comes before a vertex in it.
        let on = |vertex: usize| {
            border.along(self.places[vertex]).filter(|_| used[vertex]).map(|at| (at, vertex < first, vertex))
        };
        let mut around: Vec<(f64, bool, usize)> = (0..self.places.len()).filter_map(on).collect();
        around.sort_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
        // What ends in one place of the border, ends in one vertex.
        let mut same: Vec<usize> = (0..self.places.len()).collect();
        for at in 1..around.len() {
            if around[at].0 - around[at - 1].0 <= border.near {
                same[around[at].2] = same[around[at - 1].2];
            }
        }
        self.edges.as_flattened_mut().iter_mut().for_each(|vertex| *vertex = same[*vertex]);
        around.retain(|&(_, _, vertex)| same[vertex] == vertex);
        let is_on = |vertex: &usize| border.along(self.places[*vertex]).is_some();
        let mut taken: Vec<[usize; 2]> =
            self.edges.iter().filter(|ends| ends.iter().all(is_on)).map(|&[a, b]| [a.min(b), a.max(b)]).collect();
        taken.sort_unstable();
        for (from, to) in around.iter().zip(around.iter().cycle().skip(1)) {
            if taken.binary_search(&[from.2.min(to.2), from.2.max(to.2)]).is_err() {
                self.edges.push([from.2, to.2]);
                self.steps.push(less(self.places[to.2], self.places[from.2]));
                self.turns.push([0.0; 2]);
            }
        }
    }
}
