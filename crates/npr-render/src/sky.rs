//! The sky over a scene: what hides it, and its picture.

use crate::model::Model;
use crate::options::Picture;
use crate::placement::radius_of;
use crate::textures::STORE_WORDS;
use glam::Vec3;
use npr_core::cutout::Cutout;
use npr_core::geometry::Part;
use npr_core::math;
use npr_core::raster::{Fill, Sides, fill_triangles, triangle_of};
use npr_core::surface::{dot, weights_at};
use npr_core::texture::{TextureStore, linear_texel};
use npr_core::window::Window;
use npr_style::lighting::Lights;
use npr_style::sky::{SKY_HEADER_WORDS, dome_of, sky_height};
use npr_stylesheet::Style;
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Most triangles that all pictures of what hides the sky draw together, unless [`VIEWS`] needs more: scenes of few
/// triangles get more pictures, and smoother shadows.
const TRIANGLES_DRAWN: usize = 10_000_000;

/// Fewest and most pictures, half of them from above. With fewer, the edges of single shadows show.
const VIEWS: [usize; 2] = [128, 256];

/// Texels of a picture along a side.
const SIDE: u32 = 96;

/// The pictures show a little more than the ball around the scene, so that nothing lies on their border.
const ROOM: f32 = 1.03;

/// Turn from one picture to the next, in radians: the golden angle spreads them evenly.
const GOLDEN_ANGLE: f32 = 2.399_963_2;

/// Where the pictures of what hides the sky lie in a texture store.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SkyMaps {
    center: [f32; 3],
    radius: f32,
    start: u32,
    views: u32,
}

impl SkyMaps {
    /// Draws the pictures for a sky that the style lets things hide; none where there is no such sky, nothing to hide
    /// it, or no room in the store. O(pictures * (triangles + texels)), parallel.
    pub fn new(
        model: &Model,
        style: &Style,
        parts: &[Part],
        textures: &mut TextureStore,
    ) -> Option<Self> {
        // Choose how many pictures there are, and make sure that they fit.
        let sky = style.light.hidden_sky()?;
        let per_view = TRIANGLES_DRAWN.checked_div(model.triangles.len())?;
        let views = (per_view.clamp(VIEWS[0], VIEWS[1]) & !1) as u32;
        let words = views as usize * (SIDE * SIDE / 2 + SKY_HEADER_WORDS) as usize;
        if textures.words().len() + words > STORE_WORDS {
            return None;
        }
        // Draw them all in radii of the ball around the scene.
        let (low, high) = model.bounds();
        let center = (Vec3::from(low) + Vec3::from(high)) * 0.5;
        let radius = radius_of((low, high)) * ROOM;
        let points = model.vertices.iter().zip(&model.influences);
        let places: Vec<[f32; 3]> = points
            .map(|(vertex, influence)| {
                ((model.posed_point(vertex, influence) - center) / radius).to_array()
            })
            .collect();
        let drawn: Vec<([Vec3; 3], Vec<u32>)> = (0..views)
            .into_par_iter()
            .map(|i| {
                let axes = axes_of(i, views, Vec3::from(sky.unit_direction()));
                let texels = reach_of(model, parts, textures.words(), &places, axes);
                (axes, texels)
            })
            .collect();
        // Line up the headers, then the texels.
        let headers = drawn.iter().enumerate().flat_map(|(i, (axes, _))| {
            let is_lower = u32::from(i as u32 >= views / 2);
            let row = |axis: Vec3, last: u32| {
                let [x, y, z] = axis.to_array().map(f32::to_bits);
                [x, y, z, last]
            };
            let [right, up, outwards] = *axes;
            [row(right, 0), row(up, 0), row(outwards, is_lower)].concat()
        });
        let words: Vec<u32> = headers
            .chain(drawn.iter().flat_map(|(_, texels)| texels.iter().copied()))
            .collect();
        Some(Self {
            center: center.to_array(),
            radius,
            start: textures.add_words(&words)?,
            views,
        })
    }

    /// Tells the lights of a frame where the pictures lie.
    pub fn apply_to(&self, lights: &mut Lights) {
        lights.sky_center = self.center;
        lights.sky_radius = self.radius;
        (lights.sky_maps, lights.sky_views) = (self.start, self.views);
        lights.sky_side = SIDE;
    }
}

/// The right, up and outward axis of picture `i`. The outward axes spread evenly over the sphere, from `up` downwards,
/// by Fibonacci's lattice.
fn axes_of(i: u32, views: u32, up: Vec3) -> [Vec3; 3] {
    let height = 1.0 - (2 * i + 1) as f32 / views as f32;
    let ring = (1.0 - height * height).max(0.0).sqrt();
    let turn = i as f32 * GOLDEN_ANGLE;
    let (right, ahead) = up.any_orthonormal_pair();
    let outwards =
        up * height + right * (ring * math::cos(turn)) + ahead * (ring * math::sin(turn));
    let outwards = outwards.normalize();
    let (right, up) = outwards.any_orthonormal_pair();
    [right, up, outwards]
}

/// How far the scene reaches outwards at every texel of a picture, two to a word; `places` are its vertices in radii.
fn reach_of(
    model: &Model,
    parts: &[Part],
    texels: &[u32],
    places: &[[f32; 3]],
    axes: [Vec3; 3],
) -> Vec<u32> {
    // Project the scene along the axes, with depths from 0 to 1 across the ball around it.
    let [right, up, outwards] = axes.map(|axis| axis.to_array());
    let clip_of = |v: u32| {
        let place = places[v as usize];
        let depth = (dot(place, outwards) + 1.0) * 0.5;
        [dot(place, right), dot(place, up), depth, 1.0]
    };

    // Draw both sides of its triangles, with their holes.
    let cutout = Cutout {
        posed: &[],
        vertices: &model.vertices,
        triangles: &model.triangles,
        parts,
        texels,
    };
    let is_hole = |triangle: u32, ndc| {
        let corners = model.triangles[triangle as usize].corners;
        cutout.is_hole_at(triangle, weights_at(corners.map(clip_of), ndc))
    };
    let side_px = [SIDE as f32; 2];
    let window = Window::over(side_px, [0.0; 2], side_px, [SIDE; 2]);
    let fill = Fill {
        window: &window,
        triangles: &model.triangles,
        parts,
        sides: Sides::Both,
        id_bits: 0,
        clip_of,
        keep: |id, x, y| !is_hole(triangle_of(id), window.ndc_of(x, y)),
    };
    let count = (SIDE * SIDE) as usize;
    let (mut ids, mut depths) = (vec![0; count], vec![0; count]);
    fill_triangles(&fill, &mut ids, &mut depths);

    // Pack the heights; 0 where nothing is hit.
    let reach = |i: usize| match ids[i] {
        0 => 0,
        _ => sky_height(f32::from_bits(depths[i]) * 2.0 - 1.0).round() as u32,
    };
    (0..count / 2)
        .map(|i| reach(2 * i) | reach(2 * i + 1) << 16)
        .collect()
}

/// The picture of a style's sky, summed up; none where it has none or it was not given.
pub(crate) fn dome(style: &Style, pictures: &BTreeMap<String, Picture>) -> Option<[[f32; 4]; 9]> {
    let picture = pictures.get(style.light.sky_image())?;
    let store = TextureStore::new();
    let linear = |pixel: &[u8; 4]| {
        let [r, g, b, a] = linear_texel(store.words(), u32::from_le_bytes(*pixel));
        [r * a, g * a, b * a]
    };
    let texels: Vec<[f32; 3]> = picture.rgba.as_chunks().0.iter().map(linear).collect();
    Some(dome_of(picture.size, &texels))
}
