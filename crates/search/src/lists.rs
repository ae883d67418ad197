//! Parameters with a list of values, of which a search modulo primes takes the first.
//!
//! A find is proved for all listed values. A theorem of absence holds for the values of its count: so it
//! is computed for each combination of values, or names those for which it is stated.

use super::hypotheses::headed;
use super::orbit::OrbitReport;
use super::origin::RemarkOrigin;
use super::{Effort, Excluded, Found, Given, SearchError, SearchReport};
use liouville::case::Case;
use liouville::mechanics::{Draw, ListedValues, Model, ParameterOrigin, SamplerSpec};
use liouville::number::rational::Rational;

/// Reason why a case with lists is not counted as a whole.
pub const HAS_LISTS: &str =
    "a parameter has a list of values: write a separate case for each value";

/// Largest number of combinations of listed values that are searched one by one.
const MOST: usize = 64;
/// The same for searches along orbits.
const MOST_ORBITS: usize = 8;

/// Largest number of listed values that a remark names.
const MOST_NAMED: usize = 8;

/// A case with one value in place of each list.
pub struct ListedCase {
    /// The case.
    pub case: Case,
    /// The values, as `a = 1 and b = 2`.
    pub values: String,
}

/// Parameters with a list of several values, by place, with the values of those that are scalars.
fn lists(case: &Case) -> Vec<(usize, Option<Vec<Rational>>)> {
    let several = |draw: &Draw| matches!(draw, Draw::OneOf(values) if values.len() > 1);
    let own = |(place, origin): (usize, &ParameterOrigin)| match origin {
        ParameterOrigin::Free(SamplerSpec::Scalar(Draw::OneOf(values))) if values.len() > 1 => {
            Some((place, Some(values.clone())))
        }
        ParameterOrigin::Free(recipe) if recipe.draws().iter().any(several) => Some((place, None)),
        _ => None,
    };
    let origins = case.model.parameters.iter().map(|parameter| &parameter.origin);
    origins.enumerate().filter_map(own).collect()
}

/// Names the first listed values, for which a search without regard to lists holds; `None` if no
/// parameter has a list of several.
pub fn first_values(case: &Case) -> Option<String> {
    let own = lists(case);
    let name = |place: usize| &case.model.parameters[place].name;
    let text = |(place, values): &(usize, Option<Vec<Rational>>)| match values {
        Some(values) => format!("{} = {}", name(*place), values[0]),
        None => format!("the first listed values of {}", name(*place)),
    };
    let texts: Vec<String> = own.iter().map(text).collect();
    match own.as_slice() {
        [] => None,
        [(_, Some(_))] => Some(format!("{}, the first of its values", texts[0])),
        [(_, None)] => Some(texts[0].clone()),
        _ => Some(format!("{}, the first listed values", texts.join(" and "))),
    }
}

/// Takes the listed values for which there is no motion out of a case, and names them in a remark with combinations of
/// others for which there is none; `None` if there is motion for all, or for none.
pub fn with_motion(case: &Case) -> Option<(Case, String)> {
    let mut moving = case.clone();
    let left_out = moving.model.leave_out_values_without_motion();
    let name = |(place, value): &(usize, Rational)| {
        format!("{} = {value}", case.model.parameters[*place].name)
    };
    let mut names: Vec<String> = left_out.iter().map(name).collect();
    let still = moving.model.choices_without_motion();
    if still.len() < all_choices(&moving) {
        let joined =
            |choice: &ListedValues| choice.iter().map(name).collect::<Vec<String>>().join(" and ");
        names.extend(still.iter().map(joined));
    }
    if names.len() > MOST_NAMED {
        let more = names.len() - MOST_NAMED;
        names.truncate(MOST_NAMED);
        names.push(format!("{more} more"));
    }
    (!names.is_empty()).then(|| {
        let remark = format!(
            "nothing is said for {}, where the equations of motion have no value",
            names.join("; ")
        );
        (moving, remark)
    })
}

/// Number of the choices of listed values of scalars.
fn all_choices(case: &Case) -> usize {
    let count = |(_, values): (usize, Option<Vec<Rational>>)| values.map_or(1, |own| own.len());
    lists(case).into_iter().map(count).product()
}

