//! Identifiers and their canonical spelling.
//!
//! `gamma3`, `γ₃` and `γ3` are one name, as are `omega'` and `ω′`. All code that stores or compares
//! names uses the form returned by [`canonical_name`].

/// Greek letters by their English names, and the two decorated letters of the papers.
const SPELLED: [(&str, &str); 35] = [
    ("alpha", "α"),
    ("beta", "β"),
    ("gamma", "γ"),
    ("delta", "δ"),
    ("epsilon", "ε"),
    ("zeta", "ζ"),
    ("eta", "η"),
    ("theta", "θ"),
    ("iota", "ι"),
    ("kappa", "κ"),
    ("lambda", "λ"),
    ("mu", "μ"),
    ("nu", "ν"),
    ("xi", "ξ"),
    ("pi", "π"),
    ("rho", "ρ"),
    ("sigma", "σ"),
    ("tau", "τ"),
    ("phi", "φ"),
    ("chi", "χ"),
    ("psi", "ψ"),
    ("omega", "ω"),
    ("Gamma", "Γ"),
    ("Delta", "Δ"),
    ("Theta", "Θ"),
    ("Lambda", "Λ"),
    ("Xi", "Ξ"),
    ("Pi", "Π"),
    ("Sigma", "Σ"),
    ("Phi", "Φ"),
    ("Psi", "Ψ"),
    ("Omega", "Ω"),
    ("Itilde", "Ĩ"),
    ("Jtilde", "J\u{303}"),
    ("Jscript", "𝒥"),
];

/// Combining marks, each with the letters it joins and the results.
const COMPOSED: [(char, &str, &str); 11] = [
    ('\u{300}', "AEINOUWYaeinouwy", "ÀÈÌǸÒÙẀỲàèìǹòùẁỳ"),
    ('\u{301}', "ACEGIKLMNOPRSUWYZacegiklmnoprsuwyz", "ÁĆÉǴÍḰĹḾŃÓṔŔŚÚẂÝŹáćéǵíḱĺḿńóṕŕśúẃýź"),
    ('\u{302}', "ACEGHIJOSUWYZaceghijosuwyz", "ÂĈÊĜĤÎĴÔŜÛŴŶẐâĉêĝĥîĵôŝûŵŷẑ"),
    ('\u{303}', "AEINOUVYaeinouvy", "ÃẼĨÑÕŨṼỸãẽĩñõũṽỹ"),
    ('\u{304}', "AEGIOUYaegiouy", "ĀĒḠĪŌŪȲāēḡīōūȳ"),
    ('\u{306}', "AEGIOUaegiou", "ĂĔĞĬŎŬăĕğĭŏŭ"),
    (
        '\u{307}',
        "ABCDEFGHIMNOPRSTWXYZabcdefghmnoprstwxyz",
        "ȦḂĊḊĖḞĠḢİṀṄȮṖṘṠṪẆẊẎŻȧḃċḋėḟġḣṁṅȯṗṙṡṫẇẋẏż",
    ),
    ('\u{308}', "AEHIOUWXYaehiotuwxy", "ÄËḦÏÖÜẄẌŸäëḧïöẗüẅẍÿ"),
    ('\u{30a}', "AUauwy", "ÅŮåůẘẙ"),
    ('\u{30c}', "ACDEGHIKLNORSTUZacdeghijklnorstuz", "ǍČĎĚǦȞǏǨĽŇǑŘŠŤǓŽǎčďěǧȟǐǰǩľňǒřšťǔž"),
    ('\u{327}', "CDEGHKLNRSTcdeghklnrst", "ÇḐȨĢḨĶĻŅŖŞŢçḑȩģḩķļņŗşţ"),
];

/// Letters of other alphabets that look like the first of their row.
const ALIKE: [(char, &str); 44] = [
    ('a', "аɑ"),
    ('c', "сϲ"),
    ('d', "ԁ"),
    ('e', "еє"),
    ('h', "һ"),
    ('i', "іı"),
    ('j', "јϳ"),
    ('k', "к"),
    ('l', "ӏ"),
    ('n', "ո"),
    ('o', "оο"),
    ('p', "р"),
    ('q', "ԛ"),
    ('s', "ѕ"),
    ('u', "ս"),
    ('v', "ѵ"),
    ('w', "ԝ"),
    ('x', "х"),
    ('y', "уү"),
    ('A', "АΑ"),
    ('B', "ВΒ"),
    ('C', "СϹ"),
    ('E', "ЕΕ"),
    ('H', "НΗ"),
    ('I', "ІΙӀ"),
    ('J', "Ј"),
    ('K', "КΚ"),
    ('M', "МΜ"),
    ('N', "Ν"),
    ('O', "ОΟ"),
    ('P', "РΡ"),
    ('S', "Ѕ"),
    ('T', "ТΤ"),
    ('X', "ХΧ"),
    ('Y', "ҮΥ"),
    ('Z', "Ζ"),
    ('ω', "ѡꞷ"),
    ('φ', "ф"),
    ('ε', "ԑ"),
    ('Γ', "Г"),
    ('Λ', "Л"),
    ('Π', "П"),
    ('Φ', "Ф"),
    ('ψ', "ѱ"),
];

