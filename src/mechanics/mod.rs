//! Mechanical systems, each written once over any [`crate::scalar::Scalar`].

mod across;
mod ball;
mod ball_surface;
mod blocks;
mod body;
pub mod calculus;
mod chart;
mod configuration;
mod draws;
mod dynamics;
pub mod elimination;
mod flat_base;
mod hamiltonian;
pub mod iterate;
mod lagrangian;
mod level_equation;
mod linear;
mod listed;
mod literal;
mod memo;
mod model;
mod model_formulas;
mod motion_bracket;
mod parts;
mod phase;
mod quantity;
mod recipe;
mod rigid;
mod rigid_names;
mod rolling;
mod rubber;
mod rubber_measure;
mod shortcuts;
mod spinning;
mod streams;
mod system;
mod ties;
pub(crate) mod vanishing;
mod variables;
mod vocabulary;

pub use ball::BallOnSurface;
pub use ball_surface::Surface;
pub use body::{Shape, SurfacePolynomial};
pub use chart::{Chart, GivenChart};
pub use configuration::Configuration;
pub use draws::DrawSource;
pub use flat_base::FlatBase;
pub use hamiltonian::HamiltonianSystem;
pub use lagrangian::{
    AccelerationSolver, Algebra, EquationTerms, Lagrangian, LagrangianEquations, VariableRole,
};
pub use level_equation::{
    ENTRY, Half, LevelEquation, LevelFunction, Orientation, RootEquation, written,
};
pub use listed::{ListedValues, combinations};
pub use model::{MatrixShape, Model, Parameter, ParameterOrigin, TIME, Variable, components};
pub use motion_bracket::{MotionBracket, size_of_variables};
pub use parts::EquationPart;
pub use phase::Phase;
pub use quantity::{
    BallSurface, Features, Quantity, of_ball, of_flat_base, of_hamiltonian, of_lagrangian,
    of_rubber, of_spinning,
};
pub use recipe::{Draw, NumberLine, Range, SamplerSpec};
pub use rigid::RigidBody;
pub use rubber::{NORMAL, OMEGA, Potential, Rubber};
pub use spinning::Spinning;
pub(crate) use streams::Streams;
pub use system::System;
pub use ties::{StiffEntry, TiedEntry};
pub use variables::{BracketBlock, NewVariables, Poisson};
pub use vocabulary::{Dependence, Meaning, Vocabulary, VocabularyEntry};

pub use across::AcrossNormal;
pub use body::contact_of;
pub use chart::rolling_point;
pub use linear::point_mass;
pub use rolling::{Pose, RollingTerms};
