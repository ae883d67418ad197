//! Guards the growth of recording against regressions: the exponent of instructions in the
//! operations of the residuals, by valgrind's callgrind, from two sizes of each family.
//!
//! A count is the same in every run, and an exponent hardly depends on the compiler. Operations and
//! nodes of small members are counted by the program itself, and may not become more; without
//! valgrind, or on another processor, they are counted alone.

mod callgrind;

use std::time::Duration;

use callgrind::all_counts;
use liouville::case::Case;
use liouville::verdict::{RecordedSize, recorded_size};
use liouville_lab::growth::{CaseFamily, FAMILIES, SizePoint, at_size, measure};

/// Families with a small size, which is doubled, and the greatest exponent allowed. Claims of one
/// field share most of their operations, and are left out.
const MEMBERS: [(&str, u64, f64); 8] = [
    ("chain", 40, 1.3),
    ("pendulum", 12, 1.3),
    ("toda", 50, 1.3),
    ("calogero", 12, 1.3),
    ("lotka-volterra", 20, 1.3),
    ("bodies", 5, 1.3),
    ("terms", 125, 1.3),
    ("roots", 25, 1.3),
];

/// Operations and nodes of the same families at twice the small size. They are the same on every
/// machine; to be lowered when a change reduces them.
const COUNTS: [[usize; 2]; 8] = [
    [1289, 4434],
    [13_772, 16_218],
    [1588, 5654],
    [4539, 7493],
    [3412, 7753],
    [2560, 6651],
    [1009, 3273],
    [359, 674],
];

const MEMBER: &str = "LIOUVILLE_COUNTED_MEMBER";

fn family(name: &str) -> &'static CaseFamily {
    FAMILIES.iter().find(|family| family.name == name).expect("a family of this name")
}

fn case(name: &str, size: u64) -> Case {
    Case::parse(&family(name).case(size), &[]).expect("members of families are cases")
}

#[inline(never)]
fn counted_record(case: &Case) -> RecordedSize {
    recorded_size(case).expect("records")
}

/// The counted work: run by the test below under valgrind, at the small size and at its double.
#[test]
fn workload() {
    let Ok(member) = std::env::var(MEMBER) else { return };
    let (name, size) = member.split_once(' ').expect("a name and a size");
    let size: u64 = size.parse().expect("a size");
    for size in [size, 2 * size] {
        let case = case(name, size);
        assert!(counted_record(&case).operations > 0, "the residuals have operations");
    }
}

/// Exponent e of y ~ x^e from two points.
fn exponent(x: [usize; 2], y: [f64; 2]) -> f64 {
    (y[1] / y[0]).ln() / (x[1] as f64 / x[0] as f64).ln()
}

#[test]
fn a_graph_grows_as_its_residuals() {
    for (name, size, most) in MEMBERS {
        let [small, large] = [size, 2 * size].map(|size| counted_record(&case(name, size)));
        let found = exponent(
            [small.operations, large.operations],
            [small.nodes as f64, large.nodes as f64],
        );
        println!("{name}: nodes grow with exponent {found:.2} in the operations");
        assert!(found <= most, "{name}: {found:.2} from {small:?} to {large:?}");
    }
}

#[test]
fn small_members_take_no_more_operations_than_before() {
    for ((name, size, _), [operations, nodes]) in MEMBERS.into_iter().zip(COUNTS) {
        let found = counted_record(&case(name, 2 * size));
        assert!(found.operations <= operations, "{name}: {found:?}, {operations} before");
        assert!(found.nodes <= nodes, "{name}: {found:?}, {nodes} nodes before");
    }
}

#[test]
#[ignore = "slow: under valgrind; nodes and operations are counted by the tests above"]
fn instructions_of_recording_grow_as_its_residuals() {
    let members = MEMBERS.map(|(name, size, _)| format!("{name} {size}"));
    let Some(all) = all_counts(MEMBER, &members, &["counted_record"]) else { return };
    for ((name, size, most), counts) in MEMBERS.into_iter().zip(all) {
        let [small, large] = counts[..] else { panic!("{name}: {counts:?} instructions") };
        let sizes = [size, 2 * size].map(|size| counted_record(&case(name, size)).operations);
        let found = exponent(sizes, [small as f64, large as f64]);
        println!("{name}: {counts:?} instructions for {sizes:?} operations, exponent {found:.2}");
        assert!(found <= most, "{name}: {found:.2}, {counts:?} instructions");
    }
}

#[test]
fn all_claims_of_small_members_hold() {
    for family in FAMILIES.iter().filter(|family| !family.counts_states) {
        let point = at_size(family, family.first).expect("a member of a family is judged");
        assert_eq!(point.holding, point.claims, "{}: {point:?}", family.name);
        assert!(point.claims > 0 && point.operations > 0, "{}: {point:?}", family.name);
    }
}

#[test]
fn powers_have_their_exponents() {
    let power = |_: &CaseFamily, size: u64| {
        let n = size as f64;
        Ok(SizePoint {
            size,
            operations: 5 * size as usize,
            nodes: 0,
            read: 0.0,
            record: 7.0 * n.powi(3),
            judge: 0.0,
            memory: None,
            claims: 1,
            holding: 1,
        })
    };
    let found = measure(family("chain"), Duration::from_secs(60), power).exponents;
    let is = |found: Option<f64>, power: f64| found.is_some_and(|e| (e - power).abs() < 1e-12);
    assert!(is(found.operations, 1.0), "{found:?}");
    assert!(is(found.record, 3.0) && is(found.size, 3.0), "{found:?}");
    let alone = measure(family("chain"), Duration::ZERO, power).exponents;
    assert_eq!(alone.record, None, "one point has no slope");
}
