//! The command `liouville motion periodic`.

use crate::report::cycle::{self, FoundOrbit};
use clap::Args;
use liouville::case::{Case, FixedLine};
use liouville::number::rational::Rational;
use liouville::verdict::Options;
use liouville_flow::{
    Begin, CrossingSurface, FlowError, Launches, SectionMap, closed_orbit, crossing_time, observe,
};
use serde_json::json;

use super::fixing::integrals;
use super::motion::{MotionArgs, SectionPlaneArgs, Threads, parse_number};
use super::starts::{GivenStart, Starts, misfit};
use super::surface::read_surface;
use super::{CommandOutput, Progress, map_points, symmetric};

/// Case, section and start of a closed orbit.
#[derive(Debug, Args)]
pub struct OrbitSearch {
    #[command(flatten)]
    pub subject: MotionArgs,
    #[command(flatten)]
    pub plane: SectionPlaneArgs,
    #[command(flatten)]
    pub starts: Starts,
    /// Surface whose crossings count, for a start by its state: --section 'z = 27'
    #[arg(long, value_name = "EQUATION", conflicts_with = "g0", allow_hyphen_values = true)]
    pub section: Option<String>,
    /// Crossings of --section that count: up, down, both
    #[arg(long, requires = "section")]
    pub direction: Option<liouville::case::Direction>,
    /// Period of the point, in crossings; of symmetric points the longest
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub period: u32,
}

#[derive(Debug, Args)]
pub struct Periodic {
    #[command(flatten)]
    pub search: OrbitSearch,
    /// Approximate period in time, for a start by its state, instead of counting crossings
    #[arg(long, value_name = "TIME", conflicts_with = "period", value_parser = parse_number)]
    pub time: Option<Rational>,
    /// Find the symmetric orbits that meet these lines of fixed points of reversors, with periods up
    /// to --period: L=0, l=0 (and π), l=π/2 (and 3π/2). No start is needed
    #[arg(long, value_name = "LINES", value_delimiter = ',',
        conflicts_with_all = ["start", "starts", "section", "time"])]
    pub symmetric: Vec<FixedLine>,
    /// Number of points tried along each line of --symmetric
    #[arg(long, default_value_t = 400, requires = "symmetric",
        value_parser = clap::value_parser!(u32).range(8..=1_000_000))]
    pub points: u32,
    /// Prove that each orbit of --symmetric closes, by enclosures, as it is tried for an orbit near a
    /// start: the theorem, or the reason why there is none
    #[arg(long)]
    pub prove: bool,
    /// Leave the proof out, and report what is computed
    #[arg(long, conflicts_with = "prove")]
    pub numerical: bool,
    /// Of a map: find all points of the period in a box, NAME=a..b for each component whose range is not
    /// that of [state]
    #[arg(long = "box", value_name = "NAME=A..B", conflicts_with_all = ["start", "starts"],
        allow_hyphen_values = true)]
    pub ranges: Vec<String>,
    #[command(flatten)]
    pub threads: Threads,
}

impl Periodic {
    /// Adds the proof to an orbit, if it is to be tried.
    pub fn proved(&self, case: &Case, found: FoundOrbit) -> Result<FoundOrbit, String> {
        let is_tried = match self.symmetric.is_empty() {
            true => !self.numerical,
            false => self.prove,
        };
        if is_tried { self.search.proved(case, found) } else { self.search.supported(found) }
    }
}

pub fn run(options: &Periodic) -> Result<CommandOutput, String> {
    let search = &options.search;
    if search.subject.reads_map()? {
        return map_points::run(options);
    }
    let case = search.subject.open()?;
    if !options.ranges.is_empty() {
        return Err("error: --box: closed orbits of a flow are found from a start\n\
                    help: give --start with a state near the orbit; all points in a box are those of a map"
            .to_string());
    }
    if case.model.system.has_arbitrary_function() {
        return Err(search.subject.told(&FlowError::Arbitrary));
    }
    if !options.symmetric.is_empty() {
        return symmetric::run(options, &case);
    }
    let time = options.time.as_ref();
    let found = search.starts(&case)?;
    let bar = Progress::of(found.len() as u64, "orbits");
    let found = found.into_iter().map(|given| {
        let found = options.proved(&case, search.orbit(&case, given, time)?);
        bar.add(1.0);
        found
    });
    let found: Vec<FoundOrbit> = found.collect::<Result<_, _>>()?;
    bar.finish();
    let text = match search.subject.json {
        true => {
            let points: Vec<_> = found.iter().map(cycle::entry).collect();
            let root = json!({ "title": case.title, "points": points });
            serde_json::to_string_pretty(&root).map_err(|error| format!("error: {error}"))? + "\n"
        }
        false => found.iter().map(|found| cycle::text(&case, found)).collect(),
    };
    Ok(CommandOutput { text, code: 0 })
}

