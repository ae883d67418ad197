//! Poincaré section of a body's motion in a document.

use crate::report::section::drawing;
use liouville_draw::{Figure, Size, inline_svg};
use liouville_flow::{FlowError, Portrait};
use liouville_report::survey::{DocumentSection, Picture, SectionBlock};

/// Size of the picture.
const SIZE: Size = Size { width: 150.0, height: None, dot: 0.3, opacity: 1.0 };

/// Section of a document about the motion.
pub fn section(motion: Result<&Portrait, &FlowError>) -> DocumentSection {
    let blocks = match motion {
        Ok(portrait) => blocks(portrait),
        Err(FlowError::NoAndoyer) => vec![SectionBlock::Text(
            "No section is drawn: reports have sections of bodies that roll, in (l, L/G)."
                .to_string(),
        )],
        Err(problem) => vec![SectionBlock::Text(format!("No section is drawn: {problem}."))],
    };
    DocumentSection { title: "Its motion", blocks }
}

fn blocks(portrait: &Portrait) -> Vec<SectionBlock> {
    let (request, orbits) = (&portrait.request, &portrait.orbits);
    let mut plot = drawing::plane();
    drawing::draw_orbits(&mut plot, orbits, drawing::Colouring::Orbits);
    let figure = Figure {
        title: String::new(),
        caption: Vec::new(),
        plots: vec![plot],
        columns: 1,
        size: SIZE,
    };
    let mut scene = figure.scene();
    scene.title = "Poincaré section".to_string();
    let caption = format!(
        "Poincaré section g = {}, energy {}: points (l, L/G) of {} orbits, a colour each",
        request.g0,
        request.energy,
        orbits.len()
    );
    let mut found = vec![SectionBlock::Picture(Picture { svg: inline_svg(&scene), caption })];
    if portrait.is_drawn {
        let words =
            "Free parameters have the values of the first draw; others give other pictures.";
        found.push(SectionBlock::Text(words.to_string()));
    }
    let worst = orbits.iter().map(|orbit| orbit.drift).fold(0.0, f64::max);
    let lost = orbits.iter().filter(|orbit| orbit.problem.is_some()).count();
    let mut words = format!(
        "A picture is no proof. The energy drifts by {worst:.1e} at most. Curves are the work of an \
         integral or of slow motion, clouds are chaos; the commands section and exponents tell more."
    );
    if lost > 0 {
        words.push_str(&format!(" {lost} orbits have no start or end early."));
    }
    found.push(SectionBlock::Text(words));
    found
}
