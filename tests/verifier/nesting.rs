//! Formulas that are long or nested deeply.

use liouville::case::Case;
use liouville::verdict::evaluate;

fn case(formula: &str) -> String {
    format!(
        "title = 't'\n[state]\nx = '1..2'\n\"γ\" = 'vector(1..2)'\n[field]\n\"x'\" = '1'\n\"γ'\" = '[0, 0, 0]'\n\
         [[claim]]\nintegral = '{formula}'\n"
    )
}

#[test]
fn reading_and_evaluating_keep_within_a_small_stack() {
    let run = || {
        let product = Case::parse(&case(&vec!["x"; 100_000].join("*")), &[]);
        assert!(product.is_ok_and(|own| evaluate(&own, None, 1, 0).is_ok()), "a long product");
        let mut read = 0;
        for (open, close, times) in [
            ("(", ")", 190),
            ("|", "|", 190),
            ("sin(", ")", 190),
            ("x^(", ")", 95),
            ("(1 + γ1*(", "))", 95),
            ("[1,2,3]*((γ,γ + γ × 2*", "))", 95),
            ("-", "", 190),
            ("sum(i, 1..1, ", ")", 190),
            ("if(1 = 1, ", ", 0)", 190),
        ] {
            // Some of these are no formulas of fitting types; all must return.
            let formula = format!("{}x{}", open.repeat(times), close.repeat(times));
            if let Ok(own) = Case::parse(&case(&formula), &[]) {
                read += 1;
                assert!(evaluate(&own, None, 1, 0).is_ok(), "{open} nested");
            }
        }
        assert!(read >= 4, "{read} formulas were read");
    };
    let thread = std::thread::Builder::new().stack_size(1 << 20).spawn(run).expect("a thread");
    assert!(thread.join().is_ok(), "neither length nor depth overflows");
}
