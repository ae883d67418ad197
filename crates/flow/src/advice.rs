//! Advice on errors of motions.

use crate::error::FlowError;

impl FlowError {
    /// Advice on how to avoid the error.
    pub fn help(&self) -> &'static str {
        match self {
            FlowError::NotAnalytic => "write the field without it, on one side of its zero",
            FlowError::Antiderivative => "write the function itself instead of ∫(f, x)",
            FlowError::Singular { time: 0.0, .. } => {
                "choose another start; if all are singular, the parameters are"
            }
            FlowError::NoValue { time: 0.0, .. } => {
                "choose another start, or other parameters; a formula that goes on there is written \
                 without the operation, as x for x²/x"
            }
            FlowError::NoValue { .. } => {
                "choose another start, or a shorter time; a formula that goes on there is written \
                 without the operation, as x for x²/x"
            }
            FlowError::Singular { .. }
            | FlowError::RunsAway { .. }
            | FlowError::TooShort { .. }
            | FlowError::Shrinking { .. } => "choose another start, or a shorter time",
            FlowError::Slides { .. } => {
                "choose a shorter time, or write the motion along the jump as a [one-sided] constraint; \
                 a steep function, as tanh(1000*x) for sign(x), slides nearly so"
            }
            FlowError::Jumps => "write a steep function, as tanh(100*x) for sign(x)",
            FlowError::Endless { .. } => "give a shorter time",
            FlowError::Overflow(_) => {
                "choose another start or a shorter time, or measure in units in which numbers are \
                 nearer to 1"
            }
            FlowError::NoColumnValue { .. } => {
                "ask for values that exist along all motions, such as |x| and not ln(x)"
            }
            FlowError::NoAndoyer => {
                "give a surface, such as --section 'x = 0', and starts by states"
            }
            FlowError::NoSection => "add [section] with g0 and energy",
            FlowError::Arbitrary => "give a shape and a potential by formulas",
            FlowError::Discrete => {
                "`motion orbit --iterates N` follows the iterates of a map, and `motion exponents` \
                 measures how neighbours separate; for the rest give a case with a field"
            }
            FlowError::OffSphere { .. } => "write a start as l,z with |z| < 1",
            FlowError::BelowPotential { .. } => "choose a higher energy, or another start",
            FlowError::NeverCrossed { .. } => {
                "choose another start, another surface (--section or --g0), or another direction; a surface that \
                 is touched and not crossed, as cos(t) = 1, has no crossings: write sin(t) = 0"
            }
            FlowError::SectionEnds { .. } => {
                "write the surface without roots, logarithms, quotients and high powers: y + 0.7 = 1/4, not sqrt(y + 0.7) = 1/2, and y = x*tan(1), not atan2(y, x) = 1"
            }
            FlowError::NoTangents => "leave out an equation of [level]",
            FlowError::AtRest => "choose another start",
            FlowError::InSurface => "choose another surface, or a start outside of it",
            FlowError::NoEnergy => "leave out --energy",
            FlowError::NoPoint(_) => {
                "choose other values, another energy or direction, or give the whole state"
            }
            FlowError::NoSuchClaim(_) => "give the name of a claim of the case",
            FlowError::OneSided => "follow an orbit by `motion orbit`, or leave out [one-sided]",
            FlowError::OneSidedBackwards => "give a positive --time",
            FlowError::BehindConstraint { .. } => {
                "choose a start where the function is not negative"
            }
            FlowError::TooManyPhases { .. } => "choose a shorter time",
            FlowError::NoPeriodicPoint { .. } => "draw the section, and start nearer to the point",
            FlowError::NoClosedOrbit(_) => {
                "start nearer to the orbit, or give its period by --time or another --period"
            }
            FlowError::NeverCloses => {
                "write a phase in place of t: variables c and s with c' = -w*s, s' = w*c and the level \
                 c^2 + s^2 = 1, for cos(w*t) and sin(w*t)"
            }
            FlowError::NearReturn(..) => {
                "start elsewhere, or follow the orbits over a parameter by `motion continue`: near a \
                 fold two of them meet, and beyond it there is none"
            }
            FlowError::Degenerate(_) => {
                "where a further integral is kept, closed orbits come in families, and have no \
                 multipliers: claim it (integral = \"…\", and of a field its energy too), and if it is \
                 proved its value is held"
            }
            FlowError::Cyclic { .. } => {
                "leave these coordinates out of the system, with the momenta that belong to them as \
                 parameters: closed orbits of what is left are those up to a shift"
            }
            FlowError::NoReversor { .. } => {
                "name another of L=0, l=0, l=π/2, or another section (--g0); `liouville report` lists the reversors of a body"
            }
            FlowError::OutsideRange { .. } => {
                "give it a value within by --set or --energy, or another --from or --to"
            }
            FlowError::EnergyChanges => "vary a parameter: --parameter NAME",
            FlowError::NotHyperbolic { .. } => {
                "`liouville motion periodic` tells what kind a point is; start near a hyperbolic one"
            }
            FlowError::TooLong => "write the field with fewer terms, by [let]",
            FlowError::Stopped | FlowError::StoppedAt { .. } => {
                "follow it again, for a shorter time"
            }
            FlowError::NoStart => {
                "give a start nearer to the level, where the slopes of its equations do not vanish, or \
                 another --seed or --index"
            }
            FlowError::NoValueState { .. } => {
                "give a value between these, or a start at which it is near to the one you want"
            }
            FlowError::Recording(_) => "use operations that hold for every number",
        }
    }
}
