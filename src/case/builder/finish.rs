//! Construction of the case from its declarations.

use super::super::value::FormulaSource;
use super::super::{Case, CaseRemark, ClaimError, build, halves, implied, repeated, shadows};
use super::{BodyPart, Build, ModelBuilder, chart};
use crate::formula::{Formula, Scope, Symbol, Type, names_in};
use crate::mechanics::{
    Chart, Dependence, Features, LevelEquation, LevelFunction, Meaning, Model, Potential, Quantity,
    RigidBody, Rubber, Shape, Spinning, System, Variable, of_rubber, of_spinning,
};

impl ModelBuilder {
    /// Builds the case.
    ///
    /// # Errors
    /// The first mistake in a declaration, or the first missing declaration.
    pub fn build(mut self) -> Result<Case, ClaimError> {
        if let Some(error) = self.error.take() {
            return Err(error);
        }
        let system = match self.build {
            Build::Field | Build::Map => None,
            Build::Rolling { spins, curved } => Some(self.body(spins, curved)?),
        };
        let rates = self.read_rates()?;
        let given_chart = self.chart.take();
        let (system, extension, chart) = match system {
            None => {
                if self.state.variables.is_empty() {
                    let message = "the system has no state variables";
                    return Err(ClaimError::new(&self.title, message, "declare some by `state`"));
                }
                let chart = if self.level.is_empty() { Chart::Free } else { Chart::Equations };
                let system = match self.build {
                    Build::Map => System::Map(rates),
                    _ => System::Field(rates),
                };
                (system, Vec::new(), chart)
            }
            Some(system) => {
                let chart = system.chart();
                (system, rates, chart)
            }
        };
        self.name_rates();
        let hidden = shadows::all(&self.vocabulary, Vec::new());
        let warnings = hidden.iter().map(|name| shadows::warning(&self.vocabulary, name));
        let warnings: Vec<String> =
            warnings.chain(shadows::look_alikes(&self.vocabulary)).collect();
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
            orientations: Vec::new(),
            fixed,
            undetermined: Vec::new(),
        };
        let mut case = Case {
            title: self.title,
            source: String::new(),
            system: match self.build {
                Build::Field => "field",
                Build::Map => "map",
                Build::Rolling { spins: false, curved: false } => "rubber-plane",
                Build::Rolling { spins: false, curved: true } => "rubber-sphere",
                Build::Rolling { spins: true, curved: false } => "rolling-plane",
                Build::Rolling { spins: true, curved: true } => "rolling-sphere",
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
            remarks: Vec::new(),
            without_time: None,
        };
        build::extend_support(&mut case.model);
        if let System::Map(images) = &case.model.system
            && let Some(image) = images.iter().find(|own| case.model.has_antiderivative(own))
        {
            let message = "an image cannot contain ∫, whose constant is open";
            return Err(ClaimError::new(image.text(), message, "write the antiderivative out"));
        }
        let is_open = |equation: &&LevelEquation| match &equation.function {
            LevelFunction::Formula(function) => case.model.has_antiderivative(function),
            _ => false,
        };
        let open = case.model.level.iter().find(is_open).map(|equation| equation.text.clone());
        case.model.undetermined = case.model.find_undetermined();
        let is_written =
            |equation: &LevelEquation| matches!(equation.function, LevelFunction::Formula(_));
        match open {
            None => {
                let mut remarks = repeated::count_factors_once(&mut case.model, is_written);
                remarks.extend(halves::take_out(&mut case.model, is_written));
                let left_out = implied::leave_out(&mut case.model, is_written);
                remarks.extend(left_out.map_err(|text| {
                    let message = "a level equation contradicts those before it";
                    ClaimError::new(&text, message, "correct one of them")
                })?);
                case.remarks = remarks.into_iter().map(CaseRemark::from).collect();
                if let Some(own) = given_chart {
                    case.chart = chart::chart(&case.model, own)?;
                }
                Ok(case)
            }
            Some(text) => {
                let message = "a level equation cannot contain ∫, whose constant is open";
                Err(ClaimError::new(&text, message, "write the antiderivative out"))
            }
        }
    }

