//! Diagrams: the arrays of one from points, and a view of one from its arrays.

use crazing::{DiagramView, quad_edge};
use numpy::{PyArray1, PyArray2, PyReadonlyArray2};
use pyo3::prelude::*;

use crate::arrays::{rows, table};
use crate::guard::{checked, detached};

/// The arrays of a `Diagram` as its face passes them: sites, triangles, vertices, edges, dual_edges.
#[derive(FromPyObject)]
pub(crate) struct Arrays<'py>(
    PyReadonlyArray2<'py, f64>,
    PyReadonlyArray2<'py, i32>,
    PyReadonlyArray2<'py, f64>,
    PyReadonlyArray2<'py, i32>,
    PyReadonlyArray2<'py, i32>,
);

impl Arrays<'_> {
    /// A view whose indices all point somewhere, whoever made the arrays.
    pub(crate) fn view(&self) -> PyResult<DiagramView<'_>> {
        let view = self.unchecked()?;
        checked(view.check())?;
        Ok(view)
    }

    /// A view for what reads dual edges and their ends alone: only these have been checked.
    pub(crate) fn duals(&self) -> PyResult<DiagramView<'_>> {
        let view = self.unchecked()?;
        checked(view.check_duals())?;
        Ok(view)
    }

    /// A view for what looks at indices itself.
    pub(crate) fn unchecked(&self) -> PyResult<DiagramView<'_>> {
        Ok(DiagramView {
            sites: rows(&self.0)?,
            triangles: rows(&self.1)?,
            vertices: rows(&self.2)?,
            edges: rows(&self.3)?,
            dual_edges: rows(&self.4)?,
        })
    }
}

type DiagramArrays<'py> = (
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray1<i32>>,
    Bound<'py, PyArray2<i32>>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray2<i32>>,
    Bound<'py, PyArray2<i32>>,
);

/// Sites, site_of, triangles, vertices, edges and dual edges of the diagram of points.
#[pyfunction]
pub(crate) fn diagram<'py>(py: Python<'py>, points: PyReadonlyArray2<'py, f64>) -> PyResult<DiagramArrays<'py>> {
    let points = rows(&points)?;
    handed(py, detached(py, |watch| crazing::diagram::diagram(points, watch))?)
}

/// The same with edges along constraints, and which these are.
#[pyfunction]
pub(crate) fn constrained_diagram<'py>(
    py: Python<'py>,
    points: PyReadonlyArray2<'py, f64>,
    constraints: PyReadonlyArray2<'py, i32>,
) -> PyResult<(DiagramArrays<'py>, Row<'py, bool>)> {
    let (points, constraints) = (rows(&points)?, rows(&constraints)?);
    let found = detached(py, |watch| crazing::diagram::constrained(points, constraints, watch))?;
    Ok((handed(py, found.diagram)?, PyArray1::from_vec(py, found.constrained)))
}

fn handed(py: Python<'_>, found: crazing::Diagram) -> PyResult<DiagramArrays<'_>> {
    Ok((
        table(py, found.sites)?,
        PyArray1::from_vec(py, found.site_of),
        table(py, found.triangles)?,
        table(py, found.vertices)?,
        table(py, found.edges)?,
        table(py, found.dual_edges)?,
    ))
}

type Table<'py, T> = Bound<'py, PyArray2<T>>;
type Row<'py, T> = Bound<'py, PyArray1<T>>;
#[rustfmt::skip]
type PeriodicArrays<'py> = (
    Table<'py, f64>, Row<'py, i32>, Table<'py, i32>, Table<'py, f64>, Table<'py, i32>, Table<'py, i32>,
    Table<'py, i8>, Table<'py, i8>,
);

/// The same on a torus, and the shifts of edges and dual edges.
#[pyfunction]
pub(crate) fn periodic_diagram<'py>(
    py: Python<'py>,
    points: PyReadonlyArray2<'py, f64>,
    period: [f64; 2],
) -> PyResult<PeriodicArrays<'py>> {
    let points = rows(&points)?;
    let torus = detached(py, |watch| crazing::diagram::periodic(points, period, watch))?;
    let found = torus.diagram;
    Ok((
        table(py, found.sites)?,
        PyArray1::from_vec(py, found.site_of),
        table(py, found.triangles)?,
        table(py, found.vertices)?,
        table(py, found.edges)?,
        table(py, found.dual_edges)?,
        table(py, torus.shifts)?,
        table(py, torus.dual_shifts)?,
    ))
}

