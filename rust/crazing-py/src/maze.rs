//! Mazes of a diagram.

use crazing::maze;
use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;

use crate::arrays::table;
use crate::diagram::Arrays;
use crate::guard::detached;

type Carved<'py> = (Bound<'py, PyArray1<bool>>, Bound<'py, PyArray2<i32>>, i32);

/// Open doors, passages and start of a depth-first maze over the Voronoi cells.
#[pyfunction]
pub(crate) fn voronoi_maze<'py>(
    py: Python<'py>,
    arrays: Arrays<'py>,
    start: Option<usize>,
    opening: f64,
    key: [u64; 2],
) -> PyResult<Carved<'py>> {
    let view = arrays.view()?;
    let carved = detached(py, |watch| {
        maze::carve(view.sites.len(), view.edges, &maze::voronoi_doors(view), start, opening, key, watch)
    })?;
    Ok((PyArray1::from_vec(py, carved.open), table(py, carved.passages)?, carved.start))
}
