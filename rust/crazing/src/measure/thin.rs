//! Thinning: a mask becomes lines one pixel wide, with the same pieces and the same holes.

use crate::error::Result;
use crate::watch::Watch;

use super::Mask;

/// The eight neighbours in turn, from the east against the clock as rows count downwards: (row, column).
pub(super) const AROUND: [(isize, isize); 8] = [(0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1), (1, 0), (1, 1)];

/// The skeleton of a mask: no pixel of it can be taken away without changing its pieces, its holes or its ends.
///
/// Pixels are taken from the four sides in turn, each only if it is simple at that moment: so the topology is exact,
/// whatever the mask. The pieces are those of 8-connected pixels, the holes those of 4-connected ones. Beyond the
/// picture there is no crack.
///
/// # Errors
/// [`crate::Error::Interrupted`].
///
/// # Source
/// Directional sequential thinning after Rosenfeld: A characterization of parallel thinning algorithms (Information
/// and Control 1975); simple points by the crossing number of Hilditch (1969).
pub fn thin(mask: &Mask, watch: Watch<'_>) -> Result<Mask> {
    let mut left = mask.clone();
    let mut rim: Vec<u32> = (0..left.pixels.len() as u32).filter(|&at| left.pixels[at as usize]).collect();
    let mut steps = 0;
    while !rim.is_empty() {
        let mut next = Vec::new();
        for side in [2, 6, 0, 4] {
            let exposed = |at: &u32| left.pixels[*at as usize] && !around(&left, *at)[side];
            let layer: Vec<u32> = rim.iter().copied().filter(exposed).collect();
            for at in layer {
                watch.poll_at(steps)?;
                steps += 1;
                if is_removable(around(&left, at)) {
                    left.pixels[at as usize] = false;
                    next.extend(neighbours(&left, at));
                }
            }
        }
        next.sort_unstable();
        next.dedup();
        next.retain(|&at| left.pixels[at as usize]);
        rim = next;
    }
    Ok(left)
}

/// Which of the eight neighbours are crack.
pub(super) fn around(mask: &Mask, at: u32) -> [bool; 8] {
    AROUND.map(|step| mask.beside(at, step).is_some_and(|next| mask.pixels[next as usize]))
}

fn neighbours(mask: &Mask, at: u32) -> impl Iterator<Item = u32> + '_ {
    AROUND.into_iter().filter_map(move |step| mask.beside(at, step)).filter(|&next| mask.pixels[next as usize])
}

/// Whether a pixel can go: its neighbours hang together without it, it fills no hole, and it is no end of a line.
fn is_removable(near: [bool; 8]) -> bool {
    let count = near.iter().filter(|&&crack| crack).count();
    // Runs of crack about the pixel, where a corner between two sides that are crack is passed over.
    let crossings = (0..4).filter(|i| !near[2 * i] && (near[2 * i + 1] || near[(2 * i + 2) % 8])).count();
    count > 1 && crossings == 1
}
