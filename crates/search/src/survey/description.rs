//! Description of the system: its functions, parameters and equations of motion, line by line.

use liouville::case::Case;
use liouville::formula::Formula;
use liouville::mechanics::{BracketBlock, ParameterOrigin, Potential, Shape, Surface, System};
use liouville::number::rational::Rational;
use serde::Serialize;

/// Contents of a case that describe its system.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Description {
    /// Functions and constants of the system, such as `h = R*|γ|`.
    pub functions: Vec<String>,
    /// Parameters with their ranges or values.
    pub parameters: Vec<String>,
    /// Equations of motion, and those of the level set.
    pub equations: Vec<String>,
}

impl Description {
    /// Description of the system of a case.
    pub fn of(case: &Case) -> Self {
        let mut own = Self { parameters: parameters(case), ..Self::default() };
        match &case.model.system {
            System::Rubber(_) | System::Spinning(_) => own.rolling(case),
            System::FlatBase(body) => {
                own.function("m", Some(&body.mass));
                own.function("I", Some(&body.inertia));
                own.function("k", Some(&body.curvature));
                own.function("z", Some(&body.height));
                own.function("S", body.gyrostat.as_ref());
                own.function("U", body.potential.as_ref());
                own.equations.push(
                    match body.potential {
                        None => "Ĩω' = (Ĩω + S)×ω − m r×(ω×r') + λγ, with r = (r₁, r₂, z), γ = e₃",
                        Some(_) => {
                            "Ĩω' = (Ĩω + S)×ω − m r×(ω×r') + (∂U/∂r₂, −∂U/∂r₁, 0)/k + λγ, with \
                             r = (r₁, r₂, z), γ = e₃"
                        }
                    }
                    .to_string(),
                );
            }
            System::Ball(ball) => {
                match &ball.surface {
                    Surface::Level(formula) => own.function("F(r)", Some(formula)),
                    Surface::Arbitrary(_) => {
                        own.functions.push("F(r) is any smooth function".to_string());
                    }
                    Surface::Support(shape) => own.shape(shape),
                }
                own.function("m", Some(&ball.mass));
                own.function("R", Some(&ball.radius));
                own.function("μ", Some(&ball.moment));
                own.potential("U(r)", ball.potential.as_ref());
                own.function("Ω", ball.rotation.as_ref());
                let equation = "M' = moment of the forces and the reaction about the contact, with \
                                M = μω + Dγ×(ω×γ), D = mR²; r' = R ω×γ without rotation";
                own.equations.push(equation.to_string());
            }
            System::Lagrangian(lagrangian) => {
                own.function("T", Some(&lagrangian.kinetic));
                own.function("U", lagrangian.potential.as_ref());
                for (component, force) in &lagrangian.forces {
                    let of = case.model.variable_of(*component);
                    let name = of.map_or(String::new(), |(variable, _)| variable.name.clone());
                    own.functions.push(format!("force on {name} = {}", force.text()));
                }
                let equations = match (lagrangian.constraints.is_empty(), lagrangian.vakonomic) {
                    (true, _) => "Lagrange's equations",
                    (false, true) => "Lagrange's equations of T − U − Σ λᵢfᵢ",
                    (false, false) => "Lagrange's equations with reactions Σ μᵢ ∂fᵢ/∂q'",
                };
                own.equations.push(equations.to_string());
            }
            System::Hamiltonian(own_function) => {
                own.function("H", Some(&own_function.function));
                let names: Vec<&str> =
                    case.model.state.iter().map(|variable| variable.name.as_str()).collect();
                for (row, blocks) in names.iter().zip(&own_function.blocks) {
                    for (column, block) in names.iter().zip(blocks) {
                        match block {
                            Some(BracketBlock::Given(formula)) => own
                                .functions
                                .push(format!("{{{row},{column}}} = {}", formula.text())),
                            Some(BracketBlock::Unit) => {
                                own.functions.push(format!("{{{row},{column}}} = E"));
                            }
                            Some(BracketBlock::Opposite(_) | BracketBlock::OppositeUnit) | None => {
                            }
                        }
                    }
                }
                own.equations.push("x' = P ∂H/∂x".to_string());
            }
            System::Field(rates) | System::Map(rates) => own.rates(case, rates),
        }
        own.further_rates(case);
        // An equation between vectors or matrices is several, and written once.
        let mut level: Vec<String> =
            case.model.level.iter().map(|own| format!("level: {}", own.written())).collect();
        level.dedup();
        own.equations.extend(level);
        own
    }

