//! Tips that go on along what was peeled off an axis, as long as one way alone does.

use super::cost::distance;
use super::peel::peeled_tree;
use super::tree::Tree;
use crate::diagram::DiagramView;
use crate::error::{Error, Result};
use crate::parallel;
use crate::watch::Watch;

/// Least arc of the boundary that a way spans, in radii of the disc it starts from. The axis of a corner of angle a spans
/// 2 / tan(a / 2) of them all along, 2 in a right one, 1.16 at 120 degrees; that of the far side of a round end spans a
/// step of the samples, and a hair of noise two. On flowers, stars, ellipses and corridors under noise of up to a quarter
/// of a step tips pass the true ones by up to 3 steps, and stay behind them by up to 13 of 2000; with 1 it is 2 and 35.
const LEAST: f64 = 0.9;

/// The axis that [`peeled`](super::peeled) leaves, grown outwards at its tips: each goes on to the middle of a round end,
/// into a corner if there is but one, and up to where the ways into two corners part.
///
/// `arcs` are the lengths of the boundary that the dual edges cut off. What is kept is not run into, so there is no new
/// tip, cycle or component.
///
/// # Errors
/// [`Error::BadLength`], [`Error::Interrupted`].
pub fn reaching(
    view: DiagramView<'_>,
    axis: &[bool],
    worth: &[f64],
    arcs: &[f64],
    least: f64,
    watch: Watch<'_>,
) -> Result<Vec<bool>> {
    let (found, wanted) = (arcs.len(), view.edges.len());
    if found != wanted {
        return Err(Error::BadLength { array: "arcs", found, wanted });
    }
    let mut tree = peeled_tree(view, axis, worth, least, watch)?;
    let mut ways = Ways::of(&tree, view, arcs);
    let tips: Vec<i32> = tree.tip_vertices().collect();
    for (step, &tip) in tips.iter().enumerate() {
        watch.poll_at(step)?;
        let mut at = tip;
        while let Some(k) = ways.only(at).filter(|&k| tree.leads_out(k, at)) {
            let [a, b] = tree.duals[k as usize];
            at = if a == at { b } else { a };
            tree.join(k);
            ways.come(k, at);
        }
    }
    Ok(tree.kept)
}

/// The peeled edges on which a tip may go on.
struct Ways<'a> {
    view: DiagramView<'a>,
    arcs: &'a [f64],
    /// How many there are at every vertex, and their numbers by exclusive or: of one, its number.
    at: Vec<[u32; 2]>,
}

impl<'a> Ways<'a> {
    fn of(tree: &Tree, view: DiagramView<'a>, arcs: &'a [f64]) -> Self {
        let mut ways = Self { view, arcs, at: vec![[0; 2]; view.vertices.len()] };
        let (duals, kept) = (&tree.duals, &tree.kept);
        let found = parallel::ranges(arcs.len(), |range| {
            let peeled = range.filter(|&k| !kept[k] && duals[k][0] != -1);
            let ends = peeled.flat_map(|k| duals[k].map(|v| (k as u32, v)));
            ends.filter(|&(k, v)| ways.is_wide(k, v)).collect::<Vec<_>>()
        });
        for (k, v) in found.into_iter().flatten() {
            let [count, last] = &mut ways.at[v as usize];
            *count += 1;
            *last ^= k;
        }
        ways
    }

    /// Whether an edge spans enough for a tip at one of its ends.
    fn is_wide(&self, k: u32, v: i32) -> bool {
        let [x, y] = self.view.vertices[v as usize];
        let [s, t] = self.view.sites[self.view.edges[k as usize][0] as usize];
        let most = self.arcs[k as usize] / LEAST;
        // Nearly always one coordinate tells.
        (x - s).abs() <= most && (y - t).abs() <= most && distance([x, y], [s, t]) <= most
    }

    /// Takes out the edge on which a tip came to a vertex.
    fn come(&mut self, k: u32, v: i32) {
        if self.is_wide(k, v) {
            let [count, last] = &mut self.at[v as usize];
            *count -= 1;
            *last ^= k;
        }
    }

    fn only(&self, v: i32) -> Option<u32> {
        let [count, last] = self.at[v as usize];
        (count == 1).then_some(last)
    }
}
