//! The table `[parameters]`: numbers, lists, ranges and formulas.

use toml::Spanned;
use toml::de::DeValue;

use super::error::{Mistake, Problem};
use super::order::{ItemKind, Stage, WaitingName};
use super::section::{CaseTable, SpannedStr};
use super::shapes::{self, GivenValue, Refusal};
use super::systems::Reading;
use crate::formula::{Formula, FormulaError, Scope, Type, canonical_name, excerpt};
use crate::graph;
use crate::mechanics::{
    Dependence, Draw, Meaning, NumberLine, Parameter, ParameterOrigin, Range, SamplerSpec,
    Vocabulary,
};
use crate::number::rational::{Rational, RationalError};

/// A value given on the command line in place of the file's.
#[derive(Clone, Debug)]
pub struct Setting {
    /// Canonical name of the parameter.
    pub name: String,
    /// Constant given for it.
    pub value: String,
}

/// Message about texts that are not names.
pub const NO_NAME: &str = "a name is letters, then digits, primes or _";

impl<'r, 's> Reading<'r, 's> {
    /// Reads `[parameters]`; settings replace the file's values.
    pub(super) fn read_parameters(&mut self) {
        let section = self.root.table("parameters");
        for (key, value) in section.map(|section| section.entries()).unwrap_or_default() {
            let Some(name) = self.mistakes().keep(named(key)) else { continue };
            if self.parameters.iter().any(|known| known.name == name) {
                let reason = "it is declared twice".to_string();
                let problem = Problem::BadName { name, reason };
                self.mistakes().add(Mistake::at(key.span(), problem));
                continue;
            }
            let index = self.parameters.len();
            let origin = ParameterOrigin::Fixed(vec![Rational::from(0)]);
            self.parameters.push(Parameter { name: name.clone(), kind: Type::Scalar, origin });
            self.items.push(WaitingName::new(name, key.span(), ItemKind::Parameter(index, value)));
        }
        self.list_abbreviations();
        self.await_names();
        self.settle(Stage::Parameters);
    }

    /// Reads one parameter, if all names in it are known.
    pub(super) fn read_parameter(
        &mut self,
        index: usize,
        item: usize,
        value: &'s Spanned<DeValue<'s>>,
    ) -> Result<(), Mistake> {
        let name = self.items[item].name.clone();
        let text = || self.root.as_text(&name, value);
        let written = shapes::given(value, &self.vocabulary).map_err(|refusal| match refusal {
            Refusal::Message(message) => Mistake::at(value.span(), Problem::Parameter(message)),
            Refusal::Form(message, remedy) => {
                Mistake::at(value.span(), Problem::Sense { message, remedy })
            }
            Refusal::OneValue(only) => {
                let message = Refusal::empty_range(&only, &only);
                let remedy = format!("write {only} for one value");
                Mistake::at(value.span(), Problem::Sense { message, remedy })
            }
            Refusal::Size(error, start) => {
                let inner = start + error.span().start..start + error.span().end;
                let place = text().map_or(value.span(), |text| text.locate(inner));
                Mistake::at(place, Problem::Formula(error))
            }
        })?;
        let setting = self.settings.iter().find(|setting| setting.name == name);
        let (given, text) = match setting {
            None => (written, text().ok()),
            Some(setting) => (self.set(setting, &written), None),
        };
        let text = text.unwrap_or_else(|| match &given {
            GivenValue::Formula(formula) => SpannedStr::made(formula.clone(), value.span()),
            _ => SpannedStr::made(String::new(), value.span()),
        });
        let (kind, origin) = match given {
            GivenValue::Fixed(kind, values) => (kind, ParameterOrigin::Fixed(values)),
            GivenValue::Drawn(recipe) => {
                self.sizes.push(text.value.clone());
                (recipe.kind(), ParameterOrigin::Free(recipe))
            }
            GivenValue::List(values) => {
                self.lists.push(name.clone());
                let (kind, values) = shapes::list(values, self.assumed.is_diagonal(&name));
                (kind, ParameterOrigin::Fixed(values))
            }
            GivenValue::Formula(_) => {
                let formula = Formula::parse(&text.value, &self.vocabulary);
                let formula = formula.map_err(|error| match setting {
                    Some(setting) => refused(setting, &error),
                    None => Mistake::at(text.locate(error.span()), Problem::Formula(error)),
                })?;
                (formula.value_type(), origin_of(formula))
            }
        };
        if let Some(setting) = setting
            && let Some(expected) = self.kind_of_written(value).filter(|known| *known != kind)
        {
            let (own, given) = match expected.differs_in_size(kind) {
                true => (expected.in_full(), kind.in_full()),
                false => (expected.to_string(), kind.to_string()),
            };
            let problem = format!("`{name}` is a {own}, and this is a {given}");
            return Err(set_to(setting, &problem, &form_of(&name, expected)));
        }
        if let (Some(setting), Ok(GivenValue::Drawn(recipe))) =
            (setting, shapes::given(value, &self.vocabulary))
            && let ParameterOrigin::Fixed(values) = &origin
            && let Some([(i, j), (k, l)]) = recipe.unlike(values)
        {
            let [one, other] =
                [[i, j], [k, l]].map(|[i, j]| format!("{name}[{},{}]", i + 1, j + 1));
            let problem = match one == other {
                true => format!("`{name}` is `{}`, and {one} is not 0", recipe.text()),
                false => {
                    format!("`{name}` is `{}`, and {one} and {other} do not fit", recipe.text())
                }
            };
            return Err(set_to(setting, &problem, "give a matrix of this form"));
        }
        let whole = match (&origin, kind) {
            (ParameterOrigin::Fixed(values), Type::Scalar) => {
                values.first().and_then(Rational::to_integer)
            }
            (ParameterOrigin::Formula(formula), Type::Scalar) => {
                Formula::whole_number(formula.text(), &self.vocabulary).ok()
            }
            _ => None,
        };
        self.vocabulary.add(&name, Meaning::Parameter(index), kind, Dependence::Parameters);
        if let Some(whole) = whole {
            self.vocabulary.set_whole(&name, whole);
        }
        self.parameters[index] = Parameter { name, kind, origin };
        Ok(())
    }

