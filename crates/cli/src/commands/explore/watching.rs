//! Commands that report what was reached where a limit or Ctrl-C stops them.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::channel;

use liouville_flow::stoppable;

use super::super::limits::{STOPPED, Stop, signals};
use super::{CommandOutput, LimitArgs};

/// Runs work that returns its report, and whether it was stopped before its end; of a job that may be done
/// in parts the remedy is given.
pub fn watched(
    limits: LimitArgs,
    of_parts: Option<&str>,
    work: impl FnOnce() -> Result<(String, bool), String>,
) -> Result<CommandOutput, String> {
    limits.check()?;
    let watch = Watch::new(limits)?;
    let found = stoppable(&watch.raised, work);
    let (raised, stop) = (Arc::clone(&watch.raised), watch.end());
    let (text, is_stopped) = match found {
        // nothing was reached
        Err(_) if raised.load(Ordering::Relaxed) => (String::new(), true),
        other => other?,
    };
    if is_stopped {
        let stopped = "error: not finished: stopped".to_string();
        anstream::eprintln!("{}", stop.map_or(stopped, |stop| stop.message(of_parts)));
    }
    Ok(CommandOutput { text, code: if is_stopped { STOPPED } else { 0 } })
}

/// Watch over limits and signals beside the work.
struct Watch {
    raised: Arc<AtomicBool>,
    done: std::sync::mpsc::Sender<()>,
    thread: std::thread::JoinHandle<Option<Stop>>,
}

impl Watch {
    fn new(limits: LimitArgs) -> Result<Self, String> {
        let (signal, raised) = (signals()?, Arc::new(AtomicBool::new(false)));
        let (done, receiver) = channel();
        let flag = Arc::clone(&raised);
        let thread = std::thread::Builder::new()
            .spawn(move || {
                let stop = limits.wait(&receiver, &signal).err();
                flag.store(stop.is_some(), Ordering::Relaxed);
                stop
            })
            .map_err(|error| format!("error: cannot start a thread: {error}"))?;
        Ok(Self { raised, done, thread })
    }

    /// Ends the watch; returns the reason for which it stopped the work.
    fn end(self) -> Option<Stop> {
        // nobody waits any more if this fails
        _ = self.done.send(());
        self.thread.join().ok().flatten()
    }
}
