//! Search for cells of any width along lines: all zeros of the parts of formulas on a line through a
//! state, in full precision, and the states between them.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use super::expr::{Expr, Function, Tree};
use super::hint::{Hints, Unseen};
use super::jet::Place;
use super::point::Point;
use super::random::Stream;
use super::real::{Found, Lack, Real, guessed, sure_sign, with_bits};
use super::scene::Scene;
use super::seek;
use super::values::Known;

/// A position in a range: a number and what is far below its last digit.
type Position = (f64, f64);

/// The bits of a position, and whether few bits are asked.
type Address = (u64, u64, bool);

/// Values at a position, and whether a sum in them was taken for 0.
type Beside = Rc<(Found<Vec<Found<Real>>>, bool)>;

/// Sign of a part at a position, if it has one that is known, where there is a state.
type Mark = Option<Option<i32>>;

/// Number of intervals into which a line is divided evenly.
const EVENLY: u32 = 48;
/// Smallest distance, as a power of ten, from the ends, from the state and from 0.
const NEAREST: i32 = 44;
/// Largest number of parts, and of zeros on a line.
const PARTS: usize = 32;
const ZEROS: usize = 40;
/// Largest number of places on a line where states begin or end that are looked at closely.
const ENDS: usize = 6;
/// Number of points drawn for each state.
const DRAWS: usize = 40;
/// Number of bits in which a sign is asked for first.
const ROUGH: usize = 160;
/// Number of halvings.
const HALVINGS: usize = 260;
/// Largest number of states of either kind through which lines are laid.
const STATES: usize = 12;

/// Finds states between the zeros of divisors and of the arguments of roots, moduli and powers on
/// lines along the coordinates, through so many states drawn, and as many found by descents; with
/// `sums`, also between the zeros of sums.
pub fn between_zeros(
    scene: &Scene,
    trees: &[&Tree],
    stream: &mut Stream,
    (starts, sums): (usize, bool),
) -> Vec<Point> {
    let mut parts: Vec<Tree> = Vec::new();
    for tree in trees {
        collect(tree, sums, &mut parts);
    }
    parts.truncate(PARTS);
    let drawn = (0..DRAWS * starts).map(|k| scene.point(stream, k % 2 == 1));
    let mut states: Vec<Point> =
        drawn.filter(|state| scene.rough_values(state).is_some()).take(starts).collect();
    states.extend(seek::thin(scene, trees, stream, (starts, 60)));
    // Those found last are the farthest from where a search began.
    let half = starts.min(states.len());
    let (drawn, found) = states.split_at(half);
    let states = drawn.iter().take(STATES).chain(found.iter().rev().take(STATES));
    let free = scene.free();
    let lines = states.flat_map(|state| free.iter().map(move |place| (state, *place)));
    lines.flat_map(|(from, place)| Line::new(scene, &parts, from, place).states()).collect()
}

/// Collects divisors and the arguments of what has a corner or an end.
fn collect(tree: &Tree, sums: bool, parts: &mut Vec<Tree>) {
    let part = match &**tree {
        Expr::Add(..) | Expr::Sub(..) if sums => Some(tree),
        Expr::Div(_, b) => Some(b),
        Expr::Power(a, ..) | Expr::PowerTo(a, _) => Some(a),
        Expr::Of(Function::Root | Function::Modulus | Function::Log, a) => Some(a),
        _ => None,
    };
    if let Some(part) = part
        && !parts.contains(part)
    {
        parts.push(part.clone());
    }
    for inner in tree.parts() {
        collect(inner, sums, parts);
    }
}

/// A line along a coordinate through a point.
struct Line<'l> {
    scene: &'l Scene,
    parts: &'l [Tree],
    from: &'l Point,
    place: usize,
    /// Signs and lacks that f64 shows.
    hints: Hints<'l>,
    /// Values at the state, in few and in more bits.
    known: [Known; 2],
    /// Whether few bits take a sum in them for 0.
    is_guess: bool,
    /// Values at positions between two, at which several parts may be asked for.
    beside: RefCell<BTreeMap<Address, Beside>>,
}

impl<'l> Line<'l> {
    fn new(scene: &'l Scene, parts: &'l [Tree], from: &'l Point, place: usize) -> Self {
        let (rough, is_guess) = guessed(|| with_bits(ROUGH, || scene.known(from, place)));
        let known = [rough, scene.known(from, place)];
        let hints = Hints::new(scene, from, place);
        let beside = RefCell::default();
        Self { scene, parts, from, place, hints, known, is_guess, beside }
    }

