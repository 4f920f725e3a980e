//! Whole frames whose lines mind the background.

use npr_core::camera::{Camera, Projection};
use npr_gpu::processor::Processor;
use npr_render::{Model, Picture, Renderer, RendererOptions};
use npr_scene::{Mesh, Node, Part, Scene};
use npr_style::backdrop::{Rule, contrast};
use npr_stylesheet::Style;

const SIZE: [u32; 2] = [240, 160];

/// Every pixel left of the middle black, all others white.
fn two_colors() -> Picture {
    black_and(255)
}

/// Every pixel left of the middle black, all others of a grey.
fn black_and(grey: u8) -> Picture {
    let texel = |i: u32| match i % SIZE[0] < SIZE[0] / 2 {
        true => [0, 0, 0, 255],
        false => [grey, grey, grey, 255],
    };
    Picture {
        size: SIZE,
        rgba: (0..SIZE[0] * SIZE[1]).flat_map(texel).collect(),
    }
}

/// A square of one unit to each side of the middle for every name, each nearer than the last and half as large.
fn squares(names: &[&str]) -> Model {
    let mut scene = Scene::default();
    for (i, name) in names.iter().enumerate() {
        let (half, z) = (0.5f32.powi(i as i32), i as f32 * 0.3);
        let corner = |x: f32, y: f32| [x * half, y * half, z];
        let part = Part {
            positions: vec![
                corner(-1.0, -1.0),
                corner(1.0, -1.0),
                corner(1.0, 1.0),
                corner(-1.0, 1.0),
            ],
            triangles: vec![[0, 1, 2], [0, 2, 3]],
            ..Part::default()
        };
        scene.meshes.push(Mesh {
            name: String::new(),
            parts: vec![part],
        });
        scene.nodes.push(Node {
            name: (*name).to_owned(),
            mesh: Some(i as u32),
            ..Node::default()
        });
    }
    Model::new(&scene).unwrap()
}

fn style(text: &str) -> Style {
    let base = r##"
        background = "two.png"
        shade.mode = "paper"
        shade.paper = "#101010"
        light.intensity = 0.0
        antialias.samples = 1
        [line]
        color = "#000000"
        width = { base = "4px", source = "constant", min = 1.0, max = 1.0 }
        background.method = "contrast"
    "##;
    let style = Style::from_toml(base, &|_| Err(String::new())).unwrap();
    text.lines()
        .map(str::trim)
        .filter(|line| !line.is_empty())
        .fold(style, |mut style, line| {
            style.set(line).unwrap();
            style
        })
}

fn with_rules(text: &str, rules: &str) -> Style {
    let toml = format!("{}\n{rules}", style(text).to_toml().unwrap());
    Style::from_toml(&toml, &|_| Err(String::new())).unwrap()
}

fn draw(model: &Model, style: &Style, tile_pixels: u32) -> Vec<[u8; 4]> {
    draw_before(two_colors(), model, style, tile_pixels)
}

fn draw_before(behind: Picture, model: &Model, style: &Style, tile_pixels: u32) -> Vec<[u8; 4]> {
    let options = RendererOptions {
        background_image: Some(behind),
        tile_pixels,
        ..RendererOptions::new(SIZE)
    };
    let frame = Renderer::new(&Processor, model, style, &options)
        .unwrap()
        .draw(&beside(0.0))
        .unwrap();
    frame
        .rgba
        .chunks_exact(4)
        .map(|texel| texel.try_into().unwrap())
        .collect()
}

/// Looks along -z from a place beside the middle.
fn beside(x: f32) -> Camera {
    Camera {
        eye: [x, 0.0, 5.0],
        target: [x, 0.0, 0.0],
        up: [0.0, 1.0, 0.0],
        projection: Projection::Parallel { height: 3.0 },
    }
}

fn at(frame: &[[u8; 4]], x: u32, y: u32) -> [f32; 3] {
    let [r, g, b, _] = frame[(y * SIZE[0] + x) as usize];
    [r, g, b].map(|byte| f32::from(byte) / 255.0)
}

/// Columns of the left and of the right side of the largest square: 1 unit is 53.3 pixels.
const SIDES: [u32; 2] = [66, 173];

const ALL: u32 = 4_000_000;

