//! The key `system`: equations of motion with their names, states and level sets.

use toml::de::{DeTable, DeValue};

use super::arbitrary::Arbitrary;
use super::build::Assumed;
use super::equations;
use super::error::{Mistake, Problem};
use super::field;
use super::mistakes::Mistakes;
use super::order::{Stage, WaitingName};
use super::parameters::Setting;
use super::section::{CaseTable, SpannedStr};
use super::state::{self, State};
use super::stated::Time;
use super::{kinds, shadows, shaped};
use crate::formula::{Formula, Scope, Symbol, Type, canonical_name, names_in};
use crate::mechanics::{
    Chart, Dependence, Draw, LevelEquation, Meaning, Model, Parameter, Quantity, System, TIME,
    Variable, Vocabulary,
};

/// A model with its chart and draws.
pub struct ModelParts {
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
    pub root: &'r CaseTable<'s>,
    pub settings: &'r [Setting],
    pub assumed: &'r Assumed,
    pub arbitrary: Arbitrary<'r>,
    pub vocabulary: Vocabulary,
    pub parameters: Vec<Parameter>,
    /// Parameters that are lists: vectors, or diagonal matrices.
    pub lists: Vec<String>,
    /// Texts of parameters that are drawn, which may contain sizes.
    pub sizes: Vec<String>,
    pub state: State,
    /// Names of `[parameters]` and `[let]`, whether read or pending.
    pub items: Vec<WaitingName<'s>>,
    /// Whether names may stand for reactions of constraints that are not counted yet.
    pub awaits_reactions: bool,
    pub abbreviations: Vec<Formula>,
    pub level: Vec<LevelEquation>,
    pub extension: Vec<Formula>,
    /// Names of the system that the file redefines.
    pub hidden: Vec<String>,
}

