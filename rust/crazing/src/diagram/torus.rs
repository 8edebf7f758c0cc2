//! From a triangulation of sites and copies in the plane to the torus below it.

use super::Diagram;
use super::delaunay::Topology;
use super::periodic::{Cell, PeriodicDiagram, Row};
use super::vertices::coincide;
use crate::error::{Error, Result};
use crate::graph::Point;
use crate::parallel;
use crate::sets::DisjointSets;

pub(super) type Shift = [i8; 2];

/// Sites of the cell and copies about it, along a curve, and their triangulation in the plane.
#[derive(Default)]
pub(super) struct Cover {
    /// The site of every row.
    pub(super) site_of: Vec<i32>,
    pub(super) at: Vec<Point>,
    /// Whose copy each one is, and how many periods away.
    pub(super) site: Vec<i32>,
    pub(super) shift: Vec<Shift>,
    pub(super) topology: Topology,
    /// Circumcentres of the triangles.
    pub(super) centres: Vec<Point>,
    /// Whether any two of neighbours may coincide.
    pub(super) coincident: bool,
}

/// Triangles that one thread takes at a time.
const RUN: usize = 1 << 12;

/// The radius of a circle through a point, grown by far more than the rounding of its centre.
pub(super) fn circle(centre: Point, through: Point) -> f64 {
    let (x, y) = (centre[0] - through[0], centre[1] - through[1]);
    (1.0 + 1e-9) * (x * x + y * y).sqrt()
}

/// How far a circle reaches out of a cell along each axis.
pub(super) fn out_of(period: Point, centre: Point, radius: f64) -> Point {
    [0, 1].map(|i| match (radius - centre[i]).max(centre[i] + radius - period[i]) {
        // A centre that is no number reaches anywhere.
        out if out.is_nan() => f64::INFINITY,
        out => out,
    })
}

/// A triangle whatever the copy: its sites from the lowest corner on, and where two of them are seen from it.
type Name = ([i32; 3], [Shift; 2]);

impl Cover {
    pub(super) fn is_home(&self, i: i32) -> bool {
        self.shift[i as usize] == [0, 0]
    }

    /// How far the circles about the triangles at sites of the cell reach out of it.
    pub(super) fn reach(&self, period: Point) -> Point {
        let triangles = &self.topology.triangles;
        let farther = |reach: Point, other: Point| [reach[0].max(other[0]), reach[1].max(other[1])];
        let of_run = |run: usize| {
            let end = triangles.len().min((run + 1) * RUN);
            (run * RUN..end)
                .filter(|&t| triangles[t].iter().any(|&i| self.is_home(i)))
                .map(|t| out_of(period, self.centres[t], circle(self.centres[t], self.at[triangles[t][0] as usize])))
                .fold([0.0; 2], farther)
        };
        parallel::map_slow(triangles.len().div_ceil(RUN), of_run).into_iter().fold([0.0; 2], farther)
    }

    /// Of the copies of a triangle or edge, the one whose lowest corner is in the cell stands for all.
    fn lowest<const N: usize>(&self, corners: [i32; N]) -> usize {
        let mut lowest = 0;
        for i in 1..N {
            let (p, q) = (self.at[corners[i] as usize], self.at[corners[lowest] as usize]);
            if p[0] < q[0] || (p[0] == q[0] && p[1] < q[1]) {
                lowest = i;
            }
        }
        lowest
    }

    /// Whether a triangle or edge stands for all its copies.
    fn stands<const N: usize>(&self, corners: [i32; N]) -> bool {
        corners.iter().all(|&i| self.is_home(i)) || self.is_home(corners[self.lowest(corners)])
    }

    fn name(&self, t: i32) -> Name {
        let mut corners = self.topology.triangles[t as usize];
        let first = self.lowest(corners);
        corners.rotate_left(first);
        let [a, b, c] = corners.map(|i| self.shift[i as usize]);
        (corners.map(|i| self.site[i as usize]), [minus(b, a), minus(c, a)])
    }

    /// The torus.
    ///
    /// # Errors
    /// [`Error::Internal`] when the halo was too narrow, which its certificate rules out.
    pub(super) fn restrict(mut self, rows: &[Row], cell: &Cell) -> Result<PeriodicDiagram> {
        let kept = Kept::of(&self);
        let vertices = self.vertices(&kept, cell)?;
        let mut torus = PeriodicDiagram::default();
        // What is kept moves down in the memory that it is in: fresh memory costs more than all that is done here.
        let mut edges = std::mem::take(&mut self.topology.edges);
        let mut dual_edges = std::mem::take(&mut self.topology.dual_edges);
        let mut count = 0;
        torus.shifts.reserve_exact(edges.len());
        torus.dual_shifts.reserve_exact(edges.len());
        for k in 0..edges.len() {
            let (ends, sides) = (edges[k], dual_edges[k]);
            if self.stands(ends) {
                let dual = [kept.number(&self, sides[0])?, kept.number(&self, sides[1])?];
                let turns = [0, 1].map(|i| self.turns(sides[i], vertices[dual[i] as usize], cell.period));
                let shift = minus(self.shift[ends[1] as usize], self.shift[ends[0] as usize]);
                let row = (ends.map(|i| self.site[i as usize]), dual, shift, minus(turns[1], turns[0]));
                let (shift, dual_shift);
                (edges[count], dual_edges[count], shift, dual_shift) = upward(row);
                torus.shifts.push(shift);
                torus.dual_shifts.push(dual_shift);
                count += 1;
            }
        }
        edges.truncate(count);
        dual_edges.truncate(count);
        let mut triangles = std::mem::take(&mut self.topology.triangles);
        for (number, &t) in kept.rows.iter().enumerate() {
            triangles[number] = triangles[t as usize].map(|i| self.site[i as usize]);
        }
        triangles.truncate(kept.rows.len());
        torus.diagram = Diagram { triangles, edges, dual_edges, ..Diagram::default() };
        place(&mut torus.diagram, vertices, rows, self.site_of, cell);
        let Diagram { sites, triangles, edges, .. } = &torus.diagram;
        let whole = sites.len() + triangles.len() == edges.len();
        if whole { Ok(torus) } else { Err(Error::Internal("a torus with holes")) }
    }

