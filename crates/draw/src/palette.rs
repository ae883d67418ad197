//! Colours that the colour-blind tell apart, on light and on dark paper.

/// Background of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Paper {
    /// Dark ink on white.
    Light,
    /// Light ink on black.
    Dark,
}

/// Colour of an item, by its job or as a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Paint {
    /// Background.
    Paper,
    /// Words and marks.
    Ink,
    /// Frames, ticks and points that stand back.
    Soft,
    /// Lines of a grid.
    Grid,
    /// Red, green and blue on any paper.
    Same([u8; 3]),
    /// Red, green and blue on light paper, and on dark.
    Each([u8; 3], [u8; 3]),
}

impl Paint {
    /// Returns red, green and blue on a kind of paper.
    pub fn on(self, paper: Paper) -> [u8; 3] {
        let [light, dark] = match self {
            Paint::Paper => [[255; 3], [0x14, 0x17, 0x1c]],
            Paint::Ink => [[0x1a; 3], [0xe8; 3]],
            Paint::Soft => [[0x80; 3], [0x8c; 3]],
            Paint::Grid => [[0xe2; 3], [0x2b, 0x30, 0x38]],
            Paint::Same(colour) => [colour; 2],
            Paint::Each(light, dark) => [light, dark],
        };
        match paper {
            Paper::Light => light,
            Paper::Dark => dark,
        }
    }
}

/// Colours of a few things side by side: those of Okabe and Ito (2008), lighter on dark paper.
pub const CATEGORIES: [Paint; 8] = [
    Paint::Each([0x00, 0x72, 0xb2], [0x4d, 0xaf, 0xe8]),
    Paint::Each([0xd5, 0x5e, 0x00], [0xff, 0x95, 0x45]),
    Paint::Each([0x00, 0x9e, 0x73], [0x35, 0xcc, 0xa1]),
    Paint::Each([0xb0, 0x5a, 0x8a], [0xe0, 0x98, 0xc0]),
    Paint::Each([0xb8, 0x80, 0x00], [0xf0, 0xc7, 0x55]),
    Paint::Each([0x2b, 0x2b, 0x8f], [0x9a, 0x9a, 0xf0]),
    Paint::Each([0x66, 0x66, 0x66], [0xb5, 0xb5, 0xb5]),
    Paint::Each([0x8c, 0x2f, 0x2f], [0xf0, 0x8a, 0x8a]),
];

/// Chroma of the gradient, in the space Oklab (Ottosson 2020).
const CHROMA: f64 = 0.14;
/// Hues of both ends, as parts of a turn: from blue over purple and red to yellow.
const HUES: [f64; 2] = [0.73, 1.21];
/// Lightness of both ends, on light and on dark paper.
const ON_LIGHT: [f64; 2] = [0.38, 0.76];
const ON_DARK: [f64; 2] = [0.52, 0.88];

/// Colour at a position from 0 to 1: dark blue over red to yellow, ever lighter, so that it reads
/// without hues too.
pub fn gradient(share: f64) -> Paint {
    Paint::Each(colour(share, ON_LIGHT), colour(share, ON_DARK))
}

fn colour(share: f64, lightness: [f64; 2]) -> [u8; 3] {
    let share = if share.is_finite() { share.clamp(0.0, 1.0) } else { 0.0 };
    let between = |[from, to]: [f64; 2]| from + (to - from) * share;
    let angle = 2.0 * std::f64::consts::PI * between(HUES);
    let (a, b) = (CHROMA * libm::cos(angle), CHROMA * libm::sin(angle));
    let lightness = between(lightness);
    let cube = |x: f64| x * x * x;
    let l = cube(lightness + 0.396_337_777_4 * a + 0.215_803_757_3 * b);
    let m = cube(lightness - 0.105_561_345_8 * a - 0.063_854_172_8 * b);
    let s = cube(lightness - 0.089_484_177_5 * a - 1.291_485_548_0 * b);
    [
        4.076_741_662_1 * l - 3.307_711_591_3 * m + 0.230_969_929_2 * s,
        -1.268_438_004_6 * l + 2.609_757_401_1 * m - 0.341_319_396_5 * s,
        -0.004_196_086_3 * l - 0.703_418_614_7 * m + 1.707_614_701_0 * s,
    ]
    .map(|linear| (255.0 * gamma(linear.clamp(0.0, 1.0))).round() as u8)
}

/// The sRGB transfer function.
fn gamma(linear: f64) -> f64 {
    match linear <= 0.003_130_8 {
        true => 12.92 * linear,
        false => 1.055 * libm::pow(linear, 1.0 / 2.4) - 0.055,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn luminance([r, g, b]: [u8; 3]) -> f64 {
        let linear = |x: u8| libm::pow(f64::from(x) / 255.0, 2.2);
        0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b)
    }

    fn contrast(paint: Paint, paper: Paper) -> f64 {
        let (one, other) = (luminance(paint.on(paper)), luminance(Paint::Paper.on(paper)));
        (one.max(other) + 0.05) / (one.min(other) + 0.05)
    }

    #[test]
    fn colours_differ_from_the_paper() {
        for paper in [Paper::Light, Paper::Dark] {
            for step in 0..=20 {
                let found = contrast(gradient(f64::from(step) / 20.0), paper);
                assert!(found > 1.8, "step {step} on {paper:?}: {found}");
            }
            for paint in CATEGORIES {
                assert!(contrast(paint, paper) > 3.0, "{paint:?} on {paper:?}");
            }
            assert!(contrast(Paint::Ink, paper) > 12.0, "words are legible");
        }
    }

    #[test]
    fn the_gradient_reads_without_hues() {
        for paper in [Paper::Light, Paper::Dark] {
            let steps = (0..=20).map(|step| luminance(gradient(f64::from(step) / 20.0).on(paper)));
            let steps: Vec<f64> = steps.collect();
            assert!(steps.windows(2).all(|pair| pair[0] < pair[1]), "{paper:?}: {steps:?}");
        }
    }
}
