//! Outlines and widths of the letters, from two embedded fonts.
//!
//! The fonts were made for this reader: one table of characters, no composed glyphs, no hints.

use std::collections::BTreeMap;
use std::sync::LazyLock;

/// Font with its tables.
pub(crate) struct Face {
    /// Bytes of the file, for formats that embed it.
    pub bytes: &'static [u8],
    glyphs: BTreeMap<char, u16>,
    advances: Vec<u16>,
    outlines: &'static [u8],
    places: Vec<usize>,
}

/// Consumer of outlines; coordinates are in units of the type size, upwards from the base line.
pub(crate) trait Pen {
    fn go(&mut self, to: [f64; 2]);
    fn line(&mut self, to: [f64; 2]);
    fn curve(&mut self, control: [f64; 2], to: [f64; 2]);
    fn close(&mut self);
}

/// Units of a font in the size of its type.
const UNITS: f64 = 2048.0;
/// Heights above and below the base line that letters may reach, in units of the type size.
pub(crate) const ASCENT: f64 = 0.93;
pub(crate) const DESCENT: f64 = 0.24;

static UPRIGHT: LazyLock<Face> =
    LazyLock::new(|| Face::read(include_bytes!("../font/upright.ttf")));
static SLANTED: LazyLock<Face> =
    LazyLock::new(|| Face::read(include_bytes!("../font/oblique.ttf")));

/// Returns a font.
pub(crate) fn face(slanted: bool) -> &'static Face {
    if slanted { &SLANTED } else { &UPRIGHT }
}

/// Width of upright words in type of a size.
pub fn width(words: &str, size: f64) -> f64 {
    face(false).width(words) * size
}

fn short(bytes: &[u8], at: usize) -> u16 {
    bytes.get(at..at + 2).map_or(0, |two| u16::from_be_bytes([two[0], two[1]]))
}

fn signed(bytes: &[u8], at: usize) -> i16 {
    short(bytes, at) as i16
}

fn long(bytes: &[u8], at: usize) -> usize {
    usize::from(short(bytes, at)) << 16 | usize::from(short(bytes, at + 2))
}

