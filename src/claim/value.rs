//! Claims as values: a statement with its place, its name and its expectation, before a case takes
//! it up.

use super::entry::Entry;
use super::{
    AnalyticDensity, Casimir, Density, DensityInVariables, Expect, Form, Hamiltonian, Identity,
    Independent, Integral, JacobiIdentity, Lyapunov, PositionDensity, Rate, Relation, Reversor,
    Statement, Symmetry, SymmetryField,
};
use crate::formula::Formula;

/// Place of a claim relative to the level set of its case.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Locus {
    /// The level set.
    #[default]
    Level,
    /// The level set, and nowhere else.
    LevelOnly,
    /// All of phase space.
    Everywhere,
    /// The set of one equation of the level, by its text.
    Equation(String),
}

/// A claim as a value, made by the constructor of its kind and judged by
/// [`Case::judge`](crate::case::Case::judge).
///
/// Nothing is checked before a case takes the claim: its formulas have to be in the names of the
/// case, and of the types that the kind of claim demands.
///
/// ```
/// use liouville::prelude::*;
///
/// let case = Model::field()
///     .parameter("k", "0.5..2")
///     .state("x", "-2..2", "v")
///     .state("v", "-2..2", "-k*x")
///     .build()?;
/// let [k, x, v] = ["k", "x", "v"].map(|name| case.formula(name));
/// let [k, x, v] = [k?, x?, v?];
/// let energy = (v.raised(2)? + &(&k * &x.raised(2)?)?)?;
/// assert_eq!(energy.to_string(), "v² + k*x²");
///
/// let claims = [
///     Claim::integral(&energy),
///     Claim::density(Formula::number(1)).named("phase volume"),
///     Claim::integral(&x).expected(Expect::Fails),
/// ];
/// let report = case.judge(&claims, &Options::default())?;
/// let verdicts: Vec<Verdict> = report.claims.iter().map(|claim| claim.verdict).collect();
/// assert_eq!(verdicts, [Verdict::Proved, Verdict::Proved, Verdict::Refuted]);
/// assert!(report.claims.iter().all(|claim| claim.agrees));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Claim {
    key: &'static str,
    entries: Vec<(&'static str, Entry)>,
    name: Option<String>,
    source: String,
    locus: Locus,
    expect: Expect,
    cell: Option<String>,
    note: Option<String>,
}

impl Claim {
    /// Makes the claim of the kind of this key, one of [`STATEMENTS`](super::STATEMENTS), from what
    /// case files write there.
    pub fn of(key: &'static str, entry: impl Into<Entry>) -> Self {
        Self {
            key,
            entries: vec![(key, entry.into())],
            name: None,
            source: String::new(),
            locus: Locus::default(),
            expect: Expect::default(),
            cell: None,
            note: None,
        }
    }

    /// F is a first integral.
    pub fn integral(function: impl Into<Entry>) -> Self {
        Self::of(Integral::NAME, function)
    }

    /// ρ is an invariant density.
    pub fn density(density: impl Into<Entry>) -> Self {
        Self::of(Density::NAME, density)
    }

    /// There is an analytic invariant density.
    pub fn analytic_density() -> Self {
        Self::of(AnalyticDensity::NAME, "exists")
    }

    /// There is an invariant density of the configuration.
    pub fn position_density() -> Self {
        Self::of(PositionDensity::NAME, "exists")
    }

    /// A = B.
    pub fn identity(left: &Formula, right: &Formula) -> Self {
        Self::of(Identity::NAME, Entry::Equation(left.clone(), right.clone()))
    }

    /// F' = G along the motion.
    pub fn rate(function: impl Into<Entry>, rate: impl Into<Entry>) -> Self {
        Self::of(Rate::NAME, function).with("equals", rate)
    }

    /// F' = κF, so that F = 0 is kept.
    pub fn invariant_relation(function: impl Into<Entry>, cofactor: impl Into<Entry>) -> Self {
        Self::of(Relation::NAME, function).with("cofactor", cofactor)
    }

    /// F does not grow.
    pub fn lyapunov(function: impl Into<Entry>) -> Self {
        Self::of(Lyapunov::NAME, function)
    }