#[test]
fn a_black_line_lifts_before_black_and_stays_before_white_by_every_method() {
    let model = squares(&["hero"]);
    for method in ["shape", "okuya", "filter", "edges", "filter+hull"] {
        let frame = draw(&model, &style(&format!("line.method={method}")), ALL);
        // Across the border; the surface itself reads by half as much. A flat square has no hull.
        let across = SIDES[0] - 4..SIDES[0] + 2;
        let reads = across.map(|x| contrast(at(&frame, x, 80), [0.0; 3], &Rule::CONTRAST));
        let reads = reads.fold(0.0, f32::max);
        assert!(reads > 0.2, "{method}: {reads}");
        // Outside of the shape, where only the line may lie.
        let right = (174..177).map(|x| at(&frame, x, 80)[0]).fold(1.0, f32::min);
        assert!(
            right < 0.1 || method.starts_with("filter"),
            "{method}: {right}"
        );
    }
}

#[test]
fn the_publication_s_outline_is_a_pixel_wide_and_multiplies_the_rim() {
    let text = "line.method=rim\nline.background.method=published\nline.background.direction=brighter\n\
        line.background.intensity=4";
    let frame = draw(&squares(&["hero"]), &style(text), ALL);
    let row: Vec<u8> = (0..SIZE[0])
        .map(|x| frame[(80 * SIZE[0] + x) as usize][0])
        .collect();
    let brightened: Vec<usize> = (0..120).filter(|x| row[*x] > 20).collect();
    assert_eq!(brightened.len(), 1, "{row:?}");
    assert_eq!(row[brightened[0]], 4 * row[brightened[0] + 1]);
    assert_eq!((120..240).filter(|x| row[*x] == 0).count(), 1, "{row:?}");
}

#[test]
fn parts_keep_their_line_by_rule_and_belong_to_subjects_by_name() {
    let model = squares(&["body", "hair"]);
    // The small square lies before the large one: a border of two subjects, all dark.
    let [_, inner] = [66, 93];
    let reads = |frame: &[[u8; 4]], x: u32| {
        contrast(at(frame, x, 80), at(frame, x + 8, 80), &Rule::CONTRAST)
    };
    let roots = "line.background.subjects=root";
    let apart = draw(&model, &style(roots), ALL);
    assert!(
        reads(&apart, inner) > 0.2,
        "subjects of their own: {}",
        reads(&apart, inner)
    );
    let hair = "[[rule]]\nmatch.object = \"hair\"\n";
    let kept = draw(
        &model,
        &with_rules(roots, &format!("{hair}line.background.method = \"off\"\n")),
        ALL,
    );
    assert!(
        reads(&kept, inner) < 0.2,
        "hair keeps its line: {}",
        reads(&kept, inner)
    );
    let one = draw(
        &model,
        &with_rules(roots, "[[rule]]\nsubject = \"hero\"\n"),
        ALL,
    );
    assert!(
        reads(&one, inner) < 0.2,
        "one subject: {}",
        reads(&one, inner)
    );
    let all = with_rules(
        "line.background.scope=all",
        "[[rule]]\nsubject = \"hero\"\n",
    );
    let all = draw(&model, &all, ALL);
    assert!(
        reads(&all, inner) > 0.2,
        "lines within it too: {}",
        reads(&all, inner)
    );
    let ground = draw(
        &model,
        &with_rules(roots, "[[rule]]\nsubject = \"background\"\n"),
        ALL,
    );
    let off = draw(&model, &style("line.background.method=off"), ALL);
    assert_eq!(ground, off, "all background: nothing adapts");
}

#[test]
fn nothing_behind_and_nothing_before_leave_lines_alone() {
    for model in [squares(&["hero"]), squares(&[])] {
        let [on, off] = ["contrast", "off"].map(|method| {
            let text = format!("background=transparent\nline.background.method={method}");
            draw(&model, &style(&text), ALL)
        });
        assert_eq!(on, off);
    }
}

