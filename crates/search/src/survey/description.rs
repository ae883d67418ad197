//! Description of the system: its functions, parameters and equations of motion, line by line.

use liouville::case::Case;
use liouville::formula::{Formula, Layout, Type};
use liouville::mechanics::{
    Algebra, BracketBlock, Lagrangian, Meaning, Model, Potential, Shape, Surface, System,
    VariableRole,
};
use liouville::order::StableOrder;
use serde::Serialize;

use super::system_line::{SystemLine, boxes, parameters};

/// Contents of a case that describe its system.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Description {
    /// Functions and constants of the system, and the abbreviations in them.
    pub functions: Vec<SystemLine>,
    /// Parameters with their ranges or values.
    pub parameters: Vec<SystemLine>,
    /// Equations of motion, and those of the level set.
    pub equations: Vec<SystemLine>,
}

impl Description {
    /// Description of the system of a case.
    pub fn of(case: &Case) -> Self {
        let model = &case.model;
        let mut own = Self { parameters: parameters(case), ..Self::default() };
        match &model.system {
            System::Rubber(_) | System::Spinning(_) => own.rolling(case),
            System::FlatBase(body) => {
                own.function(model, "m", Some(&body.mass));
                own.function(model, "I", Some(&body.inertia));
                own.function(model, "k", Some(&body.curvature));
                own.function(model, "z", Some(&body.height));
                own.function(model, "S", body.gyrostat.as_ref());
                own.function(model, "U", body.potential.as_ref());
                own.equations.push(SystemLine::words(match body.potential {
                    None => "Ĩω' = (Ĩω + S)×ω − m r×(ω×r') + λγ, with r = (r₁, r₂, z), γ = e₃",
                    Some(_) => {
                        "Ĩω' = (Ĩω + S)×ω − m r×(ω×r') + (∂U/∂r₂, −∂U/∂r₁, 0)/k + λγ, with \
                         r = (r₁, r₂, z), γ = e₃"
                    }
                }));
            }
            System::Ball(ball) => {
                match &ball.surface {
                    Surface::Level(formula) => own.function(model, "F(r)", Some(formula)),
                    Surface::Arbitrary(_) => {
                        own.functions.push(SystemLine::words("F(r) is any smooth function"));
                    }
                    Surface::Support(shape) => own.shape(model, shape),
                }
                own.function(model, "m", Some(&ball.mass));
                own.function(model, "R", Some(&ball.radius));
                own.function(model, "μ", Some(&ball.moment));
                own.potential(model, "U(r)", ball.potential.as_ref());
                own.function(model, "Ω", ball.rotation.as_ref());
                let equation = "M' = moment of the forces and the reaction about the contact, with \
                                M = μω + Dγ×(ω×γ), D = mR²; r' = R ω×γ without rotation";
                own.equations.push(SystemLine::words(equation));
            }
            System::Lagrangian(lagrangian) => {
                own.function(model, "T", Some(&lagrangian.kinetic));
                own.function(model, "U", lagrangian.potential.as_ref());
                for (component, force) in &lagrangian.forces {
                    let of = case.model.variable_of(*component);
                    let name = of.map_or(String::new(), |(variable, _)| variable.name.clone());
                    own.functions
                        .push(SystemLine::words(format!("force on {name} = {}", force.text())));
                }
                own.lagrangian(model, lagrangian);
            }
            System::Hamiltonian(own_function) => {
                own.function(model, "H", Some(&own_function.function));
                for (variable, blocks) in model.state.iter().zip(&own_function.blocks) {
                    let row = variable.name.as_str();
                    // Of two vectors the unit matrix.
                    let unit = if variable.len() == 1 { "1" } else { "E" };
                    for (column, block) in model.state.iter().zip(blocks) {
                        let column = column.name.as_str();
                        match block {
                            Some(BracketBlock::Given(formula)) => {
                                let value = boxes(model, formula);
                                let text = formula.text();
                                own.functions.push(SystemLine::bracket([row, column], text, value));
                            }
                            Some(BracketBlock::Unit) => {
                                let kind = if unit == "1" { Type::Scalar } else { Type::MATRIX };
                                let value = Layout::name(unit, kind);
                                own.functions.push(SystemLine::bracket([row, column], unit, value));
                            }
                            Some(BracketBlock::Opposite(_) | BracketBlock::OppositeUnit) | None => {
                            }
                        }
                    }
                }
                own.equations.push(SystemLine::words("f' = {f,H} for each variable f"));
            }
            System::Field(rates) | System::Map(rates) => own.rates(case, rates),
        }
        own.further_rates(case);
        // An equation between vectors or matrices is several, and written once.
        let mut level: Vec<&str> = model.level.iter().map(|own| own.written()).collect();
        level.extend(model.orientations.iter().map(|own| own.equation.written()));
        level.dedup();
        own.equations.extend(level.into_iter().map(|own| SystemLine::level(model, own)));
        own.abbreviations(model);
        own
    }

