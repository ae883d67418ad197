//! Systems and claims as values: the same as from a file, and refused where they do not fit.

use liouville::formula::Type;
use liouville::prelude::*;

/// What a model consists of, as text.
fn parts(case: &Case) -> Vec<String> {
    let model = &case.model;
    let mut parts = vec![
        case.system.clone(),
        format!("{:?}", case.chart),
        format!("{:?}", case.free_draws),
        format!("{:?}", model.parameters),
        format!("{:?}", model.state),
    ];
    let text = |formula: &&Formula| formula.to_string().replace(' ', "");
    let texts = |formulas: Vec<&Formula>| formulas.iter().map(text).collect::<Vec<_>>();
    parts.extend(texts(model.functions()));
    parts.extend(texts(model.abbreviations.iter().collect()));
    parts.extend(model.level.iter().map(|equation| equation.text.clone()));
    let mut names: Vec<String> = model
        .vocabulary
        .iter()
        .map(|(_, entry)| format!("{} {:?} {:?}", entry.name, entry.kind, entry.reach))
        .collect();
    names.sort();
    parts.extend(names);
    parts
}

fn claims_of(case: &Case, texts: &[&str]) -> Vec<Claim> {
    texts.iter().map(|text| Claim::integral(case.formula(text).expect("a formula"))).collect()
}

fn reports(report: &CaseReport) -> Vec<String> {
    let one = |claim: &ClaimReport| serde_json::to_string(claim).expect("JSON");
    report.claims.iter().map(one).collect()
}

#[test]
fn a_field_is_the_same_from_values_and_from_a_file() {
    let text = r#"
        title = "spherical pendulum"
        system = "field"
        [parameters]
        g = "0.5..2"
        l = 2
        w = "g/l"
        [state]
        q = "vector(-1..1)"
        p = "vector(-1..1)"
        [let]
        up = "[0, 0, 1]"
        [field]
        q = "p"
        p = "−w*up + (w*(q,up) − (p,p))*q"
        [level]
        equations = ["(q,q) = 1", "(q,p) = 0"]
        [[claim]]
        integral = "(p,p)/2 + w*(q,up)"
        [[claim]]
        integral = "(q × p)[3]"
        [[claim]]
        integral = "q[3]"
        expect = "fails"
    "#;
    let file = Case::parse(text, &[]).expect("a case");
    let built = Model::field()
        .title("spherical pendulum")
        .parameter("g", "0.5..2")
        .parameter("l", 2)
        .parameter("w", "g/l")
        .variable("q", "vector(-1..1)")
        .variable("p", "vector(-1..1)")
        .define("up", "[0, 0, 1]")
        .rate("q", "p")
        .rate("p", "−w*up + (w*(q,up) − (p,p))*q")
        .level("(q,q)", Formula::number(1))
        .level("(q,p)", Formula::number(0))
        .build()
        .expect("a case");
    assert_eq!(parts(&built), parts(&file));
    let mut claims = claims_of(&built, &["(p,p)/2 + w*(q,up)", "(q × p)[3]", "q[3]"]);
    claims[2] = claims[2].clone().expected(Expect::Fails);
    let options = Options::default();
    let by_values = built.judge(&claims, &options).expect("judged");
    let by_file = judge(&file, &options).expect("judged");
    assert_eq!(reports(&by_values), reports(&by_file), "the same reports, with all evidence");
    assert!(by_values.claims.iter().all(|claim| claim.agrees));
}

