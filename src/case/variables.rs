//! The tables `[variables]` and `[poisson]`: new variables, and a bracket for them.

use std::borrow::Cow;

use toml::Spanned;

use super::claim_table::stranger;
use super::error::{Mistake, Problem};
use super::formulas::formula;
use super::parameters::named;
use super::section::{CaseTable, SpannedStr};
use super::{Case, ClaimError};
use crate::formula::{Formula, Scope, Type, canonical_name};
use crate::mechanics::{
    BracketBlock, Dependence, Meaning, Model, NewVariables, Poisson, System, Variable, Vocabulary,
};

/// Name of a bracket that is given without one.
const ONLY: &str = "poisson";

/// Name of the bracket of `[hamiltonian]`.
const OWN: &str = "hamiltonian";

/// Reads both tables into the model, if they are present; `false` where there is a mistake.
pub fn read(root: &CaseTable<'_>, model: &mut Model) -> bool {
    let Some(section) = root.table("variables") else {
        if root.value("variables").is_some() {
            return false;
        }
        return state_brackets(root, model);
    };
    let (mut state, mut images, mut broken) = (Vec::new(), Vec::new(), false);
    for (key, value) in section.entries() {
        let read = named(key).and_then(|name| {
            let text = section.as_text(key.get_ref(), value)?;
            let image = formula(&text, &model.vocabulary, &name, None, Dependence::Phase)?;
            Ok((name, image))
        });
        match section.keep(read) {
            Some((name, image)) => {
                state.push(Variable { name, kind: image.value_type(), shape: None });
                images.push(image);
            }
            None => broken = true,
        }
    }
    if broken {
        return false;
    }
    let target = target(model, state, &images);
    let Some(brackets) = brackets(root, &target) else { return false };
    model.variables = Some(Box::new(NewVariables { model: target, images, brackets }));
    true
}

/// Brackets for the state variables themselves, where no new variables are named.
fn state_brackets(root: &CaseTable<'_>, model: &mut Model) -> bool {
    let own = own_bracket(model);
    if root.value("poisson").is_none() {
        model.variables = own.map(Box::new);
        return true;
    }
    let variables = own.or_else(|| {
        let images = own_images(model)?;
        let target = target(model, model.state.clone(), &images);
        Some(NewVariables { model: target, images, brackets: Vec::new() })
    });
    let Some(mut variables) = variables else { return false };
    let Some(brackets) = brackets(root, &variables.model) else { return false };
    variables.brackets.extend(brackets);
    model.variables = Some(Box::new(variables));
    true
}

