//! Parts cut up by the id maps of a style.

use crate::error::RenderError;
use crate::instance::placed_uv;
use crate::options::Picture;
use crate::spots::middles;
use crate::textures::packed_wrap;
use glam::Vec3;
use npr_core::geometry::NONE;
use npr_core::texture::{Wrap, texel_at};
use npr_scene::{Material, Notice, Part, Scene};
use npr_stylesheet::{IdMap, IdRegion, Style};
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};

/// Most rows of small triangles that a triangle is cut into, so that at most 64 places decide its id.
const ROWS_MAX: u32 = 8;

/// Alpha from which a pixel of a map counts.
const OPAQUE: u8 = 128;

/// Share of a surface that may be taken for another id than painted before the user is told.
const STRAYED_MAX: f64 = 0.05;

/// Most names in a notice.
const NAMES_MAX: usize = 4;

/// Which map lies on every part of a mesh.
type Cover = Vec<Option<usize>>;

/// Cuts the parts of a scene up by the id maps of a style, so that its rules find their regions as parts of their own.
///
/// Every triangle goes as a whole to the id that most of it shows: it is cut into 64 equal small ones, or fewer where
/// it lies within a texel, and each counts as the texel its middle lies in. Of ids that show equally, the one that the
/// map names first wins; no id comes last. Maps lie as the base colour texture does, with its transform and wrapping,
/// and repeat where there is none. Parts without texture coordinates have no ids. Nothing moves: where pieces meet,
/// their vertices are equal and welded again, so that creases, contours and normals stay what they were.
///
/// Regions keep their material's number, and no line runs between them; a map with `border` gives each a copy of the
/// material. What looks like a slip is added to the scene's notices. A scene may be cut anew for another style.
///
/// O(64 triangles) at most, on all threads; meshes that several objects share are copied only where other maps lie on
/// them.
///
/// # Errors
///
/// [`RenderError::MissingPicture`] where `pictures` lacks one of [`Style::id_map_pictures`],
/// [`RenderError::EmptyPicture`] for one without pixels.
pub fn apply_id_maps(
    scene: &mut Scene,
    style: &Style,
    pictures: &BTreeMap<String, Picture>,
) -> Result<(), RenderError> {
    // Forget the regions of an earlier style.
    let parts = scene.meshes.iter_mut().flat_map(|mesh| &mut mesh.parts);
    parts.for_each(|part| part.ids.clear());
    let maps = maps_of(style, pictures)?;
    if maps.is_empty() {
        return Ok(());
    }

    // Cut every mesh by the maps that lie on its parts.
    let covered = cover_meshes(scene, &maps);
    let mut knife = Knife {
        tallies: maps.iter().map(Tally::new).collect(),
        maps,
        materials: &mut scene.materials,
        bordered: BTreeMap::new(),
    };
    for (mesh, cover, object) in covered {
        let parts = std::mem::take(&mut scene.meshes[mesh].parts);
        let pieces = parts.into_iter().zip(cover);
        scene.meshes[mesh].parts = pieces
            .flat_map(|(part, map)| knife.cut(part, map, &object))
            .collect();
    }

    // Report what looks like a mistake.
    let notices = knife.notices().into_iter().map(|text| Notice { text });
    scene.notices.extend(notices);
    Ok(())
}

/// An id map with its pixels.
struct Map<'a> {
    of: &'a IdMap,
    picture: &'a Picture,
    regions: Vec<IdRegion>,
    /// The region of each colour that is one.
    numbers: BTreeMap<[u8; 3], u32>,
}

fn maps_of<'a>(
    style: &'a Style,
    pictures: &'a BTreeMap<String, Picture>,
) -> Result<Vec<Map<'a>>, RenderError> {
    let map = |(i, of): (usize, &'a IdMap)| {
        // Find the picture, and check that it has as many pixels as its size says.
        let key = format!("id_map.{i}.image");
        let Some(picture) = pictures.get(&of.image) else {
            let name = of.image.clone();
            return Err(RenderError::MissingPicture { key, name });
        };
        let [width, height] = picture.size.map(|side| side as usize);
        let bytes = width.checked_mul(height).and_then(|n| n.checked_mul(4));
        if picture.rgba.is_empty() || bytes != Some(picture.rgba.len()) {
            return Err(RenderError::EmptyPicture { key });
        }

        // Number the regions by their colours.
        let regions = style.id_regions(of);
        let numbers = (0..).zip(&regions).map(|(i, region)| (region.color, i));
        Ok(Map {
            of,
            picture,
            numbers: numbers.collect(),
            regions,
        })
    };
    style.id_map.iter().enumerate().map(map).collect()
}

