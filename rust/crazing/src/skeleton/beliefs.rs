//! Which edges the cheapest curve has, as far as sites can find out by talking to their neighbours.
//!
//! Every site would have the two edges that cost least, turn included, and tells the other end of each edge how much
//! dearer its best choice is with that edge than without. Told to and fro, this becomes what the neighbourhood thinks.
//! All sites speak at once, so the answer does not depend on their order.

use super::candidates::Candidates;
use super::cost;
use crate::error::Result;
use crate::parallel;
use crate::watch::Watch;

/// Edges of a site that are thought of: the cheapest.
const THOUGHT_OF: usize = 12;
/// Most rounds. What has not settled by then swings on.
const ROUNDS: usize = 100;
/// Sites that speak between two questions whether to go on.
const AT_A_TIME: usize = 1 << 15;
/// Changes below this are none.
const SETTLED: f64 = 1e-3;
/// Part of what was said before that is kept: two ends that contradict each other would swing without end.
const KEPT: f64 = 0.5;
/// More than a site can gain by any choice.
const SURE: f64 = 50.0;

/// What the two ends say of every edge.
type Said = Vec<[f64; 2]>;

/// A site with a say: its edges and the cost of having two of them.
struct Listener {
    /// Edge, and which of its ends the site is.
    ends: Vec<(u32, usize)>,
    /// Cost of the pairs (0, 1), (0, 2), (1, 2), (0, 3) ...
    pairs: Vec<f64>,
}

/// How much dearer the curve is with each edge than without, where the active sites have a say and all others keep what
/// is chosen. `pair` is the cost of two edges at a site.
///
/// # Errors
/// [`crate::Error::Interrupted`].
pub(super) fn beliefs(
    net: &Candidates,
    price: &[f64],
    active: &[bool],
    chosen: &[bool],
    pair: impl Fn(usize, [u32; 2]) -> f64 + Sync + Send,
    watch: Watch<'_>,
) -> Result<Vec<f64>> {
    let sites: Vec<usize> = (0..active.len()).filter(|&v| active[v]).collect();
    let mut listeners = Vec::with_capacity(sites.len());
    for part in sites.chunks(AT_A_TIME) {
        watch.poll()?;
        listeners.extend(parallel::map(part.len(), |i| Listener::of(net, price, part[i], &pair)));
    }
    let silent = |k: usize, end: i32| if chosen[k] && !active[end as usize] { -SURE } else { SURE };
    let mut said: Said = net.edges.iter().enumerate().map(|(k, ends)| ends.map(|end| silent(k, end))).collect();
    listeners.iter().flat_map(|listener| &listener.ends).for_each(|&(k, end)| said[k as usize][end] = 0.0);
    for _ in 0..ROUNDS {
        let mut answers = Vec::with_capacity(listeners.len());
        for part in listeners.chunks(AT_A_TIME) {
            watch.poll()?;
            answers.extend(parallel::map(part.len(), |i| part[i].answers(price, &said)));
        }
        if settled(&listeners, &answers, &mut said) {
            break;
        }
    }
    Ok(said.iter().zip(price).map(|([a, b], price)| a + b + price).collect())
}

/// Takes the answers in; true when that changes nothing.
fn settled(listeners: &[Listener], answers: &[Vec<f64>], said: &mut Said) -> bool {
    let mut most = 0.0_f64;
    for (listener, answers) in listeners.iter().zip(answers) {
        for (&(k, end), answer) in listener.ends.iter().zip(answers) {
            let old = &mut said[k as usize][end];
            most = most.max((answer - *old).abs());
            *old = KEPT * *old + (1.0 - KEPT) * answer;
        }
    }
    most < SETTLED
}

impl Listener {
    fn of(net: &Candidates, price: &[f64], v: usize, pair: impl Fn(usize, [u32; 2]) -> f64) -> Self {
        let mut edges = net.about.at(v).to_vec();
        edges.sort_by(|&a, &b| price[a as usize].total_cmp(&price[b as usize]));
        edges.truncate(THOUGHT_OF);
        let pairs = pairs(edges.len()).map(|[i, j]| pair(v, [edges[i], edges[j]])).collect();
        let ends = edges.into_iter().map(|k| (k, usize::from(net.edges[k as usize][1] == v as i32))).collect();
        Self { ends, pairs }
    }

    /// For each edge, how much dearer the best choice with it is than the best without, its own price and what is said
    /// of it left out.
    fn answers(&self, price: &[f64], said: &[[f64; 2]]) -> Vec<f64> {
        let heard: Vec<f64> = self.ends.iter().map(|&(k, end)| price[k as usize] + said[k as usize][1 - end]).collect();
        // An edge alone, and none.
        let mut with: Vec<f64> = heard.iter().map(|heard| heard + cost::FREE).collect();
        let (mut best, mut members) = (2.0 * cost::FREE, [usize::MAX; 2]);
        for (i, &cost) in with.iter().enumerate() {
            if cost < best {
                (best, members) = (cost, [i; 2]);
            }
        }
        for ([i, j], pair) in pairs(heard.len()).zip(&self.pairs) {
            let cost = heard[i] + heard[j] + pair;
            with[i] = with[i].min(cost);
            with[j] = with[j].min(cost);
            if cost < best {
                (best, members) = (cost, [i, j]);
            }
        }
        let without = |i: usize| if members.contains(&i) { self.best_without(i, &heard) } else { best };
        (0..heard.len()).map(|i| (with[i] - heard[i] - without(i)).clamp(-SURE, SURE)).collect()
    }

    fn best_without(&self, out: usize, heard: &[f64]) -> f64 {
        let alone = heard.iter().enumerate().filter(|&(i, _)| i != out).map(|(_, heard)| heard + cost::FREE);
        let both = pairs(heard.len()).zip(&self.pairs).filter(|(pair, _)| !pair.contains(&out));
        let both = both.map(|([i, j], pair)| heard[i] + heard[j] + pair);
        alone.chain(both).fold(2.0 * cost::FREE, f64::min)
    }
}

/// (0, 1), (0, 2), (1, 2), (0, 3) ... below a count.
fn pairs(count: usize) -> impl Iterator<Item = [usize; 2]> {
    (1..count).flat_map(|j| (0..j).map(move |i| [i, j]))
}