    fn function(&mut self, model: &Model, name: &str, formula: Option<&Formula>) {
        let own = formula.filter(|own| own.text() != name);
        self.functions.extend(own.map(|own| SystemLine::definition(model, name, own)));
    }

    fn potential(&mut self, model: &Model, name: &str, potential: Option<&Potential>) {
        match potential {
            Some(Potential::Formula(formula)) => self.function(model, name, Some(formula)),
            Some(Potential::Arbitrary(_)) => {
                let text = format!("{name} is any smooth function");
                self.functions.push(SystemLine::words(text));
            }
            None => {}
        }
    }

    fn shape(&mut self, model: &Model, shape: &Shape) {
        match shape {
            Shape::Support(formula) | Shape::SupportOnSphere(formula) => {
                self.function(model, "h(γ)", Some(formula));
            }
            Shape::Profile(formula) => self.function(model, "p(z)", Some(formula)),
            Shape::Contact(formula) => self.function(model, "r(γ)", Some(formula)),
            Shape::Arbitrary(_) => {
                self.functions.push(SystemLine::words("h(γ) is any support function"));
            }
            Shape::ArbitraryProfile(_) => {
                self.functions.push(SystemLine::words("p(z) is any profile"));
            }
        }
    }

    fn rolling(&mut self, case: &Case) {
        let model = &case.model;
        let Some(body) = model.system.body() else { return };
        self.shape(model, &body.shape);
        self.function(model, "m", Some(&body.mass));
        self.function(model, "I", Some(&body.inertia));
        self.function(model, "k", body.curvature.as_ref());
        self.function(model, "S", body.gyrostat.as_ref());
        self.potential(model, "U(γ)", body.potential.as_ref());
        self.function(model, "M_P", body.moment.as_ref());
        let plus = |is_there: bool, text: &'static str| if is_there { text } else { "" };
        let rotor = match body.gyrostat.is_some() {
            true => "(Ĩω + S)×ω",
            false => "Ĩω×ω",
        };
        let forces = body.potential.is_some() || body.moment.is_some();
        let spins = matches!(case.model.system, System::Spinning(_));
        self.equations.push(SystemLine::words(format!(
            "Ĩω' = {rotor} − m r×(ω×r'){}{}",
            plus(forces, " + M_P"),
            plus(!spins, " + λγ")
        )));
        self.equations.push(SystemLine::words(match body.curvature {
            Some(_) => "γ' = Γ⁻¹(γ×ω), Γ = E − k ∂r/∂γ",
            None => "γ' = γ×ω",
        }));
        self.equations.push(SystemLine::words(format!(
            "r = −∇h, Ĩ = I + m r²E − m r⊗r{}{}",
            plus(body.potential.is_some(), ", M_P = γ×Γ⁻ᵀ∂U/∂γ"),
            plus(!spins, ", λ such that (ω,γ)' = 0")
        )));
    }

    /// Adds the rates of the variables that the case adds to a system.
    fn further_rates(&mut self, case: &Case) {
        let rates = &case.model.extension;
        let further = &case.model.state[case.model.own_variables()..];
        if rates.len() == further.len() {
            let pairs = further.iter().zip(rates);
            self.equations.extend(pairs.map(|(variable, rate)| {
                SystemLine::definition(&case.model, &format!("{}'", variable.name), rate)
            }));
        }
    }