    /// Converts a setting to a value: a list keeps the type of the file's value.
    fn set(&mut self, setting: &Setting, written: &GivenValue) -> GivenValue {
        let text = setting.value.trim();
        let list = text.strip_prefix('[').and_then(|rest| rest.strip_suffix(']'));
        let Some(list) = list.filter(|list| !list.contains('[')) else {
            return GivenValue::Formula(text.to_string());
        };
        let is_matrix = match written {
            GivenValue::Fixed(kind, _) => matches!(kind, Type::Matrix(..)),
            GivenValue::Drawn(recipe) => matches!(recipe.kind(), Type::Matrix(..)),
            GivenValue::List(_) | GivenValue::Formula(_) => {
                self.lists.push(setting.name.clone());
                self.assumed.is_diagonal(&setting.name)
            }
        };
        let text = if is_matrix { format!("diag({list})") } else { text.to_string() };
        GivenValue::Formula(text)
    }

    /// Type of the value in the file, where that is known without reading formulas.
    fn kind_of_written(&self, value: &Spanned<DeValue<'_>>) -> Option<Type> {
        match shapes::given(value, &self.vocabulary).ok()? {
            GivenValue::Fixed(kind, _) => Some(kind),
            GivenValue::Drawn(recipe) => Some(recipe.kind()),
            GivenValue::List(_) | GivenValue::Formula(_) => None,
        }
    }
}

/// Numbers of a formula without names, or the formula.
pub fn origin_of(formula: Formula) -> ParameterOrigin {
    match constant(&formula) {
        Some(values) => ParameterOrigin::Fixed(values),
        None => ParameterOrigin::Formula(formula),
    }
}

/// Advice on the form of a value of a type.
fn form_of(name: &str, kind: Type) -> String {
    const MOST_WRITTEN: usize = 4;
    let listed = |count: usize| {
        let mut all: Vec<String> = (1..=count.min(MOST_WRITTEN)).map(|k| k.to_string()).collect();
        if count > MOST_WRITTEN {
            all.push("…".to_string());
        }
        format!("[{}]", all.join(", "))
    };
    match kind {
        Type::Scalar => format!("give a number: {name}=5/4"),
        Type::Vector(length) => format!("give {length} components: {name}={}", listed(length)),
        Type::Matrix(rows, columns) if rows == columns => format!(
            "give the {rows} numbers of its diagonal, {name}={}, or its rows, {name}=[[…], …]",
            listed(rows)
        ),
        Type::Matrix(rows, _) => format!("give its {rows} rows: {name}=[[…], …]"),
    }
}

