//! Where a system stands in the hierarchy of BMB 2013: integral and measure, integral only, measure
//! only, neither; and what is typical of it.

use serde::Serialize;

/// What is known of an invariant density that is positive.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Measure {
    /// One was found in closed form, and proved.
    ClosedForm,
    /// One exists by the criterion, by quadrature.
    ByQuadrature,
    /// None that is positive and C¹ near ω = 0 exists.
    Excluded,
    /// None of the configuration alone exists; others are not known.
    ExcludedForConfiguration,
    /// One with zeros or poles was found; no positive one is known.
    Singular,
    /// Nothing is known.
    NotKnown,
}

/// What is known of integrals beside the energy.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Integrals {
    /// As many as Euler and Jacobi's theorem needs, or more.
    Enough,
    /// Some, but fewer.
    Some,
    /// None is known; none that is polynomial in the velocities up to a degree exists.
    ExcludedToDegree(u32),
    /// None is known.
    NotKnown,
}

/// The place in the hierarchy.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum Class {
    /// An integral beside the energy, and a measure.
    #[serde(rename = "integral and measure")]
    IntegralAndMeasure,
    /// An integral, and no measure.
    #[serde(rename = "integral only")]
    IntegralOnly,
    /// A measure, and no integral that is known.
    #[serde(rename = "measure only")]
    MeasureOnly,
    /// No measure, and no integral that is known.
    #[serde(rename = "neither")]
    Neither,
    /// The measure is not decided.
    #[serde(rename = "not known")]
    NotKnown,
}

/// The place in the hierarchy, with what it rests on and what is typical of it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Standing {
    /// The class.
    pub class: Class,
    /// What is known of densities.
    pub measure: Measure,
    /// What is known of integrals.
    pub integrals: Integrals,
    /// On what the class rests, and what it leaves open.
    pub grounds: Vec<String>,
    /// What is typical of the class.
    pub typical: Vec<String>,
}

impl Class {
    /// The words used in reports.
    pub fn words(self) -> &'static str {
        match self {
            Class::IntegralAndMeasure => "integral and measure",
            Class::IntegralOnly => "integral only",
            Class::MeasureOnly => "measure only",
            Class::Neither => "neither integral nor measure",
            Class::NotKnown => "not known",
        }
    }
}

impl Standing {
    /// The standing of a system with these invariants; `reversors` is how many were found.
    pub fn of(measure: Measure, integrals: Integrals, reversors: usize) -> Self {
        let has_integral = matches!(integrals, Integrals::Enough | Integrals::Some);
        let class = match (measure, has_integral) {
            (Measure::ClosedForm | Measure::ByQuadrature, true) => Class::IntegralAndMeasure,
            (Measure::ClosedForm | Measure::ByQuadrature, false) => Class::MeasureOnly,
            (Measure::Excluded, true) => Class::IntegralOnly,
            (Measure::Excluded, false) => Class::Neither,
            (Measure::ExcludedForConfiguration | Measure::Singular | Measure::NotKnown, _) => {
                Class::NotKnown
            }
        };
        let grounds = vec![grounds_of(measure).to_string(), integrals.grounds()];
        let mut typical: Vec<String> =
            typical(class, integrals).iter().map(|line| line.to_string()).collect();
        if reversors > 0 && matches!(class, Class::IntegralOnly | Class::Neither | Class::NotKnown)
        {
            typical.push(
                "each reversor takes an attractor to a repeller of the same kind; near its fixed set \
                 the motion may be like that of a conservative system, and a symmetric periodic orbit \
                 has multipliers in pairs λ, 1/λ"
                    .to_string(),
            );
        }
        Self { class, measure, integrals, grounds, typical }
    }
}

fn grounds_of(measure: Measure) -> &'static str {
    match measure {
        Measure::ClosedForm => "a measure: proved, in closed form",
        Measure::ByQuadrature => "a measure: proved to exist, by quadrature",
        Measure::Excluded => {
            "no measure: the criterion is not 0, so that no density is positive and C¹ near ω = 0; one \
             with singularities there is not excluded"
        }
        Measure::ExcludedForConfiguration => {
            "a measure: not known; no density of the configuration alone exists, one that depends on \
             the velocities is open"
        }
        Measure::Singular => {
            "a measure: not known; an invariant density was found, with zeros or poles, and is a measure \
             between them"
        }
        Measure::NotKnown => "a measure: not known",
    }
}

impl Integrals {
    fn grounds(self) -> String {
        match self {
            Integrals::Enough => {
                "integrals: proved, as many as Euler and Jacobi's theorem needs".to_string()
            }
            Integrals::Some => {
                "integrals: proved, but fewer than Euler and Jacobi's theorem needs".to_string()
            }
            Integrals::ExcludedToDegree(degree) => format!(
                "an integral beside the energy: none known; none that is polynomial in the velocities of \
                 degree at most {degree} exists for generic parameters; others are not known"
            ),
            Integrals::NotKnown => "an integral beside the energy: not known".to_string(),
        }
    }
}

fn typical(class: Class, integrals: Integrals) -> &'static [&'static str] {
    match (class, integrals) {
        (Class::IntegralAndMeasure, Integrals::Enough) => &[
            "integrable by quadratures (Euler, Jacobi): on compact regular joint levels without fixed \
             points the motion is on two-dimensional tori, quasi-periodic after a change of time",
            "no attractors, no chaos",
        ],
        (Class::IntegralAndMeasure, _) => {
            &["motion on the joint levels keeps a measure: no attractors; one integral short of \
             quadratures, chaos is possible and usually weak"]
        }
        (Class::IntegralOnly, _) => &[
            "the phase space is foliated by the joint levels; on them there may be limit cycles, \
             towards which the motion settles, and rotation numbers may lock",
            "no chaos where the joint levels are two-dimensional",
        ],
        (Class::MeasureOnly, _) => {
            &["the Poincaré map keeps an area: no attractors, islands in a chaotic sea as in a \
             Hamiltonian system"]
        }
        (Class::Neither, _) => &[
            "attractors and repellers are possible, strange ones among them, as in a dissipative \
             system, though the energy is kept",
        ],
        (Class::NotKnown, _) => &[],
    }
}
