//! `[body]`: shape, mass, inertia, support, potential, rotor.

use super::arbitrary::Arbitrary;
use super::error::{CaseError, Problem};
use super::parameters::has;
use super::section::{Section, Text};
use crate::formula::{Formula, FormulaError, Scope, Type};
use crate::mechanics::{
    Features, FlatBase, Meaning, Parameter, Potential, Reach, Rubber, Shape, System, Vocabulary,
};

/// Reads a formula and checks its kind and what it depends on.
pub fn formula(
    text: &Text,
    vocabulary: &Vocabulary,
    what: &str,
    expected: Option<Type>,
    reach: Reach,
) -> Result<Formula, CaseError> {
    let failed =
        |error: FormulaError| CaseError::at(text.locate(error.span()), Problem::Formula(error));
    let formula = Formula::parse(&text.value, vocabulary).map_err(failed)?;
    let whole = || text.locate(0..text.value.len());
    if let Some(expected) = expected.filter(|expected| *expected != formula.value_type()) {
        let (what, found) = (what.to_string(), formula.value_type());
        return Err(CaseError::at(whole(), Problem::WrongKind { what, expected, found }));
    }
    match vocabulary.reach(&formula) {
        Some(entry) if entry.reach > reach => {
            let allowed = match reach {
                Reach::Parameters => "parameters".to_string(),
                _ => format!("{} and parameters", position(vocabulary)),
            };
            let (what, name) = (what.to_string(), entry.name.clone());
            Err(CaseError::at(whole(), Problem::Reach { what, allowed, name }))
        }
        _ => Ok(formula),
    }
}

/// What a system calls the part of its state that shapes and potentials are functions of.
fn position(vocabulary: &Vocabulary) -> &str {
    let mut names = vocabulary.iter().filter(|(symbol, entry)| {
        let is_state = matches!(entry.meaning, Meaning::State(_));
        let is_found = vocabulary.lookup(&entry.name).is_some_and(|(found, _)| found == *symbol);
        is_state && is_found && entry.reach == Reach::Configuration
    });
    match (names.next(), names.next()) {
        (Some((_, only)), None) => &only.name,
        _ => "the state",
    }
}

/// A formula under a key, or the default text where the key is missing.
pub(super) fn formula_or(
    section: &Section<'_>,
    key: &'static str,
    default: &str,
    vocabulary: &Vocabulary,
    kind: Type,
) -> Result<Formula, CaseError> {
    let text = match section.text(key)? {
        Some(text) => text,
        None if has(vocabulary, default, kind) => Text::made(default.to_string(), 0..0),
        None => {
            let remedy = match vocabulary.find(default).map(|entry| entry.kind) {
                Some(found) => format!("`{default}` is a {found}, and should be a {kind}"),
                None => format!("declare the {kind} `{default}` in [parameters], or give `{key}`"),
            };
            return Err(section.missing(key, &remedy));
        }
    };
    formula(&text, vocabulary, &format!("`{key}`"), Some(kind), Reach::Parameters)
}

fn optional(
    section: &Section<'_>,
    key: &'static str,
    vocabulary: &Vocabulary,
    kind: Type,
) -> Result<Option<Formula>, CaseError> {
    let Some(text) = section.text(key)? else { return Ok(None) };
    formula(&text, vocabulary, &format!("`{key}`"), Some(kind), Reach::Parameters).map(Some)
}

/// What names a rubber body will have, from the keys alone.
pub fn features(section: &Section<'_>, curved: bool, vocabulary: &Vocabulary) -> Features {
    Features {
        radius: has(vocabulary, "R", Type::Scalar),
        displacement: has(vocabulary, "c", Type::VECTOR),
        curvature: curved,
        potential: section.value("potential").is_some(),
        profile: section.value("profile").is_some(),
    }
}

/// A body rolling on a plane, or on a sphere if `curved`.
pub fn rubber(
    section: &Section<'_>,
    curved: bool,
    arbitrary: &Arbitrary<'_>,
    vocabulary: &Vocabulary,
    parameters: &mut Vec<Parameter>,
) -> Result<System, CaseError> {
    let scalar = Type::Scalar;
    let curvature = match curved {
        true => Some(formula_or(section, "curvature", "k", vocabulary, scalar)?),
        false => None,
    };
    let mass = formula_or(section, "mass", "m", vocabulary, scalar)?;
    let inertia = formula_or(section, "inertia", "I", vocabulary, Type::MATRIX)?;
    let gyrostat = optional(section, "gyrostat", vocabulary, Type::VECTOR)?;
    let shape = shape(section, arbitrary, vocabulary, parameters)?;
    let potential = potential(section, arbitrary, vocabulary, parameters)?;
    let moment = match section.text("moment")? {
        Some(text) => {
            let (what, kind) = ("`moment`", Some(Type::VECTOR));
            Some(formula(&text, vocabulary, what, kind, Reach::Phase)?)
        }
        None => None,
    };
    let body = Rubber { mass, inertia, shape, curvature, gyrostat, potential, moment };
    Ok(System::Rubber(Box::new(body)))
}

