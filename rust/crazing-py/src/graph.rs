//! Drawings of straight edges.

use numpy::{PyArray1, PyArray2, PyReadonlyArray2};
use pyo3::prelude::*;

use crate::arrays::{rows, table};
use crate::guard::detached;

type Edges<'py> = PyReadonlyArray2<'py, i32>;
type Row<'py, T> = Bound<'py, PyArray1<T>>;
type Table<'py, T> = Bound<'py, PyArray2<T>>;

#[pyfunction]
pub(crate) fn graph_degrees<'py>(py: Python<'py>, count: usize, edges: Edges<'py>) -> PyResult<Row<'py, i32>> {
    let edges = rows(&edges)?;
    let degrees = detached(py, |watch| crazing::graph::degrees(count, edges, watch))?;
    Ok(PyArray1::from_vec(py, degrees))
}

/// The label of every vertex, and the number of components.
#[pyfunction]
pub(crate) fn graph_components<'py>(
    py: Python<'py>,
    count: usize,
    edges: Edges<'py>,
) -> PyResult<(Row<'py, i32>, usize)> {
    let edges = rows(&edges)?;
    let found = detached(py, |watch| crazing::graph::components(count, edges, watch))?;
    Ok((PyArray1::from_vec(py, found.labels), found.count))
}

/// The rows of the vertices along the lines, and where each line begins.
#[pyfunction]
pub(crate) fn graph_polylines<'py>(
    py: Python<'py>,
    count: usize,
    edges: Edges<'py>,
) -> PyResult<(Row<'py, i32>, Row<'py, i64>)> {
    let edges = rows(&edges)?;
    let lines = detached(py, |watch| crazing::graph::polylines(count, edges, watch))?;
    Ok((PyArray1::from_vec(py, lines.rows), PyArray1::from_vec(py, lines.offsets)))
}

#[pyfunction]
pub(crate) fn graph_compact<'py>(
    py: Python<'py>,
    vertices: PyReadonlyArray2<'py, f64>,
    edges: Edges<'py>,
) -> PyResult<(Table<'py, f64>, Table<'py, i32>)> {
    let (vertices, edges) = (rows(&vertices)?, rows(&edges)?);
    let small = detached(py, |watch| crazing::graph::compact(vertices, edges, watch))?;
    Ok((table(py, small.vertices)?, table(py, small.edges)?))
}

/// Distance of every point from the nearest edge.
#[pyfunction]
pub(crate) fn graph_distances<'py>(
    py: Python<'py>,
    vertices: PyReadonlyArray2<'py, f64>,
    edges: Edges<'py>,
    points: PyReadonlyArray2<'py, f64>,
) -> PyResult<Row<'py, f64>> {
    let (vertices, edges, points) = (rows(&vertices)?, rows(&edges)?, rows(&points)?);
    let found = detached(py, |watch| crazing::graph::distances(vertices, edges, points, watch))?;
    Ok(PyArray1::from_vec(py, found))
}
