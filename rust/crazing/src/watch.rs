//! How long work is stopped from outside: it asks, now and then, whether to go on.

use crate::error::{Error, Result};

/// Steps of a tight loop between two questions: some tens of microseconds of work.
pub const STRIDE: usize = 1 << 12;

/// Answers whether work should go on. The core owns no clock and knows no signals: the caller does.
#[derive(Clone, Copy)]
pub struct Watch<'a> {
    go_on: &'a (dyn Fn() -> bool + Sync),
}

impl std::fmt::Debug for Watch<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Watch")
    }
}

impl<'a> Watch<'a> {
    /// A watch that asks `go_on`, which must be cheap and may be called from any thread.
    pub fn new(go_on: &'a (dyn Fn() -> bool + Sync)) -> Self {
        Self { go_on }
    }

    /// Asks now.
    ///
    /// # Errors
    /// [`Error::Interrupted`] when the caller wants the work to stop.
    pub fn poll(&self) -> Result<()> {
        if (self.go_on)() { Ok(()) } else { Err(Error::Interrupted) }
    }

    /// Asks once every [`STRIDE`] steps.
    ///
    /// # Errors
    /// [`Error::Interrupted`] when the caller wants the work to stop.
    pub fn poll_at(&self, step: usize) -> Result<()> {
        if step.is_multiple_of(STRIDE) { self.poll() } else { Ok(()) }
    }
}

impl Default for Watch<'_> {
    /// A watch that never stops the work.
    fn default() -> Self {
        Self { go_on: &|| true }
    }
}
