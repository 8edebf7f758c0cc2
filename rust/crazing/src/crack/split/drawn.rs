//! The cracks of a mesh as a drawing.

use super::measure;
use super::mesh::Mesh;
use crate::crack::aged::Aged;
use crate::crack::fence::Fence;
use crate::crack::net::{NONE, Net};
use crate::graph::Point;
use crate::parallel;
use crate::predicates::orientation;

impl Mesh {
    /// The cracks, without the outline.
    pub(super) fn finish(self) -> Aged {
        // One after the other on a thread of its own: which vertex is new depends on all that came before.
        let middles = || (0..self.cells.len()).map(|cell| self.middle(cell)).collect::<Vec<_>>();
        let (middles, (order, number)) = parallel::join(self.walls.len(), middles, || self.numbered());
        let mut cut = vec![false; order.len()];
        for end in self.border.iter().flat_map(|&[a, b, ..]| [a, b]) {
            if let Some(cut) = cut.get_mut(number[end as usize] as usize) {
                *cut = true;
            }
        }
        let apexes = if self.shifts.is_empty() { Vec::new() } else { self.apex_shifts(&middles) };
        let Self { points, walls: mut kites, partners, ages, shifts, period, .. } = self;
        let vertices = parallel::map(order.len(), |i| points[order[i] as usize]);
        drop((points, order));
        let mut anchors = Vec::with_capacity(middles.len());
        let anchor = |middle: Option<Point>| {
            let Some(middle) = middle else { return NONE };
            anchors.push(middle);
            (vertices.len() + anchors.len()) as i32 - 1
        };
        let anchor: Vec<i32> = middles.into_iter().map(anchor).collect();
        parallel::alter(&mut kites, |kite| {
            let [a, b, left, right] = kite.map(|x| x as usize);
            *kite = [number[a], number[b], anchor[left], anchor[right]];
        });
        let edges = parallel::map(kites.len(), |k| [kites[k][0], kites[k][1]]);
        let net = Net { vertices, edges, shifts, period, cut };
        let fence = Fence { anchors, kites, shifts: apexes };
        Aged { net, fence, partner: partners.into_flattened(), age: ages }
    }

    /// The vertices in the order in which walls come to them, and for each vertex its place there; -1 for corners of the
    /// bounds, to which none comes.
    fn numbered(&self) -> (Vec<i32>, Vec<i32>) {
        let mut number = vec![NONE; self.points.len()];
        let mut order = Vec::with_capacity(self.points.len());
        for end in self.walls.iter().flat_map(|&[a, b, ..]| [a, b]) {
            if number[end as usize] == NONE {
                number[end as usize] = order.len() as i32;
                order.push(end);
            }
        }
        (order, number)
    }

    /// The middle of a cell if all its walls see it.
    fn middle(&self, cell: usize) -> Option<Point> {
        let (area, middle) = measure(self.ring(cell));
        let next = self.ring(cell).skip(1).chain(self.ring(cell).take(1));
        self.ring(cell).zip(next).all(|(p, q)| orientation(p, q, middle) > 1e-9 * area).then_some(middle)
    }

    /// Periods between the first end of each wall and its other end, its left anchor, and its right anchor.
    fn apex_shifts(&self, middles: &[Option<Point>]) -> Vec<[i8; 6]> {
        let mut shifts = parallel::map(self.shifts.len(), |k| {
            let [x, y] = self.shifts[k];
            [x, y, 0, 0, 0, 0]
        });
        for cell in (0..self.cells.len()).filter(|&cell| middles[cell].is_some()) {
            for (corner, turn) in self.turns(cell) {
                let (k, side) = (corner.half as usize / 2, corner.half as usize % 2);
                let turn = [0, 1].map(|i| if side == 0 { turn[i] } else { turn[i] - i32::from(self.shifts[k][i]) });
                [shifts[k][2 + 2 * side], shifts[k][3 + 2 * side]] = turn.map(|x| -x as i8);
            }
        }
        shifts
    }
}