/// Lists every mesh that is drawn, with the maps on its parts and the first object that uses it with them. Objects that
/// share a mesh but not the maps get copies of it.
fn cover_meshes(scene: &mut Scene, maps: &[Map<'_>]) -> Vec<(usize, Cover, String)> {
    let mut made: BTreeMap<(u32, Cover), u32> = BTreeMap::new();
    let mut used = BTreeSet::new();
    let mut covered = Vec::new();
    for node in &mut scene.nodes {
        let Some(mesh) = node.mesh else { continue };

        // Find the last map that lies on each part.
        let parts = &scene.meshes[mesh as usize].parts;
        let material = |part: &Part| part.material.and_then(|m| scene.materials.get(m as usize));
        let name = |part| material(part).map_or("", |material| &material.name);
        let cover: Cover = parts
            .iter()
            .map(|part| {
                let mut maps = maps.iter();
                maps.rposition(|map| map.of.lies_on(name(part), &node.name))
            })
            .collect();

        // Keep the mesh for the first maps that lie on it, and copy it for all others.
        let slot = *made.entry((mesh, cover.clone())).or_insert_with(|| {
            let slot = match used.insert(mesh) {
                true => mesh,
                false => {
                    let copy = scene.meshes[mesh as usize].clone();
                    scene.meshes.push(copy);
                    scene.meshes.len() as u32 - 1
                }
            };
            covered.push((slot as usize, cover, node.name.clone()));
            slot
        });
        node.mesh = Some(slot);
    }
    covered
}

/// What is counted of a map while parts are cut, for notices.
struct Tally {
    /// Whether it lies on any part.
    lies: bool,
    /// The first object that it cannot lie on.
    bare: Option<String>,
    /// Which regions any triangle has.
    taken: Vec<bool>,
    /// Area that the map lies on, and how much of it gets another id than painted.
    area: f64,
    strayed: f64,
}

impl Tally {
    fn new(map: &Map<'_>) -> Self {
        Self {
            lies: false,
            bare: None,
            taken: vec![false; map.regions.len()],
            area: 0.0,
            strayed: 0.0,
        }
    }
}

/// Cuts parts into pieces by their maps.
struct Knife<'a> {
    maps: Vec<Map<'a>>,
    tallies: Vec<Tally>,
    materials: &'a mut Vec<Material>,
    /// Copies of materials, by material, map and region.
    bordered: BTreeMap<(Option<u32>, usize, u32), u32>,
}

impl Knife<'_> {
    /// Cuts a part of an object into the pieces that show the regions of its map.
    fn cut(&mut self, part: Part, map: Option<usize>, object: &str) -> Vec<Part> {
        let Some(number) = map.filter(|_| !part.triangles.is_empty()) else {
            return vec![part];
        };

        // Leave parts without texture coordinates whole.
        let (map, tally) = (&self.maps[number], &mut self.tallies[number]);
        tally.lies = true;
        let Some(uvs) = &part.uvs else {
            tally.bare.get_or_insert_with(|| object.to_owned());
            return vec![part];
        };

        // Find the region of every triangle, and count how well it fits.
        let material = part.material.and_then(|m| self.materials.get(m as usize));
        let shown: Vec<(u32, f32)> = map.shown_by(&part.triangles, uvs, material);
        for (corners, (region, strayed)) in part.triangles.iter().zip(&shown) {
            let area = area_of(&part, *corners);
            tally.area += area;
            tally.strayed += area * f64::from(*strayed);
            if let Some(taken) = tally.taken.get_mut(*region as usize) {
                *taken = true;
            }
        }

        // Split the part, and label the pieces.
        let regions: Vec<u32> = shown.iter().map(|(region, _)| *region).collect();
        let pieces = part.split(&regions).into_iter();
        pieces
            .map(|(region, part)| self.labelled(part, number, region))
            .collect()
    }

    /// A piece with the names of its region, and a material of its own where the map wants a border.
    fn labelled(&mut self, part: Part, map: usize, region: u32) -> Part {
        let of = &self.maps[map];
        let Some(found) = of.regions.get(region as usize) else {
            return part;
        };

        // Give the piece a copy of its material, which pieces of the same region share.
        let mut material = part.material;
        if of.of.border {
            let materials = &mut self.materials;
            let key = (material, map, region);
            material = Some(*self.bordered.entry(key).or_insert_with(|| {
                let own = material.and_then(|m| materials.get(m as usize)).cloned();
                materials.push(own.unwrap_or_default());
                materials.len() as u32 - 1
            }));
        }
        Part {
            material,
            ids: found.names.clone(),
            ..part
        }
    }

    /// Notices of what looks like a mistake.
    fn notices(&self) -> Vec<String> {
        let tallied = || self.maps.iter().zip(&self.tallies);
        let mut notices: Vec<String> = tallied()
            .flat_map(|(map, tally)| map.notices(tally))
            .collect();
        // Colours that rules name may be on any map.
        let mut missing: BTreeSet<&str> = BTreeSet::new();
        for (map, tally) in tallied().filter(|(_, tally)| tally.area > 0.0) {
            let unnamed = map.regions.iter().zip(&tally.taken).skip(map.of.ids.len());
            missing.extend(unnamed.map(|(region, _)| region.names[0].as_str()));
        }
        for (map, tally) in tallied() {
            let taken = map
                .regions
                .iter()
                .zip(&tally.taken)
                .filter(|(_, taken)| **taken);
            for (region, _) in taken {
                missing.remove(region.names.last().map_or("", String::as_str));
            }
        }
        if !missing.is_empty() {
            let names = listed(missing.into_iter());
            notices.push(format!(
                "rules name {names}, which no triangle shows on an id map"
            ));
        }
        notices
    }
}

