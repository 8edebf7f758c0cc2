//! The cracks of a mesh as a drawing.

use super::measure;
use super::mesh::{Mesh, TOGETHER};
use crate::crack::aged::Aged;
use crate::crack::fence::Fence;
use crate::crack::net::{NONE, Net};
use crate::diagram::curve_order;
use crate::graph::Point;
use crate::incidence::Incidence;
use crate::parallel;
use crate::predicates::orientation;

impl Mesh {
    /// The cracks, without the outline: walls that are near each other stand together, cells having been split in no
    /// order of place.
    pub(super) fn finish(mut self) -> Aged {
        self.settle();
        let middles = self.middles();
        let sequence = self.in_order(&middles);
        // One after the other on a thread of its own: which vertex is new depends on all that came before.
        let (place, (vertices, number)) =
            parallel::join(sequence.len(), || inverse(&sequence), || self.numbered(&sequence));
        let mut cut = vec![false; vertices.len()];
        for end in self.border.iter().flatten() {
            if let Some(cut) = cut.get_mut(number[*end as usize] as usize) {
                *cut = true;
            }
        }
        let is_torus = self.period[0] > 0.0;
        let apexes = if is_torus { self.apex_shifts(&middles) } else { Vec::new() };
        let mut anchors = Vec::with_capacity(middles.len());
        let anchor = |middle: Option<Point>| {
            let Some(middle) = middle else { return NONE };
            anchors.push(middle);
            (vertices.len() + anchors.len()) as i32 - 1
        };
        let anchor: Vec<i32> = middles.into_iter().map(anchor).collect();
        let kites = parallel::map(sequence.len(), |i| {
            let k = sequence[i] as usize;
            let [a, b] = self.walls[k].map(|end| number[end as usize]);
            let [left, right] = [0, 1].map(|side| anchor[self.corners.walls[2 * k + side].cell as usize]);
            [a, b, left, right]
        });
        let of_end = |end: i32| if end == NONE { NONE } else { 2 * place[end as usize / 2] as i32 + end % 2 };
        let partner =
            parallel::map(2 * sequence.len(), |end| of_end(self.partners[sequence[end / 2] as usize][end % 2]));
        let edges = parallel::map(kites.len(), |k| [kites[k][0], kites[k][1]]);
        let shifts = sorted(&apexes, &sequence);
        let crossed = parallel::map(shifts.len(), |k| [shifts[k][0], shifts[k][1]]);
        let net = Net { vertices, edges, shifts: crossed, period: self.period, cut };
        Aged { net, fence: Fence { anchors, kites, shifts }, partner, age: sorted(&self.ages, &sequence) }
    }

    /// The walls cell by cell, along a curve through their middles.
    fn in_order(&self, middles: &[Option<Point>]) -> Vec<u32> {
        let start = |cell: usize| self.corners.get(self.firsts[cell]).at;
        let curve = curve_order(&parallel::map(middles.len(), |cell| middles[cell].unwrap_or_else(|| start(cell))));
        let rank = inverse(&curve);
        let first = parallel::map(self.walls.len(), |k| {
            let [left, right] = [0, 1].map(|side| rank[self.corners.walls[2 * k + side].cell as usize]);
            [left.min(right) as i32]
        });
        Incidence::of(middles.len(), &first).into_rows()
    }

    /// The vertices in the order in which walls come to them, and for each vertex its place there; -1 for corners of the
    /// bounds, to which none comes.
    fn numbered(&self, sequence: &[u32]) -> (Vec<Point>, Vec<i32>) {
        let mut number = vec![NONE; self.count];
        let mut vertices = Vec::with_capacity(self.count);
        for half in sequence.iter().flat_map(|&k| [2 * k as usize, 2 * k as usize + 1]) {
            let end = self.walls[half / 2][half % 2] as usize;
            if number[end] == NONE {
                number[end] = vertices.len() as i32;
                vertices.push(self.corners.walls[half].at);
            }
        }
        (vertices, number)
    }

    /// The middle of a cell, or of the part of it that all its walls see; none if there is no such part.
    fn middle(&self, cell: usize) -> Option<Point> {
        let (area, middle) = measure(self.ring(cell));
        let sees = |place: &Point| {
            let next = self.ring(cell).skip(1).chain(self.ring(cell).take(1));
            self.ring(cell).zip(next).all(|(p, q)| orientation(p, q, *place) > 1e-9 * area)
        };
        Some(middle).filter(sees).or_else(|| {
            let seen = kernel(&self.ring(cell).collect::<Vec<_>>());
            Some(measure(seen.into_iter()).1).filter(sees)
        })
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
    fn apex_shifts(&self, middles: &[Option<Point>]) -> Vec<[i8; 6]> {
        let crossed = |k: usize| self.corners.walls[2 * k].shift;
        let mut apexes = parallel::map(self.walls.len(), |k| [crossed(k)[0], crossed(k)[1], 0, 0, 0, 0]);
        for cell in 0..middles.len() {
            if cell % TOGETHER == 0 {
                self.fetch(cell..middles.len());
            }
            if middles[cell].is_none() {
                continue;
            }
            for (half, _, turn) in self.turns(cell) {
                let (k, side) = (half as usize / 2, half as usize % 2);
                let turn = [0, 1].map(|i| if side == 0 { turn[i] } else { turn[i] - i32::from(crossed(k)[i]) });
                [apexes[k][2 + 2 * side], apexes[k][3 + 2 * side]] = turn.map(|x| -x as i8);
            }
        }
        apexes
    }
}

/// Of each of the numbers below the length of a permutation its place there.
fn inverse(permutation: &[u32]) -> Vec<u32> {
    let mut place = vec![0; permutation.len()];
    permutation.iter().zip(0..).for_each(|(&number, i)| place[number as usize] = i);
    place
}

/// Rows in another order; none if there are none.
fn sorted<T: Copy + Sync + Send>(rows: &[T], order: &[u32]) -> Vec<T> {
    parallel::map(if rows.is_empty() { 0 } else { order.len() }, |i| rows[order[i] as usize])
}

/// The part of a polygon that all its sides see, but for rounding.
fn kernel(ring: &[Point]) -> Vec<Point> {
    let [low, high] =
        [f64::min, f64::max].map(|of| [0, 1].map(|axis| ring.iter().map(|p| p[axis]).fold(ring[0][axis], of)));
    // From the box around it on: a cell may have many corners, the place that all see hardly has.
    let mut seen = vec![low, [high[0], low[1]], high, [low[0], high[1]]];
    let mut part = Vec::new();
    for (&p, &q) in ring.iter().zip(ring.iter().cycle().skip(1)) {
        let height = |r: Point| (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
        part.clear();
        for (&a, &b) in seen.iter().zip(seen.iter().cycle().skip(1)) {
            let (here, there) = (height(a), height(b));
            if here >= 0.0 {
                part.push(a);
            }
            if (here < 0.0) != (there < 0.0) {
                let along = here / (here - there);
                part.push([0, 1].map(|i| a[i] + along * (b[i] - a[i])));
            }
        }
        std::mem::swap(&mut seen, &mut part);
        if seen.is_empty() {
            break;
        }
    }
    seen
}
