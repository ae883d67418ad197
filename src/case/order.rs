//! Resolution of parameters and abbreviations, in any order: each is read after those
//! that it uses.

use std::ops::Range;

use toml::Spanned;
use toml::de::DeValue;

use super::error::{Mistake, Problem};
use super::mistakes::bases;
use super::section::SpannedStr;
use super::stated::Time;
use super::systems::Reading;
use crate::formula::canonical_name;
use crate::mechanics::TIME;

/// Name of `[parameters]` or `[let]` that waits for the names it uses.
pub struct WaitingName<'s> {
    /// Canonical name.
    pub name: String,
    /// Place of the name in the file.
    pub key: Range<usize>,
    /// Definition of the name.
    pub kind: ItemKind<'s>,
    state: WaitingState,
}

/// Definition of a name.
#[derive(Clone)]
pub enum ItemKind<'s> {
    /// A parameter, by its number, with its value.
    Parameter(usize, &'s Spanned<DeValue<'s>>),
    /// An abbreviation, with its formula.
    Abbreviation(SpannedStr),
}

/// Stage of reading a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Only parameters have names; abbreviations are read if a parameter uses them.
    Parameters,
    /// The state and the quantities of the system have names.
    State,
    /// Rates have names too.
    Rates,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum WaitingState {
    Pending,
    /// Being read; waits for the items above it on the stack.
    Open,
    Done,
    Failed,
    /// Uses a name that is not defined at this stage.
    Later,
}

/// Whether a name is that of a reaction, if there are as many constraints.
fn is_reaction(name: &str) -> bool {
    let name = canonical_name(name).unwrap_or_default();
    name.strip_prefix('μ').is_some_and(|index| index.chars().all(|c| c.is_ascii_digit()))
}

/// Whether a formula cannot be read as it uses time.
fn lacks_time(mistake: &Mistake) -> bool {
    mistake.unknown_name() == Some(TIME)
}

impl<'s> WaitingName<'s> {
    /// A name that has not been read yet.
    pub fn new(name: String, key: Range<usize>, kind: ItemKind<'s>) -> Self {
        Self { name, key, kind, state: WaitingState::Pending }
    }
}

impl Reading<'_, '_> {
    /// Notes the names that are read from here on, and those of `[state]`: until then they are not taken for
    /// numbers such as π or for components such as `v1`.
    pub(super) fn await_names(&mut self) {
        let state = self.root.value("state").and_then(|value| value.get_ref().as_table());
        let keys = state.into_iter().flat_map(|table| table.keys());
        let of_state = keys.filter_map(|key| canonical_name(key.get_ref()));
        let items = self.items.iter().map(|item| item.name.clone());
        for name in of_state.chain(items).collect::<Vec<_>>() {
            self.vocabulary.await_name(&name);
        }
    }

    /// Reads all names that can be read at this stage.
    pub(super) fn settle(&mut self, stage: Stage) {
        for item in &mut self.items {
            if item.state == WaitingState::Later {
                item.state = WaitingState::Pending;
            }
        }
        for start in 0..self.items.len() {
            let is_parameter = matches!(self.items[start].kind, ItemKind::Parameter(..));
            let begins = is_parameter == (stage == Stage::Parameters);
            if begins && self.items[start].state == WaitingState::Pending {
                self.settle_from(start, stage);
            }
        }
        let waits =
            |item: &&WaitingName<'_>| stage == Stage::State && item.state == WaitingState::Later;
        let names = self.items.iter().filter(waits).map(|item| item.name.clone());
        self.mistakes().wait_for(names.collect());
    }

    /// Reads a name after those that it uses.
    fn settle_from(&mut self, start: usize, stage: Stage) {
        let mut stack = vec![start];
        while let Some(&top) = stack.last() {
            self.items[top].state = WaitingState::Open;
            let read = self.read_item(top, stage);
            let end = match read {
                Ok(()) => WaitingState::Done,
                Err(mistake) => match self.item_of(&mistake) {
                    Some(other) if self.items[other].state == WaitingState::Pending => {
                        stack.push(other);
                        continue;
                    }
                    Some(other) if self.items[other].state == WaitingState::Open => {
                        self.cycle(&stack, other);
                        for item in &stack {
                            self.give_up(*item);
                        }
                        return;
                    }
                    Some(other) if self.items[other].state == WaitingState::Later => {
                        self.later(top, other, stage)
                    }
                    Some(other) if self.items[other].state == WaitingState::Failed => {
                        match self.mistakes().is_left_out(&self.items[other].name) {
                            true => self.leave_out(top, mistake),
                            false => self.give_up(top),
                        }
                        WaitingState::Failed
                    }
                    _ => self.trouble(top, mistake, stage),
                },
            };
            self.items[top].state = end;
            stack.pop();
        }
    }

