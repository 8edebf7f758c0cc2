//! The spacing of plates: what the lengths of a recipe are parts of.

use super::net::length;
use crate::graph::Point;
use crate::parallel;

/// The median length of edges between sites, 0 without any; `shifts` are the periods each crosses, none in the plane.
/// The mean would follow far outliers.
pub fn spacing(sites: &[Point], edges: &[[i32; 2]], shifts: &[[i8; 2]], period: Point) -> f64 {
    let mut lengths = parallel::map(edges.len(), |k| {
        let [p, q] = edges[k].map(|site| sites[site as usize]);
        let shift = shifts.get(k).copied().unwrap_or_default();
        length([0, 1].map(|i| q[i] - p[i] + f64::from(shift[i]) * period[i]))
    });
    if lengths.is_empty() {
        return 0.0;
    }
    let middle = lengths.len() / 2;
    let is_even = lengths.len().is_multiple_of(2);
    let (below, &mut upper, _) = lengths.select_nth_unstable_by(middle, f64::total_cmp);
    let lower = below.iter().copied().fold(0.0, f64::max);
    if is_even { lower / 2.0 + upper / 2.0 } else { upper }
}

#[cfg(test)]
mod tests {
    use super::spacing;

    #[test]
    fn the_median_is_the_middle_or_between_the_two() {
        let sites = [[0.0, 0.0], [3.0, 4.0], [0.0, 1.0], [7.0, 0.0]];
        assert_eq!(spacing(&sites, &[], &[], [0.0; 2]), 0.0);
        assert_eq!(spacing(&sites, &[[0, 1], [0, 2], [0, 3]], &[], [0.0; 2]), 5.0);
        assert_eq!(spacing(&sites, &[[0, 1], [2, 0], [0, 3], [2, 0]], &[], [0.0; 2]), 3.0);
        // On a torus of width 8 the far one is next door.
        assert_eq!(spacing(&sites, &[[0, 3]], &[[-1, 0]], [8.0, 8.0]), 1.0);
    }
}
