//! Place of a system in the hierarchy of BMB 2013: integral and measure, integral only, measure
//! only, neither; and the behaviour typical of each class.

use serde::Serialize;

/// State of knowledge about a positive invariant density.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum MeasureStatus {
    /// Found in closed form, and proved.
    ClosedForm,
    /// Known to exist by the criterion, given by a quadrature.
    ByQuadrature,
    /// Proved not to exist, if positive and C¹ near ω = 0.
    Excluded,
    /// Proved not to exist, if continuous and positive near a permanent rotation.
    ExcludedAtRotation,
    /// Proved not to exist, if continuous and positive near the rest at 0.
    ExcludedAtRest,
    /// Proved not to exist as a function of the configuration alone; otherwise unknown.
    ExcludedForConfiguration,
    /// Found with zeros or poles; no positive density is known.
    Singular,
    /// Found as a function of the state and the time t; no density of the state is known.
    WithTime,
    /// Unknown.
    NotKnown,
}

/// State of knowledge about integrals other than the energy.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Integrals {
    /// At least as many as the theorem of Euler and Jacobi needs.
    Enough,
    /// The same, if some are independent that are shown to be so on a part of the states only.
    EnoughOnAPart,
    /// Some, but fewer than the theorem needs.
    Some,
    /// None known; none exists that is polynomial in the velocities up to this degree.
    ExcludedToDegree(u32),
    /// None known.
    NotKnown,
}

/// A class of the hierarchy.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum HierarchyClass {
    /// An integral other than the energy, and a measure.
    #[serde(rename = "integral and measure")]
    IntegralAndMeasure,
    /// An integral, and no measure.
    #[serde(rename = "integral only")]
    IntegralOnly,
    /// A measure, and no known integral.
    #[serde(rename = "measure only")]
    MeasureOnly,
    /// No measure, and no known integral.
    #[serde(rename = "neither")]
    Neither,
    /// A measure is neither known nor excluded.
    #[serde(rename = "not known")]
    NotKnown,
    /// Another class for other listed values of the parameters.
    #[serde(rename = "depends on the listed values")]
    ByValue,
}

/// Place of a system in the hierarchy, with the grounds for it and its typical behaviour.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct HierarchyPlace {
    /// Class of the system.
    pub class: HierarchyClass,
    /// State of knowledge about densities.
    pub measure: MeasureStatus,
    /// State of knowledge about integrals.
    pub integrals: Integrals,
    /// Grounds for the class, and questions left open.
    pub grounds: Vec<String>,
    /// Typical behaviour of the class.
    pub typical: Vec<String>,
}

impl HierarchyClass {
    /// Returns the name used in reports.
    pub fn words(self) -> &'static str {
        match self {
            HierarchyClass::IntegralAndMeasure => "integral and measure",
            HierarchyClass::IntegralOnly => "integral only",
            HierarchyClass::MeasureOnly => "measure only",
            HierarchyClass::Neither => "neither integral nor measure",
            HierarchyClass::NotKnown => "not known",
            HierarchyClass::ByValue => "depends on the listed values of the parameters",
        }
    }
}

/// Features of a system besides its measures and its integrals.
#[derive(Clone, Copy, Debug, Default)]
pub struct KnownFeatures {
    /// Number of reversors found.
    pub reversors: usize,
    /// Whether the energy is proved to be an integral.
    pub has_energy: bool,
    /// Dimension of the levels of the energy, if the system does not depend on time and keeps an
    /// energy: nothing is typical of other systems.
    pub dimension: Option<usize>,
    /// Whether parameters are free, so that an absence of integrals is one for generic values.
    pub has_free: bool,
}

