//! The tables `[variables]` and `[poisson]`: new variables, and a bracket for them.

use std::borrow::Cow;

use toml::Spanned;

use super::error::{Mistake, Problem};
use super::formulas::formula;
use super::parameters::named;
use super::section::{Section, Text};
use crate::formula::{Formula, Type, canonical_name};
use crate::mechanics::{Block, Meaning, Model, Reach, System, Variable, Variables, Vocabulary};

/// Reads both tables into the model, if they are present; `false` where there is a mistake.
pub fn read(root: &Section<'_>, model: &mut Model) -> bool {
    let Some(section) = root.table("variables") else {
        if let Some(section) = root.table("poisson") {
            root.mistakes().add(section.complaint(Problem::Other {
                message: "[poisson] is a bracket for new variables".to_string(),
                remedy: "add [variables], e.g. M = \"Ĩ*ω\", \"γ\" = \"γ\"".to_string(),
            }));
        } else if root.value("variables").is_none() {
            model.variables = own_bracket(model).map(Box::new);
        }
        return root.value("variables").is_none() && root.value("poisson").is_none();
    };
    let (mut state, mut images, mut broken) = (Vec::new(), Vec::new(), false);
    for (key, value) in section.entries() {
        let read = named(key).and_then(|name| {
            let text = section.as_text(key.get_ref(), value)?;
            let image = formula(&text, &model.vocabulary, &name, None, Reach::Phase)?;
            Ok((name, image))
        });
        match section.keep(read) {
            Some((name, image)) => {
                state.push(Variable { name, kind: image.value_type() });
                images.push(image);
            }
            None => broken = true,
        }
    }
    if broken {
        return false;
    }
    let target = target(model, state, &images);
    let blocks = match root.table("poisson") {
        Some(section) => {
            let names =
                Names { state: &target.state, vocabulary: &target.vocabulary, reach: Reach::Phase };
            blocks(&section, &names)
        }
        None => Some(vec![vec![None; target.state.len()]; target.state.len()]),
    };
    let Some(blocks) = blocks else { return false };
    model.variables = Some(Box::new(Variables { model: target, images, blocks }));
    root.value("poisson").is_none_or(|value| value.get_ref().is_table())
}

/// State variables as variables of the bracket that `[hamiltonian]` gives.
fn own_bracket(model: &Model) -> Option<Variables> {
    let System::Hamiltonian(hamiltonian) = &model.system else { return None };
    let image = |variable: &Variable| Formula::parse(&variable.name, &model.vocabulary).ok();
    let images: Vec<Formula> = model.state.iter().map(image).collect::<Option<_>>()?;
    let target = target(model, model.state.clone(), &images);
    let again = |formula: &Formula| Formula::parse(formula.text(), &target.vocabulary).ok();
    let block = |block: &Option<Block>| {
        Some(match block {
            Some(Block::Given(formula)) => Some(Block::Given(again(formula)?)),
            Some(Block::Opposite(formula)) => Some(Block::Opposite(again(formula)?)),
            other => other.clone(),
        })
    };
    let row = |row: &Vec<Option<Block>>| row.iter().map(block).collect::<Option<Vec<_>>>();
    let blocks = hamiltonian.blocks.iter().map(row).collect::<Option<Vec<_>>>()?;
    Some(Variables { model: target, images, blocks })
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
        _ => entry.reach == Reach::Parameters,
    });
    for (index, variable) in state.iter().enumerate() {
        let position = keeps_body && index == 1;
        let reach = if position { Reach::Configuration } else { Reach::Phase };
        names.add(&variable.name, Meaning::State(index), variable.kind, reach);
    }
    model.with_names(names, state)
}

/// Blocks of a bracket, by pairs of variables.
pub type Blocks = Vec<Vec<Option<Block>>>;

/// Names in which a bracket is written.
pub struct Names<'n> {
    /// Variables of the bracket.
    pub state: &'n [Variable],
    /// Names that formulas may use.
    pub vocabulary: &'n Vocabulary,
    /// Dependence allowed to formulas.
    pub reach: Reach,
}

/// Reads the blocks of a Poisson tensor; `None` where there is a mistake.
pub fn blocks(section: &Section<'_>, target: &Names<'_>) -> Option<Blocks> {
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
fn structure(
    section: &Section<'_>,
    target: &Names<'_>,
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
    text: &Text,
    target: &Names<'_>,
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
    let kind = match (target.state[i].kind, target.state[j].kind) {
        (Type::Vector(rows), Type::Vector(columns)) => Type::Matrix(rows, columns),
        (Type::Scalar, Type::Scalar) => Type::Scalar,
        (Type::Matrix(..), _) | (_, Type::Matrix(..)) => {
            let message = "a bracket of matrices cannot be given".to_string();
            let remedy = "take the columns as variables".to_string();
            return Err(Mistake::at(key.span(), Problem::Other { message, remedy }));
        }
        (Type::Vector(length), _) | (_, Type::Vector(length)) => Type::Vector(length),
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

fn parse(text: &str, names: &Vocabulary) -> Result<Formula, Mistake> {
    Formula::parse(text, names).map_err(|error| Mistake::whole(Problem::Formula(error)))
}

/// Enters a block, and its opposite.
fn place(blocks: &mut [Vec<Option<Block>>], (i, j): (usize, usize), block: Formula) {
    if i != j {
        blocks[j][i] = Some(Block::Opposite(block.clone()));
    }
    blocks[i][j] = Some(Block::Given(block));
}
