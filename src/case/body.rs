//! The table `[body]`: shape, mass, inertia, support, potential, rotor.

use super::arbitrary::Arbitrary;
use super::error::{Mistake, Problem};
use super::formulas::formula;
use super::kinds::RollingKind;
use super::mistakes::Mistakes;
use super::parameters::has;
use super::section::{CaseTable, SpannedStr};
use crate::formula::{Formula, Type};
use crate::mechanics::{
    Dependence, Features, FlatBase, Parameter, Potential, RigidBody, Rubber, Shape, Spinning,
    System, Vocabulary,
};

/// Reads the formula of a key, or the default text where the key is missing.
pub(super) fn formula_or(
    section: &CaseTable<'_>,
    key: &'static str,
    default: &str,
    vocabulary: &Vocabulary,
    kind: Type,
) -> Result<Formula, Mistake> {
    let text = match section.text(key)? {
        Some(text) => text,
        None if has(vocabulary, default, kind) => SpannedStr::made(default.to_string(), 0..0),
        None if section.mistakes().has_failed(default) => {
            // the mistake is reported at its declaration
            let text = SpannedStr::made(default.to_string(), section.span.clone());
            return formula(&text, vocabulary, key, Some(kind), Dependence::Parameters);
        }
        None => {
            let remedy = match vocabulary.find(default).map(|entry| entry.kind) {
                Some(found) if kind == Type::MATRIX => {
                    format!("`{default}` is a {found}: write three moments, {default} = [1, 2, 3]")
                }
                Some(found) => format!("`{default}` is a {found}, and should be a {kind}"),
                None => format!("declare the {kind} `{default}` in [parameters], or give `{key}`"),
            };
            return Err(section.missing(key, &remedy));
        }
    };
    formula(&text, vocabulary, &format!("`{key}`"), Some(kind), Dependence::Parameters)
}

fn optional(
    section: &CaseTable<'_>,
    key: &'static str,
    vocabulary: &Vocabulary,
    kind: Type,
) -> Result<Option<Formula>, Mistake> {
    let Some(text) = section.text(key)? else { return Ok(None) };
    formula(&text, vocabulary, &format!("`{key}`"), Some(kind), Dependence::Parameters).map(Some)
}

/// Names that a rolling body will have, judged by the keys alone.
pub fn features(section: &CaseTable<'_>, curved: bool, vocabulary: &Vocabulary) -> Features {
    Features {
        radius: has(vocabulary, "R", Type::Scalar),
        displacement: has(vocabulary, "c", Type::VECTOR),
        curvature: curved,
        potential: section.value("potential").is_some(),
        profile: section.value("profile").is_some(),
    }
}

/// Reads a body rolling on a plane or a sphere; `None` where there is a mistake.
pub(super) fn rolling(
    section: &CaseTable<'_>,
    way: RollingKind,
    arbitrary: &Arbitrary<'_>,
    vocabulary: &Vocabulary,
    parameters: &mut Vec<Parameter>,
) -> Option<System> {
    let scalar = Type::Scalar;
    let constant =
        |key, default, kind| section.keep(formula_or(section, key, default, vocabulary, kind));
    let curvature = way.curved.then(|| constant("curvature", "k", scalar));
    let mass = constant("mass", "m", scalar);
    let inertia = constant("inertia", "I", Type::MATRIX);
    let gyrostat = section.keep(optional(section, "gyrostat", vocabulary, Type::VECTOR));
    let shape = section.keep(shape(section, arbitrary, vocabulary, parameters));
    let potential = section.keep(potential(section, arbitrary, vocabulary, "γ3", parameters));
    let moment = section.keep(section.text("moment").and_then(|text| {
        let kind = Some(Type::VECTOR);
        let read = |text| formula(&text, vocabulary, "`moment`", kind, Dependence::Phase);
        text.map(read).transpose()
    }));
    let body = RigidBody {
        mass: mass?,
        inertia: inertia?,
        shape: shape?,
        curvature: match curvature {
            Some(curvature) => Some(curvature?),
            None => None,
        },
        gyrostat: gyrostat?,
        potential: potential?,
        moment: moment?,
    };
    Some(match way.spins {
        true => System::Spinning(Box::new(Spinning(body))),
        false => System::Rubber(Box::new(Rubber(body))),
    })
}

/// Reads a body with a flat part on a sphere; `None` where there is a mistake.
pub fn flat_base(section: &CaseTable<'_>, vocabulary: &Vocabulary) -> Option<System> {
    let constant =
        |key, default, kind| section.keep(formula_or(section, key, default, vocabulary, kind));
    let mass = constant("mass", "m", Type::Scalar);
    let inertia = constant("inertia", "I", Type::MATRIX);
    let curvature = constant("curvature", "k", Type::Scalar);
    let height = constant("height", "z", Type::Scalar);
    let gyrostat = section.keep(optional(section, "gyrostat", vocabulary, Type::VECTOR));
    let potential = section.keep(section.text("potential").and_then(|text| {
        let (what, kind) = ("the potential of a flat base", Some(Type::Scalar));
        let read = |text| formula(&text, vocabulary, what, kind, Dependence::Configuration);
        text.map(read).transpose()
    }));
    Some(System::FlatBase(Box::new(FlatBase {
        mass: mass?,
        inertia: inertia?,
        curvature: curvature?,
        height: height?,
        gyrostat: gyrostat?,
        potential: potential?,
    })))
}

