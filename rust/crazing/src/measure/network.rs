//! A drawing as nodes and the segments between them: chains of edges through vertices of degree 2 are joined.

use crate::clip::Bounds;
use crate::error::{Error, Result};
use crate::graph::{self, Point};
use crate::watch::Watch;

/// A graph to be measured.
#[derive(Debug, Clone, Copy, Default)]
pub struct Drawing<'a> {
    /// Positions.
    pub vertices: &'a [Point],
    /// Rows of `vertices`, two an edge.
    pub edges: &'a [[i32; 2]],
    /// Periods that each edge crosses on its way from the first end to the second; empty in the plane.
    pub shifts: &'a [[i8; 2]],
    /// Width and height of the torus; read only with `shifts`.
    pub period: Point,
    /// Width at both ends of each edge; empty when there are none.
    pub widths: &'a [[f64; 2]],
    /// Where the drawing was cut, if it was.
    pub bounds: Option<Bounds>,
}

impl Drawing<'_> {
    /// Checks that the arrays belong together.
    ///
    /// # Errors
    /// [`Error::BadLength`], [`Error::BadIndex`], [`Error::NotFinite`] or [`Error::BadEntry`].
    pub fn check(&self, watch: Watch<'_>) -> Result<()> {
        let wanted = self.edges.len();
        for (array, found) in [("shifts", self.shifts.len()), ("width", self.widths.len())] {
            if found != 0 && found != wanted {
                return Err(Error::BadLength { array, found, wanted });
            }
        }
        graph::degrees(self.vertices.len(), self.edges, watch)?;
        let finite = |p: &Point| p.iter().all(|x| x.is_finite());
        if let Some(row) = self.vertices.iter().position(|p| !finite(p)) {
            return Err(Error::NotFinite { row, x: self.vertices[row][0], y: self.vertices[row][1] });
        }
        let sane = |w: &[f64; 2]| w.iter().all(|w| w.is_finite() && *w >= 0.0);
        if let Some(row) = self.widths.iter().position(|w| !sane(w)) {
            let value = self.widths[row].into_iter().find(|w| !(w.is_finite() && *w >= 0.0)).unwrap_or(0.0);
            return Err(Error::BadEntry {
                array: "width",
                row,
                value,
                wanted: "a finite number of at least 0 is wanted",
            });
        }
        Ok(())
    }

    /// The way along half-edge `2 k` (edge `k` forward) or `2 k + 1` (back).
    pub(super) fn step(&self, half: u32) -> Point {
        let [a, b] = self.edges[half as usize / 2].map(|end| self.vertices[end as usize]);
        let shift = self.shift(half & !1);
        let way = [0, 1].map(|i| b[i] - a[i] + f64::from(shift[i]) * self.period[i]);
        if half.is_multiple_of(2) { way } else { way.map(|x| -x) }
    }

    /// Periods crossed along a half-edge.
    pub(super) fn shift(&self, half: u32) -> [i32; 2] {
        let shift = self.shifts.get(half as usize / 2).map_or([0; 2], |shift| shift.map(i32::from));
        if half.is_multiple_of(2) { shift } else { shift.map(|x| -x) }
    }

    /// The vertex that a half-edge leaves.
    pub(super) fn origin(&self, half: u32) -> usize {
        self.edges[half as usize / 2][half as usize % 2] as usize
    }
}

/// Segments of a drawing. Their ends are numbered `2 s` (the first end of segment `s`) and `2 s + 1`.
#[derive(Debug, Clone, Default)]
pub(super) struct Network {
    /// Edge ends at every vertex of the drawing.
    pub(super) degree: Vec<i32>,
    /// Half-edges along all segments one after the other.
    pub(super) halves: Vec<u32>,
    /// Where each segment begins in `halves`, and the end.
    pub(super) starts: Vec<usize>,
    /// The vertices at both ends; twice the same for a ring.
    pub(super) ends: Vec<[u32; 2]>,
    /// Length of each segment.
    pub(super) length: Vec<f64>,
    /// The straight way from the first end to the second, unwrapped.
    pub(super) way: Vec<Point>,
}

impl Network {
    pub(super) fn of(drawing: &Drawing<'_>, watch: Watch<'_>) -> Result<Self> {
        let degree = graph::degrees(drawing.vertices.len(), drawing.edges, watch)?;
        // Exclusive or of the half-edges that leave each vertex: where two leave, either one gives the other.
        let mut leaving = vec![0_u32; degree.len()];
        let all = 0..2 * drawing.edges.len() as u32;
        all.clone().for_each(|half| leaving[drawing.origin(half)] ^= half);
        let mut found = Self { degree, starts: vec![0], ..Self::default() };
        let mut used = vec![false; drawing.edges.len()];
        let tips: Vec<u32> = all.clone().filter(|&half| found.degree[drawing.origin(half)] != 2).collect();
        for half in tips.into_iter().chain(all) {
            watch.poll_at(half as usize)?;
            if !used[half as usize / 2] {
                found.follow(drawing, half, &leaving, &mut used);
            }
        }
        Ok(found)
    }

    fn follow(&mut self, drawing: &Drawing<'_>, first: u32, leaving: &[u32], used: &mut [bool]) {
        let (mut half, mut length, mut way) = (first, 0.0, [0.0; 2]);
        while !used[half as usize / 2] {
            used[half as usize / 2] = true;
            self.halves.push(half);
            let step = drawing.step(half);
            length += libm::hypot(step[0], step[1]);
            way = [way[0] + step[0], way[1] + step[1]];
            let end = drawing.origin(half ^ 1);
            if self.degree[end] != 2 {
                break;
            }
            half = leaving[end] ^ half ^ 1;
        }
        let last = self.halves.last().map_or(first, |&half| half);
        self.ends.push([first, last ^ 1].map(|half| drawing.origin(half) as u32));
        self.starts.push(self.halves.len());
        self.length.push(length);
        self.way.push(way);
    }

    pub(super) fn count(&self) -> usize {
        self.ends.len()
    }

    /// Half-edges along one segment.
    pub(super) fn along(&self, segment: usize) -> &[u32] {
        &self.halves[self.starts[segment]..self.starts[segment + 1]]
    }

    /// Half-edges from an end of a segment inwards.
    pub(super) fn inwards(&self, end: usize) -> impl Iterator<Item = u32> + '_ {
        let along = self.along(end / 2);
        let back = !end.is_multiple_of(2);
        (0..along.len()).map(move |i| if back { along[along.len() - 1 - i] ^ 1 } else { along[i] })
    }

    /// Degree of the vertex at an end.
    pub(super) fn degree_at(&self, end: usize) -> i32 {
        self.degree[self.ends[end / 2][end % 2] as usize]
    }
}
