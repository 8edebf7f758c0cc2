//! Threads that share independent pieces of work, such as the bands of a picture.
//!
//! The calling thread works too, and is the one that asks the watch: Python tells only its main thread of Ctrl-C.
//! Threads are made for one call: a pool that outlives it would hang in a forked child.

use std::num::NonZero;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread::{self, Builder, ScopedJoinHandle};
use std::time::Duration;

use crate::error::{Error, Result};
use crate::watch::Watch;

/// Between two questions to the watch while the caller waits for the others.
const LOOK: Duration = Duration::from_millis(20);

/// What a worker calls now and then; an error means that it must stop.
pub(crate) type Poll<'a> = &'a dyn Fn() -> Result<()>;

/// How many threads are worth having for that many pieces, the caller's among them; `threads` 0 asks for all cores.
pub(crate) fn size(threads: usize, pieces: usize) -> usize {
    let cores = || thread::available_parallelism().map_or(1, NonZero::get);
    let wanted = if threads == 0 { cores() } else { threads };
    wanted.min(pieces).max(1)
}

/// Both results, at the same time where there are threads for that.
pub(crate) fn both<A, B: Send>(threads: usize, a: impl FnOnce() -> A, b: impl FnOnce() -> B + Send) -> (A, B) {
    if threads < 2 {
        return (a(), b());
    }
    thread::scope(|scope| {
        let other = scope.spawn(b);
        (a(), other.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)))
    })
}

struct Crew<I> {
    pieces: Mutex<I>,
    stop: AtomicBool,
    /// Threads other than the caller's that have not ended their work.
    busy: AtomicUsize,
}

/// Does `work` on every piece, on `threads` threads, each with a state of its own from `make`.
pub(crate) fn share<T, S>(
    pieces: impl Iterator<Item = T> + Send,
    threads: usize,
    watch: Watch<'_>,
    make: impl Fn() -> Result<S> + Sync,
    work: impl Fn(&mut S, T, Poll<'_>) -> Result<()> + Sync,
) -> Result<()> {
    let crew = Crew { pieces: Mutex::new(pieces), stop: AtomicBool::new(false), busy: AtomicUsize::new(0) };
    let caller = thread::current();
    thread::scope(|scope| {
        let hire = |_| {
            let (crew, caller, make, work) = (&crew, &caller, &make, &work);
            let task = move || {
                let outcome = crew.work(make, work, &|| crew.go_on());
                crew.leave();
                caller.unpark();
                outcome
            };
            // Where the system refuses a thread, the others do its work.
            crew.busy.fetch_add(1, Ordering::Relaxed);
            Builder::new().spawn_scoped(scope, task).inspect_err(|_| crew.leave()).ok()
        };
        let hired: Vec<ScopedJoinHandle<'_, _>> = (1..threads).filter_map(hire).collect();
        let own = crew.work(&make, &work, &|| crew.ask(watch)).and_then(|()| crew.wait(&hired, watch));
        let others = hired.into_iter().map(|hand| hand.join().unwrap_or(Err(Error::Internal("a thread panicked"))));
        // The caller's own reason first: it is the one that was interrupted.
        others.fold(own, |first, next| if first == Err(Error::Interrupted) { next.and(first) } else { first.and(next) })
    })
}

impl<T, I: Iterator<Item = T>> Crew<I> {
    /// Takes pieces until none is left.
    fn work<S>(
        &self,
        make: &impl Fn() -> Result<S>,
        work: &impl Fn(&mut S, T, Poll<'_>) -> Result<()>,
        poll: Poll<'_>,
    ) -> Result<()> {
        let outcome = make().and_then(|mut state| {
            while let Some(piece) = self.next() {
                poll()?;
                work(&mut state, piece, poll)?;
            }
            Ok(())
        });
        outcome.inspect_err(|_| self.stop.store(true, Ordering::Relaxed))
    }

    fn next(&self) -> Option<T> {
        self.pieces.lock().ok()?.next()
    }
}

impl<I> Crew<I> {
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
