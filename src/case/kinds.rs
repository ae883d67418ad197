//! The kinds of systems by name: states, names and level sets of each.

use toml::de::DeTable;

use super::order::Stage;
use super::section::SpannedStr;
use super::systems::Reading;
use super::{ball, body, equations, feedback, field, hamiltonian, lagrangian, map};
use crate::formula::Type;
use crate::mechanics::{
    BallSurface, Chart, Dependence, Draw, LevelEquation, LevelFunction, Meaning, NumberLine,
    Quantity, Range, System, of_ball, of_flat_base, of_lagrangian, of_rubber, of_spinning,
};

/// Equations of motion and the chart of their level; `None` where there is a mistake.
type Read = Option<(System, Chart)>;

/// Reads the tables of a system after the parameters; the text is its name.
type Reader = for<'a, 'r, 's> fn(&'a mut Reading<'r, 's>, &SpannedStr) -> Read;

/// The systems by name, in the order of messages.
pub(super) const SYSTEMS: [(&str, Reader); 10] = [
    ("rubber-plane", |reading, name| {
        reading.rolling(name, RollingKind { spins: false, curved: false })
    }),
    ("rubber-sphere", |reading, name| {
        reading.rolling(name, RollingKind { spins: false, curved: true })
    }),
    ("rolling-plane", |reading, name| {
        reading.rolling(name, RollingKind { spins: true, curved: false })
    }),
    ("rolling-sphere", |reading, name| {
        reading.rolling(name, RollingKind { spins: true, curved: true })
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
pub(super) struct RollingKind {
    /// Whether it may spin about the normal.
    pub spins: bool,
    /// Whether it rolls on a sphere, with a curvature.
    pub curved: bool,
}

/// Names of all systems.
pub const SYSTEM_NAMES: [&str; SYSTEMS.len()] = {
    let mut names = [""; SYSTEMS.len()];
    let mut index = 0;
    while index < names.len() {
        names[index] = SYSTEMS[index].0;
        index += 1;
    }
    names
};

/// Lists the names of all systems.
pub(super) fn names() -> String {
    let [others @ .., last] = &SYSTEM_NAMES;
    format!("{} or {last}", others.join(", "))
}

fn equation(text: &str, function: LevelFunction) -> LevelEquation {
    LevelEquation { text: text.to_string(), function, root: None, lacks_entries: false }
}

impl Reading<'_, '_> {
    /// Reads a body of any shape that rolls.
    fn rolling(&mut self, name: &SpannedStr, way: RollingKind) -> Read {
        let nothing = DeTable::new();
        let section = self.root.table("body").unwrap_or(self.root.empty("[body]", &nothing));
        let features = body::features(&section, way.curved, &self.vocabulary);
        let own = [("ω", Type::VECTOR), ("γ", Type::VECTOR)];
        let quantities = if way.spins { of_spinning(features) } else { of_rubber(features) };
        self.declare(&own, &[], quantities, name);
        let added = self.fixed_frame(&section);
        self.further_state();
        self.settle(Stage::State);
        let (names, arbitrary) = (&self.vocabulary, self.arbitrary);
        let system = body::rolling(&section, way, &arbitrary, names, &mut self.parameters);
        section.finish();
        self.further_rates(own.len() + added);
        let system = system?;
        self.mistakes().keep(feedback::none(self, &section, &system))?;
        self.level = vec![equation("|γ| = 1", LevelFunction::UnitNormal)];
        if !way.spins {
            self.level.push(equation("(ω,γ) = 0", LevelFunction::NoSpin));
        }
        let chart = system.chart();
        Some((system, chart))
    }

    fn flat_base(&mut self, name: &SpannedStr) -> Read {
        let nothing = DeTable::new();
        let section = self.root.table("body").unwrap_or(self.root.empty("[body]", &nothing));
        let near = Draw::Of(NumberLine::All, Range::between((-3, 2), (3, 2)));
        let own = ["ω1", "ω2", "r1", "r2"].map(|name| (name, Type::Scalar));
        let draws = [near.clone(), near.clone(), near.clone(), near];
        let has_potential = section.value("potential").is_some();
        self.declare(&own, &draws, of_flat_base(has_potential), name);
        self.further_state();
        self.settle(Stage::State);
        let system = body::flat_base(&section, &self.vocabulary);
        section.finish();
        self.further_rates(own.len());
        Some((system?, Chart::Free))
    }

    fn ball(&mut self, name: &SpannedStr) -> Read {
        let nothing = DeTable::new();
        let section = self.root.table("body").unwrap_or(self.root.empty("[body]", &nothing));
        let by_support = section.value("surface").is_none();
        let second = if by_support { "γ" } else { "r" };
        let own = [("M", Type::VECTOR), (second, Type::VECTOR)];
        let near = Draw::Of(NumberLine::All, Range::between((-2, 1), (2, 1)));
        let draws = if by_support { Vec::new() } else { vec![near; 6] };
        let surface = match (by_support, section.value("profile").is_some()) {
            (false, _) => BallSurface::Level,
            (true, false) => BallSurface::Support,
            (true, true) => BallSurface::Profile,
        };
        self.declare(&own, &draws, of_ball(surface), name);
        if section.value("potential").is_some() {
            for (name, quantity, kind) in [
                ("U", Quantity::Potential, Type::Scalar),
                ("∂U", Quantity::PotentialGradient, Type::VECTOR),
            ] {
                self.vocabulary.add(name, Meaning::Quantity(quantity), kind, Dependence::Phase);
            }
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
            Dependence::Configuration,
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
        let texts = section.texts("constraints").unwrap_or_default();
        let counted = equations::numbers(&texts, &self.vocabulary);
        self.awaits_reactions = counted.contains(&None);
        if !self.awaits_reactions {
            self.name_reactions(&counted);
        }
        self.settle(Stage::State);
        if self.awaits_reactions {
            // Constraints in names of [let] can be counted now.
            self.name_reactions(&equations::numbers(&texts, &self.vocabulary));
            self.awaits_reactions = false;
            self.settle(Stage::State);
        }
        let system = lagrangian::read(self, &section, vakonomic);
        section.finish();
        let own = self.read_level();
        let system = system?;
        self.level.extend(own?);
        Some((system, Chart::Free))
    }

    /// Names the reaction of each constraint.
    fn name_reactions(&mut self, counted: &[Option<usize>]) {
        let constraints = counted.iter().map(|count| count.unwrap_or(1)).sum();
        for (name, quantity, kind, reach) in of_lagrangian(constraints) {
            self.name(&name, quantity, kind, reach);
        }
    }

    fn field(&mut self) -> Read {
        if self.root.value("hamiltonian").is_some() {
            return hamiltonian::system(self);
        }
        self.own_state(
            Dependence::Phase,
            "add a table [state] with x = \"-2..2\" for each variable",
        );
        let section = self.root.table("field");
        if section.is_none() && self.root.value("field").is_none() {
            let remedy = "add a table [field] with \"x'\" = \"…\" for each variable";
            self.mistakes().add(self.root.missing("field", remedy));
        }
        self.settle(Stage::State);
        let variables = &self.state.variables;
        let rates = section.and_then(|section| field::rates(&section, variables, self.names()));
        let level = self.read_level();
        self.level = level?;
        Some((System::Field(rates?), Chart::Free))
    }
}