/// Vertices and edges of one period of a drawing on a torus.
#[pyfunction]
pub(crate) fn tile<'py>(
    py: Python<'py>,
    points: PyReadonlyArray2<'py, f64>,
    edges: PyReadonlyArray2<'py, i32>,
    shifts: PyReadonlyArray2<'py, i8>,
    period: [f64; 2],
) -> PyResult<(Table<'py, f64>, Table<'py, i32>)> {
    let (points, edges, shifts) = (rows(&points)?, rows(&edges)?, rows(&shifts)?);
    let graph = detached(py, |watch| crazing::diagram::tile(points, edges, shifts, period, watch))?;
    Ok((table(py, graph.vertices)?, table(py, graph.edges)?))
}

/// Corners and offsets of every cell as a polygon; on a torus the steps between copies of sites, edge by edge.
#[pyfunction]
pub(crate) fn mosaic<'py>(
    py: Python<'py>,
    arrays: Arrays<'py>,
    steps: Option<PyReadonlyArray2<'py, f64>>,
    bounds: [f64; 4],
) -> PyResult<(Table<'py, f64>, Row<'py, i64>)> {
    let view = arrays.view()?;
    let steps = steps.as_ref().map(rows).transpose()?;
    let found = detached(py, |watch| crazing::diagram::mosaic(view, steps, bounds, watch))?;
    Ok((table(py, found.coords)?, PyArray1::from_vec(py, found.offsets)))
}

/// The next quarter-edge about the same origin, for every quarter-edge; with the shifts of a torus.
#[pyfunction]
pub(crate) fn onext<'py>(
    py: Python<'py>,
    arrays: Arrays<'py>,
    shifts: Option<PyReadonlyArray2<'py, i8>>,
) -> PyResult<Row<'py, i32>> {
    let view = arrays.view()?;
    let shifts = shifts.as_ref().map(rows).transpose()?;
    Ok(PyArray1::from_vec(py, detached(py, |_| quad_edge::onext(view, shifts))?))
}

/// How many walls lie between every triangle and infinity.
#[pyfunction]
pub(crate) fn depths<'py>(
    py: Python<'py>,
    arrays: Arrays<'py>,
    wall: numpy::PyReadonlyArray1<'py, bool>,
) -> PyResult<Row<'py, i32>> {
    let (view, wall) = (arrays.view()?, wall.as_slice()?);
    Ok(PyArray1::from_vec(py, detached(py, |watch| crazing::diagram::depths(view, wall, watch))?))
}

/// For every vertex the lowest row that shares its place.
#[pyfunction]
pub(crate) fn representatives<'py>(py: Python<'py>, arrays: Arrays<'py>) -> PyResult<Bound<'py, PyArray1<i32>>> {
    let view = arrays.view()?;
    Ok(PyArray1::from_vec(py, detached(py, |_| Ok(crazing::diagram::representatives(view)))?))
}

type Clipped<'py> = (Bound<'py, PyArray2<f64>>, Bound<'py, PyArray2<i32>>, Bound<'py, PyArray1<i32>>);

/// Vertices, edges and rows of the dual edges of the wanted rows, clipped to the bounds.
#[pyfunction]
pub(crate) fn dual_edges<'py>(
    py: Python<'py>,
    arrays: Arrays<'py>,
    bounds: [f64; 4],
    wanted: numpy::PyReadonlyArray1<'py, bool>,
) -> PyResult<Clipped<'py>> {
    let view = arrays.view()?;
    let wanted = crate::arrays::column(&wanted, "wanted", view.edges.len())?;
    let found = detached(py, |_| crazing::clip::dual_edges(view, bounds, |k| wanted[k]))?;
    Ok((table(py, found.graph.vertices)?, table(py, found.graph.edges)?, PyArray1::from_vec(py, found.rows)))
}
