//! Cells that wait to be split.

use std::cmp::Ordering;
use std::collections::{BTreeMap, BinaryHeap};

/// Bits of a size that bins do not tell apart: 16 bins from one size to twice of it.
const BIN_BITS: u32 = 48;

/// The largest first, of equal ones the one with the lowest number.
///
/// Only those of about the largest size are kept in a heap, the others as they come, in bins by size: most never get to
/// the top, and a heap of all is larger than the fast memory.
pub(super) struct Queue {
    heap: BinaryHeap<Next>,
    /// The least bin of those in the heap.
    least: i64,
    later: BTreeMap<i64, Vec<Next>>,
}

impl Queue {
    pub(super) fn new() -> Self {
        Self { heap: BinaryHeap::new(), least: i64::MAX, later: BTreeMap::new() }
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
        if self.heap.is_empty() {
            let (bin, waiting) = self.later.pop_last()?;
            (self.heap, self.least) = (BinaryHeap::from(waiting), bin);
        }
        self.heap.pop().map(|next| next.cell as usize)
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
    use super::*;
    use crate::rng::{Rng, stream};

    #[test]
    fn cells_come_as_from_one_heap() {
        let sizes = [0.0, -0.0, -1.0, 1e-300, f64::INFINITY, f64::NAN, 0.5, 0.5, 0.5, 0.75, 3.0];
        let (mut queue, mut heap, mut rng) = (Queue::new(), BinaryHeap::new(), Rng::new([1, 2], stream::SPLIT));
        let mut count = 0;
        for step in 0..20_000 {
            let size = if step % 7 == 0 { sizes[rng.below(11) as usize] } else { libm::exp(8.0 * rng.unit()) };
            queue.push(size, step);
            heap.push(Next { size, cell: step as u32 });
            for _ in 0..rng.below(3) {
                let found = queue.pop();
                assert_eq!(found, heap.pop().map(|next| next.cell as usize));
                count += usize::from(found.is_some());
            }
        }
        while let Some(next) = heap.pop() {
            assert_eq!(queue.pop(), Some(next.cell as usize));
        }
        assert_eq!(queue.pop(), None);
        assert!(count > 10_000);
    }
}
