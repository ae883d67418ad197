//! Spoilt verdicts: for claims that are hard to decide, the oracle accepts what the verifier says
//! and notices each lie.

use std::rc::Rc;

use libtest_mimic::Failed;
use liouville::verdict::{ClaimReport, DensitySign, Independence, Verdict};

use super::claim::Claim;
use super::draw::Made;
use super::expr::{
    Expr, Function, Number, Tree, add, div, modulus, mul, neg, of, power, ratio, root, square, sub,
    symbol, ten_to, whole,
};
use super::print::Hand;
use super::random::Stream;
use super::scene::{Level, Origin, Scene, Symbol};
use super::told::{Told, told};
use super::wrong::{Wrong, weighed};

/// A change of a report.
type Lie = (&'static str, fn(&mut ClaimReport), Wrong);

const PROVED: Lie = ("proved", |report| as_if(report, Verdict::Proved), Wrong::ProvedFalse);
const VOID: Lie = ("proved", |report| as_if(report, Verdict::Proved), Wrong::ProvedVoid);
const REFUTED: Lie = ("refuted", |report| as_if(report, Verdict::Refuted), Wrong::RefutedTrue);
const CONFIRMED: Lie =
    ("confirmed", |report| as_if(report, Verdict::Confirmed), Wrong::ConfirmedFalse);
const CONSTANT: Lie = (
    "constant",
    |report| report.evidence.independence = Some(Independence::Constant),
    Wrong::OtherNovelty,
);
const NEW: Lie = (
    "new",
    |report| report.evidence.independence = Some(Independence::Independent),
    Wrong::OtherNovelty,
);
const POSITIVE: Lie =
    ("positive", |report| signed(report, DensitySign::Positive), Wrong::OtherSign);
const NEGATIVE: Lie =
    ("negative", |report| signed(report, DensitySign::Negative), Wrong::OtherSign);
const CHANGES: Lie = ("changes", |report| signed(report, DensitySign::Changes), Wrong::OtherSign);

fn as_if(report: &mut ClaimReport, verdict: Verdict) {
    report.verdict = verdict;
    report.evidence.witness = None;
}

fn signed(report: &mut ClaimReport, sign: DensitySign) {
    (report.evidence.sign, report.evidence.sign_is_proved) = (Some(sign), true);
}

fn witness_at(report: &mut ClaimReport, state: &str) {
    if let Some(witness) = &mut report.evidence.witness {
        witness.state = state.to_string();
    }
}

/// A claim with lies about it.
struct Hard {
    name: &'static str,
    scene: Scene,
    claim: Claim,
    lies: Vec<Lie>,
}

fn number(top: i64, bottom: i64) -> Number {
    Number { top, bottom, tens: 0 }
}

/// Makes a scene with the states x, y, …, each in its range in thousandths.
fn space(ranges: &[(i64, i64)]) -> Scene {
    let state = |(name, (low, high)): (&&str, &(i64, i64))| Symbol {
        name: (*name).to_string(),
        origin: Origin::State(number(*low, 1000), number(*high, 1000)),
    };
    let symbols = ["x", "y", "z"].iter().zip(ranges).map(state).collect();
    Scene { symbols, ..Scene::default() }
}

fn with_parameter(mut scene: Scene, origin: Origin) -> Scene {
    scene.symbols.push(Symbol { name: "a".to_string(), origin });
    scene
}

fn on_level(scene: Scene, equation: (Tree, Tree), branches: Vec<Vec<(usize, Tree)>>) -> Scene {
    Scene { level: Some(Level { equations: vec![equation], branches, chart: None }), ..scene }
}

/// The circle x² + y² = 2 with x in a hundredth of its range.
fn circle() -> Scene {
    let (x, y) = (symbol(0), symbol(1));
    let rest = root(&sub(&whole(2), &square(&y)));
    let scene = space(&[(1, 10), (-2000, 2000), (-2000, 2000)]);
    let equation = (add(&square(&x), &square(&y)), whole(2));
    on_level(scene, equation, vec![vec![(0, rest.clone())], vec![(0, neg(&rest))]])
}

/// The level z = 0, with z at rest on it.
fn plane() -> Scene {
    let mut scene = space(&[(-2000, 2000), (-2000, 2000), (-2000, 2000)]);
    scene.field = vec![(0, symbol(1))];
    on_level(scene, (symbol(2), whole(0)), vec![vec![(2, whole(0))]])
}

fn hard() -> Vec<Hard> {
    let (x, y, z, a) = (symbol(0), symbol(1), symbol(2), symbol(1));
    let wide = (-2000, 2000);
    let tiny = |tens: i32| ten_to(tens);
    let hard = |name, scene, claim, lies: &[Lie]| Hard { name, scene, claim, lies: lies.to_vec() };
    let round = add(&square(&x), &square(&y));
    let turns = of(Function::Sin, &mul(&whole(4000), &of(Function::Atan, &whole(1))));
    let relation = |f: &Tree| Claim::Relation(f.clone(), whole(0));
    let norm = |first: &Tree| Rc::new(Expr::Norm([first.clone(), x.clone(), whole(2)]));
    let speck = square(&sub(&a, &mul(&a, &add(&whole(1), &tiny(-40)))));
    let corner = add(&y, &modulus(&y));
    let rooted = on_level(
        space(&[wide, (-1000, 1_000_000), (-20_000, 20_000)]),
        (x.clone(), root(&corner)),
        vec![vec![(0, root(&corner))]],
    );
    let folded = root(&add(&x, &modulus(&add(&x, &a))));
    let listed = Origin::List(vec![number(2, 1), number(-3, 2)]);
    let rest = root(&sub(&whole(-1), &square(&x)));
    let slanted = sub(&sub(&ratio(1, 2), &square(&x)), &neg(&x));
    vec![
        // Thin pieces of levels, and thin sets of a sign.
        hard(
            "thin level",
            circle(),
            Claim::Identity(add(&root(&y), &round), add(&root(&y), &whole(2))),
            &[REFUTED],
        ),
        hard(
            "thin level, false",
            circle(),
            Claim::Identity(add(&root(&y), &round), add(&root(&y), &whole(3))),
            &[PROVED],
        ),
        hard(
            "thin sign",
            space(&[(-1000, 1_000_000)]),
            Claim::Density(sub(&neg(&square(&x)), &div(&x, &whole(2)))),
            &[POSITIVE, NEGATIVE],
        ),
        hard(
            "fixed sign",
            space(&[wide]),
            Claim::Density(add(&whole(1), &square(&x))),
            &[CHANGES, NEGATIVE],
        ),
        // Multiples of a quarter turn.
        hard("half turns", space(&[wide]), Claim::Identity(turns.clone(), whole(0)), &[REFUTED]),
        hard(
            "half turns, false",
            space(&[wide]),
            Claim::Identity(turns, tiny(-30)),
            &[PROVED, CONFIRMED],
        ),
        // Differences down to 10^-160 of their terms.
        hard(
            "speck",
            with_parameter(space(&[(-6000, 2100)]), Origin::Range(number(1, 2), number(2, 1))),
            Claim::Identity(norm(&whole(0)), norm(&speck)),
            &[PROVED],
        ),
        hard(
            "rounded state",
            rooted.clone(),
            Claim::Identity(mul(&z, &add(&whole(2), &mul(&tiny(-30), &x))), mul(&whole(2), &z)),
            &[
                PROVED,
                (
                    "a state at which it holds",
                    |r| witness_at(r, "x=0 y=-1 z=3"),
                    Wrong::IdleWitness,
                ),
                ("off the level", |r| witness_at(r, "x=1 y=-1 z=3"), Wrong::NoWitness),
                ("out of range", |r| witness_at(r, "x=2 y=2 z=30"), Wrong::NoWitness),
            ],
        ),
        // What is at rest on a corner.
        hard("corner at rest", plane(), relation(&modulus(&z)), &[REFUTED]),
        hard("corner in motion", plane(), relation(&modulus(&x)), &[PROVED]),
        hard("no corner", plane(), relation(&rest), &[VOID]),
        // Near misses that 256 bits show.
        hard(
            "near miss",
            space(&[wide]),
            Claim::Identity(x.clone(), mul(&x, &add(&whole(1), &tiny(-40)))),
            &[CONFIRMED, PROVED],
        ),
        // New and constant integrals.
        hard("new", space(&[wide]), Claim::Integral(x.clone()), &[CONSTANT]),
        hard("constant", space(&[wide]), Claim::Integral(whole(3)), &[NEW]),
        hard("new on a thin piece", rooted, Claim::Integral(slanted), &[CONSTANT]),
        hard(
            "new without a state",
            with_parameter(space(&[(-2000, -1000)]), listed),
            Claim::Integral(folded),
            &[NEW],
        ),
        hard(
            "new at one choice",
            with_parameter(space(&[wide]), Origin::List(vec![number(2, 1), number(0, 1)])),
            Claim::Integral(power(&mul(&a, &x), 2, 1)),
            &[CONSTANT],
        ),
    ]
}

/// Checks that the oracle accepts each verdict and notices each lie.
pub fn noticed() -> Result<(), Failed> {
    let mut count = 0;
    for Hard { name, scene, claim, lies } in hard() {
        let made = Made::new(claim, false);
        let text = scene.text(&[made.body(&scene.names(), Hand(0))], Hand(0));
        let answer = told(&text, 7, 1).swap_remove(0);
        let fault = |told: &Told| weighed(&scene, &made, told, &mut Stream::new(3, 1)).1;
        let Told::Report(report) = &answer else {
            return Err(Failed::from(format!("{name}: {}\n{text}", answer.grounds())));
        };
        let has_value = lies.iter().all(|(_, _, wrong)| *wrong != Wrong::ProvedVoid);
        if report.verdict == Verdict::Undecided && has_value {
            return Err(Failed::from(format!("{name} is undecided:\n{text}")));
        }
        if let Some(wrong) = fault(&answer) {
            let grounds = answer.grounds();
            return Err(Failed::from(format!("{name}: {grounds} is no fault: {wrong:?}\n{text}")));
        }
        for (lie, change, wrong) in lies {
            let mut report = report.clone();
            change(&mut report);
            let found = fault(&Told::Report(report));
            if found != Some(wrong) {
                return Err(Failed::from(format!("{name}: {lie} is {wrong:?}, not {found:?}")));
            }
            count += 1;
        }
    }
    if count > 20 { Ok(()) } else { Err(Failed::from(format!("only {count} lies"))) }
}