/// Reads `[poisson]`, one bracket or several with names; `None` where there is a mistake.
fn brackets(root: &CaseTable<'_>, target: &Model) -> Option<Vec<Poisson>> {
    let Some(section) = root.table("poisson") else {
        return root.value("poisson").is_none().then(Vec::new);
    };
    let names = BracketNames {
        state: &target.state,
        vocabulary: &target.vocabulary,
        reach: Dependence::Phase,
    };
    let entries = section.entries();
    let named: Vec<(String, CaseTable<'_>)> = entries
        .iter()
        .filter_map(|(key, value)| {
            Some((key.get_ref().to_string(), section.inner(key.get_ref(), value)?))
        })
        .collect();
    if named.is_empty() {
        let bracket = bracket(ONLY, &section, &names)?;
        return Some(if bracket.is_some() { bracket.into_iter().collect() } else { Vec::new() });
    }
    if named.len() < entries.len() {
        section.mistakes().add(section.complaint(Problem::Other {
            message: "blocks cannot be mixed with named brackets".to_string(),
            remedy: "give every bracket a name: [poisson.P], [poisson.Q]".to_string(),
        }));
        return None;
    }
    let mut all = Vec::new();
    for (name, inner) in named {
        match bracket(&name, &inner, &names)? {
            _ if name == OWN || name.trim() != name => {
                let (name, reason) = (name, "it is taken already".to_string());
                inner.mistakes().add(inner.complaint(Problem::BadName { name, reason }));
                return None;
            }
            Some(bracket) => all.push(bracket),
            None => {
                inner.mistakes().add(inner.complaint(Problem::Other {
                    message: format!("the bracket `{name}` has no block"),
                    remedy: "write \"M,γ\" = \"hat(γ)\" or structure = \"e(3)\"".to_string(),
                }));
                return None;
            }
        }
    }
    Some(all)
}

/// Reads a bracket; `None` within if it has no block.
fn bracket(
    name: &str,
    section: &CaseTable<'_>,
    names: &BracketNames<'_>,
) -> Option<Option<Poisson>> {
    let blocks = blocks(section, names)?;
    let is_given = blocks.iter().flatten().any(Option::is_some);
    Some(is_given.then(|| Poisson { name: name.to_string(), blocks }))
}

/// Each state variable as a formula.
fn own_images(model: &Model) -> Option<Vec<Formula>> {
    let image = |variable: &Variable| Formula::parse(&variable.name, &model.vocabulary).ok();
    model.state.iter().map(image).collect()
}

/// State variables as variables of the bracket that `[hamiltonian]` gives.
fn own_bracket(model: &Model) -> Option<NewVariables> {
    let System::Hamiltonian(hamiltonian) = &model.system else { return None };
    let images = own_images(model)?;
    let target = target(model, model.state.clone(), &images);
    let again = |formula: &Formula| Formula::parse(formula.text(), &target.vocabulary).ok();
    let block = |block: &Option<BracketBlock>| {
        Some(match block {
            Some(BracketBlock::Given(formula)) => Some(BracketBlock::Given(again(formula)?)),
            Some(BracketBlock::Opposite(formula)) => Some(BracketBlock::Opposite(again(formula)?)),
            other => other.clone(),
        })
    };
    let row = |row: &Vec<Option<BracketBlock>>| row.iter().map(block).collect::<Option<Vec<_>>>();
    let blocks = hamiltonian.blocks.iter().map(row).collect::<Option<Vec<_>>>()?;
    let brackets = vec![Poisson { name: OWN.to_string(), blocks }];
    Some(NewVariables { model: target, images, brackets })
}

/// Model whose names functions of the new variables use.
fn target(model: &Model, state: Vec<Variable>, images: &[Formula]) -> Model {
    // A body's quantities depend on the second state variable alone: they keep their meaning as
    // long as that variable stays.
    let stays = |index: usize| {
        let own = model.state.get(index);
        own.is_some_and(|own| {
            state.get(index).is_some_and(|new| new.name == own.name && new.kind == own.kind)
                && images[index].text().trim() == own.name
        })
    };
    let is_body = model.system.body().is_some() || matches!(model.system, System::Ball(_));
    let keeps_body = is_body && stays(1) && state[0].kind == Type::VECTOR;
    let mut names = model.vocabulary.only(|entry| match entry.meaning {
        Meaning::Quantity(quantity) if keeps_body && quantity.is_of_position() => true,
        _ => entry.reach == Dependence::Parameters,
    });
    for (index, variable) in state.iter().enumerate() {
        let position = keeps_body && index == 1;
        let reach = if position { Dependence::Configuration } else { Dependence::Phase };
        names.add(&variable.name, Meaning::State(index), variable.kind, reach);
    }
    model.with_names(names, state)
}

/// Blocks of a bracket, by pairs of variables.
pub type Blocks = Vec<Vec<Option<BracketBlock>>>;

/// Names in which a bracket is written.
pub struct BracketNames<'n> {
    /// Variables of the bracket.
    pub state: &'n [Variable],
    /// Names that formulas may use.
    pub vocabulary: &'n Vocabulary,
    /// Dependence allowed to formulas.
    pub reach: Dependence,
}

/// Reads the blocks of a Poisson tensor; `None` where there is a mistake.
pub fn blocks(section: &CaseTable<'_>, target: &BracketNames<'_>) -> Option<Blocks> {
    let count = target.state.len();
    let mut blocks: Blocks = vec![vec![None; count]; count];
    let mut whole = section.keep(structure(section, target, &mut blocks)).is_some();
    for (key, value) in section.entries().into_iter().filter(|(k, _)| k.get_ref() != "structure") {
        let text = section.as_text(key.get_ref(), value);
        let read = text.and_then(|text| block(key, &text, target, &mut blocks));
        whole &= section.keep(read).is_some();
    }
    whole.then_some(blocks)
}