impl Map<'_> {
    /// The region of every triangle, [`NONE`] for none, and the share of it that shows another.
    fn shown_by(
        &self,
        triangles: &[[u32; 3]],
        uvs: &[[f32; 2]],
        material: Option<&Material>,
    ) -> Vec<(u32, f32)> {
        let texture = material.and_then(|material| material.base_color_texture.as_ref());
        let wrap = texture.map_or([Wrap::Repeat; 2], |texture| texture.wrap.map(packed_wrap));
        let triangles = triangles.par_iter().with_min_len(256);
        triangles
            .map(|corners| {
                let placed = corners.map(|corner| placed_uv(uvs[corner as usize], material));
                self.region_of(placed, wrap)
            })
            .collect()
    }

    /// The region that most of a triangle shows, and the share of it that shows another.
    fn region_of(&self, uvs: [[f32; 2]; 3], wrap: [Wrap; 2]) -> (u32, f32) {
        let mut counts: Vec<(u32, u32)> = Vec::with_capacity(4);
        let rows = rows_of(uvs, self.picture.size);
        for uv in middles(uvs, rows) {
            let region = self.region_at(texel_at(uv, self.picture.size, wrap));
            match counts.iter_mut().find(|(other, _)| *other == region) {
                Some((_, count)) => *count += 1,
                None => counts.push((region, 1)),
            }
        }
        let most = counts
            .iter()
            .max_by_key(|(region, count)| (*count, !region));
        let (region, count) = most.copied().unwrap_or((NONE, 0));
        (region, 1.0 - count as f32 / (rows * rows) as f32)
    }

    fn region_at(&self, [x, y]: [u32; 2]) -> u32 {
        let at = (y as usize * self.picture.size[0] as usize + x as usize) * 4;
        let [r, g, b, a] = std::array::from_fn(|i| self.picture.rgba[at + i]);
        match self.numbers.get(&[r, g, b]) {
            Some(number) if a >= OPAQUE => *number,
            _ => NONE,
        }
    }

    fn notices(&self, tally: &Tally) -> Vec<String> {
        let IdMap {
            image,
            object,
            material,
            ids,
            ..
        } = self.of;
        let mut notices = Vec::new();
        let mut tell = |text: String| notices.push(format!("id map '{image}' {text}"));

        // Report a map that lies on nothing, or cannot.
        if !tally.lies {
            tell(format!(
                "lies on nothing: no part is of object '{object}' and material '{material}'"
            ));
        }
        if let Some(bare) = &tally.bare {
            tell(format!(
                "cannot lie on '{bare}', which has no texture coordinates"
            ));
        }

        // Report ids that no triangle shows.
        let untaken = ids.iter().zip(&tally.taken).filter(|(_, taken)| !**taken);
        let untaken: BTreeSet<&str> = untaken.map(|(id, _)| id.name.as_str()).collect();
        if tally.area > 0.0 && !untaken.is_empty() {
            let names = listed(untaken.into_iter());
            tell(format!(
                "names {names}, but no triangle shows that colour most"
            ));
        }

        // Report a map that is finer than the triangles.
        if tally.strayed > STRAYED_MAX * tally.area {
            let percent = (tally.strayed / tally.area * 100.0).round();
            tell(format!(
                "is finer than the triangles: ids end at their edges, so that {percent} % of the surface has \
                 another than painted"
            ));
        }
        notices
    }
}

/// Names in quotes, the first few of many.
fn listed<'a>(names: impl ExactSizeIterator<Item = &'a str>) -> String {
    let more = names.len().saturating_sub(NAMES_MAX);
    let shown: Vec<String> = names
        .take(NAMES_MAX)
        .map(|name| format!("'{name}'"))
        .collect();
    match more {
        0 => shown.join(", "),
        _ => format!("{} and {more} more", shown.join(", ")),
    }
}

/// Area of a triangle in the mesh's own space.
fn area_of(part: &Part, corners: [u32; 3]) -> f64 {
    let [a, b, c] = corners.map(|corner| Vec3::from(part.positions[corner as usize]).as_dvec3());
    let area = (b - a).cross(c - a).length() * 0.5;
    if area.is_finite() { area } else { 0.0 }
}

/// Into how many rows of small triangles, about an eighth of a texel wide, to cut a triangle. Fewer would miss what
/// lies within a texel's width of an edge, which is much of a triangle that is two or three texels large.
fn rows_of([a, b, c]: [[f32; 2]; 3], size: [u32; 2]) -> u32 {
    let texels = |from: [f32; 2], to: [f32; 2]| {
        let [u, v] = [0, 1].map(|i| (to[i] - from[i]) * size[i] as f32);
        u.abs().max(v.abs())
    };
    let longest = texels(a, b).max(texels(b, c)).max(texels(c, a));
    ((longest * ROWS_MAX as f32).ceil() as u32).clamp(1, ROWS_MAX)
}
