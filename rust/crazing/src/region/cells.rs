//! Voronoi cells within a region: every connected part of a cell is a cell of its own, and every piece of a wall
//! between two of them is a door.

use super::Region;
use super::chains::{Chain, Chains};
use crate::diagram::DiagramView;
use crate::error::Result;
use crate::predicates::orientation;
use crate::sets::DisjointSets;
use crate::watch::Watch;

/// The cells and doors of a diagram within a region.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Cells {
    /// The site of every further part; part `i` of them is cell `sites + i`. The first part of a cell has the number of
    /// its site: the one with the first door.
    pub parts: Vec<i32>,
    /// The edge of every further door, ascending.
    pub rows: Vec<i32>,
    /// The cells on either side of every door; -1 twice where there is none. Door `k` is the first piece of dual edge
    /// `k` inside; then come the further pieces.
    pub sides: Vec<[i32; 2]>,
    /// The cells along the outline, in no order.
    pub rim: Vec<i32>,
    /// Whether each of these is on an outer ring.
    pub outer: Vec<bool>,
    /// Where the outline enters and leaves each of these: number of a side, and part of it.
    pub arcs: Vec<[f64; 2]>,
}

/// The cells of `view` within `region`.
///
/// # Errors
/// [`crate::Error::BadValue`] for sites too far away to be multiplied; [`crate::Error::Interrupted`].
pub fn cells(view: DiagramView<'_>, region: &Region, watch: Watch<'_>) -> Result<Cells> {
    let chains = Chains::of(view, region, watch)?;
    let mut cells = Cells {
        sides: view
            .edges
            .iter()
            .zip(&chains.inside)
            .map(|(&ends, &inside)| if inside { ends } else { [-1; 2] })
            .collect(),
        ..Cells::default()
    };
    // Where the further doors of each cut start, one before their first.
    let mut further = Vec::with_capacity(chains.cuts.len());
    for (i, cut) in chains.cuts.iter().enumerate() {
        further.push((cells.sides.len() + cells.rows.len()) as i32 - 1);
        let doors = chains.pieces(i).filter(|piece| piece.door.is_some()).count();
        cells.rows.extend(std::iter::repeat_n(cut.row as i32, doors.saturating_sub(1)));
    }
    let count = cells.sides.len() + cells.rows.len();
    cells.sides.resize(count, [-1; 2]);
    let around = around(view, &chains);
    let is_outer = outer(region);
    let mut own = chains.chains.as_slice();
    let mut floor = Floor {
        view,
        chains: &chains,
        further: &further,
        tokens: Vec::new(),
        token_of: vec![0; chains.crossings.len()],
    };
    for (step, rows) in around.chunk_by(|a, b| a.0 == b.0).enumerate() {
        watch.poll_at(step)?;
        let site = rows[0].0;
        let split = own.partition_point(|chain| chain.site < site);
        own = &own[split..];
        let (here, rest) = own.split_at(own.partition_point(|chain| chain.site == site));
        own = rest;
        floor.part(site, rows, here, &is_outer, &mut cells);
    }
    Ok(cells)
}

/// Sites that the outline passes through, and the rows about each that are not wholly outside.
fn around(view: DiagramView<'_>, chains: &Chains) -> Vec<(u32, u32)> {
    let mut met = vec![0_u64; view.sites.len() / 64 + 1];
    for site in chains.cuts.iter().flat_map(|cut| view.edges[cut.row as usize]) {
        met[site as usize / 64] |= 1 << (site % 64);
    }
    let is_met = |site: i32| met[site as usize / 64] >> (site % 64) & 1 == 1;
    let mut found = Vec::new();
    for (k, ends) in view.edges.iter().enumerate().filter(|&(k, _)| chains.inside[k]) {
        found.extend(ends.iter().filter(|&&site| is_met(site)).map(|&site| (site as u32, k as u32)));
    }
    for row in chains.cuts.iter().map(|cut| cut.row) {
        found.extend(view.edges[row as usize].map(|site| (site as u32, row)));
    }
    found.sort_unstable();
    found
}

/// Whether each side is of a ring with the inside within it.
fn outer(region: &Region) -> Vec<bool> {
    let mut is_outer = vec![false; region.sides.len()];
    for ring in region.rings.windows(2) {
        let sides = &region.sides[ring[0]..ring[1]];
        let origin = sides[0][0];
        let area = |[[ax, ay], [bx, by]]: &[[f64; 2]; 2]| {
            (ax - origin[0]) * (by - origin[1]) - (ay - origin[1]) * (bx - origin[0])
        };
        is_outer[ring[0]..ring[1]].fill(sides.iter().map(area).sum::<f64>() > 0.0);
    }
    is_outer
}

/// What lies along the border of a cell, counter-clockwise.
#[derive(Clone, Copy)]
enum Token {
    /// A piece inside; its door and which side of it the cell is on, if it has a length.
    Piece(Option<(i32, usize)>),
    /// Where the outline crosses.
    Crossing,
}