    /// The functions, and those of the level, have independent gradients.
    pub fn independent(functions: Vec<Formula>) -> Self {
        Self::of(Independent::NAME, functions)
    }

    /// The field with these components commutes with the motion; variables left out do not change
    /// along it.
    pub fn symmetry_field(components: Vec<(String, Formula)>) -> Self {
        Self::of(SymmetryField::NAME, components)
    }

    /// The map with these images takes solutions to solutions; variables left out stay.
    pub fn symmetry(images: Vec<(String, Formula)>) -> Self {
        Self::of(Symmetry::NAME, images)
    }

    /// The map with these images reverses time, and is an involution; variables left out stay.
    pub fn reversor(images: Vec<(String, Formula)>) -> Self {
        Self::of(Reversor::NAME, images)
    }

    /// The form with these coefficients is kept: of `x` for … dx, of `x,y` for … dx∧dy.
    pub fn form(coefficients: Vec<(String, Formula)>) -> Self {
        Self::of(Form::NAME, coefficients)
    }

    /// The motion is Hamilton's, with H in the names of the case's variables and their bracket.
    pub fn hamiltonian(function: impl Into<Entry>) -> Self {
        Self::of(Hamiltonian::NAME, function)
    }

    /// C is a Casimir function of the bracket, in the names of the case's variables.
    pub fn casimir(function: impl Into<Entry>) -> Self {
        Self::of(Casimir::NAME, function)
    }

    /// The bracket satisfies Jacobi's identity.
    pub fn jacobi_identity() -> Self {
        Self::of(JacobiIdentity::NAME, "holds")
    }

    /// ρ dy is invariant in the case's variables y, in their names.
    pub fn density_in_variables(density: impl Into<Entry>) -> Self {
        Self::of(DensityInVariables::NAME, density)
    }

    /// Adds what stands under a further key, such as the `weight` of a symmetry field.
    #[must_use]
    pub fn with(mut self, key: &'static str, entry: impl Into<Entry>) -> Self {
        self.entries.push((key, entry.into()));
        self
    }

    /// Sets the place of the claim, which is the level set otherwise.
    #[must_use]
    pub fn at(mut self, locus: Locus) -> Self {
        self.locus = locus;
        self
    }

    /// Sets the name of the claim, which is its text otherwise.
    #[must_use]
    pub fn named(mut self, name: impl Into<String>) -> Self {
        self.name = Some(name.into());
        self
    }

    /// Sets the source of the claim: an equation of a paper.
    #[must_use]
    pub fn from_source(mut self, source: impl Into<String>) -> Self {
        self.source = source.into();
        self
    }

    /// Sets what is expected of the claim: that it holds, otherwise.
    #[must_use]
    pub fn expected(mut self, expect: Expect) -> Self {
        self.expect = expect;
        self
    }

    /// Sets the row of a paper's table that the claim fills.
    #[must_use]
    pub fn in_cell(mut self, cell: impl Into<String>) -> Self {
        self.cell = Some(cell.into());
        self
    }

    /// Adds a note.
    #[must_use]
    pub fn noted(mut self, note: impl Into<String>) -> Self {
        self.note = Some(note.into());
        self
    }

    /// Key of the kind of claim.
    pub fn key(&self) -> &'static str {
        self.key
    }

    /// Keys with what stands under them, that of the kind first.
    pub fn entries(&self) -> &[(&'static str, Entry)] {
        &self.entries
    }

    /// What stands under a key.
    pub fn entry(&self, key: &str) -> Option<&Entry> {
        self.entries.iter().find(|(own, _)| *own == key).map(|(_, entry)| entry)
    }

    /// Name, if one is set.
    pub fn name(&self) -> Option<&str> {
        self.name.as_deref()
    }

    /// Source; empty where none is set.
    pub fn source(&self) -> &str {
        &self.source
    }

    /// Place.
    pub fn locus(&self) -> &Locus {
        &self.locus
    }

    /// Expectation.
    pub fn expect(&self) -> Expect {
        self.expect
    }

    /// Row of a paper's table, if one is set.
    pub fn cell(&self) -> Option<&str> {
        self.cell.as_deref()
    }

    /// Note, if there is one.
    pub fn note(&self) -> Option<&str> {
        self.note.as_deref()
    }
}