/// The mistake of a setting that cannot be read.
fn refused(setting: &Setting, error: &FormulaError) -> Mistake {
    let constant = "give a constant: 5/4, [1,2,3], [[…],[…],[…]]";
    let help = error.help().filter(|_| error.unknown_name().is_none());
    set_to(setting, error.message(), help.unwrap_or(constant))
}

fn set_to(setting: &Setting, problem: &str, remedy: &str) -> Mistake {
    let message = format!("--set {}={}: {problem}", setting.name, setting.value);
    Mistake::whole(Problem::Other { message, remedy: remedy.to_string() })
}

/// Canonical name for a user-defined key.
pub fn named(key: &Spanned<std::borrow::Cow<'_, str>>) -> Result<String, Mistake> {
    canonical_name(key.get_ref()).ok_or_else(|| {
        let (name, reason) = (excerpt(key.get_ref()), NO_NAME.to_string());
        Mistake::at(key.span(), Problem::BadName { name, reason })
    })
}

/// Reports settings of parameters that do not exist.
pub fn unknown_settings(root: &CaseTable<'_>, settings: &[Setting], parameters: &[Parameter]) {
    let known = |name: &str| parameters.iter().any(|parameter| parameter.name == name);
    for setting in settings.iter().filter(|setting| !known(&setting.name)) {
        let names: Vec<&str> = parameters.iter().map(|p| p.name.as_str()).collect();
        let known = if names.is_empty() { "no parameters".to_string() } else { names.join(", ") };
        let whole = setting.name.split(|c: char| c.is_ascii_digit() || c == '[').next();
        let whole = parameters.iter().find(|own| Some(own.name.as_str()) == whole);
        let (message, remedy) = match whole.filter(|own| own.kind != Type::Scalar) {
            Some(own) => {
                let all =
                    if matches!(own.kind, Type::Vector(_)) { "[…]" } else { "[[…], […]]" };
                (
                    format!(
                        "`{}` is an entry of `{}`, and is not set alone",
                        setting.name, own.name
                    ),
                    format!("give the whole: --set '{}={all}'", own.name),
                )
            }
            None => (
                format!("there is no parameter `{}` to set", setting.name),
                format!("this case has {known}"),
            ),
        };
        root.mistakes().add(Mistake::whole(Problem::Other { message, remedy }));
    }
}

/// Exact components of a formula without names.
pub fn constant(formula: &Formula) -> Option<Vec<Rational>> {
    if formula.symbols().next().is_some() {
        return None;
    }
    let (graph, values) = graph::record(0, |_| {
        formula.evaluate::<graph::Expr>(&mut |_| unreachable!("it has no symbols")).components()
    })
    .ok()?;
    values.into_iter().map(|value| graph.constant_value(value).cloned()).collect()
}

/// Declares free parameters for the coefficients of an arbitrary function.
pub fn coefficients(
    prefix: &str,
    exponents: &[[u32; 3]],
    range: &Range,
    settings: &[Setting],
    parameters: &mut Vec<Parameter>,
) -> Result<(), Mistake> {
    for [i, j, k] in exponents {
        let name = format!("{prefix}[{i},{j},{k}]");
        let origin = match settings.iter().find(|setting| setting.name == name) {
            None => {
                ParameterOrigin::Free(SamplerSpec::Scalar(Draw::Of(NumberLine::All, range.clone())))
            }
            Some(setting) => match setting.value.trim().parse() {
                Ok(value) => ParameterOrigin::Fixed(vec![value]),
                Err(error) => {
                    let error: RationalError = error;
                    return Err(set_to(setting, &error.to_string(), "give a number"));
                }
            },
        };
        parameters.push(Parameter { name, kind: Type::Scalar, origin });
    }
    Ok(())
}

/// Whether this name is declared with this type.
pub fn has(vocabulary: &Vocabulary, name: &str, kind: Type) -> bool {
    vocabulary.lookup(name).is_some_and(|(_, found)| found == kind)
}