fn table(bytes: &'static [u8], name: &[u8; 4]) -> &'static [u8] {
    let count = usize::from(short(bytes, 4));
    let entry = (0..count).map(|k| 12 + 16 * k).find(|at| bytes.get(*at..at + 4) == Some(name));
    let range = entry.map(|at| (long(bytes, at + 8), long(bytes, at + 12)));
    range.and_then(|(start, length)| bytes.get(start..start + length)).unwrap_or_default()
}

impl Face {
    fn read(bytes: &'static [u8]) -> Self {
        let (cmap, hhea) = (table(bytes, b"cmap"), table(bytes, b"hhea"));
        // The only subtable has the format 12: groups of first and last letter, and first glyph.
        let map = cmap.get(long(cmap, 8)..).unwrap_or_default();
        let mut glyphs = BTreeMap::new();
        for group in 0..long(map, 12) {
            let at = 16 + 12 * group;
            let (first, last) = (long(map, at), long(map, at + 4));
            for code in first..=last {
                let letter = u32::try_from(code).ok().and_then(char::from_u32);
                let glyph = (long(map, at + 8) + code - first) as u16;
                letter.and_then(|letter| glyphs.insert(letter, glyph));
            }
        }
        let metrics = table(bytes, b"hmtx");
        let advances = (0..usize::from(short(hhea, 34))).map(|k| short(metrics, 4 * k)).collect();
        let (head, loca) = (table(bytes, b"head"), table(bytes, b"loca"));
        let places = match short(head, 50) {
            0 => (0..loca.len() / 2).map(|k| 2 * usize::from(short(loca, 2 * k))).collect(),
            _ => (0..loca.len() / 4).map(|k| long(loca, 4 * k)).collect(),
        };
        Self { bytes, glyphs, advances, outlines: table(bytes, b"glyf"), places }
    }

    /// Glyph of a letter; 0, an empty box, where the font has none.
    pub fn glyph(&self, letter: char) -> u16 {
        self.glyphs.get(&letter).copied().unwrap_or(0)
    }

    /// Width of a glyph in units of the type size.
    pub fn advance(&self, glyph: u16) -> f64 {
        let advance = self.advances.get(usize::from(glyph)).or(self.advances.last());
        advance.map_or(0.0, |advance| f64::from(*advance) / UNITS)
    }

    /// Width of words in units of the type size.
    pub fn width(&self, words: &str) -> f64 {
        words.chars().map(|letter| self.advance(self.glyph(letter))).sum()
    }

    /// Draws the outline of a glyph.
    pub fn draw(&self, glyph: u16, pen: &mut impl Pen) {
        let place =
            self.places.get(usize::from(glyph)).zip(self.places.get(usize::from(glyph) + 1));
        let data = place.and_then(|(from, to)| self.outlines.get(*from..*to)).unwrap_or_default();
        let count = signed(data, 0);
        if data.len() < 12 || count <= 0 {
            return;
        }
        let count = count as usize;
        let ends: Vec<usize> = (0..count).map(|k| usize::from(short(data, 10 + 2 * k))).collect();
        let points = ends.last().map_or(0, |last| last + 1);
        let at = 10 + 2 * count;
        let (flags, at) = flags(data, at + 2 + usize::from(short(data, at)), points);
        let (across, at) = coordinates(data, at, &flags, 0x02, 0x10);
        let (up, _) = coordinates(data, at, &flags, 0x04, 0x20);
        let mut first = 0;
        for end in ends {
            let contour: Vec<([f64; 2], bool)> = (first..=end)
                .filter_map(|k| {
                    let (x, y) = across.get(k).zip(up.get(k))?;
                    Some(([f64::from(*x) / UNITS, f64::from(*y) / UNITS], flags.get(k)? & 1 == 1))
                })
                .collect();
            contour_with(&contour, pen);
            first = end + 1;
        }
    }
}

fn flags(data: &[u8], mut at: usize, points: usize) -> (Vec<u8>, usize) {
    let mut flags = Vec::with_capacity(points);
    while flags.len() < points && at < data.len() {
        let flag = data[at];
        at += 1;
        let again = if flag & 0x08 != 0 { data.get(at).copied().unwrap_or(0) } else { 0 };
        at += usize::from(flag & 0x08 != 0);
        flags.extend(std::iter::repeat_n(flag, usize::from(again) + 1));
    }
    (flags, at)
}

/// Coordinates of one axis: a byte, a number of two bytes, or the last one again.
fn coordinates(
    data: &[u8],
    mut at: usize,
    flags: &[u8],
    is_byte: u8,
    is_same: u8,
) -> (Vec<i32>, usize) {
    let mut value = 0;
    let mut found = Vec::with_capacity(flags.len());
    for flag in flags {
        match (flag & is_byte != 0, flag & is_same != 0) {
            (true, is_positive) => {
                let step = i32::from(data.get(at).copied().unwrap_or(0));
                value += if is_positive { step } else { -step };
                at += 1;
            }
            (false, true) => {}
            (false, false) => {
                value += i32::from(signed(data, at));
                at += 2;
            }
        }
        found.push(value);
    }
    (found, at)
}

/// Draws a closed contour of points on the curve and control points off it; between two control
/// points lies one on the curve.
fn contour_with(contour: &[([f64; 2], bool)], pen: &mut impl Pen) {
    let Some(start) = contour.iter().position(|(_, is_on)| *is_on) else { return };
    let middle = |a: [f64; 2], b: [f64; 2]| [(a[0] + b[0]) / 2.0, (a[1] + b[1]) / 2.0];
    let origin = contour[start].0;
    pen.go(origin);
    let mut control: Option<[f64; 2]> = None;
    let after = contour[start + 1..].iter().chain(&contour[..start]);
    for (point, is_on) in after.chain([&(origin, true)]) {
        match (control, is_on) {
            (None, true) => pen.line(*point),
            (None, false) => control = Some(*point),
            (Some(off), true) => {
                pen.curve(off, *point);
                control = None;
            }
            (Some(off), false) => {
                pen.curve(off, middle(off, *point));
                control = Some(*point);
            }
        }
    }
    pen.close();
}

#[cfg(test)]
mod tests {
    use super::*;

    struct GlyphExtent(usize, [f64; 2], [f64; 2]);

    impl GlyphExtent {
        fn take(&mut self, to: [f64; 2]) {
            self.0 += 1;
            self.1 = [self.1[0].min(to[0]), self.1[1].min(to[1])];
            self.2 = [self.2[0].max(to[0]), self.2[1].max(to[1])];
        }
    }

    impl Pen for GlyphExtent {
        fn go(&mut self, to: [f64; 2]) {
            self.take(to);
        }
        fn line(&mut self, to: [f64; 2]) {
            self.take(to);
        }
        fn curve(&mut self, _: [f64; 2], to: [f64; 2]) {
            self.take(to);
        }
        fn close(&mut self) {}
    }

    fn extent(slanted: bool, letter: char) -> GlyphExtent {
        let mut found = GlyphExtent(0, [9.0; 2], [-9.0; 2]);
        let face = face(slanted);
        face.draw(face.glyph(letter), &mut found);
        found
    }

    #[test]
    fn every_letter_of_formulas_has_an_outline_within_the_line() {
        for letter in "ωγλμκπσφψΩΓΔΣ−·×⊗∂∫√≤≠∞⁻⁰¹²³⁸₀₁₉öłЖ°′".chars()
        {
            let GlyphExtent(points, low, high) = extent(false, letter);
            assert!(points > 2 && face(false).glyph(letter) != 0, "{letter}");
            assert!(low[1] > -0.4 && high[1] < 1.2 && high[0] < 1.2, "{letter}: {low:?} {high:?}");
        }
        assert!("xyzlLGaωγ".chars().all(|letter| face(true).glyph(letter) != 0), "slanted letters");
    }

    #[test]
    fn letters_have_the_shape_of_the_font() {
        // H of DejaVu Sans Condensed: two stems from the base line to 1493 units.
        let GlyphExtent(points, low, high) = extent(false, 'H');
        assert_eq!((points, low[1]), (13, 0.0), "twelve corners, and back to the first");
        assert!((high[1] - 1493.0 / UNITS).abs() < 1e-12, "{high:?}");
        assert_eq!(face(false).glyph('漢'), 0, "no such letter");
        assert!((width("MM", 10.0) - 2.0 * width("M", 10.0)).abs() < 1e-12, "no kerning");
    }
}
