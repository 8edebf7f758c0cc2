//! A way through the cells of a maze in a region, as a line that meets no wall.

use super::Region;
use super::cells::turned;
use super::chains::{Chain, Chains, beyond};
use crate::clip::Ways;
use crate::diagram::{ConstrainedDiagram, Diagram, DiagramView, constrained};
use crate::error::{Error, Result};
use crate::graph::{Point, check_indices};
use crate::incidence::Incidence;
use crate::predicates::nearer_sign;
use crate::watch::Watch;

/// The line through cells, given by their `sites`, and the `doors` between them: the row of each and the number of its
/// piece. At its ends it starts or stops on the outline (number of a side and part of it), or in the cell where that is
/// None.
///
/// In a cell without outline the line goes by the site; in others from triangle to triangle of the part.
///
/// # Errors
/// [`Error::BadIndex`], [`Error::BadLength`], [`Error::BadValue`], [`Error::Interrupted`].
pub fn route(
    view: DiagramView<'_>,
    region: &Region,
    sites: &[i32],
    doors: &[[i32; 2]],
    ends: [Option<f64>; 2],
    watch: Watch<'_>,
) -> Result<Vec<Point>> {
    if doors.len() + 1 != sites.len() {
        return Err(Error::BadLength { array: "doors", found: doors.len(), wanted: sites.len().saturating_sub(1) });
    }
    let rows: Vec<[i32; 1]> = doors.iter().map(|door| [door[0]]).collect();
    check_indices("doors", &rows, 0, view.edges.len())?;
    check_indices("sites", &sites.iter().map(|&site| [site]).collect::<Vec<_>>(), 0, view.sites.len())?;
    let chains = Chains::of(view, region, watch)?;
    let plan = Plan { view, region, ways: Ways::of(view, beyond(region)), islands: islands(region, &chains), chains };
    let about = about(view, sites);
    let mut line = Vec::new();
    for (i, &site) in sites.iter().enumerate() {
        watch.poll_at(i)?;
        let start = about.partition_point(|entry| entry.0 < site as u32);
        let rows = &about[start..start + about[start..].partition_point(|entry| entry.0 == site as u32)];
        let room = plan.room(site as u32, rows);
        let before = if i == 0 { plan.gap(&room, ends[0]) } else { plan.door(site, doors[i - 1]) };
        let after = if i + 1 == sites.len() { plan.gap(&room, ends[1]) } else { plan.door(site, doors[i]) };
        line.extend(before.filter(|_| i == 0).map(|stop| stop.middle));
        if room.walls.is_empty() {
            line.push(view.sites[site as usize]);
        } else {
            line.extend(room.through(before, after, view.sites[site as usize], watch)?);
        }
        line.extend(after.map(|stop| stop.middle));
    }
    Ok(line)
}

/// The rows about each of the sites.
fn about(view: DiagramView<'_>, sites: &[i32]) -> Vec<(u32, u32)> {
    let mut wanted = vec![false; view.sites.len()];
    sites.iter().for_each(|&site| wanted[site as usize] = true);
    let mut found = Vec::new();
    for (k, ends) in view.edges.iter().enumerate() {
        found.extend(ends.iter().filter(|&&site| wanted[site as usize]).map(|&site| (site as u32, k as u32)));
    }
    found.sort_unstable();
    found
}

/// Rings that no dual edge crosses.
fn islands(region: &Region, chains: &Chains) -> Vec<usize> {
    let ring = |side: u32| region.rings.partition_point(|&start| start <= side as usize) - 1;
    let mut crossed = vec![false; region.rings.len().saturating_sub(1)];
    chains.crossings.iter().for_each(|crossing| crossed[ring(crossing.side)] = true);
    (0..crossed.len()).filter(|&ring| !crossed[ring]).collect()
}

struct Plan<'a> {
    view: DiagramView<'a>,
    region: &'a Region,
    ways: Ways<'a>,
    chains: Chains,
    islands: Vec<usize>,
}

/// A place on a wall of a room: the piece of wall, the cell on its left, and where the line passes.
#[derive(Debug, Clone, Copy)]
struct Stop {
    ends: [Point; 2],
    middle: Point,
}

/// A cell with the outline in it.
#[derive(Default)]
struct Room {
    /// Empty when no outline is in it.
    walls: Vec<[Point; 2]>,
    /// Of each wall that is a piece of the outline: its side, and from which part of it to which.
    outline: Vec<(usize, u32, [f64; 2])>,
}

