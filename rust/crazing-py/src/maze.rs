//! Mazes of a diagram.

use crazing::maze::{self, Doors, Tree};
use crazing::{DiagramView, Error};
use numpy::{PyArray1, PyArray2, PyReadonlyArray1};
use pyo3::prelude::*;

use crate::arrays::{column, table};
use crate::diagram::Arrays;
use crate::guard::{checked, detached};

type Carved<'py> = (Bound<'py, PyArray1<bool>>, Bound<'py, PyArray2<i32>>, i32);

/// Number of cells and the two sides of every door: sites and edges, or triangles and dual edges.
fn cells<'a>(view: DiagramView<'a>, delaunay: bool) -> (usize, &'a [[i32; 2]]) {
    if delaunay { (view.triangles.len(), view.dual_edges) } else { (view.sites.len(), view.edges) }
}

fn tree(name: &str) -> PyResult<Tree> {
    checked(match name {
        "depth-first" => Ok(Tree::DepthFirst),
        "kruskal" => Ok(Tree::Kruskal),
        "prim" => Ok(Tree::Prim),
        "wilson" => Ok(Tree::Wilson),
        _ => Err(Error::Internal("a tree that the face let through")),
    })
}

/// Open doors, passages and start of a maze; the doors are those of the diagram where none are given.
#[pyfunction]
#[allow(clippy::too_many_arguments, reason = "the face passes them one by one")]
pub(crate) fn carve<'py>(
    py: Python<'py>,
    arrays: Arrays<'py>,
    delaunay: bool,
    doors: Option<PyReadonlyArray1<'py, bool>>,
    tree: &str,
    start: Option<usize>,
    opening: f64,
    key: [u64; 2],
) -> PyResult<Carved<'py>> {
    let (view, tree) = (arrays.view()?, self::tree(tree)?);
    let (cells, sides) = cells(view, delaunay);
    let given = doors.as_ref().map(|doors| column(doors, "doors", sides.len())).transpose()?;
    let carved = detached(py, |watch| {
        let every = || if delaunay { vec![true; sides.len()] } else { maze::voronoi_doors(view) };
        let door = given.map_or_else(every, <[bool]>::to_vec);
        maze::carve(Doors { cells, sides, door: &door }, tree, start, opening, key, watch)
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

/// Open doors between the source and every cell.
#[pyfunction]
pub(crate) fn distances<'py>(
    py: Python<'py>,
    arrays: Arrays<'py>,
    delaunay: bool,
    open: PyReadonlyArray1<'py, bool>,
    source: usize,
) -> PyResult<Bound<'py, PyArray1<i32>>> {
    let view = arrays.view()?;
    let (cells, sides) = cells(view, delaunay);
    let open = column(&open, "open", sides.len())?;
    Ok(PyArray1::from_vec(py, detached(py, |watch| maze::distances(cells, sides, open, source, watch))?))
}

/// The cells along the longest way.
#[pyfunction]
pub(crate) fn longest<'py>(
    py: Python<'py>,
    arrays: Arrays<'py>,
    delaunay: bool,
    open: PyReadonlyArray1<'py, bool>,
) -> PyResult<Bound<'py, PyArray1<i32>>> {
    let view = arrays.view()?;
    let (cells, sides) = cells(view, delaunay);
    let open = column(&open, "open", sides.len())?;
    Ok(PyArray1::from_vec(py, detached(py, |watch| maze::longest(cells, sides, open, watch))?))
}
