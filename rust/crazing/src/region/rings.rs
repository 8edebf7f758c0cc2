//! Rings made plain: sides without their doubles, cut where others touch them, and joined so that the inside is on the
//! left and a ring that touches itself comes apart.

use super::Region;
use crate::diagram::check_apart;
use crate::error::{Error, Result};
use crate::graph::Point;
use crate::predicates::orientation;
use crate::watch::Watch;

/// The sides of the rings: those there an odd number of times, cut at the corners that lie on them.
pub(super) fn sides(coords: &[Point], offsets: &[i64], watch: Watch<'_>) -> Result<Vec<[Point; 2]>> {
    let rows = rows(coords, offsets)?;
    let sides = once(coords, &rows);
    let touched = check_apart(coords, &sides, "outline side", watch)?;
    let mut cut = Vec::with_capacity(sides.len() + touched.len());
    let mut touches = touched.into_iter().peekable();
    for (k, ends) in sides.iter().enumerate() {
        let [mut from, to] = ends.map(|end| coords[end as usize]);
        let mut between = Vec::new();
        while let Some((_, corner)) = touches.next_if(|&(side, _)| side as usize == k) {
            between.push(corner);
        }
        // Touched in the order of the sweep, along x or against it.
        if between.len() > 1 && (between[0] < between[1]) != (from < to) {
            between.reverse();
        }
        for corner in between {
            cut.push([from, corner]);
            from = corner;
        }
        cut.push([from, to]);
    }
    Ok(cut)
}

fn rows(coords: &[Point], offsets: &[i64]) -> Result<Vec<[u32; 2]>> {
    let mut sides = Vec::with_capacity(coords.len());
    for (row, ends) in offsets.windows(2).enumerate() {
        let range = usize::try_from(ends[0]).ok().zip(usize::try_from(ends[1]).ok());
        let range = range.filter(|&(a, b)| a <= b && b <= coords.len());
        let (low, limit) = (ends[0], coords.len() as i64 + 1);
        let (a, b) = range.ok_or(Error::BadIndex { array: "offsets", row: row + 1, value: ends[1], low, limit })?;
        let next = |i: usize| if i + 1 == b { a } else { i + 1 };
        sides.extend((a..b).filter(|&i| coords[i] != coords[next(i)]).map(|i| [i as u32, next(i) as u32]));
    }
    Ok(sides)
}

/// Without the pairs of sides that join the same places.
fn once(coords: &[Point], sides: &[[u32; 2]]) -> Vec<[u32; 2]> {
    let key = |k: u32| {
        let [a, b] = sides[k as usize].map(|end| coords[end as usize]);
        if a < b { [a, b] } else { [b, a] }
    };
    let mut order: Vec<u32> = (0..sides.len() as u32).collect();
    // Keys that cannot be compared are of no number, and were refused.
    order.sort_by(|&a, &b| key(a).partial_cmp(&key(b)).unwrap_or(std::cmp::Ordering::Equal));
    let mut kept: Vec<u32> =
        order.chunk_by(|&a, &b| key(a) == key(b)).filter(|same| same.len() % 2 == 1).map(|same| same[0]).collect();
    kept.sort_unstable();
    kept.into_iter().map(|k| sides[k as usize]).collect()
}

/// Sides in the order of their rings and whether each is turned round; and where the rings start.
pub(super) type Traced = (Vec<(u32, bool)>, Vec<usize>);

/// The rings that the sides make.
pub(super) fn traced(region: &Region, watch: Watch<'_>) -> Result<Traced> {
    let next = paired(region, watch)?;
    let mut seen = vec![false; region.sides.len()];
    let (mut order, mut rings) = (Vec::with_capacity(seen.len()), vec![0]);
    for first in 0..seen.len() {
        let mut end = 2 * first;
        // From the end at which the side starts with the inside on its left.
        if next[end] & 1 == NONE {
            end += 1;
        }
        while !std::mem::replace(&mut seen[end / 2], true) {
            watch.poll_at(order.len())?;
            order.push((end as u32 / 2, end % 2 == 1));
            // Over to the far end, and on with the side that bounds the same part of the inside.
            end = (next[end ^ 1] >> 1) as usize;
        }
        if order.len() > rings[rings.len() - 1] {
            rings.push(order.len());
        }
    }
    Ok((order, rings))
}

/// Low bit of an entry of `paired`: the side that leaves by this end has the outside on its left.
const NONE: u32 = 0;

/// For every end of a side (2 k and 2 k + 1) the end that bounds the same wedge of the inside at their corner, twice,
/// and one where the side leaves it with the inside on the left.
fn paired(region: &Region, watch: Watch<'_>) -> Result<Vec<u32>> {
    let at = |end: u32| region.sides[end as usize / 2][end as usize % 2];
    let far = |end: u32| at(end ^ 1);
    let mut ends: Vec<u32> = (0..2 * region.sides.len() as u32).collect();
    ends.sort_by(|&a, &b| at(a).partial_cmp(&at(b)).unwrap_or(std::cmp::Ordering::Equal));
    let mut next = vec![0; ends.len()];
    for (step, here) in ends.chunk_by_mut(|&a, &b| at(a) == at(b)).enumerate() {
        watch.poll_at(step)?;
        let corner = at(here[0]);
        // Counter-clockwise from the direction to the right, which is not part of the turn.
        let is_lower = |end: u32| far(end)[1] < corner[1] || (far(end)[1] == corner[1] && far(end)[0] > corner[0]);
        let is_right = |end: u32| far(end)[1] == corner[1] && far(end)[0] > corner[0];
        here.sort_by(|&a, &b| {
            let key = |end: u32| (!is_right(end), is_lower(end) && !is_right(end));
            let turn = || orientation(corner, far(b), far(a)).partial_cmp(&0.0).unwrap_or(std::cmp::Ordering::Equal);
            key(a).cmp(&key(b)).then_with(turn).then(a.cmp(&b))
        });
        // The wedge that holds the direction right and up by next to nothing is the one asked for at the corner itself.
        let first = usize::from(is_right(here[0]));
        let count = here.len();
        let is_inside = region.contains(corner);
        for i in 0..count {
            // Wedges that alternate, the one before `first` being known: from `from`, counter-clockwise, to `to`.
            let (from, to) = (here[(first + i + count - 1) % count], here[(first + i) % count]);
            if is_inside == (i % 2 == 0) {
                next[from as usize] = (to << 1) | 1;
                next[to as usize] = from << 1;
            }
        }
    }
    Ok(next)
}
