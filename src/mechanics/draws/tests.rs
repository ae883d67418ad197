use super::*;
use crate::mechanics::recipe::{NumberLine, Range};
use crate::number::ball::about;

#[test]
fn the_stream_is_frozen() {
    let draws = vec![Draw::Within(Range::between((1, 2), (2, 1))); 3];
    let shown: Vec<String> =
        DrawSource::new(&draws).state(7, 3).iter().map(|x| x.to_string()).collect();
    assert_eq!(shown, FROZEN, "a change here changes every witness ever printed");
}

const FROZEN: [&str; 3] = ["0.772", "0.64", "1.967"];

#[test]
fn the_nearest_f64_is_that_of_the_number() {
    let ends = [(-3, 7, 5, 3), (0, 1, 1, 1), (-1, 1, 1, 1), (1, 1024, 3, 1024), (1, 3, 1 << 40, 9)];
    // Without an f64 inside, with few, and from one to the next.
    let narrow = 300_000_000_000_000_000;
    let few =
        [(1, 3, narrow / 3 + 3, narrow), (1, 3, narrow / 3 + 60, narrow), (1, 1 << 52, 2, 1 << 52)];
    let ranges = [&ends[..], &few]
        .concat()
        .into_iter()
        .map(|(a, b, c, d)| Draw::Within(Range::between((a, b), (c, d))));
    let ranges: Vec<Draw> = ranges.collect();
    let list = Draw::OneOf(vec![Rational::new(1, 3), Rational::new(5, 8)]);
    let directions = Draw::Of(NumberLine::Directions, Range::between((-8, 5), (8, 5)));
    let draws = DrawSource::new(&[&ranges[..], &[list, directions]].concat());
    for index in 0..2000 {
        let exact = draws.state(5, index).iter().map(Rational::to_f64).collect::<Vec<_>>();
        assert_eq!(draws.nearest(5, index, 0), exact, "state {index}");
    }
    for start in [0, 40, 64, 1 << 33] {
        let mut columns = vec![Balls::<64>::about(|_| (f64::NAN, true)); draws.len()];
        draws.fill(&Streams::new(5), start, &mut columns);
        for lane in 0..64 {
            let expected = draws.nearest(5, start + lane as u64, 0);
            for (column, expected) in columns.iter().zip(expected) {
                let found = (column.mid[lane], column.rad[lane]);
                assert_eq!(found, about(expected), "state {start} + {lane}");
            }
        }
    }
}

#[test]
fn draws_stay_inside_and_off_zero() {
    let range = Range::between((-1, 1), (1, 1));
    let draws = vec![Draw::Within(range.clone()); 2000];
    for value in DrawSource::new(&draws).state(1, 0) {
        assert!(value > range.low && value < range.high && !value.is_zero(), "{value}");
    }
    let narrow = Draw::Within(Range::between((1, 1_000_000), (2, 1_000_000)));
    let value = DrawSource::new(&[narrow]).state(1, 0)[0].clone();
    assert!(value > Rational::new(1, 1_000_000) && value < Rational::new(2, 1_000_000));
}

#[test]
fn later_states_have_all_digits() {
    let range = Range::between((-2, 1), (2, 1));
    let draws = DrawSource::new(&[Draw::Within(range.clone()), Draw::Sign]);
    let lengths = |indices: std::ops::Range<u64>| {
        indices.map(|index| draws.state(1, index)[0].bits()).max().unwrap_or(0)
    };
    assert!(lengths(0..64) < 30, "the first are short");
    assert!(lengths(64..128) > 50, "the others are not");
    let sign = |index| draws.state(1, index)[1].clone();
    assert!((0..64).any(|k| sign(k) == Rational::from(1)), "some signs are positive");
    assert!((0..64).any(|k| sign(k) == Rational::from(-1)), "some are not");
    assert_ne!(draws.attempt(1, 3, 1), draws.state(1, 3), "another attempt");
    assert_eq!(draws.attempt(1, 3, 0), draws.state(1, 3), "the first attempt");
}

#[test]
fn edges_are_near_the_ends_and_near_zero() {
    let draws = DrawSource::new(&[Draw::Within(Range::between((-1, 1), (1000, 1)))]);
    let found: Vec<f64> = (0..64).map(|k| draws.edge(1, k)[0].to_f64().0).collect();
    assert!(found.iter().all(|x| *x > -1.0 && *x < 1000.0), "inside: {found:?}");
    assert!(found.iter().any(|x| *x < -0.01), "near the lower end");
    assert!(found.iter().any(|x| *x > 999.0), "near the upper end");
    assert!(found.iter().any(|x| (2.0..998.0).contains(x)), "anywhere");
    let nearest: Vec<f64> = (0..64).map(|k| draws.nearest_edge(1, k)[0].0).collect();
    assert_eq!(nearest, found, "the same numbers");
}

#[test]
fn states_differ_and_do_not_depend_on_each_other() {
    let draws = vec![Draw::Within(Range::between((0, 1), (1, 1))); 4];
    let (four, two) = (DrawSource::new(&draws), DrawSource::new(&draws[..2]));
    assert_ne!(four.state(1, 0), four.state(1, 1), "each state has numbers of its own");
    assert_eq!(four.state(1, 5)[..2], two.state(1, 5)[..], "further draws change nothing");
}

#[test]
fn directions_reach_every_part_of_a_circle() {
    let draws =
        DrawSource::new(&[Draw::Of(NumberLine::Directions, Range::between((-8, 5), (8, 5)))]);
    let inside = |index: u64, attempt| draws.nearest(1, index, attempt)[0].0.abs() < 1.6;
    assert!((0..32).all(|index| inside(index, 0)), "the first states are easy to read");
    assert!((0..32).any(|index| !inside(index, 1)), "but for further attempts");
    let mut sectors = [0; 24];
    for index in 32..1032 {
        let angle = 2.0 * draws.nearest(1, index, 0)[0].0.atan();
        sectors[((angle / std::f64::consts::PI + 1.0) * 12.0) as usize] += 1;
    }
    assert!(sectors.iter().all(|count| *count > 10), "states by sector: {sectors:?}");
    let far = |index| draws.nearest_edge(1, index)[0].0;
    assert!((0..64).any(|index| far(index) > 1e3), "near the upper end of the line");
    assert!((0..64).any(|index| far(index) < -1e3), "near the lower end");
}

#[test]
fn signs_tell_what_is_inside() {
    let tiny = f64::from_bits(1);
    let ends = [[0.5, 2.0], [-1.0, 1.0], [-3.0, -1.0], [0.0, 1e-300], [-tiny, tiny], [0.0, 1e308]];
    for [low, high] in ends {
        let near = |x: f64| [x.next_down(), x, x.next_up()];
        let inner = [0.0, -0.0, tiny, -tiny, (low + high) / 2.0, low + (high - low) / 3.0, 1.0];
        let numbers = near(low).into_iter().chain(near(high)).chain(inner);
        for x in numbers.chain([f64::MAX, -f64::MAX, 1e-200, -1e-200]) {
            let is_inside = low < x && x < high && x != 0.0;
            let inner = [low.next_up(), high.next_down()];
            let word = source::sign_outside(x, inner) | source::sign_at_zero(x);
            assert_eq!(word >> 63 == 0, is_inside, "{x} between {low} and {high}");
        }
    }
}
