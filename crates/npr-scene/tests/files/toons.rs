//! Toon materials of both versions of VRM: their values, defaults, images, and what is said of broken ones.

use crate::models::{loaded, models};
use npr_scene::testing::{glb, picture};
use npr_scene::{
    AlphaMode, Format, Limits, MemoryResources, OutlineWidth, Scene, Toon, load_bytes,
};

/// A triangle with coordinates in one material, `Skin`, of which `material` and `more` of the file say all.
fn file(material: &str, more: &str) -> Vec<u8> {
    let places = [[0f32, 0., 0.], [1., 0., 0.], [0., 1., 0.]];
    let uvs = [[0f32, 0.], [1., 0.], [0., 1.]];
    let numbers = places.as_flattened().iter().chain(uvs.as_flattened());
    let mut bin: Vec<u8> = numbers.flat_map(|number| number.to_le_bytes()).collect();
    let png = picture([2, 1], &[[255, 0, 128, 255], [0, 255, 64, 255]]);
    let length = png.len();
    bin.extend(png);
    let json = format!(
        r#"{{"asset":{{"version":"2.0"}},"scenes":[{{"nodes":[0]}}],"nodes":[{{"name":"face","mesh":0}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"TEXCOORD_0":1}},"material":0}}]}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}},
        {{"bufferView":1,"componentType":5126,"count":3,"type":"VEC2"}}],
        "bufferViews":[{{"buffer":0,"byteLength":36}},{{"buffer":0,"byteOffset":36,"byteLength":24}},
        {{"buffer":0,"byteOffset":60,"byteLength":{length}}}],
        "buffers":[{{"byteLength":{}}}],"images":[{{"bufferView":2,"mimeType":"image/png"}}],
        "textures":[{{"source":0}}],"materials":[{{"name":"Skin"{material}}}]{more}}}"#,
        bin.len(),
    );
    glb(&json, &bin)
}

fn load(file: &[u8]) -> Scene {
    let resources = MemoryResources::default();
    let limits = Limits::default();
    let scene = load_bytes("test", file, Some(Format::Glb), &resources, &limits);
    let scene = scene.expect("a file that can be drawn");
    scene.sanity_check();
    scene
}

fn toon_of(scene: &Scene) -> &Toon {
    scene.materials[0].toon.as_ref().expect("a toon material")
}

fn told(scene: &Scene) -> Vec<&str> {
    let notices = scene.notices.iter().map(|notice| notice.text.as_str());
    let of_avatars = ["look-at and springs", "the avatar lacks bones"];
    notices
        .filter(|text| !of_avatars.iter().any(|start| text.starts_with(start)))
        .collect()
}

fn of_1(said: &str) -> Vec<u8> {
    file(
        &format!(
            r#","extensions":{{"VRMC_materials_mtoon":{{"specVersion":"1.0"{said}}},"KHR_materials_unlit":{{}}}}"#
        ),
        r#","extensionsUsed":["VRMC_materials_mtoon","KHR_materials_unlit"]"#,
    )
}

fn of_0(said: &str) -> Vec<u8> {
    file(
        "",
        &format!(
            r#","extensionsUsed":["VRM"],"extensions":{{"VRM":{{"humanoid":{{"humanBones":[]}},
            "materialProperties":[{{"name":"Skin","shader":"VRM/MToon"{said}}}]}}}}"#
        ),
    )
}

#[test]
fn a_toon_that_states_nothing_has_the_values_of_its_version() {
    let one = load(&of_1(""));
    assert_eq!(toon_of(&one), &Toon::default());
    assert!(told(&one).is_empty(), "{:?}", told(&one));

    // VRM 0.x: hardness 0.9 and shift 0 become 0.95 and -0.05.
    let zero = load(&of_0(""));
    let toon = toon_of(&zero);
    assert_eq!(
        (toon.shading_toony, toon.rim_power, toon.outline.width),
        (0.95, 1.0, None)
    );
    assert!((toon.shading_shift + 0.05).abs() < 1e-6);
    assert!((toon.shade_color[0] - 0.935_2).abs() < 1e-3, "{toon:?}");
}

