//! Work on all cores, in a pool that lives as long as the call: a global pool would not survive a fork.

mod slow;

use std::cell::RefCell;
use std::ops::Range;
use std::rc::Rc;

use rayon::iter::{IndexedParallelIterator, IntoParallelIterator, IntoParallelRefMutIterator, ParallelIterator};
use rayon::slice::ParallelSliceMut;
use rayon::{ThreadPool, ThreadPoolBuilder};

pub(crate) use slow::{map_slow, map_slow_with, several, several_with};

use crate::error::Result;
use crate::watch::Watch;

/// Fewer items than this are not worth waking threads for.
const WORTHWHILE: usize = 1 << 15;

/// A call that is under way on this thread, if any.
#[derive(Clone, Default)]
struct Call {
    is_on: bool,
    /// Threads it may have; 0 for one a core.
    threads: usize,
    /// As soon as it needs one.
    pool: Option<Rc<ThreadPool>>,
}

thread_local! {
    static CALL: RefCell<Call> = const { RefCell::new(Call { is_on: false, threads: 0, pool: None }) };
}

/// Does `work` with one pool for all of it: to make one takes as long as to look at ten thousand items.
///
/// A call within a call, as from the handler of a signal that the watch lets in, has a pool of its own: the handler may
/// have forked, and threads do not come along.
pub fn in_one_pool<T>(work: impl FnOnce() -> T) -> T {
    in_pool_of(0, work)
}

/// The same, with so many threads; 0 is one a core.
pub fn in_pool_of<T>(threads: usize, work: impl FnOnce() -> T) -> T {
    /// Panics come by here, too.
    struct End(Call);
    impl Drop for End {
        fn drop(&mut self) {
            CALL.replace(std::mem::take(&mut self.0));
        }
    }
    let _end = End(CALL.replace(Call { is_on: true, threads, pool: None }));
    work()
}

/// The pool of the call, or a new one outside of any; none where one thread is all that is wanted.
fn pool() -> Option<Rc<ThreadPool>> {
    let call = CALL.with_borrow(Clone::clone);
    if call.threads == 1 {
        return None;
    }
    let new = || ThreadPoolBuilder::new().num_threads(call.threads).build().ok().map(Rc::new);
    let pool = call.pool.or_else(new);
    if call.is_on {
        CALL.with_borrow_mut(|call| call.pool.clone_from(&pool));
    }
    pool
}

/// Runs `many` in a pool of all cores, or `one` when there is little to do or no pool can be had.
fn choose<T: Send, A: Send>(len: usize, arg: A, one: impl FnOnce(A) -> T, many: impl FnOnce(A) -> T + Send) -> T {
    if len < WORTHWHILE {
        return one(arg);
    }
    if rayon::current_thread_index().is_some() {
        return many(arg);
    }
    match pool() {
        Some(pool) if pool.current_num_threads() > 1 => pool.install(|| many(arg)),
        _ => one(arg),
    }
}

/// Both results; `b` on a thread of its own when there are many items.
pub(crate) fn join<A, B: Send>(len: usize, a: impl FnOnce() -> A, b: impl FnOnce() -> B + Send) -> (A, B) {
    if len < WORTHWHILE || CALL.with_borrow(|call| call.threads == 1) {
        return (a(), b());
    }
    std::thread::scope(|scope| {
        let other = scope.spawn(b);
        (a(), other.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)))
    })
}

/// `f` of `0..len`, in order.
pub(crate) fn map<T: Send>(len: usize, f: impl Fn(usize) -> T + Sync + Send) -> Vec<T> {
    choose(
        len,
        &f,
        |f| (0..len).map(f).collect(),
        |f| (0..len).into_par_iter().with_min_len(WORTHWHILE / 8).map(f).collect(),
    )
}

/// `f` of `0..len`, in order, asked between parts whether to go on: only the thread that called may be told to stop.
pub(crate) fn map_watched<T: Send>(
    len: usize,
    f: impl Fn(usize) -> T + Sync + Send,
    watch: Watch<'_>,
) -> Result<Vec<T>> {
    let mut found = Vec::with_capacity(len);
    while found.len() < len {
        watch.poll()?;
        let start = found.len();
        found.extend(map(WORTHWHILE.min(len - start), |i| f(start + i)));
    }
    Ok(found)
}

/// `f` of ranges that make up `0..len`, in order: for work that would make a small vector an item.
pub(crate) fn ranges<T: Send>(len: usize, f: impl Fn(Range<usize>) -> T + Sync + Send) -> Vec<T> {
    let all: Vec<Range<usize>> = all_ranges(len).collect();
    choose(len, (all, &f), |(all, f)| all.into_iter().map(f).collect(), |(all, f)| all.into_par_iter().map(f).collect())
}

