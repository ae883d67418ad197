//! Limits of time and memory, and Ctrl-C: a watch beside the work.

use std::fmt;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::sync::{Arc, OnceLock};
use std::thread::Builder;
use std::time::{Duration, Instant};

use clap::Args;
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;

/// Time between two looks at the clock and at the memory.
const GLANCE: Duration = Duration::from_millis(20);

/// Stack of the thread that works.
const STACK: usize = 64 << 20;

/// Exit code of a program ended by a second Ctrl-C.
const INTERRUPTED: i32 = 130;

/// Exit code of a command that a limit or Ctrl-C stopped.
pub const STOPPED: u8 = 3;

/// Limits of time and memory.
#[derive(Clone, Copy, Debug, Default, Args)]
pub struct LimitArgs {
    /// Stop after SECONDS and report what was reached; the exit code is then 3
    #[arg(long, value_name = "SECONDS", value_parser = parse_seconds)]
    pub within: Option<Duration>,
    /// Stop when the program takes more than N megabytes of memory; the exit code is then 3
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    pub megabytes: Option<u64>,
}

/// Reads a positive number of seconds.
pub fn parse_seconds(text: &str) -> Result<Duration, String> {
    let seconds = text.parse().ok().and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
    seconds.filter(|time| !time.is_zero()).ok_or("write a positive number of seconds".to_string())
}

/// Reason for an early end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stop {
    /// The time is over.
    Time(Duration),
    /// The program takes more megabytes.
    Memory(u64),
    /// Ctrl-C, or a request to end.
    Signal,
    /// The work failed.
    Failed,
}

impl fmt::Display for Stop {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Stop::Time(time) => write!(out, "stopped after {} s", time.as_secs_f64()),
            Stop::Memory(megabytes) => write!(out, "stopped at {megabytes} megabytes of memory"),
            Stop::Signal => write!(out, "stopped by a signal"),
            Stop::Failed => write!(out, "stopped by a fault of the program"),
        }
    }
}

impl Stop {
    /// Message of a command that was ended early; the remedy of a job in parts counts for every reason.
    pub fn message(&self, of_parts: Option<&str>) -> String {
        let is_limit = matches!(self, Stop::Time(_) | Stop::Memory(_));
        let remedy = of_parts.or(is_limit.then_some("allow more, or ask for less"));
        let help = remedy.map_or(String::new(), |remedy| format!("\nhelp: {remedy}"));
        format!("error: not finished: {self}{help}")
    }
}

impl LimitArgs {
    /// Whether there is a limit.
    fn is_some(&self) -> bool {
        self.within.is_some() || self.megabytes.is_some()
    }

    /// Waits for a result, a limit, or a signal.
    pub fn wait<T>(&self, result: &Receiver<T>, signal: &AtomicBool) -> Result<T, Stop> {
        let started = Instant::now();
        loop {
            match result.recv_timeout(GLANCE) {
                Ok(found) => return Ok(found),
                Err(RecvTimeoutError::Disconnected) => return Err(Stop::Failed),
                Err(RecvTimeoutError::Timeout) => {}
            }
            if signal.load(Ordering::Relaxed) {
                return Err(Stop::Signal);
            }
            if let Some(time) = self.within.filter(|time| started.elapsed() >= *time) {
                return Err(Stop::Time(time));
            }
            if let Some(most) = self.megabytes.filter(|most| memory().is_some_and(|m| m > *most)) {
                return Err(Stop::Memory(most));
            }
        }
    }

    /// Message that the program, which has ended, took more memory than it was to: it may do so between
    /// two looks.
    pub fn exceeded(&self) -> Option<String> {
        let most = self.megabytes?;
        let peak = kilobytes("VmHWM:")?.div_ceil(1024);
        (peak > most).then(|| {
            format!(
                "error: --megabytes {most}: the program took {peak} megabytes, and had finished before it \
                 was stopped\nhelp: the results are complete; allow {peak} or more"
            )
        })
    }

    /// Checks that the system tells how much memory the program takes, if that is limited.
    pub fn check(&self) -> Result<(), String> {
        match self.megabytes.is_some() && memory().is_none() {
            true => Err("error: this system does not tell how much memory a program takes\n\
                         help: leave --megabytes out, and limit the memory outside"
                .to_string()),
            false => Ok(()),
        }
    }

