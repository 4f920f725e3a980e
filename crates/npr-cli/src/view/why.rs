//! What is told of a line that is clicked.

use npr_render::{LineReason, Pointed, PointedPart, Removal};
use npr_stylesheet::Style;
use npr_view::{Answer, Question, Remedy, ToldFact, ToldLine, ToldPart};

/// What a renderer found at the place of a question, as a studio tells it.
pub fn answer(question: &Question, style: &Style, pointed: Pointed) -> Answer {
    let size = question.order.size;
    Answer {
        change: question.order.change,
        notice: notice(style),
        line: pointed.line.map(|line| told(line, size)),
        part: pointed.part.map(told_part),
    }
}

/// What is said where lines are no strokes.
fn notice(style: &Style) -> Option<String> {
    (!style.has_curves()).then(|| {
        "Lines of this line.method are found on pixels; those of method strokes can say why they are there.".to_owned()
    })
}

fn told(line: LineReason, [width, height]: [u32; 2]) -> ToldLine {
    let share = |[x, y]: [f64; 2]| {
        [
            (x / f64::from(width)) as f32,
            (y / f64::from(height)) as f32,
        ]
    };
    let facts = line.facts.into_iter().map(|fact| ToldFact {
        name: fact.name,
        text: fact.text,
        key: fact.key,
    });
    ToldLine {
        points: line.points.into_iter().map(share).collect(),
        closed: line.closed,
        facts: facts.collect(),
        part: told_part(line.part),
        removal: match line.removal {
            Removal::Kind(kind) => Remedy::Key(format!("line.kinds.{}", kind.name())),
            Removal::Part => Remedy::Rule,
        },
    }
}

fn told_part(part: PointedPart) -> ToldPart {
    ToldPart {
        object: part.object,
        material: part.material,
        at_rest: part.at_rest,
    }
}
