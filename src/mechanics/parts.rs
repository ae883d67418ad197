//! Parts of the equations of motion that a case may leave out.

use super::system::System;

/// A part of the equations of motion that is recorded only where a case has it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EquationPart {
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

impl EquationPart {
    /// Returns the name in reports.
    pub fn name(self) -> &'static str {
        match self {
            EquationPart::Potential => "potential",
            EquationPart::Moment => "moment",
            EquationPart::Rotor => "rotor",
            EquationPart::Curvature => "curvature",
            EquationPart::Rotation => "rotation",
        }
    }
}

impl System {
    /// Lists the parts that a system of this kind may have.
    pub fn possible_parts(&self) -> &'static [EquationPart] {
        match self {
            System::Rubber(_) | System::Spinning(_) => &[
                EquationPart::Potential,
                EquationPart::Moment,
                EquationPart::Rotor,
                EquationPart::Curvature,
            ],
            System::FlatBase(_) => &[EquationPart::Potential, EquationPart::Rotor],
            System::Ball(_) => &[EquationPart::Potential, EquationPart::Rotation],
            System::Lagrangian(_) | System::Hamiltonian(_) | System::Field(_) | System::Map(_) => {
                &[]
            }
        }
    }

    /// Returns the system without a part; `None` where it has none of it.
    pub fn without(&self, part: EquationPart) -> Option<System> {
        let mut rest = self.clone();
        let had = match (&mut rest, part) {
            (System::Ball(ball), EquationPart::Potential) => ball.potential.take().is_some(),
            (System::Ball(ball), EquationPart::Rotation) => {
                ball.rotating_frame = false;
                ball.rotation.take().is_some()
            }
            (System::FlatBase(base), EquationPart::Rotor) => base.gyrostat.take().is_some(),
            (System::FlatBase(base), EquationPart::Potential) => base.potential.take().is_some(),
            (system, part) => system.body_mut().is_some_and(|body| match part {
                EquationPart::Potential => body.potential.take().is_some(),
                EquationPart::Moment => body.moment.take().is_some(),
                EquationPart::Rotor => body.gyrostat.take().is_some(),
                EquationPart::Curvature => body.curvature.take().is_some(),
                EquationPart::Rotation => false,
            }),
        };
        had.then_some(rest)
    }
}
