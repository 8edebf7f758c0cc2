//! Points inside a disc, found by walking from Voronoi cell to Voronoi cell.
//!
//! The cells that meet a disc hang together through the Voronoi edges that meet it, and every vertex inside belongs to
//! one of them, so nothing but the diagram itself is needed. Nearly all discs meet two to four cells.

use std::borrow::Cow;
use std::ops::ControlFlow::{self, Break, Continue};

use super::disc::{Disc, Place};
use super::doors::{Doors, Few, Many, Noted};
use super::far::{FAR, near};
use super::links::{NONE, after, before, side};
use crate::diagram::DiagramView;
use crate::diagram::scale::{Scale, largest};
use crate::graph::Point;

/// What a walk found.
pub(super) enum Found {
    Nothing,
    Inside(Point),
    /// It gave up.
    TooMany,
}

impl Found {
    /// The point inside, if any; None when it gave up.
    pub(super) fn known(self) -> Option<Option<Point>> {
        match self {
            Self::Nothing => Some(None),
            Self::Inside(v) => Some(Some(v)),
            Self::TooMany => None,
        }
    }
}

/// Sites and Voronoi vertices near 1, and the links between triangles.
pub(super) struct Cells<'a> {
    pub(super) view: DiagramView<'a>,
    pub(super) sites: Cow<'a, [Point]>,
    pub(super) vertices: Cow<'a, [Point]>,
    links: &'a [u32],
    /// Whether no vertex had to be moved: only then are cells convex.
    convex: bool,
}

impl<'a> Cells<'a> {
    /// `links` are [those](super::links()) of the diagram.
    pub(super) fn of(view: DiagramView<'a>, links: &'a [u32]) -> Self {
        let scale = Scale::of(largest(view.sites));
        let farthest = largest(view.vertices);
        let (sites, vertices) = if scale.is_one() && farthest < 1e30 {
            (Cow::Borrowed(view.sites), Cow::Borrowed(view.vertices))
        } else {
            (scale.all_down(view.sites), view.vertices.iter().map(|&v| near(scale.down(v))).collect())
        };
        let convex = farthest < f64::MAX && scale.down([farthest; 2])[0] <= FAR;
        Self { view, sites, vertices, links, convex }
    }

    /// The first vertex or site met for which `inside` holds, on a walk through the cells that `disc` meets; the cells
    /// of the two sites of edge `k` must be among them. Neither these sites nor the ends of its dual are looked at.
    ///
    /// Gives up after `MOST` cells, or eight times as many vertices: a cell with very many neighbours, asked about by
    /// each of them, would make the whole quadratic. Gives up at once where vertices had to be moved.
    #[inline]
    pub(super) fn find<const MOST: usize>(&self, k: usize, disc: Disc, inside: impl Fn(Point) -> bool) -> Found {
        self.walk(k, disc, inside, Few::<MOST>::default(), MOST)
    }

    /// The same for walks among `most` cells, where these are many.
    pub(super) fn find_far(
        &self,
        k: usize,
        disc: Disc,
        inside: impl Fn(Point) -> bool,
        (doors, most): (&mut Many, usize),
    ) -> Found {
        self.walk(k, disc, inside, doors.emptied(most), most)
    }

    /// What long walks note their doors in.
    pub(super) fn doors(&self) -> Many {
        Many::of(self.links.len())
    }

    #[inline]
    fn walk(&self, k: usize, disc: Disc, inside: impl Fn(Point) -> bool, doors: impl Doors, most: usize) -> Found {
        if !self.convex {
            return Found::TooMany;
        }
        let (ends, [right, left]) = (self.view.edges[k], self.view.dual_edges[k]);
        let Some(first) = side(self.view, left, ends[0]).or_else(|| side(self.view, right, ends[1])) else {
            return Found::Nothing;
        };
        // Where there is no triangle across, the other end begins the next side.
        let second = Some(self.across(first)).filter(|&side| side != NONE).unwrap_or(after(first));
        let mut walk = Walk { cells: self, disc, inside, ends, own: [right, left], doors, left: 8 * most };
        [first, second].into_iter().for_each(|side| _ = walk.doors.note(self.origin(side), side));
        let mut next = 0;
        while let Some(side) = walk.doors.at(next) {
            if let Break(found) = walk.ring(side) {
                return found;
            }
            next += 1;
        }
        Found::Nothing
    }

    /// The site that a side begins at.
    #[inline]
    fn origin(&self, side: u32) -> i32 {
        self.view.triangles.as_flattened()[side as usize]
    }

    /// The side across, or [`NONE`].
    #[inline]
    fn across(&self, side: u32) -> u32 {
        self.links.get(side as usize).copied().unwrap_or(NONE)
    }

    #[inline]
    fn vertex(&self, side: u32) -> Point {
        self.vertices[side as usize / 3]
    }
}

