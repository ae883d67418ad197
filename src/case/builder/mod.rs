//! Systems as values: a field or a map of one's own, or a body that rolls without slipping and spinning.

mod chart;
mod declare;
mod finish;

use super::ClaimError;
use super::state::State;
use super::value::{FormulaSource, ValueSpec};
use crate::formula::{Formula, Type};
use crate::mechanics::{Dependence, LevelEquation, Model, Parameter, Vocabulary};

/// Kind of system that is built.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Build {
    Field,
    Map,
    Rolling { spins: bool, curved: bool },
}

/// A part of a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum BodyPart {
    Support,
    Contact,
    Mass,
    Inertia,
    Curvature,
    Gyrostat,
    Potential,
}

/// Builder of a [`Case`](super::Case) without claims: a system with its names, its states and its level set.
///
/// Names are declared before they are used. The first mistake is returned by
/// [`formula`](ModelBuilder::formula) and [`build`](ModelBuilder::build).
///
/// ```
/// use liouville::prelude::*;
///
/// let ball = Model::rubber_plane()
///     .parameter("m", "0.5..2")
///     .parameter("R", "1..3")
///     .parameter("I", "inertia(0.5..5)")
///     .support("R*|γ|")
///     .build()?;
/// let momentum = ball.formula("|J*ω × γ|²")?;
/// let report = ball.judge(&[Claim::integral(momentum)], &Options::default())?;
/// assert_eq!(report.claims[0].verdict, Verdict::Proved);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct ModelBuilder {
    build: Build,
    title: String,
    vocabulary: Vocabulary,
    parameters: Vec<Parameter>,
    /// Texts that may contain sizes.
    sizes: Vec<String>,
    state: State,
    /// Number of variables that the system has itself.
    own: usize,
    rates: Vec<Option<FormulaSource>>,
    abbreviations: Vec<Formula>,
    level: Vec<LevelEquation>,
    parts: Vec<(BodyPart, FormulaSource)>,
    chart: Option<chart::ChartSource>,
    error: Option<ClaimError>,
}

impl Model {
    /// Begins a vector field of one's own.
    pub fn field() -> ModelBuilder {
        ModelBuilder::new(Build::Field, "field")
    }

    /// Begins a map of one's own, in which the formula of a variable is its image.
    ///
    /// ```
    /// use liouville::prelude::*;
    ///
    /// let map = Model::map().parameter("a", "1..2").state("x", "1..2", "y/a").state("y", "1..2", "a*x").build()?;
    /// let report = map.judge(&[Claim::integral(map.formula("x*y")?)], &Options::default())?;
    /// assert_eq!(report.claims[0].verdict, Verdict::Proved);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn map() -> ModelBuilder {
        ModelBuilder::new(Build::Map, "map")
    }

    /// Begins a body that rolls on a plane without slipping and spinning, in the variables ω and γ.
    pub fn rubber_plane() -> ModelBuilder {
        ModelBuilder::new(Build::Rolling { spins: false, curved: false }, "body on a plane")
    }

    /// Begins a body that rolls on a sphere without slipping and spinning, in the variables ω and γ.
    pub fn rubber_sphere() -> ModelBuilder {
        ModelBuilder::new(Build::Rolling { spins: false, curved: true }, "body on a sphere")
    }

    /// Begins a body that rolls on a plane without slipping and may spin, in the variables ω and γ.
    pub fn rolling_plane() -> ModelBuilder {
        ModelBuilder::new(Build::Rolling { spins: true, curved: false }, "body on a plane")
    }

    /// Begins a body that rolls on a sphere without slipping and may spin, in the variables ω and γ.
    pub fn rolling_sphere() -> ModelBuilder {
        ModelBuilder::new(Build::Rolling { spins: true, curved: true }, "body on a sphere")
    }
}

impl ModelBuilder {
    fn new(build: Build, title: &str) -> Self {
        let state = State { variables: Vec::new(), draws: Vec::new(), rotations: None };
        let mut builder = Self {
            build,
            title: title.to_string(),
            vocabulary: Vocabulary::default(),
            parameters: Vec::new(),
            sizes: Vec::new(),
            state,
            own: 0,
            rates: Vec::new(),
            abbreviations: Vec::new(),
            level: Vec::new(),
            parts: Vec::new(),
            chart: None,
            error: None,
        };
        if let Build::Rolling { .. } = build {
            for (name, reach) in [("ω", Dependence::Phase), ("γ", Dependence::Configuration)] {
                let (names, kind) = (&mut builder.vocabulary, Type::VECTOR);
                builder.state.add(name, kind, Vec::new(), names, reach);
                builder.rates.push(None);
            }
            builder.own = 2;
        }
        builder
    }

