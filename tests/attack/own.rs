//! Tests of the instruments: the oracle against differences and against f64, the printer and the
//! enclosures of the verifier against the oracle.

use libtest_mimic::Failed;
use liouville::case::Case;
use liouville::verdict::evaluate;

use super::claim::{At, Claim};
use super::draw::{drawn, plain};
use super::expr::{Tree, add, modulus, mul, root, square, sub, symbol, whole};
use super::grow::Garden;
use super::hint::{Hints, Unseen};
use super::jet::Place;
use super::oracle::searched;
use super::print::Hand;
use super::random::Stream;
use super::real::{
    LADDER, Lack, difference, exactly, height, modulus as size, nearest, sign, sure_sign,
    whole as number, with_bits,
};
use super::scene::Scene;
use super::scout;
use super::told::read;

/// Grows a random expression with a scene for it.
fn grown(index: u64) -> (Scene, Tree, Stream) {
    let mut stream = Stream::new(4711, index);
    let scene = plain(&mut stream);
    let mut garden = Garden::new(&scene, &mut stream);
    garden.functions |= index.is_multiple_of(5);
    let depth = 1 + stream.below(4);
    let tree = garden.tree(&mut stream, depth);
    (scene, tree, stream)
}

/// Compares derivatives with differences.
pub fn derivatives() -> Result<(), Failed> {
    let (mut compared, step) = (0, 2f64.powi(-80));
    for index in 0..600 {
        let (scene, tree, mut stream) = grown(index);
        let states = scene.states();
        let point = scene.point(&mut stream, false);
        let Some(values) = scene.values(&point) else { continue };
        let Ok(jet) = (Place { values: &values, along: &states }).jet(&tree) else { continue };
        for (k, place) in states.iter().enumerate() {
            let beside = |by: f64| {
                let mut values = values.clone();
                values[*place] = values[*place].clone().map(|x| x + exactly(by));
                (Place { values: &values, along: &[] }).value(&tree)
            };
            let (Ok(above), Ok(below)) = (beside(step), beside(-step)) else { continue };
            let slope = (above - below) / exactly(2.0 * step);
            let (slope, own) = (nearest(&slope), nearest(&jet.slopes[k]));
            compared += 1;
            if (slope - own).abs() > 1e-9 * own.abs().max(1.0) {
                let text = Hand(0).text(&tree, &scene.names());
                return Err(Failed::from(format!("{own} is not the slope {slope} of {text}")));
            }
        }
    }
    if compared > 500 { Ok(()) } else { Err(Failed::from(format!("only {compared} slopes"))) }
}

/// Compares with f64, which finds the same values and the same undefined states.
pub fn two_precisions() -> Result<(), Failed> {
    let (mut compared, mut without) = (0, 0);
    for index in 0..2000 {
        let (scene, tree, mut stream) = grown(index);
        let point = scene.point(&mut stream, false);
        let (Some(values), Some(rough)) = (scene.values(&point), scene.rough_values(&point)) else {
            continue;
        };
        let exact = (Place { values: &values, along: &[] }).value(&tree);
        let text = || Hand(0).text(&tree, &scene.names());
        match (exact, scout::value(&tree, &rough)) {
            (Ok(exact), Some(rough)) => {
                compared += 1;
                let exact = nearest(&exact);
                if (exact - rough).abs() > 1e-5 * exact.abs().max(1.0) {
                    return Err(Failed::from(format!("{exact} and {rough} are {}", text())));
                }
            }
            (Err(Lack::Value), None) => without += 1,
            (Err(Lack::Decision), _) => {}
            (exact, rough) => {
                return Err(Failed::from(format!("{exact:?} and {rough:?} are {}", text())));
            }
        }
    }
    match (compared, without) {
        (1000.., 100..) => Ok(()),
        _ => Err(Failed::from(format!("{compared} values, {without} without"))),
    }
}

