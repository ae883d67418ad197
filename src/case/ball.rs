//! The table `[body]` of a homogeneous ball on a surface.

use super::arbitrary::Arbitrary;
use super::body::{formula_or, potential};
use super::error::{Mistake, Problem};
use super::formulas::formula;
use super::section::{CaseTable, SpannedStr};
use crate::formula::Type;
use crate::mechanics::{
    BallOnSurface, Dependence, Meaning, NORMAL, Parameter, Shape, Surface, System, Vocabulary,
};

/// Reads the table; the names of the system are declared. `None` where there is a mistake.
pub fn read(
    section: &CaseTable<'_>,
    arbitrary: &Arbitrary<'_>,
    vocabulary: &mut Vocabulary,
    parameters: &mut Vec<Parameter>,
) -> Option<System> {
    let scalar = Type::Scalar;
    let surface = section.keep(surface(section, arbitrary, vocabulary, parameters));
    // The potential is a function of the centre, which takes γ's place where Σ is given by h.
    let centre =
        vocabulary.hide("r", Meaning::State(NORMAL), Type::VECTOR, Dependence::Configuration);
    let vocabulary = &*vocabulary;
    let mut of_centre = vocabulary.only_parameters();
    of_centre.bind("r", centre);
    let potential = section.keep(potential(section, arbitrary, &of_centre, "r3", parameters));
    let rotation = section.keep(section.text("rotation").and_then(|text| {
        let read = |text| formula(&text, vocabulary, "Ω", Some(scalar), Dependence::Parameters);
        text.map(read).transpose()
    }));
    let rotating_frame = section.keep(is_rotating(section));
    let constant =
        |key, default| section.keep(formula_or(section, key, default, vocabulary, scalar));
    let (mass, radius) = (constant("mass", "m"), constant("radius", "R"));
    let moment = constant("moment", "μ");
    Some(System::Ball(Box::new(BallOnSurface {
        mass: mass?,
        radius: radius?,
        moment: moment?,
        surface: surface?,
        potential: potential?,
        rotation: rotation?,
        rotating_frame: rotating_frame?,
    })))
}

fn is_rotating(section: &CaseTable<'_>) -> Result<bool, Mistake> {
    let turns = section.value("rotation").is_some();
    match section.text("frame")? {
        None => Ok(false),
        Some(text) if text.value == "fixed" => Ok(false),
        Some(text) if text.value == "rotating" && turns => Ok(true),
        Some(text) => {
            let message = format!("`{}` is not a frame of this ball", text.value);
            let remedy = "write \"fixed\", or \"rotating\" with a `rotation`".to_string();
            Err(Mistake::at(text.span, Problem::Other { message, remedy }))
        }
    }
}

fn surface(
    section: &CaseTable<'_>,
    arbitrary: &Arbitrary<'_>,
    vocabulary: &Vocabulary,
    parameters: &mut Vec<Parameter>,
) -> Result<Surface, Mistake> {
    let read = |text, what: &str| {
        formula(text, vocabulary, what, Some(Type::Scalar), Dependence::Configuration)
    };
    let is_any = |text: &SpannedStr| text.value == "arbitrary";
    match (section.text("surface")?, section.text("support")?, section.text("profile")?) {
        (Some(text), None, None) if is_any(&text) => arbitrary.level(parameters),
        (Some(text), None, None) => Ok(Surface::Level(read(&text, "the surface")?)),
        (None, Some(text), None) => Ok(Surface::Support(match is_any(&text) {
            true => arbitrary.support(parameters)?,
            false => Shape::Support(read(&text, "the support function")?),
        })),
        (None, None, Some(text)) => Ok(Surface::Support(match is_any(&text) {
            true => arbitrary.profile(parameters)?,
            false => Shape::Profile(read(&text, "the profile")?),
        })),
        (None, None, None) => Err(section.incomplete(
            "the surface of the ball is missing".to_string(),
            "give surface = \"F(r)\", support = \"h(γ)\" or profile = \"p(z)\"",
        )),
        _ => Err(section.incomplete(
            "the surface of the ball is given more than once".to_string(),
            "keep one of surface = \"F(r)\", support = \"h(γ)\" and profile = \"p(z)\"",
        )),
    }
}
