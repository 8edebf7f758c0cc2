//! Tables whose rows are written in any order, by all cores.

use std::sync::atomic::{AtomicI32, Ordering::Relaxed};

use crate::parallel::{each, map};

/// Row `i` of `f` at `places[i]`, for places that are `0..places.len()` in some order.
pub(crate) fn scatter<const N: usize>(places: &[u32], f: impl Fn(usize) -> [i32; N] + Sync + Send) -> Vec<[i32; N]> {
    scatter_both(places, |i| (f(i), [])).0
}

/// The same of two tables.
pub(crate) fn scatter_both<const A: usize, const B: usize>(
    places: &[u32],
    f: impl Fn(usize) -> ([i32; A], [i32; B]) + Sync + Send,
) -> (Vec<[i32; A]>, Vec<[i32; B]>) {
    fn empty<const N: usize>(len: usize) -> Vec<[AtomicI32; N]> {
        map(len, |_| [const { AtomicI32::new(0) }; N])
    }
    // Each is written once, by whoever comes to its row: in any order, the table is the same.
    fn store<const N: usize>(slots: &[AtomicI32; N], row: [i32; N]) {
        for (slot, value) in slots.iter().zip(row) {
            slot.store(value, Relaxed);
        }
    }
    fn filled<const N: usize>(slots: Vec<[AtomicI32; N]>) -> Vec<[i32; N]> {
        slots.into_iter().map(|row| row.map(AtomicI32::into_inner)).collect()
    }
    let (a, b) = (empty(places.len()), empty(places.len()));
    each(places.len(), |i| {
        let (place, rows) = (places[i] as usize, f(i));
        store(&a[place], rows.0);
        store(&b[place], rows.1);
    });
    (filled(a), filled(b))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Few and many: with one thread and with all.
    const SIZES: [usize; 4] = [0, 1, 1000, 100_000];

    #[test]
    fn scattered_rows_stand_at_their_places() {
        for len in SIZES {
            // 7 divides none of the sizes, so this is a permutation.
            let places: Vec<u32> = (0..len).map(|i| (7 * i % len) as u32).collect();
            let found = scatter(&places, |i| [i as i32, -(i as i32)]);
            assert_eq!(found.len(), len);
            assert!(places.iter().enumerate().all(|(i, &at)| found[at as usize] == [i as i32, -(i as i32)]));
            let (first, second) = scatter_both(&places, |i| ([i as i32], [-(i as i32), 7]));
            assert!(first.iter().zip(&second).zip(&found).all(|((a, b), row)| [a[0], b[0]] == *row && b[1] == 7));
            assert_eq!(second.len(), len);
        }
    }
}