    fn read_rates(&self) -> Result<Vec<Formula>, ClaimError> {
        let variables = self.state.variables.iter().zip(&self.rates).skip(self.own);
        let read = |(variable, rate): (&Variable, &Option<FormulaSource>)| {
            let what = match self.build {
                Build::Map => variable.name.clone(),
                _ => format!("{}'", variable.name),
            };
            match rate {
                Some(rate) => self.read(&what, rate, Some(variable.kind), Dependence::Phase),
                None if self.build == Build::Map => {
                    Err(ClaimError::new(&what, "the image is missing", "give it by `rate`"))
                }
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
                self.vocabulary.add(&name, meaning, variable.kind, Dependence::Phase);
            }
        }
    }

    /// Returns the symbols of whole numbers that occur in sizes.
    fn fixed(&self) -> Vec<Symbol> {
        let names = self.sizes.iter().flat_map(|text| names_in(text));
        let whole = |name: String| {
            let is_whole = self.vocabulary.find(&name)?.whole.is_some();
            self.vocabulary.lookup(&name).filter(|_| is_whole).map(|(symbol, _)| symbol)
        };
        names.filter_map(whole).collect()
    }

    fn source(&self, part: BodyPart) -> Option<&FormulaSource> {
        self.parts.iter().find(|(own, _)| *own == part).map(|(_, source)| source)
    }

    /// Reads a constant of the body, or the parameter that represents it.
    fn constant(&self, part: BodyPart, name: &str, kind: Type) -> Result<Formula, ClaimError> {
        let default = FormulaSource::from(name);
        let source = self.source(part).unwrap_or(&default);
        self.read(name, source, Some(kind), Dependence::Parameters)
    }

    fn body(&mut self, spins: bool, curved: bool) -> Result<System, ClaimError> {
        let mass = self.constant(BodyPart::Mass, "m", Type::Scalar)?;
        let inertia = self.constant(BodyPart::Inertia, "I", Type::MATRIX)?;
        let curvature =
            curved.then(|| self.constant(BodyPart::Curvature, "k", Type::Scalar)).transpose()?;
        let rotor = self.source(BodyPart::Gyrostat);
        let gyrostat = rotor
            .map(|rotor| self.read("gyrostat", rotor, Some(Type::VECTOR), Dependence::Parameters))
            .transpose()?;
        let shape = self.shape()?;
        let has = |name: &str, kind: Type| {
            self.vocabulary.lookup(name).is_some_and(|(_, found)| found == kind)
        };
        let features = Features {
            radius: has("R", Type::Scalar),
            displacement: has("c", Type::VECTOR),
            curvature: curved,
            potential: self.source(BodyPart::Potential).is_some(),
            profile: false,
        };
        let quantities = if spins { of_spinning(features) } else { of_rubber(features) };
        // the potential may use h, and not itself
        let is_potential = |quantity: &Quantity| *quantity == Quantity::Potential;
        let (own, others): (Vec<_>, Vec<_>) =
            quantities.into_iter().partition(|(_, quantity, _, _)| is_potential(quantity));
        self.name_quantities(others);
        let given = self.source(BodyPart::Potential);
        let potential = given
            .map(|given| self.read("U", given, Some(Type::Scalar), Dependence::Configuration))
            .transpose()?;
        self.name_quantities(own);
        let equation = |text: &str, function| LevelEquation {
            text: text.to_string(),
            function,
            root: None,
            lacks_entries: false,
        };
        self.level = vec![equation("|γ| = 1", LevelFunction::UnitNormal)];
        if !spins {
            self.level.push(equation("(ω,γ) = 0", LevelFunction::NoSpin));
        }
        let body = RigidBody {
            mass,
            inertia,
            shape,
            curvature,
            gyrostat,
            potential: potential.map(Potential::Formula),
            moment: None,
        };
        Ok(match spins {
            true => System::Spinning(Box::new(Spinning(body))),
            false => System::Rubber(Box::new(Rubber(body))),
        })
    }

    fn name_quantities(&mut self, quantities: Vec<(&'static str, Quantity, Type, Dependence)>) {
        for (name, quantity, kind, reach) in quantities {
            if self.vocabulary.find(name).is_none() {
                self.vocabulary.add(name, Meaning::Quantity(quantity), kind, reach);
            }
        }
    }

    fn shape(&self) -> Result<Shape, ClaimError> {
        let reach = Dependence::Configuration;
        let (scalar, vector) = (Some(Type::Scalar), Some(Type::VECTOR));
        let given = [BodyPart::Support, BodyPart::Contact];
        let mut given = given.into_iter().filter_map(|part| Some((part, self.source(part)?)));
        match (given.next(), given.next()) {
            (Some((BodyPart::Support, source)), None) => {
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
