//! Equations of a Lagrangian system solved for independent accelerations: a field without constraints.

use liouville::case::Case;
use liouville::formula::Formula;
use liouville::mechanics::{Chart, Lagrangian, Model, SamplerSpec, System};

use super::super::super::SearchError;
use super::super::super::terms::recorded;
use super::back::with_words;
use super::equations::{ReadEquations, SolvedMotion};
use super::parts::refined;
use super::ring::{AdjoinedRing, Atom, Of};
use super::write::{function_names, unused, with_parameters, written};

/// Largest number of velocities.
const MOST_VELOCITIES: usize = 10;
/// Largest number of independent velocities.
const MOST_INDEPENDENT: usize = 5;
/// Beginning of the names of velocities.
const PREFIX: &str = "vel";

/// The motion of a Lagrangian system on its constraints as a field of the positions and independent
/// velocities.
pub struct ExplicitField {
    /// The field.
    pub case: Case,
    /// Whether the velocities are solved for at all positions: the field is the motion on the level.
    pub is_whole: bool,
    /// Names in the field that are others in the case.
    renamed: Vec<(String, String)>,
}

impl ExplicitField {
    /// Solves the equations of a system in coordinates; `None` of another system, and where this takes
    /// too many terms.
    pub fn of(case: &Case) -> Result<Option<Self>, SearchError> {
        let System::Lagrangian(own) = &case.model.system else { return Ok(None) };
        if !is_plain(case, own) {
            return Ok(None);
        }
        let model = &case.model;
        let (graph, (equations, constraints, level)) = recorded(case, |jet| {
            let level = model.level.iter().map(|own| jet.phase.level_function(&own.function));
            let constraints = own.constraints.iter().map(|own| jet.phase.scalar(own));
            let (constraints, level) = (constraints.collect(), level.collect());
            (own.equations(&jet.phase), constraints, level)
        })?;
        let (parameters, dimension) = (model.free_components(), model.dimension());
        if graph.inputs() > parameters + dimension {
            return Ok(None);
        }
        let velocities: Vec<usize> = equations.velocities.iter().map(|w| parameters + w).collect();
        let made = refined((parameters, dimension), Vec::new(), |ring| {
            let read = ReadEquations::of(&graph, &equations, [&constraints, &level], ring)?;
            read.solved(&velocities, ring)
        });
        match made {
            Some((ring, motion)) => Self::written(case, &ring, motion),
            None => Ok(None),
        }
    }

    /// Writes a text of the field in the names of the case.
    pub fn back(&self, text: &str) -> String {
        with_words(text, &|word| {
            let own = self.renamed.iter().find(|(name, _)| name == word);
            own.map(|(_, original)| original.clone())
        })
    }

    fn written(
        case: &Case,
        ring: &AdjoinedRing,
        motion: SolvedMotion,
    ) -> Result<Option<Self>, SearchError> {
        let model = &case.model;
        let parameters = model.free_components();
        let is_function = |atom: &Atom| matches!(atom, Atom::Constant(Of::Function(..)));
        if ring.atoms.iter().any(is_function) {
            return Ok(None);
        }
        let mut given = model.parameter_names();
        let (prefix, mut renamed) = (unused(PREFIX, case), Vec::new());
        for (component, name) in model.state_names().into_iter().enumerate() {
            let is_plain = name.chars().all(char::is_alphanumeric);
            let new = if is_plain { name.clone() } else { format!("{prefix}{component}") };
            if new != name {
                renamed.push((new.clone(), name));
            }
            given.push(new);
        }
        let names = function_names(ring, &given);
        let mut field = with_parameters(Model::field().title("explicit field"), model);
        for (place, rate) in &motion.rates {
            let Some(draw) = case.free_draws.get(*place) else { return Ok(None) };
            let (name, range) = (&names[parameters + place], SamplerSpec::Scalar(draw.clone()));
            field = field.state(name, range, written(rate, &names));
        }
        for equation in &motion.level {
            field = field.level(written(equation, &names), Formula::number(0));
        }
        let case = field.build().map_err(SearchError::Unbuilt)?;
        Ok(Some(Self { case, is_whole: motion.is_whole, renamed }))
    }
}

/// Whether a system is one that can be solved so, and is not too large.
fn is_plain(case: &Case, own: &Lagrangian) -> bool {
    let velocities = own.velocities(&case.model.state).len();
    !own.vakonomic
        && case.model.extension.is_empty()
        && matches!(case.chart, Chart::Free | Chart::Equations)
        && velocities <= MOST_VELOCITIES
        && velocities.saturating_sub(own.constraints.len()) <= MOST_INDEPENDENT
}

#[cfg(test)]
mod tests {
    use liouville::mechanics::Phase;
    use liouville::mechanics::elimination::solve_by_minors;

    use super::*;