#[test]
fn values_of_version_1_are_taken_as_they_are() {
    let scene = load(&of_1(
        r#","shadeColorFactor":[0.1,0.2,0.3],"shadeMultiplyTexture":{"index":0,"extensions":
        {"KHR_texture_transform":{"offset":[0.25,0.5],"scale":[2,3]}}},"shadingShiftFactor":-0.2,
        "shadingShiftTexture":{"index":0,"scale":0.4},"shadingToonyFactor":0.7,"giEqualizationFactor":0.6,
        "matcapFactor":[0.5,0.6,0.7],"matcapTexture":{"index":0},"parametricRimColorFactor":[0.3,0.2,0.1],
        "parametricRimFresnelPowerFactor":3,"parametricRimLiftFactor":0.1,"rimLightingMixFactor":0.25,
        "rimMultiplyTexture":{"index":0},"outlineWidthMode":"worldCoordinates","outlineWidthFactor":0.01,
        "outlineWidthMultiplyTexture":{"index":0},"outlineColorFactor":[0.4,0,0],"outlineLightingMixFactor":0.5,
        "renderQueueOffsetNumber":3,"transparentWithZWrite":true,"uvAnimationMaskTexture":{"index":0},
        "uvAnimationScrollXSpeedFactor":0.5,"uvAnimationScrollYSpeedFactor":-0.5,
        "uvAnimationRotationSpeedFactor":2"#,
    ));
    let toon = toon_of(&scene);
    assert_eq!(toon.shade_color, [0.1, 0.2, 0.3]);
    let shade = toon.shade_texture.as_ref().expect("an image");
    assert_eq!(
        (shade.transform.offset, shade.transform.scale),
        ([0.25, 0.5], [2.0, 3.0])
    );
    assert_eq!((toon.shading_shift, toon.shading_shift_scale), (-0.2, 0.4));
    assert_eq!((toon.shading_toony, toon.gi_equalization), (0.7, 0.6));
    assert_eq!(
        (toon.matcap_color, toon.rim_color),
        ([0.5, 0.6, 0.7], [0.3, 0.2, 0.1])
    );
    assert_eq!(
        (toon.rim_power, toon.rim_lift, toon.rim_lighting_mix),
        (3.0, 0.1, 0.25)
    );
    let outline = &toon.outline;
    assert_eq!(outline.width, Some(OutlineWidth::World(0.01)));
    assert_eq!(
        (outline.color, outline.lighting_mix),
        ([0.4, 0.0, 0.0], 0.5)
    );
    assert_eq!(
        (toon.render_queue_offset, toon.blends_with_depth),
        (3, true)
    );
    assert_eq!((toon.flow.scroll, toon.flow.rotation), ([0.5, -0.5], 2.0));
    assert_eq!((toon.textures().count(), scene.images.len()), (6, 1));
    assert!(scene.materials[0].unlit, "the material without hints");
    assert!(told(&scene).is_empty(), "{:?}", told(&scene));
}

#[test]
fn values_of_version_0_are_converted() {
    let scene = load(&of_0(
        r#","floatProperties":{"_ShadeShift":-0.5,"_ShadeToony":0.8,"_OutlineWidthMode":2,"_OutlineWidth":0.5,
        "_OutlineColorMode":1,"_OutlineLightingMix":0.9,"_CullMode":0,"_Cutoff":0.3,"_UvAnimScrollY":0.25,
        "_IndirectLightIntensity":0.25},"keywordMap":{"_ALPHATEST_ON":true},
        "vectorProperties":{"_Color":[0.5,0.5,0.5,0.8],"_ShadeColor":[0.5,1,0,1],"_EmissionColor":[0.5,0,0,1],
        "_MainTex":[0.1,0.2,0.5,0.25]},"textureProperties":{"_MainTex":0,"_ShadeTexture":0,"_SphereAdd":0}"#,
    ));
    let (material, toon) = (&scene.materials[0], toon_of(&scene));
    // Hardness 0.8 moved a quarter of the way to 1, and a shift of 0.5 less what was cut off.
    assert!((toon.shading_toony - 0.85).abs() < 1e-6, "{toon:?}");
    assert!((toon.shading_shift - 0.35).abs() < 1e-6, "{toon:?}");
    let half = npr_core::math::powf(0.5, 2.2);
    assert!((toon.shade_color[0] - half).abs() < 1e-6 && toon.shade_color[2] == 0.0);
    assert!((toon.emissive[0] - half).abs() < 1e-6);
    assert!((material.base_color[0] - half).abs() < 1e-6 && material.base_color[3] == 0.8);
    // A hundredth of half of the height, as the file of version 1.0 says it of the whole height.
    assert_eq!(toon.outline.width, Some(OutlineWidth::Screen(0.0025)));
    assert_eq!(toon.outline.lighting_mix, 0.9);
    assert_eq!(
        (toon.alpha, toon.double_sided),
        (AlphaMode::Mask(0.3), true)
    );
    assert_eq!(toon.flow.scroll, [0.0, -0.25]);
    assert_eq!(toon.gi_equalization, 0.75);
    // Offsets count from below there and from above here.
    let shade = toon.shade_texture.as_ref().expect("an image");
    assert_eq!(Some(shade), material.base_color_texture.as_ref());
    assert_eq!(shade.transform.scale, [0.5, 0.25]);
    assert!((shade.transform.offset[1] - 0.55).abs() < 1e-6);
    assert!(toon.matcap_texture.is_some());
    assert!(told(&scene).is_empty(), "{:?}", told(&scene));
}