impl Plan<'_> {
    fn door(&self, site: i32, [row, number]: [i32; 2]) -> Option<Stop> {
        let [p, q] = match self.chains.cut(row as u32) {
            Some(cut) => self.chains.pieces(cut).find(|piece| piece.door == Some(number))?.ends,
            None => self.ways.cut(row as usize)?,
        };
        let ends = if self.view.edges[row as usize][0] == site { [p, q] } else { [q, p] };
        Some(Stop { ends, middle: [0, 1].map(|i| f64::midpoint(p[i], q[i])) })
    }

    fn gap(&self, room: &Room, at: Option<f64>) -> Option<Stop> {
        let at = at?;
        let (side, part) = (at.floor(), at - at.floor());
        let on = |piece: &&(usize, u32, [f64; 2])| {
            let &&(_, own, [from, to]) = piece;
            f64::from(own) == side && from <= part && part <= to
        };
        let &(wall, side, _) = room.outline.iter().find(on)?;
        let [u, v] = self.region.sides[side as usize];
        Some(Stop { ends: room.walls[wall], middle: super::on_way(u, v, part) })
    }

    /// The walls of a cell, if the outline is in it.
    fn room(&self, site: u32, rows: &[(u32, u32)]) -> Room {
        let chains = &self.chains.chains;
        let start = chains.partition_point(|chain| chain.site < site);
        let own = &chains[start..start + chains[start..].partition_point(|chain| chain.site == site)];
        let mut room = Room::default();
        own.iter().for_each(|chain| self.follow(chain, &mut room));
        for &ring in self.islands.iter().filter(|&&ring| self.holds(site, rows, ring)) {
            let sides = self.region.rings[ring]..self.region.rings[ring + 1];
            sides.for_each(|side| room.push_outline(self.region.sides[side], side as u32, [0.0, 1.0]));
        }
        if room.walls.is_empty() {
            return room;
        }
        for row in turned(self.view, site, rows) {
            let places: Vec<Point> = match self.chains.cut(row) {
                Some(cut) => {
                    let cut = &self.chains.cuts[cut];
                    let between = cut.crossings.clone().map(|crossing| self.chains.place(crossing as u32));
                    std::iter::once(cut.way[0]).chain(between).chain([cut.way[1]]).collect()
                }
                None => self.ways.cut(row as usize).map_or(Vec::new(), |way| way.to_vec()),
            };
            room.walls.extend(places.windows(2).map(|pair| [pair[0], pair[1]]));
        }
        room
    }

    /// The sides of a chain, cut at its ends.
    fn follow(&self, chain: &Chain, room: &mut Room) {
        let [from, to] = [chain.from, chain.to].map(|crossing| self.chains.crossings[crossing as usize]);
        let [start, end] = [chain.from, chain.to].map(|crossing| self.chains.place(crossing));
        let rings = &self.region.rings;
        let ring = rings.partition_point(|&first| first <= from.side as usize);
        let (low, high) = (rings[ring - 1] as u32, rings[ring] as u32);
        let (mut side, mut at, mut part) = (from.side, start, from.at);
        let is_here = |side: u32, part: f64| side == to.side && part <= to.at;
        // At most once about the ring.
        for _ in low..=high {
            if is_here(side, part) {
                break;
            }
            let corner = self.region.sides[side as usize][1];
            room.push_outline([at, corner], side, [part, 1.0]);
            side = if side + 1 == high { low } else { side + 1 };
            (at, part) = (corner, 0.0);
        }
        room.push_outline([at, end], side, [part, to.at]);
    }

    /// Whether a ring lies in the cell of a site: its first corner is nearer to it than to its neighbours.
    fn holds(&self, site: u32, rows: &[(u32, u32)], ring: usize) -> bool {
        let corner = self.region.sides[self.region.rings[ring]][0];
        let place = |site: i32| self.view.sites[site as usize];
        rows.iter().all(|&(_, row)| {
            let [a, b] = self.view.edges[row as usize];
            let other = if a == site as i32 { b } else { a };
            nearer_sign(corner, place(site as i32), place(other)) <= 0.0
        })
    }
}

impl Room {
    fn push_outline(&mut self, ends: [Point; 2], side: u32, parts: [f64; 2]) {
        self.outline.push((self.walls.len(), side, parts));
        self.walls.push(ends);
    }

