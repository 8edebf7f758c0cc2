//! What noise gives.

/// A value, about 0 and seldom beyond -1 or 1, and how it changes a pixel to the right and a pixel down.
#[derive(Debug, Clone, Copy, Default)]
pub(in super::super) struct Value {
    pub(in super::super) value: f32,
    pub(in super::super) slope: [f32; 2],
}

/// The same of some pixels of a row.
#[derive(Debug, Default)]
pub(in super::super) struct Values {
    pub(in super::super) value: Vec<f32>,
    pub(in super::super) slope: [Vec<f32>; 2],
}

impl Values {
    pub(in super::super) fn new(width: usize) -> Self {
        let row = || vec![0.0; width];
        Self { value: row(), slope: [row(), row()] }
    }

    pub(in super::super) fn clear(&mut self) {
        let [right, down] = &mut self.slope;
        [&mut self.value, right, down].into_iter().for_each(|row| row.fill(0.0));
    }

    #[inline(always)]
    pub(in super::super) fn at(&self, x: usize) -> Value {
        Value { value: self.value[x], slope: [self.slope[0][x], self.slope[1][x]] }
    }
}
