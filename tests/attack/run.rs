//! Judgement of many cases, and comparison with the oracle.

use std::collections::BTreeMap;
use std::time::Instant;

use rayon::prelude::*;

use super::draw::{Drawn, drawn};
use super::random::Stream;
use super::shrink::Faulty;
use super::table::{Table, constructs};
use super::told::{Told, told};
use super::wrong::{Truth, Wrong, weighed};

/// Number of cases with 5 000 claims.
const CASES: u64 = 2_600;

/// A plan of a run: the number of cases, the seed, and single cases if wanted.
#[derive(Clone, Debug)]
pub struct Plan {
    pub cases: u64,
    /// Index of the first case.
    pub first: u64,
    pub seed: u64,
    pub only: Vec<u64>,
    /// Number of faults of each class that are shrunk and shown.
    pub shown: usize,
}

impl Plan {
    /// Reads the plan from the environment.
    pub fn of_environment() -> Self {
        let number = |name: &str| -> Option<u64> {
            let text = std::env::var(name).ok()?;
            Some(text.replace('_', "").parse().unwrap_or_else(|_| panic!("{name} is a number")))
        };
        Self {
            cases: number("LIOUVILLE_ATTACK").unwrap_or(CASES),
            first: number("LIOUVILLE_ATTACK_FIRST").unwrap_or(0),
            seed: number("LIOUVILLE_ATTACK_SEED").unwrap_or(1),
            only: std::env::var("LIOUVILLE_ATTACK_ONLY").map_or(Vec::new(), |text| listed(&text)),
            shown: number("LIOUVILLE_ATTACK_SHOW").unwrap_or(3) as usize,
        }
    }
}

/// Reads numbers separated by commas.
fn listed(text: &str) -> Vec<u64> {
    let number = |part: &str| part.trim().parse().unwrap_or_else(|_| panic!("{part} is a case"));
    text.split(',').map(number).collect()
}

/// The result for a claim.
struct Fate {
    index: u64,
    /// Index among the case's claims.
    number: usize,
    constructs: Vec<&'static str>,
    truth: Truth,
    word: &'static str,
    on_level: bool,
    /// Rung that decided it.
    method: &'static str,
    wrong: Option<Wrong>,
    /// Times of the verifier for the case, and of the oracle for the claim.
    seconds: f64,
    weighing: f64,
}

/// The results for all claims.
#[derive(Default)]
pub struct Outcome {
    pub table: Table,
    pub claims: usize,
    /// Number of positive and negative verdicts on claims that the oracle cannot decide.
    pub open: usize,
    pub wrong: usize,
    pub text: String,
}

/// Largest share of the claims with a verdict that the oracle leaves open: one in this many.
const MOST_OPEN: usize = 100;

impl Outcome {
    /// Whether the oracle decides nearly all claims that have a verdict.
    pub fn is_open_rarely(&self) -> bool {
        self.open * MOST_OPEN <= self.claims.max(1000)
    }
}

