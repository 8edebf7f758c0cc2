//! Mazes: a depth-first search over cells opens the doors it passes; the shut ones are the walls.

use crate::diagram::DiagramView;
use crate::error::{Error, Result};
use crate::parallel;
use crate::rng::{Key, Rng, stream};
use crate::watch::Watch;

/// A maze over the rows of an edge table.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Maze {
    /// Whether the door of each row is open.
    pub open: Vec<bool>,
    /// The spanning forest of the search, parent and child in the order of carving: cells - components rows.
    pub passages: Vec<[i32; 2]>,
    /// The cell the search started from; -1 when there is no cell.
    pub start: i32,
}

/// Rows whose dual edge has a length: a cell cannot be left through a point.
pub fn voronoi_doors(view: DiagramView<'_>) -> Vec<bool> {
    let point = |[a, b]: [i32; 2]| a != -1 && b != -1 && view.vertices[a as usize] == view.vertices[b as usize];
    parallel::map(view.dual_edges.len(), |k| !point(view.dual_edges[k]))
}

/// Carves a maze through `cells` cells. Row `k` of `sides` holds the two cells of door `k`; it is a door when `door[k]`
/// and neither side is -1.
///
/// Truly depth-first: among the unvisited neighbours of the current cell one is drawn, each as likely as the other;
/// where there is none the search goes back the way it came. `start` is drawn when None. `opening` is the share of
/// the passages whose door is really opened, drawn after the search; 1 is the thesis.
///
/// # Errors
/// [`Error::BadIndex`] for a start that is no cell, [`Error::Interrupted`].
///
/// # Source
/// Thesis, section 7.
pub fn carve(
    cells: usize,
    sides: &[[i32; 2]],
    door: &[bool],
    start: Option<usize>,
    opening: f64,
    key: Key,
    watch: Watch<'_>,
) -> Result<Maze> {
    let mut rng = Rng::new(key, stream::MAZE);
    // Drawn in any case, so that the same seed gives the same choices from a given start.
    let drawn = rng.below(cells as u32) as usize;
    let start = start.unwrap_or(drawn);
    if start >= cells.max(1) {
        return Err(Error::BadIndex { array: "start", row: 0, value: start as i64, low: 0, limit: cells as i64 });
    }
    let neighbours = Neighbours::of(cells, sides, door);
    let passages = Search::new(neighbours, rng).run(start, watch)?;
    let mut open = vec![false; sides.len()];
    for door in opened(&passages, opening, key) {
        open[door as usize] = true;
    }
    let passages = passages.into_iter().map(|(ends, _)| ends).collect();
    Ok(Maze { open, passages, start: if cells == 0 { -1 } else { start as i32 } })
}

/// A passage: parent and child, and the door between them.
type Passage = ([i32; 2], u32);

/// The doors of `opening` of all passages, drawn without return.
fn opened(passages: &[Passage], opening: f64, key: Key) -> Vec<u32> {
    let mut doors: Vec<u32> = passages.iter().map(|&(_, door)| door).collect();
    let wanted = (opening * doors.len() as f64).round() as usize;
    if wanted < doors.len() {
        let mut rng = Rng::new(key, stream::OPENING);
        for i in 0..wanted {
            let other = i + rng.below((doors.len() - i) as u32) as usize;
            doors.swap(i, other);
        }
        doors.truncate(wanted);
    }
    doors
}

/// The cells along the shortest way from `source` to `target` through open doors, by breadth-first search; empty when
/// there is none.
///
/// # Errors
/// [`Error::BadIndex`] when either is no cell, [`Error::Interrupted`].
///
/// # Source
/// Thesis, section 7.1.
pub fn solve(
    cells: usize,
    sides: &[[i32; 2]],
    open: &[bool],
    source: usize,
    target: usize,
    watch: Watch<'_>,
) -> Result<Vec<i32>> {
    for (array, cell) in [("source", source), ("target", target)] {
        if cell >= cells {
            return Err(Error::BadIndex { array, row: 0, value: cell as i64, low: 0, limit: cells as i64 });
        }
    }
    let graph = Neighbours::of(cells, sides, open);
    let [source, target] = [source, target].map(|cell| graph.rank_of[cell]);
    // From the target, so that following the links from the source gives the way in its order.
    let toward = breadth_first(&graph, target, source, watch)?;
    let mut way = Vec::new();
    let mut at = source;
    while toward[at as usize] != UNSEEN {
        way.push(graph.cell_of[at as usize]);
        if at == target {
            break;
        }
        at = toward[at as usize];
    }
    Ok(way)
}

/// Not reached by the search.
const UNSEEN: u32 = u32::MAX;

