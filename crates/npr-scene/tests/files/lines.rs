//! Lines that files have as geometry.

use npr_scene::testing::{lines_glb, skinned_glb, skinned_lines_glb};
use npr_scene::{Limits, MemoryResources, Scene, SceneError, load_bytes};
use proptest::prelude::*;

fn load_within(bytes: &[u8], limits: &Limits) -> Result<Scene, SceneError> {
    let scene = load_bytes("test", bytes, None, &MemoryResources::default(), limits)?;
    scene.sanity_check();
    Ok(scene)
}

fn load(bytes: &[u8]) -> Result<Scene, SceneError> {
    load_within(bytes, &Limits::default())
}

/// Both ends of every segment of every part, in the world, in order.
fn ends_of(scene: &Scene) -> Vec<[[f32; 3]; 2]> {
    let mut found = Vec::new();
    for (node, part) in scene.drawn_parts() {
        let world = scene.positions_world(node, part);
        let ends = |ends: &[u32; 2]| ends.map(|end| world[end as usize]);
        found.extend(part.segments.iter().map(ends));
    }
    found
}

fn place(number: u32) -> [f32; 3] {
    [number as f32, (number * number % 7) as f32, 0.5]
}

fn places(count: u32) -> Vec<[f32; 3]> {
    (0..count).map(place).collect()
}

/// The segments that a walk along the vertices of a primitive meets.
fn walked(mode: u32, vertices: &[u32]) -> Vec<[[f32; 3]; 2]> {
    let mut found = Vec::new();
    let mut at = 0;
    while at + 1 < vertices.len() {
        found.push([vertices[at], vertices[at + 1]].map(place));
        at += if mode == 1 { 2 } else { 1 };
    }
    if mode == 2 && vertices.len() > 2 {
        found.push([vertices[vertices.len() - 1], vertices[0]].map(place));
    }
    found
}

proptest! {
    #[test]
    fn every_mode_gives_the_segments_of_a_plain_walk(
        lists in prop::collection::vec((1u32..4, prop::collection::vec(0u32..9, 0..12)), 0..4),
        with_triangle: bool,
    ) {
        let lines: Vec<(u32, &[u32])> = lists.iter().map(|(mode, list)| (*mode, list.as_slice())).collect();
        let triangles: &[[u32; 3]] = if with_triangle { &[[0, 1, 2]] } else { &[] };
        let scene = load(&lines_glb(&places(9), triangles, &lines)).expect("a sound file");
        let wanted: Vec<_> = lists.iter().flat_map(|(mode, list)| walked(*mode, list)).collect();
        prop_assert_eq!(scene.segment_count(), wanted.len());
        prop_assert_eq!(ends_of(&scene), wanted);
        prop_assert_eq!(scene.triangle_count(), usize::from(with_triangle));
        let is_odd = lists.iter().any(|(mode, list)| match mode {
            1 => list.len() % 2 == 1,
            _ => list.len() == 1,
        });
        let reported = scene.notices.iter().any(|notice| notice.text.contains("one end"));
        prop_assert_eq!(reported, is_odd);
    }

    #[test]
    fn polylines_of_obj_files_are_those_of_the_text(
        lists in prop::collection::vec(prop::collection::vec(0u32..9, 2..8), 1..5),
        backwards: bool,
    ) {
        let mut text: String = places(9).iter().map(|[x, y, z]| format!("v {x} {y} {z}\n")).collect();
        for list in &lists {
            let name = |v: &u32| if backwards { format!(" -{}", 9 - v) } else { format!(" {}", v + 1) };
            text += &format!("l{}\n", list.iter().map(name).collect::<String>());
        }
        let scene = load(text.as_bytes()).expect("a sound file");
        let wanted: Vec<_> = lists.iter().flat_map(|list| walked(3, list)).collect();
        prop_assert_eq!(ends_of(&scene), wanted);
    }
}

#[test]
fn lines_follow_their_skin_and_their_morphs_as_triangles_do() {
    let posed = |bytes: &[u8]| {
        let scene = load(bytes).expect("a sound file");
        let (node, part) = scene.drawn_parts().next().expect("a part");
        scene.positions_world(node, part)
    };
    let scene = load(&skinned_lines_glb()).expect("a sound file");
    let [a, b, c] = posed(&skinned_glb())[..] else {
        panic!("three corners");
    };
    assert_eq!(ends_of(&scene), [[a, b], [b, c]]);
    assert_ne!(a[2], 0.0, "the morph moves it");
}