    /// Points between two stops, without these. Where there is none, the line ends in the widest triangle it can reach.
    fn through(&self, before: Option<Stop>, after: Option<Stop>, site: Point, watch: Watch<'_>) -> Result<Vec<Point>> {
        let points: Vec<Point> = self.walls.iter().flatten().copied().collect();
        let floor = match constrained(&points, &distinct(&self.walls), watch) {
            Ok(found) => Floor::of(found),
            // Walls nearer together than numbers can tell: the straight way is as good as any.
            Err(Error::Crossing { .. }) => return Ok(Vec::new()),
            Err(other) => return Err(other),
        };
        let triangle = |stop: Option<Stop>| stop.and_then(|stop| floor.beside(stop.ends));
        Ok(match (triangle(before), triangle(after)) {
            (Some(from), Some(to)) => floor.middles(from, to),
            (Some(from), None) => {
                let to = floor.widest(from);
                floor.middles(from, to).into_iter().chain([floor.centre(to)]).collect()
            }
            (None, Some(to)) => {
                let from = floor.widest(to);
                std::iter::once(floor.centre(from)).chain(floor.middles(from, to)).collect()
            }
            (None, None) => vec![site],
        })
    }
}

/// Rows of the walls that have a length, each once.
fn distinct(walls: &[[Point; 2]]) -> Vec<[i32; 2]> {
    let key = |i: usize| if walls[i][0] < walls[i][1] { walls[i] } else { [walls[i][1], walls[i][0]] };
    let mut rows: Vec<usize> = (0..walls.len()).filter(|&i| walls[i][0] != walls[i][1]).collect();
    rows.sort_by(|&a, &b| key(a).partial_cmp(&key(b)).unwrap_or(std::cmp::Ordering::Equal));
    rows.dedup_by(|a, b| key(*a) == key(*b));
    rows.into_iter().map(|i| [2 * i as i32, 2 * i as i32 + 1]).collect()
}

/// The triangles of a cell and its walls.
struct Floor {
    diagram: Diagram,
    wall: Vec<bool>,
    /// The edges of every triangle.
    around: Incidence,
}

impl Floor {
    fn of(ConstrainedDiagram { diagram, constrained }: ConstrainedDiagram) -> Self {
        let around = Incidence::of(diagram.triangles.len(), &diagram.dual_edges);
        Self { diagram, wall: constrained, around }
    }

    /// The triangle on the left of a wall.
    fn beside(&self, ends: [Point; 2]) -> Option<usize> {
        let place = |site: i32| self.diagram.sites[site as usize];
        let found = self.diagram.edges.iter().enumerate().find_map(|(k, edge)| {
            let [a, b] = edge.map(place);
            let [right, left] = self.diagram.dual_edges[k];
            if [a, b] == ends { Some(left) } else { ([b, a] == ends).then_some(right) }
        });
        usize::try_from(found?).ok()
    }

    /// Triangles that can be reached from one, each with the edge by which it is.
    fn reached(&self, from: usize) -> Vec<(usize, usize)> {
        let mut seen = vec![false; self.diagram.triangles.len()];
        seen[from] = true;
        let mut queue = vec![(from, usize::MAX)];
        let mut next = 0;
        while let Some(&(t, _)) = queue.get(next) {
            next += 1;
            for &k in self.around.at(t).iter().filter(|&&k| !self.wall[k as usize]) {
                for &other in self.diagram.dual_edges[k as usize].iter().filter(|&&other| other != -1) {
                    if !std::mem::replace(&mut seen[other as usize], true) {
                        queue.push((other as usize, k as usize));
                    }
                }
            }
        }
        queue
    }

    fn corners(&self, t: usize) -> [Point; 3] {
        self.diagram.triangles[t].map(|site| self.diagram.sites[site as usize])
    }

    fn centre(&self, t: usize) -> Point {
        let [a, b, c] = self.corners(t);
        [0, 1].map(|i| (a[i] + b[i] + c[i]) / 3.0)
    }

    /// The largest of the triangles that can be reached from one.
    fn widest(&self, from: usize) -> usize {
        let area = |t: usize| {
            let [a, b, c] = self.corners(t);
            (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        };
        self.reached(from).into_iter().map(|(t, _)| t).max_by(|&a, &b| area(a).total_cmp(&area(b))).unwrap_or(from)
    }

    /// The middles of the edges on a shortest way from one triangle to another.
    fn middles(&self, from: usize, to: usize) -> Vec<Point> {
        let mut by = vec![usize::MAX; self.diagram.triangles.len()];
        self.reached(to).into_iter().for_each(|(t, k)| by[t] = k);
        let mut line = Vec::new();
        let mut at = from;
        while at != to && by[at] != usize::MAX {
            let k = by[at];
            let [p, q] = self.diagram.edges[k].map(|site| self.diagram.sites[site as usize]);
            line.push([0, 1].map(|i| f64::midpoint(p[i], q[i])));
            let [right, left] = self.diagram.dual_edges[k];
            at = if right == at as i32 { left } else { right } as usize;
        }
        line
    }
}
