//! Mechanical systems, each written once over any [`crate::scalar::Scalar`].

mod across;
mod ball;
mod ball_surface;
mod body;
pub mod calculus;
mod chart;
mod configuration;
mod draws;
mod dynamics;
mod flat_base;
mod hamiltonian;
pub mod iterate;
mod lagrangian;
mod linear;
mod memo;
mod model;
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
mod variables;
mod vocabulary;

pub use ball::BallOnSurface;
pub use ball_surface::Surface;
pub use body::{Polynomial, Shape};
pub use chart::{Chart, GivenChart};
pub use configuration::Configuration;
pub use draws::Draws;
pub use flat_base::FlatBase;
pub use hamiltonian::Hamiltonian;
pub use lagrangian::{Algebra, Lagrangian, Role};
pub use model::{
    LevelEquation, LevelFunction, Model, Origin, Parameter, RootEquation, Variable, components,
};
pub use parts::Part;
pub use phase::Phase;
pub use quantity::{
    BallSurface, Features, Quantity, of_ball, of_flat_base, of_hamiltonian, of_lagrangian,
    of_rubber, of_spinning,
};
pub use recipe::{Draw, Line, Range, Recipe};
pub use rigid::RigidBody;
pub use rubber::{NORMAL, OMEGA, Potential, Rubber};
pub use spinning::Spinning;
pub use system::System;
pub use variables::{Block, Poisson, Variables};
pub use vocabulary::{Entry, Meaning, Reach, Vocabulary};

pub use across::AcrossNormal;
pub use body::contact_of;
pub use chart::rolling_point;
pub use linear::point_mass;
pub use rolling::{Motion, Pose};
