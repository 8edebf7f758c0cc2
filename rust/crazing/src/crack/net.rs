//! The drawing that the steps of a crack work on: straight edges in the plane or on a torus.

use crate::error::{Error, Result};
use crate::graph::{PlanarGraph, Point, check_indices};

/// A drawing whose edges may cross the sides of a period.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Net {
    /// Positions.
    pub vertices: Vec<Point>,
    /// Rows of `vertices`, two an edge.
    pub edges: Vec<[i32; 2]>,
    /// Periods that each edge crosses from its first vertex to its second; empty in the plane.
    pub shifts: Vec<[i8; 2]>,
    /// What is repeated; zeros in the plane.
    pub period: Point,
    /// Vertices where an edge was cut at the bounds: it goes on outside.
    pub cut: Vec<bool>,
}

/// The arrays of a [`Net`], borrowed. Edge ends are numbered 2 edge + side.
#[derive(Debug, Clone, Copy)]
pub struct NetView<'a> {
    /// See [`Net::vertices`].
    pub vertices: &'a [Point],
    /// See [`Net::edges`].
    pub edges: &'a [[i32; 2]],
    /// See [`Net::shifts`].
    pub shifts: &'a [[i8; 2]],
    /// See [`Net::period`].
    pub period: Point,
    /// See [`Net::cut`].
    pub cut: &'a [bool],
}

/// No edge goes on, no vertex, no parent.
pub(super) const NONE: i32 = -1;

impl Net {
    /// Borrows the arrays.
    pub fn view(&self) -> NetView<'_> {
        let Self { vertices, edges, shifts, period, cut } = self;
        NetView { vertices, edges, shifts, period: *period, cut }
    }

    /// A drawing in the plane without cut ends.
    pub fn plane(graph: PlanarGraph) -> Self {
        let cut = vec![false; graph.vertices.len()];
        Self { vertices: graph.vertices, edges: graph.edges, cut, ..Self::default() }
    }

    /// Moves the vertices into [0, width) x [0, height); in the plane, none.
    pub fn wrap(&mut self) {
        if self.shifts.is_empty() {
            return;
        }
        let period = self.period;
        let turn = |p: &Point| [0, 1].map(|i| (p[i] / period[i]).floor() as i8);
        let turns: Vec<[i8; 2]> = self.vertices.iter().map(turn).collect();
        for (vertex, turn) in self.vertices.iter_mut().zip(&turns).filter(|(_, turn)| **turn != [0, 0]) {
            *vertex = [0, 1].map(|i| (vertex[i] - f64::from(turn[i]) * period[i]).clamp(0.0, period[i].next_down()));
        }
        for (edge, shift) in self.edges.iter().zip(&mut self.shifts) {
            let [from, to] = edge.map(|vertex| turns[vertex as usize]);
            *shift = [0, 1].map(|i| shift[i] + to[i] - from[i]);
        }
    }
}