    fn function(&mut self, name: &str, formula: Option<&Formula>) {
        let text = formula.map(Formula::text).filter(|text| *text != name);
        self.functions.extend(text.map(|text| format!("{name} = {text}")));
    }

    fn potential(&mut self, name: &str, potential: Option<&Potential>) {
        match potential {
            Some(Potential::Formula(formula)) => self.function(name, Some(formula)),
            Some(Potential::Arbitrary(_)) => {
                self.functions.push(format!("{name} is any smooth function"));
            }
            None => {}
        }
    }

    fn shape(&mut self, shape: &Shape) {
        match shape {
            Shape::Support(formula) | Shape::SupportOnSphere(formula) => {
                self.function("h(γ)", Some(formula));
            }
            Shape::Profile(formula) => self.function("p(z)", Some(formula)),
            Shape::Contact(formula) => self.function("r(γ)", Some(formula)),
            Shape::Arbitrary(_) => self.functions.push("h(γ) is any support function".to_string()),
            Shape::ArbitraryProfile(_) => {
                self.functions.push("p(z) is any profile".to_string());
            }
        }
    }

    fn rolling(&mut self, case: &Case) {
        let Some(body) = case.model.system.body() else { return };
        self.shape(&body.shape);
        self.function("m", Some(&body.mass));
        self.function("I", Some(&body.inertia));
        self.function("k", body.curvature.as_ref());
        self.function("S", body.gyrostat.as_ref());
        self.potential("U(γ)", body.potential.as_ref());
        self.function("M_P", body.moment.as_ref());
        let plus = |is_there: bool, text: &'static str| if is_there { text } else { "" };
        let rotor = match body.gyrostat.is_some() {
            true => "(Ĩω + S)×ω",
            false => "Ĩω×ω",
        };
        let forces = body.potential.is_some() || body.moment.is_some();
        let spins = matches!(case.model.system, System::Spinning(_));
        self.equations.push(format!(
            "Ĩω' = {rotor} − m r×(ω×r'){}{}",
            plus(forces, " + M_P"),
            plus(!spins, " + λγ")
        ));
        self.equations.push(match body.curvature {
            Some(_) => "γ' = Γ⁻¹(γ×ω), Γ = E − k ∂r/∂γ".to_string(),
            None => "γ' = γ×ω".to_string(),
        });
        self.equations.push(format!(
            "r = −∇h, Ĩ = I + m r²E − m r⊗r{}{}",
            plus(body.potential.is_some(), ", M_P = γ×Γ⁻ᵀ∂U/∂γ"),
            plus(!spins, ", λ such that (ω,γ)' = 0")
        ));
    }

    /// Adds the rates of the variables that the case adds to a system.
    fn further_rates(&mut self, case: &Case) {
        let rates = &case.model.extension;
        let further = &case.model.state[case.model.own_variables()..];
        if rates.len() == further.len() {
            let pairs = further.iter().zip(rates);
            self.equations.extend(
                pairs.map(|(variable, rate)| format!("{}' = {}", variable.name, rate.text())),
            );
        }
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
                self.equations.push(format!("{name}' = {}", rate.text()));
                place += size.max(1);
            }
        }
    }
}

/// Largest number of decimal places that are printed.
const MOST_PLACES: usize = 24;

