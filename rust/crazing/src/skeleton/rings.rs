//! The lines of a crust as rings, which have an inside, an arc length, and noise.

use super::cost::distance;
use super::gaps::{self, Bridge, Closed};
use crate::diagram::scale::{Scale, largest};
use crate::diagram::{DiagramView, depths};
use crate::error::{Error, Result};
use crate::graph::{Point, Polylines, polylines};
use crate::incidence::Incidence;
use crate::parallel;
use crate::watch::Watch;

/// A line of sites; the last is joined to the first when it is closed.
#[derive(Debug, Clone, Default)]
pub(super) struct Line {
    pub(super) sites: Vec<u32>,
    pub(super) closed: bool,
}

/// Where a site stands: on which line, and at which of its sites; line -1 for a site on none.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stand {
    pub(super) line: i32,
    pub(super) place: u32,
}

/// The lines of a crust. Under noise a line may miss an edge or lose a few samples: gaps of a few steps are closed, and
/// sites beside a line stand where the nearest of it does; see the file `gaps.rs`.
#[derive(Debug)]
pub struct Rings<'a> {
    pub(super) view: DiagramView<'a>,
    pub(super) scale: Scale,
    /// The sites at a scale near 1.
    pub(super) sites: Vec<Point>,
    pub(super) lines: Vec<Line>,
    pub(super) stands: Vec<Stand>,
    /// How far along its line each of its sites stands, and at last its length.
    pub(super) along: Vec<Vec<f64>>,
    /// Edges that part inside from outside.
    pub(super) wall: Vec<bool>,
}

impl<'a> Rings<'a> {
    /// The rings and lines of the masked edges.
    ///
    /// # Errors
    /// [`Error::BadLength`], [`Error::Interrupted`].
    pub fn of(view: DiagramView<'a>, mask: &[bool], watch: Watch<'_>) -> Result<Self> {
        Self::read(view, mask, true, watch)
    }

    fn read(view: DiagramView<'a>, mask: &[bool], may_splinter: bool, watch: Watch<'_>) -> Result<Self> {
        fits("mask", mask, view)?;
        let scale = Scale::of(largest(view.sites));
        let sites: Vec<Point> = view.sites.iter().map(|&p| scale.down(p)).collect();
        let kept: Vec<[i32; 2]> = view.edges.iter().zip(mask).filter(|(_, kept)| **kept).map(|(&e, _)| e).collect();
        let lines = opened(&polylines(sites.len(), &kept, watch)?);
        if let Some(stands) = gaps::whole(sites.len(), &lines, may_splinter) {
            let along = lines.iter().map(|line| travelled(line, &sites)).collect();
            return Ok(Self { view, scale, sites, lines, stands, along, wall: mask.to_vec() });
        }
        let about = Incidence::of(sites.len(), view.edges);
        let Closed { lines, stands, bridges } = gaps::closed(view, &sites, &about, lines, watch)?;
        let along = lines.iter().map(|line| travelled(line, &sites)).collect();
        let mut rings = Self { view, scale, sites, lines, stands, along, wall: Vec::new() };
        rings.wall = rings.walls(mask, &about, &bridges);
        Ok(rings)
    }

    /// The rings, and [`Rings::inside`] of them: looked for meanwhile as if no line had a gap, and again if one has.
    ///
    /// `are_known` says that the rings were given and not found: then a small one near a long one is a hole or an
    /// island, and no splinter of noise.
    ///
    /// # Errors
    /// [`Error::BadLength`], [`Error::Interrupted`].
    pub fn with_inside(
        view: DiagramView<'a>,
        mask: &[bool],
        are_known: bool,
        watch: Watch<'_>,
    ) -> Result<(Self, Vec<bool>)> {
        fits("mask", mask, view)?;
        let read = || Self::read(view, mask, !are_known, watch);
        let (rings, inside) = parallel::join(view.edges.len(), read, || inside(view, mask, watch));
        let rings = rings?;
        let inside = if rings.wall == mask { inside? } else { rings.inside(watch)? };
        Ok((rings, inside))
    }

    /// The masked edges along the closed lines, and the bridges over their gaps.
    fn walls(&self, mask: &[bool], about: &Incidence, bridges: &[Bridge]) -> Vec<bool> {
        let mut wall = vec![false; self.view.edges.len()];
        for line in self.lines.iter().filter(|line| line.closed) {
            for (i, &a) in line.sites.iter().enumerate() {
                let b = line.sites[(i + 1) % line.sites.len()] as i32;
                let step = about.at(a as usize).iter().find(|&&k| self.view.edges[k as usize].contains(&b));
                if let Some(&k) = step.filter(|&&k| mask[k as usize]) {
                    wall[k as usize] = true;
                }
            }
        }
        // What is passed twice is no wall: every site keeps an even number of them.
        let over = bridges.iter().filter(|bridge| self.is_closed(self.stands[bridge.from as usize].line));
        over.flat_map(|bridge| &bridge.edges).for_each(|&k| wall[k as usize] ^= true);
        wall
    }

    /// Refuses a mask that is not of the edges.
    pub(super) fn check(&self, array: &'static str, mask: &[bool]) -> Result<()> {
        fits(array, mask, self.view)
    }

    /// A vertex of the diagram at the scale of the sites.
    pub(super) fn vertex(&self, v: usize) -> Point {
        self.scale.down(self.view.vertices[v])
    }

