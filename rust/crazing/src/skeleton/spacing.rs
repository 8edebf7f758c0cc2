//! How far apart samples stand, by the diagram alone.

use super::cost::distance;
use crate::diagram::DiagramView;
use crate::error::Result;
use crate::graph::Point;
use crate::incidence::Incidence;
use crate::parallel;
use crate::watch::Watch;

/// The spacing at every site: the geometric mean of its two shortest edges, smoothed once along the crust.
///
/// # Errors
/// [`crate::Error::Interrupted`].
pub(super) fn spacing(
    view: DiagramView<'_>,
    sites: &[Point],
    about: &Incidence,
    crust: &[bool],
    watch: Watch<'_>,
) -> Result<Vec<f64>> {
    let other = |k: u32, v: usize| {
        let [a, b] = view.edges[k as usize].map(|end| end as usize);
        if a == v { b } else { a }
    };
    let near = |v: usize| {
        let [first, second] = shortest(about.at(v).iter().map(|&k| distance(sites[v], sites[other(k, v)])));
        0.5 * (libm::log(first) + libm::log(second))
    };
    let near = parallel::map_watched(sites.len(), near, watch)?;
    let smoothed = |v: usize| {
        let along = about.at(v).iter().filter(|&&k| crust[k as usize]).map(|&k| near[other(k, v)]);
        let (sum, count) = along.fold((near[v], 1.0), |(sum, count), log| (sum + log, count + 1.0));
        libm::exp(sum / count)
    };
    parallel::map_watched(sites.len(), smoothed, watch)
}

/// The two smallest of at least two lengths.
fn shortest(lengths: impl Iterator<Item = f64>) -> [f64; 2] {
    lengths.fold([f64::INFINITY; 2], |[first, second], length| [first.min(length), second.min(first.max(length))])
}