impl<'r, 's> Reading<'r, 's> {
    /// A reading that has not begun.
    pub fn new(root: &'r CaseTable<'s>, settings: &'r [Setting], assumed: &'r Assumed) -> Self {
        Self {
            root,
            settings,
            assumed,
            arbitrary: Arbitrary::of(root, settings),
            vocabulary: Vocabulary::default(),
            parameters: Vec::new(),
            lists: Vec::new(),
            sizes: Vec::new(),
            state: State { variables: Vec::new(), draws: Vec::new(), rotations: None },
            items: Vec::new(),
            awaits_reactions: false,
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
    pub fn read(mut self) -> Option<(String, ModelParts)> {
        let text = self.kind()?;
        let Some((_, reader)) = kinds::SYSTEMS.iter().find(|(name, _)| *name == text.value) else {
            let message = format!("unknown system `{}`", text.value);
            let remedy = match text.value.as_str() {
                "hamiltonian" => "remove this line: the table [hamiltonian] is enough".to_string(),
                "lagrangian" if self.is_free() => {
                    "remove this line: a table [lagrangian] without constraints is enough"
                        .to_string()
                }
                "lagrangian" => "write nonholonomic or vakonomic".to_string(),
                _ => format!("write {}", kinds::names()),
            };
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
            orientations: Vec::new(),
            fixed,
            undetermined: Vec::new(),
        };
        let free_draws = self.state.draws;
        // Without constraints every kind is Lagrange's equations.
        let name = match &model.system {
            System::Lagrangian(own) if own.constraints.is_empty() => "lagrangian".to_string(),
            _ => text.value,
        };
        Some((name, ModelParts { model, chart, free_draws, hidden, alike, is_whole }))
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

    /// Whether there is a Lagrangian, and no constraint.
    fn is_free(&self) -> bool {
        let value = self.root.value("lagrangian").map(|value| value.get_ref());
        let Some(DeValue::Table(table)) = value else { return false };
        !table.contains_key("constraints") && !table.contains_key("multipliers")
    }

    fn kind(&self) -> Option<SpannedStr> {
        match self.root.keep(self.root.text("system"))? {
            Some(text) => Some(text),
            None if ["field", "hamiltonian"].iter().any(|key| self.root.has(key)) => {
                Some(SpannedStr::made("field".to_string(), 0..0))
            }
            None if self.root.has("map") => Some(SpannedStr::made("map".to_string(), 0..0)),
            // Without constraints both kinds are Lagrange's equations.
            None if self.is_free() => Some(SpannedStr::made("nonholonomic".to_string(), 0..0)),
            None if self.root.value("lagrangian").is_some() => {
                let remedy = "add system = \"nonholonomic\" or \"vakonomic\"";
                self.mistakes().add(self.root.missing("system", remedy));
                None
            }
            None => {
                let remedy = format!("add system = \"…\" with {}", kinds::names());
                self.mistakes().add(self.root.missing("system", &remedy));
                None
            }
        }
    }

    /// Names and parameters that formulas use.
    pub fn names(&self) -> field::Names<'_> {
        field::Names { vocabulary: &self.vocabulary, parameters: &self.parameters }
    }

    /// Reads the equations of `[level]`; `None` if one is wrong.
    pub fn read_level(&self) -> Option<Vec<LevelEquation>> {
        let mut level = match self.root.table("level") {
            Some(section) => equations::level_equations(&section, &self.vocabulary)?,
            None => Vec::new(),
        };
        let mut own = self.rotations(false);
        // Those with velocities are constraints of a Lagrangian.
        if !self.root.has("lagrangian") {
            own.extend(self.rotations(true));
        }
        let own = own.into_iter();
        level.extend(own.map(|(text, own)| equations::level_equation(text, own, None)));
        Some(level)
    }

    /// Returns the equations of the matrices that `[state]` declares as rotations: those of which it declares velocities
    /// too, or the others.
    pub fn rotations(&self, with_velocities: bool) -> Vec<(String, Formula)> {
        let has_velocity = |name: &&String| {
            let velocity = format!("{name}'");
            self.state.variables.iter().any(|own| own.name == velocity) == with_velocities
        };
        let names = self.state.rotations.iter().flatten().filter(has_velocity);
        let of = |name: &String| equations::of_rotation(name, &self.vocabulary);
        names.flat_map(|name| self.root.keep(of(name)).unwrap_or_default()).collect()
    }

    /// Reads the variables of a system without built-in ones.
    pub fn own_state(&mut self, reach: Dependence, remedy: &str) {
        match self.root.table("state") {
            Some(ranges) => {
                // A map may take one half of the orthogonal matrices to the other, and multipliers are given by constraint.
                let kind = self.root.text("system").ok().flatten();
                let is_vakonomic = kind.is_some_and(|kind| kind.value == "vakonomic");
                let rotations = (!self.root.has("map") && !is_vakonomic).then(Vec::new);
                self.state = state::state(&ranges, &mut self.vocabulary, reach, rotations);
                self.list_shapes();
            }
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
    fn add_time(&mut self, reach: Dependence) {
        let is_discrete = self.root.has("map");
        if self.assumed.time != Time::Absent && !is_discrete && self.vocabulary.find(TIME).is_none()
        {
            self.state.add_time(&mut self.vocabulary, reach);
        }
    }

    /// Adds the system's state and quantities; a parameter may hide a quantity, not a variable.
    pub fn declare(
        &mut self,
        own: &[(&str, Type)],
        draws: &[Draw],
        quantities: Vec<(&'static str, Quantity, Type, Dependence)>,
        system: &SpannedStr,
    ) {
        let given = self.root.table("parameters");
        let place = |name: &str| {
            let entries = given.as_ref().map(CaseTable::entries).unwrap_or_default();
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
            let position = matches!(*name, "γ" | "r" | "r1" | "r2");
            let reach = if position { Dependence::Configuration } else { Dependence::Phase };
            self.vocabulary.add(name, Meaning::State(index), *kind, reach);
            self.state.variables.push(Variable {
                name: name.to_string(),
                kind: *kind,
                shape: None,
            });
        }
        self.state.draws.extend(draws.iter().cloned());
        for (name, quantity, kind, reach) in quantities {
            self.name(name, quantity, kind, reach);
        }
        self.name_rates();
    }

    /// Names a quantity, unless the file gave the name another meaning.
    pub fn name(&mut self, name: &str, quantity: Quantity, kind: Type, reach: Dependence) {
        match self.vocabulary.find(name).map(|entry| entry.meaning) {
            None => self.vocabulary.add(name, Meaning::Quantity(quantity), kind, reach),
            // x' is the velocity of x where both are declared.
            Some(Meaning::State(_) | Meaning::Quantity(_)) => {}
            Some(_) if self.hidden.iter().any(|hidden| hidden == name) => {}
            Some(_) => self.hidden.push(name.to_string()),
        }
    }

    /// Reads the variables that `[state]` adds to a built-in system.
    pub fn further_state(&mut self) {
        let first = self.state.variables.len();
        if let Some(section) = self.root.table("state") {
            state::add_state(&section, &mut self.vocabulary, Dependence::Phase, &mut self.state);
            self.list_shapes();
        }
        let mut added = self.state.variables[first..].iter();
        if let Some(variable) = added.find(|variable| variable.name != TIME)
            && self.root.value("field").is_none()
        {
            let name = shaped::written(variable).name;
            let remedy = format!("add \"{name}'\" = \"…\" under [field]");
            self.mistakes().add(self.root.missing("field", &remedy));
        }
        self.add_time(Dependence::Phase);
    }

    /// Reads the rates of the added variables.
    pub fn further_rates(&mut self, own: usize) {
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
            let rates = field::rates(&section, further, self.names());
            self.extension.extend(rates.unwrap_or_default());
        }
    }

    /// Gives the rate of each state variable a name, unless the name is taken.
    fn name_rates(&mut self) {
        for (index, variable) in self.state.variables.clone().iter().enumerate() {
            let name = format!("{}'", variable.name);
            self.name(&name, Quantity::Rate(index), variable.kind, Dependence::Phase);
        }
    }
}
