//! Tracks of contact points, for `liouville motion orbit --track`.

use liouville::case::Case;
use liouville::mechanics::System;
use liouville::number::double_double::DoubleDouble;
use liouville::number::rational::Rational;
use liouville_flow::{
    Columns, FlowError, Lexicon, Precision, RollingSamples, SampledOrbit, Sampling, Start, Track,
    track,
};

/// Error of the carried normal below which a track is fine enough.
const ERROR: f64 = 1e-7;
/// Samples between two points of a track, at first and at most.
const FEWEST: i64 = 4;
const MOST_SAMPLES: i64 = 256;
/// Values of a sample: ω, γ, r'.
const COLUMNS: &str = "ω, γ, r'";

/// Motions with their tracks.
pub struct Tracks {
    pub found: Vec<SampledOrbit>,
    pub tracks: Vec<Track>,
}

/// Checks that the body of a case rolls on a plane.
pub fn check(case: &Case) -> Result<(), String> {
    let is_plane = matches!(case.model.system, System::Rubber(_) | System::Spinning(_))
        && !case.model.system.is_curved();
    match is_plane {
        true => Ok(()),
        false => Err("error: --track is the path of a contact point on a plane\n\
                      help: give a case with system = \"rubber-plane\" or \"rolling-plane\", or draw \
                      columns by --plot 'x, y'"
            .to_string()),
    }
}

/// Follows motions, with samples close enough together for the errors of their tracks.
pub fn follow(
    case: &Case,
    starts: &[Result<Start, FlowError>],
    (time, every): (&Rational, &Rational),
    threads: usize,
    progress: &(dyn Fn(f64) + Sync),
) -> Result<Tracks, String> {
    let columns = Columns::read(Lexicon::new(case), COLUMNS)
        .map_err(|mistake| format!("error: {}", mistake.message))?;
    let mut between = FEWEST;
    loop {
        let step = every * &Rational::new(1, between);
        let sampling = Sampling { columns: &columns, every: step.clone(), with_steps: false };
        let followed = (time, Precision::Float);
        let found =
            liouville_flow::orbits(case, starts, followed, Some(&sampling), threads, progress);
        let sign = if time.to_f64().0 < 0.0 { -1.0 } else { 1.0 };
        let step = sign * step.to_f64().0;
        let stride = usize::try_from(between / FEWEST).unwrap_or(1);
        let tracks: Vec<Track> = found
            .iter()
            .map(|one| {
                let motion: Vec<RollingSamples> = one.rows.iter().map(|row| rolling(row)).collect();
                let Track { points, error } = track(&motion, step);
                Track { points: points.into_iter().step_by(stride).collect(), error }
            })
            .collect();
        if between >= MOST_SAMPLES || tracks.iter().all(|track| track.error < ERROR) {
            return Ok(Tracks { found, tracks });
        }
        between *= 4;
    }
}

fn rolling(row: &[DoubleDouble]) -> RollingSamples {
    let three = |from: usize| [0, 1, 2].map(|k| row.get(from + k).map_or(f64::NAN, |x| x.hi));
    RollingSamples { turning: three(0), normal: three(3), velocity: three(6) }
}

impl Tracks {
    /// Rows of t, X, Y for each motion.
    pub fn rows(&self, time: &Rational, every: &Rational) -> Vec<Vec<Vec<DoubleDouble>>> {
        let sign = if time.to_f64().0 < 0.0 { -1.0 } else { 1.0 };
        let every = sign * every.to_f64().0;
        let row = |(place, [x, y]): (usize, &[f64; 2])| {
            [place as f64 * every, *x, *y].map(DoubleDouble::from_f64).to_vec()
        };
        let rows = |track: &Track| track.points.iter().enumerate().map(row).collect();
        self.tracks.iter().map(rows).collect()
    }
}
