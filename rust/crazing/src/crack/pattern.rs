//! Patterns: cracks with their widths, the last drawing of a recipe.

use super::net::{Ends, NONE, Net, NetView};
use super::roughen::Trace;
use super::roughen::pieces::{pieces_of, repeated, shifts_of};
use super::strand::{Pieces, Runs, of_pieces};
use super::width::{Profile, spans, widen};
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
/// Edges of which one follows the other, as the pieces of rough ones do, are looked at as one.
///
/// # Errors
/// [`crate::Error::BadValue`], [`crate::Error::Interrupted`].
pub fn looks(
    net: NetView<'_>,
    partner: &[i32],
    age: &[i32],
    profile: Profile,
    key: Key,
    watch: Watch<'_>,
) -> Result<Looks> {
    let starts = chains(net, partner);
    let chains = starts.len() - 1;
    let end_of = |end: i32| match end {
        NONE => NONE,
        _ => 2 * (starts.partition_point(|&start| start <= end as usize / 2) - 1) as i32 + end % 2,
    };
    let outer = |k: usize| [(starts[k], 0), (starts[k + 1] - 1, 1)];
    let edges: Vec<[i32; 2]> = (0..chains).map(|k| outer(k).map(|(edge, side)| net.edges[edge][side])).collect();
    let partner: Vec<i32> =
        (0..chains).flat_map(|k| outer(k).map(|(edge, side)| end_of(partner[2 * edge + side]))).collect();
    let age: Vec<i32> = starts[..chains].iter().filter_map(|&edge| age.get(edge).copied()).collect();
    let whole = NetView { edges: &edges, shifts: &[], ..net };
    looks_of(net, (whole, None), &starts, (Runs::of(&partner), &age), (profile, key), watch)
}

/// The first edges of chains, and the end: edges that follow one another and meet at vertices where nothing else is.
fn chains(net: NetView<'_>, partner: &[i32]) -> Vec<usize> {
    let degrees = net.degrees();
    let goes_on = |k: usize| {
        let (near, far) = (2 * k - 1, 2 * k);
        let vertex = net.vertex(far as u32);
        partner[near] == far as i32
            && partner[far] == near as i32
            && degrees[vertex] == 2
            && net.vertex(near as u32) == vertex
    };
    let edges = net.edges.len();
    (0..edges).filter(|&k| k == 0 || !goes_on(k)).chain([edges]).collect()
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
    let mut widths = spans(net);
    watch.poll()?;
    let pieces = Pieces { starts, span: |piece: usize| widths[piece][0] };
    let (mut strands, older) = of_pieces(whole, ends.as_ref(), runs, age, &pieces);
    drop(ends);
    watch.poll()?;
    let (generation, parent) = if profile.shrink == 1.0 {
        // One generation after the other, on one thread: widths that do not depend on it are found meanwhile.
        let widen = || widen(net, whole, starts, &strands, &profile, key, &mut widths);
        let (done, found) = parallel::join(whole.edges.len(), widen, || older.descend(&strands.run));
        done?;
        found
    } else {
        let found = older.descend(&strands.run);
        strands.generation = parallel::map(whole.edges.len(), |k| found.0[strands.of_edge[k] as usize]);
        widen(net, whole, starts, &strands, &profile, key, &mut widths)?;
        found
    };
    watch.poll()?;
    drop(older);
    let of_edge = strands.into_of_edge();
    Ok(Looks {
        widths,
        strand: repeated(starts, |k| of_edge[k]),
        generation: repeated(starts, |k| generation[of_edge[k] as usize]),
        parent: repeated(starts, |k| parent[of_edge[k] as usize]),
    })
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
    let fine = NetView { vertices: &vertices, edges: &edges, shifts: &shifts, ..net };
    let looks = looks_of(fine, (whole, ends), &starts, runs, widths, watch)?;
    let mut net = Net { vertices, edges, shifts, period: net.period, cut: Vec::new() };
    net.wrap();
    Ok(Pattern { net, looks })
}
