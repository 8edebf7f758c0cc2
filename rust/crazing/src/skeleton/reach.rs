//! Tips that go on along what was peeled off an axis, as long as one way leads on.

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
/// Least arc of a way that leads past another, in radii: a corner whose neighbour is a way, too, is one of 48 degrees or
/// more, which spans no more. So the end of a corridor that is cut askew is an end.
const FAR: f64 = 4.5;
/// And in arcs of the other. In corridors with niches half as deep as wide, tips stop up to 5 widths short if all that
/// part there hold them up; so they come to half a width from the end, from 1.5 to 2.8 alike.
const LEAD: f64 = 1.9;

/// The axis that [`peeled`](super::peeled) leaves, grown outwards at its tips: each goes on to the middle of a round end,
/// into a corner if there is but one, and up to where the ways into two corners part; past what is small beside the rest.
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
    let ways = Ways::of(&tree, view, arcs);
    let tips: Vec<i32> = tree.tip_vertices().collect();
    for (step, &tip) in tips.iter().enumerate() {
        watch.poll_at(step)?;
        let mut at = tip;
        while let Some(k) = ways.onward(&tree, at) {
            let [a, b] = tree.duals[k as usize];
            at = if a == at { b } else { a };
            tree.join(k);
        }
    }
    Ok(tree.kept)
}

/// The peeled edges on which a tip that comes to a vertex may go on: few of all, so that each vertex has but a chain.
struct Ways<'a> {
    view: DiagramView<'a>,
    arcs: &'a [f64],
    /// One more than the place of a vertex' last way, 0 where there is none.
    last: Vec<u32>,
    /// Edges, and the same of the way before each at its vertex.
    chain: Vec<(u32, u32)>,
}

impl<'a> Ways<'a> {
    fn of(tree: &Tree, view: DiagramView<'a>, arcs: &'a [f64]) -> Self {
        let (duals, kept) = (&tree.duals, &tree.kept);
        let wide = parallel::ranges(arcs.len(), |range| {
            let peeled = range.filter(|&k| !kept[k] && duals[k][0] != -1);
            let ends = peeled.flat_map(|k| duals[k].map(|v| (k as u32, v)));
            ends.filter(|&(k, v)| spans(view, arcs, k, v, LEAST)).collect::<Vec<_>>()
        });
        let mut last = vec![0; view.vertices.len()];
        let chain = (1..).zip(wide.iter().flatten()).map(|(place, &(k, v))| {
            let before = std::mem::replace(&mut last[v as usize], place);
            (k, before)
        });
        let chain = chain.collect();
        Self { view, arcs, last, chain }
    }

    /// The ways at a vertex that lead to where nothing is kept.
    fn free(&self, tree: &Tree, v: i32) -> impl Iterator<Item = u32> {
        let way = |place: u32| self.chain.get((place as usize).wrapping_sub(1)).copied();
        let all = std::iter::successors(way(self.last[v as usize]), move |&(_, before)| way(before));
        all.map(|(k, _)| k).filter(move |&k| tree.leads_out(k, v))
    }

    /// The edge that leads on from a vertex to where nothing is kept; None where none does, or several alike.
    fn onward(&self, tree: &Tree, v: i32) -> Option<u32> {
        let mut free = self.free(tree, v);
        let mut widest = free.next()?;
        let mut other = 0.0_f64;
        for k in free {
            let [a, b] = [widest, k].map(|k| self.arcs[k as usize]);
            other = other.max(a.min(b));
            if b > a {
                widest = k;
            }
        }
        let is_clear =
            other == 0.0 || (self.arcs[widest as usize] > LEAD * other && spans(self.view, self.arcs, widest, v, FAR));
        is_clear.then_some(widest)
    }
}

/// Whether an edge spans so many radii of the disc at one of its ends.
fn spans(view: DiagramView<'_>, arcs: &[f64], k: u32, v: i32, least: f64) -> bool {
    let ([x, y], [s, t]) = (view.vertices[v as usize], view.sites[view.edges[k as usize][0] as usize]);
    let most = arcs[k as usize] / least;
    // Nearly always one coordinate tells.
    (x - s).abs() <= most && (y - t).abs() <= most && distance([x, y], [s, t]) <= most
}
