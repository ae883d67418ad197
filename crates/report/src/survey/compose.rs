//! Composition of the document of a survey: its sections and their contents.

use super::document::{Document, DocumentSection, SectionBlock, TableCell};
use super::entry::{self, blocks, independence, involution};
use super::liouville::in_involution;
use super::maps::maps;
use super::picture;
use liouville::case::Case;
use liouville::verdict::CaseReport;
use liouville_search::survey::{
    Description, HierarchyPlace, IntegralCount, Integrals, MeasureStatus, SearchOutcome, Survey,
    SystemLine, TestedClaim,
};

/// Composes the document of a survey; `origin` names the program and the case.
pub fn document(survey: &Survey, origin: &str) -> Document {
    let sections = [
        DocumentSection::new("Classification", standing(survey)),
        DocumentSection::new("The system", system(survey)),
        DocumentSection::new("General integrals", blocks(&survey.general)),
        DocumentSection::new("Invariant measure", measure(survey)),
        DocumentSection::new("Further integrals", integrals(survey)),
        DocumentSection::new("For single listed values", blocks(&survey.for_values)),
        DocumentSection::new("Invariant surfaces", blocks(&survey.surfaces)),
        DocumentSection::new("Functions of constant rate", blocks(&survey.drifts)),
        DocumentSection::new("Symmetry fields", blocks(&survey.fields)),
        DocumentSection::new("Reversors and symmetries", maps(survey)),
        DocumentSection::new("Conformally Hamiltonian form", hamiltonian(survey)),
        DocumentSection::new("Excluded invariants", excluded(survey)),
        DocumentSection::new("Not proved", blocks(&survey.undecided)),
        DocumentSection::new("Claims of the case", blocks(&survey.claimed)),
        DocumentSection::new("Reproducibility", repeated(survey.seed, origin)),
    ];
    Document {
        title: survey.title.clone(),
        lead: survey.sentence.clone(),
        headline: survey.hierarchy.class.words().to_string(),
        sections: sections.into_iter().flatten().collect(),
    }
}

/// Composes the document of a case without a survey: its claims alone.
pub fn of_claims(case: &Case, report: &CaseReport, seed: u64, origin: &str) -> Document {
    let claims = report.claims.iter().map(|claim| TestedClaim::claimed(case, claim.clone()));
    let own = Description::of(case);
    let told = report.warnings.iter().map(|warning| text(format!("Warning: {warning}.")));
    let told = told.chain(report.remarks.iter().map(|remark| text(format!("Remark: {remark}."))));
    let sections = [
        DocumentSection::new("The system", described(&own)),
        DocumentSection::new("Claims of the case", blocks(&claims.collect::<Vec<_>>())),
        DocumentSection::new("Notes", told.collect()),
        DocumentSection::new("Reproducibility", repeated(seed, origin)),
    ];
    Document {
        title: case.title.clone(),
        lead: case.source.clone(),
        headline: "verdicts on its claims".to_string(),
        sections: sections.into_iter().flatten().collect(),
    }
}

fn text(words: impl Into<String>) -> SectionBlock {
    SectionBlock::Text(words.into())
}

fn standing(survey: &Survey) -> Vec<SectionBlock> {
    let standing = &survey.hierarchy;
    let mut found = vec![
        text(format!("Class: {}.", standing.class.words())),
        SectionBlock::List(standing.grounds.clone()),
        SectionBlock::Picture(picture::hierarchy(standing)),
    ];
    if !standing.typical.is_empty() {
        found.push(text("Typical behaviour of this class:"));
        found.push(SectionBlock::List(standing.typical.clone()));
    }
    found
}

fn described(own: &Description) -> Vec<SectionBlock> {
    let set = |lines: &[SystemLine]| {
        let each = lines.iter().map(|line| (line.text.clone(), line.layout.clone()));
        SectionBlock::Definitions(each.collect())
    };
    let mut found = Vec::new();
    if !own.functions.is_empty() {
        found.extend([text("Given by:"), set(&own.functions)]);
    }
    if !own.equations.is_empty() {
        found.extend([text("Equations of motion:"), set(&own.equations)]);
    }
    if !own.parameters.is_empty() {
        found.extend([text("Parameters:"), set(&own.parameters)]);
    }
    found
}

