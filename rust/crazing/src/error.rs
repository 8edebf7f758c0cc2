//! Everything that can be wrong with an input, with its facts as fields.

use thiserror::Error;

/// A core result.
pub type Result<T> = std::result::Result<T, Error>;

/// Why a call has no answer. The message says what was found, where, and what is wanted.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum Error {
    /// A coordinate is NaN or infinite.
    #[error("points[{row}] is ({}, {}); every coordinate must be finite", spelt(*x), spelt(*y))]
    NotFinite {
        /// Row of the input.
        row: usize,
        /// What was found.
        x: f64,
        /// What was found.
        y: f64,
    },
    /// More rows than 32-bit indices can number.
    #[error("{found} {what}; at most {limit} are supported")]
    TooMany {
        /// What was counted.
        what: &'static str,
        /// How many there are.
        found: usize,
        /// How many may be.
        limit: usize,
    },
    /// Fewer than three distinct sites.
    #[error("{} distinct site{}; at least 3 are needed", found, plural(*found))]
    TooFewSites {
        /// How many distinct sites there are.
        found: usize,
    },
    /// All sites lie on one line.
    #[error("all {found} distinct sites lie on one line; a triangle is needed")]
    Collinear {
        /// How many distinct sites there are.
        found: usize,
    },
    /// An index array does not fit the array it points into.
    #[error("{array}[{row}] is {value}; it must be at least {low} and less than {limit}")]
    BadIndex {
        /// Which array.
        array: &'static str,
        /// Which row.
        row: usize,
        /// What was found.
        value: i64,
        /// The smallest value allowed.
        low: i64,
        /// One past the largest value allowed.
        limit: i64,
    },
    /// Two arrays that belong together differ in length.
    #[error("{array} has {found} row{}; {wanted} {} wanted", plural(*found), if *wanted == 1 { "is" } else { "are" })]
    BadLength {
        /// Which array.
        array: &'static str,
        /// How many rows it has.
        found: usize,
        /// How many rows it must have.
        wanted: usize,
    },
    /// Arrays of a diagram that contradict each other.
    #[error("{array}[{row}] contradicts the other arrays of its diagram")]
    Inconsistent {
        /// Which array.
        array: &'static str,
        /// Which row.
        row: usize,
    },
    /// A number outside its allowed range.
    #[error("{name} is {}; {wanted}", short(*value))]
    BadValue {
        /// The argument.
        name: &'static str,
        /// What was found.
        value: f64,
        /// What is wanted.
        wanted: &'static str,
    },
    /// An entry of an array that is outside its allowed range.
    #[error("{array}[{row}] holds {}; {wanted}", short(*value))]
    BadEntry {
        /// Which array.
        array: &'static str,
        /// Which row.
        row: usize,
        /// What was found.
        value: f64,
        /// What is wanted.
        wanted: &'static str,
    },
    /// A segment without a length.
    #[error("{array}[{row}] is ({}, {}), one place; two distinct points are wanted", ends[0], ends[1])]
    Loop {
        /// Which array.
        array: &'static str,
        /// Which row.
        row: usize,
        /// Rows of its ends.
        ends: [i32; 2],
    },
    /// Two segments that may only touch.
    #[error(
        "{what} ({}, {}) crosses or overlaps {what} ({}, {}); they may only touch", first[0], first[1], second[0], second[1]
    )]
    Crossing {
        /// What a segment is.
        what: &'static str,
        /// Rows of the ends of one.
        first: [usize; 2],
        /// Rows of the ends of the other.
        second: [usize; 2],
    },
    /// A result that would not fit into memory.
    #[error("{what} would take {bytes} bytes of memory, which could not be had")]
    OutOfMemory {
        /// What was to be stored.
        what: &'static str,
        /// How many bytes it takes.
        bytes: u128,
    },
    /// Writing the output failed; the reason is the writer's.
    #[error("writing failed: {reason}")]
    Write {
        /// The writer's own words.
        reason: String,
    },
    /// The caller asked to stop.
    #[error("interrupted")]
    Interrupted,
    /// A state that the library promises never to reach.
    #[error("internal error: {0}; please report it")]
    Internal(&'static str),
}

/// What a noun ends in after so many.
fn plural(count: usize) -> &'static str {
    if count == 1 { "" } else { "s" }
}

/// A number as Python spells it.
fn spelt(value: f64) -> String {
    if value.is_nan() { "nan".into() } else { format!("{value:?}") }
}

/// A number in few digits: Rust writes out all zeros of what is very large or very small.
fn short(value: f64) -> String {
    let is_plain = value == 0.0 || !value.is_finite() || (1e-5..1e16).contains(&value.abs());
    if is_plain { value.to_string() } else { spelt(value) }
}

#[cfg(test)]
mod tests {
    use super::Error;

    #[test]
    fn numbers_are_short() {
        let message = |value| Error::BadValue { name: "radius", value, wanted: "more is wanted" }.to_string();
        assert_eq!(message(2.0), "radius is 2; more is wanted");
        assert_eq!(message(-0.0), "radius is -0; more is wanted");
        assert_eq!(message(1e200), "radius is 1e200; more is wanted");
        assert_eq!(message(-5e-324), "radius is -5e-324; more is wanted");
    }

    #[test]
    fn one_is_not_many() {
        let text = [0, 1, 2].map(|found| Error::TooFewSites { found }.to_string());
        assert_eq!(
            text.map(|text| text.chars().take(16).collect::<String>()),
            ["0 distinct sites", "1 distinct site;", "2 distinct sites"]
        );
        let text = Error::BadLength { array: "mask", found: 1, wanted: 1 }.to_string();
        assert_eq!(text, "mask has 1 row; 1 is wanted");
    }

    #[test]
    fn coordinates_are_spelt_as_in_python() {
        let error = Error::NotFinite { row: 17, x: f64::NAN, y: 2.0 };
        assert_eq!(error.to_string(), "points[17] is (nan, 2.0); every coordinate must be finite");
        let error = Error::NotFinite { row: 0, x: -1e300, y: f64::NEG_INFINITY };
        assert_eq!(error.to_string(), "points[0] is (-1e300, -inf); every coordinate must be finite");
    }
}
