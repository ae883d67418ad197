//! Claims as values: a statement with its domain, its name and its expectation, before it is added
//! to a case.

use super::entry::ClaimEntry;
use super::{
    AnalyticDensity, Casimir, Density, DensityInVariables, Divergence, Expect, Form, Hamiltonian,
    Identity, Independent, Integral, Involution, JacobiIdentity, Lyapunov, PositionDensity, Rate,
    Relation, Reversor, SmoothDensity, Statement, Symmetry, SymmetryField,
};
use crate::formula::Formula;

/// Domain of a claim relative to the level set of its case.
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
/// The claim is checked when it is added to a case: its formulas must be in the names of the case,
/// and of the types that the kind of claim requires.
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
    entries: Vec<(&'static str, ClaimEntry)>,
    name: Option<String>,
    source: String,
    locus: Locus,
    expect: Expect,
    cell: Option<String>,
    note: Option<String>,
}

impl Claim {
    /// Makes the claim whose kind has this key, one of [`STATEMENTS`](super::STATEMENTS), from the
    /// entry that a case file has there.
    pub fn of(key: &'static str, entry: impl Into<ClaimEntry>) -> Self {
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

    /// Claims that F is a first integral.
    pub fn integral(function: impl Into<ClaimEntry>) -> Self {
        Self::of(Integral::NAME, function)
    }

    /// Claims that ρ is an invariant density.
    pub fn density(density: impl Into<ClaimEntry>) -> Self {
        Self::of(Density::NAME, density)
    }

    /// Claims that there is an analytic invariant density.
    pub fn analytic_density() -> Self {
        Self::of(AnalyticDensity::NAME, "exists")
    }

    /// Claims that there is an invariant density that is positive and C¹ at all states.
    pub fn smooth_density() -> Self {
        Self::of(SmoothDensity::NAME, "exists")
    }

    /// Claims that the divergence of the field is F.
    pub fn divergence(divergence: impl Into<ClaimEntry>) -> Self {
        Self::of(Divergence::NAME, divergence)
    }

    /// Claims that the divergence of the field relative to the volume ρ dx is F.
    pub fn divergence_relative_to(
        volume: impl Into<ClaimEntry>,
        divergence: impl Into<ClaimEntry>,
    ) -> Self {
        Self::of(Divergence::NAME, divergence).with("volume", volume)
    }

    /// Claims that there is an invariant density of the configuration.
    pub fn position_density() -> Self {
        Self::of(PositionDensity::NAME, "exists")
    }

    /// Claims that A = B.
    pub fn identity(left: &Formula, right: &Formula) -> Self {
        Self::of(Identity::NAME, ClaimEntry::Equation(left.clone(), right.clone()))
    }

    /// Claims that F' = G along the motion.
    pub fn rate(function: impl Into<ClaimEntry>, rate: impl Into<ClaimEntry>) -> Self {
        Self::of(Rate::NAME, function).with("equals", rate)
    }

    /// Claims that F' = κF, so that F = 0 is invariant.
    pub fn invariant_relation(
        function: impl Into<ClaimEntry>,
        cofactor: impl Into<ClaimEntry>,
    ) -> Self {
        Self::of(Relation::NAME, function).with("cofactor", cofactor)
    }

    /// Claims that F does not grow along the motion.
    pub fn lyapunov(function: impl Into<ClaimEntry>) -> Self {
        Self::of(Lyapunov::NAME, function)
    }

    /// Claims that the functions, and those of the level, have independent gradients.
    pub fn independent(functions: Vec<Formula>) -> Self {
        Self::of(Independent::NAME, functions)
    }

    /// Claims that the functions are in involution in the bracket of the motion.
    pub fn involution(functions: Vec<Formula>) -> Self {
        Self::of(Involution::NAME, functions)
    }

    /// Claims that the field with these components commutes with the motion; the components of
    /// variables left out are 0.
    pub fn symmetry_field(components: Vec<(String, Formula)>) -> Self {
        Self::of(SymmetryField::NAME, components)
    }

    /// Claims that the map with these images takes solutions to solutions; variables left out are
    /// unchanged.
    pub fn symmetry(images: Vec<(String, Formula)>) -> Self {
        Self::of(Symmetry::NAME, images)
    }

    /// Claims that the map with these images reverses time and is an involution; variables left out
    /// are unchanged.
    pub fn reversor(images: Vec<(String, Formula)>) -> Self {
        Self::of(Reversor::NAME, images)
    }

    /// Claims that the form with these coefficients is invariant: of `x` for … dx, of `x,y` for
    /// … dx∧dy.
    pub fn form(coefficients: Vec<(String, Formula)>) -> Self {
        Self::of(Form::NAME, coefficients)
    }

    /// Claims that the motion is Hamiltonian with the function H, in the names of the case's
    /// variables and with their bracket.
    pub fn hamiltonian(function: impl Into<ClaimEntry>) -> Self {
        Self::of(Hamiltonian::NAME, function)
    }

    /// Claims that C is a Casimir function of the bracket, in the names of the case's variables.
    pub fn casimir(function: impl Into<ClaimEntry>) -> Self {
        Self::of(Casimir::NAME, function)
    }

    /// Claims that the bracket satisfies Jacobi's identity.
    pub fn jacobi_identity() -> Self {
        Self::of(JacobiIdentity::NAME, "holds")
    }

    /// Claims that ρ dy is invariant, with ρ in the names of the case's variables y.
    pub fn density_in_variables(density: impl Into<ClaimEntry>) -> Self {
        Self::of(DensityInVariables::NAME, density)
    }

    /// Adds the entry of a further key, such as the `weight` of a symmetry field.
    #[must_use]
    pub fn with(mut self, key: &'static str, entry: impl Into<ClaimEntry>) -> Self {
        self.entries.push((key, entry.into()));
        self
    }

    /// Sets the domain of the claim; the default is the level set.
    #[must_use]
    pub fn at(mut self, locus: Locus) -> Self {
        self.locus = locus;
        self
    }

    /// Sets the name of the claim; the default is its text.
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

    /// Sets the expected verdict; the default is that the claim holds.
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

    /// Keys with their entries, that of the kind first.
    pub fn entries(&self) -> &[(&'static str, ClaimEntry)] {
        &self.entries
    }

    /// Entry of a key.
    pub fn entry(&self, key: &str) -> Option<&ClaimEntry> {
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

    /// Domain of the claim.
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
