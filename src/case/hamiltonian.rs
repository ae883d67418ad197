//! The table `[hamiltonian]`: a function, and a bracket by canonical pairs and by blocks.

use toml::Spanned;
use toml::de::DeValue;

use super::error::{Mistake, Problem};
use super::formulas::formula;
use super::order::Stage;
use super::section::CaseTable;
use super::systems::Reading;
use super::variables::{Blocks, BracketNames, blocks, structure};
use crate::formula::{Type, canonical_name};
use crate::mechanics::{
    BracketBlock, Chart, Dependence, HamiltonianSystem, System, TIME, Variable, of_hamiltonian,
};

const PAIRS: &str = "write pairs = [[\"q\",\"p\"]], two state variables of one kind in each";

/// Reads a system given by `[hamiltonian]`; `None` where there is a mistake.
pub fn system(reading: &mut Reading<'_, '_>) -> Option<(System, Chart)> {
    reading.own_state(
        Dependence::Configuration,
        "add a table [state] with q = \"-2..2\", p = \"-2..2\" for each pair",
    );
    if let Some(rates) = reading.root.table("field") {
        rates.mistakes().add(rates.complaint(Problem::Other {
            message: "[hamiltonian] and [field] both give the rates".to_string(),
            remedy: "remove one of them".to_string(),
        }));
    }
    let section = reading.root.table("hamiltonian")?;
    for (name, quantity, kind, reach) in of_hamiltonian() {
        reading.name(name, quantity, kind, reach);
    }
    reading.settle(Stage::State);
    let system = read(reading, &section);
    let level = reading.read_level();
    reading.level = level?;
    Some((system?, Chart::Free))
}

/// Reads the table.
fn read(reading: &Reading<'_, '_>, section: &CaseTable<'_>) -> Option<System> {
    let (vocabulary, state) = (&reading.vocabulary, &reading.state.variables);
    let function =
        section.required("function", "add function = \"p²/2 + q²/2\"").and_then(|text| {
            formula(
                &text,
                vocabulary,
                "the Hamiltonian",
                Some(Type::Scalar),
                Dependence::Configuration,
            )
        });
    let function = section.keep(function);
    let names = BracketNames { state, vocabulary, reach: Dependence::Configuration };
    let bracket = section.keep(section.section("bracket"));
    let blocks = match bracket.as_ref().map(Option::as_ref) {
        Some(Some(bracket)) => blocks(bracket, &names),
        Some(None) => Some(vec![vec![None; state.len()]; state.len()]),
        None => None,
    };
    let blocks = blocks.and_then(|mut blocks| {
        section.keep(structure(section, &names, &mut blocks))?;
        section.keep(pairs(section, state, &mut blocks))?;
        section.keep(all_move(section, state, &blocks))?;
        Some(blocks)
    });
    section.finish();
    let (function, blocks) = (function?, blocks?);
    let clock = state.iter().enumerate().position(|(index, v)| is_clock(v, index, &blocks));
    Some(System::Hamiltonian(Box::new(HamiltonianSystem { function, blocks, clock })))
}

/// Enters the canonical pairs.
fn pairs(section: &CaseTable<'_>, state: &[Variable], blocks: &mut Blocks) -> Result<(), Mistake> {
    let Some(value) = section.value("pairs") else { return Ok(()) };
    let wrong = |item: &Spanned<DeValue<'_>>, message: String| {
        Mistake::at(item.span(), Problem::Other { message, remedy: PAIRS.to_string() })
    };
    let DeValue::Array(list) = value.get_ref() else {
        return Err(wrong(value, "`pairs` is a list of pairs".to_string()));
    };
    for item in list {
        let names: Vec<&str> = list.iter().filter_map(|own| own.get_ref().as_str()).collect();
        if let ([q, p], 2) = (names.as_slice(), list.len()) {
            let (message, remedy) = ("this is not a pair".to_string(), PAIRS.to_string());
            let own = format!("pairs = [[\"{q}\",\"{p}\"]]");
            let remedy = remedy.replace("pairs = [[\"q\",\"p\"]]", &own);
            return Err(Mistake::at(value.span(), Problem::Other { message, remedy }));
        }
        let both = match item.get_ref() {
            DeValue::Array(both) if both.len() == 2 => both,
            _ => return Err(wrong(item, "this is not a pair".to_string())),
        };
        let index = |place: usize| {
            let text = section.as_text("pairs", &both[place])?;
            let name = canonical_name(&text.value).unwrap_or_default();
            let found = state.iter().position(|variable| variable.name == name);
            found.ok_or_else(|| {
                let (name, remedy) = (text.value.clone(), PAIRS.to_string());
                Mistake::at(both[place].span(), Problem::NotAVariable { name, remedy })
            })
        };
        let (q, p) = (index(0)?, index(1)?);
        if q == p {
            return Err(wrong(item, format!("`{}` is paired with itself", state[q].name)));
        }
        if state[q].kind != state[p].kind {
            let (first, second) = (state[q].kind, state[p].kind);
            return Err(wrong(item, format!("a {first} is paired with a {second}")));
        }
        if blocks[q][p].is_some() {
            let names = format!("`{}` and `{}`", state[q].name, state[p].name);
            return Err(wrong(item, format!("the bracket of {names} is given already")));
        }
        blocks[q][p] = Some(BracketBlock::Unit);
        blocks[p][q] = Some(BracketBlock::OppositeUnit);
    }
    Ok(())
}

/// Rejects a variable without any bracket: it would be constant, so it is a parameter, or was
/// forgotten.
fn all_move(section: &CaseTable<'_>, state: &[Variable], blocks: &Blocks) -> Result<(), Mistake> {
    let stands = |(index, variable): &(usize, &Variable)| {
        blocks[*index].iter().all(Option::is_none) && !is_clock(variable, *index, blocks)
    };
    match state.iter().enumerate().find(stands) {
        None => Ok(()),
        Some((_, variable)) => Err(section.complaint(Problem::Other {
            message: format!("`{}` has no bracket with any variable", variable.name),
            remedy: format!(
                "name it in pairs = [[\"q\",\"p\"]], or give bracket = {{ \"{0},{0}\" = \"…\" }} or \
                 structure = \"e(3)\"; what never moves is a parameter",
                variable.name
            ),
        })),
    }
}

/// Whether the variable is time, without a bracket; its rate is 1.
fn is_clock(variable: &Variable, index: usize, blocks: &Blocks) -> bool {
    let is_free = blocks[index].iter().all(Option::is_none);
    variable.name == TIME && variable.kind == Type::Scalar && is_free
}
