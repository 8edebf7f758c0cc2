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
        Self::of_rows(count, || table.iter().enumerate().map(|(row, &entries)| (row as u32, entries)))
    }

    /// The same of some rows, ascending, which are gone through twice.
    pub(crate) fn of_rows<const N: usize, I: Iterator<Item = (u32, [i32; N])>>(
        count: usize,
        rows_in_turn: impl Fn() -> I,
    ) -> Self {
        let is_below = |index: &i32| *index >= 0 && (*index as usize) < count;
        let mut starts = vec![0_u32; count + 2];
        for (_, entries) in rows_in_turn() {
            for index in entries.into_iter().filter(is_below) {
                starts[index as usize + 2] += 1;
            }
        }
        for i in 2..starts.len() {
            starts[i] += starts[i - 1];
        }
        let mut rows = vec![0; starts[count + 1] as usize];
        for (row, entries) in rows_in_turn() {
            for index in entries.into_iter().filter(is_below) {
                let next = &mut starts[index as usize + 1];
                rows[*next as usize] = row;
                *next += 1;
            }
        }
        Self { starts, rows }
    }

    /// The rows of the first index, then those of the second, and so on.
    pub(crate) fn into_rows(self) -> Vec<u32> {
        self.rows
    }

    /// Puts the rows of every index in the order of a value each, the smallest first; equal ones stay ascending.
    pub(crate) fn sort_by_value(&mut self, value: impl Fn(u32) -> f64) {
        for ends in self.starts.windows(2) {
            let rows = &mut self.rows[ends[0] as usize..ends[1] as usize];
            rows.sort_by(|&a, &b| value(a).total_cmp(&value(b)));
        }
    }

    /// The rows that hold `index`, ascending unless they were sorted.
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
        let rows = |found: &Incidence| [0, 1, 2, 3].map(|i| found.at(i).to_vec());
        assert_eq!(rows(&found), [vec![0, 1], vec![], vec![0, 2], vec![2]]);
        let mut sorted = found;
        sorted.sort_by_value(|row| [2.0, 0.0, 1.0][row as usize]);
        assert_eq!(rows(&sorted), [vec![1, 0], vec![], vec![2, 0], vec![2]]);
    }
}
