//! The key `system`: equations of motion with their names, states and level sets.

use toml::de::{DeTable, DeValue};

use super::arbitrary::Arbitrary;
use super::build::Assumed;
use super::error::{Mistake, Problem};
use super::field;
use super::mistakes::Mistakes;
use super::order::{Item, Stage};
use super::parameters::Setting;
use super::section::{Section, Text};
use super::state::{self, State, TIME};
use super::{ball, body, feedback, hamiltonian, lagrangian, map, shadows};
use crate::formula::{Formula, Scope, Symbol, Type, canonical_name, names_in};
use crate::mechanics::{
    Chart, Draw, LevelEquation, LevelFunction, Line, Meaning, Model, Parameter, Quantity, Range,
    Reach, System, Variable, Vocabulary, of_ball, of_flat_base, of_lagrangian, of_rubber,
    of_spinning,
};

/// Reads the tables of a system after the parameters; the text is its name.
type Reader = for<'a, 'r, 's> fn(&'a mut Reading<'r, 's>, &Text) -> Read;

/// The systems by name, in the order of messages.
const SYSTEMS: [(&str, Reader); 10] = [
    ("rubber-plane", |reading, name| {
        reading.rolling(name, Rolling { spins: false, curved: false })
    }),
    ("rubber-sphere", |reading, name| {
        reading.rolling(name, Rolling { spins: false, curved: true })
    }),
    ("rolling-plane", |reading, name| {
        reading.rolling(name, Rolling { spins: true, curved: false })
    }),
    ("rolling-sphere", |reading, name| {
        reading.rolling(name, Rolling { spins: true, curved: true })
    }),
    ("flat-base", |reading, name| reading.flat_base(name)),
    ("ball-on-surface", |reading, name| reading.ball(name)),
    ("nonholonomic", |reading, _| reading.lagrangian(false)),
    ("vakonomic", |reading, _| reading.lagrangian(true)),
    ("field", |reading, _| reading.field()),
    ("map", |reading, _| map::system(reading)),
];

/// The way in which a body of any shape rolls.
#[derive(Clone, Copy)]
pub(super) struct Rolling {
    /// Whether it may spin about the normal.
    pub spins: bool,
    /// Whether it rolls on a sphere, with a curvature.
    pub curved: bool,
}

/// Lists the names of all systems.
fn names() -> String {
    let [others @ .., (last, _)] = &SYSTEMS;
    let others: Vec<&str> = others.iter().map(|(name, _)| *name).collect();
    format!("{} or {last}", others.join(", "))
}

/// A model with its chart and draws.
pub struct Parts {
    /// The model.
    pub model: Model,
    /// Chart that makes states.
    pub chart: Chart,
    /// Draws of the components that the chart leaves free.
    pub free_draws: Vec<Draw>,
    /// Names of the system or the language that the file redefines.
    pub hidden: Vec<String>,
    /// Warnings about names that look alike.
    pub alike: Vec<String>,
    /// Whether everything was read; otherwise the equations of motion are meaningless.
    pub is_whole: bool,
}

/// State of reading a model.
pub(super) struct Reading<'r, 's> {
    pub root: &'r Section<'s>,
    pub settings: &'r [Setting],
    pub assumed: &'r Assumed,
    arbitrary: Arbitrary<'r>,
    pub vocabulary: Vocabulary,
    pub parameters: Vec<Parameter>,
    /// Parameters that are lists: vectors, or diagonal matrices.
    pub lists: Vec<String>,
    /// Texts of parameters that are drawn, which may contain sizes.
    pub sizes: Vec<String>,
    pub state: State,
    /// Names of `[parameters]` and `[let]`, whether read or pending.
    pub items: Vec<Item<'s>>,
    pub abbreviations: Vec<Formula>,
    pub level: Vec<LevelEquation>,
    pub extension: Vec<Formula>,
    /// Names of the system that the file redefines.
    pub hidden: Vec<String>,
}

fn equation(text: &str, function: LevelFunction) -> LevelEquation {
    LevelEquation { text: text.to_string(), function, root: None }
}

type Read = Option<(System, Chart)>;

