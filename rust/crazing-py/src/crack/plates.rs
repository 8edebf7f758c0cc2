//! The plates of a recipe in one call.

use crazing::Point;
use crazing::crack::{self, Carving, Plates};
use crazing::rng::Key;
use numpy::PyArray1;
use pyo3::prelude::*;

use super::{FenceOut, NetOut, Row, fence_out, net_out};
use crate::diagram::Arrays;
use crate::guard::detached;
use crate::maze::tree;

type PlatesOut<'py> = (NetOut<'py>, FenceOut<'py>, Row<'py, i32>, f64);

/// The walls of a maze in the plane, their partners, and the spacing of its plates.
#[pyfunction]
pub(crate) fn crack_plates<'py>(
    py: Python<'py>,
    arrays: Arrays<'py>,
    tree: &str,
    opening: f64,
    key: Key,
    bounds: [f64; 4],
    stretch: Option<([Point; 2], Point, [f64; 4])>,
) -> PyResult<PlatesOut<'py>> {
    let (view, tree) = (arrays.view()?, self::tree(tree)?);
    let how = Carving { tree, opening, key, bounds, stretch };
    let Plates { net, fence, partner, spacing } = detached(py, |watch| crack::plates(view, how, watch))?;
    Ok((net_out(py, net)?, fence_out(py, fence)?, PyArray1::from_vec(py, partner), spacing))
}