/// Judges all cases of a plan.
pub fn run(plan: &Plan) -> Outcome {
    let start = Instant::now();
    let indices = match plan.only.is_empty() {
        true => (plan.first..plan.first + plan.cases).collect(),
        false => plan.only.clone(),
    };
    let fates: Vec<Fate> =
        indices.into_par_iter().flat_map_iter(|index| fates(plan.seed, index)).collect();
    let mut outcome = Outcome::default();
    let mut faults: BTreeMap<Wrong, Vec<&Fate>> = BTreeMap::new();
    for fate in &fates {
        outcome.table.note(&fate.constructs, fate.truth, fate.word);
        let is_decided = ["proved", "confirmed", "refuted"].contains(&fate.word);
        outcome.claims += 1;
        outcome.open += usize::from(is_decided && fate.truth == Truth::Unsure);
        if let Some(wrong) = fate.wrong {
            faults.entry(wrong).or_default().push(fate);
        }
    }
    outcome.wrong = faults.values().map(Vec::len).sum();
    outcome.text = outcome.table.text();
    let slowest = fates.iter().max_by(|a, b| a.seconds.total_cmp(&b.seconds));
    if let Some(slowest) = slowest {
        // A case is judged once for all its claims.
        let cases = fates.iter().filter(|fate| fate.number == 0);
        let total: f64 = cases.map(|fate| fate.seconds).sum();
        let weighing: f64 = fates.iter().map(|fate| fate.weighing).sum();
        let heaviest = fates.iter().max_by(|a, b| a.weighing.total_cmp(&b.weighing));
        let (heaviest, longest) = heaviest.map_or((0, 0.0), |fate| (fate.index, fate.weighing));
        outcome.text.push_str(&format!(
            "\n{} claims, {:.1} s; judged in {total:.1} s, the slowest in {:.1} s (case {}); weighed in \
             {weighing:.1} s, the slowest in {longest:.1} s (case {heaviest})\n",
            fates.len(),
            start.elapsed().as_secs_f64(),
            slowest.seconds,
            slowest.index
        ));
    }
    let Outcome { claims, open, .. } = outcome;
    outcome
        .text
        .push_str(&format!("{open} of {claims} with a verdict that the oracle leaves open\n"));
    for (wrong, list) in faults {
        outcome.text.push_str(&format!("\n{} times: {}\n", list.len(), wrong.words()));
        let mut by: BTreeMap<(&str, &str, &str), Vec<u64>> = BTreeMap::new();
        for fate in &list {
            let place = if fate.on_level { " on a level" } else { "" };
            by.entry((fate.constructs[0], place, fate.method)).or_default().push(fate.index);
        }
        for ((kind, place, method), cases) in by {
            let line = format!("  {:>5} {kind}{place} by {method}: cases {cases:?}\n", cases.len());
            outcome.text.push_str(&line);
        }
        let shown: Vec<String> =
            list.par_iter().take(plan.shown).map(|fate| shown(plan.seed, fate, wrong)).collect();
        outcome.text.push_str(&shown.concat());
    }
    outcome
}

fn fates(seed: u64, index: u64) -> Vec<Fate> {
    let drawn = drawn(seed, index);
    let names = drawn.scene.names();
    let bodies: Vec<String> = drawn.made.iter().map(|made| made.body(&names, drawn.hand)).collect();
    let start = Instant::now();
    let all = told(&drawn.scene.text(&bodies, drawn.hand), drawn.seed, bodies.len());
    let seconds = start.elapsed().as_secs_f64();
    let fate = |(number, told): (usize, Told)| {
        let made = &drawn.made[number];
        let mut stream = Stream::new(seed ^ 0x5bd1_e995, index * 16 + number as u64);
        let began = Instant::now();
        let (truth, wrong) = weighed(&drawn.scene, made, &told, &mut stream);
        let weighing = began.elapsed().as_secs_f64();
        let constructs = constructs(&drawn.scene, &made.claim);
        let method = match &told {
            Told::Report(report) => report.evidence.method.name(),
            other => other.word(),
        };
        let (word, on_level) = (told.word(), drawn.scene.level.is_some());
        Fate { index, number, constructs, truth, word, on_level, method, wrong, seconds, weighing }
    };
    all.into_iter().enumerate().map(fate).collect()
}

/// Shrinks a fault and writes it as a file.
fn shown(seed: u64, fate: &Fate, wrong: Wrong) -> String {
    let Fate { index, number, .. } = fate;
    let drawn: Drawn = drawn(seed, *index);
    let repeat = format!("LIOUVILLE_ATTACK_SEED={seed} LIOUVILLE_ATTACK_ONLY={index}");
    match Faulty::alone(&drawn, &drawn.made[*number], wrong) {
        Some(faulty) => {
            let small = faulty.shrunk(wrong);
            let grounds = small.told().grounds();
            let file = small.text();
            format!("\n# {repeat}, seed {}: {grounds}\n{file}", small.seed)
        }
        None => {
            let names = drawn.scene.names();
            let body = |made: &super::draw::Made| made.body(&names, drawn.hand);
            let bodies: Vec<String> = drawn.made.iter().map(body).collect();
            let file = drawn.scene.text(&bodies, drawn.hand);
            format!(
                "\n# {repeat}, seed {}: claim {number}, in this company only\n{file}",
                drawn.seed
            )
        }
    }
}
