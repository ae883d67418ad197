//! `[body]` of a homogeneous ball on a surface.

use super::arbitrary::Arbitrary;
use super::body::{formula, formula_or, potential};
use super::error::{CaseError, Problem};
use super::section::Section;
use crate::formula::Type;
use crate::mechanics::{
    BallOnSurface, Meaning, NORMAL, Parameter, Reach, Shape, Surface, System, Vocabulary,
};

/// Reads it; the names of the system are declared.
pub fn read(
    section: &Section<'_>,
    arbitrary: &Arbitrary<'_>,
    vocabulary: &mut Vocabulary,
    parameters: &mut Vec<Parameter>,
) -> Result<System, CaseError> {
    let scalar = Type::Scalar;
    let (by_level, by_support) = (section.text("surface")?, section.text("support")?);
    let read =
        |text, what: &str| formula(text, vocabulary, what, Some(scalar), Reach::Configuration);
    let surface = match (by_level, by_support) {
        (Some(text), None) => Surface::Level(read(&text, "the surface")?),
        (None, Some(text)) if text.value == "arbitrary" => {
            Surface::Support(arbitrary.support(parameters)?)
        }
        (None, Some(text)) => {
            Surface::Support(Shape::Support(read(&text, "the support function")?))
        }
        (surface, _) => {
            let given = if surface.is_some() { "both" } else { "neither" };
            return Err(section.complaint(Problem::Other {
                message: format!(
                    "the surface is given by a level or a support function, not by {given}"
                ),
                remedy: "give surface = \"F(r)\" or support = \"h(γ)\"".to_string(),
            }));
        }
    };
    // The potential is a function of the centre, which stands in γ's place where Σ is given by h.
    let centre = vocabulary.hide("r", Meaning::State(NORMAL), Type::VECTOR, Reach::Configuration);
    let vocabulary = &*vocabulary;
    let mut of_centre = vocabulary.only_parameters();
    of_centre.bind("r", centre);
    let potential = potential(section, arbitrary, &of_centre, parameters)?;
    let rotation = match section.text("rotation")? {
        Some(text) => Some(formula(&text, vocabulary, "Ω", Some(scalar), Reach::Parameters)?),
        None => None,
    };
    let rotating_frame = match section.text("frame")? {
        None => false,
        Some(text) if text.value == "fixed" => false,
        Some(text) if text.value == "rotating" && rotation.is_some() => true,
        Some(text) => {
            let message = format!("`{}` is no frame of this ball", text.value);
            let remedy = "write \"fixed\", or \"rotating\" with a `rotation`".to_string();
            return Err(CaseError::at(text.span, Problem::Other { message, remedy }));
        }
    };
    Ok(System::Ball(Box::new(BallOnSurface {
        mass: formula_or(section, "mass", "m", vocabulary, scalar)?,
        radius: formula_or(section, "radius", "R", vocabulary, scalar)?,
        moment: formula_or(section, "moment", "μ", vocabulary, scalar)?,
        surface,
        potential,
        rotation,
        rotating_frame,
    })))
}