pub(crate) fn all_ranges(len: usize) -> impl Iterator<Item = Range<usize>> {
    const SIZE: usize = WORTHWHILE / 8;
    (0..len.div_ceil(SIZE)).map(move |i| i * SIZE..len.min((i + 1) * SIZE))
}

/// `f` of ranges that make up `0..len`, each with the part of `found` that is its own: item by item, where one thread
/// has several under way at once. What it gives of each range, in order.
pub(crate) fn fill<T: Send, R: Send>(found: &mut [T], f: impl Fn(Range<usize>, &mut [T]) -> R + Sync + Send) -> Vec<R> {
    const SIZE: usize = WORTHWHILE / 8;
    let part = |i: usize, part: &mut [T]| f(i * SIZE..i * SIZE + part.len(), part);
    choose(
        found.len(),
        found,
        |found| found.chunks_mut(SIZE).enumerate().map(|(i, found)| part(i, found)).collect(),
        |found| found.par_chunks_mut(SIZE).enumerate().map(|(i, found)| part(i, found)).collect(),
    )
}

/// What `keep` gives of each of `0..len`, in order. It is asked twice: how many there are is not seen from outside, and
/// growing a table is dearer.
pub(crate) fn compact<T: Send + Copy + Default>(len: usize, keep: impl Fn(usize) -> Option<T> + Sync + Send) -> Vec<T> {
    let counts = ranges(len, |range| range.filter(|&i| keep(i).is_some()).count());
    compact_counted(len, &counts, keep)
}

/// The same where it is known how many there are in each of the [`ranges`].
pub(crate) fn compact_counted<T: Send + Copy + Default>(
    len: usize,
    counts: &[usize],
    keep: impl Fn(usize) -> Option<T> + Sync + Send,
) -> Vec<T> {
    let mut found = vec![T::default(); counts.iter().sum()];
    let mut rest = found.as_mut_slice();
    let mut parts = Vec::with_capacity(counts.len());
    for (range, &count) in all_ranges(len).zip(counts) {
        let part;
        (part, rest) = rest.split_at_mut(count);
        parts.push((range, part));
    }
    let write = |(range, part): (Range<usize>, &mut [T])| {
        // Every item is written, and the next over it if it is not kept: whether it is cannot be foretold.
        let mut next = 0;
        for kept in range.map(&keep) {
            if let Some(slot) = part.get_mut(next) {
                *slot = kept.unwrap_or_default();
            }
            next += usize::from(kept.is_some());
        }
    };
    choose(len, parts, |parts| parts.into_iter().for_each(write), |parts| parts.into_par_iter().for_each(write));
    found
}

/// `f` of each of `0..len`, in any order.
pub(crate) fn each(len: usize, f: impl Fn(usize) + Sync + Send) {
    choose(len, &f, |f| (0..len).for_each(f), |f| (0..len).into_par_iter().with_min_len(WORTHWHILE / 8).for_each(f));
}

/// `f` of every item, in any order.
pub(crate) fn alter<T: Send>(items: &mut [T], f: impl Fn(&mut T) + Sync + Send) {
    fill(items, |_, items| items.iter_mut().for_each(&f));
}

/// `f` of every item and the one in the same place of another table.
pub(crate) fn alter_both<A: Send, B: Send>(a: &mut [A], b: &mut [B], f: impl Fn(&mut A, &mut B) + Sync + Send) {
    choose(
        a.len(),
        (a, b),
        |(a, b)| a.iter_mut().zip(b).for_each(|(a, b)| f(a, b)),
        |(a, b)| a.par_iter_mut().zip(b).with_min_len(WORTHWHILE / 8).for_each(|(a, b)| f(a, b)),
    );
}

/// The first of `0..len` that `f` holds for.
pub(crate) fn first(len: usize, f: impl Fn(usize) -> bool + Sync + Send) -> Option<usize> {
    choose(
        len,
        &f,
        |f| (0..len).find(|&i| f(i)),
        |f| (0..len).into_par_iter().with_min_len(WORTHWHILE / 8).find_first(|&i| f(i)),
    )
}

/// Slices of so many items each, one after the other.
pub(crate) fn shared<T>(mut all: &mut [T], counts: impl Iterator<Item = usize>) -> impl Iterator<Item = &mut [T]> {
    counts.map(move |count| {
        let (part, rest) = std::mem::take(&mut all).split_at_mut(count);
        all = rest;
        part
    })
}

