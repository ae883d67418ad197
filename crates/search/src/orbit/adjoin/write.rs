//! The extended field as a case.

use liouville::case::{Case, ModelBuilder};
use liouville::formula::{Formula, exponent_text};
use liouville::mechanics::{Draw, Model, ParameterOrigin, Range, SamplerSpec};
use liouville::number::rational::Rational;

use super::super::cleared::input_names;
use super::names_are_foreign;
use super::parsed::is_name;
use super::polynomial::RingPolynomial;
use super::ring::{AdjoinedRing, Atom, ConstantFunction, Of};

/// Beginning of the names of adjoined functions.
const PREFIX: &str = "aux";
/// Range of adjoined functions, and of free inputs of the chart.
const RANGE: [(i64, i64); 2] = [(1, 4), (3, 4)];

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
        let mut given = input_names(case).into_iter();
        let prefix = unused(PREFIX, case);
        let is_foreign = names_are_foreign(case);
        let mut names = Self { extended: Vec::new(), original: Vec::new() };
        for (place, atom) in ring.atoms.iter().enumerate() {
            let (extended, original) = match atom {
                Atom::State if is_foreign => {
                    (format!("{prefix}{place}"), given.next().unwrap_or_default())
                }
                Atom::Parameter | Atom::State => {
                    let name = given.next().unwrap_or_default();
                    (name.clone(), name)
                }
                Atom::Constant(Of::Inverse(_) | Of::Root(_)) => {
                    (defined(ring, atom, &names.extended), defined(ring, atom, &names.original))
                }
                _ => (format!("{prefix}{place}"), defined(ring, atom, &names.original)),
            };
            names.extended.push(extended);
            names.original.push(original);
        }
        names
    }
}

/// The beginning of names that no name of a case contains: `aux`, or with further letters.
pub fn unused(beginning: &str, case: &Case) -> String {
    let is_taken = |own: &String| {
        case.model.vocabulary.iter().any(|(_, entry)| entry.name.contains(own.as_str()))
    };
    let mut own = beginning.to_string();
    while is_taken(&own) {
        own.push('x');
    }
    own
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

/// The field whose state has the adjoined functions, and the same with their relations as a level set, if
/// there are any; that of the case comes before these, and then there is no chart.
pub fn case(
    case: &Case,
    ring: &AdjoinedRing,
    (rates, own_level): (&[RingPolynomial], &[RingPolynomial]),
    names: &RingNames,
) -> Option<(ModelBuilder, ModelBuilder)> {
    let model = &case.model;
    let names = &names.extended;
    let mut field = with_parameters(Model::field().title("extended field"), model);
    let range = || SamplerSpec::Scalar(Draw::Within(Range::between(RANGE[0], RANGE[1])));
    for (place, atom) in ring.atoms.iter().enumerate() {
        if let Atom::Constant(Of::Function(..)) = atom {
            field = field.parameter(&names[place], range());
        }
    }
    let is_foreign = names_are_foreign(case);
    let first = ring.atoms.iter().position(|atom| matches!(atom, Atom::State))?;
    let ranges = match is_foreign {
        true => {
            let own = names[first..].iter().zip(&case.free_draws);
            own.map(|(name, draw)| (name.clone(), SamplerSpec::Scalar(draw.clone()))).collect()
        }
        false => ranges(model, &case.free_draws)?,
    };
    for (name, range) in &ranges {
        field = field.variable(name, range.clone());
    }
    let adjoined = |atom: &Atom| !matches!(atom, Atom::Parameter | Atom::State | Atom::Constant(_));
    let own: Vec<usize> =
        (0..ring.atoms.len()).filter(|place| adjoined(&ring.atoms[*place])).collect();
    for place in &own {
        field = field.variable(&names[*place], range());
    }
    for k in (first..first + model.dimension()).filter(|_| is_foreign) {
        field = field.rate(&names[k], written(&rates[k], names));
    }
    let mut component = first;
    for variable in model.state.iter().filter(|_| !is_foreign) {
        let parts: Vec<String> =
            (component..component + variable.len()).map(|k| written(&rates[k], names)).collect();
        component += variable.len();
        let rate = variable.kind.listed(&parts, ["[", ", ", "]"]);
        field = field.rate(&variable.name, rate);
    }
    for place in &own {
        field = field.rate(&names[*place], written(&rates[*place], names));
    }
    let mut level = FunctionChart::default();
    own.iter().for_each(|place| level.add(*place, &ring.atoms[*place], names));
    let mut whole = field.clone();
    for own in own_level {
        whole = whole.level(written(own, names), Formula::number(0));
    }
    let has_level = !own_level.is_empty() || !level.equations.is_empty();
    for (left, right) in &level.equations {
        whole = whole.level(left.as_str(), right.as_str());
    }
    if own_level.is_empty() && has_level {
        let free = level.inputs.into_iter().map(|name| (name, range()));
        whole = whole.chart(ranges.into_iter().chain(free), level.chart);
    }
    Some((field, whole))
}

/// Declares the free parameters of a model.
pub fn with_parameters(builder: ModelBuilder, model: &Model) -> ModelBuilder {
    model.parameters.iter().fold(builder, |builder, own| match &own.origin {
        ParameterOrigin::Free(recipe) => builder.parameter(&own.name, recipe.clone()),
        _ => builder,
    })
}

/// Ranges of the variables of the state.
fn ranges(model: &Model, draws: &[Draw]) -> Option<Vec<(String, SamplerSpec)>> {
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
        all.push((variable.name.clone(), recipe));
    }
    Some(all)
}

/// Relations between the functions, and a chart that solves them.
#[derive(Default)]
struct FunctionChart {
    equations: Vec<(String, String)>,
    inputs: Vec<String>,
    chart: Vec<(String, String)>,
}

impl FunctionChart {
    fn add(&mut self, place: usize, atom: &Atom, names: &[String]) {
        let name = names[place].clone();
        let mut relation = |left: String, right: String, value: String| {
            self.equations.push((left, right));
            self.chart.push((name.clone(), value));
        };
        match atom {
            Atom::Sine(_) => {
                let (angle, cosine) = (format!("arc{name}"), &names[place + 1]);
                let value = format!("2*{angle}/(1 + {angle}²)");
                relation(format!("{name}² + {cosine}²"), "1".to_string(), value);
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
                relation(format!("{name}^{order}"), base, value);
            }
            Atom::Inverse(base, 1) => {
                let base = written(base, names);
                relation(format!("{name}*({base})"), "1".to_string(), format!("1/({base})"));
            }
            Atom::Inverse(..) => {
                let root = &names[place - 1];
                relation(format!("{name}*{root}"), "1".to_string(), format!("1/{root}"));
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
                let value = format!("{above}/({below})");
                relation(format!("{name}*{below}"), above, value);
            }
            _ => self.inputs.push(name),
        }
    }
}