fn system(survey: &Survey) -> Vec<SectionBlock> {
    let mut found = vec![text(survey.sentence.clone())];
    found
        .extend(survey.wireframe.as_ref().map(|frame| SectionBlock::Picture(picture::body(frame))));
    found.extend(described(&survey.description));
    let has_free = survey.parameters.iter().any(|one| one.value.is_none());
    if has_free {
        found.push(text(
            "Proofs cover all values of the free parameters, unless a remark says otherwise.",
        ));
    }
    let (holds, fails): (Vec<_>, Vec<_>) = survey.facts.iter().partition(|fact| fact.holds);
    let told = |facts: Vec<&liouville_search::survey::GeometryFact>| {
        facts.iter().map(|fact| fact.words.clone()).collect::<Vec<_>>()
    };
    if !holds.is_empty() {
        found.extend([text("Verified properties:"), SectionBlock::List(told(holds))]);
    }
    if !fails.is_empty() {
        let not = told(fails).join("; ");
        let words = if has_free { "Not true for all parameter values" } else { "Ruled out" };
        found.push(text(format!("{words}: {not}.")));
    }
    let grounds = survey.facts.iter().map(|fact| match &fact.claim {
        None => format!("{}: as the file says", fact.words),
        Some(claim) => {
            let grounds = entry::grounds(&claim.evidence).pop().unwrap_or_default();
            format!("{}: {}; {grounds}", fact.words, claim.verdict.word())
        }
    });
    let grounds: Vec<String> = grounds.collect();
    if !grounds.is_empty() {
        found.push(SectionBlock::Folded("evidence", grounds));
    }
    found.extend(survey.notes.iter().map(|note| text(format!("Note: {note}"))));
    found.extend(survey.warnings.iter().map(|warning| text(format!("Warning: {warning}."))));
    found.extend(survey.remarks.iter().map(|remark| text(format!("Remark: {remark}."))));
    found
}

fn measure(survey: &Survey) -> Vec<SectionBlock> {
    let mut found = blocks(&survey.criterion);
    let witness = survey.criterion.iter().find_map(|one| one.claim.evidence.witness.as_ref());
    found.extend(
        witness.map(|found| text(format!(
                "A density of the configuration exists only if the criterion vanishes. It does not; {}.",
                entry::witness(found)
            ))),
    );
    if !survey.by_value.is_empty() && survey.criterion.iter().any(TestedClaim::fails) {
        found.push(text(
            "What is refuted here fails for some of the listed values; the place of each is above.",
        ));
    }
    found.extend(blocks(&survey.densities));
    let sentence = match survey.hierarchy.measure {
        MeasureStatus::ByQuadrature if survey.densities.is_empty() => Some(
            "The criterion proves that a density of the configuration exists; no closed form of it is \
             known here. Its values follow by quadrature.",
        ),
        MeasureStatus::ExcludedForConfiguration => Some(
            "With forces or a rotor the criterion excludes densities of the configuration alone; one \
             that depends on the velocities stays open.",
        ),
        _ => None,
    };
    found.extend(sentence.map(text));
    if let Some(map) = &survey.sphere {
        let closure = map.closure.map(|error| {
            format!(" Around closed parallels the quadrature vanishes to {error:.0e}.")
        });
        let what = match map.quantity {
            "C₁" => {
                "The condition C₁ on the sphere of γ. A density of the configuration exists only if it is 0 everywhere."
            }
            "C" => {
                "The criterion (γ, rot w) on the sphere of γ. A density of the configuration exists only if it is 0 everywhere."
            }
            _ => {
                "ln ρ on the sphere of γ, normalised to 0 at e₁, computed by quadrature from the criterion."
            }
        };
        let values: Vec<String> =
            map.parameters.iter().map(|(name, value)| format!("{name} = {value}")).collect();
        let of = match values.is_empty() || values.len() > 12 {
            true if values.is_empty() => " For the parameters of the case.".to_string(),
            true => " For the parameters drawn for state 0.".to_string(),
            false => format!(" For {}.", values.join("; ")),
        };
        let largest =
            map.values.iter().flatten().flatten().fold(0.0f64, |most, x| most.max(x.abs()));
        if map.quantity == "ln ρ" && largest < NOTHING {
            found.push(text(
                "By quadrature from the criterion ρ is constant on the sphere of γ.".to_string(),
            ));
            return found;
        }
        found.push(text(format!("{what}{of}{}", closure.unwrap_or_default())));
        found.push(SectionBlock::Picture(picture::sphere(map)));
        found.push(table_of(map));
    }
    found
}

