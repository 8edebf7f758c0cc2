//! Polygons with holes.

use crazing::region::{self, Region};
use numpy::{PyArray1, PyArray2, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;

use crate::arrays::{rows, table};
use crate::diagram::Arrays;
use crate::guard::detached;

type Row<'py, T> = Bound<'py, PyArray1<T>>;
type Table<'py, T> = Bound<'py, PyArray2<T>>;
#[rustfmt::skip]
type Cells<'py> = (
    Row<'py, i32>, Row<'py, i32>, Table<'py, i32>, Row<'py, i32>, Table<'py, f64>, Row<'py, bool>,
);

/// The coordinates and offsets of a region, as the face passes them.
#[derive(FromPyObject)]
pub(crate) struct Rings<'py>(PyReadonlyArray2<'py, f64>, PyReadonlyArray1<'py, i64>);

/// The same rings made plain: outer ones counter-clockwise, holes clockwise.
#[pyfunction]
pub(crate) fn region_rings<'py>(py: Python<'py>, rings: Rings<'py>) -> PyResult<(Table<'py, f64>, Row<'py, i64>)> {
    let (coords, offsets) = (rows(&rings.0)?, rings.1.as_slice()?);
    let (coords, offsets) = detached(py, |watch| Ok(Region::of(coords, offsets, 0, watch)?.rings()))?;
    Ok((table(py, coords)?, PyArray1::from_vec(py, offsets)))
}

/// Which points lie in a region.
#[pyfunction]
pub(crate) fn region_contains<'py>(
    py: Python<'py>,
    rings: Rings<'py>,
    points: PyReadonlyArray2<'py, f64>,
) -> PyResult<Row<'py, bool>> {
    let (coords, points, offsets) = (rows(&rings.0)?, rows(&points)?, rings.1.as_slice()?);
    let found = detached(py, |watch| {
        let region = Region::of(coords, offsets, points.len(), watch)?;
        Ok(points.iter().map(|&p| region.contains(p)).collect())
    });
    Ok(PyArray1::from_vec(py, found?))
}

/// Further parts, rows of further doors, sides of all doors, cells on the outline, where they meet it, and whether it is
/// an outer ring that they meet.
#[pyfunction]
pub(crate) fn region_cells<'py>(py: Python<'py>, arrays: Arrays<'py>, rings: Rings<'py>) -> PyResult<Cells<'py>> {
    let (view, coords, offsets) = (arrays.view()?, rows(&rings.0)?, rings.1.as_slice()?);
    let found = detached(py, |watch| {
        let region = Region::of(coords, offsets, view.edges.len(), watch)?;
        region::cells::cells(view, &region, watch)
    })?;
    Ok((
        PyArray1::from_vec(py, found.parts),
        PyArray1::from_vec(py, found.rows),
        table(py, found.sides)?,
        PyArray1::from_vec(py, found.rim),
        table(py, found.arcs)?,
        PyArray1::from_vec(py, found.outer),
    ))
}

/// Vertices, edges and numbers of the doors wanted.
#[pyfunction]
pub(crate) fn region_doors<'py>(
    py: Python<'py>,
    arrays: Arrays<'py>,
    rings: Rings<'py>,
    wanted: PyReadonlyArray1<'py, bool>,
) -> PyResult<(Table<'py, f64>, Table<'py, i32>, Row<'py, i32>)> {
    let (view, coords, offsets) = (arrays.view()?, rows(&rings.0)?, rings.1.as_slice()?);
    let wanted = wanted.as_slice()?;
    let found = detached(py, |watch| {
        let region = Region::of(coords, offsets, view.edges.len(), watch)?;
        region::doors(view, &region, wanted, watch)
    })?;
    Ok((table(py, found.graph.vertices)?, table(py, found.graph.edges)?, PyArray1::from_vec(py, found.numbers)))
}

/// The line through cells within a region.
#[pyfunction]
pub(crate) fn region_route<'py>(
    py: Python<'py>,
    arrays: Arrays<'py>,
    rings: Rings<'py>,
    sites: PyReadonlyArray1<'py, i32>,
    doors: PyReadonlyArray2<'py, i32>,
    ends: [Option<f64>; 2],
) -> PyResult<Table<'py, f64>> {
    let (view, coords, offsets) = (arrays.view()?, rows(&rings.0)?, rings.1.as_slice()?);
    let (sites, doors) = (sites.as_slice()?, rows(&doors)?);
    let line = detached(py, |watch| {
        let region = Region::of(coords, offsets, view.edges.len(), watch)?;
        region::route(view, &region, sites, doors, ends, watch)
    })?;
    table(py, line)
}