/// Reads `structure = "e(3)"`.
pub fn structure(
    section: &CaseTable<'_>,
    target: &BracketNames<'_>,
    blocks: &mut Blocks,
) -> Result<(), Mistake> {
    let Some(text) = section.text("structure")? else { return Ok(()) };
    let vectors = target.state.iter().filter(|v| v.kind == Type::VECTOR).count();
    let pairs: &[(usize, usize)] = match (text.value.as_str(), vectors) {
        ("e(3)", 2..) if target.state[1].kind == Type::VECTOR => &[(0, 0), (0, 1)],
        ("so(3)", 1..) => &[(0, 0)],
        (found, _) => {
            let message = format!("`{found}` is not a bracket of these variables");
            let remedy =
                "write \"e(3)\" for two vectors, \"so(3)\" for one, or give blocks".to_string();
            return Err(Mistake::at(text.span, Problem::Other { message, remedy }));
        }
    };
    for (i, j) in pairs {
        let hat = format!("hat({})", target.state[*j].name);
        place(blocks, (*i, *j), parse(&hat, target.vocabulary)?);
    }
    Ok(())
}

/// Reads one entry of `[poisson]`.
fn block(
    key: &Spanned<Cow<'_, str>>,
    text: &SpannedStr,
    target: &BracketNames<'_>,
    blocks: &mut Blocks,
) -> Result<(), Mistake> {
    let index = |name: &str| {
        let name = canonical_name(name.trim())?;
        target.state.iter().position(|variable| variable.name == name)
    };
    let pair = key.get_ref().split_once(',').and_then(|(a, b)| Some((index(a)?, index(b)?)));
    let Some((i, j)) = pair else {
        let message = format!("`{}` is not a pair of the bracket's variables", key.get_ref());
        let remedy = "write \"M,γ\" = \"hat(γ)\"".to_string();
        return Err(Mistake::at(key.span(), Problem::Other { message, remedy }));
    };
    let Some(kind) = block_type(target.state[i].kind, target.state[j].kind) else {
        let message = "a bracket of matrices cannot be given".to_string();
        let remedy = "take the columns as variables".to_string();
        return Err(Mistake::at(key.span(), Problem::Other { message, remedy }));
    };
    if blocks[i][j].is_some() {
        let message = format!("the block {} is given already", key.get_ref());
        let remedy = "give each pair once: the opposite block follows from skewness";
        let problem = Problem::Other { message, remedy: remedy.to_string() };
        return Err(Mistake::at(key.span(), problem));
    }
    let what = format!("the block {}", key.get_ref());
    let read = formula(text, target.vocabulary, &what, Some(kind), target.reach)?;
    place(blocks, (i, j), read);
    Ok(())
}

impl Case {
    /// Returns the same system with new variables, each given by its image in the names of the case,
    /// and no claims.
    ///
    /// # Errors
    /// A name is not one, or is given twice, or an image is in the names of another case.
    pub fn with_variables(&self, images: &[(String, Formula)]) -> Result<Case, ClaimError> {
        let model = &self.model;
        let mut state: Vec<Variable> = Vec::new();
        for (name, image) in images {
            model.vocabulary.check_own(image).map_err(|other| stranger(name, &other))?;
            let canonical = canonical_name(name).ok_or_else(|| {
                let remedy = "write letters, then digits, primes or _";
                ClaimError::new(name, "this is not a name", remedy)
            })?;
            if state.iter().any(|variable| variable.name == canonical) {
                return Err(ClaimError::new(name, "it is given twice", "give each variable once"));
            }
            state.push(Variable { name: canonical, kind: image.value_type(), shape: None });
        }
        let images: Vec<Formula> = images.iter().map(|(_, image)| image.clone()).collect();
        let target = target(model, state, &images);
        let brackets = Vec::new();
        let mut changed = self.with_claims(&[])?;
        changed.model.variables = Some(Box::new(NewVariables { model: target, images, brackets }));
        Ok(changed)
    }