    /// Adds the form of Lagrange's equations, the quasi-velocities with their algebra, and the rates of
    /// coordinates.
    fn lagrangian(&mut self, model: &Model, own: &Lagrangian) {
        let is_velocity = |role: &VariableRole| matches!(role, VariableRole::Velocity);
        let pairs = model.state.iter().zip(&own.roles).filter(|(_, role)| is_velocity(role));
        let velocities: Vec<&str> = pairs.map(|(variable, _)| variable.name.as_str()).collect();
        let velocities = velocities.join(", ");
        let (momenta, names) = match own.algebra {
            Algebra::Commuting => ("q'", String::new()),
            Algebra::Rotations(_) | Algebra::Frame => {
                ("w", format!(" in the quasi-velocities w = ({velocities})"))
            }
        };
        let reactions = match (own.constraints.is_empty(), own.vakonomic) {
            (true, _) => String::new(),
            (false, true) => " of T − U − Σ λᵢfᵢ".to_string(),
            (false, false) => format!(" with reactions Σ μᵢ ∂fᵢ/∂{momenta}"),
        };
        self.equations.push(SystemLine::words(format!("Lagrange's equations{reactions}{names}")));
        self.equations.extend(match own.algebra {
            Algebra::Commuting => None,
            Algebra::Rotations(_) => Some(SystemLine::words(format!(
                "the quasi-velocities are an angular velocity, algebra so(3): P' = P × {velocities} + …, P = ∂T/∂{velocities}"
            ))),
            Algebra::Frame => Some(SystemLine::words(
                "the terms of their commutators follow from the rates of the coordinates",
            )),
        });
        self.carried(model, own);
    }

    /// Adds the rates of coordinates that are given by quasi-velocities.
    fn carried(&mut self, model: &Model, lagrangian: &Lagrangian) {
        for (variable, role) in model.state.iter().zip(&lagrangian.roles) {
            let VariableRole::Carried(rates) = role else { continue };
            for (place, rate) in rates.iter().enumerate() {
                let name = match rates.len() {
                    1 => variable.name.clone(),
                    _ => variable.kind.component(&variable.name, place),
                };
                self.equations.push(SystemLine::definition(model, &format!("{name}'"), rate));
            }
        }
    }

    /// Adds what the abbreviations stand for that occur in the equations of motion or the level, each
    /// before those that use it.
    fn abbreviations(&mut self, model: &Model) {
        let mut used = vec![false; model.abbreviations.len()];
        for formula in model.functions() {
            for entry in model.vocabulary.uses(formula, &model.abbreviations) {
                if let Meaning::Abbreviation(index) = entry.meaning {
                    used[index] = true;
                }
            }
        }
        let mut lines = Vec::new();
        for (_, entry) in model.vocabulary.iter() {
            let Meaning::Abbreviation(index) = entry.meaning else { continue };
            if used.get(index) == Some(&true) {
                let own = &model.abbreviations[index];
                lines.push((index, SystemLine::definition(model, &entry.name, own)));
            }
        }
        lines.order_by_key(|(index, _)| *index);
        lines.dedup_by_key(|(index, _)| *index);
        self.functions.splice(0..0, lines.into_iter().map(|(_, line)| line));
    }