    fn read_item(&mut self, item: usize, stage: Stage) -> Result<(), Mistake> {
        match self.items[item].kind.clone() {
            ItemKind::Parameter(index, value) => self.read_parameter(index, item, value),
            ItemKind::Abbreviation(text) => self.abbreviate(item, &text, stage),
        }
    }

    /// Item whose name is missing where a formula cannot be read, if it is pending.
    fn item_of(&self, mistake: &Mistake) -> Option<usize> {
        let written = mistake.unknown_name()?;
        let name = canonical_name(written).unwrap_or_else(|| written.to_string());
        bases(&name).find_map(|base| self.items.iter().position(|item| item.name == base))
    }

    fn give_up(&mut self, item: usize) {
        self.items[item].state = WaitingState::Failed;
        self.mistakes().fail(&self.items[item].name);
    }

    /// Handles a name that uses another which cannot be read at this stage.
    fn later(&mut self, item: usize, other: usize, stage: Stage) -> WaitingState {
        if stage != Stage::Parameters || matches!(self.items[item].kind, ItemKind::Abbreviation(_))
        {
            return WaitingState::Later;
        }
        let (name, used) = (&self.items[item].name, &self.items[other].name);
        let message =
            format!("the parameter `{name}` uses `{used}`, which depends on more than parameters");
        let remedy = format!("move `{name}` to [let]");
        let span = self.items[item].key.clone();
        self.mistakes().add(Mistake::at(span, Problem::Other { message, remedy }));
        self.give_up(item);
        WaitingState::Failed
    }

    /// Handles a name that cannot be read for another reason.
    fn trouble(&mut self, item: usize, mistake: Mistake, stage: Stage) -> WaitingState {
        let is_abbreviation = matches!(self.items[item].kind, ItemKind::Abbreviation(_));
        let is_rate = |name: &str| {
            let name = canonical_name(name).unwrap_or_default();
            let variables = &self.state.variables;
            bases(&name).any(|base| {
                base.strip_suffix('\'')
                    .is_some_and(|base| variables.iter().any(|variable| variable.name == base))
            })
        };
        let waits = match stage {
            // the state may define the name
            Stage::Parameters => is_abbreviation && mistake.unknown_name().is_some(),
            Stage::State => mistake
                .unknown_name()
                .is_some_and(|name| is_rate(name) || (self.awaits_reactions && is_reaction(name))),
            Stage::Rates => false,
        };
        if waits {
            return WaitingState::Later;
        }
        match is_abbreviation && self.assumed.time == Time::Absent && lacks_time(&mistake) {
            true => self.leave_out(item, mistake),
            false => {
                self.mistakes().add(mistake);
                self.give_up(item);
            }
        }
        WaitingState::Failed
    }

    /// Leaves out an abbreviation that uses time; a parameter cannot.
    fn leave_out(&mut self, item: usize, mistake: Mistake) {
        match &self.items[item].kind {
            ItemKind::Abbreviation(_) => {
                self.items[item].state = WaitingState::Failed;
                self.mistakes().leave_out(&self.items[item].name);
            }
            ItemKind::Parameter(..) => {
                self.mistakes().add(mistake);
                self.give_up(item);
            }
        }
    }

    /// Reports that a name is defined in terms of itself.
    fn cycle(&self, stack: &[usize], first: usize) {
        let start = stack.iter().position(|item| *item == first).unwrap_or_default();
        let around = stack[start..].iter().chain([&first]);
        let names: Vec<&str> = around.map(|item| self.items[*item].name.as_str()).collect();
        let problem = Problem::Cycle(names[0].to_string(), names.join(" → "));
        self.mistakes().add(Mistake::at(self.items[first].key.clone(), problem));
    }
}