impl HierarchyPlace {
    /// Finds the standing of a system with these invariants.
    pub fn of(measure: MeasureStatus, integrals: Integrals, features: KnownFeatures) -> Self {
        let has_integral =
            matches!(integrals, Integrals::Enough | Integrals::EnoughOnAPart | Integrals::Some);
        let class = match (measure, has_integral) {
            (MeasureStatus::ClosedForm | MeasureStatus::ByQuadrature, true) => {
                HierarchyClass::IntegralAndMeasure
            }
            (MeasureStatus::ClosedForm | MeasureStatus::ByQuadrature, false) => {
                HierarchyClass::MeasureOnly
            }
            (
                MeasureStatus::Excluded
                | MeasureStatus::ExcludedAtRotation
                | MeasureStatus::ExcludedAtRest,
                true,
            ) => HierarchyClass::IntegralOnly,
            (
                MeasureStatus::Excluded
                | MeasureStatus::ExcludedAtRotation
                | MeasureStatus::ExcludedAtRest,
                false,
            ) => HierarchyClass::Neither,
            (
                MeasureStatus::ExcludedForConfiguration
                | MeasureStatus::Singular
                | MeasureStatus::WithTime
                | MeasureStatus::NotKnown,
                _,
            ) => HierarchyClass::NotKnown,
        };
        let grounds = vec![grounds_of(measure).to_string(), integrals.grounds(features)];
        let mut typical: Vec<String> = typical(class, integrals, features.dimension)
            .iter()
            .map(|line| line.to_string())
            .collect();
        if features.reversors > 0
            && matches!(
                class,
                HierarchyClass::IntegralOnly | HierarchyClass::Neither | HierarchyClass::NotKnown
            )
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

fn grounds_of(measure: MeasureStatus) -> &'static str {
    match measure {
        MeasureStatus::ClosedForm => "a measure: proved, in closed form",
        MeasureStatus::ByQuadrature => "a measure: proved to exist, by quadrature",
        MeasureStatus::Excluded => {
            "no measure: the criterion is not 0, so that no density is positive and C¹ near ω = 0; \
             densities with singularities there are not excluded"
        }
        MeasureStatus::ExcludedAtRotation => {
            "no measure: near a permanent rotation no density is continuous and positive; \
             densities with singularities there are not excluded"
        }
        MeasureStatus::ExcludedAtRest => {
            "no measure: near the equilibrium 0, where volumes change, no density is continuous and \
             positive; densities with singularities there are not excluded"
        }
        MeasureStatus::ExcludedForConfiguration => {
            "a measure: not known; no density of the configuration alone exists, one that depends on \
             the velocities is open"
        }
        MeasureStatus::Singular => {
            "a measure: one on each region between the zeros and poles of an invariant density, which no \
             motion crosses; none is known on the whole space of states"
        }
        MeasureStatus::WithTime => {
            "a measure: not known; the density that was found contains t, so that volumes in the space of \
             states may shrink with time, and attractors are possible"
        }
        MeasureStatus::NotKnown => "a measure: not known",
    }
}

impl Integrals {
    fn grounds(self, features: KnownFeatures) -> String {
        let wanted = match features.has_energy {
            true => "an integral besides the energy",
            false => "an integral",
        };
        let generic = if features.has_free { " for generic parameters" } else { "" };
        match self {
            Integrals::Enough => {
                "integrals: proved, enough for the Euler–Jacobi theorem".to_string()
            }
            Integrals::EnoughOnAPart => "integrals: proved, enough for the Euler–Jacobi theorem if they \
                                         are independent, which is shown on a part of the states only"
                .to_string(),
            Integrals::Some => {
                "integrals: proved, but too few for the Euler–Jacobi theorem".to_string()
            }
            Integrals::ExcludedToDegree(degree) => format!(
                "{wanted}: none known; none that is polynomial in the velocities of degree at most \
                 {degree} exists{generic}; others are not known"
            ),
            Integrals::NotKnown => format!("{wanted}: not known"),
        }
    }
}

fn typical(
    class: HierarchyClass,
    integrals: Integrals,
    dimension: Option<usize>,
) -> &'static [&'static str] {
    let Some(dimension) = dimension.filter(|dimension| *dimension >= 2) else { return &[] };
    match (class, integrals) {
        (HierarchyClass::IntegralAndMeasure, Integrals::Enough) => &[
            "integrable by quadratures (Euler, Jacobi): on compact regular joint levels without fixed \
             points the motion is on two-dimensional tori, quasi-periodic after a change of time",
            "no attractors, no chaos",
        ],
        (HierarchyClass::IntegralAndMeasure, Integrals::EnoughOnAPart) => &[
            "motion on the joint levels preserves a measure: no attractors on compact ones",
            "where the integrals are independent: integrable by quadratures (Euler, Jacobi), and no chaos",
        ],
        (HierarchyClass::IntegralAndMeasure, _) => &[
            "motion on the joint levels preserves a measure: no attractors on compact ones; where one \
             integral is missing to quadratures, chaos is possible and usually weak",
        ],
        (HierarchyClass::IntegralOnly, _) => &[
            "the phase space is foliated by the joint levels; on them there may be limit cycles, \
             towards which the motion settles, and rotation numbers may lock",
            "no chaos where the joint levels are two-dimensional",
        ],
        (HierarchyClass::MeasureOnly, _) if dimension != 3 => &[
            "the flow preserves a measure on the levels of the energy: no attractors on compact ones",
        ],
        (HierarchyClass::MeasureOnly, _) => &[
            "the Poincaré map preserves an area: no attractors, typically islands in a chaotic sea, as in a \
             Hamiltonian system",
        ],
        (HierarchyClass::Neither, _) => &[
            "attractors and repellers are possible, strange ones among them, as in a dissipative \
             system, though the energy is conserved",
        ],
        (HierarchyClass::NotKnown | HierarchyClass::ByValue, _) => &[],
    }
}
