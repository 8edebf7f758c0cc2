//! Curves and skeletons of a diagram.

use crazing::skeleton;
use numpy::{PyArray1, PyArray2, PyReadonlyArray1};
use pyo3::prelude::*;

use crate::arrays::{column, table};
use crate::diagram::Arrays;
use crate::guard::detached;

/// Whether each edge is one-step crust.
#[pyfunction]
pub(crate) fn one_step<'py>(py: Python<'py>, arrays: Arrays<'py>) -> PyResult<Bound<'py, PyArray1<bool>>> {
    let view = arrays.view()?;
    Ok(PyArray1::from_vec(py, detached(py, |_| skeleton::one_step(view))?))
}

/// Whether each edge is two-pass crust.
#[pyfunction]
pub(crate) fn two_pass<'py>(py: Python<'py>, arrays: Arrays<'py>) -> PyResult<Bound<'py, PyArray1<bool>>> {
    let view = arrays.view()?;
    Ok(PyArray1::from_vec(py, detached(py, |_| skeleton::two_pass(view))?))
}

type Masks<'py> = (Bound<'py, PyArray1<bool>>, Bound<'py, PyArray1<bool>>);

/// Two-pass crust and edge-filtered axis.
#[pyfunction]
pub(crate) fn edge_filter<'py>(py: Python<'py>, arrays: Arrays<'py>) -> PyResult<Masks<'py>> {
    let view = arrays.view()?;
    let found = detached(py, |_| skeleton::edge_filter(view))?;
    Ok((PyArray1::from_vec(py, found.crust), PyArray1::from_vec(py, found.axis)))
}

/// Edges of the initial axis, by the second triangulation.
#[pyfunction]
pub(crate) fn initial<'py>(py: Python<'py>, arrays: Arrays<'py>) -> PyResult<Bound<'py, PyArray2<i32>>> {
    let view = arrays.view()?;
    table(py, detached(py, |watch| skeleton::second(view, watch))?.axis)
}

/// Dual edges of the masked rows that join two different finite vertices.
#[pyfunction]
pub(crate) fn axis_edges<'py>(
    py: Python<'py>,
    arrays: Arrays<'py>,
    mask: PyReadonlyArray1<'py, bool>,
) -> PyResult<Bound<'py, PyArray2<i32>>> {
    let view = arrays.view()?;
    let mask = column(&mask, "mask", view.edges.len())?;
    table(py, detached(py, |_| Ok(skeleton::axis_edges(view, mask)))?)
}
