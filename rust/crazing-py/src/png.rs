//! Pixels to a Python file.

// pyo3 hands arguments over by value.
#![allow(clippy::needless_pass_by_value)]

use crazing::png::{About, Image, bands, encode, head, tail};
use numpy::{PyReadonlyArray3, PyUntypedArrayMethods};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::guard::{checked, writing};

/// C-contiguous (H, W, channels * depth / 8) bytes as an image.
fn image_of<'a>(pixels: &'a PyReadonlyArray3<'_, u8>, depth: usize) -> PyResult<Image<'a>> {
    let &[height, width, bytes] = pixels.shape() else { return Err(PyTypeError::new_err("(H, W, C) is wanted")) };
    let channels = bytes * 8 / depth.max(1);
    Ok(Image { pixels: pixels.as_slice()?, height, width, channels, depth })
}

/// Writes a C-contiguous (H, W, channels * depth / 8) array of bytes as a PNG to an open binary file.
#[pyfunction]
pub(crate) fn encode_png(
    py: Python<'_>,
    file: Py<PyAny>,
    pixels: PyReadonlyArray3<'_, u8>,
    depth: usize,
    text: Vec<(String, String)>,
    srgb: bool,
    density: [u32; 2],
) -> PyResult<()> {
    let image = image_of(&pixels, depth)?;
    writing(py, &file, |writer, watch| encode(writer, image, &About { text, srgb, density }, watch))
}

/// What stands before the pixels of a PNG of that shape: height, width, channels, bits a sample.
#[pyfunction]
pub(crate) fn png_head(
    py: Python<'_>,
    shape: [usize; 4],
    text: Vec<(String, String)>,
    srgb: bool,
    density: [u32; 2],
) -> PyResult<Py<PyBytes>> {
    let [height, width, channels, depth] = shape;
    let image = Image { pixels: &[], height, width, channels, depth };
    let bytes = checked(head(image, &About { text, srgb, density }))?;
    Ok(PyBytes::new(py, &bytes).unbind())
}

/// Writes the next rows of a PNG to an open binary file; from the checksum of the rows before, that of all so far.
#[pyfunction]
pub(crate) fn png_rows(
    py: Python<'_>,
    file: Py<PyAny>,
    pixels: PyReadonlyArray3<'_, u8>,
    depth: usize,
    adler: u32,
) -> PyResult<u32> {
    let image = image_of(&pixels, depth)?;
    writing(py, &file, |writer, watch| bands(writer, image, adler, watch))
}

/// What stands behind the pixels of a PNG.
#[pyfunction]
pub(crate) fn png_tail(py: Python<'_>, adler: u32) -> Py<PyBytes> {
    PyBytes::new(py, &tail(adler)).unbind()
}