/// Largest value of ln ρ on the sphere that is rounding alone.
const NOTHING: f64 = 1e-9;

/// Table of every eighth column and fourth row of the map, for formats without pictures.
fn table_of(map: &liouville_search::survey::SphereMap) -> SectionBlock {
    let number = |x: f64| {
        let text = format!("{x:.4}");
        if text == "-0.0000" { "0.0000".to_string() } else { text }
    };
    let shown = |value: &Option<f64>| TableCell::Text(value.map_or("–".to_string(), number));
    let rows = map.latitudes.iter().zip(&map.values).skip(1).step_by(4).map(|(latitude, row)| {
        let mut cells = vec![TableCell::Text(format!("{latitude:+.1}°"))];
        cells.extend(row.iter().step_by(8).map(shown));
        cells
    });
    SectionBlock::Table {
        head: vec!["latitude", "3.75°", "63.75°", "123.75°", "183.75°", "243.75°", "303.75°"],
        rows: rows.collect(),
    }
}

fn integrals(survey: &Survey) -> Vec<SectionBlock> {
    let mut found = blocks(&survey.integrals);
    if !survey.dependent.is_empty() {
        found.push(text(match survey.by_value.is_empty() {
            true => "Also integrals, and functions of those above:",
            false => {
                "Also integrals, and functions of those above for some listed values at least:"
            }
        }));
        found.extend(blocks(&survey.dependent));
    }
    if !survey.rates.is_empty() {
        found.push(text("By a linear equation two integrals exist, without a closed form here:"));
        found.extend(blocks(&survey.rates));
    }
    if found.is_empty() && !survey.by_value.is_empty() {
        found.push(text("None is known for all listed values of the parameters."));
    }
    if found.is_empty() {
        found.push(text(match survey.hierarchy.integrals {
            Integrals::ExcludedToDegree(degree) => {
                let generic = match survey.parameters.iter().any(|one| one.value.is_none()) {
                    true => " for generic values of the free parameters",
                    false => "",
                };
                format!(
                    "None is known. None that is polynomial in the velocities of degree at most {degree} \
                     exists{generic}."
                )
            }
            _ => "None is known.".to_string(),
        }));
    }
    let jumps = survey.integrals.iter().any(TestedClaim::jumps);
    let count = count(&survey.independence, &survey.hierarchy, jumps);
    found.push(text(match survey.by_value.is_empty() {
        true => count,
        false => format!("What holds for all listed values: {count}"),
    }));
    // Of one integral it would say nothing.
    if survey.independence.independent.len() > 1 {
        found.extend(survey.independence.claim.as_ref().map(independence));
    }
    if let Some(proof) = &survey.liouville {
        found.push(text(in_involution(proof)));
        found.push(involution(&proof.claim));
    }
    found
}