/// Compares what f64 shows about the formulas of random cases with what more bits show, at states and
/// close to the ends of ranges.
pub fn hints() -> Result<(), Failed> {
    let (mut signs, mut lacks, mut away) = (0, 0, 0);
    for index in 0..3000 {
        let case = drawn(6, index);
        let (scene, mut stream) = (&case.scene, Stream::new(4715, index));
        let trees: Vec<&Tree> = case.made.iter().flat_map(|made| made.claim.trees()).collect();
        let point = scene.point(&mut stream, false);
        let Some(place) = scene.free().first().copied() else { continue };
        for power in [0, 3, 9, 17, 25, 40] {
            let near = 10f64.powi(-power) * stream.unit();
            let at = if stream.once_in(2) { (near, 0.0) } else { (1.0, -near) };
            let seen = Hints::new(scene, &point, place).signs(at, trees.iter().copied());
            for bits in [160, LADDER[0]] {
                let known = with_bits(bits, || {
                    let values = scene.values(&point.at(place, at))?;
                    let place = Place { values: &values, along: &[] };
                    let sign = |tree: &&Tree| place.value(tree).and_then(|value| sure_sign(&value));
                    Some(trees.iter().map(sign).collect::<Vec<_>>())
                });
                let is_right = match (&seen, &known) {
                    (Err(Unseen::Open), _) => true,
                    (Err(Unseen::Lack), known) => known.is_none(),
                    (Ok(_), None) => false,
                    (Ok(seen), Some(known)) => seen.iter().zip(known).all(|pair| match pair {
                        // Few bits may leave it open.
                        (Ok(_), Err(Lack::Digits)) if bits < LADDER[0] => true,
                        (Ok(seen), known) => *known == Ok(*seen),
                        (Err(Unseen::Lack), known) => known.is_err(),
                        (Err(Unseen::Open), _) => true,
                    }),
                };
                if !is_right {
                    return Err(Failed::from(format!("case {index}: {seen:?}, not {known:?}")));
                }
            }
            for sign in seen.iter().flatten() {
                signs += usize::from(sign.is_ok());
                lacks += usize::from(*sign == Err(Unseen::Lack));
            }
            away += usize::from(matches!(seen, Err(Unseen::Lack)));
        }
    }
    match (signs, lacks, away) {
        (10_000.., 500.., 100..) => Ok(()),
        few => Err(Failed::from(format!("only {few:?} signs, lacks and points off"))),
    }
}

/// Prints a formula and reads it again: its enclosure contains the oracle's value.
pub fn enclosures() -> Result<(), Failed> {
    let mut enclosed = 0;
    for index in 0..1500 {
        let (scene, tree, mut stream) = grown(index);
        let hand = Hand(stream.below(8) as u8);
        let body = Claim::Identity(tree.clone(), whole(0)).body(&scene.names(), hand);
        let text = scene.text(&[body], hand);
        let case = match Case::parse(&text, &[]) {
            Ok(case) => case,
            // The formula contains a number over 0.
            Err(error) if error.to_string().contains("divides by zero") => continue,
            Err(error) => return Err(Failed::from(format!("{error}\n{text}"))),
        };
        let Ok(report) = evaluate(&case, None, 1, index) else { continue };
        let mut values = Vec::new();
        for symbol in &scene.symbols {
            let given = report.parameters.iter().chain(&report.state);
            let own = given.into_iter().find(|(name, _)| *name == symbol.name);
            let value = match (own, &symbol.origin) {
                (Some((_, value)), _) => read(&value[0]).ok_or(Lack::Decision),
                (None, super::scene::Origin::Formula(tree)) => {
                    (Place { values: &values, along: &[] }).value(tree)
                }
                (None, super::scene::Origin::Fixed(n)) => Ok(super::real::number(*n)),
                _ => Err(Lack::Decision),
            };
            values.push(value);
        }
        let Ok(value) = (Place { values: &values, along: &[] }).value(&tree) else { continue };
        let Some((middle, radius)) = report.claims[0].2[0] else { continue };
        enclosed += 1;
        let off = size(&difference(&value, &exactly(middle)).unwrap_or_else(|_| number(0)));
        if sign(&(&off - exactly(radius))) > 0 && height(&off) > height(&value) - 200 {
            let value = nearest(&value);
            return Err(Failed::from(format!(
                "{middle} ± {radius:e} does not hold {value}:\n{text}"
            )));
        }
    }
    if enclosed > 700 { Ok(()) } else { Err(Failed::from(format!("only {enclosed} values"))) }
}

