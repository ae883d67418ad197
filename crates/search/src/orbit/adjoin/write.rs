//! The extended field as the text of a case.

use std::fmt::Write;

use liouville::case::Case;
use liouville::formula::exponent_text;
use liouville::mechanics::{Draw, Model, SamplerSpec};
use liouville::number::rational::Rational;

use super::names_are_foreign;
use super::parsed::is_name;
use super::polynomial::RingPolynomial;
use super::ring::{AdjoinedRing, Atom, ConstantFunction, Of};

/// Beginning of the names of adjoined functions.
const PREFIX: &str = "aux";
/// Range of free inputs of the chart.
const RANGE: &str = "0.25..0.75";

/// Names of the variables of a ring.
pub struct RingNames {
    /// Names in the extended case; functions of the parameters are written out.
    pub extended: Vec<String>,
    /// Functions in the names of the case.
    pub original: Vec<String>,
}

impl RingNames {
    /// Names all variables of a ring.
    pub fn of(case: &Case, ring: &AdjoinedRing) -> Self {
        let model = &case.model;
        let parameters = model
            .free_parameters()
            .flat_map(|own| (0..own.kind.size()).map(|place| own.kind.component(&own.name, place)));
        let state = (0..model.dimension()).map(|k| model.component_name(k));
        let mut given = parameters.chain(state);
        let is_foreign = names_are_foreign(case);
        let mut names = Self { extended: Vec::new(), original: Vec::new() };
        for (place, atom) in ring.atoms.iter().enumerate() {
            let (extended, original) = match atom {
                Atom::State if is_foreign => {
                    (format!("{PREFIX}{place}"), given.next().unwrap_or_default())
                }
                Atom::Parameter | Atom::State => {
                    let name = given.next().unwrap_or_default();
                    (name.clone(), name)
                }
                Atom::Constant(Of::Inverse(_) | Of::Root(_)) => {
                    (defined(ring, atom, &names.extended), defined(ring, atom, &names.original))
                }
                _ => (format!("{PREFIX}{place}"), defined(ring, atom, &names.original)),
            };
            names.extended.push(extended);
            names.original.push(original);
        }
        names
    }
}

/// Names of all variables of a ring, from those of the parameters and the state.
pub fn function_names(ring: &AdjoinedRing, given: &[String]) -> Vec<String> {
    let mut names: Vec<String> = given.to_vec();
    for atom in &ring.atoms[given.len()..] {
        names.push(defined(ring, atom, &names));
    }
    names
}

/// Definition of a function by the names before it.
fn defined(ring: &AdjoinedRing, atom: &Atom, names: &[String]) -> String {
    let text = |own: &RingPolynomial| written(own, names);
    let inside = |own: &RingPolynomial| match own.single() {
        Some((monomial, value)) if value.is_one() && monomial.len() == 1 => text(own),
        _ => format!("({})", text(own)),
    };
    match atom {
        Atom::Parameter | Atom::State => String::new(),
        Atom::Constant(Of::Inverse(own)) => format!("(1/{})", inside(own)),
        Atom::Constant(Of::Root(own)) => format!("√({})", text(own)),
        Atom::Constant(Of::Function(function, own)) => {
            let name = match function {
                ConstantFunction::Exponential => "exp",
                ConstantFunction::Sine => "sin",
                ConstantFunction::Cosine => "cos",
                ConstantFunction::Logarithm => "ln",
                ConstantFunction::Arctangent => "atan",
                ConstantFunction::Power(power) => {
                    return format!("(({})^({}))", text(own), text(power));
                }
            };
            format!("{name}({})", text(own))
        }
        Atom::Exponential(own) | Atom::ExponentialOf(own, _) => {
            general_power(ring, own, names).unwrap_or_else(|| format!("exp({})", text(own)))
        }
        Atom::Sine(own) => format!("sin({})", text(own)),
        Atom::Cosine(own) => format!("cos({})", text(own)),
        Atom::Root(own, 2) => match own.square_root() {
            Some(root) => format!("|{}|", text(&root)),
            None => format!("√({})", text(own)),
        },
        Atom::Root(own, order) => format!("({})^(1/{order})", text(own)),
        Atom::Inverse(own, 1) => format!("(1/{})", inside(own)),
        Atom::Inverse(own, 2) => match own.square_root() {
            Some(root) => format!("(1/|{}|)", text(&root)),
            None => format!("(1/√({}))", text(own)),
        },
        Atom::Inverse(own, order) => format!("({})^(−1/{order})", text(own)),
        Atom::Logarithm(own, _) => format!("ln({})", text(own)),
        Atom::Arctangent(own, _) => format!("atan({})", text(own)),
        Atom::Power(own, exponent, _) => format!("({})^({})", text(own), text(exponent)),
    }
}

