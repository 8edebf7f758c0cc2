//! Polygons with holes.

use crazing::clip::dual_edges;
use crazing::region::Region;
use numpy::{PyArray1, PyArray2, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;

use crate::arrays::{column, rows, table};
use crate::diagram::Arrays;
use crate::guard::detached;

type Parts<'py> =
    (Bound<'py, PyArray2<f64>>, Bound<'py, PyArray2<i32>>, Bound<'py, PyArray1<i32>>, Bound<'py, PyArray1<i32>>);

/// Vertices, edges and rows of the wanted dual edges within a region, and the rows that its outline cuts.
#[pyfunction]
pub(crate) fn dual_edges_within<'py>(
    py: Python<'py>,
    arrays: Arrays<'py>,
    bounds: [f64; 4],
    coords: PyReadonlyArray2<'py, f64>,
    offsets: PyReadonlyArray1<'py, i64>,
    wanted: PyReadonlyArray1<'py, bool>,
) -> PyResult<Parts<'py>> {
    let (view, coords) = (arrays.view()?, rows(&coords)?);
    let (offsets, wanted) = (offsets.as_slice()?, column(&wanted, "wanted", view.edges.len())?);
    let (parts, cut) = detached(py, |watch| {
        let clipped = dual_edges(view, bounds, |k| wanted[k])?;
        let mut parts = Region::of(coords, offsets, watch)?.clip(&clipped.graph, watch)?;
        parts.rows.iter_mut().for_each(|row| *row = clipped.rows[*row as usize]);
        let cut = clipped.rows.iter().zip(&parts.cut).filter(|(_, cut)| **cut).map(|(&row, _)| row).collect();
        Ok((parts, cut))
    })?;
    let (vertices, edges) = (table(py, parts.graph.vertices)?, table(py, parts.graph.edges)?);
    Ok((vertices, edges, PyArray1::from_vec(py, parts.rows), PyArray1::from_vec(py, cut)))
}

/// Which points lie in a region.
#[pyfunction]
pub(crate) fn region_contains<'py>(
    py: Python<'py>,
    coords: PyReadonlyArray2<'py, f64>,
    offsets: PyReadonlyArray1<'py, i64>,
    points: PyReadonlyArray2<'py, f64>,
) -> PyResult<Bound<'py, PyArray1<bool>>> {
    let (coords, points, offsets) = (rows(&coords)?, rows(&points)?, offsets.as_slice()?);
    let found = detached(py, |watch| {
        let region = Region::of(coords, offsets, watch)?;
        Ok(points.iter().map(|&p| region.contains(p)).collect())
    });
    Ok(PyArray1::from_vec(py, found?))
}
