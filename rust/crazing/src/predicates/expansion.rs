//! Exact sums of doubles (Shewchuk 1997): the number is the sum of the terms, which do not overlap and grow in size.

/// `a + b` as a rounded sum and its exact error.
#[inline]
pub fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let virtual_b = sum - a;
    (sum, (a - (sum - virtual_b)) + (b - virtual_b))
}

/// `a * b` as a rounded product and its exact error (Dekker); needs no fused multiply-add, whose speed and
/// presence depend on the machine.
#[inline]
pub fn two_product(a: f64, b: f64) -> (f64, f64) {
    let product = a * b;
    let ((a_high, a_low), (b_high, b_low)) = (split(a), split(b));
    let error = ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low;
    (product, error)
}

#[inline]
fn split(a: f64) -> (f64, f64) {
    const SPLITTER: f64 = 134_217_729.0; // 2^27 + 1
    let c = SPLITTER * a;
    let high = c - (c - a);
    (high, a - high)
}

/// An exact number. Terms that are zero are not kept, so zero has no terms.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Expansion {
    terms: Vec<f64>,
}

impl Expansion {
    /// `a - b`, exactly.
    pub fn difference(a: f64, b: f64) -> Self {
        let (high, low) = two_sum(a, -b);
        Self::of([low, high])
    }

    fn of<const N: usize>(terms: [f64; N]) -> Self {
        Self { terms: terms.into_iter().filter(|&term| term != 0.0).collect() }
    }

    /// Exact sum.
    #[must_use]
    pub fn plus(&self, other: &Self) -> Self {
        other.terms.iter().fold(self.clone(), |sum, &term| sum.grown(term))
    }

    /// Exact difference.
    #[must_use]
    pub fn minus(&self, other: &Self) -> Self {
        other.terms.iter().fold(self.clone(), |sum, &term| sum.grown(-term))
    }

    /// Exact product.
    #[must_use]
    pub fn times(&self, other: &Self) -> Self {
        let mut product = Self::default();
        for &a in &self.terms {
            for &b in &other.terms {
                let (high, low) = two_product(a, b);
                product = product.grown(low).grown(high);
            }
        }
        product
    }

    /// Adds one double: each term in turn takes what the sum rounds off and hands the rest on.
    fn grown(mut self, term: f64) -> Self {
        let mut carry = term;
        let mut kept = 0;
        for i in 0..self.terms.len() {
            let (sum, error) = two_sum(carry, self.terms[i]);
            carry = sum;
            if error != 0.0 {
                self.terms[kept] = error;
                kept += 1;
            }
        }
        self.terms.truncate(kept);
        if carry != 0.0 {
            self.terms.push(carry);
        }
        self
    }

    /// The largest term carries the sign of the whole.
    pub fn sign(&self) -> f64 {
        self.terms.last().map_or(0.0, |&term| term.signum())
    }

    /// The nearest double, within an ulp.
    pub fn estimate(&self) -> f64 {
        self.terms.iter().sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cancels_exactly() {
        let tiny = Expansion::difference(1.0, 1.0 - f64::EPSILON);
        let one = Expansion::difference(1.0, 0.0);
        assert_eq!(one.plus(&tiny).minus(&one), tiny);
        assert_eq!(tiny.minus(&tiny).sign(), 0.0);
    }

    #[test]
    fn squares_sum_exactly() {
        // (1 + e)^2 - 1 - 2e = e^2, far below the last bit of 1.
        let e = f64::EPSILON;
        let a = Expansion::difference(1.0, -e);
        let two_e = Expansion::difference(e, -e);
        let left = a.times(&a).minus(&Expansion::difference(1.0, 0.0)).minus(&two_e);
        assert_eq!(left.estimate(), e * e);
    }
}
