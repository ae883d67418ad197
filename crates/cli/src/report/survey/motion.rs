//! Poincaré section of a body's motion in a document.

use super::document::{Block, Document, Section};
use super::picture::Picture;
use crate::report::{picture as drawn, section};
use liouville_flow::{FlowError, Portrait};

/// Width of the picture in pixels.
const WIDTH: u32 = 640;

impl Document {
    /// Inserts the section after the system's description.
    pub(super) fn insert_motion(&mut self, motion: Result<&Portrait, &FlowError>) {
        let blocks = match motion {
            Ok(portrait) => blocks(portrait),
            Err(problem) => vec![Block::Text(format!("No section is drawn: {problem}."))],
        };
        let place = self.sections.len().min(2);
        self.sections.insert(place, Section { title: "Its motion", blocks });
    }
}

fn blocks(portrait: &Portrait) -> Vec<Block> {
    let (request, orbits) = (&portrait.request, &portrait.orbits);
    let picture = section::picture("Poincaré section", orbits, None, WIDTH);
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
