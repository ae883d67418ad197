//! Colours of equal lightness around the hue circle, legible on white and on black.

/// Lightness and chroma of all colours, in the space Oklab (Ottosson 2020).
const LIGHTNESS: f64 = 0.62;
const CHROMA: f64 = 0.14;
/// Part of the hue circle in use: both ends of a scale have to differ.
const FROM: f64 = 0.07;
const SPAN: f64 = 0.80;

/// Background of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Paper {
    /// Dark ink on white.
    Light,
    /// Light ink on black.
    Dark,
}

impl Paper {
    /// Colours of paper, frame and ink.
    pub fn colours(self) -> [[u8; 3]; 3] {
        match self {
            Paper::Light => [[255; 3], [136; 3], [17; 3]],
            Paper::Dark => [[0x14, 0x17, 0x1c], [136; 3], [0xf0; 3]],
        }
    }
}

/// Colour at a position from 0 to 1: from red over green and blue to purple.
pub fn colour(shade: f64) -> [u8; 3] {
    let angle = 2.0 * std::f64::consts::PI * (FROM + SPAN * shade.clamp(0.0, 1.0));
    let (a, b) = (CHROMA * libm::cos(angle), CHROMA * libm::sin(angle));
    let cube = |x: f64| x * x * x;
    let l = cube(LIGHTNESS + 0.396_337_777_4 * a + 0.215_803_757_3 * b);
    let m = cube(LIGHTNESS - 0.105_561_345_8 * a - 0.063_854_172_8 * b);
    let s = cube(LIGHTNESS - 0.089_484_177_5 * a - 1.291_485_548_0 * b);
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

    #[test]
    fn colours_differ_from_both_backgrounds() {
        let luminance = |[r, g, b]: [u8; 3]| {
            let linear = |x: u8| libm::pow(f64::from(x) / 255.0, 2.2);
            0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b)
        };
        for step in 0..=20 {
            let y = luminance(colour(f64::from(step) / 20.0));
            assert!((1.05 / (y + 0.05)) > 2.5, "seen on white, {step}");
            assert!((y + 0.05) / 0.05 > 2.5, "seen on black, {step}");
        }
    }
}