    /// Circumcentres moved into the cell. Coincident ones of neighbours are equal.
    fn vertices(&self, kept: &Kept, cell: &Cell) -> Result<Vec<Point>> {
        let wrap = |c: f64, side: f64| match c {
            // Adding zero turns -0.0 into 0.0.
            _ if (0.0..side).contains(&c) => c + 0.0,
            _ => (c - (c / side).floor() * side).clamp(0.0, side.next_down()),
        };
        let moved = |c: Point| [wrap(c[0], cell.period[0]), wrap(c[1], cell.period[1])];
        let mut vertices = parallel::map(kept.rows.len(), |row| moved(self.centres[kept.rows[row] as usize]));
        if !self.coincident {
            return Ok(vertices);
        }
        let Topology { edges, dual_edges, .. } = &self.topology;
        let coincident = |k: usize| match dual_edges[k] {
            [-1, _] | [_, -1] => false,
            [r, s] => coincide(self.centres[r as usize], self.centres[s as usize], self.at[edges[k][0] as usize]),
        };
        if let Some(first) = parallel::first(edges.len(), coincident) {
            let mut sets = DisjointSets::new(vertices.len());
            for k in (first..edges.len()).filter(|&k| coincident(k) && self.stands(edges[k])) {
                let dual = [kept.number(self, dual_edges[k][0])?, kept.number(self, dual_edges[k][1])?];
                sets.unite(dual[0] as usize, dual[1] as usize);
            }
            for t in 0..vertices.len() {
                vertices[t] = vertices[sets.lowest(t)];
            }
        }
        Ok(vertices)
    }

    /// Periods between the centre of a triangle as it lies in the plane and its vertex.
    fn turns(&self, t: i32, vertex: Point, period: Point) -> Shift {
        let centre = self.centres[t as usize];
        if centre == vertex {
            return [0, 0];
        }
        [0, 1].map(|i| ((centre[i] - vertex[i]) / period[i]).round() as i8)
    }
}

fn minus(a: Shift, b: Shift) -> Shift {
    [a[0] - b[0], a[1] - b[1]]
}

/// Positions in the user's units.
fn place(diagram: &mut Diagram, vertices: Vec<Point>, rows: &[Row], mut site_of: Vec<i32>, cell: &Cell) {
    site_of.truncate(rows.len());
    diagram.site_of = site_of;
    let count = diagram.site_of.iter().max().map_or(0, |&last| last as usize + 1);
    diagram.sites = vec![[0.0; 2]; count];
    // Backward, so that the first row of a site has the last word.
    for (row, &site) in rows.iter().zip(&diagram.site_of).rev() {
        diagram.sites[site as usize] = row.given;
    }
    let inside = |x: f64, i: usize| x.min(cell.given[i].next_down());
    let up = |p: Point| cell.scale.up(p);
    diagram.vertices = vertices.into_iter().map(up).map(|[x, y]| [inside(x, 0), inside(y, 1)]).collect();
}

/// Sites, triangles and both shifts of an edge.
type EdgeRow = ([i32; 2], [i32; 2], Shift, Shift);

/// From the lower site to the higher; between copies of one site rightward, or up.
fn upward(row: EdgeRow) -> EdgeRow {
    let ([from, to], [right, left], shift, dual_shift) = row;
    if from > to || (from == to && shift < [0, 0]) {
        ([to, from], [left, right], minus([0, 0], shift), minus([0, 0], dual_shift))
    } else {
        row
    }
}

/// The triangles that stand for all their copies.
struct Kept {
    /// Rows of the triangulation in the plane.
    rows: Vec<i32>,
    /// The number of each triangle in the plane; -1 for those that do not stand for others.
    number: Vec<i32>,
    /// Those that reach out of the cell by name: copies of no other are met at the cell's own edges.
    by_name: Vec<(Name, i32)>,
}

impl Kept {
    fn of(cover: &Cover) -> Self {
        let number = Vec::with_capacity(cover.topology.triangles.len());
        let mut kept = Self { rows: Vec::new(), number, by_name: Vec::new() };
        for (t, &corners) in cover.topology.triangles.iter().enumerate() {
            let is_kept = cover.stands(corners);
            kept.number.push(if is_kept { kept.rows.len() as i32 } else { -1 });
            if is_kept {
                if !corners.iter().all(|&i| cover.is_home(i)) {
                    kept.by_name.push((cover.name(t as i32), kept.rows.len() as i32));
                }
                kept.rows.push(t as i32);
            }
        }
        kept.by_name.sort_unstable();
        kept
    }

    /// The number of the triangle that stands for `t`.
    fn number(&self, cover: &Cover, t: i32) -> Result<i32> {
        match self.number.get(t as usize) {
            Some(-1) => {
                let name = cover.name(t);
                let row = self.by_name.binary_search_by_key(&name, |entry| entry.0).ok();
                row.map(|row| self.by_name[row].1).ok_or(Error::Internal("a triangle without its copy"))
            }
            Some(&own) => Ok(own),
            None => Err(Error::Internal("a triangle without its copy")),
        }
    }
}