fn count(count: &IntegralCount, place: &HierarchyPlace, jumps: bool) -> String {
    let has_measure =
        matches!(place.measure, MeasureStatus::ClosedForm | MeasureStatus::ByQuadrature);
    let found = count.independent.len();
    let verdict = match (found >= count.needed, has_measure) {
        (true, true) if place.integrals == Integrals::EnoughOnAPart => {
            "these suffice where they are independent, which is shown on a part of the states only"
        }
        (true, true) if count.needed == 0 => "one is known",
        (true, true) => "these suffice",
        (true, false) if place.measure == MeasureStatus::Singular => {
            "these suffice on each part between the zeros and poles of the density"
        }
        (true, false) => "no measure is known",
        (false, _) => "too few integrals are known",
    };
    let known = match found {
        0 if jumps => "no integral that does not jump is proved".to_string(),
        0 => "no integral is proved".to_string(),
        1 => format!("1 independent integral is proved ({})", count.independent.join(", ")),
        _ => format!("{found} independent integrals are proved ({})", count.independent.join(", ")),
    };
    let space = if count.has_level { "level set" } else { "phase space" };
    let needed = match count.needed {
        0 => "only an invariant measure".to_string(),
        1 => "1 integral and an invariant measure".to_string(),
        many => format!("{many} integrals and an invariant measure"),
    };
    format!(
        "The {space} has dimension {}; {known}. The Euler–Jacobi theorem needs {needed}: {verdict}.",
        count.dimension,
    )
}

fn hamiltonian(survey: &Survey) -> Vec<SectionBlock> {
    if survey.hamiltonian.is_empty() {
        return Vec::new();
    }
    let mut found = vec![text(
        "With the multiplier N and the bracket of e(3), {Mᵢ,Mⱼ} = −εᵢⱼₖMₖ, {Mᵢ,γⱼ} = −εᵢⱼₖγₖ: \
         N⁻¹M′ = M × ∂H/∂M + γ × ∂H/∂γ, N⁻¹γ′ = γ × ∂H/∂M on (M,γ) = 0, |γ| = 1; the measure is ρ dM dγ.",
    )];
    found.extend(blocks(&survey.hamiltonian));
    found
}

fn excluded(survey: &Survey) -> Vec<SectionBlock> {
    let mut found = theorems(&survey.search);
    if !survey.fails.is_empty() {
        let has_free = survey.parameters.iter().any(|one| one.value.is_none());
        found.push(text(match has_free {
            true => {
                "Invariants of related systems that this one does not have for all values of the parameters:"
            }
            false => "Invariants of related systems that are refuted for this one:",
        }));
        found.extend(blocks(&survey.fails));
    }
    found
}

fn theorems(search: &SearchOutcome) -> Vec<SectionBlock> {
    let mut found: Vec<SectionBlock> =
        search.excluded.iter().map(|one| text(format!("Theorem. {}", one.theorem))).collect();
    if !search.counts.is_empty() {
        found.push(text(
            "Integrals polynomial in the velocities, with any smooth coefficients in the positions: upper \
             bounds on the number of integrals that are linearly independent over the constants, and how \
             many of these are products of known integrals.",
        ));
        let row = |count: &liouville_search::CountReport| {
            let degree = match (count.mixed, count.free) {
                (true, _) => format!("up to {}", count.degree),
                (false, true) => format!("{} of the free motion", count.degree),
                (false, false) => count.degree.to_string(),
            };
            let numbers = [count.dimension, count.known, count.unknowns, count.equations];
            let cells = numbers.iter().map(|number| TableCell::Text(number.to_string()));
            std::iter::once(TableCell::Text(degree)).chain(cells).collect()
        };
        found.push(SectionBlock::Table {
            head: vec!["degree", "at most", "known", "unknowns", "equations"],
            rows: search.counts.iter().map(row).collect(),
        });
    }
    found.extend(search.remarks.iter().map(|remark| text(format!("Note: {remark}."))));
    found
}

fn repeated(seed: u64, origin: &str) -> Vec<SectionBlock> {
    vec![text(format!(
        "{origin}, seed {}: the same input gives the same report. Pass a witness to `liouville eval` as \
         printed.",
        seed
    ))]
}
