//! Rules laid over the style: tables of plain values, and for each the table of what rules may state about it.
//!
//! A rule may state most keys of a table of the style, so its own table has the same keys, all of them optional.
//! [`style_table!`] declares both tables from one list of keys, with the default of each, and lays one over the other.
//! [`rule_table!`] declares the rules' table alone, where rules may state only some of the keys.
//!
//! The rules' tables are structs, not TOML, for four reasons. The schema has a text of its own for every key of a
//! rule. Dumped styles spell values out in the order of the structs, whatever the file wrote. Callers read and build
//! rules by field. And a frame lays rules over the style once for every part, which moves plain values here and would
//! read a table anew there.

/// Lays the values that a rule states over those that a part had without it.
pub(crate) trait Over<T> {
    /// `below`, with the stated values in place of its own.
    fn over(&self, below: T) -> T;
}

impl<T: Clone> Over<T> for Option<T> {
    fn over(&self, below: T) -> T {
        self.clone().unwrap_or(below)
    }
}

impl<T: Clone> Over<Option<T>> for Option<T> {
    fn over(&self, below: Option<T>) -> Option<T> {
        self.clone().or(below)
    }
}

/// Declares a table of the style, with a field and a default for each key; and the rules' table too, where rules may
/// state all of the keys.
///
/// `#[rule = ".."]` is the text of a key in the rules' schema; ranges and lengths hold for both. Nested tables are
/// listed in the block `with`, each with its own rules' table.
macro_rules! style_table {
    (
        $(#[doc = $about:tt])+
        pub struct $Table:ident {
            $($(#[$attribute:meta])+ pub $key:ident: $type:ty = $default:expr,)*
        }
    ) => {
        $(#[doc = $about])+
        #[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize, schemars::JsonSchema)]
        #[serde(default, deny_unknown_fields)]
        pub struct $Table {
            $($(#[$attribute])+ pub $key: $type,)*
        }

        impl Default for $Table {
            fn default() -> Self {
                Self { $($key: $default,)* }
            }
        }
    };
    (
        $(#[doc = $about:tt])+
        pub struct $Table:ident;
        $(#[doc = $rule_about:tt])+
        pub struct $Rule:ident {
            $(
                $(#[doc = $doc:tt])+
                $(#[schemars(range $range:tt)])?
                $(#[schemars(length $length:tt)])?
                $(#[schemars(inner $inner:tt)])?
                #[rule = $words:tt]
                pub $key:ident: $type:ty = $default:expr,
            )*
        }
        $(with {
            $(
                $(#[doc = $table_doc:tt])+
                #[rule = $table_words:tt]
                pub $table:ident: $Inner:ident or $RuleInner:ident,
            )*
        })?
    ) => {
        $crate::overlay::style_table! {
            $(#[doc = $about])+
            pub struct $Table {
                $(
                    $(#[doc = $doc])+
                    $(#[schemars(range $range)])?
                    $(#[schemars(length $length)])?
                    $(#[schemars(inner $inner)])?
                    pub $key: $type = $default,
                )*
                $($($(#[doc = $table_doc])+ pub $table: $Inner = $Inner::default(),)*)?
            }
        }

        $crate::overlay::rule_table! {
            $(#[doc = $rule_about])+
            pub struct $Rule over $Table {
                $(
                    #[doc = $words]
                    $(#[schemars(range $range)])?
                    $(#[schemars(length $length)])?
                    $(#[schemars(inner $inner)])?
                    pub $key: $type,
                )*
            }
            $(with { $(#[doc = $table_words] pub $table: $RuleInner,)* })?
        }
    };
}

/// Declares the rules' table of a table of the style. Absent keys leave a part's values as they were.
///
/// A key with `#[yields_to(other)]` is reset where a rule states the other one and not the key itself.
macro_rules! rule_table {
    (
        $(#[doc = $about:tt])+
        pub struct $Rule:ident over $Table:ident {
            $(
                $(#[doc = $doc:tt])+
                $(#[schemars $schemars:tt])?
                $(#[yields_to($other:ident)])?
                pub $key:ident: $type:ty,
            )*
        }
        $(with { $($(#[doc = $table_doc:tt])+ pub $table:ident: $RuleInner:ident,)* })?
    ) => {
        $(#[doc = $about])+
        #[derive(Debug, Clone, PartialEq, Default, serde::Serialize, serde::Deserialize, schemars::JsonSchema)]
        #[serde(default, deny_unknown_fields)]
        pub struct $Rule {
            $(
                $(#[doc = $doc])+
                $(#[schemars $schemars])?
                #[serde(skip_serializing_if = "Option::is_none")]
                pub $key: Option<$type>,
            )*
            $($($(#[doc = $table_doc])+ pub $table: $RuleInner,)*)?
        }

        impl $crate::overlay::Over<$Table> for $Rule {
            fn over(&self, mut below: $Table) -> $Table {
                $(
                    $(if self.$other.is_some() {
                        below.$key = Default::default();
                    })?
                    below.$key = self.$key.over(below.$key);
                )*
                $($(below.$table = self.$table.over(below.$table);)*)?
                below
            }
        }
    };
}

pub(crate) use {rule_table, style_table};
