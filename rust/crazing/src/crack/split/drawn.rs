//! The cracks of a mesh as a drawing.

use super::measure;
use super::mesh::{Mesh, TOGETHER};
use crate::crack::aged::Aged;
use crate::crack::fence::Fence;
use crate::crack::net::{NONE, Net};
use crate::graph::Point;
use crate::parallel;
use crate::predicates::orientation;

impl Mesh {
    /// The cracks, without the outline.
    pub(super) fn finish(mut self) -> Aged {
        self.settle();
        // The others on a thread of its own, one after the other: which vertex is new depends on all that came before.
        let (middles, (vertices, number)) = parallel::join(self.walls.len(), || self.middles(), || self.numbered());
        let mut cut = vec![false; vertices.len()];
        for end in self.border.iter().flatten() {
            if let Some(cut) = cut.get_mut(number[*end as usize] as usize) {
                *cut = true;
            }
        }
        let is_torus = self.period[0] > 0.0;
        let shifts =
            if is_torus { parallel::map(self.walls.len(), |k| self.corners.walls[2 * k].shift) } else { Vec::new() };
        let apexes = if is_torus { self.apex_shifts(&shifts, &middles) } else { Vec::new() };
        let Self { corners, walls: mut edges, partners, ages, period, .. } = self;
        let mut anchors = Vec::with_capacity(middles.len());
        let anchor = |middle: Option<Point>| {
            let Some(middle) = middle else { return NONE };
            anchors.push(middle);
            (vertices.len() + anchors.len()) as i32 - 1
        };
        let anchor: Vec<i32> = middles.into_iter().map(anchor).collect();
        parallel::alter(&mut edges, |ends| *ends = ends.map(|end| number[end as usize]));
        let kites = parallel::map(edges.len(), |k| {
            let ([a, b], [left, right]) =
                (edges[k], [0, 1].map(|side| anchor[corners.walls[2 * k + side].cell as usize]));
            [a, b, left, right]
        });
        let net = Net { vertices, edges, shifts, period, cut };
        let fence = Fence { anchors, kites, shifts: apexes };
        Aged { net, fence, partner: partners.into_flattened(), age: ages }
    }

    /// The vertices in the order in which walls come to them, and for each vertex its place there; -1 for corners of the
    /// bounds, to which none comes.
    fn numbered(&self) -> (Vec<Point>, Vec<i32>) {
        let mut number = vec![NONE; self.count];
        let mut vertices = Vec::with_capacity(self.count);
        for (&end, corner) in self.walls.as_flattened().iter().zip(&self.corners.walls) {
            if number[end as usize] == NONE {
                number[end as usize] = vertices.len() as i32;
                vertices.push(corner.at);
            }
        }
        (vertices, number)
    }

    /// The middle of a cell if all its walls see it.
    fn middle(&self, cell: usize) -> Option<Point> {
        let (area, middle) = measure(self.ring(cell));
        let next = self.ring(cell).skip(1).chain(self.ring(cell).take(1));
        self.ring(cell).zip(next).all(|(p, q)| orientation(p, q, middle) > 1e-9 * area).then_some(middle)
    }

    /// The middles of all cells.
    fn middles(&self) -> Vec<Option<Point>> {
        let mut middles = vec![None; self.firsts.len()];
        parallel::fill(&mut middles, |range, middles| {
            for (start, middles) in range.step_by(TOGETHER).zip(middles.chunks_mut(TOGETHER)) {
                self.fetch(start..start + middles.len());
                middles.iter_mut().enumerate().for_each(|(i, slot)| *slot = self.middle(start + i));
            }
        });
        middles
    }

    /// Periods between the first end of each wall and its other end, its left anchor, and its right anchor.
    fn apex_shifts(&self, shifts: &[[i8; 2]], middles: &[Option<Point>]) -> Vec<[i8; 6]> {
        let mut apexes = parallel::map(shifts.len(), |k| [shifts[k][0], shifts[k][1], 0, 0, 0, 0]);
        for cell in 0..middles.len() {
            if cell % TOGETHER == 0 {
                self.fetch(cell..middles.len());
            }
            if middles[cell].is_none() {
                continue;
            }
            for (half, _, turn) in self.turns(cell) {
                let (k, side) = (half as usize / 2, half as usize % 2);
                let turn = [0, 1].map(|i| if side == 0 { turn[i] } else { turn[i] - i32::from(shifts[k][i]) });
                [apexes[k][2 + 2 * side], apexes[k][3 + 2 * side]] = turn.map(|x| -x as i8);
            }
        }
        apexes
    }
}
