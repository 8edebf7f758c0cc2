//! Mazes of a diagram.

use crazing::{DiagramView, maze};
use numpy::{PyArray1, PyArray2, PyReadonlyArray1};
use pyo3::prelude::*;

use crate::arrays::{column, table};
use crate::diagram::Arrays;
use crate::guard::detached;

type Carved<'py> = (Bound<'py, PyArray1<bool>>, Bound<'py, PyArray2<i32>>, i32);

/// Number of cells and the two sides of every door: sites and edges, or triangles and dual edges.
fn cells<'a>(view: DiagramView<'a>, delaunay: bool) -> (usize, &'a [[i32; 2]]) {
    if delaunay { (view.triangles.len(), view.dual_edges) } else { (view.sites.len(), view.edges) }
}

/// Open doors, passages and start of a depth-first maze.
#[pyfunction]
pub(crate) fn carve<'py>(
    py: Python<'py>,
    arrays: Arrays<'py>,
    delaunay: bool,
    start: Option<usize>,
    opening: f64,
    key: [u64; 2],
) -> PyResult<Carved<'py>> {
    let view = arrays.view()?;
    let (cells, sides) = cells(view, delaunay);
    let carved = detached(py, |watch| {
        let doors = if delaunay { vec![true; sides.len()] } else { maze::voronoi_doors(view) };
        maze::carve(cells, sides, &doors, start, opening, key, watch)
    })?;
    Ok((PyArray1::from_vec(py, carved.open), table(py, carved.passages)?, carved.start))
}

/// The cells along the shortest way through open doors.
#[pyfunction]
pub(crate) fn solve<'py>(
    py: Python<'py>,
    arrays: Arrays<'py>,
    delaunay: bool,
    open: PyReadonlyArray1<'py, bool>,
    source: usize,
    target: usize,
) -> PyResult<Bound<'py, PyArray1<i32>>> {
    let view = arrays.view()?;
    let (cells, sides) = cells(view, delaunay);
    let open = column(&open, "open", sides.len())?;
    let way = detached(py, |watch| maze::solve(cells, sides, open, source, target, watch))?;
    Ok(PyArray1::from_vec(py, way))
}
