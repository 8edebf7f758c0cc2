//! Mazes: a spanning tree of the cells says which doors are opened; the shut ones are the walls.

mod depth_first;
mod kruskal;
mod neighbours;
mod prim;
mod way;
mod wilson;

use std::borrow::Cow;

pub use way::{distances, longest, solve};

use crate::clip::{Bounds, Ways};
use crate::diagram::DiagramView;
use crate::error::{Error, Result};
use crate::graph::Point;
use crate::parallel;
use crate::rng::{Key, Rng, stream};
use crate::watch::Watch;
use neighbours::Neighbours;

/// A maze over the rows of an edge table.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Maze {
    /// Whether the door of each row is open.
    pub open: Vec<bool>,
    /// The spanning forest, two cells a passage in the order of carving: cells - components rows. Parent and child,
    /// except of Kruskal's tree, which has no root.
    pub passages: Vec<[i32; 2]>,
    /// The cell the search started from; -1 when there is no cell.
    pub start: i32,
}

/// By which rule the tree grows.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Tree {
    /// On from the newest cell: long winding ways, few dead ends.
    #[default]
    DepthFirst,
    /// Doors in any order, wherever they join two parts.
    Kruskal,
    /// Any door out of the part carved so far: many short dead ends.
    Prim,
    /// Every spanning tree as likely as the other.
    Wilson,
}

/// Rows whose dual edge has a length within `bounds`, and not along their sides: a cell cannot be left through a point,
/// nor a page at its edge.
///
/// Cells of sites within the bounds hang together: the dual edge of two that are joined by an edge of a shortest spanning
/// tree holds the middle between them.
pub fn voronoi_doors(view: DiagramView<'_>, bounds: Option<Bounds>) -> Vec<bool> {
    let Some(bounds) = bounds else {
        let point = |[a, b]: [i32; 2]| a != -1 && b != -1 && view.vertices[a as usize] == view.vertices[b as usize];
        return parallel::map(view.dual_edges.len(), |k| !point(view.dual_edges[k]));
    };
    let ways = Ways::of(view, bounds);
    let along_side = |[a, b]: [Point; 2]| (0..2).any(|i| a[i] == b[i] && (a[i] == bounds[i] || a[i] == bounds[i + 2]));
    parallel::map(view.dual_edges.len(), |k| ways.cut(k).is_some_and(|ends| !along_side(ends)))
}

/// What a maze is carved through: row `k` of `sides` holds the two cells of door `k`; it is a door when `door[k]` and
/// neither side is -1.
#[derive(Debug, Clone, Copy)]
pub struct Doors<'a> {
    /// How many cells there are.
    pub cells: usize,
    /// Two cells a row.
    pub sides: &'a [[i32; 2]],
    /// Which rows are doors.
    pub door: &'a [bool],
}

/// Carves a maze.
///
/// Depth-first truly: among the unvisited neighbours of the current cell one is drawn, each as likely as the other;
/// where there is none the search goes back the way it came. `start` is drawn when None, a cell with a door if there is
/// one. `opening` is the share of
/// the passages whose door is really opened, drawn after the search; 1 is the thesis.
///
/// # Errors
/// [`Error::BadIndex`] for a start that is no cell, [`Error::Interrupted`].
///
/// # Source
/// Thesis, section 7. The other trees: see their files.
pub fn carve(
    doors: Doors<'_>,
    tree: Tree,
    start: Option<usize>,
    opening: f64,
    key: Key,
    watch: Watch<'_>,
) -> Result<Maze> {
    let Doors { cells, sides, door } = doors;
    let mut rng = Rng::new(key, stream::MAZE);
    // Drawn in any case, so that the same seed gives the same choices from a given start.
    let drawn = rng.below(cells as u32) as usize;
    let first = start.unwrap_or(drawn);
    if first >= cells.max(1) {
        return Err(Error::BadIndex { array: "start", row: 0, value: first as i64, low: 0, limit: cells as i64 });
    }
    let graph = Neighbours::of(cells, sides, door);
    let is_shut = start.is_none() && cells > 0 && graph.entries_of(graph.rank_of[first]).is_empty();
    let start = if is_shut { cell_with_door(doors, key).unwrap_or(first) } else { first };
    let passages = grow(tree, graph, start, rng, watch)?;
    let mut open = vec![false; sides.len()];
    for &(_, door) in opened(&passages, opening, key).iter() {
        open[door as usize] = true;
    }
    let passages = passages.into_iter().map(|(ends, _)| ends).collect();
    Ok(Maze { open, passages, start: if cells == 0 { -1 } else { start as i32 } })
}

/// A cell with a door, each as likely as the other; None when there is none.
pub fn cell_with_door(doors: Doors<'_>, key: Key) -> Option<usize> {
    let mut with_door = vec![false; doors.cells];
    for sides in
        doors.sides.iter().zip(doors.door).filter(|(sides, door)| **door && !sides.contains(&-1)).map(|row| row.0)
    {
        sides.iter().for_each(|&cell| with_door[cell as usize] = true);
    }
    let count = with_door.iter().filter(|&&with| with).count();
    let drawn = ((u128::from(key[0]) * count as u128) >> 64) as usize;
    (0..doors.cells).filter(|&cell| with_door[cell]).nth(drawn)
}

fn grow(tree: Tree, graph: Neighbours, start: usize, rng: Rng, watch: Watch<'_>) -> Result<Vec<Passage>> {
    let Some(&start) = graph.rank_of.get(start) else { return Ok(Vec::new()) };
    match tree {
        Tree::DepthFirst => depth_first::passages(graph, start, rng, watch),
        Tree::Kruskal => kruskal::passages(&graph, rng, watch),
        Tree::Prim => prim::passages(&graph, start, rng, watch),
        Tree::Wilson => wilson::passages(&graph, start, rng, watch),
    }
}

/// A passage: parent and child, and the door between them.
type Passage = ([i32; 2], u32);

/// `opening` of all passages, drawn without return.
fn opened(passages: &[Passage], opening: f64, key: Key) -> Cow<'_, [Passage]> {
    let wanted = (opening * passages.len() as f64).round() as usize;
    if wanted >= passages.len() {
        return Cow::Borrowed(passages);
    }
    let mut chosen = passages.to_vec();
    let mut rng = Rng::new(key, stream::OPENING);
    for i in 0..wanted {
        let other = i + rng.below((chosen.len() - i) as u32) as usize;
        chosen.swap(i, other);
    }
    chosen.truncate(wanted);
    Cow::Owned(chosen)
}
