//! Lists of the kinds of statements, each of which is a type written in one file.

/// Shape of the value of a key of a claim.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ValueShape {
    /// A text or a number.
    Text,
    /// A list, or one text.
    List,
    /// A table, or one text.
    Table,
    /// A list, a table, or one text.
    ListOrTable,
}

impl ValueShape {
    /// Returns the shape of `key` in a list of the keys whose values are more than a text.
    pub fn of(key: &str, shapes: &[(&str, Self)]) -> Self {
        let own = shapes.iter().find(|(name, _)| *name == key);
        own.map_or(Self::Text, |(_, shape)| *shape)
    }
}

/// Makes the enum of some kinds of statements, the list of their keys, and what all kinds share: they are
/// read by their key, and have a name, companions and the shapes of their values.
macro_rules! statements {
    (
        $(#[$about:meta])* $name:ident,
        $(#[$keys_about:meta])* $keys:ident,
        $($kind:ident),* $(,)?
    ) => {
        $(#[$about])*
        #[derive(Clone, Debug)]
        pub enum $name {
            $(#[doc = concat!("See [`", stringify!($kind), "`].")] $kind($kind),)*
        }

        $(#[$keys_about])*
        pub const $keys: &[&str] = &[$($kind::NAME),*];

        impl $name {
            /// Reads the statement of `key`, if it is one of these.
            pub fn read<R: Reader>(key: &str, from: &R) -> Option<Result<Self, R::Error>> {
                match key {
                    $(_ if key == $kind::NAME => Some($kind::read(from).map(Self::$kind)),)*
                    _ => None,
                }
            }

            /// Returns the keys that may accompany the statement of `key`.
            pub fn companions(key: &str) -> &'static [&'static str] {
                match key {
                    $(_ if key == $kind::NAME => $kind::COMPANIONS,)*
                    _ => &[],
                }
            }

            /// Returns the keys of the statement of `key` whose values are more than a text.
            pub fn shapes(key: &str) -> &'static [(&'static str, ValueShape)] {
                match key {
                    $(_ if key == $kind::NAME => $kind::SHAPES,)*
                    _ => &[],
                }
            }

            /// Returns the kind's name in case files and reports.
            pub fn name(&self) -> &'static str {
                match self { $(Self::$kind(_) => $kind::NAME,)* }
            }
        }
    };
}

pub(super) use statements;
