// The subject that each pixel shows. Twin: npr_style::backdrop::Scenery.
// The shader declares `window`, `rules`, `ids`, `triangles` and `part_subjects`.

//# use lib/backdrop

// A pixel whose samples disagree.
const MIXED: u32 = 0xffffffffu;

struct Shown {
    subject: u32,
    part: u32,
}

fn part_of(id: u32) -> u32 {
    return triangles[(id & ID_MASK) - 1u].part;
}

fn subject_of(id: u32) -> u32 {
    if id == 0u { return 0u; }
    return part_subjects[part_of(id)].subject;
}

// Subject and part that a pixel shows; the subject is MIXED if its samples disagree.
fn shown_at(x: u32, y: u32) -> Shown {
    let samples = rules.samples;
    let first = textureLoad(ids, vec2<u32>(x, y) * samples, 0).x;
    var shown: Shown;
    shown.subject = subject_of(first);
    if first != 0u { shown.part = part_of(first); }
    for (var i = 1u; i < samples * samples; i++) {
        let at = vec2<u32>(x * samples + i % samples, y * samples + i / samples);
        if subject_of(textureLoad(ids, at, 0).x) != shown.subject { shown.subject = MIXED; }
    }
    return shown;
}