#[test]
fn a_body_is_the_same_from_values_and_from_a_file() {
    let text = r#"
        title = "ball"
        system = "rubber-sphere"
        [parameters]
        m = "0.5..2"
        R = "1..3"
        k = "0.2..1"
        g = "0.5..2"
        I = "inertia(0.5..5)"
        S = "vector(-1..1)"
        [body]
        support = "R*|γ|"
        gyrostat = "S"
        potential = "g*γ3"
        [[claim]]
        integral = "energy"
        [[claim]]
        density = "1"
        expect = "open"
    "#;
    let file = Case::parse(text, &[]).expect("a case");
    let built = Model::rubber_sphere()
        .title("ball")
        .parameter("m", "0.5..2")
        .parameter("R", "1..3")
        .parameter("k", "0.2..1")
        .parameter("g", "0.5..2")
        .parameter("I", "inertia(0.5..5)")
        .parameter("S", "vector(-1..1)")
        .support("R*|γ|")
        .gyrostat("S")
        .potential("g*γ3")
        .build()
        .expect("a case");
    assert_eq!(parts(&built), parts(&file));
    let energy = built.formula("energy").expect("a name");
    let claims = [Claim::integral(energy), Claim::density(1).expected(Expect::Open)];
    let options = Options::default();
    let by_values = built.judge(&claims, &options).expect("judged");
    let by_file = judge(&file, &options).expect("judged");
    assert_eq!(reports(&by_values), reports(&by_file), "the same reports, with all evidence");
}

#[test]
fn a_body_that_may_spin_is_the_same_by_values() {
    let text = r#"
        title = "ellipsoid"
        system = "rolling-sphere"
        [parameters]
        m = "0.5..2"
        k = "0.1..0.3"
        B = "diag(1..3)"
        I = "full(0.5..5)"
        S = "vector(-1..1)"
        [body]
        support = "√(γ,B*γ)"
        gyrostat = "S"
        [[claim]]
        divergence = "(χ,ω)"
        volume = "D_T"
        [[claim]]
        divergence = "(χ,ω)"
        expect = "fails"
        [[claim]]
        smooth-density = "exists"
        expect = "open"
        [[claim]]
        analytic-density = "exists"
        expect = "open"
        source = "(2.1)"
        [[claim]]
        position-density = "exists"
        expect = "open"
    "#;
    let file = Case::parse(text, &[]).expect("a case");
    let built = Model::rolling_sphere()
        .title("ellipsoid")
        .parameter("m", "0.5..2")
        .parameter("k", "0.1..0.3")
        .parameter("B", "diag(1..3)")
        .parameter("I", "full(0.5..5)")
        .parameter("S", "vector(-1..1)")
        .support("√(γ,B*γ)")
        .gyrostat("S")
        .build()
        .expect("a case");
    assert_eq!(parts(&built), parts(&file));
    let formula = |text: &str| built.formula(text).expect("a formula");
    let claims = [
        Claim::divergence_relative_to(formula("D_T"), formula("(χ,ω)")),
        Claim::divergence(formula("(χ,ω)")).expected(Expect::Fails),
        Claim::smooth_density().expected(Expect::Open),
        Claim::analytic_density().expected(Expect::Open).from_source("(2.1)"),
        Claim::position_density().expected(Expect::Open),
    ];
    let options = Options::default();
    let by_values = built.judge(&claims, &options).expect("judged");
    let by_file = judge(&file, &options).expect("judged");
    assert_eq!(reports(&by_values), reports(&by_file), "the same reports, with all evidence");
    assert!(by_values.claims.iter().all(|claim| claim.agrees), "D_T belongs to the volume");
}

fn oscillator() -> Case {
    let built = Model::field().state("x", "-2..2", "v").state("v", "-2..2", "-x");
    built.build().expect("a case")
}

#[test]
fn an_invariant_relation_has_its_cofactor() {
    let case = Model::field().state("x", "-2..2", "x*v").state("v", "-2..2", "-v").build();
    let case = case.expect("a case");
    let [x, v] = ["x", "v"].map(|name| case.formula(name).expect("a name"));
    let claims = [
        Claim::invariant_relation(&x, &v),
        Claim::invariant_relation(&x, &x).expected(Expect::Fails),
    ];
    let report = case.judge(&claims, &Options::default()).expect("judged");
    assert!(report.claims.iter().all(|claim| claim.agrees), "{:?}", report.claims);
}

fn refusal(case: &Case, claim: Claim) -> String {
    let taken = case.with_claims(&[claim]);
    taken.map(|_| ()).expect_err("it does not fit").to_string()
}

