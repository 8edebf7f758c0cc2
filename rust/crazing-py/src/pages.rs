//! Large arrays on huge pages, where the system wants to be asked for them.
//!
//! To touch fresh memory costs several times as much by pages of 4 KiB as by those of 2 MiB, and random access misses
//! the tables of pages less often. Linux, as most distributions set it up, gives huge pages to those who ask; NumPy
//! asks for its own arrays, and this does for ours.

#![allow(unsafe_code, reason = "an allocator cannot be written without; it adds advice to the system's own, no more")]

use std::alloc::{GlobalAlloc, Layout, System};

/// The system's allocator, and a word about every large piece it gives.
pub(crate) struct HugePages;

/// Pieces from this size on are worth it: two huge pages, the least that surely hold a whole one.
const LARGE: usize = 1 << 22;

// SAFETY: every call goes to the system's allocator as it came, and its answer back as it is.
unsafe impl GlobalAlloc for HugePages {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        advised(unsafe { System.alloc(layout) }, layout.size())
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        advised(unsafe { System.alloc_zeroed(layout) }, layout.size())
    }

    unsafe fn realloc(&self, piece: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        advised(unsafe { System.realloc(piece, layout, size) }, size)
    }

    unsafe fn dealloc(&self, piece: *mut u8, layout: Layout) {
        unsafe { System.dealloc(piece, layout) }
    }
}

/// Asks for huge pages behind a large piece; whether it gets them changes nothing but time.
#[inline]
fn advised(piece: *mut u8, size: usize) -> *mut u8 {
    #[cfg(target_os = "linux")]
    if size >= LARGE && !piece.is_null() {
        const PAGE: usize = 1 << 12;
        let before = piece.addr().wrapping_neg() % PAGE;
        let whole = (size - before) / PAGE * PAGE;
        // SAFETY: these are whole pages inside of the piece, and advice about them changes no byte. Where pages are
        // larger the call may fail, which is as good as not asking.
        unsafe { libc::madvise(piece.add(before).cast(), whole, libc::MADV_HUGEPAGE) };
    }
    #[cfg(not(target_os = "linux"))]
    let _ = (size, LARGE);
    piece
}
