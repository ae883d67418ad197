//! States that are drawn, and what prime fields say about false claims at all of them.

use std::path::Path;

use liouville::case::{Case, Expect};
use liouville::claim::LevelSubset;
use liouville::graph::record;
use liouville::mechanics::calculus::DualPoint;
use liouville::mechanics::{Phase, combinations};
use liouville::number::rational::Rational;
use liouville::proof::{Group, GroupOutcome, Prover};
use liouville::verdict::Sampler;

use crate::CASES;
use crate::files::files;

#[test]
fn the_first_block_is_that_of_the_same_draws() {
    let text = "title = \"a list\"\nsystem = \"field\"\n[parameters]\nk = \"one of 1, 2, 3\"\n\
                [state]\nx = \"0..1\"\n[field]\nx = \"k*x\"\n[[claim]]\nidentity = \"x + k = k + x\"\n";
    let case = Case::parse(text, &[]).expect("a case");
    let place = LevelSubset::level(&case.model);
    let sampler = || Sampler::new(&case, &place, 1).expect("samples");
    let all = |sampler: &Sampler| {
        let made = format!("{:?}", sampler.balls(0));
        assert_eq!(made, format!("{:?}", sampler.balls(0)), "the second time");
        made
    };
    let whole = sampler();
    let first = all(&whole);
    for value in 1..=3 {
        let fixed = [Some(Rational::from(value)), None];
        let chosen = all(&whole.with(&fixed));
        assert_ne!(chosen, first, "one value of the list");
        assert_eq!(chosen, all(&sampler().with(&fixed)), "before the whole was drawn");
    }
    assert_eq!(all(&whole), first);
}

/// Returns the answers of prime fields on the claims of a case that are expected to fail.
fn answers_on_false_claims(case: &Case) -> Vec<(String, Vec<GroupOutcome>)> {
    let model = &case.model;
    let free = model.free_components();
    let (graph, residuals) = record(free + model.dimension(), |inputs| {
        let (parameters, state) = inputs.split_at(free);
        let jet = DualPoint::new(Phase::new(model, parameters, state));
        let of =
            |claim: &liouville::case::PlacedClaim| claim.kind.residual(&jet, &claim.place.kept);
        case.claims.iter().map(of).collect::<Vec<_>>()
    })
    .expect("records");
    let mut found = Vec::new();
    for (claim, residual) in case.claims.iter().zip(residuals) {
        // A claim of independence fails where the residual does vanish.
        if claim.expect != Expect::Fails || claim.kind.is_negated() {
            continue;
        }
        let sampler = Sampler::new(case, &claim.place, 1).expect("samples");
        if sampler.is_numerical() {
            continue;
        }
        let (extents, sources) = (sampler.extents(), sampler.sources());
        let prover = Prover { sources: &sources, extents: &extents, seed: 1 };
        let choices = combinations(sampler.recipes()).expect("few values");
        let answer = |fixed: &Vec<Option<Rational>>| {
            let (graph, own) =
                sampler.compose(&graph, std::slice::from_ref(&residual), fixed).expect("composes");
            let own: Vec<Group> = own.into_iter().map(Group::of).collect();
            prover.prove(&graph, &own).expect("tested").remove(0)
        };
        found.push((claim.name.clone(), choices.iter().map(answer).collect()));
    }
    found
}

#[test]
fn no_false_claim_is_zero_in_prime_fields() {
    false_claims_of_one_file_in(4, 250);
}

#[test]
#[ignore = "slow: those of one file in four are tried above"]
fn no_false_claim_of_the_catalogue_is_zero_in_prime_fields() {
    false_claims_of_one_file_in(1, 1000);
}

fn false_claims_of_one_file_in(step: usize, least: usize) {
    let mut found = Vec::new();
    for path in files(Path::new(CASES)).into_iter().step_by(step) {
        let case = Case::read(&path, &[]).1.expect("a case");
        let named = |(name, all)| (format!("{} :: {name}", path.display()), all);
        found.extend(answers_on_false_claims(&case).into_iter().map(named));
    }
    assert!(found.len() > least, "{} false claims", found.len());
    let mut refuted = 0;
    for (name, answers) in &found {
        let is_zero = |answer: &GroupOutcome| matches!(answer, GroupOutcome::Zero(_));
        assert!(!answers.iter().all(is_zero), "{name} is false");
        let is_nonzero = |answer: &GroupOutcome| match answer {
            GroupOutcome::NonZero(parts) => parts.proper().is_none(),
            _ => false,
        };
        refuted += usize::from(answers.iter().any(is_nonzero));
    }
    // The others contain symbols of transcendental functions, or fail for listed values only.
    assert!(refuted * 10 > least * 9, "{refuted} of {} are seen not to be identities", found.len());
}