    /// Compares the field at some states with that of the case on its constraints.
    fn agrees(text: &str) -> ExplicitField {
        let case = Case::parse(text, &[]).expect("a case");
        let field = ExplicitField::of(&case).expect("recorded").expect("it is solved");
        let System::Lagrangian(own) = &case.model.system else { panic!("a Lagrangian") };
        let dimension = case.model.dimension();
        let component = |name: &str| {
            (0..dimension).find(|k| case.model.component_name(*k) == name).expect("a component")
        };
        let free: Vec<usize> = (0..field.case.model.dimension())
            .map(|k| component(&field.back(&field.case.model.component_name(k))))
            .collect();
        let given: Vec<usize> = (0..dimension).filter(|k| !free.contains(k)).collect();
        assert_eq!(given.len(), own.constraints.len(), "velocities given by constraints");
        let parameters: Vec<f64> =
            (0..case.model.free_components()).map(|k| 0.7 + 0.31 * k as f64).collect();
        for number in 0..3 {
            let mut state: Vec<f64> = (0..dimension)
                .map(|k| 0.4 + 0.37 * (k as f64 + 1.0).sin() + 0.11 * f64::from(number))
                .collect();
            let values = |state: &[f64]| -> Vec<f64> {
                let phase = Phase::new(&case.model, &parameters, state);
                own.constraints.iter().map(|f| phase.scalar(f)).collect()
            };
            given.iter().for_each(|k| state[*k] = 0.0);
            let rest = values(&state);
            let columns: Vec<Vec<f64>> = given
                .iter()
                .map(|k| {
                    let mut moved = state.clone();
                    moved[*k] = 1.0;
                    values(&moved).iter().zip(&rest).map(|(a, b)| a - b).collect()
                })
                .collect();
            let rows: Vec<Vec<f64>> =
                (0..rest.len()).map(|i| columns.iter().map(|own| own[i]).collect()).collect();
            let side: Vec<f64> = rest.iter().map(|own| -own).collect();
            let solved = match rows.is_empty() {
                true => Vec::new(),
                false => solve_by_minors(&rows, &[side]).remove(0),
            };
            given.iter().zip(solved).for_each(|(k, value)| state[*k] = value);
            let wanted = Phase::new(&case.model, &parameters, &state).field().to_vec();
            let inner: Vec<f64> = free.iter().map(|k| state[*k]).collect();
            let made = Phase::new(&field.case.model, &parameters, &inner).field().to_vec();
            for (k, rate) in free.iter().zip(made) {
                let error = (wanted[*k] - rate).abs() / (1.0 + rate.abs());
                assert!(error < 1e-11, "{}: {} {rate}", case.model.component_name(*k), wanted[*k]);
            }
        }
        field
    }

    #[test]
    fn solved_equations_are_those_of_the_case() {
        let scalars = |names: &[&str]| -> String {
            names.iter().map(|name| format!("\"{name}\" = '-1..1'\n")).collect()
        };
        let head =
            "title = 'x'\nsystem = 'nonholonomic'\n[parameters]\nm = '1..2'\nJ = '1..2'\n[state]\n";
        // A constraint with a pivot that is no number, with a force.
        let knife = format!(
            "{head}{}[lagrangian]\nkinetic = \"m*(x'² + y'²)/2 + J*f'²/2 + m*x'*f'*sin(f)/3\"\n\
             potential = 'x*y'\nforces = {{ f = \"−f'*x\" }}\n\
             constraints = [\"x'*sin(f) − y'*cos(f) = 0\"]\n",
            scalars(&["x", "y", "f", "x'", "y'", "f'"])
        );
        assert!(!agrees(&knife).is_whole, "sin f and cos f have zeros");
        // Constraints that are affine, and two of them.
        let affine = format!(
            "{head}{}[lagrangian]\nkinetic = \"m*(x'² + y'² + z'²)/2 + J*u'²*(1 + x²)/2\"\n\
             constraints = [\"z' = y*x' + u\", \"y' − 2*x' + x*u' = 0\"]\n",
            scalars(&["x", "y", "z", "u", "x'", "y'", "z'", "u'"])
        );
        assert!(agrees(&affine).is_whole);
        // Without constraints, with one denominator.
        let pendulum = format!(
            "{head}{}[lagrangian]\nkinetic = \"(m + J)*a'²/2 + J*b'²/2 + J*a'*b'*cos(a − b)\"\n\
             potential = '−cos(a) − cos(b)'\n",
            scalars(&["a", "b", "a'", "b'"])
        );
        assert!(agrees(&pendulum).is_whole);
        // Quasi-velocities with a carried vector.
        let top = format!(
            "{head}w = 'vector(3, -1..1)'\ng = 'vector(3, -1..1)'\n[lagrangian]\n\
             kinetic = '(w1² + m*w2² + J*w3²)/2 + w1*w2*g3/9'\npotential = 'g1*g2 + m*g3'\n\
             quasi-velocities = ['w']\nalgebra = 'so(3)'\nconstraints = ['w1 + w2*g3 = 0']\n\
             [field]\n\"g'\" = 'g × w'\n"
        );
        assert!(agrees(&top).is_whole);
    }
}
