//! Poincaré section of a body's motion in a document.

use crate::report::{picture as drawn, section as written};
use liouville_flow::{FlowError, Portrait};
use liouville_report::survey::{Block, Picture, Section};

/// Width of the picture in pixels.
const WIDTH: u32 = 640;

/// Section of a document about the motion.
pub fn section(motion: Result<&Portrait, &FlowError>) -> Section {
    let blocks = match motion {
        Ok(portrait) => blocks(portrait),
        Err(problem) => vec![Block::Text(format!("No section is drawn: {problem}."))],
    };
    Section { title: "Its motion", blocks }
}

fn blocks(portrait: &Portrait) -> Vec<Block> {
    let (request, orbits) = (&portrait.request, &portrait.orbits);
    let picture = written::picture("Poincaré section", orbits, None, WIDTH);
    let caption = format!(
        "Poincaré section g = {}, energy {}: points (l, L/G) of {} orbits, a colour each",
        request.g0,
        request.energy,
        orbits.len()
    );
    let mut found = vec![Block::Picture(Picture { svg: drawn::inline_svg(&picture), caption })];
    if portrait.is_drawn {
        let words =
            "Free parameters have the values of the first draw; others give other pictures.";
        found.push(Block::Text(words.to_string()));
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
    found.push(Block::Text(words));
    found
}
