//! `system = "…"`: which equations of motion, with their names, states and level sets.

use toml::de::DeTable;

use super::arbitrary::Arbitrary;
use super::error::{CaseError, Problem};
use super::field::{self, State};
use super::parameters::Setting;
use super::section::{Section, Text};
use super::{ball, body, lagrangian, shadows};
use crate::formula::{Formula, Type, canonical_name};
use crate::mechanics::{
    Chart, Draw, Entry, LevelEquation, LevelFunction, Line, Meaning, Model, Parameter, Potential,
    Quantity, Range, Reach, Shape, Surface, System, Variable, Vocabulary, of_ball, of_flat_base,
    of_lagrangian, of_rubber,
};

const SYSTEMS: &str =
    "rubber-plane, rubber-sphere, flat-base, ball-on-surface, nonholonomic, vakonomic or field";

/// A model with the way its states are made.
pub struct Parts {
    /// The model.
    pub model: Model,
    /// How its states are made.
    pub chart: Chart,
    /// The draws of what the chart leaves free.
    pub free_draws: Vec<Draw>,
    /// Names that the file takes from the system or the language.
    pub hidden: Vec<String>,
}

/// What is read on the way to a model.
pub(super) struct Reading<'r, 's> {
    pub root: &'r Section<'s>,
    arbitrary: Arbitrary<'r>,
    pub vocabulary: Vocabulary,
    pub parameters: Vec<Parameter>,
    pub state: State,
    pub abbreviations: Vec<Formula>,
    /// Abbreviations that use rates, which are known in the end only.
    pub waiting: Vec<String>,
    pub level: Vec<LevelEquation>,
    pub extension: Vec<Formula>,
    /// Names of the system that the file gives another meaning.
    pub hidden: Vec<String>,
}

/// Reads what the kind of system asks for; gives its name too.
pub fn read(
    root: &Section<'_>,
    vocabulary: Vocabulary,
    parameters: Vec<Parameter>,
    settings: &[Setting],
) -> Result<(String, Parts), CaseError> {
    let text = match (root.text("system")?, root.section("field")?) {
        (Some(text), _) => text,
        (None, Some(_)) => Text::made("field".to_string(), 0..0),
        (None, None) => {
            let remedy = format!("add system = \"…\" with {SYSTEMS}");
            return Err(root.missing("system", &remedy));
        }
    };
    let mut reading = Reading {
        root,
        arbitrary: Arbitrary::of(root, settings)?,
        vocabulary,
        parameters,
        state: State { variables: Vec::new(), draws: Vec::new() },
        abbreviations: Vec::new(),
        waiting: Vec::new(),
        level: Vec::new(),
        extension: Vec::new(),
        hidden: Vec::new(),
    };
    let (system, chart) = match text.value.as_str() {
        "rubber-plane" => reading.rubber(&text, false)?,
        "rubber-sphere" => reading.rubber(&text, true)?,
        "flat-base" => reading.flat_base(&text)?,
        "ball-on-surface" => reading.ball(&text)?,
        "nonholonomic" => reading.lagrangian(false)?,
        "vakonomic" => reading.lagrangian(true)?,
        "field" => reading.field()?,
        found => {
            let (message, remedy) = (format!("`{found}` is no system"), format!("write {SYSTEMS}"));
            return Err(CaseError::at(text.span, Problem::Other { message, remedy }));
        }
    };
    reading.name_rates();
    reading.read_waiting()?;
    let hidden = shadows::all(&reading.vocabulary, reading.hidden);
    let model = Model {
        system,
        vocabulary: reading.vocabulary,
        parameters: reading.parameters,
        state: reading.state.variables,
        extension: reading.extension,
        variables: None,
        abbreviations: reading.abbreviations,
        level: reading.level,
    };
    Ok((text.value, Parts { model, chart, free_draws: reading.state.draws, hidden }))
}

fn equation(text: &str, function: LevelFunction) -> LevelEquation {
    LevelEquation { text: text.to_string(), function }
}

impl Reading<'_, '_> {
    fn rubber(&mut self, name: &Text, curved: bool) -> Result<(System, Chart), CaseError> {
        let nothing = DeTable::new();
        let section = self.root.section("body")?.unwrap_or(self.root.empty("[body]", &nothing));
        let features = body::features(&section, curved, &self.vocabulary);
        let own = [("ω", Type::VECTOR), ("γ", Type::VECTOR)];
        self.declare(&own, &[], of_rubber(features), name)?;
        self.further_state()?;
        self.read_abbreviations()?;
        let (names, arbitrary) = (&self.vocabulary, self.arbitrary);
        let system = body::rubber(&section, curved, &arbitrary, names, &mut self.parameters)?;
        self.no_feedback(&section, &system)?;
        section.finish()?;
        self.further_rates(own.len())?;
        self.level = vec![
            equation("|γ| = 1", LevelFunction::UnitNormal),
            equation("(ω,γ) = 0", LevelFunction::NoSpin),
        ];
        Ok((system, Chart::Rolling))
    }

