//! The table `[body]` of a homogeneous ball on a surface.

use super::arbitrary::Arbitrary;
use super::body::{formula_or, potential};
use super::error::{Mistake, Problem};
use super::formulas::formula;
use super::section::Section;
use crate::formula::Type;
use crate::mechanics::{
    BallOnSurface, Meaning, NORMAL, Parameter, Reach, Shape, Surface, System, Vocabulary,
};

/// Reads the table; the names of the system are declared. `None` where there is a mistake.
pub fn read(
    section: &Section<'_>,
    arbitrary: &Arbitrary<'_>,
    vocabulary: &mut Vocabulary,
    parameters: &mut Vec<Parameter>,
) -> Option<System> {
    let scalar = Type::Scalar;
    let surface = section.keep(surface(section, arbitrary, vocabulary, parameters));
    // The potential is a function of the centre, which takes γ's place where Σ is given by h.
    let centre = vocabulary.hide("r", Meaning::State(NORMAL), Type::VECTOR, Reach::Configuration);
    let vocabulary = &*vocabulary;
    let mut of_centre = vocabulary.only_parameters();
    of_centre.bind("r", centre);
    let potential = section.keep(potential(section, arbitrary, &of_centre, parameters));
    let rotation = section.keep(section.text("rotation").and_then(|text| {
        let read = |text| formula(&text, vocabulary, "Ω", Some(scalar), Reach::Parameters);
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

fn is_rotating(section: &Section<'_>) -> Result<bool, Mistake> {
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
    section: &Section<'_>,
    arbitrary: &Arbitrary<'_>,
    vocabulary: &Vocabulary,
    parameters: &mut Vec<Parameter>,
) -> Result<Surface, Mistake> {
    let read = |text, what: &str| {
        formula(text, vocabulary, what, Some(Type::Scalar), Reach::Configuration)
    };
    match (section.text("surface")?, section.text("support")?) {
        (Some(text), None) => Ok(Surface::Level(read(&text, "the surface")?)),
        (None, Some(text)) if text.value == "arbitrary" => {
            Ok(Surface::Support(arbitrary.support(parameters)?))
        }
        (None, Some(text)) => {
            Ok(Surface::Support(Shape::Support(read(&text, "the support function")?)))
        }
        (surface, _) => {
            let given = if surface.is_some() { "both" } else { "neither" };
            Err(section.incomplete(
                format!("the surface is given by a level or a support function, not by {given}"),
                "give surface = \"F(r)\" or support = \"h(γ)\"",
            ))
        }
    }
}
