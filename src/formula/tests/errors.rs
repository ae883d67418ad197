//! Tests of every error: its message, its place, and its help.

use super::*;

/// Checks message and place of the error for a text, and its help where one is given.
#[track_caller]
fn error(text: &str, message: &str, at: &str, help: Option<&str>) {
    let error = refuse(text);
    assert_eq!(error.message(), message, "the message for `{text}`");
    assert_eq!(&text[error.span()], at, "the place in `{text}`");
    if help.is_some() {
        assert_eq!(error.help(), help, "the help for `{text}`");
    }
}

#[test]
fn juxtaposition_is_not_a_product() {
    let missing = "missing `*`";
    error("2m", missing, "m", Some("write `2*m`"));
    error("x + R(γ,c)", missing, "(", Some("write `R*(γ,c)`"));
    error("(x)(y)", missing, "(", Some("write `(x)*(y)`"));
    error("Ĩ ω", missing, "ω", Some("write `Ĩ*ω`"));
    error("x√y", missing, "√", Some("write `x*√y`"));
    error("2|x|", missing, "|", Some("write `2*|x|`"));
    error("x² y^2", missing, "y", Some("write `x²*y^2`"));
    error("2 ?", "`?` has no meaning in a formula", "?", None);
    error("2(x", missing, "(", Some("write `2*(…`"));
    error("2|mR|", "unknown name `mR`", "mR", Some("write `m*R`?"));
    let vectors = "an operator is missing between two vectors";
    error("γ ω", vectors, "ω", Some("write `(γ,ω)` or `γ × ω`"));
}

#[test]
fn unknown_names_are_guessed_at() {
    error("mR + 1", "unknown name `mR`", "mR", Some("write `m*R`?"));
    error("mγ3", "unknown name `mγ3`", "mγ3", Some("write `m*γ3`?"));
    error("x + g2", "unknown name `g2`", "g2", Some("did you mean `g1`?"));
    error("X", "unknown name `X`", "X", Some("did you mean `x`?"));
    error("omga", "unknown name `omga`", "omga", Some("did you mean `omega`?"));
    let names = "the names here are A, B, I, P, R, c, g1, k, m, n, r', u, v, x, y, Ĩ, γ, ω; \
                 others are declared in [parameters] or [let]";
    error("energy", "unknown name `energy`", "energy", Some(names));
    error("I^T", "unknown name `T`", "T", Some("a transpose is written `Iᵀ`"));
    error("rdot", "unknown name `rdot`", "rdot", Some("the rate of `r` is written `r'`"));
    error("e3", "unknown name `e3`", "e3", Some("write `[0,0,1]`"));
    error("sqr(x)", "unknown function `sqr`", "sqr", Some("did you mean `sqrt`?"));
    error("sec(x)", "unknown function `sec`", "sec", Some("write `1/cos(x)`"));
    error("cot(x)", "unknown function `cot`", "cot", Some("write `1/tan(x)`"));
    error("coshh(x)", "unknown function `coshh`", "coshh", Some("did you mean `cosh`?"));
    assert!(refuse("sn(x)").help().is_some_and(|help| help.contains("s' = c*d")), "elliptic");
    let functions = refuse("Wronskian(x)");
    assert!(functions.help().is_some_and(|help| help.contains("sinh, solve")), "all are listed");
    error("γ4", "there is no component `γ4`", "γ4", Some("`γ` has the components γ1, γ2, γ3"));
    error("I14", "there is no component `I14`", "I14", Some("`I` has the entries I11 to I33"));
}

#[test]
fn sums_need_equal_types() {
    error("x + γ", "a scalar cannot be added to a vector", "x + γ", None);
    error("γ - x", "a scalar cannot be subtracted from a vector", "γ - x", None);
    error("x + B", "a scalar cannot be added to a matrix", "x + B", Some("write `x*E`"));
}

