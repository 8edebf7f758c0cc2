//! What of each dual edge is inside, and through which cells the outline runs.

use super::{Crossing, Region, on_way};
use crate::clip::Ways;
use crate::diagram::DiagramView;
use crate::diagram::scale::largest;
use crate::error::{Error, Result};
use crate::graph::Point;
use crate::parallel;
use crate::watch::Watch;

/// A dual edge that the outline crosses: a way from the right of its edge to the left, the first site on its left.
pub(super) struct Cut {
    pub(super) row: u32,
    pub(super) way: [Point; 2],
    /// Whether the way starts inside.
    pub(super) inside: bool,
    /// Its crossings, in order, are those of these numbers.
    pub(super) crossings: std::ops::Range<usize>,
}

/// The outline in one cell, from one crossing to the next.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Chain {
    pub(super) site: u32,
    pub(super) from: u32,
    pub(super) to: u32,
}

/// Dual edges against the outline.
pub(super) struct Chains {
    /// For every row whether it is wholly inside; those the outline crosses are not.
    pub(super) inside: Vec<bool>,
    /// Rows that the outline crosses, ascending.
    pub(super) cuts: Vec<Cut>,
    pub(super) crossings: Vec<Crossing>,
    /// The cut of every crossing.
    pub(super) cut_of: Vec<u32>,
    /// By site.
    pub(super) chains: Vec<Chain>,
    /// Pieces along each axis no longer than this are no doors: rounding makes them where the outline touches a wall.
    least: f64,
}

/// Coordinates that can be multiplied.
const FARTHEST: f64 = 1e150;

/// The shortest door as a part of the extent of a region.
const LEAST: f64 = 1e-12;

/// What is known of a row at a glance.
#[derive(Clone, Copy, PartialEq)]
enum Glance {
    Outside,
    Inside,
    Near,
}

/// The bounds of a region, grown a little, so that ways cut there end outside.
pub(super) fn beyond(region: &Region) -> [f64; 4] {
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for [p, _] in &region.sides {
        low = [low[0].min(p[0]), low[1].min(p[1])];
        high = [high[0].max(p[0]), high[1].max(p[1])];
    }
    let room = [0, 1].map(|i| 0.01 * (high[i] - low[i]));
    [low[0] - room[0], low[1] - room[1], high[0] + room[0], high[1] + room[1]]
}

impl Chains {
    pub(super) fn of(view: DiagramView<'_>, region: &Region, watch: Watch<'_>) -> Result<Self> {
        let mut chains = Self {
            inside: Vec::new(),
            cuts: Vec::new(),
            crossings: Vec::new(),
            cut_of: Vec::new(),
            chains: Vec::new(),
            least: 0.0,
        };
        if region.sides.is_empty() {
            chains.inside = vec![false; view.edges.len()];
            return Ok(chains);
        }
        let value = largest(view.sites);
        if value >= FARTHEST {
            let wanted = "less than 1e150 is wanted beside a region";
            return Err(Error::BadValue { name: "the largest coordinate of a site", value, wanted });
        }
        let bounds = beyond(region);
        let size = bounds.iter().fold(bounds[2] - bounds[0], |size, x| size.max(x.abs()));
        chains.least = LEAST * size.max(bounds[3] - bounds[1]);
        let ways = Ways::of(view, bounds);
        let glances = parallel::map(view.edges.len(), |k| match ways.whole(k) {
            Some([p, q]) if p == q => Glance::Outside,
            Some([p, q]) => match region.grid.is_inside(p, q) {
                Some(true) => Glance::Inside,
                Some(false) => Glance::Outside,
                None => Glance::Near,
            },
            None => Glance::Near,
        });
        watch.poll()?;
        let near: Vec<u32> = (0..glances.len() as u32).filter(|&k| glances[k as usize] == Glance::Near).collect();
        chains.inside = glances.into_iter().map(|glance| glance == Glance::Inside).collect();
        let looks = parallel::map(near.len(), |i| look(region, &ways, near[i] as usize));
        for (row, (way, inside, crossings)) in near.into_iter().zip(looks) {
            watch.poll_at(row as usize)?;
            if crossings.is_empty() {
                chains.inside[row as usize] = inside;
                continue;
            }
            let first = chains.crossings.len();
            chains.cut_of.extend(std::iter::repeat_n(chains.cuts.len() as u32, crossings.len()));
            chains.crossings.extend(crossings);
            chains.cuts.push(Cut { row, way, inside, crossings: first..chains.crossings.len() });
        }
        chains.link(view, region);
        Ok(chains)
    }

