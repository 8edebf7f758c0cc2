//! One door between Python and the core: detaches the interpreter, answers Ctrl-C, maps errors, stops panics.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Mutex;
use std::time::{Duration, Instant};

use crazing::{Error, Watch};
use pyo3::create_exception;
use pyo3::exceptions::{PyKeyboardInterrupt, PyMemoryError, PyOSError, PyRuntimeError, PyValueError};
use pyo3::prelude::*;

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

/// Runs `work` without the interpreter. `work` stops soon after a signal handler raises.
pub(crate) fn detached<T: Send>(
    py: Python<'_>,
    work: impl FnOnce(Watch<'_>) -> crazing::Result<T> + Send,
) -> PyResult<T> {
    let raised: Mutex<Option<PyErr>> = Mutex::new(None);
    let looked = Mutex::new(Instant::now());
    let go_on = || {
        let Ok(mut last) = looked.try_lock() else { return true };
        if last.elapsed() < LOOK {
            return true;
        }
        *last = Instant::now();
        match Python::attach(|py| py.check_signals()) {
            Ok(()) => true,
            Err(error) => {
                if let Ok(mut slot) = raised.lock() {
                    *slot = Some(error);
                }
                false
            }
        }
    };
    let whole = || crazing::in_one_pool(|| work(Watch::new(&go_on)));
    let outcome = py.detach(|| catch_unwind(AssertUnwindSafe(whole)));
    match outcome {
        Ok(Ok(value)) => Ok(value),
        Ok(Err(error)) => Err(raised.into_inner().ok().flatten().unwrap_or_else(|| to_python(&error))),
        Err(panic) => Err(InternalError::new_err(panic_text(panic.as_ref()))),
    }
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
