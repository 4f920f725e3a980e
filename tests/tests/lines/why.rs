//! Why a line is there: what is told of strokes is what they were drawn by, and what would remove them does.

use npr_core::camera::Camera;
use npr_gpu::processor::Processor;
use npr_mesh::testing::{Random, cube};
use npr_render::{
    Drawing, Kind, LineModel, LineModelOptions, LineOptions, LineReason, LineRenderer, Pointed,
    Removal, RendererOptions, Spot, Subject,
};
use npr_scene::Scene;
use npr_stylesheet::{Match, Rule, RuleLine, Style};
use npr_tests::{Object, asset, placed, scene_of};
use npr_vector::stroke::Stroke;

const SIZE: [u32; 2] = [480, 360];

/// Longest piece of a line that may go with a line of another kind beside it: a fiftieth of the picture's height.
const SHRED_PX: f64 = 7.2;

/// A style that leaves nothing out for being short, which hangs on the lines around it.
fn style() -> Style {
    let mut style = Style::preset("ink").unwrap();
    for text in [
        "line.least=0",
        "line.crease_least=0",
        "line.kinds.crease=true",
        "line.width.min=0.4",
        "line.width.taper.start=20",
        "line.width.pressure=[{ at = 0, factor = 0.7 }, { at = 1, factor = 1.3 }]",
    ] {
        style.set(text).unwrap();
    }
    style
}

/// A scene with its lines, and the camera that frames it.
struct Subjects {
    model: LineModel,
    camera: Camera,
}

impl Subjects {
    fn new(scene: &Scene, style: &Style) -> Self {
        let model = LineModel::for_style(scene, style, &LineModelOptions::default(), None).unwrap();
        let camera = model.framing(SIZE[0] as f32 / SIZE[1] as f32, 0.7);
        Self { model, camera }
    }

    fn drawing(&self, style: &Style) -> Drawing {
        let options = LineOptions::of_style(style, SIZE);
        let mut renderer = LineRenderer::new(&Processor, &self.model);
        renderer.draw(&self.camera, style, &options).unwrap()
    }

    fn pointed(&self, style: &Style, place: [f64; 2]) -> Pointed {
        let options = LineOptions::of_style(style, SIZE);
        let spot = Spot {
            place,
            reach_px: 3.0,
        };
        let mut renderer = LineRenderer::new(&Processor, &self.model);
        renderer
            .point_at(&self.camera, style, &options, spot)
            .unwrap()
    }

    /// The line at a random place of a random stroke.
    fn random_line(&self, style: &Style, drawing: &Drawing, random: &mut Random) -> LineReason {
        loop {
            let stroke = &drawing.strokes[random.below(drawing.strokes.len())];
            let point = &stroke.points[random.below(stroke.points.len())];
            if point.width > 0.2 {
                let line = self.pointed(style, point.position).line.unwrap();
                assert!(line.away_px < 0.5 && is_near(&line.points, point.position, 0.5));
                return line;
            }
        }
    }
}

fn is_near(points: &[[f64; 2]], place: [f64; 2], reach: f64) -> bool {
    points.windows(2).any(|pair| {
        let [ax, ay] = pair[0];
        let [dx, dy] = [pair[1][0] - ax, pair[1][1] - ay];
        let share = ((place[0] - ax) * dx + (place[1] - ay) * dy) / (dx * dx + dy * dy).max(1e-30);
        let share = share.clamp(0.0, 1.0);
        (place[0] - ax - share * dx).hypot(place[1] - ay - share * dy) <= reach
    })
}

fn places(stroke: &Stroke) -> Vec<[f64; 2]> {
    let mut places: Vec<[f64; 2]> = stroke.points.iter().map(|point| point.position).collect();
    if stroke.closed {
        places.extend(places.first().copied());
    }
    places
}

/// Whether a drawing has a stroke of a kind at a place.
fn has(drawing: &Drawing, kind: Kind, place: [f64; 2], reach: f64) -> bool {
    let mut of_kind = drawing.strokes.iter().filter(|stroke| stroke.kind == kind);
    of_kind.any(|stroke| is_near(&places(stroke), place, reach))
}

/// Length of the longest piece of a stroke that another drawing has no stroke of its kind for, in pixels.
fn gone_px(stroke: &Stroke, after: &Drawing) -> f64 {
    let (mut longest, mut run): (f64, f64) = (0.0, 0.0);
    for pair in places(stroke).windows(2) {
        let middle = [0, 1].map(|i| 0.5 * (pair[0][i] + pair[1][i]));
        let length = (pair[1][0] - pair[0][0]).hypot(pair[1][1] - pair[0][1]);
        run = match has(after, stroke.kind, middle, 1.5) {
            true => 0.0,
            false => run + length,
        };
        longest = longest.max(run);
    }
    longest
}

/// The style with what would remove a line.
fn without(style: &Style, line: &LineReason) -> Style {
    let mut style = style.clone();
    match line.removal {
        Removal::Kind(kind) => {
            let text = format!("line.kinds.{}=false", kind.name());
            style.set(&text).unwrap();
        }
        Removal::Part => style.rule.push(Rule {
            matching: Match {
                object: line.part.object.clone(),
                material: line.part.material.clone(),
                ..Match::default()
            },
            line: RuleLine {
                on: Some(false),
                ..RuleLine::default()
            },
            ..Rule::default()
        }),
    }
    style
}