#[test]
fn products_need_fitting_types() {
    error(
        "x*γ*ω",
        "`*` does not multiply two vectors",
        "x*γ*ω",
        Some("write `(x*γ,ω)` or `x*γ × ω`"),
    );
    error("γ*B", "a vector cannot stand left of a matrix", "γ*B", Some("write `Bᵀ*γ`"));
    error(
        "B × γ",
        "`×` takes two vectors, not a matrix and a vector",
        "B × γ",
        Some("write `B*γ`"),
    );
    error(
        "x/γ",
        "nothing can be divided by a vector",
        "γ",
        Some("divide by a scalar such as its norm"),
    );
    error(
        "γ/B",
        "nothing can be divided by a matrix",
        "B",
        Some("write `solve(B, γ)` or `inverse(B)`"),
    );
    error("x/0", "this divides by zero", "0", None);
    error("x/(1-1)", "this divides by zero", "(1-1)", None);
    error("0^-1", "this divides by zero", "0^-1", None);
    error(
        "γ × ω × c",
        "products of vectors in a row need brackets",
        "γ × ω × c",
        Some("write `(γ × ω) × c` or `γ × (ω × c)`"),
    );
    error(
        "γ × ω ⊗ c",
        "products of vectors in a row need brackets",
        "γ × ω ⊗ c",
        Some("write `(γ × ω) ⊗ c` or `γ × (ω ⊗ c)`"),
    );
    error("(x,γ)", "a dot product takes two vectors, this is a scalar", "x", None);
    error(
        "(γ,ω,c)",
        "a dot product takes two vectors",
        "(γ,ω,c)",
        Some("a vector is written `[a,b,c]`"),
    );
}

#[test]
fn powers_need_fitting_types() {
    error("x^γ", "an exponent is a scalar, this is a vector", "γ", None);
    error("γ^x", "a vector is raised to whole numbers only", "x", None);
    let norm = Some("write a power of the norm, `|γ|`");
    error("γ^3", "a vector has no power except its square", "3", norm);
    error("γ⁻¹", "a vector has no power except its square", "⁻¹", norm);
    error("B^-2", "a matrix has the powers -1 and 1 to 100", "-2", None);
    error("B^(1/2)", "a matrix has the powers -1 and 1 to 100", "(1/2)", None);
    error("√γ", "a vector has no square root", "γ", None);
    error(
        "γᵀ",
        "only a matrix is transposed, this is a vector",
        "γ",
        Some("write `(a,b)` for aᵀb and `a ⊗ b` for abᵀ"),
    );
    error("|B|", "bars cannot enclose a matrix", "|B|", Some("write `det(B)`"));
}

#[test]
fn functions_check_their_arguments() {
    error(
        "det(γ)",
        "`det` takes a matrix here, this is a vector",
        "γ",
        Some("write `det(matrix)`"),
    );
    error("det(B, B)", "`det` takes 1 argument, not 2", "det(B, B)", Some("write `det(matrix)`"));
    error("x + det", "`det` is a function", "det", Some("write `det(matrix)`"));
    error("∫ x", "`∫` is a function", "∫", Some("write `∫(integrand, variable)`"));
    error(
        "diag(x)",
        "`diag` takes a vector here, this is a scalar",
        "x",
        Some("write `diag(vector)` or `diag(scalar, scalar, …)`"),
    );
    error(
        "solve(B)",
        "`solve` takes 2 arguments, not 1",
        "solve(B)",
        Some("write `solve(matrix, vector)` or `solve(matrix, matrix)`"),
    );
    let filled = Some("give 4, 9, 16, … entries, or the rows: `mat([a,b,c],[d,e,f])`");
    error("mat(1,2,3)", "3 entries do not fill a square matrix", "mat(1,2,3)", filled);
}

#[test]
fn literals_and_indices_fit_their_sizes() {
    let rows = Some("a matrix with the rows u, v, w is written `mat(u,v,w)`");
    error("[x,γ,1]", "a component is a scalar, this is a vector", "γ", rows);
    error("[γ,ω,c]", "a component is a scalar, this is a vector", "γ", rows);
    error("[[1,2,3],γ,c]", "a row of a matrix is written `[a,b,c]`, this is a vector", "γ", rows);
    error("[[1,2],[3]]", "this row has 1 entries, and the first has 2", "[3]", None);
    error("γ[4]", "there is no component 4", "4", Some("`γ` has the components 1 to 3"));
    error("A[5,1]", "there is no row 5", "5", Some("`A` has the rows 1 to 4"));
    error("P[2,0]", "there is no column 0", "0", Some("`P` has the columns 1 to 4"));
    error("u5", "there is no component `u5`", "u5", Some("`u` has the components u1 to u4"));
    let fixed = Some("use numbers, indices, and parameters such as n = 4");
    error("γ[x]", "`x` is not a whole number that the file fixes", "x", fixed);
    error("γ[1/2]", "an index is a whole number that the file fixes", "1/2", fixed);
    error("γ[]", "an index is missing", "]", Some("write `γ[3]` or `B[1,2]`"));
    error("γ[1,2]", "a vector has one index", "[1,2]", Some("write `γ[1]`"));
    error("B[1,2,3]", "a matrix has two indices", "[1,2,3]", Some("write `B[1,2]`"));
    error("x[1]", "a scalar has no components", "[1]", None);
}