#[test]
fn broken_images_and_strange_values_are_left_out_and_told() {
    for (said, notice) in [
        (
            r#""index":7"#,
            "an image of a toon material is left out: material 0 uses texture 7, but the file has only 1",
        ),
        (
            r#""index":"x""#,
            "an image of a toon material is not described as glTF asks, and left out",
        ),
        (
            r#""index":0,"texCoord":1"#,
            "images of toon materials by other coordinates than the base colour are left out",
        ),
    ] {
        let said = format!(r#","shadeMultiplyTexture":{{{said}}}"#);
        let scene = load(&of_1(&said));
        assert_eq!(toon_of(&scene).shade_texture, None);
        assert_eq!(told(&scene), [notice]);
    }

    // What is not drawn is told.
    let scene = load(&of_0(
        r#","keywordMap":{"_ALPHABLEND_ON":true},"textureProperties":{"_BumpMap":0}"#,
    ));
    let not_drawn = [
        "normal textures of toon materials are not drawn",
        "toon materials that blend are cut out",
    ];
    assert_eq!(told(&scene), not_drawn);

    // Numbers are held within what can be computed with.
    let scene = load(&of_1(
        r#","shadingToonyFactor":7,"shadingShiftFactor":1e300,"shadeColorFactor":[-1,1e300,0],
        "parametricRimFresnelPowerFactor":-4,"outlineWidthMode":"screenCoordinates","outlineWidthFactor":-1,
        "renderQueueOffsetNumber":99"#,
    ));
    let toon = toon_of(&scene);
    assert_eq!((toon.shading_toony, toon.shading_shift), (1.0, 1e4));
    assert!(toon.rim_power > 0.0 && toon.outline.width.is_none());
    assert_eq!((toon.shade_color, toon.render_queue_offset), ([0.0; 3], 9));

    // A version that is not known is no toon, nor is another shader.
    let later = file(
        r#","extensions":{"VRMC_materials_mtoon":{"specVersion":"2.0"}}"#,
        "",
    );
    let scene = load(&later);
    assert!(scene.materials[0].toon.is_none());
    assert_eq!(
        told(&scene),
        ["toon materials of version '2.0' are not known, and drawn without"]
    );
}

/// The two files are of one figure, of both versions.
#[test]
fn both_godettes_are_the_same_toons() {
    let Some(folder) = models() else { return };
    let [zero, one] =
        ["godette_vrm0.vrm", "godette_vrm1.vrm"].map(|name| loaded(&folder, name).materials);
    let near = |a: f32, b: f32| (a - b).abs() < 0.01;
    let mut toons = 0;
    for (zero, one) in zero.iter().zip(&one) {
        let (Some(a), Some(b)) = (&zero.toon, &one.toon) else {
            assert_eq!((&zero.toon, &one.toon), (&None, &None), "{}", zero.name);
            continue;
        };
        toons += 1;
        let colors = [
            (a.shade_color, b.shade_color),
            (a.rim_color, b.rim_color),
            (a.outline.color, b.outline.color),
        ];
        for (a, b) in colors {
            assert!((0..3).all(|i| near(a[i], b[i])), "{a:?} and {b:?}");
        }
        assert!(near(a.shading_shift, b.shading_shift) && near(a.shading_toony, b.shading_toony));
        assert_eq!(a.rim_power, b.rim_power);
        let (Some(OutlineWidth::Screen(a)), Some(OutlineWidth::Screen(b))) =
            (a.outline.width, b.outline.width)
        else {
            panic!("outlines of the screen");
        };
        assert!((a - b).abs() < 1e-6, "{a} and {b}");
    }
    assert_eq!(toons, 2);
}