    /// Sets the title.
    #[must_use]
    pub fn title(mut self, title: impl Into<String>) -> Self {
        self.title = title.into();
        self
    }

    /// Declares a parameter. One with a range is free, and a proof covers all its values.
    #[must_use]
    pub fn parameter(self, name: &str, value: impl Into<ValueSpec>) -> Self {
        let value = value.into();
        self.attempt(name, |builder, name| builder.add_parameter(name, &value))
    }

    /// Declares a state variable with the range of its values and its rate, or its image under a map.
    #[must_use]
    pub fn state(
        self,
        name: &str,
        range: impl Into<ValueSpec>,
        rate: impl Into<FormulaSource>,
    ) -> Self {
        self.variable(name, range).rate(name, rate)
    }

    /// Declares a state variable with the range of its values; its rate has to follow.
    #[must_use]
    pub fn variable(self, name: &str, range: impl Into<ValueSpec>) -> Self {
        let range = range.into();
        self.attempt(name, |builder, name| builder.add_variable(name, &range))
    }

    /// Sets the rate of a state variable, or its image under a map.
    #[must_use]
    pub fn rate(self, name: &str, rate: impl Into<FormulaSource>) -> Self {
        let rate = rate.into();
        self.attempt(name, |builder, name| {
            let variables = &builder.state.variables;
            let Some(index) = variables.iter().position(|variable| variable.name == name) else {
                return Err(ClaimError::new(
                    name,
                    "it is not a state variable",
                    "declare it first",
                ));
            };
            if index < builder.own || builder.rates[index].is_some() {
                let message = "its rate is given already";
                return Err(ClaimError::new(name, message, "give each rate once"));
            }
            builder.rates[index] = Some(rate);
            Ok(())
        })
    }

    /// Defines a name for a formula of the names before it.
    #[must_use]
    pub fn define(self, name: &str, formula: impl Into<FormulaSource>) -> Self {
        let formula = formula.into();
        self.attempt(name, |builder, name| {
            builder.check_free(name)?;
            let read = builder.read(name, &formula, None, Dependence::Phase)?;
            let entry = builder.vocabulary.reach(&read);
            let reach = entry.map_or(Dependence::Parameters, |entry| entry.reach);
            builder.vocabulary.define(name, builder.abbreviations.len(), &read, reach);
            builder.abbreviations.push(read);
            Ok(())
        })
    }

    /// Adds an equation of the level set, left = right.
    #[must_use]
    pub fn level(
        mut self,
        left: impl Into<FormulaSource>,
        right: impl Into<FormulaSource>,
    ) -> Self {
        let (left, right) = (left.into(), right.into());
        if self.error.is_none() {
            self.error = self.add_level(&left, &right).err();
        }
        self
    }

    /// Sets the support function h(γ) of a body.
    #[must_use]
    pub fn support(self, support: impl Into<FormulaSource>) -> Self {
        self.part(BodyPart::Support, support)
    }

    /// Sets the vector r(γ) from the mass centre of a body to its point of contact.
    #[must_use]
    pub fn contact(self, contact: impl Into<FormulaSource>) -> Self {
        self.part(BodyPart::Contact, contact)
    }

    /// Sets the mass of a body, the parameter m otherwise.
    #[must_use]
    pub fn mass(self, mass: impl Into<FormulaSource>) -> Self {
        self.part(BodyPart::Mass, mass)
    }

    /// Sets the inertia tensor of a body, the parameter I otherwise.
    #[must_use]
    pub fn inertia(self, inertia: impl Into<FormulaSource>) -> Self {
        self.part(BodyPart::Inertia, inertia)
    }

    /// Sets the curvature of the sphere that a body rolls on, the parameter k otherwise.
    #[must_use]
    pub fn curvature(self, curvature: impl Into<FormulaSource>) -> Self {
        self.part(BodyPart::Curvature, curvature)
    }

    /// Sets the angular momentum of a rotor in a body.
    #[must_use]
    pub fn gyrostat(self, rotor: impl Into<FormulaSource>) -> Self {
        self.part(BodyPart::Gyrostat, rotor)
    }

    /// Sets the potential U(γ) of the forces on a body.
    #[must_use]
    pub fn potential(self, potential: impl Into<FormulaSource>) -> Self {
        self.part(BodyPart::Potential, potential)
    }

    /// Reads a formula in the names declared so far.
    ///
    /// # Errors
    /// The formula cannot be read, or something before it was a mistake.
    pub fn formula(&self, text: &str) -> Result<Formula, ClaimError> {
        match &self.error {
            Some(error) => Err(error.clone()),
            None => self.read(text, &FormulaSource::from(text), None, Dependence::Phase),
        }
    }
}
