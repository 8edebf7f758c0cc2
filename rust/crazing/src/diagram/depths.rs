//! How deep within walls every triangle lies.

use super::DiagramView;
use crate::error::{Error, Result};
use crate::incidence::Incidence;
use crate::watch::Watch;

/// For every triangle the fewest of the edges `wall` that a way from infinity to it crosses: 0 outside, and by the
/// even-odd rule inside where the number is odd.
///
/// # Errors
/// [`Error::BadLength`], [`Error::Interrupted`].
pub fn depths(view: DiagramView<'_>, wall: &[bool], watch: Watch<'_>) -> Result<Vec<i32>> {
    if wall.len() != view.edges.len() {
        return Err(Error::BadLength { array: "wall", found: wall.len(), wanted: view.edges.len() });
    }
    let around = Incidence::of(view.triangles.len(), view.dual_edges);
    let mut depth = vec![-1; view.triangles.len()];
    // Triangles of this depth and of the next that were met, with repetition; the hull comes first.
    let mut levels: [Vec<i32>; 2] = [Vec::new(), Vec::new()];
    for (dual, &wall) in view.dual_edges.iter().zip(wall).filter(|(dual, _)| dual.contains(&-1)) {
        levels[usize::from(wall)].extend(dual.iter().filter(|&&t| t != -1));
    }
    let (mut level, mut steps) = (0, 0);
    while levels.iter().any(|level| !level.is_empty()) {
        while let Some(t) = levels[0].pop() {
            watch.poll_at(steps)?;
            steps += 1;
            if depth[t as usize] != -1 {
                continue;
            }
            depth[t as usize] = level;
            for &k in around.at(t as usize) {
                let met = view.dual_edges[k as usize].iter().filter(|&&next| next != -1 && depth[next as usize] == -1);
                levels[usize::from(wall[k as usize])].extend(met);
            }
        }
        levels.swap(0, 1);
        level += 1;
    }
    Ok(depth)
}
