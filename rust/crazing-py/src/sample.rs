//! Points of a distribution.

use crazing::rng::Key;
use crazing::sample;
use numpy::{PyArray2, PyReadonlyArray2};
use pyo3::prelude::*;

use crate::arrays::{rows, table};
use crate::crack::DensityArrays;
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

/// See [`sample::poisson_disk`].
#[pyfunction]
pub(crate) fn sample_poisson_disk(
    py: Python<'_>,
    radius: f64,
    bounds: [f64; 4],
    on_torus: bool,
    key: Key,
) -> Points<'_> {
    table(py, detached(py, |watch| sample::poisson_disk(radius, bounds, on_torus, key, watch))?)
}

/// See [`sample::from_density`].
#[pyfunction]
pub(crate) fn sample_from_density<'py>(
    py: Python<'py>,
    density: DensityArrays<'py>,
    n: usize,
    key: Key,
) -> Points<'py> {
    let density = density.view()?;
    table(py, detached(py, |watch| sample::from_density(density, n, key, watch))?)
}

/// See [`sample::relax`].
#[pyfunction]
pub(crate) fn sample_relax<'py>(
    py: Python<'py>,
    points: PyReadonlyArray2<'py, f64>,
    iterations: usize,
    bounds: [f64; 4],
    period: Option<[f64; 2]>,
) -> Points<'py> {
    let points = rows(&points)?.to_vec();
    table(py, detached(py, |watch| sample::relax(points, iterations, bounds, period, watch))?)
}
