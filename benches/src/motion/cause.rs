//! What an end is lost by, and what a texture pops by.

/// Why a line is not where it was.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Absence {
    /// Something hides it.
    Hidden,
    /// The surface is seen there, and has no line.
    NoLine,
    /// It is left out as a stub.
    Stub,
    /// It is left out as a double or a shred.
    Suppressed,
}

/// What parts two strokes in a frame that are one in the frame beside it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Joint {
    /// Raw lines end there in both frames, and are joined in one.
    Rule,
    /// In one frame the raw line changes its kind or surface.
    Kind,
    /// In one frame a part of the raw line is hidden, or two raw lines end there.
    Gap,
    /// In neither frame does a raw line end there: it is cut on the way.
    Cut,
}

/// Why ends that meet are joined in one of two frames alone, by what is drawn in the frame that parts them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Rule {
    /// One lies deeper than the other by more than lines may that are joined.
    Depth,
    /// They lie too far apart in the picture.
    Apart,
    /// They do not go on straight enough.
    Turn,
    /// What lies before the one goes on another way.
    Partner,
    /// Nothing of all that: a third end was there, or they moved since.
    Other,
}

/// Why a texture pops.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Pop {
    /// The stroke runs the other way.
    Reversed,
    /// A stroke of another kind or surface lies there.
    OtherLine,
    /// A ring starts elsewhere.
    Head,
    /// A ring opened, or a line closed to a ring.
    Ring(Joint),
    /// What lies before its start is another stroke in one of both frames, although raw lines end there in both.
    Rule(Rule),
    /// What lies before its start is another stroke in one of both frames.
    Joint(Joint),
    /// What lies before its start is not drawn in one of both frames.
    Start(Absence),
    /// Its start is where it was, and the way from there is longer or shorter.
    Stretched,
    /// Neither start lies on the other stroke.
    Elsewhere,
}

/// Why an end is lost.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Loss {
    /// The stroke goes on there.
    Joint(Joint),
    /// The line is not drawn up to there any more.
    Absence(Absence),
}
