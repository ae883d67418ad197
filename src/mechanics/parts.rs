//! Parts of the equations of motion that a case may leave out.

use super::system::System;

/// A part of the equations of motion that is recorded only where a case has it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// Forces with a potential.
    Potential,
    /// Moment of forces without a potential.
    Moment,
    /// Rotor.
    Rotor,
    /// Curvature of the support.
    Curvature,
    /// Rotation of the surface.
    Rotation,
}

impl Part {
    /// Returns the name in reports.
    pub fn name(self) -> &'static str {
        match self {
            Part::Potential => "potential",
            Part::Moment => "moment",
            Part::Rotor => "rotor",
            Part::Curvature => "curvature",
            Part::Rotation => "rotation",
        }
    }
}

impl System {
    /// Lists the parts that a system of this kind may have.
    pub fn possible_parts(&self) -> &'static [Part] {
        match self {
            System::Rubber(_) | System::Spinning(_) => {
                &[Part::Potential, Part::Moment, Part::Rotor, Part::Curvature]
            }
            System::FlatBase(_) => &[Part::Rotor],
            System::Ball(_) => &[Part::Potential, Part::Rotation],
            System::Lagrangian(_) | System::Hamiltonian(_) | System::Field(_) | System::Map(_) => {
                &[]
            }
        }
    }

    /// Returns the system without a part; `None` where it has none of it.
    pub fn without(&self, part: Part) -> Option<System> {
        let mut rest = self.clone();
        let had = match (&mut rest, part) {
            (System::Ball(ball), Part::Potential) => ball.potential.take().is_some(),
            (System::Ball(ball), Part::Rotation) => {
                ball.rotating_frame = false;
                ball.rotation.take().is_some()
            }
            (System::FlatBase(base), Part::Rotor) => base.gyrostat.take().is_some(),
            (system, part) => system.body_mut().is_some_and(|body| match part {
                Part::Potential => body.potential.take().is_some(),
                Part::Moment => body.moment.take().is_some(),
                Part::Rotor => body.gyrostat.take().is_some(),
                Part::Curvature => body.curvature.take().is_some(),
                Part::Rotation => false,
            }),
        };
        had.then_some(rest)
    }
}
