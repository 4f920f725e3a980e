//! A case of an option that acts, or is told.

/// What an option does beside others.
pub enum Does {
    /// The file differs.
    Acts,
    /// A warning with this text; the file is the same.
    Told(&'static str),
}

/// A command line without and with an option, and what that does; `FILE` stands for the output.
pub type Case = (&'static [&'static str], &'static [&'static str], Does);

/// A setting that leaves hard folds to the normals.
pub const NORMALS_ALONE: &str = "line.crease_hard_deg=180";