/// English names of the Greek letters.
pub(super) fn spelled_names() -> impl Iterator<Item = &'static str> {
    SPELLED.iter().map(|(name, _)| *name)
}

/// Canonical form of an identifier; `None` if the text is not one.
///
/// Spelled-out Greek becomes letters; look-alike letters, primes and subscript digits become one; a
/// letter and its tilde become one character: `gamma3` → `γ3`, `mu_1` → `μ_1`, `Itilde` → `Ĩ`.
pub fn canonical_name(text: &str) -> Option<String> {
    if identifier_length(text) != text.len() || text.is_empty() {
        return None;
    }
    let mut plain = String::with_capacity(text.len());
    for c in text.chars() {
        match (c, plain.chars().next_back().and_then(|last| compose(last, c))) {
            (_, Some(composed)) => {
                plain.pop();
                plain.push(composed);
            }
            ('′' | '’', _) => plain.push('\''),
            ('″', _) => plain.push_str("''"),
            ('\u{b5}', _) => plain.push('μ'),
            ('ϵ', _) => plain.push('ε'),
            ('ϕ', _) => plain.push('φ'),
            ('\u{2126}', _) => plain.push('Ω'),
            _ => plain.push(subscript(c).unwrap_or(c)),
        }
    }
    let base = plain.find(|c: char| !c.is_alphabetic()).unwrap_or(plain.len());
    match SPELLED.iter().find(|(spelled, _)| *spelled == &plain[..base]) {
        Some((_, letter)) => Some(format!("{letter}{}", &plain[base..])),
        None => Some(plain),
    }
}

/// English names of the combining marks of [`COMPOSED`].
const MARKS: [(char, &str); 11] = [
    ('\u{300}', "grave"),
    ('\u{301}', "acute"),
    ('\u{302}', "hat"),
    ('\u{303}', "tilde"),
    ('\u{304}', "bar"),
    ('\u{306}', "breve"),
    ('\u{307}', "dot"),
    ('\u{308}', "ddot"),
    ('\u{30a}', "ring"),
    ('\u{30c}', "check"),
    ('\u{327}', "cedilla"),
];

/// Spelling of a canonical name in ASCII letters, digits and underscores: `γ3` → `gamma3`,
/// `Ĩ12` → `Itilde12`, `r'` → `r_prime`. Different names may have one spelling.
pub fn ascii_name(name: &str) -> String {
    let mut out = String::with_capacity(name.len());
    for c in name.chars() {
        let spelled = SPELLED.iter().find(|(_, letter)| letter.chars().eq([c]));
        let composed = COMPOSED.iter().find_map(|(mark, letters, results)| {
            let place = results.chars().position(|result| result == c)?;
            Some((letters.chars().nth(place)?, *mark))
        });
        let mark = |mark: char| MARKS.iter().find(|(own, _)| *own == mark).map(|(_, name)| *name);
        match (c, spelled, composed) {
            (c, ..) if c.is_ascii_alphanumeric() || c == '_' => out.push(c),
            ('\'', ..) => out.push_str("_prime"),
            ('∂', ..) => out.push('d'),
            (_, _, Some((letter, over))) => {
                out.push(letter);
                out.push_str(mark(over).unwrap_or_default());
            }
            (_, Some((spelled, _)), _) => out.push_str(spelled),
            _ => match mark(c) {
                Some(mark) => out.push_str(mark),
                None => out.push_str(&format!("u{:x}", c as u32)),
            },
        }
    }
    out
}

/// Canonical names that occur in a text.
pub(crate) fn names_in(text: &str) -> Vec<String> {
    let mut names = Vec::new();
    let mut rest = text;
    while let Some(letter) = rest.chars().next() {
        let length = identifier_length(rest);
        names.extend(canonical_name(&rest[..length]));
        rest = &rest[length.max(letter.len_utf8())..];
    }
    names
}

/// Name with look-alike letters of other alphabets replaced, equal for names that look alike.
pub(crate) fn skeleton(name: &str) -> String {
    let is_usual = |c: char| c.is_ascii() || ('α'..='ω').contains(&c);
    let plain = |c: char| match is_usual(c) {
        true => c,
        false => alike(c),
    };
    name.chars().map(plain).collect()
}

/// Advice where a name is not known and looks like one that is: the letters in which they differ.
pub(crate) fn look_alike<'n>(
    name: &str,
    mut known: impl Iterator<Item = &'n str>,
) -> Option<String> {
    let name = canonical_name(name)?;
    let other = known.find(|own| *own != name && skeleton(own) == skeleton(&name))?;
    let (here, there) = name.chars().zip(other.chars()).find(|(a, b)| a != b)?;
    Some(format!(
        "`{name}` here has the letter U+{:04X}, and `{other}` the letter U+{:04X}, which looks the \
         same: write both with one of them",
        u32::from(here),
        u32::from(there)
    ))
}

