//! Claims, as text and as evaluated by the oracle at a state.

use super::expr::{Tree, neg};
use super::jet::{Jet, Place};
use super::print::Hand;
use super::real::{
    Found, LADDER, Lack, Real, difference, height, is_zero, modulus, nearest, number, sum,
    sure_sign, whole, with_bits,
};
use super::scene::{Origin, Scene};

/// Values of the symbols of a scene.
pub type Values = Vec<Found<Real>>;

/// A claim about a scene.
#[derive(Clone, Debug)]
pub enum Claim {
    Identity(Tree, Tree),
    Integral(Tree),
    Rate(Tree, Tree),
    Density(Tree),
    /// Function F with its cofactor.
    Relation(Tree, Tree),
    SymmetryField(Vec<(usize, Tree)>),
    Independent(Vec<Tree>),
    /// Function, its limit, and the parameter that tends to 0 from above.
    Limit(Tree, Tree, usize),
}

/// Result at a state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum At {
    /// A zero residual.
    Zero,
    /// A nonzero residual of about this size.
    Off(f64),
    /// No residual.
    Without(Lack),
}

impl Claim {
    /// Returns the key of the statement.
    pub fn kind(&self) -> &'static str {
        match self {
            Claim::Identity(..) => "identity",
            Claim::Integral(_) => "integral",
            Claim::Rate(..) => "rate",
            Claim::Density(_) => "density",
            Claim::Relation(..) => "invariant-relation",
            Claim::SymmetryField(_) => "symmetry-field",
            Claim::Independent(_) => "independent",
            Claim::Limit(..) => "limit",
        }
    }

    /// Whether the claim is proved by one state at which the residual is not 0.
    pub fn is_negated(&self) -> bool {
        matches!(self, Claim::Independent(_))
    }

    /// Returns all formulas.
    pub fn trees(&self) -> Vec<&Tree> {
        match self {
            Claim::Identity(a, b) | Claim::Rate(a, b) | Claim::Relation(a, b) => vec![a, b],
            Claim::Limit(a, b, _) => vec![a, b],
            Claim::Integral(a) | Claim::Density(a) => vec![a],
            Claim::SymmetryField(parts) => parts.iter().map(|(_, tree)| tree).collect(),
            Claim::Independent(list) => list.iter().collect(),
        }
    }

    /// Makes the same claim about other formulas.
    pub fn with_trees(&self, trees: &[Tree]) -> Self {
        let tree = |k: usize| trees[k].clone();
        match self {
            Claim::Identity(..) => Claim::Identity(tree(0), tree(1)),
            Claim::Rate(..) => Claim::Rate(tree(0), tree(1)),
            Claim::Relation(..) => Claim::Relation(tree(0), tree(1)),
            Claim::Limit(_, _, by) => Claim::Limit(tree(0), tree(1), *by),
            Claim::Integral(_) => Claim::Integral(tree(0)),
            Claim::Density(_) => Claim::Density(tree(0)),
            Claim::SymmetryField(parts) => {
                let place = |(k, (place, _)): (usize, &(usize, Tree))| (*place, tree(k));
                Claim::SymmetryField(parts.iter().enumerate().map(place).collect())
            }
            Claim::Independent(_) => Claim::Independent(trees.to_vec()),
        }
    }

    /// Writes the body of the claim's table.
    pub fn body(&self, names: &[String], hand: Hand) -> String {
        let text = |tree: &Tree| hand.text(tree, names);
        match self {
            Claim::Identity(a, b) => format!("identity = \"{} = {}\"", text(a), text(b)),
            Claim::Integral(a) => format!("integral = \"{}\"", text(a)),
            Claim::Rate(a, b) => format!("rate = \"{}\"\nequals = \"{}\"", text(a), text(b)),
            Claim::Density(a) => format!("density = \"{}\"", text(a)),
            Claim::Relation(a, b) => {
                format!("invariant-relation = \"{}\"\ncofactor = \"{}\"", text(a), text(b))
            }
            Claim::SymmetryField(parts) => {
                let part = |(place, tree): &(usize, Tree)| {
                    format!("{} = \"{}\"", names[*place], text(tree))
                };
                let parts: Vec<String> = parts.iter().map(part).collect();
                format!("symmetry-field = {{ {} }}", parts.join(", "))
            }
            Claim::Independent(list) => {
                let list: Vec<String> =
                    list.iter().map(|tree| format!("\"{}\"", text(tree))).collect();
                format!("independent = [{}]", list.join(", "))
            }
            Claim::Limit(a, b, by) => {
                let (a, b) = (text(a), text(b));
                format!("limit = \"{a}\"\nequals = \"{b}\"\nparameter = \"{}\"", names[*by])
            }
        }
    }

    /// Evaluates the claim at a state with these values of the symbols, in as many bits as decide.
    ///
    /// The values are made anew in each precision; `None` if they are not a state.
    pub fn settled(&self, scene: &Scene, values: &dyn Fn() -> Option<Values>) -> Option<At> {
        let mut found = None;
        for bits in LADDER {
            found = with_bits(bits, || values().map(|values| self.at(scene, &values)));
            if !matches!(found, Some(At::Without(Lack::Digits))) {
                break;
            }
        }
        found
    }

    /// Evaluates the claim at a state with these values of the symbols.
    pub fn at(&self, scene: &Scene, values: &[Found<Real>]) -> At {
        let found = match self {
            Claim::Limit(a, b, by) => return limit(a, b, *by, scene, values),
            _ => self.residuals(scene, values),
        };
        match found {
            Err(lack) => At::Without(lack),
            Ok(list) => {
                let largest = list.iter().max_by_key(|x| height(x)).filter(|x| !is_zero(x));
                match (largest, scene.lack_elsewhere(values, &self.trees())) {
                    (_, Err(lack)) => At::Without(lack),
                    (None, Ok(())) => At::Zero,
                    (Some(largest), Ok(())) => match sure_sign(largest) {
                        Ok(_) => At::Off(nearest(&modulus(largest))),
                        Err(lack) => At::Without(lack),
                    },
                }
            }
        }
    }

    fn residuals(&self, scene: &Scene, values: &[Found<Real>]) -> Found<Vec<Real>> {
        let states = scene.states();
        let place = Place { values, along: &states };
        let plain = Place { values, along: &[] };
        let still = whole(0);
        // What does not move is constant along the motion: |z| has the rate 0 where z' is 0.
        let flow = Direction::of(&plain, scene.field.iter().map(|(at, rate)| (*at, rate)))?;
        match self {
            Claim::Identity(a, b) => {
                let (a, b) = super::real::both(plain.value(a), plain.value(b))?;
                Ok(vec![difference(&a, &b)?])
            }
            Claim::Integral(f) if flow.is_at_rest() => plain.value(f).map(|_| vec![still]),
            Claim::Integral(f) => Ok(vec![flow.rate(values, f)?]),
            Claim::Rate(f, g) if flow.is_at_rest() => {
                let (_, g) = super::real::both(plain.value(f), plain.value(g))?;
                Ok(vec![g])
            }
            Claim::Rate(f, g) => {
                let (f, g) = super::real::both(flow.rate(values, f), plain.value(g))?;
                Ok(vec![difference(&f, &g)?])
            }
            Claim::Relation(f, cofactor) => {
                let (value, cofactor) = super::real::both(plain.value(f), plain.value(cofactor))?;
                let rate = if flow.is_at_rest() { still } else { flow.rate(values, f)? };
                Ok(vec![difference(&rate, &(cofactor * value))?])
            }
            Claim::Density(f) => {
                let value = plain.value(f)?;
                let relative = super::real::quotient(&flow.rate(values, f)?, &value)?;
                let diverging = |total: Real, (place, rate): (usize, &Tree)| {
                    let own = Place { values, along: &[place] }.jet(rate)?;
                    sum(&total, &own.slopes[0])
                };
                let field = scene.field.iter().map(|(place, rate)| (*place, rate));
                Ok(vec![field.into_iter().try_fold(relative, diverging)?])
            }
            Claim::SymmetryField(parts) => {
                let own = Direction::of(&plain, parts.iter().map(|(at, rate)| (*at, rate)))?;
                let mut found = Vec::new();
                for place in &states {
                    let along = |by: &Direction, of: Option<&Tree>| match of {
                        Some(of) => by.rate(values, of),
                        None => Ok(still.clone()),
                    };
                    let part = parts.iter().find(|(at, _)| at == place).map(|(_, tree)| tree);
                    let turned = along(&own, scene.rate(*place))?;
                    found.push(difference(&turned, &along(&flow, part)?)?);
                }
                for (a, b) in scene.level.iter().flat_map(|level| &level.equations) {
                    found.push(own.rate(values, &super::expr::add(a, &neg(b)))?);
                }
                Ok(found)
            }
            Claim::Independent(list) => {
                let mut rows: Vec<Vec<Real>> =
                    gradients(scene, &place)?.into_iter().map(|jet| jet.slopes).collect();
                for tree in list {
                    rows.push(place.jet(tree)?.slopes);
                }
                let full = rank(rows.clone())? == rows.len();
                Ok(vec![whole(i64::from(full))])
            }
            Claim::Limit(..) => Err(Lack::Decision),
        }
    }
}