/// A number as a decimal, if it ends, and otherwise as a fraction.
fn decimal(value: &Rational) -> String {
    let (mut scaled, ten) = (value.abs(), Rational::from(10));
    for places in 0..=MOST_PLACES {
        if let Some(whole) = scaled.to_integer() {
            let digits = format!("{whole:0>width$}", width = places + 1);
            let (before, after) = digits.split_at(digits.len() - places);
            let sign = if value.is_negative() { "-" } else { "" };
            let dot = if places == 0 { "" } else { "." };
            return format!("{sign}{before}{dot}{after}");
        }
        scaled = &scaled * &ten;
    }
    value.to_string()
}

/// Parameters with what the case says of each.
fn parameters(case: &Case) -> Vec<String> {
    let own = case.model.parameters.iter().filter(|parameter| !parameter.name.contains('['));
    own.map(|parameter| {
        let value = match &parameter.origin {
            ParameterOrigin::Fixed(values) => {
                let values: Vec<String> = values.iter().map(decimal).collect();
                format!("= {}", parameter.kind.listed(&values, ["(", ", ", ")"]))
            }
            ParameterOrigin::Formula(formula) => format!("= {}", formula.text()),
            ParameterOrigin::Free(recipe) => format!("in {}", recipe.text()),
        };
        format!("{} {value}", parameter.name)
    })
    .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_the_decimals_of_the_file() {
        let shown = |text: &str| decimal(&text.parse().expect("a number"));
        for text in ["0.0121505856", "-9.81", "12", "1/3", "-0.05"] {
            assert_eq!(shown(text), text);
        }
        assert_eq!(shown("3/8"), "0.375");
    }

    #[test]
    fn definitions_say_what_files_say() {
        let text = "title = 't'\nsystem = 'rubber-plane'\n[parameters]\nm = '0.5..2'\nR = '1..3'\n\
                    a_g = 'one of 1, 2'\nc = [0, 0, 0.5]\nI = 'inertia(0.5..5)'\n[body]\nshape = 'ball'\n\
                    potential = 'm*a_g*h'\n";
        let own = Description::of(&Case::parse(text, &[]).expect("a case"));
        assert_eq!(own.functions, ["h(γ) = R*|γ| + (c,γ)", "U(γ) = m*a_g*h"]);
        assert_eq!(own.parameters[0], "m in 0.5..2");
        assert!(own.parameters.contains(&"a_g in one of 1, 2".to_string()), "{own:?}");
        assert!(own.parameters.contains(&"I in inertia(0.5..5)".to_string()), "{own:?}");
        assert_eq!(own.equations[0], "Ĩω' = Ĩω×ω − m r×(ω×r') + M_P + λγ");
        assert!(own.equations.contains(&"level: |γ| = 1".to_string()), "{own:?}");
        let text = text.replace("shape = 'ball'", "shape = 'ball'\nframe = 'Q'\ntrack = 'X'");
        let full = Description::of(&Case::parse(&text, &[]).expect("a case"));
        for rate in ["Q' = hat(ω)ᵀ*Q", "X' = Qᵀ*r'"] {
            assert!(full.equations.iter().any(|one| one == rate), "{rate}: {full:?}");
        }
        let text = "title = 't'\n[state]\nx = '-1..1'\ny = '-1..1'\n[field]\n\"x'\" = 'y'\n\"y'\" = '−x'\n";
        let own = Description::of(&Case::parse(text, &[]).expect("a case"));
        assert_eq!(own.equations, ["x' = y", "y' = −x"]);
        let text = "title = 't'\n[state]\nq = 'vector(2, -1..1)'\nw = 'vector(2, -1..1)'\n[field]\n\
                    \"q[1]'\" = 'w1'\n\"q[2]'\" = '−w2'\n\"w'\" = '0*w'\n[level]\nequations = ['w = [1, 2]']\n";
        let own = Description::of(&Case::parse(text, &[]).expect("a case"));
        assert_eq!(own.equations, ["q1' = w1", "q2' = −w2", "w' = 0*w", "level: w = [1, 2]"]);
    }
}
