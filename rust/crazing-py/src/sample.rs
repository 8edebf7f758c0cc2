//! Points of a distribution.

use crazing::rng::Key;
use crazing::sample;
use numpy::PyArray2;
use pyo3::prelude::*;

use crate::arrays::table;
use crate::guard::detached;

type Points<'py> = PyResult<Bound<'py, PyArray2<f64>>>;

/// See [`sample::uniform`].
#[pyfunction]
pub(crate) fn sample_uniform(py: Python<'_>, n: usize, bounds: [f64; 4], key: Key) -> Points<'_> {
    table(py, detached(py, |watch| sample::uniform(n, bounds, key, watch))?)
}

/// See [`sample::normal`].
#[pyfunction]
pub(crate) fn sample_normal(py: Python<'_>, n: usize, loc: [f64; 2], scale: [f64; 2], key: Key) -> Points<'_> {
    table(py, detached(py, |watch| sample::normal(n, loc, scale, key, watch))?)
}

/// See [`sample::laplace`].
#[pyfunction]
pub(crate) fn sample_laplace(py: Python<'_>, n: usize, loc: [f64; 2], scale: [f64; 2], key: Key) -> Points<'_> {
    table(py, detached(py, |watch| sample::laplace(n, loc, scale, key, watch))?)
}
