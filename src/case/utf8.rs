//! Texts of files, which are UTF-8.

use std::ops::Range;

/// A text that is not UTF-8.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("byte 0x{byte:02X} in line {line} is not UTF-8{}", told(*.is_wide))]
pub struct NotUtf8 {
    /// The first byte that does not belong there.
    pub byte: u8,
    /// Its line, from 1.
    pub line: usize,
    /// Whether the text begins with the mark of UTF-16.
    pub is_wide: bool,
    /// Text with a replacement character for what is wrong.
    pub lossy: String,
    /// Place of the first one in this text.
    pub span: Range<usize>,
}

fn told(is_wide: bool) -> &'static str {
    if is_wide { ": the file is UTF-16" } else { "" }
}

impl NotUtf8 {
    /// Advice.
    pub const HELP: &'static str = "save the file in the editor with the encoding UTF-8";
}

/// Reads the bytes of a file as a text.
///
/// # Errors
///
/// The first byte that is not UTF-8, with its line.
pub fn utf8(bytes: Vec<u8>) -> Result<String, NotUtf8> {
    String::from_utf8(bytes).map_err(|error| {
        let start = error.utf8_error().valid_up_to();
        let bytes = error.as_bytes();
        NotUtf8 {
            byte: bytes[start],
            line: bytes[..start].iter().filter(|byte| **byte == b'\n').count() + 1,
            is_wide: bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]),
            lossy: String::from_utf8_lossy(bytes).into_owned(),
            span: start..start + char::REPLACEMENT_CHARACTER.len_utf8(),
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wrong_bytes_have_a_place() {
        assert_eq!(utf8("é".into()), Ok("é".to_string()));
        let error = utf8(b"title = 'a'\nsource = 'Poincar\xe9'\n".to_vec()).expect_err("Latin-1");
        assert_eq!(error.to_string(), "byte 0xE9 in line 2 is not UTF-8");
        assert_eq!(&error.lossy[error.span.clone()], "\u{fffd}");
        let error = utf8(vec![0xff, 0xfe, b't', 0]).expect_err("UTF-16");
        assert!(error.to_string().ends_with("the file is UTF-16"), "{error}");
    }
}
