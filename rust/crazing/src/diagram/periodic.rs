//! Diagrams on a torus: sites with a halo of their copies in the plane, and what empty circles reach beyond it.
//!
//! Copies are exact. Sites and period are rounded to a unit of 2^-51 of the period, so that a site plus or minus a
//! period is a floating-point number, and every predicate has the same sign for all copies of its sites.
//!
//! One halo of a whole period is always enough, even about one site: a circle without a site inside that passes
//! through a site p has its centre within half a period of p along each axis (else it held the next copy of p), and if
//! it held any copy of a site it would hold the one nearest to its centre along each axis, which is among the 3 x 3.

use super::build::{check_points, merge};
use super::delaunay::{Growing, Topology};
use super::scale::Scale;
use super::torus::{Cover, Shift};
use super::{Diagram, ties};
use crate::error::{Error, Result};
use crate::graph::Point;
use crate::parallel;
use crate::predicates::circumcentre;
use crate::watch::Watch;

/// A diagram on a torus. Triangles and dual edges are as in the plane, without an outside.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct PeriodicDiagram {
    /// Sites and vertices lie in [0, w) x [0, h). Edges run from the lower site to the higher; those from a site to a
    /// copy of itself rightward, or up.
    pub diagram: Diagram,
    /// Periods that each edge crosses on its way from the first site to the second.
    pub shifts: Vec<[i8; 2]>,
    /// The same for each dual edge.
    pub dual_shifts: Vec<[i8; 2]>,
}

/// The sides of a torus may differ by this factor, so that exact arithmetic neither over- nor underflows.
const MOST_OBLONG: f64 = 4_294_967_296.0;

/// Copies in the first halo, in roots of the number of sites: of uniform sites a rim 6 spacings wide. Where an empty
/// circle reaches over it, what it may hold is added.
const RIM: f64 = 24.0;

/// The Delaunay triangulation and Voronoi diagram of `points` repeated with `period`.
///
/// Equal to the diagram of 3 x 3 copies, restricted to one. Where cocircular sites leave a choice, it is the same for
/// all copies. Coordinates are rounded to 2^-51 of the period for all decisions.
///
/// # Errors
/// [`Error::NotFinite`], [`Error::TooMany`], [`Error::BadValue`] for a period, [`Error::Interrupted`].
///
/// # Source
/// Caroli, Teillaud: Computing 3D Periodic Triangulations (ESA 2009), for copies; the bound on them is ours.
pub fn periodic(points: &[Point], period: Point, watch: Watch<'_>) -> Result<PeriodicDiagram> {
    check_points(points)?;
    let cell = Cell::of(period)?;
    let rows: Vec<Row> = points.iter().map(|&p| cell.row(p)).collect();
    if rows.is_empty() {
        return Ok(PeriodicDiagram::default());
    }
    let mut halo = first_halo(&rows, &cell);
    let (mut cover, mut mesh) = match cover(&rows, &cell, halo, watch)? {
        (cover, Some(mesh)) => (cover, mesh),
        // All on one line: copies on all sides are not.
        _ => {
            halo = cell.period;
            let (cover, mesh) = self::cover(&rows, &cell, halo, watch)?;
            (cover, mesh.ok_or(Error::Internal("copies all around on one line"))?)
        }
    };
    let is_full = halo == cell.period;
    // A site on the hull has no triangles all around it.
    let mut is_whole = is_full || !mesh.hull().any(|i| cover.is_home(i as i32));
    if is_whole {
        read(&mut cover, &mesh, watch)?;
        is_whole = is_full || !reaches(&cover, &cell, halo);
    }
    if !is_whole {
        cover.complete(&mut mesh, &cell, halo, watch)?;
        read(&mut cover, &mesh, watch)?;
    }
    drop(mesh);
    // Triangles of one polygon have one centre, so that of each is still its own.
    cover.coincident = ties::settle(&mut cover.topology, &cover.at, &cover.centres);
    cover.restrict(&rows, &cell)
}

/// A period, in the user's units and in those of exact work.
pub(super) struct Cell {
    pub(super) given: Point,
    pub(super) period: Point,
    unit: Point,
    pub(super) scale: Scale,
}

/// A point of the cell: as the user will see it, and as it decides.
#[derive(Clone, Copy)]
pub(super) struct Row {
    pub(super) given: Point,
    at: Point,
}

impl Cell {
    fn of(given: Point) -> Result<Self> {
        let names = ["the width of the period", "the height of the period"];
        for (name, value) in names.into_iter().zip(given) {
            if !(value.is_finite() && value > 0.0) {
                return Err(Error::BadValue { name, value, wanted: "a positive, finite number is wanted" });
            }
        }
        let (small, large) = (given[0].min(given[1]), given[0].max(given[1]));
        // A subnormal period has no 2^51 steps to be rounded to.
        if small < large / MOST_OBLONG
            || small < f64::MIN_POSITIVE * MOST_OBLONG * MOST_OBLONG
            || large > f64::MAX / 4.0
        {
            let wanted = "sides between 1e-288 and 4e307, neither 2^32 times the other, are wanted";
            return Err(Error::BadValue { name: "the smaller side of the period", value: small, wanted });
        }
        let scale = Scale::of(large);
        let scaled = scale.down(given);
        let unit = scaled.map(|side| libm::ldexp(1.0, libm::ilogb(side) - 51));
        let period = [0, 1].map(|i| (scaled[i] / unit[i]).round() * unit[i]);
        Ok(Self { given, period, unit, scale })
    }