/// b^e for e^(e ln b).
fn general_power(ring: &AdjoinedRing, own: &RingPolynomial, names: &[String]) -> Option<String> {
    let (monomial, value) = own.single()?;
    let base = |(place, power): &(usize, u32)| match &ring.atoms[*place] {
        Atom::Constant(Of::Function(ConstantFunction::Logarithm, base))
        | Atom::Logarithm(base, _)
            if *power == 1 =>
        {
            Some((*place, base))
        }
        _ => None,
    };
    let (place, base) = monomial.iter().find_map(base)?;
    let rest = monomial.iter().filter(|(other, _)| *other != place).copied().collect();
    let tight = |own: &RingPolynomial| {
        let text = written(own, names);
        match is_name(&text) {
            true => text,
            false => format!("({text})"),
        }
    };
    Some(format!("({}^{})", tight(base), tight(&RingPolynomial::term(rest, value.clone()))))
}

/// Writes a polynomial.
pub fn written(own: &RingPolynomial, names: &[String]) -> String {
    let mut text = String::new();
    for (monomial, value) in own.terms() {
        let sign = match (value.is_negative(), text.is_empty()) {
            (true, true) => "−",
            (true, false) => " − ",
            (false, true) => "",
            (false, false) => " + ",
        };
        text.push_str(sign);
        let size = value.abs();
        let mut factors = Vec::new();
        if !size.is_one() || monomial.is_empty() {
            let (above, below) = size.parts();
            let is_whole = size.to_integer().is_some();
            factors.push(if is_whole { above.to_string() } else { format!("{above}/{below}") });
        }
        for (variable, power) in monomial {
            let name = &names[*variable];
            let base = if is_name(name) { name.clone() } else { format!("({name})") };
            factors.push(match power {
                1 => name.clone(),
                n => format!("{base}{}", exponent_text(i64::from(*n))),
            });
        }
        text.push_str(&factors.join("*"));
    }
    match text.is_empty() {
        true => "0".to_string(),
        false => text,
    }
}

/// Writes the case whose state has the adjoined functions, and then their relations as a level set; that
/// of the case comes before these, and then no chart is written.
pub fn case(
    case: &Case,
    ring: &AdjoinedRing,
    (rates, own_level): (&[RingPolynomial], &[RingPolynomial]),
    names: &RingNames,
) -> Option<[String; 2]> {
    let model = &case.model;
    let names = &names.extended;
    let mut text = "title = \"extended field\"\nsystem = \"field\"\n[parameters]\n".to_string();
    for own in model.free_parameters() {
        let liouville::mechanics::ParameterOrigin::Free(recipe) = &own.origin else { return None };
        line(&mut text, &own.name, &recipe.text());
    }
    for (place, atom) in ring.atoms.iter().enumerate() {
        if let Atom::Constant(Of::Function(..)) = atom {
            line(&mut text, &names[place], RANGE);
        }
    }
    text.push_str("[state]\n");
    let is_foreign = names_are_foreign(case);
    let first = ring.atoms.iter().position(|atom| matches!(atom, Atom::State))?;
    let ranges = match is_foreign {
        true => {
            let own = names[first..].iter().zip(&case.free_draws);
            own.map(|(name, draw)| (name.clone(), SamplerSpec::Scalar(draw.clone()).text()))
                .collect()
        }
        false => ranges(model, &case.free_draws)?,
    };
    ranges.iter().for_each(|(name, range)| line(&mut text, name, range));
    let adjoined = |atom: &Atom| !matches!(atom, Atom::Parameter | Atom::State | Atom::Constant(_));
    let own: Vec<usize> =
        (0..ring.atoms.len()).filter(|place| adjoined(&ring.atoms[*place])).collect();
    own.iter().for_each(|place| line(&mut text, &names[*place], RANGE));
    text.push_str("[field]\n");
    for k in (first..first + model.dimension()).filter(|_| is_foreign) {
        line(&mut text, &format!("{}'", names[k]), &written(&rates[k], names));
    }
    let mut component = first;
    for variable in model.state.iter().filter(|_| !is_foreign) {
        let parts: Vec<String> =
            (component..component + variable.len()).map(|k| written(&rates[k], names)).collect();
        component += variable.len();
        if variable.name != "t" {
            let rate = variable.kind.listed(&parts, ["[", ", ", "]"]);
            line(&mut text, &format!("{}'", variable.name), &rate);
        }
    }
    for place in &own {
        line(&mut text, &format!("{}'", names[*place]), &written(&rates[*place], names));
    }
    let mut level = FunctionChart::default();
    own.iter().for_each(|place| level.add(*place, &ring.atoms[*place], names));
    let of_case = own_level.iter().map(|own| format!("{} = 0", written(own, names)));
    let equations: Vec<String> =
        of_case.chain(level.equations.iter().cloned()).map(|own| format!("\"{own}\"")).collect();
    let mut relations = String::new();
    if equations.is_empty() {
        return Some([text, relations]);
    }
    let free = level.inputs.iter().map(|name| (name.clone(), RANGE.to_string()));
    let inputs: Vec<String> = ranges
        .into_iter()
        .chain(free)
        .map(|(name, own)| format!("\"{name}\" = \"{own}\""))
        .collect();
    let _ = writeln!(relations, "[level]\nequations = [{}]", equations.join(", "));
    if own_level.is_empty() {
        let _ = writeln!(relations, "[level.chart]\ninputs = {{ {} }}", inputs.join(", "));
        level.chart.iter().for_each(|(name, own)| line(&mut relations, name, own));
    }
    Some([text, relations])
}

