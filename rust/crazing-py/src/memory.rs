//! Where the extension gets its memory from.
//!
//! A pattern of a million plates asks for arrays of megabytes and gives them back, step after step. The allocators of
//! most systems return each to the kernel at once, which clears the same pages again for the next step: a fifth of the
//! time of a large pattern. mimalloc keeps them for a while, in large pages where the system has these.

use mimalloc::MiMalloc;

#[global_allocator]
static ALLOCATOR: MiMalloc = MiMalloc;

/// `mi_option_purge_delay` of mimalloc.h, for which the binding has no name.
const PURGE_DELAY: libmimalloc_sys::mi_option_t = 15;

/// How long memory without use is kept, in milliseconds: longer than any step takes.
const KEPT: std::ffi::c_long = 10_000;

/// Keeps memory that was given back for what is computed next; `MIMALLOC_PURGE_DELAY` in the environment goes first.
pub(crate) fn keep() {
    #[allow(unsafe_code, reason = "the allocator's options are set through its C interface")]
    // SAFETY: the option exists, any number is a delay, and options may be set at any time from any thread.
    unsafe {
        libmimalloc_sys::mi_option_set_default(PURGE_DELAY, KEPT);
    }
}
