//! Track of the contact point on the plane under a body that rolls without slipping.
//!
//! The state knows the body's attitude up to turns about the vertical alone. Two horizontal vectors
//! α, β of the fixed frame are carried along by α' = α × ω, in steps of fourth order (Magnus), and the
//! contact point moves with (α, r') and (β, r'), as it does along the surface of the body. The normal γ
//! is carried along in the same way and compared with the state's: that is the error.

/// Values along a motion at equal intervals of time.
#[derive(Clone, Copy, Debug)]
pub struct RollingSamples {
    /// Angular velocity ω.
    pub turning: [f64; 3],
    /// Normal γ.
    pub normal: [f64; 3],
    /// Velocity r' of the contact point along the surface of the body.
    pub velocity: [f64; 3],
}

/// Track on the plane.
#[derive(Clone, Debug, PartialEq)]
pub struct Track {
    /// Positions X, Y at every fourth of the times, from the origin on.
    pub points: Vec<[f64; 2]>,
    /// Largest distance of the carried normal from the state's.
    pub error: f64,
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn sum(a: [f64; 3], b: [f64; 3], factor: f64) -> [f64; 3] {
    [a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]]
}

fn scaled(a: [f64; 3], factor: f64) -> [f64; 3] {
    a.map(|x| factor * x)
}

/// A vector that is at rest in the fixed frame, seen from a body that turns by w (Rodrigues).
fn seen(vector: [f64; 3], w: [f64; 3]) -> [f64; 3] {
    let angle = dot(w, w).sqrt();
    if angle == 0.0 {
        return vector;
    }
    let axis = scaled(w, -1.0 / angle);
    let (sin, cos) = (libm::sin(angle), libm::cos(angle));
    let along = scaled(axis, dot(axis, vector) * (1.0 - cos));
    sum(sum(scaled(vector, cos), cross(axis, vector), sin), along, 1.0)
}

/// A horizontal unit vector: across the normal and the axis of the body farthest from it.
fn horizontal(normal: [f64; 3]) -> [f64; 3] {
    let least = (0..3).min_by(|a, b| normal[*a].abs().total_cmp(&normal[*b].abs())).unwrap_or(0);
    let mut axis = [0.0; 3];
    axis[least] = 1.0;
    let across = cross(normal, axis);
    scaled(across, 1.0 / dot(across, across).sqrt())
}

/// Computes the track of a motion given at intervals `step` of time.
pub fn track(motion: &[RollingSamples], step: f64) -> Track {
    let Some(first) = motion.first() else { return Track { points: Vec::new(), error: 0.0 } };
    let alpha = horizontal(first.normal);
    let mut frame = [alpha, cross(first.normal, alpha), first.normal];
    let speed =
        |frame: &[[f64; 3]; 3], at: &RollingSamples| [0, 1].map(|k| dot(frame[k], at.velocity));
    let (mut points, mut at, mut error) = (vec![[0.0; 2]], [0.0; 2], 0.0f64);
    let mut speeds = vec![speed(&frame, first)];
    let double = 2.0 * step;
    for three in motion.windows(3).step_by(2) {
        let [from, middle, to] = [three[0], three[1], three[2]];
        let mean = sum(sum(from.turning, to.turning, 1.0), middle.turning, 4.0);
        let bend = scaled(cross(from.turning, to.turning), double * double / 12.0);
        let turn = sum(bend, mean, double / 6.0);
        frame = frame.map(|vector| seen(vector, turn));
        let off = sum(frame[2], to.normal, -1.0);
        error = error.max(dot(off, off).sqrt());
        speeds.push(speed(&frame, &to));
        if let [a, b, c] = speeds[..] {
            at = [0, 1].map(|k| at[k] + double / 3.0 * (a[k] + 4.0 * b[k] + c[k]));
            points.push(at);
            speeds.drain(..2);
        }
    }
    Track { points, error }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Ball of radius 1 that turns with ω, constant in the fixed frame and given there; the attitude
    /// begins as the unit matrix.
    fn ball(turning: [f64; 3], time: f64) -> RollingSamples {
        // In the body, what is at rest in the fixed frame turns backwards.
        let turned = |vector| seen(vector, scaled(turning, time));
        let normal = turned([0.0, 0.0, 1.0]);
        // r = −γ, and γ' = γ × ω.
        let velocity = scaled(cross(normal, turned(turning)), -1.0);
        RollingSamples { turning: turned(turning), normal, velocity }
    }

    #[test]
    fn a_ball_that_turns_evenly_runs_straight_and_as_far_as_it_turns() {
        let turning = [0.3, -0.8, 0.5];
        let step = 0.01;
        let motion: Vec<RollingSamples> =
            (0..=400).map(|k| ball(turning, step * f64::from(k))).collect();
        let found = track(&motion, step);
        assert_eq!(found.points.len(), 101);
        assert!(found.error < 1e-9, "{}", found.error);
        let way = 4.0 * libm::hypot(0.3, 0.8);
        let end = found.points[100];
        assert!((libm::hypot(end[0], end[1]) - way).abs() < 1e-9, "{end:?} is {way} away");
        let half = found.points[50];
        assert!((half[0] * end[1] - half[1] * end[0]).abs() < 1e-9, "on a straight line");
    }

    #[test]
    fn a_wrong_normal_shows_in_the_error() {
        let step = 0.01;
        let mut motion: Vec<RollingSamples> =
            (0..=40).map(|k| ball([0.3, -0.8, 0.5], step * f64::from(k))).collect();
        motion[20].normal = [1.0, 0.0, 0.0];
        assert!(track(&motion, step).error > 0.5, "the state's normal is far");
    }
}
