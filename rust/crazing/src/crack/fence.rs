//! The fence around a drawing: triangles that pave the plane about its edges. While a vertex moves, all triangles at
//! it must stay counter-clockwise; then no edge can cross another, and none can change sides.
//!
//! The law behind it: triangles that are all counter-clockwise, and whose outline does not move, pave the same region
//! as before, each point once. Edges are sides of triangles, so they cannot meet but at their ends.

use super::net::{NONE, NetView};
use crate::clip::Bounds;
use crate::error::{Error, Result};
use crate::graph::{Point, check_indices};
use crate::parallel;

/// Two triangles an edge: kite `[a, b, left, right]` holds `a b left` and `b a right`. Kite `k` is about edge `k` of
/// the drawing; more may follow, about edges that are not drawn. Nothing at a kite with a -1 moves.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Fence {
    /// Points that do not move; numbered after the vertices of the drawing.
    pub anchors: Vec<Point>,
    /// Rows of vertices and anchors.
    pub kites: Vec<[i32; 4]>,
    /// Periods between `a` and each of `b`, `left`, `right`; empty in the plane.
    pub shifts: Vec<[i8; 6]>,
}

/// The arrays of a [`Fence`], borrowed.
#[derive(Debug, Clone, Copy)]
pub struct FenceView<'a> {
    /// See [`Fence::anchors`].
    pub anchors: &'a [Point],
    /// See [`Fence::kites`].
    pub kites: &'a [[i32; 4]],
    /// See [`Fence::shifts`].
    pub shifts: &'a [[i8; 6]],
}

impl Fence {
    /// A fence without room: no vertex of the drawing moves.
    pub fn shut(net: NetView<'_>) -> Self {
        let kites = net.edges.iter().map(|&[a, b]| [a, b, NONE, NONE]).collect();
        Self { anchors: Vec::new(), kites, shifts: vec![[0; 6]; net.shifts.len()] }
    }

    /// Draws in the anchors that lie beyond bounds, of a fence whose kites have been cut there and have anchors on
    /// both sides: then nothing that it holds leaves the bounds.
    ///
    /// About such an anchor the kites pave a convex cell, all of it but the corners of the bounds; from the middle of
    /// their ends it is seen within that cell.
    pub(super) fn draw_in(&mut self, vertices: &[Point], bounds: Bounds) {
        let is_beyond = |p: &Point| (0..2).any(|i| p[i] < bounds[i] || p[i] > bounds[i + 2]);
        let anchors = self.anchors.len();
        let beyond = parallel::compact(anchors, |anchor| is_beyond(&self.anchors[anchor]).then_some(anchor));
        if beyond.is_empty() {
            return;
        }
        let mut sums = vec![([0.0; 2], 0.0); anchors];
        for &[a, b, left, right] in &self.kites {
            let anchors = [left, right].map(|corner| corner as usize - vertices.len());
            for point in [a, b].map(|point| point as usize) {
                let p = *vertices.get(point).unwrap_or_else(|| &self.anchors[point - vertices.len()]);
                for anchor in anchors {
                    let (sum, count) = &mut sums[anchor];
                    *sum = [sum[0] + p[0], sum[1] + p[1]];
                    *count += 1.0;
                }
            }
        }
        for anchor in beyond.into_iter().filter(|&anchor| sums[anchor].1 > 0.0) {
            let (sum, count) = sums[anchor];
            let (middle, far) = (sum.map(|x| x / count), self.anchors[anchor]);
            // The part of the way that leads to the bounds.
            let part = (0..2).map(|i| {
                let step = far[i] - middle[i];
                let room = if step > 0.0 { bounds[i + 2] - middle[i] } else { bounds[i] - middle[i] };
                if step == 0.0 { 1.0 } else { room / step }
            });
            let half = 0.5 * part.fold(1.0, f64::min).max(0.0);
            self.anchors[anchor] = [0, 1].map(|i| middle[i] + half * (far[i] - middle[i]));
        }
    }

    /// Borrows the arrays.
    pub fn view(&self) -> FenceView<'_> {
        FenceView { anchors: &self.anchors, kites: &self.kites, shifts: &self.shifts }
    }
}

impl FenceView<'_> {
    /// A copy that owns its arrays.
    pub fn to_fence(&self) -> Fence {
        Fence { anchors: self.anchors.to_vec(), kites: self.kites.to_vec(), shifts: self.shifts.to_vec() }
    }

    /// Checks that the fence fits the drawing.
    ///
    /// # Errors
    /// [`Error::BadIndex`], [`Error::BadLength`], [`Error::Inconsistent`].
    pub fn check(&self, net: NetView<'_>) -> Result<()> {
        check_indices("kites", self.kites, NONE, net.vertices.len() + self.anchors.len())?;
        if self.kites.len() < net.edges.len() {
            return Err(Error::BadLength { array: "kites", found: self.kites.len(), wanted: net.edges.len() });
        }
        if !self.shifts.is_empty() && self.shifts.len() != self.kites.len() {
            return Err(Error::BadLength { array: "shifts", found: self.shifts.len(), wanted: self.kites.len() });
        }
        let differs = |k: usize| self.kites[k][..2] != net.edges[k];
        let is_open = |k: usize| self.kites[k][0] < 0 || self.kites[k][1] < 0;
        let first = parallel::first(net.edges.len(), differs);
        match first.or_else(|| parallel::first(self.kites.len(), is_open)) {
            Some(row) => Err(Error::Inconsistent { array: "kites", row }),
            None => Ok(()),
        }
    }
}