#[test]
fn claims_that_do_not_fit_are_refused() {
    let case = oscillator();
    let [x, v] = ["x", "v"].map(|name| case.formula(name).expect("a name"));
    let vector = Formula::vector(&[&x, &v]).expect("a vector");
    let found = refusal(&case, Claim::density(&vector));
    assert!(found.contains("is a vector of length 2, and has to be a scalar"), "{found}");
    let found = refusal(&case, Claim::identity(&x, &vector));
    assert!(found.contains("compared"), "{found}");
    let found = refusal(&case, Claim::integral(&x).with("weight", 1));
    assert!(found.contains("no `weight`"), "{found}");
    let found = refusal(&case, Claim::of("integrals", &x));
    assert!(found.contains("kind of claim is unknown"), "{found}");
    let found = refusal(&case, Claim::hamiltonian(&x));
    assert!(found.contains("new variables"), "{found}");
    let found = refusal(&case, Claim::symmetry_field(vec![("y".to_string(), x.clone())]));
    assert!(found.contains("`y` is not a state variable"), "{found}");
    let found = refusal(&case, Claim::integral(&x).at(Locus::Equation("x = 0".to_string())));
    assert!(found.contains("not a place"), "{found}");
    let twice = [Claim::integral(&x).named("F"), Claim::density(1).named("F")];
    assert!(case.with_claims(&twice).is_err(), "a name is given once");
}

#[test]
fn formulas_of_another_case_are_refused() {
    let other = Model::field()
        .parameter("k", "1..2")
        .state("y", "-2..2", "v")
        .state("v", "-2..2", "-k*y")
        .build()
        .expect("a case");
    let case = oscillator();
    for text in ["k", "y", "v", "k*v + 1"] {
        let stranger = other.formula(text).expect("a formula");
        let found = refusal(&case, Claim::integral(&stranger));
        assert!(found.contains("not a name of this case"), "{text}: {found}");
        assert!(case.clone().define("F", &stranger).is_err(), "{text} as a name");
        assert!(case.with_variables(&[("z".to_string(), stranger)]).is_err(), "{text} as an image");
    }
    let own = case.formula("x² + v²").expect("a formula");
    assert!(case.with_claims(&[Claim::integral(own)]).is_ok(), "one of its own is taken");
}

#[test]
fn a_hidden_name_keeps_its_meaning() {
    let case = oscillator();
    let energy = case.formula("x² + v²").expect("a formula");
    let mut named = case.clone();
    named.define("x", &case.formula("v").expect("a name")).expect("a new x");
    assert_eq!(named.formula("x").expect("a name").value_type(), Type::Scalar);
    let claims = [
        Claim::integral(&energy),
        Claim::integral(named.formula("x² + v²").expect("a formula")).expected(Expect::Fails),
    ];
    let report = named.judge(&claims, &Options::default()).expect("judged");
    assert!(report.claims.iter().all(|claim| claim.agrees), "the first x is the state's");
}

#[test]
fn brackets_of_variables_are_judged() {
    let case = oscillator();
    let own = |name: &str| (name.to_string(), case.formula(name).expect("a name"));
    let asked = case.with_variables(&[own("x"), own("v")]).expect("variables");
    let one = asked.in_variables(&Formula::number(1)).expect("a number");
    let bracketed = asked.with_bracket(&[((0, 1), one.clone())]).expect("a bracket");
    let energy = case.formula("(x² + v²)/2").expect("a formula");
    let energy = bracketed.in_variables(&energy).expect("in the variables");
    let claims = [
        Claim::hamiltonian(&energy),
        Claim::jacobi_identity(),
        Claim::casimir(&energy).expected(Expect::Fails),
    ];
    let report = bracketed.judge(&claims, &Options::default()).expect("judged");
    let verdicts: Vec<Verdict> = report.claims.iter().map(|claim| claim.verdict).collect();
    assert_eq!(verdicts, [Verdict::Proved, Verdict::Proved, Verdict::Refuted]);
    assert!(asked.with_bracket(&[((0, 2), one.clone())]).is_err(), "there are two variables");
    assert!(asked.with_bracket(&[((0, 1), one.clone()), ((1, 0), one)]).is_err(), "given twice");
    let x = case.formula("x").expect("a name");
    assert!(asked.with_bracket(&[((0, 1), x)]).is_err(), "in the names of the case");
}

