//! Weak edges taken off an axis from its tips on.

use super::tree::Tree;
use crate::diagram::DiagramView;
use crate::error::{Error, Result};
use crate::sets::DisjointSets;
use crate::watch::Watch;

/// An axis, a mask of dual edges, without its weak edges, those worth less than `least`, but for the ones that hold two
/// stronger parts together: no component falls apart, and one that is all weak vanishes.
///
/// Of the weak edges of a cycle the least ones go; the others go as long as they are tips. Where the worth never
/// decreases from a tip towards the middle, as the arc residual in a ring, just the edges are left that are not weak.
/// Edges that are not drawn, infinite or without length, are kept unless weak.
///
/// # Errors
/// [`Error::BadLength`], [`Error::Interrupted`].
pub fn peeled(view: DiagramView<'_>, axis: &[bool], worth: &[f64], least: f64, watch: Watch<'_>) -> Result<Vec<bool>> {
    Ok(peeled_tree(view, axis, worth, least, watch)?.kept)
}

/// The same with what there is at every vertex of it.
pub(super) fn peeled_tree(
    view: DiagramView<'_>,
    axis: &[bool],
    worth: &[f64],
    least: f64,
    watch: Watch<'_>,
) -> Result<Tree> {
    let wanted = view.edges.len();
    for (array, found) in [("axis", axis.len()), ("worth", worth.len())] {
        if found != wanted {
            return Err(Error::BadLength { array, found, wanted });
        }
    }
    let mut tree = Tree::of(view, axis);
    let is_weak = |k: u32| worth[k as usize] < least;
    let mut weak = Vec::new();
    for k in (0..wanted as u32).filter(|&k| is_weak(k)) {
        if tree.is_drawn(k as usize) {
            weak.push(k);
        } else {
            tree.kept[k as usize] = false;
        }
    }
    peel(&mut tree, weak.clone(), is_weak, watch)?;
    weak.retain(|&k| tree.kept[k as usize]);
    if !weak.is_empty() {
        // These hold stronger parts together, or lie on cycles, on which nothing is a tip.
        open(&mut tree, &mut weak, is_weak, worth);
        peel(&mut tree, weak, is_weak, watch)?;
    }
    Ok(tree)
}

/// Cuts the weak edges that close a cycle of strong and better ones.
fn open(tree: &mut Tree, weak: &mut [u32], is_weak: impl Fn(u32) -> bool, worth: &[f64]) {
    let mut sets = DisjointSets::new(tree.vertices());
    let mut joins = |tree: &Tree, k: u32| {
        let [a, b] = tree.duals[k as usize];
        sets.unite(a as usize, b as usize)
    };
    let strong = (0..worth.len() as u32).filter(|&k| tree.is_drawn(k as usize) && !is_weak(k));
    strong.for_each(|k| _ = joins(tree, k));
    // The best ones first: what they have joined needs no worse one.
    weak.sort_by(|&a, &b| worth[b as usize].total_cmp(&worth[a as usize]));
    for &k in &*weak {
        if !joins(tree, k) {
            tree.cut(k);
        }
    }
}

fn peel(tree: &mut Tree, mut todo: Vec<u32>, is_weak: impl Fn(u32) -> bool, watch: Watch<'_>) -> Result<()> {
    let mut steps = 0;
    while let Some(k) = todo.pop() {
        watch.poll_at(steps)?;
        steps += 1;
        if tree.kept[k as usize] && is_weak(k) && tree.hangs(k) {
            let inner = tree.inner(k);
            tree.cut(k);
            todo.extend(tree.next_tip(inner));
        }
    }
    Ok(())
}
