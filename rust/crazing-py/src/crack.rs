//! Cracks of a maze.

use crazing::crack::Profile;
use numpy::{PyArray1, PyArray2, PyReadonlyArray1};
use pyo3::prelude::*;

use crate::arrays::{column, table};
use crate::diagram::Arrays;
use crate::guard::detached;

type CrackArrays<'py> = (
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray2<i32>>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray1<i32>>,
    Bound<'py, PyArray1<i32>>,
);

/// Vertices, edges, width, strand and generation of the crack along the shut doors.
#[pyfunction]
pub(crate) fn crack<'py>(
    py: Python<'py>,
    arrays: Arrays<'py>,
    open: PyReadonlyArray1<'py, bool>,
    bounds: [f64; 4],
    width: f64,
    hierarchy: f64,
    taper: f64,
) -> PyResult<CrackArrays<'py>> {
    let view = arrays.view()?;
    let open = column(&open, "open", view.edges.len())?;
    let found = detached(py, |_| crazing::crack::crack(view, open, bounds, Profile { width, hierarchy, taper }))?;
    Ok((
        table(py, found.graph.vertices)?,
        table(py, found.graph.edges)?,
        table(py, found.width)?,
        PyArray1::from_vec(py, found.strand),
        PyArray1::from_vec(py, found.generation),
    ))
}
