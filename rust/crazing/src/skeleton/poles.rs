//! Poles: of every cell the vertices that tell best where the medial axis runs.

use super::far::near;
use crate::diagram::scale::{Scale, largest};
use crate::diagram::{DiagramView, representatives, triangulate_near_one};
use crate::error::Result;
use crate::graph::Point;
use crate::incidence::Incidence;
use crate::parallel;
use crate::predicates::{apex_sign, nearer_sign, projection_sign};
use crate::watch::Watch;

/// How poles are chosen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Variant {
    /// First the farthest vertex of the cell, second the one farthest back along the line from the site to the first.
    Thesis,
    /// Second the farthest vertex on the side away from the first; of an unbounded cell the first is at infinity.
    Amenta,
}

/// Two vertices for every site, -1 where there is none. Coincident vertices are represented by the lowest row.
///
/// Distances and products are compared exactly between the rounded vertices; the lowest row wins a tie. The direction
/// of a pole at infinity is the mean of the outward unit normals of the two hull edges at the site.
///
/// # Errors
/// [`crate::Error::TooFewSites`], [`crate::Error::Collinear`], [`crate::Error::Interrupted`].
///
/// # Source
/// Amenta, Bern: Surface Reconstruction by Voronoi Filtering (1999); thesis, section 5.1.
pub fn poles(view: DiagramView<'_>, variant: Variant, watch: Watch<'_>) -> Result<Vec<[i32; 2]>> {
    view.check_triangle()?;
    let cells = Cells::of(view, watch)?;
    let outward = if variant == Variant::Amenta { outward(view, &cells.sites) } else { Vec::new() };
    let of = |site: usize| match variant {
        Variant::Thesis => cells.thesis(site),
        Variant::Amenta => cells.amenta(site, outward[site]),
    };
    parallel::map_watched(view.sites.len(), of, watch)
}

/// Edges of the Delaunay triangulation of sites and poles that join two poles, sorted, each with the lower end first.
///
/// # Errors
/// [`crate::Error::TooFewSites`], [`crate::Error::Collinear`], [`crate::Error::Interrupted`].
///
/// # Source
/// Thesis, section 5.1.
pub fn poles_axis(view: DiagramView<'_>, variant: Variant, watch: Watch<'_>) -> Result<Vec<[i32; 2]>> {
    let mut distinct: Vec<i32> = poles(view, variant, watch)?.into_iter().flatten().filter(|&t| t != -1).collect();
    watch.poll()?;
    distinct.sort_unstable();
    distinct.dedup();
    let scale = Scale::of(largest(view.sites));
    let mut points: Vec<Point> = view.sites.iter().map(|&p| scale.down(p)).collect();
    points.extend(distinct.iter().map(|&t| near(scale.down(view.vertices[t as usize]))));
    let (first_row, edges) = triangulate_near_one(points, watch)?;
    let pole = |point: i32| (first_row[point as usize] as usize).checked_sub(view.sites.len()).map(|row| distinct[row]);
    let joined = edges.iter().filter_map(|&[a, b]| pole(a).zip(pole(b)));
    let mut axis: Vec<[i32; 2]> = joined.map(|(a, b)| [a.min(b), a.max(b)]).collect();
    axis.sort_unstable();
    Ok(axis)
}

/// Sites and vertices near 1, and which vertices are the corners of each cell.
struct Cells {
    sites: Vec<Point>,
    vertices: Vec<Point>,
    representative: Vec<i32>,
    triangles: Incidence,
}

impl Cells {
    fn of(view: DiagramView<'_>, watch: Watch<'_>) -> Result<Self> {
        let scale = Scale::of(largest(view.sites));
        let sites = parallel::map_watched(view.sites.len(), |i| scale.down(view.sites[i]), watch)?;
        let vertices = parallel::map_watched(view.vertices.len(), |i| near(scale.down(view.vertices[i])), watch)?;
        let representative = representatives(view);
        watch.poll()?;
        Ok(Self { sites, vertices, representative, triangles: Incidence::of(view.sites.len(), view.triangles) })
    }

    /// The corners of a cell; coincident ones repeat.
    fn corners(&self, site: usize) -> impl Iterator<Item = i32> {
        self.triangles.at(site).iter().map(|&t| self.representative[t as usize])
    }

    fn place(&self, vertex: i32) -> Point {
        self.vertices[vertex as usize]
    }

    /// The corner that is farthest from the site; -1 of none.
    fn farthest(&self, site: usize, corners: impl Iterator<Item = i32>) -> i32 {
        let sign = |v: i32, best: i32| nearer_sign(self.sites[site], self.place(best), self.place(v));
        first_by(corners, sign)
    }

    fn thesis(&self, site: usize) -> [i32; 2] {
        let p = self.sites[site];
        let first = self.farthest(site, self.corners(site));
        let along = |v: i32, best: i32| projection_sign(p, self.place(first), self.place(v), self.place(best));
        [first, first_by(self.corners(site).filter(|&v| v != first), along)]
    }

    fn amenta(&self, site: usize, outward: Option<Point>) -> [i32; 2] {
        let p = self.sites[site];
        let first = if outward.is_some() { -1 } else { self.farthest(site, self.corners(site)) };
        let behind = |v: &i32| match outward {
            Some([x, y]) => x * (self.place(*v)[0] - p[0]) + y * (self.place(*v)[1] - p[1]) < 0.0,
            None => apex_sign(self.place(first), self.place(*v), p) < 0.0,
        };
        [first, self.farthest(site, self.corners(site).filter(behind))]
    }
}

/// The item that comes first by `sign` (negative: the one before the other), the lower one where they are equal.
fn first_by(items: impl Iterator<Item = i32>, sign: impl Fn(i32, i32) -> f64) -> i32 {
    let better = |best: i32, item: i32| {
        let sign = if item == best { 1.0 } else { sign(item, best) };
        if sign < 0.0 || (sign == 0.0 && item < best) { item } else { best }
    };
    items.reduce(better).unwrap_or(-1)
}

/// For every site of the hull the sum of the outward unit normals of its two hull edges.
fn outward(view: DiagramView<'_>, sites: &[Point]) -> Vec<Option<Point>> {
    let mut sums: Vec<Option<Point>> = vec![None; sites.len()];
    for (&ends, duals) in view.edges.iter().zip(view.dual_edges) {
        let [p, q] = match duals {
            [_, -1] => ends,
            [-1, _] => [ends[1], ends[0]],
            _ => continue,
        };
        // The outside lies on the left of pq.
        let (a, b) = (sites[p as usize], sites[q as usize]);
        let length = libm::hypot(b[0] - a[0], b[1] - a[1]);
        let normal = [(a[1] - b[1]) / length, (b[0] - a[0]) / length];
        for end in [p, q] {
            let sum = sums[end as usize].get_or_insert([0.0; 2]);
            *sum = [sum[0] + normal[0], sum[1] + normal[1]];
        }
    }
    sums
}