#[test]
fn sizes_have_to_agree() {
    let sum = "a vector of length 4 cannot be added to a vector of length 3";
    error("u + γ", sum, "u + γ", None);
    error(
        "x + A",
        "a scalar cannot be added to a matrix of size 4×4",
        "x + A",
        Some("write `x*E(4)`"),
    );
    let dot = "a dot product takes two vectors of one length, not a vector of length 4 and a vector \
               of length 3";
    error("(u,γ)", dot, "(u,γ)", None);
    let product = "a matrix of size 4×4 does not multiply a vector of length 3";
    error("A*γ", product, "A*γ", Some("`A` has 4 columns, and `γ` has 3 components"));
    let product = "a matrix of size 4×4 does not multiply a matrix of size 2×4";
    error("A*P", product, "A*P", Some("`A` has 4 columns, and `P` has 2 rows"));
    error("u × v", "`×` takes vectors of length 3, this is a vector of length 4", "u", None);
    error("P²", "a matrix of size 2×4 has no powers", "P", None);
    error(
        "det(P)",
        "`det` takes a square matrix here, this is a matrix of size 2×4",
        "P",
        Some("write `det(matrix)`"),
    );
    let large = Some("vectors and matrices have at most 1024 components");
    error("zero(40,40)", "a matrix of size 40×40 is too large", "zero(40,40)", large);
    let small = Some("determinants and inverses take at most 16 rows");
    let message = "a matrix of size 20×20 is too large for a determinant";
    error("det(E(20))", message, "E(20)", small);
}

#[test]
fn forms_with_indices_say_what_is_missing() {
    let sum = Some("write `sum(i, 1..n, a[i])`");
    error("sum", "`sum` is written with brackets", "sum", sum);
    error("sum(u)", "an index and its range are missing here", "u", sum);
    error("sum(i, n, u[i])", "the range of `i` is missing here", "n", sum);
    error("sum(i, 1..n)", "`sum` has no body", ")", sum);
    error(
        "sum(i, 1..n, u[i], x)",
        "this `(` is not closed",
        "(",
        Some("it should close before `,`"),
    );
    error("sum(i, 1..n, u[i]", "this `(` is not closed", "(", None);
    error(
        "sum(i, 1..n, u[i+1])",
        "there is no component 5",
        "i+1",
        Some("`u` has the components 1 to 4"),
    );
    let fixed = Some("use numbers, indices, and parameters such as n = 4");
    error("sum(i, 1..x, u[i])", "`x` is not a whole number that the file fixes", "x", fixed);
    error("vector(i, 1..0, x)", "this vector has no components", "vector(i, 1..0, x)", None);
    let large = refuse("sum(i, 1..1000, sum(j, 1..1000, i*j*x))");
    assert_eq!(large.message(), "this has too many terms when expanded", "a limit");
    let endless = refuse("sum(i, 1..2000000000, j, 1..0, x)");
    assert_eq!(endless.message(), "this has too many terms when expanded", "of nothing, too");
    let cases =
        Some("`if(i = j, a, b)` compares indices; values have `max`, `min`, `sign` and `|x|`");
    error("if(x = 1, x, y)", "`x` is not a whole number that the file fixes", "x", cases);
    let equation = Some(
        "a formula is a value, not an equation; values are compared by `max`, `min`, `sign` and `|x|`",
    );
    error("x ≠ y", "`≠` has no meaning in a formula", "≠", equation);
    error(
        "1..n",
        "`..` has no meaning here",
        "..",
        Some(
            "a range is written in [parameters] and [state], and in `sum(i, 1..n, …)`; a formula has one value",
        ),
    );
    error(
        "γ x ω",
        "an operator is missing between two vectors",
        "x",
        Some("a cross product is written `γ × …`"),
    );
    error(
        "<ω,γ>",
        "a number, a name or a bracket is missing before `<`",
        "<",
        Some("a dot product is written `(a,b)`"),
    );
    let mixed = refuse("sum(i, 1..2, if(i = 1, γ, x))");
    let message = "the terms of a sum are of one kind, not a vector of length 3 and a scalar";
    assert_eq!(mixed.message(), message, "kinds are told");
}