impl<'r, 's> Reading<'r, 's> {
    /// A reading that has not begun.
    pub fn new(root: &'r Section<'s>, settings: &'r [Setting], assumed: &'r Assumed) -> Self {
        Self {
            root,
            settings,
            assumed,
            arbitrary: Arbitrary::of(root, settings),
            vocabulary: Vocabulary::default(),
            parameters: Vec::new(),
            lists: Vec::new(),
            sizes: Vec::new(),
            state: State { variables: Vec::new(), draws: Vec::new() },
            items: Vec::new(),
            abbreviations: Vec::new(),
            level: Vec::new(),
            extension: Vec::new(),
            hidden: Vec::new(),
        }
    }

    /// Collection in which mistakes are noted.
    pub fn mistakes(&self) -> &'s Mistakes {
        self.root.mistakes()
    }

    /// Reads the tables of the system after the parameters; also returns its name.
    ///
    /// `None` if the system is not known.
    pub fn read(mut self) -> Option<(String, Parts)> {
        let text = self.kind()?;
        let Some((_, reader)) = SYSTEMS.iter().find(|(name, _)| *name == text.value) else {
            let message = format!("unknown system `{}`", text.value);
            let remedy = format!("write {}", names());
            self.mistakes().add(Mistake::at(text.span, Problem::Other { message, remedy }));
            return None;
        };
        let read = reader(&mut self, &text);
        self.name_rates();
        self.settle(Stage::Rates);
        let is_whole = read.is_some();
        let (system, chart) = read.unwrap_or((System::Field(Vec::new()), Chart::Free));
        let fixed = self.fixed();
        let hidden = shadows::all(&self.vocabulary, self.hidden);
        let alike = shadows::look_alikes(&self.vocabulary);
        let model = Model {
            system,
            vocabulary: self.vocabulary,
            parameters: self.parameters,
            state: self.state.variables,
            extension: self.extension,
            variables: None,
            abbreviations: self.abbreviations,
            level: self.level,
            fixed,
        };
        let free_draws = self.state.draws;
        Some((text.value, Parts { model, chart, free_draws, hidden, alike, is_whole }))
    }

    /// Symbols of whole numbers that sizes, and keys of `[field]`, contain.
    fn fixed(&self) -> Vec<Symbol> {
        let mut texts = self.sizes.clone();
        let keys = self.root.table("field").map(|section| section.entries()).unwrap_or_default();
        texts.extend(keys.into_iter().map(|(key, _)| key.get_ref().to_string()));
        let ranges = self.root.table("state").map(|section| section.entries()).unwrap_or_default();
        texts.extend(ranges.into_iter().filter_map(|(_, value)| match value.get_ref() {
            DeValue::String(text) => Some(text.to_string()),
            _ => None,
        }));
        let names = texts.iter().flat_map(|text| names_in(text));
        let whole = |name: String| {
            let is_whole = self.vocabulary.find(&name)?.whole.is_some();
            self.vocabulary.lookup(&name).filter(|_| is_whole).map(|(symbol, _)| symbol)
        };
        names.filter_map(whole).collect()
    }

    fn kind(&self) -> Option<Text> {
        match self.root.keep(self.root.text("system"))? {
            Some(text) => Some(text),
            None if ["field", "hamiltonian"].iter().any(|key| self.root.has(key)) => {
                Some(Text::made("field".to_string(), 0..0))
            }
            None if self.root.has("map") => Some(Text::made("map".to_string(), 0..0)),
            None if self.root.value("lagrangian").is_some() => {
                let remedy = "add system = \"nonholonomic\" or \"vakonomic\"";
                self.mistakes().add(self.root.missing("system", remedy));
                None
            }
            None => {
                let remedy = format!("add system = \"…\" with {}", names());
                self.mistakes().add(self.root.missing("system", &remedy));
                None
            }
        }
    }

    fn rolling(&mut self, name: &Text, way: Rolling) -> Read {
        let nothing = DeTable::new();
        let section = self.root.table("body").unwrap_or(self.root.empty("[body]", &nothing));
        let features = body::features(&section, way.curved, &self.vocabulary);
        let own = [("ω", Type::VECTOR), ("γ", Type::VECTOR)];
        let quantities = if way.spins { of_spinning(features) } else { of_rubber(features) };
        self.declare(&own, &[], quantities, name);
        self.further_state();
        self.settle(Stage::State);
        let (names, arbitrary) = (&self.vocabulary, self.arbitrary);
        let system = body::rolling(&section, way, &arbitrary, names, &mut self.parameters);
        section.finish();
        self.further_rates(own.len());
        let system = system?;
        self.mistakes().keep(feedback::none(self, &section, &system))?;
        self.level = vec![equation("|γ| = 1", LevelFunction::UnitNormal)];
        if !way.spins {
            self.level.push(equation("(ω,γ) = 0", LevelFunction::NoSpin));
        }
        let chart = system.chart();
        Some((system, chart))
    }

    fn flat_base(&mut self, name: &Text) -> Read {
        let nothing = DeTable::new();
        let section = self.root.table("body").unwrap_or(self.root.empty("[body]", &nothing));
        let near = Draw::Of(Line::All, Range::between((-3, 2), (3, 2)));
        let own = ["ω1", "ω2", "r1", "r2"].map(|name| (name, Type::Scalar));
        let draws = [near.clone(), near.clone(), near.clone(), near];
        self.declare(&own, &draws, of_flat_base(), name);
        self.further_state();
        self.settle(Stage::State);
        let system = body::flat_base(&section, &self.vocabulary);
        section.finish();
        self.further_rates(own.len());
        Some((system?, Chart::Free))
    }

    fn ball(&mut self, name: &Text) -> Read {
        let nothing = DeTable::new();
        let section = self.root.table("body").unwrap_or(self.root.empty("[body]", &nothing));
        let by_support = section.value("surface").is_none();
        let second = if by_support { "γ" } else { "r" };
        let own = [("M", Type::VECTOR), (second, Type::VECTOR)];
        let near = Draw::Of(Line::All, Range::between((-2, 1), (2, 1)));
        let draws = if by_support { Vec::new() } else { vec![near; 6] };
        self.declare(&own, &draws, of_ball(by_support), name);
        if section.value("potential").is_some() {
            let (meaning, reach) = (Meaning::Quantity(Quantity::Potential), Reach::Phase);
            self.vocabulary.add("U", meaning, Type::Scalar, reach);
        }
        self.further_state();
        self.settle(Stage::State);
        let arbitrary = self.arbitrary;
        let system = ball::read(&section, &arbitrary, &mut self.vocabulary, &mut self.parameters);
        section.finish();
        self.further_rates(own.len());
        let system = system?;
        self.mistakes().keep(feedback::none(self, &section, &system))?;
        if by_support {
            self.level = vec![equation("|γ| = 1", LevelFunction::UnitNormal)];
        }
        let chart = system.chart();
        Some((system, chart))
    }

    fn lagrangian(&mut self, vakonomic: bool) -> Read {
        self.own_state(
            Reach::Configuration,
            "add a table [state] with q = \"-2..2\", \"q'\" = \"-2..2\" for each variable",
        );
        let section = self.root.table("lagrangian");
        if section.is_none() && self.root.value("lagrangian").is_none() {
            let remedy = "add a table [lagrangian] with kinetic = \"…\"";
            let mut missing = self.root.missing("lagrangian", remedy);
            missing.span = self.root.value("system").map(toml::Spanned::span);
            self.mistakes().add(missing);
        }
        let section = section?;
        let constraints = section.texts("constraints").map_or(0, |texts| texts.len());
        for (name, quantity, kind, reach) in of_lagrangian(constraints) {
            self.name(&name, quantity, kind, reach);
        }
        self.settle(Stage::State);
        let system = lagrangian::read(self, &section, vakonomic);
        section.finish();
        let own = self.read_level();
        let system = system?;
        self.level.extend(own?);
        Some((system, Chart::Free))
    }

    fn field(&mut self) -> Read {
        if self.root.value("hamiltonian").is_some() {
            return hamiltonian::system(self);
        }
        self.own_state(Reach::Phase, "add a table [state] with x = \"-2..2\" for each variable");
        let section = self.root.table("field");
        if section.is_none() && self.root.value("field").is_none() {
            let remedy = "add a table [field] with \"x'\" = \"…\" for each variable";
            self.mistakes().add(self.root.missing("field", remedy));
        }
        self.settle(Stage::State);
        let variables = &self.state.variables;
        let rates = section.and_then(|section| field::rates(&section, variables, &self.vocabulary));
        let level = self.read_level();
        self.level = level?;
        Some((System::Field(rates?), Chart::Free))
    }

    /// Reads the equations of `[level]`; `None` if one is wrong.
    pub fn read_level(&self) -> Option<Vec<LevelEquation>> {
        match self.root.table("level") {
            Some(section) => field::equations(&section, &self.vocabulary),
            None => Some(Vec::new()),
        }
    }

    /// Reads the variables of a system without built-in ones.
    pub fn own_state(&mut self, reach: Reach, remedy: &str) {
        match self.root.table("state") {
            Some(ranges) => self.state = state::state(&ranges, &mut self.vocabulary, reach),
            None => {
                if self.root.value("state").is_none() {
                    self.mistakes().add(self.root.missing("state", remedy));
                }
                self.mistakes().blind();
            }
        }
        self.add_time(reach);
    }

    /// Adds time as a variable where formulas use it and it has no other meaning.
    fn add_time(&mut self, reach: Reach) {
        let is_discrete = self.root.has("map");
        if self.assumed.time && !is_discrete && self.vocabulary.find(TIME).is_none() {
            self.state.add_time(&mut self.vocabulary, reach);
        }
    }

    /// Adds the system's state and quantities; a parameter may hide a quantity, not a variable.
    fn declare(
        &mut self,
        own: &[(&str, Type)],
        draws: &[Draw],
        quantities: Vec<(&'static str, Quantity, Type, Reach)>,
        system: &Text,
    ) {
        let given = self.root.table("parameters");
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
                self.mistakes().add(Mistake::new(place(name), problem));
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
    }

    /// Names a quantity, unless the file gave the name another meaning.
    pub fn name(&mut self, name: &str, quantity: Quantity, kind: Type, reach: Reach) {
        match self.vocabulary.find(name).map(|entry| entry.meaning) {
            None => self.vocabulary.add(name, Meaning::Quantity(quantity), kind, reach),
            // x' is the velocity of x where both are declared.
            Some(Meaning::State(_) | Meaning::Quantity(_)) => {}
            Some(_) if self.hidden.iter().any(|hidden| hidden == name) => {}
            Some(_) => self.hidden.push(name.to_string()),
        }
    }

    /// Reads the variables that `[state]` adds to a built-in system.
    fn further_state(&mut self) {
        let first = self.state.variables.len();
        if let Some(section) = self.root.table("state") {
            state::add_state(&section, &mut self.vocabulary, Reach::Phase, &mut self.state);
        }
        let mut added = self.state.variables[first..].iter();
        if let Some(variable) = added.find(|variable| variable.name != TIME)
            && self.root.value("field").is_none()
        {
            let remedy = format!("add \"{}'\" = \"…\" under [field]", variable.name);
            self.mistakes().add(self.root.missing("field", &remedy));
        }
        self.add_time(Reach::Phase);
    }

    /// Reads the rates of the added variables.
    fn further_rates(&mut self, own: usize) {
        let further = &self.state.variables[own..];
        let nothing = DeTable::new();
        let section = match self.root.table("field") {
            Some(section) => section,
            None if further.is_empty() => return,
            None => self.root.empty("[field]", &nothing),
        };
        let is_told = self.root.value("field").is_none()
            && further.iter().any(|variable| variable.name != TIME);
        if !is_told {
            let rates = field::rates(&section, further, &self.vocabulary);
            self.extension = rates.unwrap_or_default();
        }
    }

    /// Gives the rate of each state variable a name, unless the name is taken.
    fn name_rates(&mut self) {
        for (index, variable) in self.state.variables.clone().iter().enumerate() {
            let name = format!("{}'", variable.name);
            self.name(&name, Quantity::Rate(index), variable.kind, Reach::Phase);
        }
    }
}