/// One cell at a time.
struct Floor<'a> {
    view: DiagramView<'a>,
    chains: &'a Chains,
    further: &'a [i32],
    tokens: Vec<Token>,
    /// The token of every crossing, in the cell last looked at.
    token_of: Vec<u32>,
}

impl Floor<'_> {
    /// Gives the parts of a cell their numbers, and their doors these.
    fn part(&mut self, site: u32, rows: &[(u32, u32)], chains: &[Chain], is_outer: &[bool], cells: &mut Cells) {
        self.walk(site, rows);
        let mut sets = DisjointSets::new(self.tokens.len());
        for i in 0..self.tokens.len() {
            let next = (i + 1) % self.tokens.len();
            // Between two crossings without a piece lies the outside.
            if !matches!((self.tokens[i], self.tokens[next]), (Token::Crossing, Token::Crossing)) {
                sets.unite(i, next);
            }
        }
        for chain in chains {
            let [from, to] = [chain.from, chain.to].map(|crossing| self.token_of[crossing as usize] as usize);
            sets.unite(from, to);
        }
        let mut doors: Vec<(i32, usize, usize)> = Vec::new();
        for (i, token) in self.tokens.iter().enumerate() {
            if let &Token::Piece(Some((door, which))) = token {
                doors.push((door, which, sets.lowest(i)));
            }
        }
        doors.sort_unstable();
        let mut numbers: Vec<(usize, i32)> = Vec::new();
        for (door, which, set) in doors {
            let known = numbers.iter().find(|(other, _)| *other == set).map(|&(_, number)| number);
            let number = known.unwrap_or_else(|| {
                let fresh = !numbers.is_empty();
                cells.parts.extend(fresh.then_some(site as i32));
                let number = if fresh { (self.view.sites.len() + cells.parts.len()) as i32 - 1 } else { site as i32 };
                numbers.push((set, number));
                number
            });
            cells.sides[door as usize][which] = number;
        }
        for chain in chains {
            let set = sets.lowest(self.token_of[chain.from as usize] as usize);
            let at = |crossing: u32| {
                let crossing = self.chains.crossings[crossing as usize];
                f64::from(crossing.side) + crossing.at.clamp(0.0, 1.0 - f64::EPSILON)
            };
            let side = self.chains.crossings[chain.from as usize].side;
            if let Some(&(_, number)) = numbers.iter().find(|(other, _)| *other == set) {
                cells.rim.push(number);
                cells.outer.push(is_outer[side as usize]);
                cells.arcs.push([at(chain.from), at(chain.to)]);
            }
        }
    }

    /// The border of a cell.
    fn walk(&mut self, site: u32, rows: &[(u32, u32)]) {
        self.tokens.clear();
        for row in turned(self.view, site, rows) {
            let is_first = self.view.edges[row as usize][0] == site as i32;
            let which = usize::from(!is_first);
            let Some(cut) = self.chains.cut(row) else {
                self.tokens.push(Token::Piece(Some((row as i32, which))));
                continue;
            };
            let start = self.tokens.len();
            // Crossings and pieces in turn, along the way.
            for piece in self.chains.pieces(cut) {
                let door = piece.door.map(|number| if number == 0 { row as i32 } else { self.further[cut] + number });
                if let Some(from) = piece.from {
                    self.tokens.push(Token::Crossing);
                    self.token_of[from as usize] = self.tokens.len() as u32 - 1;
                }
                self.tokens.push(Token::Piece(door.map(|door| (door, which))));
                if let Some(to) = piece.to {
                    self.tokens.push(Token::Crossing);
                    self.token_of[to as usize] = self.tokens.len() as u32 - 1;
                }
            }
            if !is_first {
                // From the other side the way runs clockwise.
                self.tokens[start..].reverse();
                let last = (start + self.tokens.len() - 1) as u32;
                for crossing in self.chains.cuts[cut].crossings.clone() {
                    self.token_of[crossing] = last - self.token_of[crossing];
                }
            }
        }
    }
}

/// Rows about a site in the order of their neighbours, counter-clockwise.
pub(super) fn turned(view: DiagramView<'_>, site: u32, rows: &[(u32, u32)]) -> Vec<u32> {
    let centre = view.sites[site as usize];
    let other = |row: u32| {
        let [a, b] = view.edges[row as usize];
        view.sites[if a == site as i32 { b } else { a } as usize]
    };
    let is_lower = |p: [f64; 2]| p[1] < centre[1] || (p[1] == centre[1] && p[0] < centre[0]);
    let mut sorted: Vec<(bool, [f64; 2], u32)> =
        rows.iter().map(|&(_, row)| (is_lower(other(row)), other(row), row)).collect();
    sorted.sort_by(|a, b| {
        let turn = || orientation(centre, b.1, a.1).partial_cmp(&0.0).unwrap_or(std::cmp::Ordering::Equal);
        a.0.cmp(&b.0).then_with(turn).then(a.2.cmp(&b.2))
    });
    sorted.into_iter().map(|entry| entry.2).collect()
}
