//! The claims of a file, in the order in which they stand there.

use std::collections::BTreeSet;

use super::claims::{self, ClaimContext};
use super::clock::Places;
use super::section::CaseTable;
use super::{AbsenceClaim, MotionClaim, PlacedClaim, absences};

/// Whether time is a variable of the state.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Time {
    /// It is none: claims that use it are left out.
    #[default]
    Absent,
    /// It is one; of the claims at these places, which can be read without it, those are left out that cannot be read
    /// with it.
    Present(BTreeSet<usize>),
}

/// Claims that can be read, by the way in which they are judged.
#[derive(Default)]
pub struct ReadClaims {
    pub claims: Vec<PlacedClaim>,
    pub motions: Vec<MotionClaim>,
    pub absences: Vec<AbsenceClaim>,
    /// Names of all of them, by their places in the file.
    pub places: Places,
    /// Whether others were left out, because of `t`.
    pub leaves_out: bool,
}

impl ReadClaims {
    /// Reads all claims of a file.
    pub fn new(root: &CaseTable<'_>, context: &ClaimContext<'_>, time: &Time) -> Self {
        let (mut all, mut names) = (Self::default(), Vec::new());
        for (place, section) in root.tables("claim").into_iter().enumerate() {
            if claims::is_misspelt(&section) {
                continue;
            }
            let before = root.mistakes().len();
            if let Some(name) = all.read(&section, context, &names) {
                all.places.insert(place, name.clone());
                names.push(name);
                continue;
            }
            let is_left_out = match time {
                Time::Absent => root.mistakes().lacks_time_since(before),
                Time::Present(others) => others.contains(&place),
            };
            if is_left_out {
                root.mistakes().forget_since(before);
                all.leaves_out = true;
                names.extend(section.text("name").ok().flatten().map(|name| name.value));
            }
        }
        all
    }

    /// Reads one claim and returns its name.
    fn read(
        &mut self,
        section: &CaseTable<'_>,
        context: &ClaimContext<'_>,
        names: &[String],
    ) -> Option<String> {
        let name;
        if absences::is_about_absence(section) {
            let claim = section.keep(absences::read(section, context, names))?;
            name = claim.name.clone();
            self.absences.push(claim);
        } else if claims::is_about_motion(section) {
            let claim =
                section.keep(claims::read_motion(section, context, (names, &self.claims)))?;
            name = claim.name.clone();
            self.motions.push(claim);
        } else if claims::waits_for_bracket(section, context) {
            return None;
        } else {
            let claim = section.keep(claims::read(section, context, names))?;
            name = claim.name.clone();
            self.claims.push(claim);
        }
        Some(name)
    }
}