#[test]
fn brackets_point_at_the_opening_one() {
    error("x*(x + (y)", "this `(` is not closed", "(", None);
    assert_eq!(refuse("x*(x + (y)").span(), 2..3, "the outer one is open");
    error("(x|", "this `|` is not matched", "|", None);
    error("|x", "this `|` is not closed", "|", None);
    let bar = Some("it should close before `|`");
    error("|(x|", "this `(` is not closed", "(", bar);
    error("[1,2,3", "this `[` is not closed", "[", None);
    error("(x]", "this `(` is not closed", "(", Some("it should close before `]`"));
    error("γ[1", "this `[` is not closed", "[", None);
    error("γ[", "this `[` is not closed", "[", None);
    error("x)", "this `)` closes nothing", ")", None);
    error("x|", "this `|` is not matched", "|", None);
    error("()", "there is nothing between these brackets", "()", None);
}

#[test]
fn incomplete_formulas_say_so() {
    error("", "the formula is empty", "", None);
    error("  ", "the formula is empty", "  ", None);
    error("x + ", "the formula breaks off after this", "+", None);
    error("x*/y", "a number, a name or a bracket is missing before `/`", "/", None);
    error(
        "+x",
        "a number, a name or a bracket is missing before `+`",
        "+",
        Some("leave out a leading `+`"),
    );
    error(
        "x**2",
        "a number, a name or a bracket is missing before `*`",
        "*",
        Some("a power is written `a^b`"),
    );
    let equation = Some(
        "a formula is a value, not an equation: write `x + y - 2*x`, or claim the equation by identity = \
         \"x + y = 2*x\"",
    );
    let comma = Some(
        "a dot product is written `(a,b)`, a vector `[a,b,c]`, a list of formulas [\"a\", \"b\"]",
    );
    error("γ,ω", "a comma is allowed only inside brackets", ",", comma);
    error(
        "x = y",
        "`=` has no meaning in a formula",
        "=",
        Some("a formula is a value, not an equation: leave out `x =`"),
    );
    let sign = "`=` has no meaning in a formula";
    let without = |part: &str| format!("a formula is a value, not an equation: leave out `{part}`");
    error("H = x²/2", sign, "=", Some(&without("H =")));
    error("x² + y² = const", sign, "=", Some(&without("= const")));
    error("x + y = 2*x", sign, "=", equation);
    let module = Some("functions are written by their names alone, as `sin(x)`");
    error("np.sin(x)", "`.` has no meaning in a formula", ".", module);
    error("2*math.cos(x)", "`.` has no meaning in a formula", ".", module);
    let units = Some("numbers have no units: write `9.81`");
    error("9.81 m/s^2", "missing `*`", "m", units);
    error("9.81 kg*m/s²", "missing `*`", "kg", units);
    let unit = Some("numbers have no units: write `2`, or `2*kg` with a name `kg`");
    error("2 kg", "missing `*`", "kg", unit);
    error("2 m", "missing `*`", "m", Some("write `2*m`"));
    error(
        "1e99999",
        "this number is too long: at most 4000 digits and exponents within ±1000",
        "1e99999",
        None,
    );
}

#[test]
fn what_is_meant_is_written_out() {
    let help = |text: &str| refuse(text).help().unwrap_or_default().to_string();
    assert_eq!(help("x^2/2y"), "write `x^2/(2*y)` or `x^2/2*y`, whichever is meant");
    assert_eq!(help("1 + 1/2 x"), "write `1/2*x` or `1/(2*x)`, whichever is meant", "a gap");
    assert_eq!(help("exp^x"), "write `exp(x)`");
    assert_eq!(help("sin x^2"), "write `sin(x^2)`");
    assert_eq!(help("x(t)"), "write `x`, which is the value at the time t");
    assert_eq!(help("(x,y)"), "write `x*y`", "a product of scalars");
    assert_eq!(help("x[0]"), "write `x`");
    assert_eq!(help("norm(x)"), "write `|x|`");
    assert_eq!(help("x^²"), "write `a^2` or `a²`");
    assert_eq!(help("x⁄2"), "write `a/b`");
    assert!(help("floor(x)").contains("steps"), "a function that is not there");
}

#[test]
fn nesting_has_a_limit() {
    on_a_large_stack(|| {
        for open in ["(", "|", "-", "√", "[", "x^", "exp(", "2*(", "γ × (", "[1,2,"] {
            let error = refuse(&open.repeat(100_000));
            assert_eq!(error.message(), "this is nested too deeply", "{open} without end");
            assert_eq!(error.help(), Some("at most 200 levels are allowed"), "the limit is told");
        }
        let formula = format!("{}x", "-".repeat(200));
        assert_eq!(read(&formula).value_type(), Type::Scalar, "200 are fine");
    });
}