/// A vector at a state: the variables that it changes, with their rates.
///
/// A variable whose rate is written as 0 is not among them.
struct Direction {
    along: Vec<usize>,
    rates: Vec<Real>,
}

impl Direction {
    fn of<'t>(place: &Place<'_>, field: impl Iterator<Item = (usize, &'t Tree)>) -> Found<Self> {
        let (mut along, mut rates) = (Vec::new(), Vec::new());
        for (at, rate) in field {
            if !rate.is(0) {
                along.push(at);
                rates.push(place.value(rate)?);
            }
        }
        Ok(Self { along, rates })
    }

    /// Whether the vector is 0.
    fn is_at_rest(&self) -> bool {
        self.rates.iter().all(is_zero)
    }

    /// Differentiates an expression along the vector.
    fn rate(&self, values: &[Found<Real>], of: &Tree) -> Found<Real> {
        let slopes = Place { values, along: &self.along }.jet(of)?.slopes;
        let parts = slopes.iter().zip(&self.rates);
        parts.into_iter().try_fold(whole(0), |total, (slope, rate)| sum(&total, &(slope * rate)))
    }
}

/// Computes the level functions with their gradients.
pub fn gradients(scene: &Scene, place: &Place<'_>) -> Found<Vec<Jet>> {
    let equations = scene.level.iter().flat_map(|level| &level.equations);
    equations.map(|(a, b)| place.jet(&super::expr::add(a, &neg(b)))).collect()
}

