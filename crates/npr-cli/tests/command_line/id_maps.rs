//! Rules by id maps, and maps that are missing, broken or odd.

use crate::files::tiny_png;
use crate::workplace::Workplace;
use png::{BitDepth, ColorType, Encoder};

/// Two squares beside each other on one mesh: the left one lies on the left half of the map, the right one on the
/// right.
const SCENE: &[u8] = b"mtllib none.mtl\no Card\nusemtl Cloth\n\
    v -1 0 0\nv 0 0 0\nv 1 0 0\nv -1 1 0\nv 0 1 0\nv 1 1 0\n\
    vt 0 0\nvt 0.5 0\nvt 1 0\nvt 0 1\nvt 0.5 1\nvt 1 1\n\
    f 1/1 2/2 5/5 4/4\nf 2/2 3/3 6/6 5/5\n";

const STYLE: &str = "shade.mode = 'flat'\n[[id_map]]\nimage = 'ids.png'\n\
    ids = [{ name = 'left', color = '#ff0000' }, { name = 'right', color = '#0000ff' }]\n\
    [[rule]]\nmatch.id = 'left'\nshade.color = '#ff0000'\nline.color = '#aa0000'\n\
    [[rule]]\nmatch.id = 'right'\nshade.color = '#0000ff'\nline.color = '#0000aa'\n";

fn place() -> Workplace {
    let place = Workplace::new();
    place.put("card.obj", SCENE);
    place.put("none.mtl", b"newmtl Cloth\n");
    place.put("ids.toml", STYLE.as_bytes());
    place
}

/// A picture two pixels wide, by the bytes of its row.
fn pair(color: ColorType, depth: BitDepth, row: &[u8]) -> Vec<u8> {
    let mut file = Vec::new();
    let mut encoder = Encoder::new(&mut file, 2, 1);
    encoder.set_color(color);
    encoder.set_depth(depth);
    if color == ColorType::Indexed {
        encoder.set_palette(vec![255, 0, 0, 0, 0, 255]);
    }
    let mut writer = encoder.write_header().expect("a header");
    writer.write_image_data(row).expect("two pixels");
    drop(writer);
    file
}

fn red_and_blue() -> Vec<u8> {
    pair(ColorType::Rgb, BitDepth::Eight, &[255, 0, 0, 0, 0, 255])
}

/// The colours of a picture's middle row, a third and two thirds along.
fn sides(file: &[u8]) -> [[u8; 3]; 2] {
    let decoder = png::Decoder::new(std::io::Cursor::new(file));
    let mut reader = decoder.read_info().expect("a header");
    let (size, samples) = (reader.info().size(), reader.info().color_type.samples());
    let mut rows = Vec::new();
    while let Some(row) = reader.next_row().expect("pixels") {
        rows.push(row.data().to_vec());
    }
    let row = &rows[size.1 as usize / 2];
    [2, 4].map(|sixth| {
        let at = size.0 as usize * sixth / 6 * samples;
        [row[at], row[at + 1], row[at + 2]]
    })
}

/// Draws the card from the front with the style, and gives the colours of its halves.
fn drawn(place: &Workplace) -> [[u8; 3]; 2] {
    place
        .render(
            "card.obj",
            &[
                "--style", "ids.toml", "--eye", "0,0.5,3", "--target", "0,0.5,0",
            ],
        )
        .assert_silent_success();
    sides(&place.get("card.png"))
}

#[test]
fn regions_follow_their_rules_in_pictures_and_lines() {
    let place = place();
    place.put("ids.png", &red_and_blue());
    assert_eq!(drawn(&place), [[255, 0, 0], [0, 0, 255]]);
    let view = ["--eye", "0,0.5,3", "--target", "0,0.5,0", "--size", "90x60"];
    for method in ["edges", "surface"] {
        let arguments = [
            "lines", "card.obj", "-o", "-", "--style", "ids.toml", "--method", method, "--quiet",
        ];
        let lines = place.npr(&[&arguments[..], &view].concat());
        lines.assert_silent_success();
        let text = lines.text();
        assert!(
            text.contains("#aa0000") && text.contains("#0000aa"),
            "{method}"
        );
    }
}

