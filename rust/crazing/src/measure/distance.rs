//! The exact distance of every pixel to the nearest one that is no crack.

use super::Mask;

/// Squared distances between centres of pixels, in pixels; beyond the picture all is crack, so that a crack cut by the
/// edge keeps its width.
///
/// # Source
/// Meijster, Roerdink, Hesselink: A general algorithm for computing distance transforms in linear time (2000).
pub(super) fn squared_distances(mask: &Mask) -> Vec<i64> {
    let mut down = vec![(mask.height + mask.width) as i64; mask.pixels.len()];
    lower(mask, &mut down, 0..mask.height);
    lower(mask, &mut down, (0..mask.height).rev());
    for row in down.chunks_mut(mask.width.max(1)) {
        across(row);
    }
    down
}

/// From distances along columns to squared distances, for one row. Beyond a pixel that is no crack nothing is nearer,
/// so every run of crack is looked at alone, with the pixels that end it.
fn across(row: &mut [i64]) {
    let mut at = 0;
    while at < row.len() {
        let stop = row[at..].iter().position(|&height| height == 0).map_or(row.len(), |run| at + run);
        if stop > at {
            let from = at.saturating_sub(1);
            let found = envelope(&row[from..row.len().min(stop + 1)]);
            row[at..stop].copy_from_slice(&found[at - from..stop - from]);
        }
        at = stop + 1;
    }
}

/// Lowers the distance of every pixel to one more than that of the pixel in the row before it.
fn lower(mask: &Mask, down: &mut [i64], rows: impl Iterator<Item = usize>) {
    let mut run = vec![(mask.height + mask.width) as i64; mask.width];
    for row in rows {
        let here = row * mask.width..(row + 1) * mask.width;
        for ((steps, found), &crack) in run.iter_mut().zip(&mut down[here.clone()]).zip(&mask.pixels[here]) {
            *steps = if crack { (*steps + 1).min(*found) } else { 0 };
            *found = *steps;
        }
    }
}

/// The lower envelope of parabolas, one above each column.
fn envelope(heights: &[i64]) -> Vec<i64> {
    let value = |x: i64, at: usize| (x - at as i64).pow(2) + heights[at].pow(2);
    // Columns whose parabola is lowest somewhere, and where each begins to be.
    let mut lowest: Vec<(usize, i64)> = Vec::new();
    for at in 0..heights.len() {
        while lowest.last().is_some_and(|&(top, from)| value(from, top) > value(from, at)) {
            lowest.pop();
        }
        match lowest.last() {
            None => lowest.push((at, 0)),
            Some(&(top, _)) => {
                let (a, b) = (top as i64, at as i64);
                let meeting = 1 + (b * b - a * a + heights[at].pow(2) - heights[top].pow(2)).div_euclid(2 * (b - a));
                if meeting < heights.len() as i64 {
                    lowest.push((at, meeting));
                }
            }
        }
    }
    let mut found = vec![0; heights.len()];
    for x in (0..heights.len()).rev() {
        while lowest.last().is_some_and(|&(_, from)| from > x as i64) {
            lowest.pop();
        }
        found[x] = lowest.last().map_or(0, |&(at, _)| value(x as i64, at));
    }
    found
}