impl NetView<'_> {
    /// Checks that every array fits the others, so that what follows may index without a look.
    ///
    /// # Errors
    /// [`Error::BadIndex`], [`Error::BadLength`], [`Error::BadEntry`].
    pub fn check(&self) -> Result<()> {
        check_indices("edges", self.edges, 0, self.vertices.len())?;
        let fits = |array, found, wanted| {
            if found == wanted { Ok(()) } else { Err(Error::BadLength { array, found, wanted }) }
        };
        fits("cut", self.cut.len(), self.vertices.len())?;
        if !self.shifts.is_empty() {
            fits("shifts", self.shifts.len(), self.edges.len())?;
        }
        match self.vertices.iter().enumerate().find(|(_, p)| !p.iter().all(|x| x.is_finite())) {
            Some((row, &[x, y])) => {
                let value = if x.is_finite() { y } else { x };
                Err(Error::BadEntry { array: "vertices", row, value, wanted: "a finite number is wanted" })
            }
            None => Ok(()),
        }
    }

    /// Periods that an edge crosses.
    #[inline]
    pub fn shift(&self, edge: usize) -> [i8; 2] {
        self.shifts.get(edge).copied().unwrap_or_default()
    }

    /// `p` moved by whole periods.
    #[inline]
    pub fn moved(&self, p: Point, shift: [i8; 2]) -> Point {
        [p[0] + f64::from(shift[0]) * self.period[0], p[1] + f64::from(shift[1]) * self.period[1]]
    }

    /// Both ends of an edge, the first where its vertex lies.
    #[inline]
    pub fn ends(&self, edge: usize) -> [Point; 2] {
        let [a, b] = self.edges[edge];
        [self.vertices[a as usize], self.moved(self.vertices[b as usize], self.shift(edge))]
    }

    /// The vertex at an end.
    #[inline]
    pub fn vertex(&self, end: u32) -> usize {
        self.edges[end as usize / 2][end as usize % 2] as usize
    }

    /// The vector from an end along its edge to the other end.
    #[inline]
    pub fn along(&self, end: u32) -> Point {
        let [a, b] = self.ends(end as usize / 2);
        let (x, y) = (b[0] - a[0], b[1] - a[1]);
        if end.is_multiple_of(2) { [x, y] } else { [-x, -y] }
    }

    /// Length of an edge.
    #[inline]
    pub fn length(&self, edge: usize) -> f64 {
        length(self.along(2 * edge as u32))
    }

    /// The same drawing, its vertices moved into [0, width) x [0, height); in the plane, as it is.
    pub fn wrapped(&self) -> Net {
        let mut net = self.to_net();
        net.wrap();
        net
    }

    /// A copy that owns its arrays.
    pub fn to_net(&self) -> Net {
        let (vertices, edges, cut) = (self.vertices.to_vec(), self.edges.to_vec(), self.cut.to_vec());
        Net { vertices, edges, shifts: self.shifts.to_vec(), period: self.period, cut }
    }

    /// Number of edge ends at every vertex.
    pub fn degrees(&self) -> Vec<u32> {
        let mut degrees = vec![0; self.vertices.len()];
        for &vertex in self.edges.iter().flatten() {
            degrees[vertex as usize] += 1;
        }
        degrees
    }
}

/// Length of a vector; only those that would over- or underflow take the slow way.
#[inline]
pub(super) fn length([x, y]: Point) -> f64 {
    let square = x * x + y * y;
    if (1e-280..1e280).contains(&square) { square.sqrt() } else { libm::hypot(x, y) }
}

/// The ends of edges at each vertex, in one row.
#[derive(Debug, Clone)]
pub(super) struct Ends {
    starts: Vec<u32>,
    row: Vec<u32>,
}

impl Ends {
    pub(super) fn of(net: NetView<'_>) -> Self {
        Self::at_some(net, |_| true)
    }

    /// Those at some vertices only.
    pub(super) fn at_some(net: NetView<'_>, wanted: impl Fn(usize) -> bool) -> Self {
        let mut starts = vec![0; net.vertices.len() + 2];
        for &vertex in net.edges.iter().flatten().filter(|&&vertex| wanted(vertex as usize)) {
            starts[vertex as usize + 2] += 1;
        }
        for i in 2..starts.len() {
            starts[i] += starts[i - 1];
        }
        let mut row = vec![0; starts[starts.len() - 1] as usize];
        let ends = net.edges.iter().flatten().enumerate();
        for (end, &vertex) in ends.filter(|(_, vertex)| wanted(**vertex as usize)) {
            let place = &mut starts[vertex as usize + 1];
            row[*place as usize] = end as u32;
            *place += 1;
        }
        Self { starts, row }
    }

    /// The same with those of each vertex in the order of a key; equal ones stay ascending.
    pub(super) fn sorted_by_key(mut self, key: impl Fn(u32) -> i32) -> Self {
        for place in self.starts.windows(2) {
            self.row[place[0] as usize..place[1] as usize].sort_by_key(|&end| key(end));
        }
        self
    }

    #[inline]
    pub(super) fn at(&self, vertex: usize) -> &[u32] {
        &self.row[self.starts[vertex] as usize..self.starts[vertex + 1] as usize]
    }
}