    fn rates(&mut self, case: &Case, rates: &[Formula]) {
        // A variable has one formula, or one for each of its components.
        let mut rates = rates.iter();
        for variable in &case.model.state {
            let mut place = 0;
            while place < variable.len() {
                let Some(rate) = rates.next() else { return };
                let size = rate.value_type().size();
                let name = match size == variable.len() {
                    true => variable.name.clone(),
                    false => variable.kind.component(&variable.name, place),
                };
                self.equations.push(SystemLine::definition(&case.model, &format!("{name}'"), rate));
                place += size.max(1);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn definitions_say_what_files_say() {
        let text = "title = 't'\nsystem = 'rubber-plane'\n[parameters]\nm = '0.5..2'\nR = '1..3'\n\
                    a_g = 'one of 1, 2'\nc = [0, 0, 0.5]\nI = 'inertia(0.5..5)'\n[body]\nshape = 'ball'\n\
                    potential = 'm*a_g*h'\n";
        let own = Description::of(&Case::parse(text, &[]).expect("a case"));
        assert_eq!(own.functions, ["h(γ) = R*|γ| + (c,γ)", "U(γ) = m*a_g*h"]);
        assert_eq!(own.parameters[0], "m in 0.5..2");
        for line in ["a_g in one of 1, 2", "I in inertia(0.5..5)"] {
            assert!(own.parameters.iter().any(|one| *one == line), "{own:?}");
        }
        assert!(own.parameters[0].layout.is_some(), "a range is typeset");
        assert_eq!(own.equations[0], "Ĩω' = Ĩω×ω − m r×(ω×r') + M_P + λγ");
        assert!(own.equations.iter().any(|one| *one == "level: |γ| = 1"), "{own:?}");
        let text = text.replace("shape = 'ball'", "shape = 'ball'\nframe = 'Q'\ntrack = 'X'");
        let full = Description::of(&Case::parse(&text, &[]).expect("a case"));
        for rate in ["Q' = hat(ω)ᵀ*Q", "X' = Qᵀ*r'"] {
            assert!(full.equations.iter().any(|one| *one == rate), "{rate}: {full:?}");
        }
        let text = "title = 't'\n[state]\nx = '-1..1'\ny = '-1..1'\n[field]\n\"x'\" = 'y'\n\"y'\" = '−x'\n";
        let own = Description::of(&Case::parse(text, &[]).expect("a case"));
        assert_eq!(own.equations, ["x' = y", "y' = −x"]);
        let text = "title = 't'\n[state]\nx = '-1..1'\np = '-1..1'\n[hamiltonian]\nfunction = 'p^2'\npairs = [['x', 'p']]\n";
        let own = Description::of(&Case::parse(text, &[]).expect("a case"));
        assert_eq!(own.functions, ["H = p^2", "{x,p} = 1"]);
        assert!(own.functions.iter().all(|line| line.layout.is_some()), "{own:?}");
        let text = "title = 't'\n[state]\nq = 'vector(2, -1..1)'\nw = 'vector(2, -1..1)'\n[field]\n\
                    \"q[1]'\" = 'w1'\n\"q[2]'\" = '−w2'\n\"w'\" = '0*w'\n[level]\nequations = ['w = [1, 2]']\n";
        let own = Description::of(&Case::parse(text, &[]).expect("a case"));
        assert_eq!(own.equations, ["q1' = w1", "q2' = −w2", "w' = 0*w", "level: w = [1, 2]"]);
    }

    #[test]
    fn abbreviations_and_rates_of_coordinates_are_stated() {
        let text = "title = 't'\nsystem = 'nonholonomic'\n[parameters]\nm = '1..2'\n[let]\nW = 'V + w'\n\
                    V = 'v^2'\nunused = 'v^3'\n[state]\nx = '-1..1'\nf = '-1..1'\nv = '-1..1'\nw = '-1..1'\n\
                    [lagrangian]\nkinetic = 'm*W/2 + w^2'\nquasi-velocities = ['v', 'w']\n[field]\n\
                    \"x'\" = 'v*cos(f)'\n\"f'\" = 'w'\n";
        let own = Description::of(&Case::parse(text, &[]).expect("a case"));
        let texts: Vec<&str> = own.functions.iter().map(|line| line.text.as_str()).collect();
        assert_eq!(texts, ["V = v^2", "W = V + w", "T = m*W/2 + w^2"]);
        assert!(own.functions.iter().all(|line| line.layout.is_some()), "all are typeset");
        assert!(own.equations.iter().any(|one| *one == "x' = v*cos(f)"), "{own:?}");
        let first = "Lagrange's equations in the quasi-velocities w = (v, w)";
        assert_eq!(own.equations[0], first);
    }
}
