//! The cracks of a mesh as a drawing.

use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

use super::measure;
use super::mesh::{Edge, Mesh};
use crate::crack::aged::Aged;
use crate::crack::fence::Fence;
use crate::crack::net::{NONE, Net};
use crate::graph::Point;
use crate::parallel;
use crate::predicates::orientation;

impl Mesh {
    /// The cracks, without the outline.
    pub(super) fn finish(self) -> Aged {
        let is_drawn = |k: &usize| self.edges[*k].age != NONE;
        let drawn = parallel::compact(self.edges.len(), |k| Some(k).filter(is_drawn).map(|k| k as u32));
        let outline = parallel::compact(self.edges.len(), |k| (!is_drawn(&k)).then_some(k));
        let edge = |i: usize| &self.edges[drawn[i] as usize];
        let (order, number) = self.numbered(&drawn);
        let mut cut = vec![false; order.len()];
        for end in outline.iter().flat_map(|&k| self.edges[k].ends) {
            if let Some(cut) = cut.get_mut(number[end as usize].load(Relaxed) as usize) {
                *cut = true;
            }
        }
        let is_torus = self.period[0] > 0.0;
        let net = Net {
            vertices: parallel::map(order.len(), |i| self.points[order[i] as usize]),
            edges: parallel::map(drawn.len(), |i| edge(i).ends.map(|end| number[end as usize].load(Relaxed) as i32)),
            shifts: if is_torus { parallel::map(drawn.len(), |i| edge(i).shift) } else { Vec::new() },
            period: self.period,
            cut,
        };
        drop((order, number));
        let fence = self.fence(&drawn, &net);
        let age = parallel::map(drawn.len(), |i| edge(i).age);
        Aged { net, fence, partner: self.pairs(&drawn), age }
    }

    /// The vertices of some edges in the order in which these come to them, and for each vertex its place there.
    fn numbered(&self, drawn: &[u32]) -> (Vec<u32>, Vec<AtomicU32>) {
        let vertex = |end: usize| self.edges[drawn[end / 2] as usize].ends[end % 2];
        let number = parallel::map(self.points.len(), |_| AtomicU32::new(u32::MAX));
        // The least of all that come by, in any order.
        parallel::each(2 * drawn.len(), |end| {
            number[vertex(end) as usize].fetch_min(end as u32, Relaxed);
        });
        let is_first = |end: usize| number[vertex(end) as usize].load(Relaxed) == end as u32;
        let order = parallel::compact(2 * drawn.len(), |end| is_first(end).then(|| vertex(end)));
        parallel::each(order.len(), |i| number[order[i] as usize].store(i as u32, Relaxed));
        (order, number)
    }

    /// For both ends of each of some edges the end by which its crack goes on.
    fn pairs(&self, drawn: &[u32]) -> Vec<i32> {
        let mut row = vec![NONE; self.edges.len()];
        drawn.iter().zip(0..).for_each(|(&k, i)| row[k as usize] = i);
        parallel::map(2 * drawn.len(), |end| match self.partners[drawn[end / 2] as usize][end % 2] {
            NONE => NONE,
            other => 2 * row[other as usize / 2] + other % 2,
        })
    }

    /// The middle of each cell whose walls all see it.
    fn fence(&self, drawn: &[u32], net: &Net) -> Fence {
        let middles = parallel::map(self.cells.len(), |cell| self.middle(cell));
        let mut anchors = Vec::with_capacity(middles.len());
        let anchor = |middle: &Option<Point>| {
            let Some(middle) = middle else { return NONE };
            anchors.push(*middle);
            (net.vertices.len() + anchors.len()) as i32 - 1
        };
        let anchor: Vec<i32> = middles.iter().map(anchor).collect();
        let kites = parallel::map(drawn.len(), |i| {
            let ([a, b], [left, right]) = (net.edges[i], self.edges[drawn[i] as usize].cells);
            [a, b, anchor[left as usize], anchor[right as usize]]
        });
        let shifts = if net.shifts.is_empty() { Vec::new() } else { self.apex_shifts(&middles) };
        Fence { anchors, kites, shifts }
    }

    /// The middle of a cell if all its walls see it.
    fn middle(&self, cell: usize) -> Option<Point> {
        let (area, middle) = measure(self.ring(cell));
        let next = self.ring(cell).skip(1).chain(self.ring(cell).take(1));
        self.ring(cell).zip(next).all(|(p, q)| orientation(p, q, middle) > 1e-9 * area).then_some(middle)
    }

    /// Periods between the first end of each edge and its other end, its left anchor, and its right anchor.
    fn apex_shifts(&self, middles: &[Option<Point>]) -> Vec<[i8; 6]> {
        let mut shifts = parallel::map(self.edges.len(), |k| {
            let [x, y] = self.edges[k].shift;
            [x, y, 0, 0, 0, 0]
        });
        for cell in (0..self.cells.len()).filter(|&cell| middles[cell].is_some()) {
            for (corner, turn) in self.turns(cell) {
                let (k, side) = (corner.half as usize / 2, corner.half as usize % 2);
                let Edge { shift, .. } = self.edges[k];
                let turn = [0, 1].map(|i| if side == 0 { turn[i] } else { turn[i] - i32::from(shift[i]) });
                [shifts[k][2 + 2 * side], shifts[k][3 + 2 * side]] = turn.map(|x| -x as i8);
            }
        }
        shifts
    }
}