#[test]
fn builders_return_the_first_mistake() {
    let messages = [
        (Model::field().build(), "no state variables"),
        (Model::field().variable("x", "-2..2").build(), "the rate is missing"),
        (Model::field().state("x", "-2..2", "y").build(), "unknown name `y`"),
        (Model::field().state("x", "2", "1").build(), "needs a range"),
        (Model::field().state("x", 1_i64..1, "1").build(), "is empty"),
        (Model::field().state("x", "-2..2", "[1, 2, 3]").build(), "is a vector"),
        (Model::field().parameter("x", 1).state("x", "-2..2", "1").build(), "taken already"),
        (Model::field().parameter("2x", 1).build(), "not a name"),
        (Model::field().rate("x", "1").build(), "not a state variable"),
        (Model::field().support("1").build(), "no body"),
        (Model::rubber_plane().support("|γ|").build(), "unknown name `m`"),
        (Model::rubber_plane().level("ω1", "0").build(), "is fixed"),
    ];
    for (built, expected) in messages {
        let error = built.map(|_| ()).expect_err(expected).to_string();
        assert!(error.contains(expected), "{error}");
    }
    let begun = Model::rubber_plane().parameter("m", "1..2").parameter("I", "inertia(1..2)");
    assert!(begun.clone().build().is_err(), "a body has a shape");
    assert!(begun.clone().support("|ω|").build().is_err(), "of γ and parameters alone");
    assert!(begun.clone().support("|γ|").potential("U").build().is_err(), "U is not known in U");
    assert!(begun.support("|γ|").rate("ω", "γ").build().is_err(), "the rate of ω is known");
}

#[test]
fn maps_are_built_as_values() {
    let map = || Model::map().parameter("a", "1..2").state("x", "1..2", "y/a");
    let built = map().state("y", "1..2", "a*x").build().expect("a map");
    let claims = [
        Claim::integral(built.formula("x*y").expect("a formula")),
        Claim::integral(built.formula("x + y").expect("a formula")).expected(Expect::Fails),
    ];
    let report = built.judge(&claims, &Options::default()).expect("judged");
    assert!(report.claims.iter().all(|claim| claim.agrees), "x*y is kept, and x + y is not");
    let refused = |built: Result<Case, liouville::case::ClaimError>| {
        built.map(|_| ()).expect_err("refused").to_string()
    };
    let missing = refused(map().variable("y", "1..2").build());
    assert!(missing.contains("the image is missing"), "{missing}");
    let open = refused(map().state("y", "1..2", "∫(exp(x²), x)").build());
    assert!(open.contains("an image cannot contain ∫"), "{open}");
}

#[test]
fn levels_have_charts_as_values() {
    let circle = || {
        let free = Model::field().state("x", "-1..1", "-y").state("y", "-1..1", "x");
        free.level("x² + y²", "1")
    };
    let inputs = || [("u".to_string(), "-2..2")];
    let formulas = |y: &str| {
        let x = ("x".to_string(), "2*u/(1 + u²)".to_string());
        [x, ("y".to_string(), y.to_string())]
    };
    let built = circle().chart(inputs(), formulas("(1 − u²)/(1 + u²)")).build().expect("a case");
    let one = built.formula("x² + y²").expect("a formula");
    let claim = Claim::identity(&one, &Formula::number(1));
    let report = built.judge(&[claim], &Options::default()).expect("judged");
    assert_eq!(report.claims[0].verdict, Verdict::Proved);
    let refused = |y: &str| {
        let built = circle().chart(inputs(), formulas(y)).build();
        built.map(|_| ()).expect_err("refused").to_string()
    };
    assert!(refused("z").contains("y"), "z is no name of the chart: {}", refused("z"));
    assert!(refused("[u, u]").contains("vector"), "{}", refused("[u, u]"));
    let taken = circle().chart([("x".to_string(), "nonsense")], formulas("u")).build();
    assert!(taken.is_err(), "an input needs a range");
}
