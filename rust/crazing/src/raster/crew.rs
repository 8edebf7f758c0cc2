//! The threads that share the rows of tiles.
//!
//! The calling thread works too, and is the one that asks the watch: Python tells only its main thread of Ctrl-C.
//! Threads are made for one call: a pool that outlives it would hang in a forked child.

use std::num::NonZero;
use std::slice::ChunksMut;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread::{self, Builder, ScopedJoinHandle};
use std::time::Duration;

use super::Scene;
use super::frame::Frame;
use super::tile::{TILE, Tile};
use crate::error::{Error, Result};
use crate::watch::Watch;

/// Between two questions to the watch while the caller waits for the others.
const LOOK: Duration = Duration::from_millis(20);

/// Pixels and edges below which starting a thread costs more than it saves.
const SMALL: (usize, usize) = (1 << 17, 1 << 9);

/// How many threads are worth having, the caller's among them; `threads` 0 asks for all cores.
pub(super) fn size(threads: usize, frame: &Frame, edges: usize) -> usize {
    if frame.height * frame.width <= SMALL.0 && edges <= SMALL.1 {
        return 1;
    }
    let cores = || thread::available_parallelism().map_or(1, NonZero::get);
    let wanted = if threads == 0 { cores() } else { threads };
    wanted.min(frame.height.div_ceil(TILE))
}

struct Crew<'a> {
    scene: &'a Scene<'a>,
    bands: Mutex<std::iter::Enumerate<ChunksMut<'a, u8>>>,
    stop: AtomicBool,
    /// Threads other than the caller's that have not ended their work.
    busy: AtomicUsize,
}

/// Draws the whole scene into `out`.
pub(super) fn paint(scene: &Scene<'_>, out: &mut [u8], threads: usize, watch: Watch<'_>) -> Result<()> {
    let bands = Mutex::new(out.chunks_mut(TILE * scene.width * 4).enumerate());
    let crew = Crew { scene, bands, stop: AtomicBool::new(false), busy: AtomicUsize::new(0) };
    let caller = thread::current();
    thread::scope(|scope| {
        let hire = |_| {
            let (crew, caller) = (&crew, &caller);
            let work = move || {
                let outcome = crew.work(&|| crew.go_on());
                crew.leave();
                caller.unpark();
                outcome
            };
            // Where the system refuses a thread, the others do its work.
            crew.busy.fetch_add(1, Ordering::Relaxed);
            Builder::new().spawn_scoped(scope, work).inspect_err(|_| crew.leave()).ok()
        };
        let hired: Vec<ScopedJoinHandle<'_, _>> = (1..threads).filter_map(hire).collect();
        let own = crew.work(&|| crew.ask(watch)).and_then(|()| crew.wait(&hired, watch));
        let others = hired.into_iter().map(|hand| hand.join().unwrap_or(Err(Error::Internal("a thread panicked"))));
        // The caller's own reason first: it is the one that was interrupted.
        others.fold(own, |first, next| if first == Err(Error::Interrupted) { next.and(first) } else { first.and(next) })
    })
}

impl Crew<'_> {
    /// Draws rows of tiles until none is left.
    fn work(&self, poll: &dyn Fn() -> Result<()>) -> Result<()> {
        let outcome = Tile::new().and_then(|mut tile| {
            while let Some((row, pixels)) = self.next() {
                self.scene.band(row, pixels, &mut tile, poll)?;
            }
            Ok(())
        });
        outcome.inspect_err(|_| self.stop.store(true, Ordering::Relaxed))
    }
}

impl<'a> Crew<'a> {
    fn next(&self) -> Option<(usize, &'a mut [u8])> {
        self.bands.lock().ok()?.next()
    }

    fn leave(&self) {
        self.busy.fetch_sub(1, Ordering::Release);
    }

    fn go_on(&self) -> Result<()> {
        if self.stop.load(Ordering::Relaxed) { Err(Error::Interrupted) } else { Ok(()) }
    }

    fn ask(&self, watch: Watch<'_>) -> Result<()> {
        self.go_on()?;
        watch.poll()
    }

    /// Waits for the others, still asking the watch.
    fn wait(&self, hired: &[ScopedJoinHandle<'_, Result<()>>], watch: Watch<'_>) -> Result<()> {
        // A thread that panicked stays counted, but it has finished.
        while self.busy.load(Ordering::Acquire) > 0 && !hired.iter().all(ScopedJoinHandle::is_finished) {
            self.ask(watch).inspect_err(|_| self.stop.store(true, Ordering::Relaxed))?;
            thread::park_timeout(LOOK);
        }
        Ok(())
    }
}
