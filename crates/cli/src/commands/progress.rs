//! Progress of a long run: what is done, for how long, and an estimate of what is left once there is
//! something to estimate it from. A terminal shows it all the time; elsewhere there is a line on standard
//! error after a few seconds, and others when the time has doubled.

use std::io::IsTerminal;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::{Builder, JoinHandle};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use liouville_search::Meter;

/// Delay before anything appears: a quick command shows nothing.
const BLINK: Duration = Duration::from_millis(300);
/// Delay before the first line where there is no terminal.
const PATIENCE: Duration = Duration::from_secs(5);
/// Time between two looks.
const GLANCE: Duration = Duration::from_millis(200);
/// Parts of a unit that are counted.
const GRAIN: f64 = 1e6;
/// Least time from which the rest is estimated.
const FIRST: Duration = Duration::from_secs(1);
/// Least share from which the rest is estimated.
const LEAST: f64 = 1e-4;

/// Progress of a run, shown by a thread of its own, so that nothing is silent while work goes on.
pub struct Progress {
    state: Arc<RunState>,
    ticker: Mutex<Option<(Sender<()>, JoinHandle<()>)>>,
}

/// Progress of a run, as its threads share it.
struct RunState {
    phase: Mutex<Phase>,
    /// Millionths of units that are done.
    done: AtomicU64,
    /// Share of the present task that is done.
    meter: Meter,
}

/// Phase of a run.
#[derive(Clone)]
struct Phase {
    started: Instant,
    /// Number of units, or none where it is not known.
    count: Option<u64>,
    /// Noun for the units.
    what: &'static str,
    /// The present task, when it or the present part of it began, and the share told last.
    task: String,
    begun: Instant,
    share: f64,
}

impl Phase {
    fn new(count: Option<u64>, what: &'static str) -> Self {
        let now = Instant::now();
        Self { started: now, count, what, task: String::new(), begun: now, share: 0.0 }
    }
}

impl Progress {
    /// Begins to show work of a known number of units.
    pub fn of(count: u64, what: &'static str) -> Self {
        Self::shown(Some(count), what, Meter::default())
    }

    fn shown(count: Option<u64>, what: &'static str, meter: Meter) -> Self {
        let (done, phase) = (AtomicU64::new(0), Mutex::new(Phase::new(count, what)));
        let state = Arc::new(RunState { phase, done, meter });
        let (sender, receiver) = channel();
        let own = Arc::clone(&state);
        let ticker = match std::io::stderr().is_terminal() {
            true => Builder::new().spawn(move || {
                let (mut wait, mut bar) = (BLINK, None);
                while receiver.recv_timeout(wait) == Err(RecvTimeoutError::Timeout) {
                    own.show(bar.get_or_insert_with(|| own.bar()));
                    wait = GLANCE;
                }
                if let Some(bar) = bar {
                    bar.finish_and_clear();
                }
            }),
            false => Builder::new().spawn(move || {
                let mut wait = PATIENCE;
                while receiver.recv_timeout(wait) == Err(RecvTimeoutError::Timeout) {
                    let done = own.done.load(Ordering::Relaxed) as f64 / GRAIN;
                    anstream::eprintln!("at work: {}", own.line(done, Instant::now()));
                    // The next line comes when the time has doubled.
                    wait = locked(&own.phase).started.elapsed();
                }
            }),
        };
        Self { state, ticker: Mutex::new(ticker.ok().map(|thread| (sender, thread))) }
    }

    /// Goes on to work of another number of units.
    pub fn begin(&self, count: u64, what: &'static str) {
        let mut phase = locked(&self.state.phase);
        *phase = Phase::new(Some(count), what);
        self.state.done.store(0, Ordering::Relaxed);
    }

    /// Adds a share of a unit that is done.
    pub fn add(&self, share: f64) {
        self.state.done.fetch_add((share * GRAIN).round() as u64, Ordering::Relaxed);
    }

    /// Tells the present task.
    pub fn tell(&self, task: &str) {
        self.state.meter.clear();
        let mut phase = locked(&self.state.phase);
        (phase.task, phase.begun, phase.share) = (task.to_string(), Instant::now(), 0.0);
    }

    /// Removes what is shown.
    pub fn finish(&self) {
        if let Some((stop, thread)) = locked(&self.ticker).take() {
            drop(stop);
            // A panic of the thread that shows progress is no fault of the work
            _ = thread.join();
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.finish();
    }
}

/// Runs `work`, which tells its present task; `meter` has the share of that which is done.
pub fn telling<T>(meter: Meter, work: impl FnOnce(&mut dyn FnMut(&str)) -> T) -> T {
    let progress = Progress::shown(None, "", meter);
    let done = work(&mut |task| progress.tell(task));
    progress.finish();
    done
}

fn locked<T>(own: &Mutex<T>) -> MutexGuard<'_, T> {
    own.lock().unwrap_or_else(PoisonError::into_inner)
}

impl RunState {
    fn bar(&self) -> ProgressBar {
        let (bar, template) = match locked(&self.phase).count {
            Some(_) => (ProgressBar::new(GRAIN as u64), "{bar:40} {msg}"),
            None => (ProgressBar::new_spinner(), "{spinner} {msg}"),
        };
        bar.set_draw_target(ProgressDrawTarget::stderr());
        match ProgressStyle::with_template(template) {
            Ok(style) => bar.with_style(style),
            Err(_) => bar,
        }
    }

