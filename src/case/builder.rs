//! Systems as values: a field of one's own, or a body that rolls without slipping and spinning.

use super::field::level_equation;
use super::parameters::{NO_NAME, origin_of};
use super::shapes::{Given, list, state_draws};
use super::state::State;
use super::value::{Source, Value};
use super::values::stranger;
use super::{Case, ClaimError, build, shadows};
use crate::formula::{Formula, Scope, Symbol, Type, canonical_name, names_in};
use crate::mechanics::{
    Chart, Features, LevelEquation, LevelFunction, Meaning, Model, Origin, Parameter, Potential,
    Quantity, Reach, Rubber, Shape, System, Variable, Vocabulary, of_rubber,
};

/// Kind of system that is built.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Build {
    Field,
    Rubber { curved: bool },
}

/// A part of a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Part {
    Support,
    Contact,
    Mass,
    Inertia,
    Curvature,
    Gyrostat,
    Potential,
}

/// Builder of a [`Case`] without claims: a system with its names, its states and its level set.
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
    rates: Vec<Option<Source>>,
    abbreviations: Vec<Formula>,
    level: Vec<LevelEquation>,
    parts: Vec<(Part, Source)>,
    error: Option<ClaimError>,
}

impl Model {
    /// Begins a vector field of one's own.
    pub fn field() -> ModelBuilder {
        ModelBuilder::new(Build::Field, "field")
    }

    /// Begins a body that rolls on a plane without slipping and spinning, in the variables ω and γ.
    pub fn rubber_plane() -> ModelBuilder {
        ModelBuilder::new(Build::Rubber { curved: false }, "body on a plane")
    }

    /// Begins a body that rolls on a sphere without slipping and spinning, in the variables ω and γ.
    pub fn rubber_sphere() -> ModelBuilder {
        ModelBuilder::new(Build::Rubber { curved: true }, "body on a sphere")
    }
}