#[test]
fn what_would_remove_a_line_does_and_takes_no_line_of_another_kind() {
    let style = style();
    let mut random = Random::new(7);
    let mut seen = Vec::new();
    for name in ["still_life.glb", "teapot_box_plane.glb"] {
        let subject = Subjects::new(&asset(name), &style);
        let before = subject.drawing(&style);
        for _ in 0..20 {
            let line = subject.random_line(&style, &before, &mut random);
            let after = subject.drawing(&without(&style, &line));

            // The line is gone.
            for place in &line.points {
                assert!(!has(&after, line.kind, *place, 2.0), "{name}: {line:?}");
            }

            // All of other kinds are there, but for shreds beside the line: ends that met it meet others now.
            let others = before
                .strokes
                .iter()
                .filter(|stroke| stroke.kind != line.kind);
            for stroke in others {
                let gone = gone_px(stroke, &after);
                let kinds = [stroke.kind, line.kind].map(Kind::name);
                assert!(
                    gone < SHRED_PX,
                    "{name}: {gone} px of {} without {}",
                    kinds[0],
                    kinds[1]
                );
            }
            seen.push(line.kind);
        }
    }
    seen.sort_unstable();
    seen.dedup();
    assert!(seen.len() >= 2, "{seen:?}");
}

#[test]
fn widths_are_the_product_of_what_is_told_and_colours_are_those_of_the_stroke() {
    let mut style = style();
    let text = "line.paint.kinds.crease=#205080";
    style.set(text).unwrap();
    style.rule.push(Rule {
        line: RuleLine {
            width_factor: Some(1.7),
            ..RuleLine::default()
        },
        ..Rule::default()
    });
    let rule = format!("rule.{}.line.width_factor", style.rule.len() - 1);
    let subject = Subjects::new(&asset("still_life.glb"), &style);
    let drawing = subject.drawing(&style);
    let mut random = Random::new(3);
    let mut steps = 0;
    for _ in 0..20 {
        let line = subject.random_line(&style, &drawing, &mut random);
        let number = |text: &str| {
            text.split([' ', ':'])
                .find_map(|word| word.parse::<f64>().ok())
        };
        let first = line
            .facts
            .iter()
            .position(|fact| fact.name == "Width")
            .unwrap();
        let told = number(&line.facts[first].text).unwrap();
        let rest = line.facts[first + 1..].iter();
        let factors: Vec<f64> = rest
            .take_while(|fact| fact.name.is_empty())
            .map(|fact| number(&fact.text).unwrap())
            .collect();
        let product: f64 = factors.iter().product();
        assert!((told - line.width_px).abs() < 0.006, "{line:?}");
        let room = 0.06 * told + 0.03;
        assert!((product - told).abs() < room, "{product} {:?}", line.facts);
        steps += factors.len();
        assert!(
            line.facts
                .iter()
                .any(|fact| fact.key.as_deref() == Some(&rule))
        );
        if line.kind == Kind::Crease {
            assert_eq!(line.color, [0x20, 0x50, 0x80, 0xff]);
            let key = Some("line.paint.kinds.crease");
            assert!(line.facts.iter().any(|fact| fact.key.as_deref() == key));
        }
    }
    assert!(steps > 60, "{steps}");
}

#[test]
fn frames_tell_what_drawings_tell() {
    let style = style();
    let scene = asset("still_life.glb");
    let subject = Subjects::new(&scene, &style);
    let drawing = subject.drawing(&style);
    let of_frames = Subject::new(&scene, &style).unwrap();
    let options = RendererOptions::new(SIZE);
    let mut renderer = of_frames.renderer(&Processor, &style, &options).unwrap();
    let mut random = Random::new(11);
    for _ in 0..5 {
        let line = subject.random_line(&style, &drawing, &mut random);
        let place = line.points[line.points.len() / 2];
        let spot = Spot {
            place,
            reach_px: 3.0,
        };
        let of_frame = renderer.point_at(&subject.camera, spot).unwrap();
        assert_eq!(of_frame, subject.pointed(&style, place));
        let nothing = Spot {
            place: [1.0, 1.0],
            reach_px: 3.0,
        };
        assert_eq!(
            renderer.point_at(&subject.camera, nothing).unwrap(),
            Pointed::default()
        );
    }
}

#[test]
fn a_part_is_told_where_no_line_is() {
    let scene = scene_of(&[Object::new("Box", placed(&cube(), [1.0; 3], [0.0; 3]))]);
    let style = style();
    let subject = Subjects::new(&scene, &style);
    let middle = SIZE.map(|side| f64::from(side) * 0.5 + 14.0);
    let part = subject.pointed(&style, middle).part.unwrap();
    assert_eq!(part.object, "Box");
    assert_eq!(part.world, part.at_rest);
    let reach = part.world.iter().fold(0.0f32, |most, v| most.max(v.abs()));
    assert!((reach - 1.0).abs() < 1e-3, "{part:?}");
}
