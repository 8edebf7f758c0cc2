//! The copies that a first triangulation on a torus lacks, added to it.
//!
//! Where sites are few near the sides of the cell, circles about triangles reach over any narrow halo, and a wide one
//! would hold many times the sites. But only copies within these circles can change anything at the sites of the cell:
//! the centre of a circle about nothing, through a site, lies in the Voronoi cell of the site, and such a circle is
//! covered by those about the corners of that cell. So they are looked for, and few they are.

use super::delaunay::Growing;
use super::periodic::{Cell, Halo};
use super::torus::{Cover, Shift, circle, out_of};
use crate::error::Result;
use crate::graph::Point;
use crate::predicates::circumcentre;
use crate::watch::Watch;

/// A sample of so many times the root of the number of sites is copied all around first: it bounds every Voronoi cell,
/// and makes circles small that without it would hold large parts of the neighbouring copies.
const SAMPLE: f64 = 4.0;

/// The neighbours of the cell.
const AROUND: [Shift; 8] = [[-1, -1], [-1, 0], [-1, 1], [0, -1], [0, 1], [1, -1], [1, 0], [1, 1]];

impl Cover {
    /// Adds all copies beyond the halo that circles about triangles at sites of the cell hold.
    ///
    /// # Errors
    /// [`Error::Interrupted`](crate::Error::Interrupted), and those of the triangulation.
    pub(super) fn complete(&mut self, mesh: &mut Growing, cell: &Cell, halo: Halo, watch: Watch<'_>) -> Result<()> {
        let home: Vec<u32> = (0..self.at.len() as u32).filter(|&i| self.is_home(i as i32)).collect();
        let beyond = |i: u32, shift: Shift| {
            let p = self.at[i as usize];
            !(0..2).all(|axis| cell.is_within(p, axis, shift[axis], halo))
        };
        // Of every copy whether it is there already: a bit for each neighbour of the cell.
        let mut taken = vec![0_u8; self.at.len()];
        let mut copies = Vec::new();
        let mut take = |i: u32, side: usize, copies: &mut Vec<(u32, Shift)>| {
            if taken[i as usize] >> side & 1 == 0 && beyond(i, AROUND[side]) {
                taken[i as usize] |= 1 << side;
                copies.push((i, AROUND[side]));
            }
        };
        let count = (SAMPLE * (home.len() as f64).sqrt()) as usize + 1;
        for &i in mesh.sequence().iter().filter(|&&i| self.is_home(i as i32)).take(count) {
            (0..AROUND.len()).for_each(|side| take(i, side, &mut copies));
        }
        let mut grown = Copies { at: self.at.clone(), site: self.site.clone(), shift: self.shift.clone() };
        grown.add(mesh, &copies, cell, watch)?;
        copies.clear();
        let boxes = Boxes::of(&self.at, &home);
        for (step, (centre, radius)) in circles(mesh, &grown, cell, halo).into_iter().enumerate() {
            watch.poll_at(64 * step)?;
            for (side, shift) in AROUND.iter().enumerate() {
                let moved = cell.moved(centre, shift.map(|s| -s));
                boxes.within(&self.at, moved, radius, &mut |i| take(i, side, &mut copies));
            }
        }
        grown.add(mesh, &copies, cell, watch)?;
        (self.at, self.site, self.shift) = (grown.at, grown.site, grown.shift);
        Ok(())
    }
}

/// Positions, sites and shifts of a cover that grows.
struct Copies {
    at: Vec<Point>,
    site: Vec<i32>,
    shift: Vec<Shift>,
}

impl Copies {
    fn add(&mut self, mesh: &mut Growing, copies: &[(u32, Shift)], cell: &Cell, watch: Watch<'_>) -> Result<()> {
        let first = self.at.len();
        for &(i, shift) in copies {
            self.at.push(cell.moved(self.at[i as usize], shift));
            self.site.push(self.site[i as usize]);
            self.shift.push(shift);
        }
        mesh.add(&self.at[first..], watch)
    }
}

/// Centre and radius of the circles about triangles at sites of the cell that reach over the halo.
fn circles(mesh: &Growing, cover: &Copies, cell: &Cell, halo: Halo) -> Vec<(Point, f64)> {
    let mut found = Vec::new();
    for corners in mesh.triangles().filter(|corners| corners.iter().any(|&i| cover.shift[i as usize] == [0, 0])) {
        let [a, b, c] = corners.map(|i| cover.at[i as usize]);
        let centre = circumcentre(a, b, c);
        let radius = circle(centre, a);
        let out = out_of(cell.period, centre, radius);
        if !(radius.is_finite() && centre[0].is_finite() && centre[1].is_finite()) {
            found.push(([0.0; 2], f64::INFINITY));
        } else if out[0] > halo[0] || out[1] > halo[1] {
            // Moving the centre by a period rounds it.
            found.push((centre, radius + 8.0 * f64::EPSILON * cell.period[0].max(cell.period[1])));
        }
    }
    found
}

/// Points, or boxes, that one box holds.
const WIDTH: usize = 16;

/// Points along a Hilbert curve in boxes, these in larger ones, and so on.
struct Boxes<'a> {
    rows: &'a [u32],
    /// Lower and upper corner of every box, the smallest boxes first.
    levels: Vec<Vec<[Point; 2]>>,
}

impl<'a> Boxes<'a> {
    fn of(at: &[Point], rows: &'a [u32]) -> Self {
        let around = |corners: &mut dyn Iterator<Item = [Point; 2]>| {
            corners.fold([[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]], |[low, high], [p, q]| {
                [[low[0].min(p[0]), low[1].min(p[1])], [high[0].max(q[0]), high[1].max(q[1])]]
            })
        };
        let smallest =
            rows.chunks(WIDTH).map(|rows| around(&mut rows.iter().map(|&i| [at[i as usize]; 2]))).collect::<Vec<_>>();
        let mut levels = vec![smallest];
        while levels[levels.len() - 1].len() > 1 {
            let below = &levels[levels.len() - 1];
            levels.push(below.chunks(WIDTH).map(|boxes| around(&mut boxes.iter().copied())).collect());
        }
        Self { rows, levels }
    }

    /// Calls `found` with every row in a circle.
    fn within(&self, at: &[Point], centre: Point, radius: f64, found: &mut impl FnMut(u32)) {
        self.search(at, (centre, radius * radius), self.levels.len() - 1, 0, found);
    }

    fn search(&self, at: &[Point], circle: (Point, f64), level: usize, number: usize, found: &mut impl FnMut(u32)) {
        let ([x, y], square) = circle;
        let [low, high] = self.levels[level][number];
        let [dx, dy] = [x - x.clamp(low[0], high[0]), y - y.clamp(low[1], high[1])];
        if dx * dx + dy * dy > square {
            return;
        }
        let from = number * WIDTH;
        if level > 0 {
            let to = self.levels[level - 1].len().min(from + WIDTH);
            (from..to).for_each(|number| self.search(at, circle, level - 1, number, found));
            return;
        }
        for &row in &self.rows[from..self.rows.len().min(from + WIDTH)] {
            let p = at[row as usize];
            let [dx, dy] = [x - p[0], y - p[1]];
            if dx * dx + dy * dy <= square {
                found(row);
            }
        }
    }
}
