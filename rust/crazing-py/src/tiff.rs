//! Tiles of a TIFF, compressed.

use crazing::tiff::{Band, compress};
use numpy::{PyReadonlyArray3, PyUntypedArrayMethods};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::guard::detached;

/// C-contiguous (H, W, channels * sample) bytes cut into tiles of that many rows and columns, as one zlib stream a tile.
#[pyfunction]
pub(crate) fn tiff_tiles(
    py: Python<'_>,
    rows: PyReadonlyArray3<'_, u8>,
    sample: usize,
    float: bool,
    tile: [usize; 2],
) -> PyResult<Vec<Py<PyBytes>>> {
    let &[_, width, depth] = rows.shape() else { return Err(PyTypeError::new_err("(H, W, C) is wanted")) };
    let (bytes, channels) = (rows.as_slice()?, depth / sample.max(1));
    let found = detached(py, |watch| compress(Band { bytes, width, channels, sample, float, tile }, watch))?;
    Ok(found.iter().map(|bytes| PyBytes::new(py, bytes).unbind()).collect())
}
