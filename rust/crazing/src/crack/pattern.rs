//! Patterns: cracks with their widths, the last drawing of a recipe.

use super::net::{Ends, NONE, Net, NetView};
use super::roughen::Trace;
use super::roughen::pieces::{pieces_of, repeated, shifts_of};
use super::strand::{Runs, followed};
use super::width::{Profile, widen};
use crate::error::Result;
use crate::parallel;
use crate::rng::Key;
use crate::watch::Watch;

/// Cracks with their widths.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Pattern {
    /// The cracks; on a torus, vertices lie in the period.
    pub net: Net,
    /// What they are like, edge by edge.
    pub looks: Looks,
}

/// What cracks are like, edge by edge.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Looks {
    /// Width at both ends.
    pub widths: Vec<[f64; 2]>,
    /// See [`super::Strands::of_edge`].
    pub strand: Vec<i32>,
    /// See [`super::Strands::generation`].
    pub generation: Vec<i32>,
    /// The strand that the strand of the edge abuts, or -1.
    pub parent: Vec<i32>,
}

/// The widths and strands of a drawing; `partner` is what [`super::pairs`] gives, `age` is that of [`super::strands`].
///
/// `origin` is the edge that each piece is of, as [`super::Rough`] has it: pieces of one edge follow one another, and
/// lengths are those of whole edges, however far their pieces wander. Empty where edges are whole.
///
/// # Errors
/// [`crate::Error::BadValue`], [`crate::Error::Interrupted`].
pub fn looks(
    net: NetView<'_>,
    partner: &[i32],
    age: &[i32],
    origin: &[i32],
    (profile, key): (Profile, Key),
    watch: Watch<'_>,
) -> Result<Looks> {
    let starts = starts(net.edges.len(), origin);
    let edges = starts.len() - 1;
    let end_of = |end: i32| match end {
        NONE => NONE,
        _ => 2 * (starts.partition_point(|&start| start <= end as usize / 2) - 1) as i32 + end % 2,
    };
    let outer = |k: usize| [(starts[k], 0), (starts[k + 1] - 1, 1)];
    let crossed = |k: usize| {
        let shifts = net.shifts.get(starts[k]..starts[k + 1]).unwrap_or_default().iter();
        shifts.fold([0_i8; 2], |sum, shift| [0, 1].map(|axis| sum[axis].saturating_add(shift[axis])))
    };
    let whole: Vec<[i32; 2]> = (0..edges).map(|k| outer(k).map(|(piece, side)| net.edges[piece][side])).collect();
    let shifts: Vec<[i8; 2]> = (0..if net.shifts.is_empty() { 0 } else { edges }).map(crossed).collect();
    let partner: Vec<i32> =
        (0..edges).flat_map(|k| outer(k).map(|(piece, side)| end_of(partner[2 * piece + side]))).collect();
    let age: Vec<i32> = starts[..edges].iter().filter_map(|&piece| age.get(piece).copied()).collect();
    let whole = NetView { edges: &whole, shifts: &shifts, ..net };
    looks_of(net, (whole, None), &starts, (Runs::of(&partner), &age), (profile, key), watch)
}

/// Where the pieces of each edge start, and the end.
fn starts(pieces: usize, origin: &[i32]) -> Vec<usize> {
    let is_first = |k: usize| k == 0 || origin.is_empty() || origin[k] != origin[k - 1];
    (0..pieces).filter(|&k| is_first(k)).chain([pieces]).collect()
}

/// The same of edges that `starts` says the pieces of; `net` has the pieces. `ends` where it is known who meets where.
fn looks_of(
    net: NetView<'_>,
    (whole, ends): (NetView<'_>, Option<Ends>),
    starts: &[usize],
    (runs, age): (Runs, &[i32]),
    (profile, key): (Profile, Key),
    watch: Watch<'_>,
) -> Result<Looks> {
    let (mut strands, older) = followed(whole, ends.as_ref(), runs, age);
    drop(ends);
    watch.poll()?;
    let (widths, (generation, parent)) = if profile.shrink == 1.0 {
        // One generation after the other, on one thread: widths that do not depend on it are found meanwhile.
        let widen = || widen(net, whole, starts, &strands, &profile, key);
        parallel::join(whole.edges.len(), widen, || older.descend(&strands.run))
    } else {
        let found = older.descend(&strands.run);
        strands.generation = parallel::map(whole.edges.len(), |k| found.0[strands.of_edge[k] as usize]);
        (widen(net, whole, starts, &strands, &profile, key), found)
    };
    let widths = widths?;
    watch.poll()?;
    drop(older);
    let of_edge = strands.into_of_edge();
    let strand = repeated(starts, |k| of_edge[k]);
    watch.poll()?;
    let generation = repeated(starts, |k| generation[of_edge[k] as usize]);
    watch.poll()?;
    let parent = repeated(starts, |k| parent[of_edge[k] as usize]);
    Ok(Looks { widths, strand, generation, parent })
}

/// The pattern of a drawing whose edges lie as a trace says.
pub(super) fn finished(
    net: NetView<'_>,
    trace: Trace,
    runs: (Runs, &[i32]),
    widths: (Profile, Key),
    watch: Watch<'_>,
) -> Result<Pattern> {
    let Trace { vertices, starts, ends } = trace;
    let whole = NetView { vertices: &vertices[..net.vertices.len()], ..net };
    let (edges, shifts) = (pieces_of(net, &starts), shifts_of(net, &starts));
    watch.poll()?;
    let fine = NetView { vertices: &vertices, edges: &edges, shifts: &shifts, ..net };
    let looks = looks_of(fine, (whole, ends), &starts, runs, widths, watch)?;
    watch.poll()?;
    let mut net = Net { vertices, edges, shifts, period: net.period, cut: Vec::new() };
    net.wrap();
    Ok(Pattern { net, looks })
}
