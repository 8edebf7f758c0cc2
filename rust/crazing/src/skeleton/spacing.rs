//! How far apart samples stand, by the diagram alone.

use super::cost::distance;
use crate::diagram::DiagramView;
use crate::graph::Point;
use crate::incidence::Incidence;

/// The spacing at every site: the geometric mean of its two shortest edges, smoothed once along the crust.
pub(super) fn spacing(view: DiagramView<'_>, sites: &[Point], about: &Incidence, crust: &[bool]) -> Vec<f64> {
    let other = |k: u32, v: usize| {
        let [a, b] = view.edges[k as usize].map(|end| end as usize);
        if a == v { b } else { a }
    };
    let near: Vec<f64> = (0..sites.len())
        .map(|v| shortest(about.at(v).iter().map(|&k| distance(sites[v], sites[other(k, v)]))))
        .map(|[first, second]| 0.5 * (libm::log(first) + libm::log(second)))
        .collect();
    let smoothed = |v: usize| {
        let along = about.at(v).iter().filter(|&&k| crust[k as usize]).map(|&k| near[other(k, v)]);
        let (sum, count) = along.fold((near[v], 1.0), |(sum, count), log| (sum + log, count + 1.0));
        libm::exp(sum / count)
    };
    (0..sites.len()).map(smoothed).collect()
}

/// The two smallest of at least two lengths.
fn shortest(lengths: impl Iterator<Item = f64>) -> [f64; 2] {
    lengths.fold([f64::INFINITY; 2], |[first, second], length| [first.min(length), second.min(first.max(length))])
}
