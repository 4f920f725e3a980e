//! Slips of styles and pictures, told in one line each.

use super::fixture::{BLUE, RED, cut, halves, painted, scene, with_map};
use npr_mesh::testing::icosphere;
use npr_render::{Picture, apply_id_maps};
use npr_scene::Scene;
use npr_stylesheet::Style;
use std::collections::BTreeMap;

fn reported(scene: Scene, style: &Style, pictures: &BTreeMap<String, Picture>) -> Vec<String> {
    let scene = cut(scene, style, pictures);
    scene.notices.iter().map(ToString::to_string).collect()
}

fn ball() -> Scene {
    scene("Ball", icosphere(4))
}

#[test]
fn what_fits_is_not_told_of() {
    let rules = "[[rule]]\nmatch.id = 'left'\n[[rule]]\nmatch.id = '?*'";
    assert_eq!(
        reported(ball(), &with_map("shape", "", rules), &halves()),
        [""; 0]
    );
}

#[test]
fn a_map_on_nothing_is_told_of() {
    let style = with_map("shape", "object = 'Cube'\nmaterial = 'Skin*'", "");
    assert_eq!(
        reported(ball(), &style, &halves()),
        ["id map 'ids.png' lies on nothing: no part is of object 'Cube' and material 'Skin*'"]
    );
}

#[test]
fn surfaces_without_coordinates_are_told_of_once() {
    let mut scene = ball();
    scene.meshes[0].parts[0].uvs = None;
    scene.nodes.push(scene.nodes[0].clone());
    let style = with_map("shape", "", "");
    assert_eq!(
        reported(scene.clone(), &style, &halves()),
        ["id map 'ids.png' cannot lie on 'Ball', which has no texture coordinates"]
    );
    let parts = &cut(scene, &style, &halves()).meshes[0].parts;
    assert!(parts.len() == 1 && parts[0].ids.is_empty());
}

#[test]
fn ids_that_nothing_shows_are_told_of() {
    let all_red = painted(8, |_, _| RED);
    assert_eq!(
        reported(ball(), &with_map("shape", "", ""), &all_red),
        ["id map 'ids.png' names 'right', but no triangle shows that colour most"]
    );
    let rules = "[[rule]]\nmatch.id = '#00ff00'\n[[rule]]\nmatch.id = '#123456'";
    assert_eq!(
        reported(ball(), &with_map("shape", "", rules), &halves()),
        ["rules name '#00ff00', '#123456', which no triangle shows on an id map"]
    );
    let many: Vec<String> = (0..9)
        .map(|i| format!("{{ name = 'n{i}', color = '#00000{i}' }}"))
        .collect();
    let map = format!("[[id_map]]\nimage = 'ids.png'\nids = [{}]", many.join(", "));
    let style = Style::from_toml(&map, &|_| Err(String::new())).unwrap();
    assert_eq!(
        reported(ball(), &style, &halves()),
        [
            "id map 'ids.png' names 'n0', 'n1', 'n2', 'n3' and 5 more, but no triangle shows that colour most"
        ]
    );
}

#[test]
fn a_color_that_only_one_of_two_maps_has_is_no_slip() {
    let more = "[[id_map]]\nimage = 'other.png'\nobject = 'Other'\n[[rule]]\nmatch.id = '#00ff00'";
    let mut scene = ball();
    let mut other = scene.nodes[0].clone();
    other.name = "Other".to_owned();
    scene.nodes.push(other);
    let mut pictures = halves();
    let green = painted(4, |_, _| [0, 255, 0, 255])
        .remove("ids.png")
        .unwrap();
    pictures.insert("other.png".to_owned(), green);
    assert_eq!(
        reported(scene, &with_map("shape", "", more), &pictures),
        [""; 0]
    );
}

#[test]
fn pictures_that_are_missing_or_broken_are_errors() {
    let style = with_map("shape", "", "");
    let fault = |pictures: &BTreeMap<String, Picture>| {
        apply_id_maps(&mut ball(), &style, pictures)
            .unwrap_err()
            .to_string()
    };
    assert_eq!(
        fault(&BTreeMap::new()),
        "id_map.0.image: the picture 'ids.png' was not given"
    );
    for (size, bytes) in [([0, 0], 0), ([2, 2], 15), ([0, 4], 0), ([u32::MAX; 2], 16)] {
        let picture = Picture {
            size,
            rgba: vec![0; bytes],
        };
        let fault = fault(&BTreeMap::from([("ids.png".to_owned(), picture)]));
        assert_eq!(
            fault,
            "id_map.0.image: the picture has no pixels, or not as many as its size says"
        );
    }
}

#[test]
fn transparent_pixels_are_no_id() {
    let map = painted(64, |x, _| if x < 32 { [255, 0, 0, 0] } else { BLUE });
    let scene = cut(ball(), &with_map("shape", "", ""), &map);
    let names: Vec<usize> = scene.meshes[0]
        .parts
        .iter()
        .map(|part| part.ids.len())
        .collect();
    assert_eq!(names, [2, 0], "a piece of the blue half, and one of none");
}