fn shape(
    section: &CaseTable<'_>,
    arbitrary: &Arbitrary<'_>,
    vocabulary: &Vocabulary,
    parameters: &mut Vec<Parameter>,
) -> Result<Shape, Mistake> {
    let named = section.text("shape")?;
    let support = section.text("support")?;
    let profile = section.text("profile")?;
    let contact = section.text("contact")?;
    let given = [&named, &support, &profile, &contact].into_iter().flatten().count();
    if given != 1 {
        let message = match given {
            0 => "[body] needs a shape".to_string(),
            _ => format!("[body] has {given} shapes, and needs one"),
        };
        return Err(section.incomplete(
            message,
            "give one of shape = \"ball\", \"ellipsoid\" or \"disk\", support = \"…\", \
             profile = \"…\", contact = \"…\"",
        ));
    }
    let read = |text: &SpannedStr, what: &str, kind| {
        formula(text, vocabulary, what, Some(kind), Dependence::Configuration)
    };
    if let Some(text) = named {
        let support = named_shape(&text, vocabulary, section.mistakes())?;
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
    let text = support.unwrap_or_else(|| SpannedStr::made(String::new(), section.span.clone()));
    if text.value == "arbitrary" {
        return arbitrary.support(parameters);
    }
    // Homogeneity is tested once the model is complete.
    Ok(Shape::Support(read(&text, "the support function", Type::Scalar)?))
}

/// Support function of a named shape.
fn named_shape(
    text: &SpannedStr,
    vocabulary: &Vocabulary,
    mistakes: &Mistakes,
) -> Result<SpannedStr, Mistake> {
    let (needs, kind, support) = match text.value.as_str() {
        "ball" => ("R", Type::Scalar, "R*|γ|"),
        "ellipsoid" => ("B", Type::MATRIX, "√(γ,B*γ)"),
        "disk" => ("R", Type::Scalar, "R*√(γ1² + γ2²)"),
        _ => {
            return Err(Mistake::at(
                text.span.clone(),
                Problem::Other {
                    message: format!("unknown shape `{}`", text.value),
                    remedy: match text.value.as_str() {
                        "sphere" => "write \"ball\"; its mass centre may be off its middle by c",
                        "disc" | "coin" | "hoop" | "ring" => "write \"disk\"",
                        _ => {
                            "ball, ellipsoid and disk have names; anything else is a \
                             support = \"h(γ)\""
                        }
                    }
                    .to_string(),
                },
            ));
        }
    };
    if !has(vocabulary, needs, kind) && !mistakes.has_failed(needs) {
        let remedy = match (vocabulary.find(needs), kind) {
            (None, _) => format!("declare `{needs}` under [parameters]"),
            (Some(entry), Type::Scalar) => {
                format!("`{needs}` is a {}: write a number or a range \"1..3\"", entry.kind)
            }
            (Some(entry), _) => {
                format!("`{needs}` is a {}: write {needs} = \"diag(1..3)\"", entry.kind)
            }
        };
        let article = if text.value.starts_with(['a', 'e', 'i', 'o']) { "an" } else { "a" };
        let message = format!("{article} {} needs the {kind} `{needs}`", text.value);
        return Err(Mistake::at(text.span.clone(), Problem::Other { message, remedy }));
    }
    if let Some(entry) = vocabulary.find("c").filter(|entry| entry.kind != Type::VECTOR) {
        let message = format!("`c`, the place of the mass centre, is a {}", entry.kind);
        let remedy = "make it a vector, c = [0, 0, 0.5], or give it another name".to_string();
        return Err(Mistake::at(text.span.clone(), Problem::Other { message, remedy }));
    }
    let displaced = if has(vocabulary, "c", Type::VECTOR) { " + (c,γ)" } else { "" };
    Ok(SpannedStr::made(format!("{support}{displaced}"), text.span.clone()))
}

/// Reads the potential U, given by a formula or arbitrary; `height` is the variable of an arbitrary
/// function of one.
pub(super) fn potential(
    section: &CaseTable<'_>,
    arbitrary: &Arbitrary<'_>,
    vocabulary: &Vocabulary,
    height: &str,
    parameters: &mut Vec<Parameter>,
) -> Result<Option<Potential>, Mistake> {
    let Some(text) = section.text("potential")? else { return Ok(None) };
    let plain: String = text.value.chars().filter(|c| !c.is_whitespace()).collect();
    let of_height = plain.strip_prefix("arbitrary(").and_then(|rest| rest.strip_suffix(')'));
    let axial = match (plain.as_str(), of_height) {
        ("arbitrary", _) => false,
        (_, Some(name)) if name.replace(['[', ']'], "") == height => true,
        _ => {
            let what = "the potential";
            let read =
                formula(&text, vocabulary, what, Some(Type::Scalar), Dependence::Configuration)?;
            return Ok(Some(Potential::Formula(read)));
        }
    };
    arbitrary.potential(axial, parameters).map(Some)
}
