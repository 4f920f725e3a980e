//! Which region a triangle takes.

use super::fixture::{BLUE, RED, cut, halves, painted, scene, with_map};
use npr_mesh::testing::{icosphere, plane};
use npr_render::Picture;
use npr_scene::{Node, Part, Scene, TextureTransform, TextureUse, Wrap};
use npr_stylesheet::Style;
use proptest::prelude::*;
use std::collections::BTreeMap;

/// A triangle of a mesh with these coordinates, as each id counts its pieces: red, blue, none.
fn taken(
    uvs: [[f32; 2]; 3],
    wrap: Option<Wrap>,
    picture: &BTreeMap<String, Picture>,
) -> [usize; 3] {
    let mut scene = Scene::default();
    scene.nodes.push(Node {
        mesh: Some(0),
        ..Node::default()
    });
    let texture = wrap.map(|wrap| TextureUse {
        image: 0,
        uv_set: 0,
        wrap: [wrap; 2],
        transform: TextureTransform::default(),
    });
    scene.materials.push(npr_scene::Material {
        base_color_texture: texture,
        ..npr_scene::Material::default()
    });
    scene.meshes.push(npr_scene::Mesh {
        parts: vec![Part {
            positions: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
            uvs: Some(uvs.to_vec()),
            triangles: vec![[0, 1, 2]],
            material: Some(0),
            ..Part::default()
        }],
        ..npr_scene::Mesh::default()
    });
    let scene = cut(scene, &with_map("shape", "", ""), picture);
    count(&scene)
}

/// Triangles of the regions red and blue, and of none.
fn count(scene: &Scene) -> [usize; 3] {
    let mut counts = [0; 3];
    for part in scene.meshes.iter().flat_map(|mesh| &mesh.parts) {
        let region = match part.ids.first().map(String::as_str) {
            Some("left") => 0,
            Some("right") => 1,
            _ => 2,
        };
        counts[region] += part.triangles.len();
    }
    counts
}

/// Shares of red, blue and other texels in a triangle of a map that repeats, at very many places.
fn shares(uvs: [[f32; 2]; 3], picture: &Picture) -> [f64; 3] {
    const STEPS: u32 = 120;
    let mut counts = [0.0; 3];
    let mut all = 0.0;
    for i in 0..STEPS {
        for j in 0..STEPS - i {
            let [s, t] = [i, j].map(|v| (f64::from(v) + 1.0 / 3.0) / f64::from(STEPS));
            let at: [usize; 2] = std::array::from_fn(|axis| {
                let [a, b, c] = uvs.map(|uv| f64::from(uv[axis]));
                let place = a + (b - a) * s + (c - a) * t;
                let side = f64::from(picture.size[axis]);
                ((place.rem_euclid(1.0) * side) as usize).min(picture.size[axis] as usize - 1)
            });
            let texel = (at[1] * picture.size[0] as usize + at[0]) * 4;
            let region = match picture.rgba[texel..texel + 4] {
                [255, 0, 0, 128..=255] => 0,
                [0, 0, 255, 128..=255] => 1,
                _ => 2,
            };
            counts[region] += 1.0;
            all += 1.0;
        }
    }
    counts.map(|count| count / all)
}

#[test]
fn a_triangle_of_three_texels_takes_what_most_of_it_shows() {
    // Nine places would show more red than the 61 % of another colour.
    let uvs = [
        [1.3685776, -0.16949683],
        [1.3024986, -0.56920314],
        [2.0033307, -0.5492653],
    ];
    let others = [(2, 1), (3, 1), (2, 2), (3, 2), (1, 3)];
    let pictures = painted(4, |x, y| match (x, y) {
        (1, 1) => BLUE,
        place if others.contains(&place) => [255, 1, 0, 255],
        _ => RED,
    });
    let shares = shares(uvs, &pictures["ids.png"]);
    assert!(shares[2] > 0.6, "{shares:?}");
    assert_eq!(taken(uvs, None, &pictures), [0, 0, 1]);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]
    #[test]
    fn a_triangle_takes_what_most_of_it_shows(
        uvs in prop::array::uniform3(prop::array::uniform2(-1.5f32..2.5)),
        cells in prop::collection::vec(0u8..4, 16), cell_px in 1u32..9,
    ) {
        // Cells of red, blue, another colour, and red that is hardly there.
        let pictures = painted(4 * cell_px, |x, y| {
            match cells[(y / cell_px * 4 + x / cell_px) as usize] {
                0 => RED,
                1 => BLUE,
                2 => [255, 1, 0, 255],
                _ => [255, 0, 0, 127],
            }
        });
        let shares = shares(uvs, &pictures["ids.png"]);
        let best = (0..3).max_by(|a, b| shares[*a].total_cmp(&shares[*b])).unwrap();
        let second = (0..3).filter(|i| *i != best).map(|i| shares[i]).fold(0.0, f64::max);
        // Up to 64 places decide.
        prop_assume!(shares[best] - second > 0.3);
        let mut wanted = [0; 3];
        wanted[best] = 1;
        prop_assert_eq!(taken(uvs, None, &pictures), wanted, "{:?}", shares);
    }

    /// Whatever coordinates a file has, nothing panics and every triangle is in one piece.
    #[test]
    fn wild_coordinates_are_taken(
        uvs in prop::array::uniform3(prop::array::uniform2(
            prop::num::f32::NORMAL | prop::num::f32::ZERO | prop::num::f32::SUBNORMAL,
        )),
        wrap in prop::sample::select(vec![Wrap::Repeat, Wrap::Mirror, Wrap::Clamp]),
    ) {
        prop_assert_eq!(taken(uvs, Some(wrap), &halves()).iter().sum::<usize>(), 1);
    }
}