    /// Returns the same case with a bracket of its variables, by blocks for pairs of them; a pair
    /// and its opposite are given once, and entries not given are 0.
    ///
    /// # Errors
    /// The case has no variables, or a block is of the wrong type, given twice, or in other names
    /// than those of the [variables](Case::in_variables).
    pub fn with_bracket(&self, given: &[((usize, usize), Formula)]) -> Result<Case, ClaimError> {
        let mut changed = self.clone();
        let Some(variables) = changed.model.variables.as_deref_mut() else {
            return Err(no_variables("a bracket"));
        };
        let count = variables.model.state.len();
        let mut blocks: Blocks = vec![vec![None; count]; count];
        for ((i, j), block) in given {
            let refuse = |message: String, remedy: &str| {
                Err(ClaimError::new(&format!("the block {i}, {j}"), message, remedy))
            };
            let names = &variables.model.vocabulary;
            names.check_named(block).map_err(|other| stranger("a block", &other))?;
            if *i >= count || *j >= count {
                let message = format!("there are {count} variables");
                return refuse(message, "count them from 0");
            }
            if blocks[*i][*j].is_some() {
                let message = "it is given already".to_string();
                return refuse(message, "give each pair once: the opposite follows from skewness");
            }
            let state = &variables.model.state;
            match block_type(state[*i].kind, state[*j].kind) {
                None => {
                    let message = "a bracket of matrices cannot be given".to_string();
                    return refuse(message, "take the columns as variables");
                }
                Some(kind) if kind != block.value_type() => {
                    let message = format!("it is a {}", block.value_type());
                    return refuse(message, &format!("give a {kind}"));
                }
                Some(_) => place(&mut blocks, (*i, *j), block.clone()),
            }
        }
        let is_given = blocks.iter().flatten().any(Option::is_some);
        let bracket = is_given.then(|| Poisson { name: ONLY.to_string(), blocks });
        variables.brackets = bracket.into_iter().collect();
        Ok(changed)
    }

    /// Returns a formula of the case as one in the names of its variables: a name stands for the
    /// variable of this name.
    ///
    /// # Errors
    /// The case has no variables, or they lack a name of the formula.
    pub fn in_variables(&self, formula: &Formula) -> Result<Formula, ClaimError> {
        let Some(variables) = self.model.variables.as_deref() else {
            return Err(no_variables("a formula"));
        };
        let names = &variables.model.vocabulary;
        self.model.vocabulary.check_own(formula).map_err(|other| stranger("a formula", &other))?;
        let mut unknown = String::new();
        let found = formula.with_symbols(|_, name, kind| match names.lookup(name) {
            Some((symbol, found)) if found == kind => Some(symbol),
            _ => {
                unknown = name.to_string();
                None
            }
        });
        found.ok_or_else(|| stranger("a formula", &unknown))
    }
}

fn no_variables(what: &str) -> ClaimError {
    ClaimError::new(what, "the case has no variables", "add some by `with_variables`")
}

/// Type of the block of a bracket for two variables; `None` for matrices.
fn block_type(a: Type, b: Type) -> Option<Type> {
    match (a, b) {
        (Type::Vector(rows), Type::Vector(columns)) => Some(Type::Matrix(rows, columns)),
        (Type::Scalar, Type::Scalar) => Some(Type::Scalar),
        (Type::Matrix(..), _) | (_, Type::Matrix(..)) => None,
        (Type::Vector(length), _) | (_, Type::Vector(length)) => Some(Type::Vector(length)),
    }
}

fn parse(text: &str, names: &Vocabulary) -> Result<Formula, Mistake> {
    Formula::parse(text, names).map_err(|error| Mistake::whole(Problem::Formula(error)))
}

/// Enters a block, and its opposite.
fn place(blocks: &mut [Vec<Option<BracketBlock>>], (i, j): (usize, usize), block: Formula) {
    if i != j {
        blocks[j][i] = Some(BracketBlock::Opposite(block.clone()));
    }
    blocks[i][j] = Some(BracketBlock::Given(block));
}
