//! Mazes: which doors between cells are open, and the ways through them.

use crazing::Error;
use crazing::graph::check_indices;
use crazing::maze::{self, Doors, Tree};
use numpy::{PyArray1, PyArray2, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;

use crate::arrays::{column, rows, table};
use crate::diagram::Arrays;
use crate::guard::{checked, detached};

type Row<'py, T> = Bound<'py, PyArray1<T>>;
type Carved<'py> = (Row<'py, bool>, Bound<'py, PyArray2<i32>>, i32);

pub(crate) fn tree(name: &str) -> PyResult<Tree> {
    checked(match name {
        "depth-first" => Ok(Tree::DepthFirst),
        "kruskal" => Ok(Tree::Kruskal),
        "prim" => Ok(Tree::Prim),
        "wilson" => Ok(Tree::Wilson),
        _ => Err(Error::Internal("a tree that the face let through")),
    })
}

/// The cells on either side of every door.
#[derive(FromPyObject)]
pub(crate) struct Sides<'py>(usize, PyReadonlyArray2<'py, i32>);

impl Sides<'_> {
    /// The number of cells, and two of them a door.
    fn checked(&self) -> PyResult<(usize, &[[i32; 2]])> {
        let sides = rows(&self.1)?;
        checked(check_indices("sides", sides, -1, self.0))?;
        Ok((self.0, sides))
    }
}

/// Which dual edges have a length within the bounds, so that a Voronoi cell can be left through them.
#[pyfunction]
pub(crate) fn voronoi_doors<'py>(py: Python<'py>, arrays: Arrays<'py>, bounds: [f64; 4]) -> PyResult<Row<'py, bool>> {
    let view = arrays.view()?;
    Ok(PyArray1::from_vec(py, detached(py, |_| Ok(maze::voronoi_doors(view, Some(bounds))))?))
}

/// Open doors, passages and start of a maze; without a start, one is drawn, `among_doors` of the cells that have one.
#[pyfunction]
#[allow(clippy::too_many_arguments, reason = "the face passes them one by one")]
pub(crate) fn carve<'py>(
    py: Python<'py>,
    sides: Sides<'py>,
    doors: PyReadonlyArray1<'py, bool>,
    tree: &str,
    start: Option<usize>,
    among_doors: bool,
    opening: f64,
    key: [u64; 2],
) -> PyResult<Carved<'py>> {
    let ((cells, sides), tree) = (sides.checked()?, self::tree(tree)?);
    let door = column(&doors, "doors", sides.len())?;
    let doors = Doors { cells, sides, door };
    let carved = detached(py, |watch| {
        let drawn = || if among_doors { maze::cell_with_door(doors, key) } else { None };
        maze::carve(doors, tree, start.or_else(drawn), opening, key, watch)
    })?;
    Ok((PyArray1::from_vec(py, carved.open), table(py, carved.passages)?, carved.start))
}

/// The cells along the shortest way through open doors.
#[pyfunction]
pub(crate) fn solve<'py>(
    py: Python<'py>,
    sides: Sides<'py>,
    open: PyReadonlyArray1<'py, bool>,
    source: usize,
    target: usize,
) -> PyResult<Row<'py, i32>> {
    let (cells, sides) = sides.checked()?;
    let open = column(&open, "open", sides.len())?;
    Ok(PyArray1::from_vec(py, detached(py, |watch| maze::solve(cells, sides, open, source, target, watch))?))
}

/// Open doors between the source and every cell.
#[pyfunction]
pub(crate) fn distances<'py>(
    py: Python<'py>,
    sides: Sides<'py>,
    open: PyReadonlyArray1<'py, bool>,
    source: usize,
) -> PyResult<Row<'py, i32>> {
    let (cells, sides) = sides.checked()?;
    let open = column(&open, "open", sides.len())?;
    Ok(PyArray1::from_vec(py, detached(py, |watch| maze::distances(cells, sides, open, source, watch))?))
}

/// The cells along the longest way.
#[pyfunction]
pub(crate) fn longest<'py>(
    py: Python<'py>,
    sides: Sides<'py>,
    open: PyReadonlyArray1<'py, bool>,
) -> PyResult<Row<'py, i32>> {
    let (cells, sides) = sides.checked()?;
    let open = column(&open, "open", sides.len())?;
    Ok(PyArray1::from_vec(py, detached(py, |watch| maze::longest(cells, sides, open, watch))?))
}