    fn flat_base(&mut self, name: &Text) -> Result<(System, Chart), CaseError> {
        let nothing = DeTable::new();
        let section = self.root.section("body")?.unwrap_or(self.root.empty("[body]", &nothing));
        let near = Draw::Of(Line::All, Range::between((-3, 2), (3, 2)));
        let own = ["ω1", "ω2", "r1", "r2"].map(|name| (name, Type::Scalar));
        self.declare(
            &own,
            &[near.clone(), near.clone(), near.clone(), near],
            of_flat_base(),
            name,
        )?;
        self.further_state()?;
        self.read_abbreviations()?;
        let system = body::flat_base(&section, &self.vocabulary)?;
        section.finish()?;
        self.further_rates(own.len())?;
        Ok((system, Chart::Free))
    }

    fn ball(&mut self, name: &Text) -> Result<(System, Chart), CaseError> {
        let nothing = DeTable::new();
        let section = self.root.section("body")?.unwrap_or(self.root.empty("[body]", &nothing));
        let by_support = section.value("surface").is_none();
        let second = if by_support { "γ" } else { "r" };
        let own = [("M", Type::VECTOR), (second, Type::VECTOR)];
        let near = Draw::Of(Line::All, Range::between((-2, 1), (2, 1)));
        let draws = if by_support { Vec::new() } else { vec![near; 6] };
        self.declare(&own, &draws, of_ball(by_support), name)?;
        if section.value("potential").is_some() {
            let (meaning, reach) = (Meaning::Quantity(Quantity::Potential), Reach::Phase);
            self.vocabulary.add("U", meaning, Type::Scalar, reach);
        }
        self.further_state()?;
        self.read_abbreviations()?;
        let arbitrary = self.arbitrary;
        let system = ball::read(&section, &arbitrary, &mut self.vocabulary, &mut self.parameters)?;
        self.no_feedback(&section, &system)?;
        section.finish()?;
        self.further_rates(own.len())?;
        if by_support {
            self.level = vec![equation("|γ| = 1", LevelFunction::UnitNormal)];
        }
        Ok((system, if by_support { Chart::Sphere } else { Chart::Free }))
    }

    fn lagrangian(&mut self, vakonomic: bool) -> Result<(System, Chart), CaseError> {
        let ranges = self.root.section("state")?.ok_or_else(|| {
            let remedy =
                "add a table [state] with q = \"-2..2\", \"q'\" = \"-2..2\" for each variable";
            self.root.missing("state", remedy)
        })?;
        self.state = field::state(&ranges, &mut self.vocabulary, Reach::Configuration)?;
        let section = self.root.section("lagrangian")?.ok_or_else(|| {
            self.root.missing("lagrangian", "add a table [lagrangian] with kinetic = \"…\"")
        })?;
        let constraints = section.texts("constraints")?.len();
        for (name, quantity, kind, reach) in of_lagrangian(constraints) {
            self.name(&name, quantity, kind, reach);
        }
        self.read_abbreviations()?;
        let system = lagrangian::read(self, &section, vakonomic)?;
        section.finish()?;
        if let Some(section) = self.root.section("level")? {
            self.level.extend(field::equations(&section, &self.vocabulary)?);
        }
        Ok((system, Chart::Free))
    }

    fn field(&mut self) -> Result<(System, Chart), CaseError> {
        let section = self.root.section("field")?.ok_or_else(|| {
            let remedy = "add a table [field] with \"x'\" = \"…\" for each variable";
            self.root.missing("field", remedy)
        })?;
        let ranges = self.root.section("state")?.ok_or_else(|| {
            let remedy = "add a table [state] with x = \"-2..2\" for each variable";
            self.root.missing("state", remedy)
        })?;
        self.state = field::state(&ranges, &mut self.vocabulary, Reach::Phase)?;
        self.read_abbreviations()?;
        let rates = field::rates(&section, &self.state.variables, &self.vocabulary)?;
        if let Some(section) = self.root.section("level")? {
            self.level = field::equations(&section, &self.vocabulary)?;
        }
        Ok((System::Field(rates), Chart::Free))
    }