#[test]
fn maps_wrap_and_move_as_textures_do() {
    // A small triangle around a place; the map is red up to one half and blue beyond.
    let around = |u: f32| [[u, 0.5], [u + 0.01, 0.5], [u, 0.51]];
    let at = |u: f32, wrap: Wrap| {
        let counts = taken(around(u), Some(wrap), &halves());
        counts.iter().position(|count| *count == 1).unwrap()
    };
    let at_all = |wrap: Wrap| [-0.7, 0.2, 0.7, 1.2, 1.7].map(|u| at(u, wrap));
    assert_eq!(at_all(Wrap::Repeat), [0, 0, 1, 0, 1]);
    assert_eq!(at_all(Wrap::Mirror), [1, 0, 1, 1, 0]);
    assert_eq!(at_all(Wrap::Clamp), [0, 0, 1, 1, 1]);

    let mut scene = scene("Ball", icosphere(3));
    let swapped = TextureTransform {
        offset: [0.5, 0.0],
        ..TextureTransform::default()
    };
    scene.materials[0].base_color_texture = Some(TextureUse {
        image: 0,
        uv_set: 0,
        wrap: [Wrap::Repeat; 2],
        transform: swapped,
    });
    let pieces = cut(scene, &with_map("shape", "", ""), &halves());
    let red = pieces.meshes[0]
        .parts
        .iter()
        .find(|part| part.ids[0] == "left")
        .unwrap();
    let right = red
        .triangles
        .iter()
        .flatten()
        .filter(|v| red.positions[**v as usize][0] > 0.0);
    assert!(
        right.count() * 10 > red.triangles.len() * 3 * 9,
        "moved by half its width"
    );
}

#[test]
fn a_map_of_one_pixel_is_one_id() {
    let scene = cut(
        scene("Ball", icosphere(2)),
        &with_map("shape", "", ""),
        &painted(1, |_, _| BLUE),
    );
    assert_eq!(count(&scene), [0, 320, 0]);
    assert_eq!(scene.meshes[0].parts.len(), 1);
}

#[test]
fn triangles_too_large_for_a_map_go_whole_and_are_told() {
    // Two triangles; the map's border cuts both, the lower left one a little beyond its middle.
    let square =
        npr_mesh::testing::mapped(&plane(1, 1), |[x, y, z]| [x * 2.0 - 1.0, y * 2.0 - 1.0, z]);
    let map = painted(64, |x, _| if x < 28 { RED } else { BLUE });
    let scene = cut(scene("Card", square), &with_map("shape", "", ""), &map);
    let counts = count(&scene);
    assert_eq!((counts[0] + counts[1], counts[2]), (2, 0));
    assert_eq!(counts[0], 1, "one triangle has its bulk on the left");
    let reported: Vec<String> = scene.notices.iter().map(ToString::to_string).collect();
    assert!(
        reported.len() == 1
            && reported[0].starts_with("id map 'ids.png' is finer than the triangles"),
        "{reported:?}"
    );
}

/// Colours without a name, such as the blends along filtered borders, cut nothing.
#[test]
fn a_map_of_noise_makes_no_more_parts_than_ids() {
    let noise = painted(64, |x, y| {
        let bits = npr_core::math::mix_bits(x * 64 + y);
        match bits % 3 {
            0 => RED,
            1 => BLUE,
            _ => [bits as u8, (bits >> 8) as u8, (bits >> 16) as u8, 255],
        }
    });
    let scene = cut(
        scene("Ball", icosphere(4)),
        &with_map("shape", "", ""),
        &noise,
    );
    assert!(scene.meshes[0].parts.len() <= 3);
    assert_eq!(count(&scene).iter().sum::<usize>(), 5120);
    scene.meshes[0].parts.iter().for_each(Part::sanity_check);
}

#[test]
fn objects_that_share_a_mesh_are_cut_each_by_its_own_maps() {
    let mut scene = scene("Hero", icosphere(2));
    for name in ["Extra", "Hero_2"] {
        scene.nodes.push(Node {
            name: name.to_owned(),
            ..scene.nodes[0].clone()
        });
    }
    let style: Style = with_map("shape", "object = 'Hero*'", "");
    let scene = cut(scene, &style, &halves());
    let parts = |node: usize| &scene.meshes[scene.nodes[node].mesh.unwrap() as usize].parts;
    assert_eq!([0, 1, 2].map(|node| parts(node).len()), [2, 1, 2]);
    assert!(parts(1)[0].ids.is_empty());
    assert_eq!(
        (scene.meshes.len(), scene.nodes[0].mesh),
        (2, scene.nodes[2].mesh)
    );
}

#[test]
fn of_several_maps_on_a_part_the_last_counts() {
    let more = "[[id_map]]\nimage = 'other.png'\nids = [{ name = 'all', color = '#0f0' }]";
    let mut pictures = halves();
    pictures.extend(
        painted(2, |_, _| [0, 255, 0, 255])
            .into_values()
            .map(|picture| ("other.png".to_owned(), picture)),
    );
    for (material, wanted) in [("*", vec!["all"]), ("Other", vec!["left", "right"])] {
        let style = with_map("shape", "", &format!("{more}\nmaterial = '{material}'"));
        let scene = cut(scene("Ball", icosphere(2)), &style, &pictures);
        let names = scene.meshes[0]
            .parts
            .iter()
            .map(|part| part.ids[0].as_str());
        assert_eq!(names.collect::<Vec<_>>(), wanted);
    }
}