/// Computes the rank of some rows.
fn rank(mut rows: Vec<Vec<Real>>) -> Found<usize> {
    let mut found = 0;
    let columns = rows.first().map_or(0, Vec::len);
    while found < rows.len() {
        let all = (found..rows.len()).flat_map(|r| (0..columns).map(move |c| (r, c)));
        let Some((r, c)) = all.max_by_key(|(r, c)| height(&rows[*r][*c])) else { break };
        if sure_sign(&rows[r][c])? == 0 {
            break;
        }
        rows.swap(found, r);
        let (above, below) = rows.split_at_mut(found + 1);
        let pivot = &above[found];
        for row in below {
            let factor = &row[c] / &pivot[c];
            for (column, (entry, by)) in row.iter_mut().zip(pivot).enumerate() {
                *entry = match column == c {
                    true => whole(0),
                    false => difference(entry, &(&factor * by))?,
                };
            }
        }
        found += 1;
    }
    Ok(found)
}

/// Tests whether a function tends to its limit, from each side on which it has values.
fn limit(a: &Tree, b: &Tree, by: usize, scene: &Scene, values: &[Found<Real>]) -> At {
    let sides = [1, -1].map(|side| from_one_side(a, b, (by, side), scene, values));
    match sides {
        [At::Without(Lack::Value), side] | [side, At::Without(Lack::Value)] => side,
        [At::Zero, At::Zero] => At::Zero,
        [At::Off(above), At::Off(below)] => At::Off(above.max(below)),
        // The sides differ, and the claim does not state which is meant.
        _ => At::Without(Lack::Decision),
    }
}

/// Tests the steps 10^-12, 10^-24, 10^-36 on one side.
fn from_one_side(
    a: &Tree,
    b: &Tree,
    (by, side): (usize, i64),
    scene: &Scene,
    values: &[Found<Real>],
) -> At {
    let mut gaps: Vec<f64> = Vec::new();
    let mut scale: f64 = 1.0;
    for tens in [-12, -24, -36] {
        let mut values = values.to_vec();
        values[by] = Ok(number(super::expr::Number { top: side, bottom: 1, tens }));
        for (place, symbol) in scene.symbols.iter().enumerate() {
            if let Origin::Formula(tree) = &symbol.origin {
                values[place] = Place { values: &values, along: &[] }.value(tree);
            }
        }
        let place = Place { values: &values, along: &[] };
        let found = super::real::both(place.value(a), place.value(b));
        let gap = found.and_then(|(a, b)| {
            scale = scale.max(nearest(&modulus(&b)));
            difference(&a, &b)
        });
        match gap {
            Ok(gap) => gaps.push(nearest(&modulus(&gap))),
            Err(lack) => return At::Without(lack),
        }
    }
    let [_, near, nearer] = gaps[..] else { return At::Without(Lack::Decision) };
    match () {
        () if nearer <= 1e-7 * scale && nearer <= near => At::Zero,
        () if nearer >= 1e-3 * scale && nearer >= 0.5 * near => At::Off(nearer),
        () => At::Without(Lack::Decision),
    }
}
