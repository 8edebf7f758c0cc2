//! The binding: arrays in, arrays out, the interpreter detached while the core works.

#![allow(clippy::needless_pass_by_value, reason = "PyO3 hands arguments over by value")]

mod arrays;
mod graph;
mod guard;

use pyo3::prelude::*;

#[pymodule(gil_used = false)]
mod _core {
    use pyo3::prelude::*;

    #[pymodule_export]
    use crate::guard::{CrazingError, DegenerateInputError, InternalError};

    #[pymodule_export]
    use crate::graph::{graph_compact, graph_components, graph_degrees, graph_polylines};

    /// Names the build, so that a debug build can be told from a release.
    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.add("__version__", env!("CARGO_PKG_VERSION"))?;
        module.add("DEBUG", cfg!(debug_assertions))
    }
}