/// Checks the oracle on handwritten claims.
pub fn known_truths() -> Result<(), Failed> {
    let scene = |low: i64, high: i64| {
        let number = |top| super::expr::Number { top, bottom: 1, tens: 0 };
        let state = |name: &str| super::scene::Symbol {
            name: name.to_string(),
            origin: super::scene::Origin::State(number(low), number(high)),
        };
        Scene { symbols: vec![state("x"), state("y")], ..Scene::default() }
    };
    let (x, y) = (symbol(0), symbol(1));
    let one_sided = modulus(&add(&y, &modulus(&y)));
    let tower = root(&mul(&x, &one_sided));
    let false_on_a_quarter = Claim::Identity(add(&modulus(&x), &tower), add(&x, &tower));
    let cancelling = Claim::Identity(mul(&root(&x), &root(&x)), modulus(&x));
    let squared = root(&add(&add(&square(&x), &mul(&whole(2), &x)), &whole(1)));
    let nested = Claim::Identity(root(&add(&y, &squared)), root(&add(&add(&y, &x), &whole(1))));
    let none = Claim::Identity(root(&sub(&whole(-1), &square(&x))), x.clone());
    let slopes = Claim::Independent(vec![sub(&modulus(&x), &x)]);
    let expected = [
        ("a quarter", &false_on_a_quarter, (-2, 2), (true, true)),
        ("positive", &false_on_a_quarter, (1, 2), (true, false)),
        ("half", &cancelling, (-2, 2), (true, false)),
        ("without", &cancelling, (-2, -1), (false, false)),
        ("nested", &nested, (1, 2), (true, false)),
        ("nowhere", &none, (-2, 2), (false, false)),
        ("one-sided", &slopes, (-2, 2), (true, true)),
        ("constant", &slopes, (1, 2), (true, false)),
    ];
    for (name, claim, (low, high), (valued, off)) in expected {
        let survey = searched(&scene(low, high), claim, &mut Stream::new(1, 1), 2);
        if (survey.off > 0) != off || (survey.off + survey.zero > 0) != valued {
            return Err(Failed::from(format!("{name}: {survey:?}")));
        }
    }
    Ok(())
}

/// Checks that case i depends on the seed and on i alone, and that cases are of all kinds.
pub fn addresses() -> Result<(), Failed> {
    let mut kinds = std::collections::BTreeSet::new();
    for index in 0..400 {
        let text = || {
            let case = drawn(5, index);
            let names = case.scene.names();
            let bodies: Vec<String> =
                case.made.iter().map(|made| made.body(&names, case.hand)).collect();
            (case.scene.text(&bodies, case.hand), case.seed)
        };
        if text() != text() {
            return Err(Failed::from(format!("case {index} differs from itself")));
        }
        kinds.extend(drawn(5, index).made.iter().map(|made| made.claim.kind()));
        let case = drawn(5, index);
        let mut stream = Stream::new(9, index);
        let point = case.scene.point(&mut stream, false);
        if let Some(values) = case.scene.values(&point)
            && matches!(case.made[0].claim.at(&case.scene, &values), At::Off(_))
            && case.made[0].vanishes
        {
            return Err(Failed::from(format!("case {index} is true by construction, and is off")));
        }
    }
    if kinds.len() == 8 { Ok(()) } else { Err(Failed::from(format!("only {kinds:?}"))) }
}
