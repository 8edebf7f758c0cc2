//! NumPy arrays to slices of rows and back, without a copy.

use numpy::{
    Element, PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2, PyReadwriteArray2,
    PyUntypedArrayMethods,
};
use pyo3::exceptions::PyTypeError;
use pyo3::intern;
use pyo3::prelude::*;

use crate::guard::checked;

/// The rows of a C-contiguous `(n, N)` array. The face makes every array so before it calls.
pub(crate) fn rows<'a, T: Element, const N: usize>(array: &'a PyReadonlyArray2<'_, T>) -> PyResult<&'a [[T; N]]> {
    let shape = array.shape();
    match (array.as_slice(), shape[1] == N) {
        (Ok(flat), true) => Ok(flat.as_chunks::<N>().0),
        _ => Err(PyTypeError::new_err(format!("array of shape {shape:?}; a C-contiguous (n, {N}) array is wanted"))),
    }
}

/// Hands rows to NumPy as an `(n, N)` array that owns them.
pub(crate) fn table<T: Element, const N: usize>(py: Python<'_>, rows: Vec<[T; N]>) -> PyResult<Bound<'_, PyArray2<T>>> {
    let count = rows.len();
    PyArray1::from_vec(py, rows.into_flattened()).reshape([count, N])
}

/// The entries of a contiguous array that has one for each row of another.
pub(crate) fn column<'a, T: Element>(
    array: &'a PyReadonlyArray1<'_, T>,
    name: &'static str,
    wanted: usize,
) -> PyResult<&'a [T]> {
    let found = array.len();
    match array.as_slice() {
        Ok(entries) if found == wanted => Ok(entries),
        _ => checked(Err(crazing::Error::BadLength { array: name, found, wanted })),
    }
}

/// An `(n, N)` array of NumPy's that nothing has been written to yet: what it is cleared for is saved.
pub(crate) fn unwritten<'py, T: Element, const N: usize>(
    py: Python<'py>,
    count: usize,
) -> PyResult<Bound<'py, PyArray2<T>>> {
    let made = py.import(intern!(py, "numpy"))?.call_method1(intern!(py, "empty"), ((count, N), T::get_dtype(py)))?;
    Ok(made.cast_into()?)
}

/// The rows of such an array, to be written.
pub(crate) fn rows_mut<'a, T: Element, const N: usize>(
    array: &'a mut PyReadwriteArray2<'_, T>,
) -> PyResult<&'a mut [[T; N]]> {
    Ok(array.as_slice_mut()?.as_chunks_mut::<N>().0)
}
