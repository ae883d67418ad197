//! Recorded values without which formulas, as written, have none.

use super::phase::Phase;
use super::system::System;
use crate::formula::{Exponents, Formula, Symbol, Value};
use crate::graph::{Expr, divisors_of, has_moduli, left_out, literally, logarithms_times_zero};
use crate::number::UnaryFunction;
use crate::scalar::Scalar;

impl<T: Scalar> Phase<'_, T> {
    /// Evaluates a formula literally, with 0·ln X for each power X^Y that has a value for X > 0 alone.
    pub fn with_logarithms(&self, formula: &Formula) -> Value<T> {
        let model = self.model();
        let exponents = Exponents {
            varies: &|symbol| model.varies(symbol),
            is_listed: &|symbol| model.is_listed(symbol),
        };
        formula
            .evaluate_with_logarithms(&exponents, &mut |symbol| self.symbol_with_logarithms(symbol))
    }

    fn symbol_with_logarithms(&self, symbol: Symbol) -> Value<T> {
        let formula = |symbol| self.literal_formula(symbol);
        self.with_logarithms.value(symbol, &formula, &|symbol| match self.literal_formula(symbol) {
            Some(formula) => self.with_logarithms(formula),
            None => self.value(symbol),
        })
    }
}

impl Phase<'_, Expr> {
    /// Records the components of formulas so that they are defined exactly where everything written
    /// is; components that are defined everywhere are omitted.
    pub fn literal_values<'f>(&self, formulas: impl IntoIterator<Item = &'f Formula>) -> Vec<Expr> {
        let written = |f: &'f Formula| {
            let mut values = self.evaluate_literally(f).components();
            values.extend(self.presupposed(f));
            values
        };
        let values = formulas.into_iter().flat_map(written);
        values.filter(|value| !value.is_always_defined()).collect()
    }

    /// Records the equations of motion that are derived from energies so that they are defined exactly
    /// where all slopes in them are: that of √x² is 0·(1/0) at 0. Rates that a file gives are formulas.
    pub fn motion_as_written(&self) -> Vec<Expr> {
        if self.model().system.has_given_rates() {
            return Vec::new();
        }
        let rates = literally(|| self.with(&[], &self.state()).field().to_vec());
        rates.into_iter().filter(|rate| !rate.is_always_defined()).collect()
    }

    /// Records what equations of motion that are derived from energies have no value without, though neither their
    /// values nor `written`, the energies, show it: a mass in 0·(1/m).
    ///
    /// A determinant of masses may be 0 at all states, though not by its form. A modulus may hide the sign of
    /// more, so that all that is written is asked then.
    pub fn hidden_in_motion(&self, written: &[Expr]) -> Vec<Expr> {
        let system = &self.model().system;
        // Where elimination may divide by 0 on an open set, the states there count nevertheless if the determinant
        // of the masses and constraints is not 0.
        if let System::Lagrangian(own) = system
            && !own.has_known_divisors()
        {
            let mut hidden = left_out(written, &inverses(own.determinants(self)));
            if has_moduli(written) {
                hidden.extend(own.slopes_as_written(&self.with(&[], &self.state())));
            }
            return hidden;
        }
        if has_moduli(written) {
            return self.motion_as_written();
        }
        // Claims that do not contain the rates say nothing where there are none, either.
        let inverses = match system {
            System::Lagrangian(_) => self.inverse_divisors(),
            _ => inverses(system.divisors(self)),
        };
        left_out(written, &inverses)
    }

    /// Records the inverses of what the rates are divided by when they are solved for.
    fn inverse_divisors(&self) -> Vec<Expr> {
        let divisors = divisors_of(|| {
            self.with(&[], &self.state()).field();
        });
        inverses(divisors)
    }

    /// Records the inverses of what the equations of motion are divided by, where nothing is known of it: a claim that
    /// says something of motions says nothing where one of them has no value, and nobody knows whether motions do.
    pub fn open_divisors(&self) -> Vec<Expr> {
        match &self.model().system {
            System::Lagrangian(own) if !own.has_known_divisors() => self.inverse_divisors(),
            _ => Vec::new(),
        }
    }

    /// Evaluates as written what a formula has no value without, though its value need not show it: the
    /// integrand of each ∫, also of the parameters in it, and the logarithm of the base of each power
    /// with an exponent that varies, which may come out as a whole number.
    pub fn presupposed(&self, formula: &Formula) -> Vec<Expr> {
        let model = self.model();
        let own = std::iter::once(formula).chain(model.parameter_formulas_of(&[formula]));
        let with_names = |own| model.vocabulary.with_abbreviations(own, &model.abbreviations);
        let all: Vec<&Formula> = own.flat_map(with_names).collect();
        let varies = |symbol| model.varies(symbol);
        let has_powers = all.iter().any(|used| used.has_varying_exponent(&varies));
        let mut found = match has_powers {
            true => logarithms_times_zero(&self.with_logarithms(formula).components()),
            false => Vec::new(),
        };
        found.extend(all.into_iter().flat_map(|used| {
            literally(|| {
                let all = used.antiderivatives(&mut |symbol| self.literal_value(symbol));
                all.into_iter().map(|(integrand, _)| integrand).collect::<Vec<Expr>>()
            })
        }));
        found
    }
}

/// Records inverses literally: they have no value where a divisor is 0.
fn inverses(divisors: Vec<Expr>) -> Vec<Expr> {
    let inverse = |divisor: Expr| literally(|| divisor.apply(UnaryFunction::Recip));
    divisors.into_iter().map(inverse).collect()
}