struct Walk<'w, D, F> {
    cells: &'w Cells<'w>,
    disc: Disc,
    inside: F,
    /// The two sites and the two triangles of the edge.
    ends: [i32; 2],
    own: [i32; 2],
    /// Through which the cells that the disc meets are entered.
    doors: D,
    /// Vertices that may still be looked at.
    left: usize,
}

impl<D: Doors, F: Fn(Point) -> bool> Walk<'_, D, F> {
    /// About the cell of the site that a side begins at, entered through the dual of that side: from both ends of it
    /// until what lies between the two is clear of the disc, as a cell is convex.
    fn ring(&mut self, start: u32) -> ControlFlow<Found> {
        let cells = self.cells;
        let beside = cells.across(start);
        if beside == NONE || cells.across(before(start)) == NONE {
            return self.open(start);
        }
        let (mut left, mut right) = (start, after(beside));
        let [mut from, mut to] = [left, right].map(|side| self.disc.place(self.cells.vertex(side)));
        loop {
            let counterclockwise = from.square <= to.square;
            let across = cells.across(if counterclockwise { before(left) } else { right });
            if across == NONE {
                return if counterclockwise {
                    self.counterclockwise(from, left)?;
                    self.clockwise(to, right)
                } else {
                    self.clockwise(to, right)?;
                    self.counterclockwise(from, left)
                };
            }
            if counterclockwise {
                let back = before(left);
                if across == right {
                    return if self.disc.meets_segment(from, to) { self.enter(back) } else { Continue(()) };
                }
                from = self.step(from, across, back)?;
                left = across;
            } else {
                right = after(across);
                if right == left {
                    return if self.disc.meets_segment(from, to) { self.enter(across) } else { Continue(()) };
                }
                to = self.step(to, right, across)?;
            }
            if self.disc.is_clear_of(from, to) {
                return Continue(());
            }
        }
    }

    /// About a cell of the hull, both ways from a triangle.
    fn open(&mut self, start: u32) -> ControlFlow<Found> {
        let at = self.disc.place(self.cells.vertex(start));
        self.counterclockwise(at, start)?;
        self.clockwise(at, start)
    }

    fn counterclockwise(&mut self, mut at: Place, mut side: u32) -> ControlFlow<Found> {
        loop {
            let back = before(side);
            side = self.cells.across(back);
            if side == NONE {
                return self.ray(at, back, back);
            }
            at = self.step(at, side, back)?;
        }
    }

    fn clockwise(&mut self, mut at: Place, mut side: u32) -> ControlFlow<Found> {
        loop {
            let across = self.cells.across(side);
            if across == NONE {
                return self.ray(at, side, after(side));
            }
            side = after(across);
            at = self.step(at, side, across)?;
        }
    }

    /// From one vertex of the cell to the one of the triangle of `side`; `across` begins at the site beyond.
    // Left to itself the compiler calls it, which costs a tenth of all.
    #[inline(always)]
    fn step(&mut self, at: Place, side: u32, across: u32) -> ControlFlow<Found, Place> {
        let triangle = side / 3;
        let vertex = self.cells.vertices[triangle as usize];
        let next = self.disc.place(vertex);
        if self.disc.holds(next) && !self.own.contains(&(triangle as i32)) && (self.inside)(vertex) {
            return Break(Found::Inside(vertex));
        }
        self.left -= 1;
        if self.left == 0 {
            return Break(Found::TooMany);
        }
        if self.disc.meets_segment(at, next) {
            self.enter(across)?;
        }
        Continue(next)
    }

    /// The dual of a side of the hull, a ray to the right of it; `across` begins at the site beyond.
    #[cold]
    fn ray(&mut self, at: Place, hull: u32, across: u32) -> ControlFlow<Found> {
        let [p, q] = [hull, after(hull)].map(|side| self.cells.sites[self.cells.origin(side) as usize]);
        if self.disc.meets_ray(at, [q[1] - p[1], p[0] - q[0]]) { self.enter(across) } else { Continue(()) }
    }

    /// Makes a note of the cell of the site that a side begins at, to be entered through the dual of that side.
    ///
    /// A cell may be entered through several: a disc that only touches one of them may reach into the cell through
    /// another, and a walk from the first is then over before it comes there.
    fn enter(&mut self, side: u32) -> ControlFlow<Found> {
        let site = self.cells.origin(side);
        match self.doors.note(site, side) {
            Noted::Known => Continue(()),
            Noted::TooMany => Break(Found::TooMany),
            Noted::Door => Continue(()),
            Noted::Cell => {
                let position = self.cells.sites[site as usize];
                let found = !self.ends.contains(&site) && (self.inside)(position);
                if found { Break(Found::Inside(position)) } else { Continue(()) }
            }
        }
    }
}
