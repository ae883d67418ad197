//! Powers of moduli: contact and drag, through the zeros of their bases.

use liouville_flow::{Precision, QuantityRole, Variational};

use super::{distance, follow, parse, start};

/// A grain between two others under Hertz's law, with its energy.
const GRAIN: &str = "title = 'a grain'\n[state]\nx = '-2..2'\nv = '-2..2'\n[field]\n\"x'\" = 'v'\n\
    \"v'\" = '-max(x,0)^1.5 + max(-x-1,0)^1.5'\n[[claim]]\n\
    integral = 'v^2/2 + (max(x,0)^2.5 + max(-x-1,0)^2.5)/2.5'\n";

fn drift(text: &str, from: &str, time: f64, precision: Precision) -> f64 {
    let orbit = follow(&parse(text), from, time, precision);
    let integral = orbit.followed.iter().find(|own| own.role == QuantityRole::Integral);
    integral.expect("an integral").drift
}

#[test]
fn grains_pass_from_contact_to_contact() {
    for from in ["x=1/2 v=0", "x=0 v=1", "x=-1/2 v=-1/10", "x=-1 v=-3"] {
        let found = drift(GRAIN, from, 60.0, Precision::Float);
        assert!(found < 1e-13, "{from}: {found:e}");
    }
    assert!(drift(GRAIN, "x=1/2 v=0", 8.0, Precision::Pair) < 1e-29);
    // backwards through three contacts
    let case = parse(GRAIN);
    let there = follow(&case, "x=1/2 v=0", 9.0, Precision::Float);
    let back = liouville_flow::Start { state: there.end.clone(), ..there.start.clone() };
    let time = liouville::number::double_double::DoubleDouble::from_f64(-9.0);
    let back = liouville_flow::orbit(&case, back, time, Precision::Float).expect("a motion");
    assert!(distance(&back.end, &there.start.state) < 1e-13, "{:?}", back.end);
}

#[test]
fn a_chain_of_grains_that_touch_begins_from_rest() {
    let chain = "title = 'a chain'\n[state]\na = '-1..1'\nb = '-1..1'\nc = '-1..1'\nu = '-1..1'\n\
        v = '-1..1'\nw = '-1..1'\n[field]\n\"a'\" = 'u'\n\"b'\" = 'v'\n\"c'\" = 'w'\n\
        \"u'\" = '-max(a-b,0)^1.5'\n\"v'\" = 'max(a-b,0)^1.5 - max(b-c,0)^1.5'\n\
        \"w'\" = 'max(b-c,0)^1.5'\n[[claim]]\n\
        integral = '(u^2+v^2+w^2)/2 + (max(a-b,0)^2.5 + max(b-c,0)^2.5)/2.5'\n";
    let found = drift(chain, "a=0 b=0 c=0 u=1 v=0 w=0", 20.0, Precision::Float);
    assert!(found < 1e-12, "{found:e}");
}

#[test]
fn drag_turns_with_the_pendulum() {
    for drag in ["abs(p)^1.5*sign(p)", "sqrt(abs(p))*p", "abs(p)^2.5*sign(p)"] {
        let text = format!(
            "title = 'drag'\n[state]\nq = '-9..9'\np = '-9..9'\n[field]\n\"q'\" = 'p'\n\
             \"p'\" = '-sin(q) - {drag}/10'\n"
        );
        let case = parse(&text);
        let [float, pair] =
            [Precision::Float, Precision::Pair].map(|own| follow(&case, "q=3 p=0", 12.0, own).end);
        assert!(distance(&float, &pair) < 1e-14, "{drag}: {float:?} {pair:?}");
    }
}

#[test]
fn other_powers_have_no_value_at_0() {
    let text = "title = 'drag'\n[state]\nq = '-9..9'\np = '-9..9'\n[field]\n\"q'\" = 'p'\n\
        \"p'\" = '-sin(q) - abs(p)^1.2*sign(p)'\n";
    let case = parse(text);
    let time = liouville::number::double_double::DoubleDouble::from_f64(9.0);
    let found = liouville_flow::orbit(&case, start(&case, "q=1 p=1"), time, Precision::Float);
    assert!(found.is_err(), "0^1.2 has no value: {found:?}");
}

#[test]
fn zeros_that_are_touched_end_a_motion() {
    let case =
        parse("title = 'a vessel'\n[state]\nh = '0..2'\n[field]\n\"h'\" = '-sqrt(abs(h))'\n");
    let found = liouville_flow::orbit(
        &case,
        start(&case, "h=1"),
        liouville::number::double_double::DoubleDouble::from_f64(9.0),
        Precision::Float,
    );
    let found = found.expect_err("it runs empty at t = 2").to_string();
    assert!(found.contains("singularity at t = "), "{found}");
}

#[test]
fn vectors_are_carried_through_contacts() {
    let case = parse(GRAIN);
    let motion = Variational::new(&case.model, &start(&case, "x=1/2 v=0")).expect("a program");
    let found = motion.exponents(400.0).expect("no singularity");
    // An oscillator: neighbours part as t.
    assert!(found.largest.mean.abs() < 0.03, "{found:?}");
}
