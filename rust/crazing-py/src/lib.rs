//! The binding: arrays in, arrays out, the interpreter detached while the core works.

mod arrays;
mod guard;
mod png;
mod render;

use pyo3::prelude::*;

#[pymodule(gil_used = false)]
mod _core {
    use pyo3::prelude::*;

    #[pymodule_export]
    use crate::guard::{CrazingError, DegenerateInputError, InternalError};
    #[pymodule_export]
    use crate::png::encode_png;
    #[pymodule_export]
    use crate::render::render;

    /// Names the build, so that a debug build can be told from a release.
    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.add("__version__", env!("CARGO_PKG_VERSION"))?;
        module.add("DEBUG", cfg!(debug_assertions))
    }
}