fn alike(c: char) -> char {
    ALIKE.iter().find(|(_, all)| all.contains(c)).map_or(c, |(own, _)| *own)
}

/// Length in bytes of the identifier at the start of the text; 0 if none starts here.
pub(super) fn identifier_length(text: &str) -> usize {
    let mut primed = false;
    let ends = |(at, c): &(usize, char)| {
        let belongs = match c {
            _ if *at == 0 => is_letter(*c),
            '\'' | '′' | '’' | '″' => {
                primed = true;
                true
            }
            _ if c.is_ascii_digit() || subscript(*c).is_some() => true,
            // only digits follow a prime: γ'3 is a component of γ'
            _ => !primed && (*c == '_' || is_letter(*c) || is_combining_mark(*c)),
        };
        !belongs
    };
    text.char_indices().find(ends).map_or(text.len(), |(at, _)| at)
}

fn is_letter(c: char) -> bool {
    // the transpose sign is a letter in Unicode, but an operator here; for ∂ it is the reverse
    (c.is_alphabetic() || c == '∂') && c != 'ᵀ'
}

fn is_combining_mark(c: char) -> bool {
    ('\u{300}'..='\u{36f}').contains(&c)
}

fn subscript(c: char) -> Option<char> {
    let digit = (c as u32).checked_sub('₀' as u32).filter(|digit| *digit < 10)?;
    char::from_digit(digit, 10)
}

fn compose(letter: char, mark: char) -> Option<char> {
    let (_, letters, results) = COMPOSED.iter().find(|(with, _, _)| *with == mark)?;
    results.chars().nth(letters.chars().position(|c| c == letter)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spellings_of_one_name_agree() {
        let pairs = [
            ("gamma3", "γ3"),
            ("γ₃", "γ3"),
            ("mu_1", "μ_1"),
            ("omega'", "ω'"),
            ("ω′", "ω'"),
            ("r’’", "r''"),
            ("r″", "r''"),
            ("\u{b5}", "μ"),
            ("ϵ", "ε"),
            ("ϕ2", "φ2"),
            ("Itilde", "Ĩ"),
            ("I\u{303}12", "Ĩ12"),
            ("Jscript", "𝒥"),
            ("Omega", "Ω"),
            ("x\u{307}", "ẋ"),
            ("rdot", "rdot"),
            ("gammas", "gammas"),
            ("f2'", "f2'"),
            ("γ'3", "γ'3"),
        ];
        for (text, canonical) in pairs {
            assert_eq!(canonical_name(text).as_deref(), Some(canonical), "`{text}`");
            assert_eq!(canonical_name(canonical).as_deref(), Some(canonical), "idempotent");
        }
    }

    #[test]
    fn names_are_spelled_in_ascii() {
        for (name, spelled) in [
            ("γ3", "gamma3"),
            ("Ω", "Omega"),
            ("Ĩ12", "Itilde12"),
            ("J\u{303}", "Jtilde"),
            ("𝒥", "Jscript"),
            ("r''", "r_prime_prime"),
            ("ẋ_1", "xdot_1"),
            ("∂U", "dU"),
            ("ж", "u436"),
        ] {
            assert_eq!(ascii_name(name), spelled, "`{name}`");
        }
        for (mark, _, _) in COMPOSED {
            assert!(MARKS.iter().any(|(own, _)| *own == mark), "mark {mark:?} has a name");
        }
    }

    #[test]
    fn names_that_look_alike_have_one_skeleton() {
        for (a, b) in [("ω", "ѡ"), ("x1", "х1"), ("A'", "Α'"), ("Γ", "Г")] {
            assert_ne!(canonical_name(a), canonical_name(b), "two names");
            assert_eq!(skeleton(a), skeleton(b), "`{a}` and `{b}` look alike");
        }
        for (a, b) in [("ν", "v"), ("ρ", "p"), ("ω", "w"), ("γ", "y"), ("m", "M")] {
            assert_ne!(skeleton(a), skeleton(b), "`{a}` and `{b}` are told apart");
        }
        let advice = look_alike("x1", ["y", "х1"].into_iter()).expect("they look alike");
        assert!(advice.contains("U+0078") && advice.contains("U+0445"), "{advice}");
        assert_eq!(look_alike("x1", ["x1", "y1"].into_iter()), None, "one name, and another");
        assert_eq!(canonical_name("e\u{301}"), canonical_name("é"), "composed or not, one name");
    }

    #[test]
    fn other_texts_are_no_names() {
        for text in ["", "3a", "a b", "a+b", "'", "_a", "aᵀ", "γ²", "a'b", "\u{303}", "a "] {
            assert_eq!(canonical_name(text), None, "`{text}` is no identifier");
        }
    }

    #[test]
    fn the_composition_table_is_aligned() {
        for (mark, letters, results) in COMPOSED {
            assert_eq!(letters.chars().count(), results.chars().count(), "mark {mark:?}");
        }
    }
}
