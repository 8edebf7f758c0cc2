//! Tiles of a TIFF, compressed.

use crazing::tiff::{Band, compress};
use numpy::{PyReadonlyArray3, PyUntypedArrayMethods};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;

use crate::guard::writing;

/// Writes C-contiguous (H, W, channels * sample) bytes to an open binary file, cut into tiles of that many rows and
/// columns, as one zlib stream a tile. How many bytes each takes.
#[pyfunction]
pub(crate) fn tiff_tiles(
    py: Python<'_>,
    file: Py<PyAny>,
    rows: PyReadonlyArray3<'_, u8>,
    sample: usize,
    float: bool,
    tile: [usize; 2],
) -> PyResult<Vec<usize>> {
    let &[_, width, depth] = rows.shape() else { return Err(PyTypeError::new_err("(H, W, C) is wanted")) };
    let (bytes, channels) = (rows.as_slice()?, depth / sample.max(1));
    let band = Band { bytes, width, channels, sample, float, tile };
    writing(py, &file, |writer, watch| compress(writer, band, watch))
}
