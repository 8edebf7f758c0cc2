//! Which rows of a table name an index: the edges at a site, the triangles about it.

/// For every index below a count, the rows that hold it.
#[derive(Debug, Clone)]
pub struct Incidence {
    starts: Vec<u32>,
    rows: Vec<u32>,
}

impl Incidence {
    /// Sorts the rows of `table` by the indices below `count` that they hold; others are passed over. Linear.
    pub fn of<const N: usize>(count: usize, table: &[[i32; N]]) -> Self {
        let is_below = |index: i32| index >= 0 && (index as usize) < count;
        let mut starts = vec![0_u32; count + 2];
        for &index in table.iter().flatten().filter(|&&index| is_below(index)) {
            starts[index as usize + 2] += 1;
        }
        for i in 2..starts.len() {
            starts[i] += starts[i - 1];
        }
        let mut rows = vec![0; starts[count + 1] as usize];
        for (row, entries) in table.iter().enumerate() {
            for &index in entries.iter().filter(|&&index| is_below(index)) {
                let next = &mut starts[index as usize + 1];
                rows[*next as usize] = row as u32;
                *next += 1;
            }
        }
        Self { starts, rows }
    }

    /// The rows that hold `index`, ascending.
    #[inline]
    pub fn at(&self, index: usize) -> &[u32] {
        &self.rows[self.starts[index] as usize..self.starts[index + 1] as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::Incidence;

    #[test]
    fn rows_are_found_in_order() {
        let found = Incidence::of(4, &[[2, 0], [0, -1], [3, 2]]);
        assert_eq!([0, 1, 2, 3].map(|i| found.at(i).to_vec()), [vec![0, 1], vec![], vec![0, 2], vec![2]]);
    }
}