/// The neighbour of each cell that is one door nearer to `root`, for all cells up to the distance of `goal`.
fn breadth_first(graph: &Neighbours, root: u32, goal: u32, watch: Watch<'_>) -> Result<Vec<u32>> {
    let mut toward = vec![UNSEEN; graph.cell_of.len()];
    let mut queue = vec![root];
    toward[root as usize] = root;
    let mut next = 0;
    while next < queue.len() && toward[goal as usize] == UNSEEN {
        watch.poll_at(next)?;
        let cell = queue[next];
        next += 1;
        for &[neighbour, _] in graph.entries_of(cell) {
            if toward[neighbour as usize] == UNSEEN {
                toward[neighbour as usize] = cell;
                queue.push(neighbour);
            }
        }
    }
    Ok(toward)
}

/// The neighbours of every cell and the doors to them, in one row.
///
/// Cells are renumbered by first appearance in `sides`: the edges of a diagram follow a curve through the plane, so
/// cells that are neighbours come to lie close in memory, which makes the search several times faster.
struct Neighbours {
    cell_of: Vec<i32>,
    rank_of: Vec<u32>,
    /// Where the entries of each cell start, and the end.
    starts: Vec<u32>,
    /// Rank of the neighbour, and the door.
    entries: Vec<[u32; 2]>,
}

impl Neighbours {
    fn of(cells: usize, sides: &[[i32; 2]], door: &[bool]) -> Self {
        let doors = || (0..sides.len()).filter(|&k| door[k] && !sides[k].contains(&-1));
        let mut cell_of = Vec::with_capacity(cells);
        let mut rank_of = vec![u32::MAX; cells];
        let mut rank = |cell: i32| {
            let rank = &mut rank_of[cell as usize];
            if *rank == u32::MAX {
                *rank = cell_of.len() as u32;
                cell_of.push(cell);
            }
            *rank as usize
        };
        let mut starts = vec![0_u32; cells + 2];
        for cell in doors().flat_map(|k| sides[k]) {
            starts[rank(cell) + 2] += 1;
        }
        // Cells without a door come last.
        (0..cells as i32).for_each(|cell| _ = rank(cell));
        for i in 2..starts.len() {
            starts[i] += starts[i - 1];
        }
        let mut entries = vec![[0; 2]; starts[cells + 1] as usize];
        for k in doors() {
            let [a, b] = sides[k].map(|cell| rank_of[cell as usize]);
            for (from, to) in [(a, b), (b, a)] {
                // Counted two places on, filled one place on: what is left at the end are the starts.
                let place = &mut starts[from as usize + 1];
                entries[*place as usize] = [to, k as u32];
                *place += 1;
            }
        }
        Self { cell_of, rank_of, starts, entries }
    }

    fn entries_of(&self, cell: u32) -> &[[u32; 2]] {
        &self.entries[self.starts[cell as usize] as usize..self.starts[cell as usize + 1] as usize]
    }
}

/// A depth-first search with a stack of its own.
struct Search {
    graph: Neighbours,
    rng: Rng,
    visited: Vec<bool>,
    /// Entries of each cell that were not drawn yet.
    left: Vec<u32>,
    stack: Vec<u32>,
    passages: Vec<Passage>,
}

impl Search {
    fn new(graph: Neighbours, rng: Rng) -> Self {
        let cells = graph.cell_of.len();
        let left = graph.starts.windows(2).take(cells).map(|pair| pair[1] - pair[0]).collect();
        let passages = Vec::with_capacity(cells.saturating_sub(1));
        Self { graph, rng, visited: vec![false; cells], left, stack: Vec::new(), passages }
    }

    fn run(mut self, start: usize, watch: Watch<'_>) -> Result<Vec<Passage>> {
        let first = self.graph.rank_of.get(start).copied();
        for root in first.into_iter().chain(0..self.visited.len() as u32) {
            if !self.visited[root as usize] {
                self.visit(root);
                self.explore(watch)?;
            }
        }
        Ok(self.passages)
    }

    fn visit(&mut self, cell: u32) {
        self.visited[cell as usize] = true;
        self.stack.push(cell);
    }

    fn explore(&mut self, watch: Watch<'_>) -> Result<()> {
        let mut step = 0;
        while let Some(&cell) = self.stack.last() {
            watch.poll_at(step)?;
            step += 1;
            match self.draw(cell) {
                Some([next, door]) => {
                    let ends = [cell, next].map(|rank| self.graph.cell_of[rank as usize]);
                    self.passages.push((ends, door));
                    self.visit(next);
                }
                None => {
                    self.stack.pop();
                }
            }
        }
        Ok(())
    }

    /// One of the unvisited neighbours. Entries are drawn without return and those visited passed over, which makes
    /// every unvisited one as likely as the other and looks at each entry once in all.
    fn draw(&mut self, cell: u32) -> Option<[u32; 2]> {
        let start = self.graph.starts[cell as usize] as usize;
        let left = &mut self.left[cell as usize];
        while *left > 0 {
            let drawn = start + self.rng.below(*left) as usize;
            *left -= 1;
            let last = start + *left as usize;
            self.graph.entries.swap(drawn, last);
            let entry = self.graph.entries[last];
            if !self.visited[entry[0] as usize] {
                return Some(entry);
            }
        }
        None
    }
}
