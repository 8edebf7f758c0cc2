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
    let wanted = view.edges.len();
    for (array, found) in [("axis", axis.len()), ("worth", worth.len())] {
        if found != wanted {
            return Err(Error::BadLength { array, found, wanted });
        }
    }
    let mut tree = Tree::of(view, axis);
    let mut weak: Vec<u32> = Vec::new();
    let mut sets = DisjointSets::new(view.vertices.len());
    for (k, &worth) in worth.iter().enumerate() {
        let is_weak = worth < least;
        match tree.is_drawn(k) {
            true if is_weak => weak.push(k as u32),
            true => drop(sets.unite(tree.duals[k][0] as usize, tree.duals[k][1] as usize)),
            false => tree.kept[k] &= !is_weak,
        }
    }
    let strong = sets.clone();
    let mut joins = |k: &u32| sets.unite(tree.duals[*k as usize][0] as usize, tree.duals[*k as usize][1] as usize);
    // Where no weak edge closes a cycle, none has to be better than another.
    if !weak.iter().all(&mut joins) {
        sets = strong;
        // The best ones first: what they have joined needs no worse one.
        weak.sort_by(|&a, &b| worth[b as usize].total_cmp(&worth[a as usize]));
        for &k in &weak {
            let [a, b] = tree.duals[k as usize];
            if !sets.unite(a as usize, b as usize) {
                tree.cut(k);
            }
        }
    }
    peel(&mut tree, weak, |k| worth[k as usize] < least, watch)?;
    Ok(tree.kept)
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
