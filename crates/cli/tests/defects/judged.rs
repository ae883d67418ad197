//! Judgement of groups of claims.

use liouville::claim::PlaceName;
use std::sync::Arc;

use libtest_mimic::{Failed, Trial};
use liouville::case::Case;
use liouville::verdict::{ClaimReport, DensitySign, Independence, Options, judge};

use crate::file::{Claim, Group, Mutation};
use crate::right::Answer;

/// Makes one test for each claim.
pub fn trials(group: Group) -> Vec<Trial> {
    let group = Arc::new(group);
    let trial = |index: usize| {
        let (own, claim) = (Arc::clone(&group), &group.claims[index]);
        let name = format!("{}: {}", group.shows, claim.body.replace('\n', ", "));
        Trial::test(name, move || check(&own, index))
    };
    // Claims with any allowed answer only accompany the others.
    (0..group.claims.len()).filter(|index| group.claims[*index].right != "any").map(trial).collect()
}

fn check(group: &Group, index: usize) -> Result<(), Failed> {
    let claim = &group.claims[index];
    let (claims, place) = match group.together {
        true => (&group.claims[..], index),
        false => (std::slice::from_ref(claim), 0),
    };
    let mut text = group.case.clone();
    for claim in claims {
        text.push_str(&format!("[[claim]]\n{}\nexpect = \"open\"\n", claim.body));
    }
    for seed in 1..=group.seeds {
        let answer = answer(&text, place, seed);
        if !answer.is(&claim.right) {
            let told = answer.told();
            return Err(Failed::from(format!(
                "{}, not {told}\nat seed {seed} in\n{text}",
                claim.right
            )));
        }
        also(claim, &answer).map_err(|error| format!("{error}\nat seed {seed} in\n{text}"))?;
    }
    Ok(())
}

fn answer(text: &str, place: usize, seed: u64) -> Answer {
    let case = match Case::parse(text, &[]) {
        Ok(case) => case,
        Err(error) => return Answer::Error(error.to_string()),
    };
    match judge(&case, &Options { seed, ..Options::default() }) {
        Ok(mut report) => Answer::Verdict(Box::new(report.claims.swap_remove(place))),
        Err(error) => Answer::Error(error.to_string()),
    }
}

/// Words before what the remark on a claim contains.
const REMARK: &str = "remarks: ";

fn remark(answer: &Answer) -> Option<String> {
    match answer {
        Answer::Verdict(report) => report.evidence.remark.clone(),
        Answer::Error(_) => None,
    }
}

fn also(claim: &Claim, answer: &Answer) -> Result<(), String> {
    let (sign, independence) = match answer {
        Answer::Verdict(report) => (report.evidence.sign, report.evidence.independence),
        Answer::Error(_) => (None, None),
    };
    let widest = |report: &ClaimReport| report.evidence.holds.contains(&PlaceName::Everywhere);
    match claim.also.as_deref() {
        None => Ok(()),
        Some("not everywhere") => match answer {
            Answer::Verdict(report) if widest(report) => {
                Err("it is told to hold everywhere, and does not".to_string())
            }
            _ => Ok(()),
        },
        Some("changes its sign")
            if matches!(sign, Some(DensitySign::Positive | DensitySign::Negative)) =>
        {
            Err(format!("it changes its sign, and is told to be {sign:?}"))
        }
        Some("changes its sign") => Ok(()),
        Some("is not new") if independence != Some(Independence::Independent) => Ok(()),
        Some("is not new") => Err("it is constant, and told to be new".to_string()),
        Some("has no sign of all states") => match answer {
            Answer::Verdict(report)
                if !report.evidence.sign_is_partial && sign != Some(DensitySign::Changes) =>
            {
                Err(format!("it is told to be {sign:?} at all states"))
            }
            _ => Ok(()),
        },
        Some("has a remark on a part") => match answer {
            Answer::Verdict(report)
                if !report
                    .evidence
                    .remark
                    .as_ref()
                    .is_some_and(|own| own.starts_with("on a part")) =>
            {
                Err(format!("it has the remark {:?}", report.evidence.remark))
            }
            _ => Ok(()),
        },
        Some(text) if text.starts_with(REMARK) => {
            let (wanted, remark) = (&text[REMARK.len()..], remark(answer));
            match remark.as_deref().unwrap_or_default().contains(wanted) {
                true => Ok(()),
                false => Err(format!("it has the remark {remark:?}")),
            }
        }
        Some("has no remark") => match remark(answer) {
            None => Ok(()),
            remark => Err(format!("it has the remark {remark:?}")),
        },
        Some("keeps its sign") if sign != Some(DensitySign::Changes) => Ok(()),
        Some("keeps its sign") => Err("it does not change its sign".to_string()),
        Some(other) => Err(format!("`{other}` is nothing to be tested")),
    }
}

/// Tests that no mutant of the case's claims survives.
pub fn mutation(mutation: Mutation) -> Trial {
    Trial::test(mutation.shows.clone(), move || {
        let case =
            Case::parse(&mutation.case, &[]).map_err(|error| Failed::from(error.to_string()))?;
        let options = Options { mutants: true, ..Options::default() };
        let report = judge(&case, &options).map_err(|error| Failed::from(error.to_string()))?;
        if let Some(claim) = report.claims.iter().find(|claim| !claim.agrees) {
            return Err(Failed::from(format!("{} is {}", claim.name, claim.verdict.word())));
        }
        let mutants = report.mutants.ok_or("mutants were asked for")?;
        match &mutants.survived[..] {
            [] if mutants.killed > 0 => Ok(()),
            [] => Err(Failed::from("there were no mutants")),
            survived => Err(Failed::from(format!("survived: {survived:#?}"))),
        }
    })
}