/// A body with a flat part on a sphere.
pub fn flat_base(section: &Section<'_>, vocabulary: &Vocabulary) -> Result<System, CaseError> {
    Ok(System::FlatBase(Box::new(FlatBase {
        mass: formula_or(section, "mass", "m", vocabulary, Type::Scalar)?,
        inertia: formula_or(section, "inertia", "I", vocabulary, Type::MATRIX)?,
        curvature: formula_or(section, "curvature", "k", vocabulary, Type::Scalar)?,
        height: formula_or(section, "height", "z", vocabulary, Type::Scalar)?,
        gyrostat: optional(section, "gyrostat", vocabulary, Type::VECTOR)?,
    })))
}

fn shape(
    section: &Section<'_>,
    arbitrary: &Arbitrary<'_>,
    vocabulary: &Vocabulary,
    parameters: &mut Vec<Parameter>,
) -> Result<Shape, CaseError> {
    let named = section.text("shape")?;
    let support = section.text("support")?;
    let profile = section.text("profile")?;
    let contact = section.text("contact")?;
    let given = [&named, &support, &profile, &contact].into_iter().flatten().count();
    if given != 1 {
        return Err(section.complaint(Problem::Other {
            message: format!("[body] needs exactly one of its four shapes, and has {given}"),
            remedy: "give one of shape = \"ball\", \"ellipsoid\" or \"disk\", support = \"…\", \
                         profile = \"…\", contact = \"…\""
                .to_string(),
        }));
    }
    let read = |text: &Text, what: &str, kind| {
        formula(text, vocabulary, what, Some(kind), Reach::Configuration)
    };
    if let Some(text) = named {
        let support = named_shape(&text, vocabulary)?;
        return Ok(Shape::Support(read(&support, "the support function", Type::Scalar)?));
    }
    if let Some(text) = contact {
        return Ok(Shape::Contact(read(&text, "the point of contact", Type::VECTOR)?));
    }
    if let Some(text) = profile {
        if text.value == "arbitrary" {
            return arbitrary.profile(parameters);
        }
        return Ok(Shape::Profile(read(&text, "the profile", Type::Scalar)?));
    }
    let text = support.unwrap_or_else(|| Text::made(String::new(), section.span.clone()));
    if text.value == "arbitrary" {
        return arbitrary.support(parameters);
    }
    // Whether it is homogeneous is found out when the model stands.
    Ok(Shape::Support(read(&text, "the support function", Type::Scalar)?))
}

/// The support function of a shape that has a name.
fn named_shape(text: &Text, vocabulary: &Vocabulary) -> Result<Text, CaseError> {
    let (needs, kind, support) = match text.value.as_str() {
        "ball" => ("R", Type::Scalar, "R*|γ|"),
        "ellipsoid" => ("B", Type::MATRIX, "√(γ,B*γ)"),
        "disk" => ("R", Type::Scalar, "R*√(γ1² + γ2²)"),
        _ => {
            return Err(CaseError::at(
                text.span.clone(),
                Problem::Other {
                    message: format!("`{}` is no shape with a name", text.value),
                    remedy:
                        "ball, ellipsoid and disk have names; anything else is a support = \"h(γ)\""
                            .to_string(),
                },
            ));
        }
    };
    if !has(vocabulary, needs, kind) {
        return Err(CaseError::at(
            text.span.clone(),
            Problem::Other {
                message: format!("a {} needs the {kind} `{needs}`", text.value),
                remedy: format!("declare `{needs}` under [parameters]"),
            },
        ));
    }
    if let Some(entry) = vocabulary.find("c").filter(|entry| entry.kind != Type::VECTOR) {
        let message = format!("`c`, the place of the mass centre, is a {}", entry.kind);
        let remedy = "make it a vector, c = [0, 0, 0.5], or give it another name".to_string();
        return Err(CaseError::at(text.span.clone(), Problem::Other { message, remedy }));
    }
    let displaced = if has(vocabulary, "c", Type::VECTOR) { " + (c,γ)" } else { "" };
    Ok(Text::made(format!("{support}{displaced}"), text.span.clone()))
}

/// U, typed or arbitrary.
pub(super) fn potential(
    section: &Section<'_>,
    arbitrary: &Arbitrary<'_>,
    vocabulary: &Vocabulary,
    parameters: &mut Vec<Parameter>,
) -> Result<Option<Potential>, CaseError> {
    let Some(text) = section.text("potential")? else { return Ok(None) };
    let plain: String = text.value.chars().filter(|c| !c.is_whitespace()).collect();
    let axial = match plain.as_str() {
        "arbitrary" => false,
        "arbitrary(γ3)" | "arbitrary(γ[3])" => true,
        _ => {
            let what = "the potential";
            let read = formula(&text, vocabulary, what, Some(Type::Scalar), Reach::Configuration)?;
            return Ok(Some(Potential::Formula(read)));
        }
    };
    arbitrary.potential(axial, parameters).map(Some)
}