    /// Adds the system's own state and quantities; a parameter may hide a quantity, not a variable.
    fn declare(
        &mut self,
        own: &[(&str, Type)],
        draws: &[Draw],
        quantities: Vec<(&'static str, Quantity, Type, Reach)>,
        system: &Text,
    ) -> Result<(), CaseError> {
        let given = self.root.section("parameters")?;
        let place = |name: &str| {
            let entries = given.as_ref().map(Section::entries).unwrap_or_default();
            let named = |(key, _): &(&toml::Spanned<std::borrow::Cow<'_, str>>, _)| {
                canonical_name(key.get_ref()).as_deref() == Some(name)
            };
            entries.iter().find(|entry| named(entry)).map(|(key, _)| key.span())
        };
        for (index, (name, kind)) in own.iter().enumerate() {
            if self.vocabulary.find(name).is_some() {
                let reason = format!("it is a state variable of {}", system.value);
                let problem = Problem::BadName { name: name.to_string(), reason };
                return Err(CaseError { problem, span: place(name) });
            }
            let position = matches!(*name, "γ" | "r");
            let reach = if position { Reach::Configuration } else { Reach::Phase };
            self.vocabulary.add(name, Meaning::State(index), *kind, reach);
            self.state.variables.push(Variable { name: name.to_string(), kind: *kind });
        }
        self.state.draws.extend(draws.iter().cloned());
        for (name, quantity, kind, reach) in quantities {
            self.name(name, quantity, kind, reach);
        }
        self.name_rates();
        Ok(())
    }

    /// Names a quantity, unless the file gave the name another meaning.
    fn name(&mut self, name: &str, quantity: Quantity, kind: Type, reach: Reach) {
        match self.vocabulary.find(name).map(|entry| entry.meaning) {
            None => self.vocabulary.add(name, Meaning::Quantity(quantity), kind, reach),
            // x' is the velocity of x where both are declared.
            Some(Meaning::State(_) | Meaning::Quantity(_)) => {}
            Some(_) if self.hidden.iter().any(|hidden| hidden == name) => {}
            Some(_) => self.hidden.push(name.to_string()),
        }
    }

    /// The variables that `[state]` adds to a built-in system.
    fn further_state(&mut self) -> Result<(), CaseError> {
        let Some(section) = self.root.section("state")? else { return Ok(()) };
        let first = self.state.variables.len();
        field::add_state(&section, &mut self.vocabulary, Reach::Phase, &mut self.state)?;
        for variable in &self.state.variables[first..] {
            let remedy = format!("add \"{}'\" = \"…\" under [field]", variable.name);
            if self.root.section("field")?.is_none() {
                return Err(self.root.missing("field", &remedy));
            }
        }
        Ok(())
    }

    /// Their rates.
    fn further_rates(&mut self, own: usize) -> Result<(), CaseError> {
        let Some(section) = self.root.section("field")? else { return Ok(()) };
        let further = &self.state.variables[own..];
        self.extension = field::rates(&section, further, &self.vocabulary)?;
        Ok(())
    }

    /// What defines a body may not depend on what it determines: the potential on U, the surface on
    /// h, a moment of forces on the acceleration.
    fn no_feedback(&self, section: &Section<'_>, system: &System) -> Result<(), CaseError> {
        use Quantity::{AngularAcceleration, Multiplier, Potential as OwnPotential, Support};
        let of_shape = |shape: &Shape| match shape {
            Shape::Support(formula) | Shape::SupportOnSphere(formula) => {
                Some(("support", formula.clone()))
            }
            Shape::Profile(formula) => Some(("profile", formula.clone())),
            Shape::Contact(formula) => Some(("contact", formula.clone())),
            Shape::Arbitrary(_) | Shape::ArbitraryProfile(_) => None,
        };
        let (shape, moment) = match system {
            System::Rubber(body) => (of_shape(&body.shape), body.moment.clone()),
            System::Ball(ball) => match &ball.surface {
                Surface::Support(shape) => (of_shape(shape), None),
                Surface::Level(_) => (None, None),
            },
            _ => (None, None),
        };
        let potential = match system {
            System::Rubber(body) => body.potential.clone(),
            _ => None,
        };
        let potential = match potential {
            Some(Potential::Formula(formula)) => Some(("potential", formula)),
            _ => None,
        };
        let given = [
            (shape, &[Support, OwnPotential][..], "write it by γ and the parameters"),
            (potential, &[OwnPotential], "write it by γ, h and the parameters"),
            (
                moment.map(|moment| ("moment", moment)),
                &[AngularAcceleration, Multiplier],
                "write it by the state, r, r' and γ'",
            ),
        ];
        for (formula, determined, remedy) in given {
            let Some((key, formula)) = formula else { continue };
            let is_determined = |entry: &&Entry| match entry.meaning {
                Meaning::Quantity(quantity) => determined.contains(&quantity),
                _ => false,
            };
            let uses = self.vocabulary.uses(&formula, &self.abbreviations);
            if let Some(entry) = uses.into_iter().find(is_determined) {
                let message = format!("`{key}` depends on `{}`, which it determines", entry.name);
                let problem = Problem::Other { message, remedy: remedy.to_string() };
                let place = section.text(key)?.map_or(section.span.clone(), |text| text.span);
                return Err(CaseError::at(place, problem));
            }
        }
        Ok(())
    }

    /// Gives the rate of each state variable a name, unless the name is taken.
    fn name_rates(&mut self) {
        for (index, variable) in self.state.variables.clone().iter().enumerate() {
            let name = format!("{}'", variable.name);
            self.name(&name, Quantity::Rate(index), variable.kind, Reach::Phase);
        }
    }
}
