//! Words with slanted letters, indices and powers.

use crate::font;

/// Words on one line, as pieces of one style.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Text {
    /// Pieces from left to right.
    pub(crate) pieces: Vec<Piece>,
}

/// Letters of one style.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Piece {
    pub letters: String,
    /// Whether the letters are slanted.
    pub slanted: bool,
    /// Whether the letters are an index below the line.
    pub lowered: bool,
}

/// Size of an index, and its distance below the line, as parts of the size of the words.
pub(crate) const INDEX: f64 = 0.72;
pub(crate) const DROP: f64 = 0.22;

/// Raised digits.
const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];

/// Upright words as they stand.
pub fn plain(words: &str) -> Text {
    Text { pieces: vec![Piece { letters: words.to_string(), slanted: false, lowered: false }] }
}

/// Words of a formula: letters slanted, `a_g` and `γ3` with indices, a real minus, names of functions
/// upright.
pub fn math(formula: &str) -> Text {
    let mut text = Text::default();
    let letters: Vec<char> = formula.chars().collect();
    let mut place = 0;
    while let Some(letter) = letters.get(place).copied() {
        if letter.is_ascii_digit() {
            place += text.push_number(&letters[place..]);
            continue;
        }
        if !letter.is_alphabetic() {
            let shown = match letter {
                '-' => '−',
                '*' => '·',
                '\'' => '′',
                other => other,
            };
            // Upright it would touch the slanted letter before it.
            text.push(shown, letter == '\'', false);
            place += 1;
            continue;
        }
        let rest = letters[place..].iter();
        let name: Vec<char> = rest.copied().take_while(|c| c.is_alphabetic()).collect();
        place += name.len();
        // Several Latin letters are a word: sin, energy.
        let is_word = name.len() > 2 && name.iter().all(char::is_ascii);
        name.iter().for_each(|c| text.push(*c, !is_word, false));
        let has_bar = letters.get(place) == Some(&'_');
        place += usize::from(has_bar);
        let index = letters[place..].iter().copied();
        let index = index.take_while(|c| c.is_ascii_digit() || (has_bar && c.is_alphanumeric()));
        let index: Vec<char> = index.collect();
        place += index.len();
        // The digit of a function's name is none of an index, as in atan2(y, x).
        let is_call = is_word && letters.get(place) == Some(&'(');
        index.iter().for_each(|c| text.push(*c, c.is_alphabetic(), !is_call));
    }
    text
}

impl Text {
    /// Appends the number at the beginning of some letters, 2e-3 as 2·10⁻³, and returns its length.
    fn push_number(&mut self, letters: &[char]) -> usize {
        let digits = letters.iter().take_while(|c| c.is_ascii_digit() || **c == '.').count();
        let rest = &letters[digits..];
        let sign = usize::from(matches!(rest.get(1), Some('+' | '-' | '−')));
        let exponent = rest.iter().skip(1 + sign).take_while(|c| c.is_ascii_digit()).count();
        let is_power = matches!(rest.first(), Some('e' | 'E')) && exponent > 0;
        if !is_power {
            letters[..digits].iter().for_each(|c| self.push(*c, false, false));
            return digits;
        }
        if letters[..digits] != ['1'] {
            letters[..digits].iter().for_each(|c| self.push(*c, false, false));
            self.push('·', false, false);
        }
        "10".chars().for_each(|c| self.push(c, false, false));
        let end = 1 + sign + exponent;
        for c in rest[1..end].iter().filter(|c| **c != '+') {
            let raised = match c.to_digit(10) {
                Some(digit) => RAISED[digit as usize],
                None => '⁻',
            };
            self.push(raised, false, false);
        }
        digits + end
    }

    fn push(&mut self, letter: char, slanted: bool, lowered: bool) {
        match self.pieces.last_mut() {
            Some(last) if last.slanted == slanted && last.lowered == lowered => {
                last.letters.push(letter);
            }
            _ => self.pieces.push(Piece { letters: letter.to_string(), slanted, lowered }),
        }
    }

    /// Appends other words.
    pub fn then(mut self, other: Text) -> Self {
        for piece in other.pieces {
            piece.letters.chars().for_each(|c| self.push(c, piece.slanted, piece.lowered));
        }
        self
    }

    /// Whether there are no letters.
    pub fn is_empty(&self) -> bool {
        self.pieces.iter().all(|piece| piece.letters.is_empty())
    }

    /// Letters without their style.
    pub fn letters(&self) -> String {
        self.pieces.iter().map(|piece| piece.letters.as_str()).collect()
    }

    /// Width in type of a size.
    pub(crate) fn width(&self, size: f64) -> f64 {
        let one = |piece: &Piece| {
            let size = if piece.lowered { INDEX * size } else { size };
            font::face(piece.slanted).width(&piece.letters) * size
        };
        self.pieces.iter().map(one).sum()
    }

    /// Breaks the words into lines of at most this width.
    pub(crate) fn wrapped(&self, size: f64, most: f64) -> Vec<Text> {
        let mut words: Vec<Text> = vec![Text::default()];
        for piece in &self.pieces {
            for letter in piece.letters.chars() {
                if letter == ' ' {
                    words.push(Text::default());
                } else if let Some(word) = words.last_mut() {
                    word.push(letter, piece.slanted, piece.lowered);
                }
            }
        }
        let mut lines: Vec<Text> = Vec::new();
        for word in words {
            let joined = lines.last().map(|line| line.clone().then(plain(" ")).then(word.clone()));
            match (lines.last_mut(), joined) {
                (Some(line), Some(joined)) if joined.width(size) <= most => *line = joined,
                _ => lines.push(word),
            }
        }
        lines
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Pieces with `/` around slanted letters and `_` before indices.
    fn shown(text: &Text) -> String {
        let one = |piece: &Piece| {
            let letters = match piece.slanted {
                true => format!("/{}/", piece.letters),
                false => piece.letters.clone(),
            };
            if piece.lowered { format!("_{letters}") } else { letters }
        };
        text.pieces.iter().map(one).collect()
    }

    #[test]
    fn formulas_have_indices_and_a_real_minus() {
        assert_eq!(shown(&math("a_g")), "/a/_/g/");
        assert_eq!(shown(&math("γ3 - x12")), "/γ/_3 − /x/_12");
        assert_eq!(shown(&math("L/G")), "/L///G/");
        assert_eq!(shown(&math("1e4*y2 - 2.5e-12")), "10⁴·/y/_2 − 2.5·10⁻¹²");
        assert_eq!(shown(&math("2e + 1.5*exp(x)")), "2/e/ + 1.5·exp(/x/)");
        assert_eq!(shown(&math("atan2(y, x)")), "atan2(/y/, /x/)");
        assert_eq!(shown(&math("sin(x)*energy")), "sin(/x/)·energy");
        assert_eq!(shown(&math("x' + 2*m")), "/x′/ + 2·/m/");
    }

    #[test]
    fn long_words_are_broken_between_words() {
        let text = plain("one two three four five");
        let lines = text.wrapped(3.0, 20.0);
        assert!(lines.len() > 1 && lines.iter().all(|line| line.width(3.0) <= 20.0), "{lines:?}");
        let joined: Vec<String> = lines.iter().map(Text::letters).collect();
        assert_eq!(joined.join(" "), "one two three four five");
    }
}
