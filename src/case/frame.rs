//! The keys `frame` and `track` of a rolling body: its orientation Q, and the place X of the contact
//! in space.
//!
//! The columns of Q are the axes of space in the body, Q' = ω̃Q with ω̃x = x×ω. The contact moves
//! along the support with the velocity that it has along the body, X' = Qᵀr', on the plane and on a
//! sphere alike; on a sphere of curvature k, X = Qᵀγ/k up to a constant.

use super::error::{Mistake, Problem};
use super::parameters::NO_NAME;
use super::section::{CaseTable, SpannedStr};
use super::systems::Reading;
use crate::formula::{Formula, Type, canonical_name, is_function};
use crate::mechanics::{Dependence, Draw, Meaning, NumberLine, Quantity, Range};

impl Reading<'_, '_> {
    /// Adds the orientation and the place of the contact to the state, where the body asks for
    /// them; returns their number.
    pub(super) fn fixed_frame(&mut self, section: &CaseTable<'_>) -> usize {
        let given = |key| section.keep(section.text(key)).flatten();
        let (frame, track) = (given("frame"), given("track"));
        if let (None, Some(track)) = (&frame, &track)
            && section.value("frame").is_none()
        {
            let message = "`track` needs the orientation of the body".to_string();
            let remedy = "add frame = \"Q\", the name of the orientation".to_string();
            let problem = Problem::Other { message, remedy };
            self.mistakes().add(Mistake::at(track.span.clone(), problem));
            return 0;
        }
        let Some(frame) = frame.and_then(|text| self.further(&text, Type::MATRIX)) else {
            return 0;
        };
        let mut rates = vec![format!("hat(ω)ᵀ*{frame}")];
        if let Some(text) = track {
            let contact = self.vocabulary.find("r'").map(|entry| entry.meaning);
            if contact != Some(Meaning::Quantity(Quantity::ContactRate)) {
                let message = "`track` needs the rate r' of the contact, and the file gives this \
                               name another meaning"
                    .to_string();
                let remedy = "call the parameter something else".to_string();
                let problem = Problem::Other { message, remedy };
                self.mistakes().add(Mistake::at(text.span.clone(), problem));
            } else if self.further(&text, Type::VECTOR).is_some() {
                rates.push(format!("{frame}ᵀ*r'"));
            }
        }
        for rate in &rates {
            let parsed = Formula::parse(rate, &self.vocabulary);
            let read = parsed.map_err(|error| section.complaint(Problem::Formula(error)));
            self.extension.extend(section.keep(read));
        }
        rates.len()
    }

    /// Adds a variable under the name that the file gives it; returns the name, or `None` after
    /// noting the mistake.
    fn further(&mut self, text: &SpannedStr, kind: Type) -> Option<String> {
        let refused = |reason: &str| {
            let (name, reason) = (text.value.clone(), reason.to_string());
            Mistake::at(text.span.clone(), Problem::BadName { name, reason })
        };
        let name = canonical_name(&text.value).ok_or_else(|| refused(NO_NAME));
        let name = self.mistakes().keep(name)?;
        if self.vocabulary.find(&name).is_some() {
            self.mistakes().add(refused("it is taken already"));
            return None;
        }
        if is_function(&name) {
            self.mistakes().add(refused("it is a function"));
            return None;
        }
        let size = if kind == Type::MATRIX { 1 } else { 2 };
        let draw = Draw::Of(NumberLine::All, Range::between((-size, 1), (size, 1)));
        let draws = vec![draw; kind.size()];
        self.state.add(&name, kind, draws, &mut self.vocabulary, Dependence::Phase);
        Some(name)
    }
}
