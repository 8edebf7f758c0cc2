//! Tapered edges into a picture that NumPy owns.

// pyo3 hands arguments over by value.
#![allow(clippy::needless_pass_by_value)]

use crazing::raster::{self, Colors, Edges, Frame, Style};
use numpy::{PyArray3, PyArrayMethods, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;

use crate::arrays::rows;
use crate::guard::detached;

/// Draws into `out`, a C-contiguous (H, W, 4) uint8 array, all of which is written.
#[pyfunction]
#[allow(clippy::too_many_arguments)]
pub(crate) fn render(
    vertices: PyReadonlyArray2<'_, f64>,
    edges: PyReadonlyArray2<'_, i32>,
    widths: PyReadonlyArray2<'_, f64>,
    bounds: [f64; 4],
    ink: [u8; 4],
    ground: [u8; 4],
    min_width: f64,
    threads: usize,
    out: &Bound<'_, PyArray3<u8>>,
) -> PyResult<()> {
    let &[height, width, 4] = out.shape() else { return Err(PyTypeError::new_err("out is not (H, W, 4)")) };
    let mut picture = out.try_readwrite()?;
    let pixels = picture.as_slice_mut()?;
    let edges = Edges { vertices: rows(&vertices)?, edges: rows(&edges)?, widths: rows(&widths)? };
    let frame = Frame { bounds, height, width };
    let style = Style { colors: Colors { ink, ground }, min_width };
    detached(out.py(), |watch| raster::render(edges, &frame, &style, threads, watch, pixels))
}