#[test]
fn groups_materials_faces_and_lines_of_obj_files_stay_apart() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nvt 0 0\no card\nusemtl paper\nf 1//1 2//1 3//1\n\
        usemtl ink\nl 1/1 2/1 3/1\no string\nl 3 1\n";
    let scene = load(text.as_bytes()).expect("a sound file");
    let counts: Vec<Vec<[usize; 2]>> = scene
        .meshes
        .iter()
        .map(|mesh| {
            let counts = |part: &npr_scene::Part| [part.triangles.len(), part.segments.len()];
            mesh.parts.iter().map(counts).collect()
        })
        .collect();
    assert_eq!(counts, [vec![[1, 0], [0, 2]], vec![[0, 1]]]);
    let card = &scene.meshes[0].parts;
    let name = |part: &npr_scene::Part| {
        scene.materials[part.material.unwrap() as usize]
            .name
            .clone()
    };
    assert_eq!([name(&card[0]), name(&card[1])], ["paper", "ink"]);
    assert!(card[0].normals.is_some() && card[1].normals.is_none());
}

#[test]
fn edges_of_ply_files_are_lines() {
    let text = |edges: &str| {
        let count = edges.lines().count();
        format!(
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
             element edge {count}\nproperty int vertex1\nproperty int vertex2\nproperty uchar red\nend_header\n\
             0 0 0\n1 0 0\n0 1 0\n{edges}"
        )
    };
    let scene = load(text("0 1 255\n1 2 255\n").as_bytes()).expect("a sound file");
    let [a, b, c] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    assert_eq!(ends_of(&scene), [[a, b], [b, c]]);
    for end in ["3", "-1"] {
        let fault =
            load(text(&format!("0 1 0\n2 {end} 0\n")).as_bytes()).expect_err("no such vertex");
        let wanted = format!("edge 1 uses vertex {end}, but the file has only 3");
        assert_eq!(fault.to_string(), wanted);
    }
}

#[test]
fn faults_of_lines_name_their_place() {
    let fault = |bytes: &[u8]| load(bytes).expect_err("a broken file").to_string();
    assert_eq!(
        fault(&lines_glb(
            &places(3),
            &[],
            &[(1, &[0, 1]), (3, &[0, 1, 2, u32::MAX])]
        )),
        "mesh 0, part 1: line segment 2 uses vertex 4294967295, but the part has only 3"
    );
    for (line, wanted) in [
        (
            "l 1 3",
            "line 3: polyline 1 uses vertex 3, but only 2 are defined so far, counted from 1",
        ),
        ("l 1", "line 3: polyline 1 has only 1 corners"),
        (
            "l 1 x",
            "line 3: polyline 1 has the corner 'x', which is no index",
        ),
        (
            "l 0 1",
            "line 3: polyline 1 uses vertex 0, but only 2 are defined so far, counted from 1",
        ),
    ] {
        assert_eq!(
            fault(format!("v 0 0 0\nv 1 0 0\n{line}\n").as_bytes()),
            wanted
        );
    }
    let nowhere = [[f32::NAN; 3], [f32::INFINITY, 0.0, 0.0]];
    assert_eq!(
        fault(&lines_glb(&nowhere, &[], &[(1, &[0, 1])])),
        "all 1 line segments use positions that are not finite or out of range"
    );
    let scene = load(&lines_glb(
        &[[f32::NAN; 3], [0.0; 3], [1.0; 3]],
        &[],
        &[(3, &[0, 1, 2])],
    ));
    let scene = scene.expect("a sound file");
    assert_eq!(scene.segment_count(), 1);
    assert!(
        scene.notices[0].text.contains("1 line segments"),
        "{:?}",
        scene.notices
    );
}

#[test]
fn memory_for_lines_is_asked_for_before_it_is_taken() {
    let ends: Vec<u32> = (0..200_000).map(|i| i % 9).collect();
    let file = lines_glb(&places(9), &[], &[(3, &ends)]);
    let limits = |memory_bytes| Limits {
        memory_bytes,
        ..Limits::default()
    };
    let fault = load_within(&file, &limits(1 << 20)).expect_err("no room");
    assert!(
        fault.is_limit() && fault.to_string().contains("--memory-limit"),
        "{fault}"
    );
    let scene = load_within(&file, &limits(64 << 20)).expect("room enough");
    assert_eq!(scene.segment_count(), 199_999);
}