/// Adds a line of a table.
pub fn line(text: &mut String, name: &str, value: &str) {
    let _ = writeln!(text, "\"{name}\" = \"{value}\"");
}

/// Ranges of the variables of the state.
fn ranges(model: &Model, draws: &[Draw]) -> Option<Vec<(String, String)>> {
    let mut rest = draws.iter();
    let mut all = Vec::new();
    for variable in &model.state {
        let draw = rest.next()?.clone();
        (1..variable.len()).for_each(|_| {
            rest.next();
        });
        use liouville::formula::Type::{Matrix, Scalar, Vector};
        let recipe = match variable.kind {
            Scalar => SamplerSpec::Scalar(draw),
            Vector(length) => SamplerSpec::Vector(length, draw),
            Matrix(rows, columns) => SamplerSpec::Matrix(rows, columns, draw),
        };
        all.push((variable.name.clone(), recipe.text()));
    }
    Some(all)
}

/// Relations between the functions, and a chart that solves them.
#[derive(Default)]
struct FunctionChart {
    equations: Vec<String>,
    inputs: Vec<String>,
    chart: Vec<(String, String)>,
}

impl FunctionChart {
    fn add(&mut self, place: usize, atom: &Atom, names: &[String]) {
        let name = names[place].clone();
        let mut relation = |equation: String, value: String| {
            self.equations.push(equation);
            self.chart.push((name.clone(), value));
        };
        match atom {
            Atom::Sine(_) => {
                let (angle, cosine) = (format!("arc{place}"), &names[place + 1]);
                relation(format!("{name}² + {cosine}² = 1"), format!("2*{angle}/(1 + {angle}²)"));
                let value = format!("(1 − {angle}²)/(1 + {angle}²)");
                self.chart.push((cosine.clone(), value));
                self.inputs.push(angle);
            }
            Atom::Cosine(_) => {}
            Atom::Root(base, order) => {
                let base = written(base, names);
                let value = match order {
                    2 => format!("√({base})"),
                    n => format!("({base})^(1/{n})"),
                };
                relation(format!("{name}^{order} = {base}"), value);
            }
            Atom::Inverse(base, 1) => {
                let base = written(base, names);
                relation(format!("{name}*({base}) = 1"), format!("1/({base})"));
            }
            Atom::Inverse(..) => {
                let root = &names[place - 1];
                relation(format!("{name}*{root} = 1"), format!("1/{root}"));
            }
            Atom::ExponentialOf(_, powers) => {
                let part = |sign: i64| {
                    let own = powers.iter().filter(|(_, power)| power.signum() == sign);
                    let one = RingPolynomial::constant(Rational::from(1));
                    let own = own.fold(one.clone(), |made, (variable, power)| {
                        let next = RingPolynomial::variable(*variable, power.unsigned_abs() as u32);
                        made.times(&next).unwrap_or_default()
                    });
                    written(&own, names)
                };
                let (above, below) = (part(1), part(-1));
                relation(format!("{name}*{below} = {above}"), format!("{above}/({below})"));
            }
            _ => self.inputs.push(name),
        }
    }
}