/// `f` of ranges that make up `0..len`, each with the items of its own: those of `i` are the ones from `start(i)` to
/// `start(i + 1)`.
pub(crate) fn grouped<T: Send>(
    len: usize,
    start: impl Fn(usize) -> usize,
    items: &mut [T],
    f: impl Fn(Range<usize>, &mut [T]) + Sync + Send,
) {
    let (count, sizes) = (items.len(), all_ranges(len).map(|range| start(range.end) - start(range.start)));
    let all = all_ranges(len).zip(shared(items, sizes)).collect();
    parts(count, all, |(range, items)| f(range, items));
}

/// `f` of each of some parts that hold `len` items in all, in any order.
pub(crate) fn parts<P: Send>(len: usize, parts: Vec<P>, f: impl Fn(P) + Sync + Send) {
    choose(len, (parts, f), |(parts, f)| parts.into_iter().for_each(f), |(parts, f)| parts.into_par_iter().for_each(f));
}

/// Sorts; equal keys cannot be told apart, so the result does not depend on the number of threads.
pub(crate) fn sort<T: Ord + Send>(keys: &mut [T]) {
    choose(keys.len(), keys, |keys| keys.sort_unstable(), |keys| keys.par_sort_unstable());
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use super::*;

    /// Few and many: with one thread and with all.
    const SIZES: [usize; 4] = [0, 1, 1000, 3 * WORTHWHILE + 17];

    /// The thread that works on the last of many items.
    fn hand() -> std::thread::ThreadId {
        *map(SIZES[3], |_| std::thread::current().id()).last().expect("there are many")
    }

    #[test]
    fn a_call_has_one_pool_and_a_call_within_it_another() {
        let own = |hands: Vec<std::thread::ThreadId>| HashSet::<_>::from_iter(hands);
        let threads = ThreadPoolBuilder::new().build().map_or(1, |pool| pool.current_num_threads());
        let many = || own((0..20).map(|_| hand()).collect());
        in_one_pool(|| {
            let before = many();
            let within = in_one_pool(many);
            let caught = std::panic::catch_unwind(|| in_one_pool(|| std::panic::resume_unwind(Box::new(()))));
            let after = many();
            assert!(caught.is_err());
            assert!(before.union(&after).count() <= threads);
            assert!(threads == 1 || before.union(&after).all(|hand| !within.contains(hand)));
        });
        assert!(CALL.with_borrow(|call| !call.is_on && call.pool.is_none()));
    }

    #[test]
    fn a_call_has_no_more_threads_than_it_may() {
        let own = || (0..20).map(|_| hand()).collect::<HashSet<_>>();
        let me = std::thread::current().id();
        assert_eq!(in_pool_of(1, own), HashSet::from([me]));
        let (mine, other) = in_pool_of(1, || join(SIZES[3], own, || std::thread::current().id()));
        assert_eq!((mine, other), (HashSet::from([me]), me));
        let three = in_pool_of(3, own);
        assert!(three.len() <= 3 && !three.contains(&me));
    }

    #[test]
    fn calls_of_several_threads_do_not_meet() {
        let sums = std::thread::scope(|scope| {
            let hired: Vec<_> = (0..4).map(|_| scope.spawn(|| in_one_pool(nested))).collect();
            hired.into_iter().map(|hand| hand.join().expect("no thread panics")).collect::<Vec<_>>()
        });
        assert!(sums.iter().all(|sum| *sum == nested()));
    }

    /// Many in each of several.
    fn nested() -> Vec<usize> {
        several(3, |i| map(SIZES[3], |j| i * j).into_iter().sum())
    }

    #[test]
    fn what_is_kept_stays_in_order() {
        for len in SIZES {
            let kept = |i: usize| (i % 3 == 1).then_some(i);
            assert_eq!(compact(len, kept), (0..len).filter_map(kept).collect::<Vec<_>>());
        }
    }

    #[test]
    fn every_part_is_filled_and_altered_once() {
        for len in SIZES {
            let (mut found, mut other) = (vec![0; len], vec![1; len]);
            fill(&mut found, |range, part| part.iter_mut().zip(range).for_each(|(slot, i)| *slot += i));
            alter(&mut found, |value| *value += 1);
            alter_both(&mut found, &mut other, |a, b| (*a, *b) = (*a + *b, *a));
            assert!((0..len).all(|i| (found[i], other[i]) == (i + 2, i + 1)));
        }
    }
}
