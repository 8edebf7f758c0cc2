//! Pixels to a Python file.

// pyo3 hands arguments over by value.
#![allow(clippy::needless_pass_by_value)]

use std::io::{self, BufWriter, Write};
use std::sync::Mutex;

use crazing::png::{About, Image, bands, encode, head, tail};
use crazing::{Error, Watch};
use numpy::{PyReadonlyArray3, PyUntypedArrayMethods};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::guard::{checked, detached};

/// Bytes handed to Python at once.
const CHUNK: usize = 1 << 20;

/// A Python file for the core to write to, attached only for the write. Keeps the first exception.
struct PyFile<'a> {
    file: &'a Py<PyAny>,
    raised: &'a Mutex<Option<PyErr>>,
}

impl Write for PyFile<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let broken = || io::Error::other("the file refused the bytes");
        let mut raised = self.raised.lock().map_err(|_| broken())?;
        if raised.is_some() {
            return Err(broken());
        }
        Python::attach(|py| self.give(py, bytes)).map_err(|error| {
            *raised = Some(error);
            broken()
        })
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

impl PyFile<'_> {
    /// How many bytes the file took; files that return None take all.
    fn give(&self, py: Python<'_>, bytes: &[u8]) -> PyResult<usize> {
        let taken = self.file.call_method1(py, "write", (PyBytes::new(py, bytes),))?;
        Ok(taken.extract::<Option<usize>>(py)?.unwrap_or(bytes.len()).min(bytes.len()))
    }
}

/// Runs `work` with a writer to `file`; an exception of the file comes out as it is.
fn writing<T: Send>(
    py: Python<'_>,
    file: &Py<PyAny>,
    work: impl FnOnce(&mut BufWriter<PyFile<'_>>, Watch<'_>) -> crazing::Result<T> + Send,
) -> PyResult<T> {
    let raised = Mutex::new(None);
    let outcome = detached(py, |watch| {
        let mut writer = BufWriter::with_capacity(CHUNK, PyFile { file, raised: &raised });
        let value = work(&mut writer, watch)?;
        writer.flush().map_err(|error| Error::Write { reason: error.to_string() })?;
        Ok(value)
    });
    outcome.map_err(|error| raised.into_inner().ok().flatten().unwrap_or(error))
}

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