impl OrbitSearch {
    /// Reads the starts.
    pub fn starts(&self, case: &Case) -> Result<Vec<GivenStart>, String> {
        let given = self.starts.read(case)?;
        if given.is_empty() {
            return Err("error: there is no start\n\
                        help: give --start with a state near the orbit, or with l,L/G on the section \
                        of a rolling body"
                .to_string());
        }
        Ok(given.into_iter().map(|(_, given)| given).collect())
    }

    /// Adds the proof to an orbit, or the reason why there is none. A motion that is nearly closed is
    /// reported only with its proof.
    pub fn proved(&self, case: &Case, mut found: FoundOrbit) -> Result<FoundOrbit, String> {
        let energy = match found.point {
            Some(_) => Some(self.plane.of(case)?.1),
            None => None,
        };
        let options = Options { seed: self.subject.seed, ..Options::default() };
        let theorem = observe::theorem_about(case, &found.cycle, energy.as_ref(), &options);
        let is_proved = theorem.is_ok();
        found.proof = Some(theorem);
        if is_proved { Ok(found) } else { self.supported(found) }
    }

    /// The orbit, unless the motion is nearly closed only.
    fn supported(&self, found: FoundOrbit) -> Result<FoundOrbit, String> {
        let cycle = found.cycle.supported().map_err(|error| self.subject.told(&error))?;
        Ok(FoundOrbit { cycle, ..found })
    }

    /// Finds the orbit near a start.
    pub fn orbit(
        &self,
        case: &Case,
        given: GivenStart,
        time: Option<&Rational>,
    ) -> Result<FoundOrbit, String> {
        let surface = self.section.as_deref().map(|text| read_surface(case, text)).transpose()?;
        match given {
            GivenStart::State(state) => near_state(case, self, time, surface.as_ref(), state),
            GivenStart::Values(values) => near_point(case, self, time, &values),
        }
    }
}

/// Finds the orbit through a periodic point (l, L/G) of a rolling body.
fn near_point(
    case: &Case,
    options: &OrbitSearch,
    time: Option<&Rational>,
    values: &[Rational],
) -> Result<FoundOrbit, String> {
    let told = |error: FlowError| options.subject.told(&error);
    let (has_section, is_ours) =
        (liouville_flow::has_andoyer_section(&case.model), options.section.is_none());
    let [l, z] = values else {
        let otherwise = has_section.then_some("l,L/G on the section");
        return Err(misfit(case, values.len(), otherwise));
    };
    if !(has_section && is_ours && time.is_none()) {
        return Err(misfit(case, values.len(), None));
    }
    let (g0, energy) = options.plane.of(case)?;
    let map = SectionMap::new(case, &g0, &energy, options.subject.seed).map_err(told)?;
    let near = [l.to_f64().0, z.to_f64().0];
    let (point, cycle) = map.cycle(near, options.period as usize).map_err(told)?;
    Ok(FoundOrbit { point: Some(point), crossings: Some(point.period), cycle, proof: None })
}

/// Finds the orbit near a state.
fn near_state(
    case: &Case,
    options: &OrbitSearch,
    time: Option<&Rational>,
    surface: Option<&CrossingSurface>,
    state: Vec<Rational>,
) -> Result<FoundOrbit, String> {
    let told = |error: FlowError| options.subject.told(&error);
    let fixed = options.plane.fixed(case)?;
    let seed = options.subject.seed;
    let launches = Launches { case, fixed: &fixed, pad: None, seed, index: 0 };
    let start = launches.start(&Begin::State(state)).map_err(told)?;
    let count = options.period as usize;
    let (start, time, crossings) = match (surface, time) {
        (_, Some(time)) if time.to_f64().0 > 0.0 && time.to_f64().0.is_finite() => {
            (start, time.to_f64().0, None)
        }
        (_, Some(_)) => return Err("error: --time: write a period above 0".to_string()),
        (Some(surface), None) => {
            let direction = options.direction.unwrap_or(liouville::case::Direction::Up);
            let (start, time) = crossing_time(&start, surface, direction, count).map_err(told)?;
            (start, time, Some(count))
        }
        (None, None) => {
            return Err("error: the start does not determine a period\n\
                        help: give --section 'x = 0', whose crossings are counted, or --time with \
                        the approximate period"
                .to_string());
        }
    };
    let surface = surface.filter(|_| crossings.is_some());
    let cycle = closed_orbit(case, &start, time, surface, &integrals(&fixed)).map_err(told)?;
    Ok(FoundOrbit { point: None, crossings, cycle, proof: None })
}