    /// The sites that the outline goes from and to at a crossing.
    fn cells(&self, view: DiagramView<'_>, crossing: u32) -> [i32; 2] {
        let [left, right] = view.edges[self.cuts[self.cut_of[crossing as usize] as usize].row as usize];
        if self.crossings[crossing as usize].from_left { [left, right] } else { [right, left] }
    }

    /// Follows the outline from crossing to crossing. Of crossings that rounding has brought together, the one that
    /// leaves the cell the outline is in comes first.
    fn link(&mut self, view: DiagramView<'_>, region: &Region) {
        let mut order: Vec<u32> = (0..self.crossings.len() as u32).collect();
        let key = |i: u32| (self.crossings[i as usize].side, self.crossings[i as usize].at);
        order.sort_unstable_by(|&a, &b| {
            let ((side, at), (other, there)) = (key(a), key(b));
            side.cmp(&other).then(at.total_cmp(&there)).then(a.cmp(&b))
        });
        let ring = |i: u32| region.rings.partition_point(|&start| start <= self.crossings[i as usize].side as usize);
        let mut found = Vec::with_capacity(order.len());
        for along in order.chunk_by_mut(|&a, &b| ring(a) == ring(b)) {
            for i in 1..along.len() {
                let [_, now] = self.cells(view, along[i - 1]);
                let ahead = along[i..].iter().take(16).position(|&next| self.cells(view, next)[0] == now);
                if let Some(ahead) = ahead {
                    along[i..=i + ahead].rotate_right(1);
                }
            }
            for (i, &from) in along.iter().enumerate() {
                let to = along[(i + 1) % along.len()];
                let site = self.cells(view, from)[1];
                if site == self.cells(view, to)[0] {
                    found.push(Chain { site: site as u32, from, to });
                }
            }
        }
        found.sort_unstable();
        self.chains = found;
    }

    /// Where a crossing lies, on its way.
    pub(super) fn place(&self, crossing: u32) -> Point {
        let [p, q] = self.cuts[self.cut_of[crossing as usize] as usize].way;
        on_way(p, q, self.crossings[crossing as usize].along)
    }

    /// The cut of a row, if the outline crosses it.
    pub(super) fn cut(&self, row: u32) -> Option<usize> {
        self.cuts.binary_search_by_key(&row, |cut| cut.row).ok()
    }

    /// The pieces of a cut inside, as the numbers of the crossings before and after each; beyond the first and the last
    /// crossing lie the ends of the way.
    pub(super) fn pieces(&self, cut: usize) -> impl Iterator<Item = Piece> + use<'_> {
        let Cut { way: [p, q], inside, ref crossings, .. } = self.cuts[cut];
        let mut number = 0;
        (usize::from(!inside)..=crossings.len()).step_by(2).map(move |i| {
            let from = (i > 0).then(|| (crossings.start + i - 1) as u32);
            let to = (i < crossings.len()).then(|| (crossings.start + i) as u32);
            let place = |crossing: Option<u32>, end: Point| crossing.map_or(end, |crossing| self.place(crossing));
            let ends = [place(from, p), place(to, q)];
            let apart = [0, 1].map(|i| (ends[0][i] - ends[1][i]).abs());
            let door = (apart[0].max(apart[1]) > self.least).then_some(number);
            number += i32::from(door.is_some());
            Piece { ends, from, to, door }
        })
    }
}

/// A piece of a dual edge inside.
#[derive(Debug, Clone, Copy)]
pub(super) struct Piece {
    pub(super) ends: [Point; 2],
    pub(super) from: Option<u32>,
    pub(super) to: Option<u32>,
    /// Its number among the pieces that are doors.
    pub(super) door: Option<i32>,
}

fn look(region: &Region, ways: &Ways<'_>, k: usize) -> ([Point; 2], bool, Vec<Crossing>) {
    let Some([p, q]) = ways.cut(k) else { return ([[0.0; 2]; 2], false, Vec::new()) };
    let mut crossings = Vec::new();
    region.crossings(p, q, &mut crossings);
    ([p, q], region.contains(p), crossings)
}