/// Lists the cases with each combination of listed values for which there is motion; `None` if these are many, or
/// belong to a parameter that is no scalar.
pub fn combinations(case: &Case) -> Option<Vec<ListedCase>> {
    let mut all = vec![ListedCase { case: case.clone(), values: String::new() }];
    for (place, values) in lists(case) {
        let mut values = values?;
        values.dedup();
        if all.len() * values.len() > MOST {
            return None;
        }
        let name = &case.model.parameters[place].name;
        let with = |own: &ListedCase, value: &Rational| {
            let mut fixed = own.case.clone();
            fixed.model.parameters[place].origin = ParameterOrigin::Fixed(vec![value.clone()]);
            let before = match own.values.as_str() {
                "" => String::new(),
                before => format!("{before} and "),
            };
            ListedCase { case: fixed, values: format!("{before}{name} = {value}") }
        };
        all = all.iter().flat_map(|own| values.iter().map(|value| with(own, value))).collect();
    }
    if all.len() > 1 {
        let still = case.model.choices_without_motion();
        let is_still = |own: &ListedCase| still.iter().any(|choice| has_values(&own.case, choice));
        if !all.iter().all(is_still) {
            all.retain(|own| !is_still(own));
        }
    }
    Some(all)
}

/// Whether the parameters have these values.
fn has_values(case: &Case, values: &ListedValues) -> bool {
    values.iter().all(|(place, value)| match &case.model.parameters[*place].origin {
        ParameterOrigin::Fixed(own) => own.as_slice() == std::slice::from_ref(value),
        ParameterOrigin::Free(SamplerSpec::Scalar(Draw::OneOf(own))) => {
            own.iter().all(|own| own == value)
        }
        _ => false,
    })
}

/// Lists the cases with each combination of up to `most` listed values; of more, the case alone with the
/// first values.
pub fn each_or_first(case: &Case, most: usize) -> Vec<ListedCase> {
    match combinations(case).filter(|all| all.len() <= most) {
        Some(all) => all,
        None => {
            let values = first_values(case).unwrap_or_default();
            vec![ListedCase { case: case.clone(), values }]
        }
    }
}

/// A part of a search.
type Run<'r> = &'r mut dyn FnMut(
    &Case,
    &Effort,
    &mut SearchReport,
    &mut dyn FnMut(&str),
) -> Result<(), SearchError>;

/// Runs a part of a search whose theorems hold for one value of each list: what holds for all values is
/// found first, and then the search is repeated for each combination, whose theorems and finds name
/// it.
pub fn by_values(
    case: &Case,
    effort: &Effort,
    report: &mut SearchReport,
    progress: &mut dyn FnMut(&str),
    run: Run<'_>,
) -> Result<(), SearchError> {
    if first_values(case).is_none() {
        return run(case, effort, report, progress);
    }
    let (before, remarks) = (report.excluded.len(), report.remarks.len());
    name_first(case, effort, report, progress, run)?;
    let Some(all) = combinations(case) else { return Ok(()) };
    let effort = Effort { seconds: effort.seconds / all.len() as f64, ..effort.clone() };
    let mut theorems: Vec<(Excluded, Vec<&str>)> = Vec::new();
    let model = &case.model;
    // In these the listed values are given, each in the same place.
    let fixed = all.first().map_or(model, |own| &own.case.model);
    let mut finds = Vec::new();
    let mut orbits = Vec::new();
    for ListedCase { case, values } in &all {
        let mut own = SearchReport {
            counts: report.counts.clone(),
            found: report.found.clone(),
            claimed: report.claimed.clone(),
            ..SearchReport::default()
        };
        let known = own.found.len();
        run(case, &effort, &mut own, &mut |part| progress(&format!("{part}, for {values}")))?;
        orbits.push((values.as_str(), own.orbits.pop()));
        for theorem in own.excluded {
            // What is stated for all values is not repeated for one.
            if report.excluded[..before].iter().any(|known| known.theorem == theorem.theorem) {
                continue;
            }
            let is_same = |(other, _): &&mut (Excluded, Vec<&str>)| {
                (&other.ansatz, &other.theorem) == (&theorem.ansatz, &theorem.theorem)
            };
            match theorems.iter_mut().find(is_same) {
                Some((_, known)) => known.push(values),
                None => theorems.push((theorem, vec![values])),
            }
        }
        finds.extend(own.found.into_iter().skip(known).map(|found| (found, values.clone())));
        for remark in own.remarks.iter().filter(|own| own.origin == RemarkOrigin::NotTried) {
            report.remark(format!("{remark} (for {values})"));
        }
    }
    // What is stated for the first values only is kept where nothing is known for each.
    let first = all.first().map(|own| own.values.as_str());
    let is_repeated = |own: &Excluded| {
        theorems.iter().any(|(other, values)| {
            values.first().copied() == first
                && own.values.is_some()
                && (own.origin, own.family()) == (other.origin, other.family())
        })
    };
    let kept: Vec<Excluded> =
        report.excluded.split_off(before).into_iter().filter(|own| !is_repeated(own)).collect();
    for (theorem, values) in theorems {
        report.excluded.push(match values.len() == all.len() {
            true => Excluded {
                theorem: headed("each of the listed values", model, fixed, &theorem.theorem),
                ..theorem
            },
            false => named(theorem, &values.join(", or "), model, fixed),
        });
    }
    report.excluded.extend(kept);
    let is_new = |(found, _): &(Found, String)| !report.found.iter().any(|own| own.says(found));
    let finds: Vec<(Found, String)> = finds.into_iter().filter(is_new).collect();
    for (mut found, values) in finds {
        found.with.push(Given::Value(values));
        report.found.push(found);
    }
    note_orbits(&orbits, report);
    // What holds for some values only is told with them.
    let mut place = 0;
    report.remarks.retain(|remark| {
        place += 1;
        place <= remarks || remark.origin != RemarkOrigin::Unproved
    });
    Ok(())
}

