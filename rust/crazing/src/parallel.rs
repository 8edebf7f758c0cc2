//! Work on all cores, in a pool that lives as long as the call: a global pool would not survive a fork.

use std::ops::Range;

use rayon::iter::{IndexedParallelIterator, IntoParallelIterator, ParallelIterator};
use rayon::slice::ParallelSliceMut;

/// Fewer items than this are not worth waking threads for.
const WORTHWHILE: usize = 1 << 15;
/// Items that one of long work counts for.
const LONG: usize = 1 << 8;

/// Runs `many` in a pool of all cores, or `one` when there is little to do or no pool can be had.
fn choose<T: Send, A: Send>(len: usize, arg: A, one: impl FnOnce(A) -> T, many: impl FnOnce(A) -> T + Send) -> T {
    if len < WORTHWHILE {
        return one(arg);
    }
    match rayon::ThreadPoolBuilder::new().build() {
        Ok(pool) if pool.current_num_threads() > 1 => pool.install(|| many(arg)),
        _ => one(arg),
    }
}

/// Both results; `b` on a thread of its own when there are many items.
pub(crate) fn join<A, B: Send>(len: usize, a: impl FnOnce() -> A, b: impl FnOnce() -> B + Send) -> (A, B) {
    if len < WORTHWHILE {
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

/// `f` of ranges that make up `0..len`, in order: for work that would make a small vector an item.
pub(crate) fn ranges<T: Send>(len: usize, f: impl Fn(Range<usize>) -> T + Sync + Send) -> Vec<T> {
    const SIZE: usize = WORTHWHILE / 8;
    let range = |i: usize| i * SIZE..len.min((i + 1) * SIZE);
    let count = len.div_ceil(SIZE);
    choose(
        len,
        &f,
        |f| (0..count).map(|i| f(range(i))).collect(),
        |f| (0..count).into_par_iter().map(|i| f(range(i))).collect(),
    )
}

/// The same where each item is long work.
pub(crate) fn map_slow<T: Send>(len: usize, f: impl Fn(usize) -> T + Sync + Send) -> Vec<T> {
    choose(len.saturating_mul(LONG), &f, |f| (0..len).map(f).collect(), |f| (0..len).into_par_iter().map(f).collect())
}

/// The same where every single item is worth a thread.
pub(crate) fn several<T: Send>(len: usize, f: impl Fn(usize) -> T + Sync + Send) -> Vec<T> {
    let worth = if len > 1 { WORTHWHILE } else { 0 };
    choose(worth, &f, |f| (0..len).map(f).collect(), |f| (0..len).into_par_iter().map(f).collect())
}

/// `f` of each of `0..len`, in any order.
pub(crate) fn each(len: usize, f: impl Fn(usize) + Sync + Send) {
    choose(len, &f, |f| (0..len).for_each(f), |f| (0..len).into_par_iter().with_min_len(WORTHWHILE / 8).for_each(f));
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

/// `f` of each of some parts that hold `len` items in all, in any order.
pub(crate) fn parts<P: Send>(len: usize, parts: Vec<P>, f: impl Fn(P) + Sync + Send) {
    choose(len, (parts, f), |(parts, f)| parts.into_iter().for_each(f), |(parts, f)| parts.into_par_iter().for_each(f));
}

/// Sorts; equal keys cannot be told apart, so the result does not depend on the number of threads.
pub(crate) fn sort<T: Ord + Send>(keys: &mut [T]) {
    choose(keys.len(), keys, |keys| keys.sort_unstable(), |keys| keys.par_sort_unstable());
}
