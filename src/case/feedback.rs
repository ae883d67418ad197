//! Check against circular definitions of a body.

use super::error::{Mistake, Problem};
use super::section::CaseTable;
use super::systems::Reading;
use crate::mechanics::{Meaning, Quantity, Shape, Surface, System, VocabularyEntry};

/// Checks that the definition of a body does not depend on quantities it determines: the potential
/// on U, the surface on h, a moment of forces on the acceleration.
pub fn none(
    reading: &Reading<'_, '_>,
    section: &CaseTable<'_>,
    system: &System,
) -> Result<(), Mistake> {
    use Quantity::{AngularAcceleration, Multiplier, Potential as OwnPotential, Support};
    let of_shape = |shape: &Shape| match shape {
        Shape::Support(formula) | Shape::SupportOnSphere(formula) => {
            Some(("support", formula.clone()))
        }
        Shape::Profile(formula) => Some(("profile", formula.clone())),
        Shape::Contact(formula) => Some(("contact", formula.clone())),
        Shape::Arbitrary(_) | Shape::ArbitraryProfile(_) => None,
    };
    let (body, moment) = (system.body(), system.moment().cloned());
    let shape = match system {
        System::Ball(ball) => match &ball.surface {
            Surface::Support(shape) => of_shape(shape),
            Surface::Level(_) | Surface::Arbitrary(_) => None,
        },
        _ => body.and_then(|body| of_shape(&body.shape)),
    };
    let potential = body.and_then(|body| body.potential.as_ref()?.formula().cloned());
    let potential = potential.map(|formula| ("potential", formula));
    let given = [
        (shape, &[Support, OwnPotential][..], "write it by γ and the parameters"),
        (potential, &[OwnPotential], "write it by γ, h and the parameters"),
        (
            moment.map(|moment| ("moment", moment)),
            &[AngularAcceleration, Multiplier],
            "write it by the state, r, r' and γ'",
        ),
    ];
    for (formula, determined, remedy) in given {
        let Some((key, formula)) = formula else { continue };
        let is_determined = |entry: &&VocabularyEntry| match entry.meaning {
            Meaning::Quantity(quantity) => determined.contains(&quantity),
            _ => false,
        };
        let uses = reading.vocabulary.uses(&formula, &reading.abbreviations);
        if let Some(entry) = uses.into_iter().find(is_determined) {
            let message = format!("`{key}` depends on `{}`, which it determines", entry.name);
            let problem = Problem::Sense { message, remedy: remedy.to_string() };
            let place = section.text(key)?.map_or(section.span.clone(), |text| text.span);
            return Err(Mistake::at(place, problem));
        }
    }
    Ok(())
}