    /// Finds the states between all zeros that are seen.
    fn states(&self) -> Vec<Point> {
        let (mut zeros, ends) = self.zeros(&self.grid());
        // Near the end of what exists another zero may be close.
        for end in ends.into_iter().take(ENDS) {
            zeros.extend(self.zeros(&sorted(near(end).collect())).0);
        }
        zeros.extend([(0.0, 0.0), (1.0, 0.0)]);
        let zeros = sorted(zeros);
        let middles = zeros.windows(2).map(|ends| middle(ends[0], ends[1]));
        middles.map(|at| self.from.at(self.place, at)).collect()
    }

    /// Finds zeros between positions, and the places where states begin or end.
    fn zeros(&self, grid: &[Position]) -> (Vec<Position>, Vec<Position>) {
        let marks: Vec<Vec<Mark>> = grid.iter().map(|at| self.marks(*at)).collect();
        let (mut zeros, mut ends) = (Vec::new(), Vec::new());
        for (sides, seen) in grid.windows(2).zip(marks.windows(2)) {
            self.beside.borrow_mut().clear();
            let pairs = seen[0].iter().zip(&seen[1]).enumerate();
            for (part, (before, after)) in pairs.filter(|(_, (before, after))| before != after) {
                if zeros.len() < ZEROS {
                    let zero = self.halved(sides[0], sides[1], part, *before);
                    zeros.push(zero);
                    if (before.is_none() || after.is_none()) && !ends.contains(&zero) {
                        ends.push(zero);
                    }
                }
            }
        }
        (zeros, ends)
    }

    /// Lists positions, close to each other near the ends, the state and 0.
    fn grid(&self) -> Vec<Position> {
        let (low, high) = self.scene.ends(self.place);
        let zero = -low / (high - low);
        let rest = -zero.mul_add(high - low, low) / (high - low);
        let own = (self.from.cube[self.place], self.from.fine[self.place]);
        let mut all: Vec<Position> =
            (0..=EVENLY).map(|k| (f64::from(k) / f64::from(EVENLY), 0.0)).collect();
        all.extend([(0.0, 0.0), (1.0, 0.0), own, (zero, rest)].into_iter().flat_map(near));
        sorted(all)
    }

    /// Returns the marks of all parts; without parts, still one, which tells where states are.
    fn marks(&self, at: Position) -> Vec<Mark> {
        let count = self.parts.len();
        let open = Err(Unseen::Open);
        let (seen, is_state) = match self.hints.signs(at, self.parts.iter()) {
            Err(Unseen::Lack) => return vec![None; count + 1],
            Err(Unseen::Open) => (vec![open; count], false),
            Ok(seen) => (seen, true),
        };
        if is_state && !seen.contains(&open) {
            return seen.into_iter().map(|sign| Some(sign.ok())).chain([Some(None)]).collect();
        }
        // What f64 shows, more bits would show as well.
        let sign = |values: &[Found<Real>], part: usize| match seen[part] {
            Ok(sign) => Ok(sign),
            Err(Unseen::Lack) => Err(Lack::Value),
            Err(Unseen::Open) => self.sign(values, part),
        };
        match self.seen(at, |values| (0..count).map(|part| sign(values, part)).collect()) {
            Ok(signs) => {
                signs.into_iter().map(|sign| Some(sign.ok())).chain([Some(None)]).collect()
            }
            Err(_) => vec![None; count + 1],
        }
    }

    /// Asks for signs at a position in few bits, and in more where these leave something open: the
    /// lack of a value counts if no sum was taken for 0.
    fn seen(
        &self,
        at: Position,
        signs: impl Fn(&[Found<Real>]) -> Vec<Found<i32>>,
    ) -> Found<Vec<Found<i32>>> {
        let few = self.beside(at, true);
        let (rough, is_guess) = guessed(|| with_bits(ROUGH, || few.0.as_deref().map(&signs)));
        let is_guess = is_guess || few.1 || self.is_guess;
        let is_known = |lack: Option<Lack>| match lack {
            None => true,
            Some(lack) => lack == Lack::Value && !is_guess,
        };
        let is_final = match &rough {
            Ok(signs) => signs.iter().all(|sign| is_known(sign.err())),
            Err(lack) => is_known(Some(**lack)),
        };
        if is_final {
            return rough.map_err(|lack| *lack);
        }
        let more = self.beside(at, false);
        more.0.as_deref().map(signs).map_err(|lack| *lack)
    }

