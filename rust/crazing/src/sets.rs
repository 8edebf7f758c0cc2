//! Disjoint sets of indices (union-find); the lowest index stands for its set.

/// A partition of `0..n` that only ever gets coarser.
#[derive(Debug, Clone)]
pub struct DisjointSets {
    parent: Vec<u32>,
}

impl DisjointSets {
    /// Every index a set of its own.
    pub fn new(n: usize) -> Self {
        Self { parent: (0..n as u32).collect() }
    }

    /// The lowest index of the set that holds `i`.
    pub fn lowest(&mut self, i: usize) -> usize {
        let mut at = i;
        while self.parent[at] as usize != at {
            // Path halving: every other index on the way is hung one step higher.
            let up = self.parent[self.parent[at] as usize];
            self.parent[at] = up;
            at = up as usize;
        }
        at
    }

    /// Unites two sets; false when they were one already.
    pub fn unite(&mut self, a: usize, b: usize) -> bool {
        let (a, b) = (self.lowest(a), self.lowest(b));
        self.parent[a.max(b)] = a.min(b) as u32;
        a != b
    }

    /// The lowest index of the set of every index, where it is known which ones have been united.
    pub fn into_lowest(mut self, united: impl Iterator<Item = usize>) -> Vec<i32> {
        for i in united {
            let lowest = self.lowest(i) as u32;
            self.parent[i] = lowest;
        }
        self.parent.into_iter().map(|lowest| lowest as i32).collect()
    }
}