/// A picture of another shape covers the frame like a poster: middle lies on middle, and two sides are cut.
#[test]
fn pictures_of_another_shape_are_cut_at_two_sides() {
    // Bands in order: red to the cut, a white one just within it, green to the middle; blue, white and red after it.
    const BANDS: [[u8; 4]; 6] = [
        [255, 0, 0, 255],
        [255; 4],
        [0, 255, 0, 255],
        [0, 0, 255, 255],
        [255; 4],
        [255, 0, 0, 255],
    ];
    let band = |at: u32, starts: [u32; 5]| BANDS[starts.iter().filter(|s| at >= **s).count()];
    let picture = |size: [u32; 2], texel: &dyn Fn(u32, u32) -> [u8; 4]| Picture {
        size,
        rgba: (0..size[0] * size[1])
            .flat_map(|i| texel(i % size[0], i / size[0]))
            .collect(),
    };
    // Of 40 x 80 texels, 6 pixels each, rows 26.7 to 53.3 show; of 120 x 40, 4 pixels each, columns 30 to 90.
    let tall = picture([40, 80], &|_, y| band(y, [26, 30, 40, 50, 54]));
    let long = picture([120, 40], &|x, _| band(x, [30, 34, 60, 86, 90]));
    for (picture, axis, edges) in [
        (tall, 1, [0, 20, 80, 140, 160]),
        (long, 0, [0, 16, 120, 224, 240]),
    ] {
        for tile_pixels in [ALL, 9000] {
            let frame = draw_before(picture.clone(), &squares(&[]), &style(""), tile_pixels);
            for (i, pixel) in frame.iter().enumerate() {
                let at = [i as u32 % SIZE[0], i as u32 / SIZE[0]][axis];
                // A texel's colour goes over into the next within one texel.
                if edges.iter().any(|edge| at.abs_diff(*edge) < 4) {
                    continue;
                }
                let number = edges.iter().filter(|edge| at >= **edge).count();
                assert_eq!(*pixel, BANDS[number], "axis {axis}, at {at}");
            }
        }
    }
}

#[test]
fn tiles_do_not_show() {
    let model = squares(&["body", "hair"]);
    for text in [
        "",
        "line.background.scope=all\nantialias.samples=4",
        "line.method=rim",
    ] {
        let style = style(text);
        let whole = draw(&model, &style, ALL);
        assert_eq!(whole, draw(&model, &style, 9000), "{text}");
    }
}

/// What was decided for one view must not show in another: a still scene stays still, and a cut starts anew.
#[test]
fn still_frames_are_alike_and_cuts_start_anew() {
    let model = squares(&["body", "hair"]);
    let style = style("line.background.start=rim\nline.background.hold=2");
    let options = RendererOptions {
        background_image: Some(two_colors()),
        ..RendererOptions::new(SIZE)
    };
    let fresh = |x: f32| {
        let mut renderer = Renderer::new(&Processor, &model, &style, &options).unwrap();
        renderer.draw(&beside(x)).unwrap().rgba
    };
    let mut renderer = Renderer::new(&Processor, &model, &style, &options).unwrap();
    for x in [0.0, 0.0, 0.0, 1.0, 1.0, -0.5] {
        assert_eq!(renderer.draw(&beside(x)).unwrap().rgba, fresh(x), "at {x}");
    }
}

/// In small steps a square moves from the black half of a background to the other, and its lifted line turns black.
///
/// Before the dark grey, 0.37 of lightness, the line that was right before black would not read; and both walls are
/// so alike that what was decided before one is held before the other.
#[test]
fn a_line_changes_where_it_moves_before_another_wall() {
    let model = squares(&["hero"]);
    let style = style("line.background.hold=0\nline.background.fade=5");
    for grey in [0x40, 0xff] {
        let options = RendererOptions {
            background_image: Some(black_and(grey)),
            ..RendererOptions::new(SIZE)
        };
        let new_renderer = || Renderer::new(&Processor, &model, &style, &options).unwrap();
        let drawn = |renderer: &mut Renderer<'_>, x: f32| -> Vec<[u8; 4]> {
            let frame = renderer.draw(&beside(x)).unwrap();
            frame.rgba.as_chunks::<4>().0.to_vec()
        };
        // The square's middle goes from column 60 to column 180, and rests there until fades have ended.
        let mut renderer = new_renderer();
        let before = drawn(&mut renderer, 1.125);
        let steps = (1..=45).map(|step| 1.125 - 0.05 * step as f32);
        let rest = std::iter::repeat_n(-1.125, 12);
        let moved = steps.chain(rest).map(|x| drawn(&mut renderer, x));
        let after = moved.last().unwrap();
        // Above the upper side, row 26.7, there is only the line.
        let line = |frame: &[[u8; 4]], x: u32| at(frame, x, 25);
        let (lifted, black) = (line(&before, 60), line(&after, 180));
        let reads = |line: [f32; 3], behind: u8| {
            let behind = [f32::from(behind) / 255.0; 3];
            contrast(line, behind, &Rule::CONTRAST) > Rule::CONTRAST.goal - 0.01
        };
        assert!(reads(lifted, 0), "{lifted:?} before black");
        assert!(reads(black, grey), "{black:?} before {grey}");
        assert!(
            lifted[0] > 0.15 && black == [0.0; 3],
            "{lifted:?} turned {black:?}"
        );
        let first = drawn(&mut new_renderer(), -1.125);
        assert!(after == first, "before {grey} as a first frame");
    }
}
