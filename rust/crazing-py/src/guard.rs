//! One door between Python and the core: detaches the interpreter, answers Ctrl-C, maps errors, stops panics; and lets
//! the core write to a file of Python's.

use std::io::{self, BufWriter, Write};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Mutex;
use std::time::{Duration, Instant};

use crazing::{Error, Watch};
use pyo3::create_exception;
use pyo3::exceptions::{PyKeyboardInterrupt, PyMemoryError, PyOSError, PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

create_exception!(crazing, CrazingError, PyValueError, "An input that crazing cannot work with.");
create_exception!(
    crazing,
    DegenerateInputError,
    CrazingError,
    "A well-formed input that has no answer: fewer than 3 distinct sites, or all on one line."
);
create_exception!(crazing, InternalError, PyRuntimeError, "A bug in crazing; please report it.");

/// Time between two looks for a signal.
const LOOK: Duration = Duration::from_millis(50);

/// Bytes handed to Python at once.
const CHUNK: usize = 1 << 20;

/// Where a thread of Python's carries the `threading.Event` that stops it: signals reach only the main thread.
const STOP: &str = "crazing_stop";

/// Raises if a signal handler does, or if the event of the calling thread is set.
fn go_on(py: Python<'_>, stop: Option<&Py<PyAny>>) -> PyResult<()> {
    py.check_signals()?;
    match stop {
        Some(event) if event.call_method0(py, "is_set")?.is_truthy(py)? => Err(PyKeyboardInterrupt::new_err(())),
        _ => Ok(()),
    }
}

fn stop_of_thread(py: Python<'_>) -> PyResult<Option<Py<PyAny>>> {
    let thread = py.import("threading")?.call_method0("current_thread")?;
    Ok(thread.getattr_opt(STOP)?.map(Bound::unbind))
}

/// Runs `work` without the interpreter. `work` stops soon after a signal handler raises, or the thread is told to.
pub(crate) fn detached<T: Send>(
    py: Python<'_>,
    work: impl FnOnce(Watch<'_>) -> crazing::Result<T> + Send,
) -> PyResult<T> {
    let raised: Mutex<Option<PyErr>> = Mutex::new(None);
    let looked = Mutex::new(Instant::now());
    let stop = stop_of_thread(py)?;
    let look = || {
        let Ok(mut last) = looked.try_lock() else { return true };
        if last.elapsed() < LOOK {
            return true;
        }
        *last = Instant::now();
        match Python::attach(|py| go_on(py, stop.as_ref())) {
            Ok(()) => true,
            Err(error) => {
                if let Ok(mut slot) = raised.lock() {
                    *slot = Some(error);
                }
                false
            }
        }
    };
    let whole = || crazing::in_one_pool(|| work(Watch::new(&look)));
    let outcome = py.detach(|| catch_unwind(AssertUnwindSafe(whole)));
    match outcome {
        Ok(Ok(value)) => Ok(value),
        Ok(Err(error)) => Err(raised.into_inner().ok().flatten().unwrap_or_else(|| to_python(&error))),
        Err(panic) => Err(InternalError::new_err(panic_text(panic.as_ref()))),
    }
}

/// A Python file for the core to write to, attached only for the write. Keeps the first exception.
pub(crate) struct PyFile<'a> {
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
pub(crate) fn writing<T: Send>(
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

/// The value of a core result, or its error as a Python exception.
pub(crate) fn checked<T>(result: crazing::Result<T>) -> PyResult<T> {
    result.map_err(|error| to_python(&error))
}

/// The one map from core errors to Python exceptions.
fn to_python(error: &Error) -> PyErr {
    let text = error.to_string();
    match error {
        Error::TooFewSites { .. } | Error::Collinear { .. } => DegenerateInputError::new_err(text),
        Error::OutOfMemory { .. } => PyMemoryError::new_err(text),
        Error::Write { .. } => PyOSError::new_err(text),
        Error::Interrupted => PyKeyboardInterrupt::new_err(()),
        Error::Internal(_) => InternalError::new_err(text),
        _ => CrazingError::new_err(text),
    }
}

fn panic_text(panic: &(dyn std::any::Any + Send)) -> String {
    let words = panic.downcast_ref::<&str>().copied().or_else(|| panic.downcast_ref::<String>().map(String::as_str));
    format!("internal error: {}; please report it", words.unwrap_or("panic"))
}
