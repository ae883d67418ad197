//! Entries of a parameter that are one number, and change together.

use liouville::case::Case;
use liouville::mechanics::StiffEntry;

fn tied(value: &str, component: usize) -> Result<Vec<(usize, bool)>, StiffEntry> {
    let text = format!(
        "title = 't'\n[parameters]\nJ = {value}\n[state]\nx = 'vector(-1..1)'\n[field]\n\
         \"x'\" = 'J*x'\n"
    );
    let case = Case::parse(&text, &[]).unwrap_or_else(|error| panic!("{error}"));
    let tied = case.model.tied(0, component)?;
    Ok(tied.iter().map(|one| (one.component, one.is_negative)).collect())
}

#[test]
fn entries_that_are_one_quantity_are_tied() {
    for symmetric in ["'symmetric(3, 1..2)'", "[[2, 1, 0], [1, 3, 0], [0, 0, 4]]", "'full(1..2)'"] {
        assert_eq!(tied(symmetric, 1), Ok(vec![(3, false)]), "{symmetric}: J12 and J21");
        assert_eq!(tied(symmetric, 3), Ok(vec![(1, false)]), "{symmetric}: J21 and J12");
        assert_eq!(tied(symmetric, 4), Ok(vec![]), "{symmetric}: J22");
    }
    for skew in ["'skew(3, 1..2)'", "[[0, 1, 0], [-1, 0, 5], [0, -5, 0]]"] {
        assert_eq!(tied(skew, 5), Ok(vec![(7, true)]), "{skew}: J23 = −J32");
        assert_eq!(tied(skew, 4), Err(StiffEntry::Zero), "{skew}: J22");
    }
    let spherical = "'spherical(1..2)'";
    assert_eq!(tied(spherical, 4), Ok(vec![(0, false), (8, false)]), "one number");
    assert_eq!(tied(spherical, 1), Err(StiffEntry::Zero));
    let axisymmetric = "'axisymmetric(1..2)'";
    assert_eq!(tied(axisymmetric, 0), Ok(vec![(4, false)]), "J1 and J2");
    assert_eq!(tied(axisymmetric, 4), Ok(vec![(0, false)]), "J2 and J1");
    assert_eq!(tied(axisymmetric, 8), Ok(vec![]), "J3");
    assert_eq!(tied("'rotation'", 8), Err(StiffEntry::Rotation));
    for any in ["'matrix(3, 3, 1..2)'", "[[2, 1, 0], [2, 3, 0], [0, 0, 4]]"] {
        assert_eq!(tied(any, 1), Ok(vec![]), "{any}: nine numbers");
    }
}