    /// Returns the values at a position in few bits, or in more.
    fn beside(&self, at: Position, few: bool) -> Beside {
        let address = (at.0.to_bits(), at.1.to_bits(), few);
        if let Some(known) = self.beside.borrow().get(&address) {
            return known.clone();
        }
        let point = self.from.at(self.place, at);
        let of = |known: &Known| self.scene.values_beside(known, &point, self.place);
        let [rough, fine] = &self.known;
        let found = guessed(|| if few { with_bits(ROUGH, || of(rough)) } else { of(fine) });
        let found = Rc::new(found);
        self.beside.borrow_mut().insert(address, found.clone());
        found
    }

    fn sign(&self, values: &[Found<Real>], part: usize) -> Found<i32> {
        // A part that is not there has no sign, where there is a state.
        let Some(part) = self.parts.get(part) else { return Err(Lack::Value) };
        (Place { values, along: &[] }).value(part).and_then(|value| sure_sign(&value))
    }

    /// Returns the mark of one part: in few bits where these tell the sign.
    fn mark(&self, at: Position, part: usize) -> Mark {
        match self.hints.signs(at, self.parts.iter().skip(part).take(1)) {
            Err(Unseen::Lack) => return None,
            Err(Unseen::Open) => {}
            Ok(seen) => match seen[..] {
                [Err(Unseen::Open)] => {}
                [sign] => return Some(sign.ok()),
                _ => return Some(None),
            },
        }
        let found = self.seen(at, |values| vec![self.sign(values, part)]).ok()?;
        found.first().map(|sign| sign.ok())
    }

    /// Finds where the mark of a part changes between two positions.
    fn halved(&self, mut a: Position, mut b: Position, part: usize, first: Mark) -> Position {
        for _ in 0..HALVINGS {
            let between = middle(a, b);
            if between == a || between == b {
                break;
            }
            if self.mark(between, part) == first { a = between } else { b = between }
        }
        b
    }
}

/// Lists positions close to one.
fn near(anchor: Position) -> impl Iterator<Item = Position> {
    let offsets = (2..=NEAREST).step_by(3).map(|power| 10f64.powi(-power));
    let both = offsets.flat_map(|offset| [-offset, offset]);
    std::iter::once(anchor).chain(both.map(move |offset| sum(anchor, offset)))
}

/// Adds two floats without an error, in two parts.
fn exact(a: f64, b: f64) -> Position {
    let total = a + b;
    let part = total - a;
    (total, (a - (total - part)) + (b - part))
}

/// Adds a number to a position.
fn sum((cube, fine): Position, more: f64) -> Position {
    let (total, rest) = exact(cube, more);
    exact(total, rest + fine)
}

fn middle(a: Position, b: Position) -> Position {
    let (total, rest) = exact(a.0 / 2.0, b.0 / 2.0);
    exact(total, rest + a.1 / 2.0 + b.1 / 2.0)
}

/// Sorts positions inside the range, without those that are there twice.
fn sorted(all: Vec<Position>) -> Vec<Position> {
    let key = |at: &Position| (at.0.to_bits(), order(at.1));
    let inside = |at: &&Position| {
        at.0 >= 0.0 && at.0 <= 1.0 && (at.0 > 0.0 || at.1 >= 0.0) && (at.0 < 1.0 || at.1 <= 0.0)
    };
    // Positive floats are in the order of their bits.
    let keys: BTreeSet<(u64, i64)> =
        all.iter().filter(inside).map(|at| (at.0 + 0.0, at.1)).map(|at| key(&at)).collect();
    keys.into_iter().map(|(cube, fine)| (f64::from_bits(cube), unordered(fine))).collect()
}

/// Maps floats to integers in the same order.
fn order(x: f64) -> i64 {
    let bits = (x + 0.0).to_bits() as i64;
    if bits < 0 { i64::MIN - bits } else { bits }
}

fn unordered(order: i64) -> f64 {
    let bits = if order < 0 { i64::MIN - order } else { order };
    f64::from_bits(bits as u64)
}
