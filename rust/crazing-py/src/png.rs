//! Pixels to a Python file.

// pyo3 hands arguments over by value.
#![allow(clippy::needless_pass_by_value)]

use std::io::{self, BufWriter, Write};
use std::sync::Mutex;

use crazing::Error;
use crazing::png::{Image, encode};
use numpy::{PyReadonlyArray3, PyUntypedArrayMethods};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::guard::detached;

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

/// Writes a C-contiguous (H, W, channels) uint8 array as a PNG to an open binary file.
#[pyfunction]
pub(crate) fn encode_png(
    py: Python<'_>,
    file: Py<PyAny>,
    image: PyReadonlyArray3<'_, u8>,
    text: Vec<(String, String)>,
) -> PyResult<()> {
    let &[height, width, channels] = image.shape() else { return Err(PyTypeError::new_err("(H, W, C) is wanted")) };
    let pixels = image.as_slice()?;
    let raised = Mutex::new(None);
    let outcome = detached(py, |watch| {
        let mut writer = BufWriter::with_capacity(CHUNK, PyFile { file: &file, raised: &raised });
        encode(&mut writer, Image { pixels, height, width, channels }, &text, watch)?;
        writer.flush().map_err(|error| Error::Write { reason: error.to_string() })
    });
    outcome.map_err(|error| raised.into_inner().ok().flatten().unwrap_or(error))
}