    /// Runs work that has nothing to report before its end.
    ///
    /// At a limit the thread that works is left behind; it ends with the program.
    pub fn run<T: Send + 'static>(
        &self,
        work: impl FnOnce() -> T + Send + 'static,
    ) -> Result<T, Stop> {
        if !self.is_some() {
            return Ok(work());
        }
        let (sender, receiver) = channel();
        let thread = Builder::new().stack_size(STACK).spawn(move || {
            // nobody waits any more if this fails
            _ = sender.send(work());
        });
        match thread {
            Ok(_) => self.wait(&receiver, &AtomicBool::new(false)),
            Err(_) => Err(Stop::Failed),
        }
    }
}

/// A watch that raises a flag when the program takes more memory than it is to, until it is dropped.
pub struct MemoryWatch(Arc<AtomicBool>);

impl MemoryWatch {
    /// Starts a watch; without a limit there is nothing to see.
    pub fn start(most: Option<u64>, raised: Arc<AtomicBool>) -> Self {
        let done = Arc::new(AtomicBool::new(most.is_none()));
        let ended = Arc::clone(&done);
        if let Some(most) = most {
            std::thread::spawn(move || {
                while !ended.load(Ordering::Relaxed) {
                    if memory().is_some_and(|own| own > most) {
                        raised.store(true, Ordering::Relaxed);
                        return;
                    }
                    std::thread::sleep(GLANCE);
                }
            });
        }
        Self(done)
    }
}

impl Drop for MemoryWatch {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

/// Returns the flag of the process that Ctrl-C and a request to end raise; a second Ctrl-C exits.
pub fn signals() -> Result<Arc<AtomicBool>, String> {
    static RAISED: OnceLock<Arc<AtomicBool>> = OnceLock::new();
    if let Some(raised) = RAISED.get() {
        return Ok(Arc::clone(raised));
    }
    let raised = Arc::new(AtomicBool::new(false));
    for signal in [SIGINT, SIGTERM] {
        flag::register_conditional_shutdown(signal, INTERRUPTED, Arc::clone(&raised))
            .and_then(|_| flag::register(signal, Arc::clone(&raised)))
            .map_err(|error| format!("error: cannot listen to signals: {error}"))?;
    }
    Ok(Arc::clone(RAISED.get_or_init(|| raised)))
}

/// Megabytes of memory that the program takes, where the system tells.
fn memory() -> Option<u64> {
    kilobytes("VmRSS:").map(|kilobytes| kilobytes / 1024)
}

/// Number of kilobytes of a line about the process.
fn kilobytes(name: &str) -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix(name))?;
    line.split_whitespace().next()?.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn forever() {
        loop {
            std::thread::sleep(GLANCE);
        }
    }

    #[test]
    fn work_beyond_a_limit_is_left() {
        let limits = LimitArgs { within: Some(Duration::from_millis(50)), megabytes: None };
        let stop = limits.run(forever).expect_err("stopped");
        assert_eq!(stop.to_string(), "stopped after 0.05 s");
        if memory().is_some() {
            let limits = LimitArgs { within: None, megabytes: Some(1) };
            let stop = limits.run(forever).expect_err("stopped");
            assert_eq!(stop, Stop::Memory(1));
        }
        let limits = LimitArgs { within: Some(Duration::from_secs(3600)), megabytes: None };
        assert_eq!(limits.run(|| 7), Ok(7), "what ends is handed over");
    }

    #[test]
    fn seconds_are_positive() {
        assert_eq!(parse_seconds("0.5"), Ok(Duration::from_millis(500)));
        for text in ["0", "-1", "soon", "nan", "1e400"] {
            assert!(parse_seconds(text).is_err(), "{text}");
        }
    }

    #[test]
    fn a_limit_can_be_raised_and_a_signal_cannot() {
        assert!(Stop::Memory(10).message(None).contains("\nhelp: allow more"));
        assert_eq!(Stop::Signal.message(None), "error: not finished: stopped by a signal");
        assert!(Stop::Signal.message(Some("run it again")).ends_with("\nhelp: run it again"));
    }
}