    fn show(&self, bar: &ProgressBar) {
        let done = self.done.load(Ordering::Relaxed) as f64 / GRAIN;
        if let Some(count) = locked(&self.phase).count {
            bar.set_position((GRAIN * done / count.max(1) as f64) as u64);
        }
        bar.set_message(self.line(done, Instant::now()));
        bar.tick();
    }

    /// The words beside the bar.
    fn line(&self, done: f64, now: Instant) -> String {
        let mut phase = locked(&self.phase);
        let elapsed = now.duration_since(phase.started);
        let mut words = Vec::new();
        if let Some(count) = phase.count {
            // Shares are rounded: a unit is done within a thousandth.
            let whole = ((done + 1e-3) as u64).min(count);
            words.push(format!("{whole}/{count} {}", phase.what));
        }
        if !phase.task.is_empty() {
            words.push(phase.task.clone());
        }
        words.push(spoken(elapsed));
        let (share, since, of_what) = match phase.count {
            Some(count) => (Some(done / count as f64), elapsed, ""),
            None => {
                let share = self.meter.share();
                // A task has parts, each of which is counted from 0.
                if share.unwrap_or(0.0) < phase.share {
                    phase.begun = now;
                }
                phase.share = share.unwrap_or(0.0);
                (share, now.duration_since(phase.begun), " for this step")
            }
        };
        if let Some(left) = share.and_then(|share| remaining(since, share)) {
            words.push(format!("about {} left{of_what}", spoken(left)));
        }
        words.join(", ")
    }
}

/// Time that is left, if the rest takes as long as a share did; none before that says anything.
fn remaining(elapsed: Duration, share: f64) -> Option<Duration> {
    let is_known = elapsed >= FIRST && (LEAST..1.0).contains(&share);
    let left = elapsed.as_secs_f64() * (1.0 - share) / share;
    is_known.then(|| Duration::from_secs_f64(left.max(1.0)))
}

/// Words for a duration, with one or two units.
fn spoken(time: Duration) -> String {
    let seconds = time.as_secs();
    match seconds {
        0..120 => format!("{seconds} s"),
        120..7200 => format!("{} min", seconds / 60),
        7200..172_800 => format!("{} h {} min", seconds / 3600, seconds / 60 % 60),
        _ => format!("{} days {} h", seconds / 86_400, seconds / 3600 % 24),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn state(count: Option<u64>) -> (RunState, Instant) {
        let phase = Phase::new(count, "orbits");
        let started = phase.started;
        let (phase, done) = (Mutex::new(phase), AtomicU64::new(0));
        (RunState { phase, done, meter: Meter::default() }, started)
    }

    #[test]
    fn nothing_is_estimated_from_nothing() {
        let (run, started) = state(Some(200));
        let at = |seconds: u64| started + Duration::from_secs(seconds);
        assert_eq!(run.line(0.0, at(30)), "0/200 orbits, 30 s");
        assert_eq!(run.line(0.004, at(30)), "0/200 orbits, 30 s", "too little to tell");
        assert_eq!(run.line(150.0, at(0)), "150/200 orbits, 0 s", "too early to tell");
        assert_eq!(run.line(150.5, at(30)), "150/200 orbits, 30 s, about 9 s left");
        assert_eq!(run.line(0.5, at(30)), "0/200 orbits, 30 s, about 3 h 19 min left");
        assert_eq!(run.line(200.0, at(30)), "200/200 orbits, 30 s", "what is left is not known");
        assert_eq!(run.line(260.0, at(30)), "200/200 orbits, 30 s", "more than was foreseen");
        let (none, started) = state(Some(0));
        assert_eq!(none.line(0.0, started + FIRST), "0/0 orbits, 1 s", "nothing to do");
    }

    #[test]
    fn a_step_has_its_own_estimate() {
        let (run, started) = state(None);
        let at = |seconds: u64| started + Duration::from_secs(seconds);
        {
            let mut phase = locked(&run.phase);
            (phase.task, phase.begun) = ("integrals of degree 4".to_string(), at(100));
        }
        assert_eq!(run.line(0.0, at(103)), "integrals of degree 4, 103 s");
        run.meter.set(1, 4);
        let line = run.line(0.0, at(110));
        assert_eq!(line, "integrals of degree 4, 110 s, about 30 s left for this step");
        run.meter.set(1, 100);
        assert_eq!(run.line(0.0, at(115)), "integrals of degree 4, 115 s", "its next part");
        run.meter.set(1, 2);
        let line = run.line(0.0, at(119));
        assert_eq!(line, "integrals of degree 4, 119 s, about 4 s left for this step");
        run.meter.clear();
        assert_eq!(run.line(0.0, at(119)), "integrals of degree 4, 119 s");
    }

    #[test]
    fn shares_of_units_add_up() {
        let progress = Progress::of(3, "orbits");
        for _ in 0..999 {
            progress.add(0.001);
        }
        progress.add(0.001);
        progress.add(1.0);
        let done = progress.state.done.load(Ordering::Relaxed) as f64 / GRAIN;
        assert!((done - 2.0).abs() < 1e-3, "{done}");
        progress.begin(5, "claims");
        assert_eq!(progress.state.done.load(Ordering::Relaxed), 0, "counted anew");
        progress.finish();
    }

    #[test]
    fn durations_have_words() {
        let told = |seconds| spoken(Duration::from_secs(seconds));
        assert_eq!(told(119), "119 s");
        assert_eq!(told(150), "2 min");
        assert_eq!(told(7260), "2 h 1 min");
        assert_eq!(told(200_000), "2 days 7 h");
    }
}
