//! Diagrams on a torus: sites with a halo of their copies in the plane, as wide as the empty circles reach.
//!
//! Copies are exact. Sites and period are rounded to a unit of 2^-51 of the period, so that a site plus or minus a
//! period is a floating-point number, and every predicate has the same sign for all copies of its sites.
//!
//! One halo of a whole period is always enough, even about one site: a circle without a site inside that passes
//! through a site p has its centre within half a period of p along each axis (else it held the next copy of p), and if
//! it held any copy of a site it would hold the one nearest to its centre along each axis, which is among the 3 x 3.

use super::build::{check_points, merge};
use super::delaunay::{Topology, triangulate};
use super::scale::Scale;
use super::torus::Cover;
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
/// circle reaches over it, the halo grows.
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
    loop {
        let cover = cover(&rows, &cell, halo, watch)?;
        match wider(&cover, &cell, halo) {
            Some(more) => halo = more,
            None => return cover.restrict(&rows, &cell),
        }
    }
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
            let at = (scaled[i] / self.unit[i]).round() * self.unit[i];
            // What rounds to the far side is the near one.
            let inside = at < self.period[i];
            row.at[i] = if inside { at } else { 0.0 };
            row.given[i] = if inside { given[i] } else { 0.0 };
        }
        row
    }
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
type Halo = Point;

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

/// Points with their copies in the halo, triangulated.
fn cover(rows: &[Row], cell: &Cell, halo: Halo, watch: Watch<'_>) -> Result<Cover> {
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
    let mut topology = triangulate(&merged.along, watch)?;
    let centres = centres(&topology, &merged.along);
    // Triangles of one polygon have one centre, so that of each is still its own.
    ties::settle(&mut topology, &merged.along, &centres);
    Ok(Cover { site_of: merged.site_of, at: merged.along, site, shift, topology, centres })
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
    let within = |x: f64, i: usize, shift: i8| match shift {
        0 => true,
        1 => x <= halo[i],
        _ => x >= cell.period[i] - halo[i],
    };
    for (number, row) in rows.iter().enumerate() {
        for a in (-1..=1).filter(|&a| within(row.at[0], 0, a)) {
            for b in (-1..=1).filter(|&b| (a, b) != (0, 0) && within(row.at[1], 1, b)) {
                points.push([row.at[0] + f64::from(a) * cell.period[0], row.at[1] + f64::from(b) * cell.period[1]]);
                copies.push((number as u32, [a, b]));
            }
        }
    }
    (points, copies)
}

/// A halo that is wide enough, unless this one is: every circle about a triangle of the cell must lie in it. More
/// sites make empty circles smaller, never larger, so the second halo is the last.
fn wider(cover: &Cover, cell: &Cell, halo: Halo) -> Option<Halo> {
    let is_full = [0, 1].map(|i| halo[i] >= cell.period[i]);
    if is_full == [true; 2] {
        return None;
    }
    let reach = cover.reach(cell.period);
    let grown = [0, 1].map(|i| match 1.01 * reach[i] {
        _ if reach[i] <= halo[i] || is_full[i] => halo[i],
        more if more < cell.period[i] / 2.0 => more,
        _ => cell.period[i],
    });
    (grown != halo).then_some(grown)
}
