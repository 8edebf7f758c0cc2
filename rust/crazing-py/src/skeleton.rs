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

type Second<'py> = (Bound<'py, PyArray1<bool>>, Bound<'py, PyArray2<i32>>, Bound<'py, PyArray1<bool>>);

/// Two-pass crust mask, initial axis edges and edge-filter mask, by the second triangulation.
#[pyfunction]
pub(crate) fn second<'py>(py: Python<'py>, arrays: Arrays<'py>) -> PyResult<Second<'py>> {
    let view = arrays.view()?;
    let found = detached(py, |watch| skeleton::second(view, watch))?;
    Ok((PyArray1::from_vec(py, found.crust), table(py, found.axis)?, PyArray1::from_vec(py, found.filtered)))
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