#[test]
fn every_kind_of_pixel_is_read() {
    let place = place();
    for (color, depth, row) in [
        (
            ColorType::Rgb,
            BitDepth::Sixteen,
            &[255, 255, 0, 0, 0, 0, 0, 0, 0, 0, 255, 255][..],
        ),
        (
            ColorType::Rgba,
            BitDepth::Eight,
            &[255, 0, 0, 255, 0, 0, 255, 255],
        ),
        (ColorType::Indexed, BitDepth::One, &[0b0100_0000]),
        (ColorType::Indexed, BitDepth::Eight, &[0, 1]),
    ] {
        place.put("ids.png", &pair(color, depth, row));
        assert_eq!(
            drawn(&place),
            [[255, 0, 0], [0, 0, 255]],
            "{color:?} {depth:?}"
        );
    }
}

#[test]
fn missing_and_broken_maps_are_named() {
    let place = place();
    let huge = {
        let mut file = red_and_blue();
        // The width, and its checksum, which decoders check after it is too large.
        file[16..20].copy_from_slice(&60_000u32.to_be_bytes());
        file
    };
    let mut torn = red_and_blue();
    torn.truncate(50);
    for (bytes, exit, text) in [
        (None, 1, "ids.png"),
        (Some(&b"no picture"[..]), 3, "ids.png"),
        (Some(&b""[..]), 3, "ids.png"),
        (Some(&torn[..]), 3, "ids.png"),
        (Some(&huge[..]), 3, "ids.png"),
    ] {
        if let Some(bytes) = bytes {
            place.put("ids.png", bytes);
        }
        for command in ["render", "lines"] {
            let outcome = place.npr(&[
                command, "card.obj", "--style", "ids.toml", "--size", "48x32",
            ]);
            outcome.assert_fault(exit, text);
            assert!(
                outcome.stderr.starts_with("npr: id_map.0.image: "),
                "{}",
                outcome.stderr
            );
        }
    }
    place.put("ids.png", &red_and_blue());
    place
        .render(
            "card.obj",
            &["--style", "ids.toml", "--max-image-side", "1"],
        )
        .assert_fault(5, "--max-image-side");
    place
        .render("card.obj", &["--style", "ids.toml", "-o", "ids.png"])
        .assert_fault(2, "ids.png");
}

#[test]
fn maps_that_tell_nothing_apart_are_warned_of() {
    let place = place();
    place.put("ids.png", &tiny_png());
    for command in ["render", "lines"] {
        let outcome = place.npr(&[
            command, "card.obj", "--style", "ids.toml", "--size", "48x32",
        ]);
        assert_eq!(outcome.code, Some(0));
        let wanted = "npr: warning: id map 'ids.png' names 'left', 'right', but no triangle shows that colour most\n";
        let (map, rest) = outcome.stderr.split_at(wanted.len());
        assert_eq!(map, wanted);
        // Lines have no shade, of which the style says something.
        assert_eq!(
            rest.lines().count(),
            usize::from(command == "lines"),
            "{rest}"
        );
    }
}

#[test]
fn a_style_is_checked_for_ids() {
    let place = place();
    place.put(
        "slip.toml",
        format!("{STYLE}[[rule]]\nmatch.id = 'lefty'").as_bytes(),
    );
    let outcome = place.npr(&["styles", "check", "slip.toml"]);
    outcome.assert_fault(2, "is no id of an id_map; did you mean 'left'?");
    place
        .npr(&[
            "render",
            "card.obj",
            "--set",
            "rule=[{match={id='#ff0000'}}]",
        ])
        .assert_fault(2, "names an id, but the style has no id_map");
}
