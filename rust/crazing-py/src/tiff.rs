//! Tiles of a TIFF, compressed.

use crazing::tiff::{Tiles, compress};
use numpy::{PyReadonlyArray4, PyUntypedArrayMethods};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::guard::detached;

/// C-contiguous (tiles, H, W, channels * sample) bytes as one zlib stream a tile.
#[pyfunction]
pub(crate) fn tiff_tiles(
    py: Python<'_>,
    tiles: PyReadonlyArray4<'_, u8>,
    sample: usize,
    float: bool,
) -> PyResult<Vec<Py<PyBytes>>> {
    let &[_, height, width, depth] = tiles.shape() else { return Err(PyTypeError::new_err("(n, H, W, C) is wanted")) };
    let (bytes, channels) = (tiles.as_slice()?, depth / sample.max(1));
    let found = detached(py, |watch| compress(Tiles { bytes, height, width, channels, sample, float }, watch))?;
    Ok(found.iter().map(|bytes| PyBytes::new(py, bytes).unbind()).collect())
}
