//! Long work on all cores: few items are worth threads, and each may use something that is made for many.

use rayon::iter::{IntoParallelIterator, ParallelIterator};

use super::{WORTHWHILE, choose};

/// Items that one of long work counts for.
const LONG: usize = 1 << 8;

/// `f` of `0..len`, in order.
pub(crate) fn map_slow<T: Send>(len: usize, f: impl Fn(usize) -> T + Sync + Send) -> Vec<T> {
    map_slow_with(len, LONG, || (), |(), i| f(i))
}

/// The same with something that is made now and then, and used for many items, each worth so many short ones.
pub(crate) fn map_slow_with<S, T: Send>(
    len: usize,
    each: usize,
    make: impl Fn() -> S + Sync + Send,
    f: impl Fn(&mut S, usize) -> T + Sync + Send,
) -> Vec<T> {
    with(len, len.saturating_mul(each), make, f)
}

/// The same where every single item is worth a thread.
pub(crate) fn several<T: Send>(len: usize, f: impl Fn(usize) -> T + Sync + Send) -> Vec<T> {
    several_with(len, || (), |(), i| f(i))
}

/// The same with something that is made now and then, and used for many items.
pub(crate) fn several_with<S, T: Send>(
    len: usize,
    make: impl Fn() -> S + Sync + Send,
    f: impl Fn(&mut S, usize) -> T + Sync + Send,
) -> Vec<T> {
    with(len, if len > 1 { WORTHWHILE } else { 0 }, make, f)
}

/// The same where the items are worth `worth` in all.
fn with<S, T: Send>(
    len: usize,
    worth: usize,
    make: impl Fn() -> S + Sync + Send,
    f: impl Fn(&mut S, usize) -> T + Sync + Send,
) -> Vec<T> {
    choose(
        worth,
        (make, f),
        |(make, f)| {
            let mut made = make();
            (0..len).map(|i| f(&mut made, i)).collect()
        },
        |(make, f)| (0..len).into_par_iter().map_init(make, f).collect(),
    )
}
