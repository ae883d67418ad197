//! Whether a polynomial modulo a prime is a Darboux polynomial, before its coefficients are known.

use super::super::SearchError;
use super::super::ansatz::system::PrimePoint;
use super::super::echelon::Echelon;
use super::darboux::{CONJUGATES, DarbouxSearch, Terms, product};
use super::monomials::{self, value};
use super::quotients::rate_of_monomial;
use super::setting::SPARE_ORDERS;

impl DarbouxSearch<'_, '_> {
    /// Whether v(f) = K f at random points for a polynomial K other than 0.
    pub fn has_cofactor(&self, at: &PrimePoint, terms: &Terms) -> Result<bool, SearchError> {
        let (m, setting) = (at.modulus, self.setting);
        let highest = self.degree.saturating_sub(1) as u32;
        let all = monomials::up_to(self.variables, setting.dimension(), highest);
        let all = setting.independent(all, self.variables);
        let mut echelon = Echelon::new(all.len() + 1, m);
        for number in 0..(all.len() + SPARE_ORDERS) as u64 {
            setting.effort.halt.check()?;
            let Some((point, orbit)) = setting.orbit(at, number, 2)? else { return Ok(false) };
            let rates = |k: usize| orbit[k][1];
            let (mut own, mut rate) = (0, 0);
            for (monomial, factor) in terms {
                own = m.add(own, m.mul(*factor, value(&m, &point.state, monomial)));
                let slope = rate_of_monomial(at, &point, &rates, monomial);
                rate = m.add(rate, m.mul(*factor, slope));
            }
            let row = all.iter().map(|monomial| m.mul(own, value(&m, &point.state, monomial)));
            echelon.push(row.chain([m.sub(0, rate)]).collect());
        }
        let is_cofactor = |own: &Vec<u64>| {
            own[all.len()] != 0 && own[..all.len()].iter().any(|entry| *entry != 0)
        };
        Ok(echelon.null_space().iter().any(is_cofactor))
    }

    /// Whether the product of the candidates with this support has a cofactor, where that is asked:
    /// on a conic, levels of known integrals have conjugate factors.
    pub fn is_factor_together(
        &self,
        at: &PrimePoint,
        open: &[Terms],
        support: &[Vec<u32>],
    ) -> Result<bool, SearchError> {
        if self.setting.conic.is_none() {
            return Ok(true);
        }
        let same = |other: &&Terms| other.iter().map(|(own, _)| own).eq(support.iter());
        let all: Vec<Terms> = open.iter().filter(same).take(CONJUGATES).cloned().collect();
        let mut all: Terms =
            product(&at.modulus, &all, self.setting.dimension()).into_iter().collect();
        all.sort_unstable();
        self.has_cofactor(at, &all)
    }
}
