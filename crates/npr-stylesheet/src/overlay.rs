//! Rules laid over the style: tables of plain values, and beside each the table of what rules say of it.
//!
//! A rule may say most keys of a part of the style, each or none: its table has the same keys, every one optional.
//! [`style_table!`] writes both tables from one list of keys, with the default of each, and lays one over the other;
//! [`rule_table!`] writes the rules' table alone, where rules may say some of the keys. The rules' tables are structs,
//! not TOML: the schema has a text of its own for every key of a rule, dumped styles spell values out in the order of
//! the structs whatever the file wrote, callers read and build rules by field, and a frame lays rules over the style
//! once a part, which moves plain values here and would read a table anew there.

/// What a rule states, over what a part had without it.
pub(crate) trait Over<T> {
    /// `below`, with what is stated in place of what it had.
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

/// A table of the style, each key a field with its default; and the rules' table, where all of its keys stand in it.
///
/// `#[rule = ".."]` is the text of a key in the rules' schema; ranges and lengths hold for both. Tables within stand
/// in the block `with`, each with the rules' table of its own.
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

/// The rules' table over a table of the style: absent keys leave what a part had.
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