impl ModelBuilder {
    fn new(build: Build, title: &str) -> Self {
        let state = State { variables: Vec::new(), draws: Vec::new() };
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
            error: None,
        };
        if let Build::Rubber { .. } = build {
            for (name, reach) in [("ω", Reach::Phase), ("γ", Reach::Configuration)] {
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
    pub fn parameter(self, name: &str, value: impl Into<Value>) -> Self {
        let value = value.into();
        self.attempt(name, |builder, name| builder.add_parameter(name, &value))
    }

    /// Declares a state variable with the range of its values and its rate.
    #[must_use]
    pub fn state(self, name: &str, range: impl Into<Value>, rate: impl Into<Source>) -> Self {
        self.variable(name, range).rate(name, rate)
    }

    /// Declares a state variable with the range of its values; its rate has to follow.
    #[must_use]
    pub fn variable(self, name: &str, range: impl Into<Value>) -> Self {
        let range = range.into();
        self.attempt(name, |builder, name| builder.add_variable(name, &range))
    }

    /// Sets the rate of a state variable.
    #[must_use]
    pub fn rate(self, name: &str, rate: impl Into<Source>) -> Self {
        let rate = rate.into();
        self.attempt(name, |builder, name| {
            let variables = &builder.state.variables;
            let Some(index) = variables.iter().position(|variable| variable.name == name) else {
                return Err(ClaimError::new(name, "it is no state variable", "declare it first"));
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
    pub fn define(self, name: &str, formula: impl Into<Source>) -> Self {
        let formula = formula.into();
        self.attempt(name, |builder, name| {
            builder.check_free(name)?;
            let read = builder.read(name, &formula, None, Reach::Phase)?;
            let entry = builder.vocabulary.reach(&read);
            let reach = entry.map_or(Reach::Parameters, |entry| entry.reach);
            let meaning = Meaning::Abbreviation(builder.abbreviations.len());
            builder.vocabulary.add(name, meaning, read.value_type(), reach);
            builder.abbreviations.push(read);
            Ok(())
        })
    }

    /// Adds an equation of the level set, left = right.
    #[must_use]
    pub fn level(mut self, left: impl Into<Source>, right: impl Into<Source>) -> Self {
        let (left, right) = (left.into(), right.into());
        if self.error.is_none() {
            self.error = self.add_level(&left, &right).err();
        }
        self
    }

    /// Sets the support function h(γ) of a body.
    #[must_use]
    pub fn support(self, support: impl Into<Source>) -> Self {
        self.part(Part::Support, support)
    }

    /// Sets the vector r(γ) from the mass centre of a body to its point of contact.
    #[must_use]
    pub fn contact(self, contact: impl Into<Source>) -> Self {
        self.part(Part::Contact, contact)
    }

    /// Sets the mass of a body, the parameter m otherwise.
    #[must_use]
    pub fn mass(self, mass: impl Into<Source>) -> Self {
        self.part(Part::Mass, mass)
    }

    /// Sets the inertia tensor of a body, the parameter I otherwise.
    #[must_use]
    pub fn inertia(self, inertia: impl Into<Source>) -> Self {
        self.part(Part::Inertia, inertia)
    }

    /// Sets the curvature of the sphere that a body rolls on, the parameter k otherwise.
    #[must_use]
    pub fn curvature(self, curvature: impl Into<Source>) -> Self {
        self.part(Part::Curvature, curvature)
    }

    /// Sets the angular momentum of a rotor in a body.
    #[must_use]
    pub fn gyrostat(self, rotor: impl Into<Source>) -> Self {
        self.part(Part::Gyrostat, rotor)
    }

    /// Sets the potential U(γ) of the forces on a body.
    #[must_use]
    pub fn potential(self, potential: impl Into<Source>) -> Self {
        self.part(Part::Potential, potential)
    }

    /// Reads a formula in the names declared so far.
    ///
    /// # Errors
    /// The formula cannot be read, or something before it was a mistake.
    pub fn formula(&self, text: &str) -> Result<Formula, ClaimError> {
        match &self.error {
            Some(error) => Err(error.clone()),
            None => self.read(text, &Source::from(text), None, Reach::Phase),
        }
    }

    /// Builds the case.
    ///
    /// # Errors
    /// The first mistake in what was declared, or what is missing.
    pub fn build(mut self) -> Result<Case, ClaimError> {
        if let Some(error) = self.error.take() {
            return Err(error);
        }
        let system = match self.build {
            Build::Field => None,
            Build::Rubber { curved } => Some(self.body(curved)?),
        };
        let rates = self.read_rates()?;
        let (system, extension, chart) = match system {
            None => {
                if self.state.variables.is_empty() {
                    let message = "the field has no state variables";
                    return Err(ClaimError::new(&self.title, message, "declare some by `state`"));
                }
                let chart = if self.level.is_empty() { Chart::Free } else { Chart::Equations };
                (System::Field(rates), Vec::new(), chart)
            }
            Some(system) => (system, rates, Chart::Rolling),
        };
        self.name_rates();
        let hidden = shadows::all(&self.vocabulary, Vec::new());
        let warnings = hidden.iter().map(|name| shadows::warning(name));
        let warnings = warnings.chain(shadows::look_alikes(&self.vocabulary)).collect();
        let fixed = self.fixed();
        let model = Model {
            system,
            vocabulary: self.vocabulary,
            parameters: self.parameters,
            state: self.state.variables,
            extension,
            variables: None,
            abbreviations: self.abbreviations,
            level: self.level,
            fixed,
        };
        let mut case = Case {
            title: self.title,
            source: String::new(),
            system: match self.build {
                Build::Field => "field",
                Build::Rubber { curved: false } => "rubber-plane",
                Build::Rubber { curved: true } => "rubber-sphere",
            }
            .to_string(),
            model,
            chart,
            free_draws: self.state.draws,
            claims: Vec::new(),
            motions: Vec::new(),
            absences: Vec::new(),
            column: None,
            section: None,
            one_sided: None,
            notes: Vec::new(),
            warnings,
        };
        build::extend_support(&mut case.model);
        let is_open = |equation: &&LevelEquation| match &equation.function {
            LevelFunction::Formula(function) => case.model.has_antiderivative(function),
            _ => false,
        };
        match case.model.level.iter().find(is_open) {
            None => Ok(case),
            Some(equation) => {
                let message = "a level equation has no ∫ in it: its constant is open";
                Err(ClaimError::new(&equation.text, message, "write the antiderivative out"))
            }
        }
    }

    /// Carries out a step for a canonical name, unless an earlier one failed.
    fn attempt(
        mut self,
        name: &str,
        step: impl FnOnce(&mut Self, &str) -> Result<(), ClaimError>,
    ) -> Self {
        if self.error.is_none() {
            let result = match canonical_name(name) {
                Some(canonical) => step(&mut self, &canonical),
                None => Err(ClaimError::new(name, "this is not a name", NO_NAME)),
            };
            self.error = result.err();
        }
        self
    }

    fn check_free(&self, name: &str) -> Result<(), ClaimError> {
        match self.vocabulary.find(name) {
            None => Ok(()),
            Some(_) => Err(ClaimError::new(name, "it is taken already", "choose another name")),
        }
    }

    fn add_parameter(&mut self, name: &str, value: &Value) -> Result<(), ClaimError> {
        self.check_free(name)?;
        let refuse = |message: String| {
            let remedy = "write a number, a range such as \"0.5..2\", or a formula";
            ClaimError::new(name, message, remedy)
        };
        let (kind, origin) = match value.given(&self.vocabulary).map_err(refuse)? {
            Given::Fixed(kind, values) => (kind, Origin::Fixed(values)),
            Given::Drawn(recipe) => (recipe.kind(), Origin::Free(recipe)),
            Given::List(values) => {
                let (kind, values) = list(values, false);
                (kind, Origin::Fixed(values))
            }
            Given::Formula(text) => {
                let source = match value {
                    Value::Formula(formula) => Source::Formula(formula.clone()),
                    _ => Source::Text(text),
                };
                let read = self.read(name, &source, None, Reach::Parameters)?;
                (read.value_type(), origin_of(read))
            }
        };
        if let Value::Text(text) = value {
            self.sizes.push(text.clone());
        }
        let whole = match (&origin, kind) {
            (Origin::Fixed(values), Type::Scalar) => {
                values.first().and_then(|own| own.to_integer())
            }
            _ => None,
        };
        let meaning = Meaning::Parameter(self.parameters.len());
        self.vocabulary.add(name, meaning, kind, Reach::Parameters);
        if let Some(whole) = whole {
            self.vocabulary.set_whole(name, whole);
        }
        self.parameters.push(Parameter { name: name.to_string(), kind, origin });
        Ok(())
    }

    fn add_variable(&mut self, name: &str, range: &Value) -> Result<(), ClaimError> {
        self.check_free(name)?;
        let remedy = "write \"-2..2\", \"vector(-1..1)\" or \"matrix(2, 2, -1..1)\"";
        let given = range.given(&self.vocabulary);
        let given = given.map_err(|message| ClaimError::new(name, message, remedy))?;
        let Some((kind, draws)) = state_draws(&given) else {
            let message = "a state variable needs the range that its values are drawn from";
            return Err(ClaimError::new(name, message, remedy));
        };
        if let Value::Text(text) = range {
            self.sizes.push(text.clone());
        }
        self.state.add(name, kind, draws, &mut self.vocabulary, Reach::Phase);
        self.rates.push(None);
        Ok(())
    }

    fn add_level(&mut self, left: &Source, right: &Source) -> Result<(), ClaimError> {
        if self.build != Build::Field {
            let message = "the level set of this system is known";
            return Err(ClaimError::new("level", message, "leave the equation out"));
        }
        let scalar = Some(Type::Scalar);
        let left = self.read("the left side", left, scalar, Reach::Phase)?;
        let right = self.read("the right side", right, scalar, Reach::Phase)?;
        let is_zero = right.constant().is_some_and(|value| value.is_zero());
        let function = match is_zero {
            true => left.clone(),
            false => (left.bracketed() - right.bracketed())
                .map_err(|error| ClaimError::new("level", error.to_string(), "compare scalars"))?,
        };
        let text = format!("{left} = {right}");
        self.level.push(level_equation(text, function, Some((left, right))));
        Ok(())
    }

    fn part(mut self, part: Part, source: impl Into<Source>) -> Self {
        if self.error.is_none() {
            let is_body = matches!(self.build, Build::Rubber { .. });
            let is_new = self.parts.iter().all(|(own, _)| *own != part);
            self.error = match (is_body, is_new) {
                (true, true) => None,
                (false, _) => {
                    let message = "a field has no body";
                    Some(ClaimError::new("body", message, "begin with Model::rubber_plane()"))
                }
                (true, false) => {
                    let message = format!("the {part:?} is given twice").to_lowercase();
                    Some(ClaimError::new("body", message, "give each part once"))
                }
            };
            self.parts.push((part, source.into()));
        }
        self
    }

    /// Reads a formula in the names so far, and checks its type and what it depends on.
    fn read(
        &self,
        what: &str,
        source: &Source,
        kind: Option<Type>,
        reach: Reach,
    ) -> Result<Formula, ClaimError> {
        let read = match source {
            Source::Formula(formula) => {
                let own = self.vocabulary.check_own(formula);
                own.map_err(|name| stranger(what, &name))?;
                Ok(formula.clone())
            }
            Source::Text(text) => Formula::parse(text, &self.vocabulary),
            Source::Failed(error) => Err(error.clone()),
        };
        let read = read.map_err(|error| {
            let help = error.help().unwrap_or("declare the names that it uses before");
            ClaimError::new(what, error.message(), help)
        })?;
        if let Some(kind) = kind.filter(|kind| *kind != read.value_type()) {
            let message = format!("`{read}` is a {}", read.value_type());
            return Err(ClaimError::new(what, message, &format!("give a {kind}")));
        }
        match self.vocabulary.reach(&read) {
            Some(entry) if entry.reach > reach => {
                let message = format!("`{}` changes along the motion", entry.name);
                let remedy = match reach {
                    Reach::Parameters => "use parameters alone",
                    _ => "use γ and parameters",
                };
                Err(ClaimError::new(what, message, remedy))
            }
            _ => Ok(read),
        }
    }

    fn read_rates(&self) -> Result<Vec<Formula>, ClaimError> {
        let variables = self.state.variables.iter().zip(&self.rates).skip(self.own);
        let read = |(variable, rate): (&Variable, &Option<Source>)| {
            let what = format!("{}'", variable.name);
            match rate {
                Some(rate) => self.read(&what, rate, Some(variable.kind), Reach::Phase),
                None => Err(ClaimError::new(&what, "the rate is missing", "give it by `rate`")),
            }
        };
        variables.map(read).collect()
    }

    /// Gives the rate of each state variable a name, unless the name is taken.
    fn name_rates(&mut self) {
        for (index, variable) in self.state.variables.iter().enumerate() {
            let name = format!("{}'", variable.name);
            if self.vocabulary.find(&name).is_none() {
                let meaning = Meaning::Quantity(Quantity::Rate(index));
                self.vocabulary.add(&name, meaning, variable.kind, Reach::Phase);
            }
        }
    }

    /// Symbols of whole numbers that sizes contain.
    fn fixed(&self) -> Vec<Symbol> {
        let names = self.sizes.iter().flat_map(|text| names_in(text));
        let whole = |name: String| {
            let is_whole = self.vocabulary.find(&name)?.whole.is_some();
            self.vocabulary.lookup(&name).filter(|_| is_whole).map(|(symbol, _)| symbol)
        };
        names.filter_map(whole).collect()
    }

    fn source(&self, part: Part) -> Option<&Source> {
        self.parts.iter().find(|(own, _)| *own == part).map(|(_, source)| source)
    }

    /// Reads a constant of the body, or the parameter that stands for it.
    fn constant(&self, part: Part, name: &str, kind: Type) -> Result<Formula, ClaimError> {
        let default = Source::from(name);
        let source = self.source(part).unwrap_or(&default);
        self.read(name, source, Some(kind), Reach::Parameters)
    }

    fn body(&mut self, curved: bool) -> Result<System, ClaimError> {
        let mass = self.constant(Part::Mass, "m", Type::Scalar)?;
        let inertia = self.constant(Part::Inertia, "I", Type::MATRIX)?;
        let curvature =
            curved.then(|| self.constant(Part::Curvature, "k", Type::Scalar)).transpose()?;
        let rotor = self.source(Part::Gyrostat);
        let gyrostat = rotor
            .map(|rotor| self.read("gyrostat", rotor, Some(Type::VECTOR), Reach::Parameters))
            .transpose()?;
        let shape = self.shape()?;
        let has = |name: &str, kind: Type| {
            self.vocabulary.lookup(name).is_some_and(|(_, found)| found == kind)
        };
        let features = Features {
            radius: has("R", Type::Scalar),
            displacement: has("c", Type::VECTOR),
            curvature: curved,
            potential: self.source(Part::Potential).is_some(),
            profile: false,
        };
        let quantities = of_rubber(features);
        // the potential may use h, and not itself
        let is_potential = |quantity: &Quantity| *quantity == Quantity::Potential;
        let (own, others): (Vec<_>, Vec<_>) =
            quantities.into_iter().partition(|(_, quantity, _, _)| is_potential(quantity));
        self.name_quantities(others);
        let given = self.source(Part::Potential);
        let potential = given
            .map(|given| self.read("U", given, Some(Type::Scalar), Reach::Configuration))
            .transpose()?;
        self.name_quantities(own);
        self.level = vec![
            LevelEquation {
                text: "|γ| = 1".to_string(),
                function: LevelFunction::UnitNormal,
                root: None,
            },
            LevelEquation {
                text: "(ω,γ) = 0".to_string(),
                function: LevelFunction::NoSpin,
                root: None,
            },
        ];
        Ok(System::Rubber(Box::new(Rubber {
            mass,
            inertia,
            shape,
            curvature,
            gyrostat,
            potential: potential.map(Potential::Formula),
            moment: None,
        })))
    }

    fn name_quantities(&mut self, quantities: Vec<(&'static str, Quantity, Type, Reach)>) {
        for (name, quantity, kind, reach) in quantities {
            if self.vocabulary.find(name).is_none() {
                self.vocabulary.add(name, Meaning::Quantity(quantity), kind, reach);
            }
        }
    }

    fn shape(&self) -> Result<Shape, ClaimError> {
        let reach = Reach::Configuration;
        let (scalar, vector) = (Some(Type::Scalar), Some(Type::VECTOR));
        let given = [Part::Support, Part::Contact];
        let mut given = given.into_iter().filter_map(|part| Some((part, self.source(part)?)));
        match (given.next(), given.next()) {
            (Some((Part::Support, source)), None) => {
                self.read("support", source, scalar, reach).map(Shape::Support)
            }
            (Some((_, source)), None) => {
                self.read("contact", source, vector, reach).map(Shape::Contact)
            }
            (None, _) => {
                let remedy = "give `support` or `contact`";
                Err(ClaimError::new("body", "the body has no shape", remedy))
            }
            (Some(_), Some(_)) => {
                Err(ClaimError::new("body", "the body has two shapes", "give one of them"))
            }
        }
    }
}