/// Searches along orbits: for each combination of listed values if they are few, and tells the numbers of
/// relations for each.
pub fn orbits_by_values(
    case: &Case,
    effort: &Effort,
    report: &mut SearchReport,
    progress: &mut dyn FnMut(&str),
    run: Run<'_>,
) -> Result<(), SearchError> {
    match combinations(case).is_some_and(|all| (2..=MOST_ORBITS).contains(&all.len())) {
        true => by_values(case, effort, report, progress, run),
        false => run(case, effort, report, progress),
    }
}

/// Notes how many relations along orbits there are for listed values, if other numbers are told.
fn note_orbits(orbits: &[(&str, Option<OrbitReport>)], report: &mut SearchReport) {
    if orbits.iter().all(|(_, own)| own.is_none()) {
        return;
    }
    report.remarks.retain(|own| own.origin != RemarkOrigin::Lists);
    let number = |own: &OrbitReport| (own.degree, own.relations, own.integrals);
    let told = report.orbits.last().map(number);
    let text = |(values, own): &(&str, Option<OrbitReport>)| {
        let own = own.as_ref().filter(|own| Some(number(own)) != told)?;
        Some(format!("for {values}, {}", own.sentence()))
    };
    let others: Vec<String> = orbits.iter().filter_map(text).collect();
    if others.is_empty() {
        // What is counted for each is not told as that of the first.
        report.remarks.retain(|own| own.origin != RemarkOrigin::FirstValues);
    }
    report.remark(match others.as_slice() {
        [] => "relations along an orbit are as many for each of the listed values".to_string(),
        others => others.join("; "),
    });
}

/// Runs a part of a search whose theorems hold for the first value of each list, and names these values.
pub fn name_first(
    case: &Case,
    effort: &Effort,
    report: &mut SearchReport,
    progress: &mut dyn FnMut(&str),
    run: Run<'_>,
) -> Result<(), SearchError> {
    let before = report.excluded.len();
    let outcome = run(case, effort, report, progress);
    if let Some(values) = first_values(case) {
        let stated = report.excluded.split_off(before);
        report
            .excluded
            .extend(stated.into_iter().map(|own| named(own, &values, &case.model, &case.model)));
    }
    outcome
}

/// States a theorem about a case with `fixed` values for some values of the lists of `model`.
fn named(theorem: Excluded, values: &str, model: &Model, fixed: &Model) -> Excluded {
    Excluded {
        ansatz: format!("{}, for {values}", theorem.ansatz),
        theorem: headed(values, model, fixed, &theorem.theorem),
        values: Some(values.to_string()),
        ..theorem
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn case(parameters: &str) -> Case {
        let text = format!(
            "title='x'\n[parameters]\n{parameters}\n[state]\nx='1..2'\n[field]\n\"x'\"='x'\n"
        );
        Case::parse(&text, &[]).expect("a case")
    }

    #[test]
    fn values_are_combined_and_named() {
        let none = case("a='1..2'\nb=3");
        assert_eq!(first_values(&none), None);
        assert_eq!(combinations(&none).map(|all| all.len()), Some(1));
        let two = case("a='one of 1, 0'\nb='one of 2, 3, 1/2'");
        let first = first_values(&two).expect("there are lists");
        assert_eq!(first, "a = 1 and b = 2, the first listed values");
        let all = combinations(&two).expect("there are few");
        let values: Vec<&str> = all.iter().map(|own| own.values.as_str()).collect();
        assert_eq!(values.len(), 6);
        assert_eq!((values[0], values[4]), ("a = 1 and b = 2", "a = 0 and b = 3"));
        let many = case("a='one of 1, 2, 3, 4, 5'\nb='one of 1, 2, 3, 4'\nc='one of 1, 2, 3, 4'");
        assert!(combinations(&many).is_none(), "80 are too many");
    }
}
