//! Items of a benchmark: three work items of fixed size, or the cases of a user.

use super::one_by_one::{BlockResidual, OneAfterOther, one_by_one};
use super::{DifferentiationMethod, NATIVE, by_hand};
use liouville::case::{Case, CaseError};
use liouville::graph::{Kernel, with_widest_vectors};

/// A residual written by hand with num-dual.
#[derive(Clone, Copy, Debug)]
pub struct PlainCode {
    /// Plain code, or from a formula for the residual.
    pub method: DifferentiationMethod,
    /// Name of the arithmetic, with the instruction set if it is not the default one.
    pub domain: &'static str,
    /// The residual from the components of states.
    pub residual: BlockResidual,
}

/// A case to be measured.
pub struct BenchItem {
    /// Name: `W1`, or the path of a case file.
    pub name: String,
    /// The case; each of its claims is measured.
    pub case: Case,
    /// Residuals written by hand with num-dual: plain code first, then from a formula for the
    /// residual, where there is one.
    pub by_hand: Vec<PlainCode>,
}

impl BenchItem {
    /// An item for a user's case.
    pub fn new(name: String, case: Case) -> Self {
        Self { name, case, by_hand: Vec::new() }
    }
}

/// A work item: a case with fixed parameters and one claim.
struct WorkItem {
    name: &'static str,
    text: &'static str,
    /// The plain code by default, and natively.
    plain: [BlockResidual; 2],
    closed: Option<[BlockResidual; 2]>,
}

const WORK_ITEMS: [WorkItem; 3] = [
    WorkItem {
        name: "W1",
        text: "title = 'W1'\nsystem = 'rubber-plane'\n[parameters]\nm = 1.3\nR = 3\n\
               c = [0.7, -0.4, 1.1]\nI = [2.6, 1.2, 1.8]\n[body]\nshape = 'ball'\n[[claim]]\n\
               integral = '|Ĩ*ω × γ|² − 2*m*R*(γ,c)*(Ĩ*ω,ω)'\n",
        plain: one_by_one!(by_hand::second_integral_along_field),
        closed: None,
    },
    WorkItem {
        name: "W2",
        text: "title = 'W2'\nsystem = 'rubber-plane'\n[parameters]\nm = 1.3\nmu = 2\n\
               B = [1, 2, 3.5]\nI = 'm*B + mu*E'\n[body]\nshape = 'ellipsoid'\n[[claim]]\n\
               density = '(γ,adj(Ĩ)*γ)'\n",
        plain: one_by_one!(by_hand::liouville_residual),
        closed: None,
    },
    WorkItem {
        name: "W3",
        text: "title = 'W3'\nsystem = 'rubber-plane'\n[parameters]\nm = 1.3\nB = [1, 2, 3.5]\n\
               I = [2.6, 1.2, 1.8]\n[body]\nshape = 'ellipsoid'\n[[claim]]\n\
               analytic-density = 'exists'\nexpect = 'fails'\n",
        plain: one_by_one!(by_hand::criterion),
        closed: Some(one_by_one!(by_hand::criterion_in_closed_form)),
    },
];

/// Builds the work items.
///
/// W1: L_vF₂ of the unbalanced ball, F₂ = |Ĩω × γ|² - 2mR(γ,c)(Ĩω,ω).
/// W2: v(ln ρ) + div v of the ellipsoid with I = mB + μE, ρ = (γ,adj(Ĩ)γ).
/// W3: (γ, rot a) of an ellipsoid with any inertia, which is not zero.
pub fn work_items() -> Result<Vec<BenchItem>, CaseError> {
    WORK_ITEMS
        .iter()
        .map(|item| {
            let case = Case::parse(item.text, &[])?;
            let both = |method, residuals: [BlockResidual; 2]| {
                let code = move |(domain, residual)| PlainCode { method, domain, residual };
                ["f64", NATIVE].into_iter().zip(residuals).map(code)
            };
            let closed = item.closed.into_iter();
            let closed = closed.flat_map(|own| both(DifferentiationMethod::NumDualClosedForm, own));
            let plain = both(DifferentiationMethod::NumDualByHand, item.plain);
            let by_hand = plain.chain(closed).collect();
            Ok(BenchItem { name: item.name.to_string(), case, by_hand })
        })
        .collect()
}