    fn is_closed(&self, line: i32) -> bool {
        line != -1 && self.lines[line as usize].closed
    }

    /// Whether each dual edge lies inside the rings: both its ends are in triangles that an odd number of rings parts
    /// from infinity, and no ring passes between them. Open lines do not count.
    ///
    /// # Errors
    /// [`Error::Interrupted`].
    pub fn inside(&self, watch: Watch<'_>) -> Result<Vec<bool>> {
        inside(self.view, &self.wall, watch)
    }

    /// Whether a ring passes between the two ends of each dual edge: by a masked edge, or over a gap.
    pub fn walls_between(&self) -> &[bool] {
        &self.wall
    }

    /// Arc residual of every dual edge: the shorter way along the line between its two sites, as a part of the length
    /// of that line; infinite between two lines.
    ///
    /// On a closed ring it never decreases from a tip of the axis towards its middle.
    ///
    /// # Source
    /// Ogniewicz, Kübler: Hierarchic Voronoi Skeletons (1995).
    pub fn residuals(&self) -> Vec<f64> {
        let edges = self.view.edges;
        parallel::map(edges.len(), |k| self.residual(edges[k][0] as usize, edges[k][1] as usize))
    }

    /// Length of the shorter way between the two sites of every dual edge, which spans `residuals` of its line.
    pub fn arcs(&self, residuals: &[f64]) -> Vec<f64> {
        let whole = |along: &Vec<f64>| self.scale.up([along[along.len() - 1], 0.0])[0];
        let lengths: Vec<f64> = self.along.iter().map(whole).collect();
        let edges = self.view.edges;
        parallel::map(edges.len().min(residuals.len()), |k| {
            let length = lengths.get(self.stands[edges[k][0] as usize].line as usize);
            length.map_or(f64::INFINITY, |length| residuals[k] * length)
        })
    }

    pub(super) fn residual(&self, p: usize, q: usize) -> f64 {
        let (a, b) = (self.stands[p], self.stands[q]);
        if a.line != b.line || a.line == -1 {
            return f64::INFINITY;
        }
        let along = &self.along[a.line as usize];
        let length = along[along.len() - 1];
        let way = ((along[b.place as usize] - along[a.place as usize]) / length).abs();
        if self.lines[a.line as usize].closed { way.min(1.0 - way) } else { way }
    }
}

/// Which edges join a site to the next one of its ring, where sites are numbered ring after ring from each of `starts`
/// to the next.
///
/// # Errors
/// [`Error::BadLength`] where the rings are not all sites.
pub fn ring_edges(view: DiagramView<'_>, starts: &[i64]) -> Result<Vec<bool>> {
    let wanted = view.sites.len();
    let mut next: Vec<i32> = (1..=wanted as i32).collect();
    let mut end = 0;
    for pair in starts.windows(2) {
        let (first, last) = (pair[0], pair[1].saturating_sub(1));
        if first != end || last < first || last >= wanted as i64 {
            break;
        }
        next[last as usize] = first as i32;
        end = last + 1;
    }
    if end != wanted as i64 {
        return Err(Error::BadLength { array: "rings", found: end as usize, wanted });
    }
    let follows = |a: i32, b: i32| next[a as usize] == b;
    Ok(parallel::map(view.edges.len(), |k| {
        let [a, b] = view.edges[k];
        follows(a, b) | follows(b, a)
    }))
}

/// Whether both ends of each dual edge are in triangles that an odd number of walls parts from infinity, and it is none.
fn inside(view: DiagramView<'_>, wall: &[bool], watch: Watch<'_>) -> Result<Vec<bool>> {
    let depth = depths(view, wall, watch)?;
    let is_inner = |t: i32| t != -1 && depth[t as usize] % 2 == 1;
    let duals = view.dual_edges.iter().zip(wall);
    Ok(duals.map(|(dual, wall)| !wall && dual.iter().all(|&t| is_inner(t))).collect())
}

fn fits(array: &'static str, mask: &[bool], view: DiagramView<'_>) -> Result<()> {
    let (found, wanted) = (mask.len(), view.edges.len());
    if found == wanted { Ok(()) } else { Err(Error::BadLength { array, found, wanted }) }
}

/// The lines, rings without their first site again. What has fewer than three sites is no ring.
fn opened(lines: &Polylines) -> Vec<Line> {
    let each = lines.offsets.windows(2).map(|ends| &lines.rows[ends[0] as usize..ends[1] as usize]);
    let open = |line: &[i32]| {
        let closed = line.len() > 3 && line.first() == line.last();
        let sites = &line[..line.len() - usize::from(closed)];
        Line { sites: sites.iter().map(|&site| site as u32).collect(), closed }
    };
    each.map(open).collect()
}

/// Distances from the first site along a line, and its length at last.
fn travelled(line: &Line, sites: &[Point]) -> Vec<f64> {
    let place = |i: usize| sites[line.sites[i % line.sites.len()] as usize];
    let steps = line.sites.len() - usize::from(!line.closed);
    let mut along = vec![0.0; line.sites.len()];
    let mut sum = 0.0;
    for i in 0..steps {
        sum += distance(place(i), place(i + 1));
        if i + 1 < along.len() {
            along[i + 1] = sum;
        }
    }
    along.push(sum);
    along
}
