//! Cells that wait to be split.

use std::cmp::Ordering;
use std::collections::{BTreeMap, BinaryHeap};

/// Bits of a size that bins do not tell apart: 16 bins from one size to twice of it.
const BIN_BITS: u32 = 48;

/// The largest first, of equal ones the one with the lowest number.
///
/// Only those of about the largest size are sorted, the others are kept as they come, in bins by size. So most of the
/// next are known ahead: what is put in among them comes from a heap.
pub(super) struct Queue {
    /// The largest last.
    sorted: Vec<Next>,
    heap: BinaryHeap<Next>,
    /// The least bin of those sorted or in the heap.
    least: i64,
    later: BTreeMap<i64, Vec<Next>>,
    /// So many of those sorted nobody has looked at ahead.
    unseen: usize,
}

impl Queue {
    pub(super) fn new() -> Self {
        Self { sorted: Vec::new(), heap: BinaryHeap::new(), least: i64::MAX, later: BTreeMap::new(), unseen: 0 }
    }

    pub(super) fn push(&mut self, size: f64, cell: usize) {
        let (next, bin) = (Next { size, cell: cell as u32 }, bin(size));
        if bin >= self.least {
            self.heap.push(next);
        } else {
            self.later.entry(bin).or_default().push(next);
        }
    }

    pub(super) fn pop(&mut self) -> Option<usize> {
        if self.sorted.is_empty() && self.heap.is_empty() {
            (self.least, self.sorted) = self.later.pop_last()?;
            self.sorted.sort_unstable();
            self.unseen = self.sorted.len();
        }
        // None is less than any.
        let next = if self.heap.peek() > self.sorted.last() { self.heap.pop() } else { self.sorted.pop() };
        next.map(|next| next.cell as usize)
    }

    /// Some of the next, before [`Self::pop`] gives the first of them; each once, and those of the heap never.
    pub(super) fn ahead(&mut self, count: usize) -> impl Iterator<Item = usize> {
        let end = self.sorted.len();
        let seen = if end > self.unseen { 0 } else { count.min(end) };
        self.unseen = self.unseen.min(end - seen);
        self.sorted[end - seen..].iter().map(|next| next.cell as usize)
    }
}

/// Grows with the size, in the order of [`f64::total_cmp`].
fn bin(size: f64) -> i64 {
    let bits = size.to_bits() as i64;
    (bits ^ ((bits >> 63) as u64 >> 1) as i64) >> BIN_BITS
}

struct Next {
    size: f64,
    cell: u32,
}

impl PartialEq for Next {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Next {}

impl PartialOrd for Next {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Next {
    fn cmp(&self, other: &Self) -> Ordering {
        self.size.total_cmp(&other.size).then(other.cell.cmp(&self.cell))
    }
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use super::*;
    use crate::rng::{Rng, stream};

    #[test]
    fn cells_come_as_from_one_heap() {
        let sizes = [0.0, -0.0, -1.0, 1e-300, f64::INFINITY, f64::NAN, 0.5, 0.5, 0.5, 0.75, 3.0];
        let (mut queue, mut heap, mut rng) = (Queue::new(), BinaryHeap::new(), Rng::new([1, 2], stream::SPLIT));
        let (mut ahead, mut count) = (HashSet::new(), 0);
        let mut pop = |queue: &mut Queue, heap: &mut BinaryHeap<Next>| {
            for cell in queue.ahead(5) {
                assert!(heap.iter().any(|next| next.cell as usize == cell) && ahead.insert(cell));
            }
            let found = queue.pop();
            assert_eq!(found, heap.pop().map(|next| next.cell as usize));
            count += usize::from(found.is_some());
            found.is_some()
        };
        for step in 0..10_000 {
            let size = if step % 7 == 0 { sizes[rng.below(11) as usize] } else { libm::exp(8.0 * rng.unit()) };
            queue.push(size, step);
            heap.push(Next { size, cell: step as u32 });
            // Few at first, then about as many as come.
            for _ in 0..if step < 5000 { step % 2 } else { rng.below(3) as usize } {
                pop(&mut queue, &mut heap);
            }
        }
        while pop(&mut queue, &mut heap) {}
        assert!(count == 10_000 && ahead.len() > 2000, "{count} {}", ahead.len());
    }
}
