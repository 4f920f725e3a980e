//! Causes in words.

use npr_benches::motion::causes::{Absence, Joint, Loss, Pop, Rule};

/// Why a line is not there.
pub fn of_absence(absence: Absence) -> &'static str {
    match absence {
        Absence::Hidden => "something hides it",
        Absence::NoLine => "the surface is seen, and has no line there",
        Absence::Stub => "a stub in one frame",
        Absence::Suppressed => "a double or a shred in one frame",
    }
}

/// What parts two strokes.
pub fn of_joint(joint: Joint) -> &'static str {
    match joint {
        Joint::Rule => "ends that meet in both frames, joined in one",
        Joint::Kind => "the raw line changes kind or surface in one frame",
        Joint::Gap => "raw lines end there in one frame",
        Joint::Cut => "cut where no raw line ends",
    }
}

/// Why ends are joined in one frame alone.
fn of_rule(rule: Rule) -> &'static str {
    match rule {
        Rule::Depth => "too far apart in depth in one frame",
        Rule::Apart => "too far apart in the picture in one frame",
        Rule::Turn => "not straight enough in one frame",
        Rule::Partner => "what lies before goes on another way in one frame",
        Rule::Other => "other reasons in one frame",
    }
}

/// Why a texture pops.
pub fn of_pop(pop: Pop) -> String {
    match pop {
        Pop::Reversed => "the stroke runs the other way".to_owned(),
        Pop::OtherLine => "a stroke of another kind or surface".to_owned(),
        Pop::Head => "a ring starts elsewhere".to_owned(),
        Pop::Ring(joint) => format!("a ring opens or closes: {}", of_joint(joint)),
        Pop::Rule(rule) => format!("ends that meet in both frames: {}", of_rule(rule)),
        Pop::Joint(joint) => format!("more or less before its start: {}", of_joint(joint)),
        Pop::Start(absence) => format!("its start comes or goes: {}", of_absence(absence)),
        Pop::Elsewhere => "neither start lies on the other stroke".to_owned(),
        Pop::Stretched => "the way from its start is longer or shorter".to_owned(),
    }
}

/// Why an end is lost.
pub fn of_loss(loss: Loss) -> String {
    match loss {
        Loss::Joint(joint) => format!("the stroke goes on: {}", of_joint(joint)),
        Loss::Absence(absence) => format!("no ink up to there: {}", of_absence(absence)),
    }
}