    fn row(&self, p: Point) -> Row {
        let mut row = Row { given: p, at: p };
        let given = [0, 1].map(|i| wrapped(p[i], self.given[i]));
        let scaled = self.scale.down(given);
        for i in 0..2 {
            let at = rounded(scaled[i] / self.unit[i]) * self.unit[i];
            // What rounds to the far side is the near one.
            let inside = at < self.period[i];
            row.at[i] = if inside { at } else { 0.0 };
            row.given[i] = if inside { given[i] } else { 0.0 };
        }
        row
    }

    pub(super) fn moved(&self, p: Point, shift: Shift) -> Point {
        [0, 1].map(|i| p[i] + f64::from(shift[i]) * self.period[i])
    }

    /// Whether a point moved by `shift` along one axis lies in the halo or the cell.
    pub(super) fn is_within(&self, p: Point, axis: usize, shift: i8, halo: Halo) -> bool {
        match shift {
            0 => true,
            1 => p[axis] <= halo[axis],
            _ => p[axis] >= self.period[axis] - halo[axis],
        }
    }
}

/// `f64::round` of a number from 0 to 2^52, which many processors have no instruction for.
fn rounded(x: f64) -> f64 {
    let whole = x as u64 as f64;
    if x - whole >= 0.5 { whole + 1.0 } else { whole }
}

/// `x` moved by whole periods into [0, side).
fn wrapped(x: f64, side: f64) -> f64 {
    // The remainder is slow, and most points are inside already.
    let rest = if (0.0..side).contains(&x) { x } else { libm::fmod(x, side) };
    let positive = if rest < 0.0 { rest + side } else { rest };
    // Adding zero turns -0.0 into 0.0.
    if positive < side { positive + 0.0 } else { 0.0 }
}

/// How far from the cell copies are made, along each axis; at most a period.
pub(super) type Halo = Point;

fn first_halo(rows: &[Row], cell: &Cell) -> Halo {
    let copies = (RIM * (rows.len() as f64).sqrt()) as usize;
    if copies >= rows.len() {
        return cell.period;
    }
    let [w, h] = cell.period;
    let rim = |row: &Row| row.at[0].min(w - row.at[0]).min(row.at[1]).min(h - row.at[1]);
    let mut depths: Vec<f64> = rows.iter().map(rim).collect();
    let (_, &mut depth, _) = depths.select_nth_unstable_by(copies, f64::total_cmp);
    cell.period.map(|side| if depth < side / 2.0 { depth } else { side })
}

/// Points with their copies in the halo, triangulated unless all lie on one line.
fn cover(rows: &[Row], cell: &Cell, halo: Halo, watch: Watch<'_>) -> Result<(Cover, Option<Growing>)> {
    let (points, copies) = copies(rows, cell, halo);
    check_points(&points)?;
    let merged = merge(points);
    // Copies come after all points, so the sites of the cell are numbered first, as without copies.
    let mut origin = vec![(0, [0, 0]); merged.sites.len()];
    for row in 0..rows.len() {
        origin[merged.site_of[row] as usize] = (merged.site_of[row], [0, 0]);
    }
    for (i, &(row, shift)) in copies.iter().enumerate() {
        origin[merged.site_of[rows.len() + i] as usize] = (merged.site_of[row as usize], shift);
    }
    let (site, shift): (Vec<i32>, Vec<[i8; 2]>) = merged.curve.iter().map(|&i| origin[i as usize]).unzip();
    let mesh = Growing::of(&merged.along, watch)?;
    Ok((Cover { site_of: merged.site_of, at: merged.along, site, shift, ..Cover::default() }, mesh))
}

fn read(cover: &mut Cover, mesh: &Growing, watch: Watch<'_>) -> Result<()> {
    cover.topology = mesh.read(watch)?;
    cover.centres = centres(&cover.topology, &cover.at);
    Ok(())
}

fn centres(topology: &Topology, at: &[Point]) -> Vec<Point> {
    parallel::map(topology.triangles.len(), |t| {
        let [a, b, c] = topology.triangles[t].map(|corner| at[corner as usize]);
        circumcentre(a, b, c)
    })
}

/// All points, then the copies within the halo: of which row, and how many periods away.
fn copies(rows: &[Row], cell: &Cell, halo: Halo) -> (Vec<Point>, Vec<(u32, [i8; 2])>) {
    let mut points: Vec<Point> = Vec::with_capacity(rows.len() + rows.len() / 8);
    points.extend(rows.iter().map(|row| row.at));
    let mut copies = Vec::new();
    for (number, row) in rows.iter().enumerate() {
        if (0..2).all(|i| row.at[i] > halo[i] && row.at[i] < cell.period[i] - halo[i]) {
            continue;
        }
        for a in (-1..=1).filter(|&a| cell.is_within(row.at, 0, a, halo)) {
            for b in (-1..=1).filter(|&b| (a, b) != (0, 0) && cell.is_within(row.at, 1, b, halo)) {
                points.push(cell.moved(row.at, [a, b]));
                copies.push((number as u32, [a, b]));
            }
        }
    }
    (points, copies)
}

/// Whether a circle about a triangle at the cell reaches over the halo, where it may hold copies that are not there.
fn reaches(cover: &Cover, cell: &Cell, halo: Halo) -> bool {
    let reach = cover.reach(cell.period);
    (0..2).any(|i| reach[i] > halo[i] && halo[i] < cell.period[i])
}
