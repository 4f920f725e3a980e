//! Prints an inventory in words. Characters of names that could upset a terminal are escaped.

use super::{
    Bone, Bounds, Clip, Drawn, Expression, Image, Inventory, Material, Named, Overrides, Skin,
};
use crate::message::{name, plain};
use std::fmt::Write;

/// Most entries of one kind that the text lists; JSON has them all.
const LISTED: usize = 20;

impl Inventory {
    /// The inventory as lines for people.
    pub fn text(&self) -> String {
        // Tell what is drawn, and in which materials.
        let mut text = self.summary();
        list(&mut text, "surface", self.drawn.iter().map(Drawn::text));
        list(
            &mut text,
            "material",
            self.materials.iter().map(Material::text),
        );
        list(&mut text, "image", self.images.iter().map(Image::text));

        // Tell what else the file has, then what is ignored.
        list(&mut text, "camera", self.cameras.iter().map(Named::text));
        list(&mut text, "light", self.lights.iter().map(Named::text));
        list(&mut text, "skin", self.skins.iter().map(Skin::text));
        let clips = self.clips.iter().enumerate();
        list(
            &mut text,
            "clip",
            clips.map(|(index, clip)| clip.text(index)),
        );
        list(&mut text, "bone", self.bones.iter().map(Bone::text));
        let faces = self.expressions.iter().map(Expression::text);
        list(&mut text, "expression", faces);
        let moved = self.moved_expressions.iter();
        list(
            &mut text,
            "expression",
            moved.map(|moved| format!("'{}' moves with the clips", name(moved))),
        );
        list(
            &mut text,
            "extension",
            self.extensions.iter().map(|extension| name(extension)),
        );
        list(
            &mut text,
            "note:",
            self.ignored.iter().map(|notice| plain(notice)),
        );
        text
    }

    /// Format, counts and bounds.
    fn summary(&self) -> String {
        // Tell what wrote the file.
        let mut text = format!(
            "{}: {}, {} bytes\n",
            plain(&self.file),
            self.format,
            self.bytes
        );
        list(
            &mut text,
            "generator",
            self.generator.iter().map(|generator| name(generator)),
        );

        // Tell what it holds and how large that is.
        let (nodes, meshes) = (self.node_count, self.mesh_count);
        let geometry = counted(self.triangle_count, self.line_segment_count);
        let vertices = self.vertex_count;
        let _ = writeln!(
            text,
            "contains {nodes} nodes, {meshes} meshes, {geometry}, {vertices} vertices"
        );
        if let Some(Bounds { min, max }) = &self.bounds {
            let decimals = decimals_for(*min, *max);
            let _ = writeln!(
                text,
                "bounds {} to {}",
                point(*min, decimals),
                point(*max, decimals)
            );
        }

        // Tell how much of it is drawn.
        let drawn = counted(self.drawn_triangle_count, self.drawn_line_segment_count);
        let _ = writeln!(text, "draws {drawn}");
        text
    }
}

/// The numbers of triangles and line segments in words. A number of 0 is left out; where both are 0, the text is
/// `0 triangles`.
fn counted(triangles: usize, segments: usize) -> String {
    match (triangles, segments) {
        (_, 0) => format!("{triangles} triangles"),
        (0, _) => format!("{segments} line segments"),
        _ => format!("{triangles} triangles, {segments} line segments"),
    }
}

/// Appends a line for each of the first `LISTED` entries, and one with the number of the others.
pub(super) fn list(text: &mut String, what: &str, entries: impl IntoIterator<Item = String>) {
    let mut entries = entries.into_iter();
    for entry in entries.by_ref().take(LISTED) {
        let _ = writeln!(text, "  {what} {entry}");
    }
    let more = entries.count();
    if more > 0 {
        let _ = writeln!(text, "  {what} and {more} more");
    }
}

impl Drawn {
    fn text(&self) -> String {
        let material = self
            .material
            .as_deref()
            .map(|material| format!(" in '{}'", name(material)));
        let (object, material) = (name(&self.object), material.unwrap_or_default());
        let geometry = counted(self.triangle_count, self.line_segment_count);
        format!("'{object}'{material}, {geometry}")
    }
}

impl Material {
    fn text(&self) -> String {
        let [r, g, b, a] = self.base_color;
        let mut text = format!("'{}' colour {r:.3},{g:.3},{b:.3},{a:.3}", name(&self.name));
        if let Some(image) = self.image {
            let _ = write!(text, ", image {image}");
        }
        let marks = [
            (self.alpha != "opaque", self.alpha),
            (self.double_sided, "double-sided"),
            (self.unlit, "unlit"),
        ];
        for (_, mark) in marks.iter().filter(|(holds, _)| *holds) {
            let _ = write!(text, ", {mark}");
        }
        if let Some(toon) = &self.toon {
            let _ = write!(text, ", {}", toon.text());
        }
        text
    }
}

impl Image {
    fn text(&self) -> String {
        format!("'{}' {}x{}", name(&self.name), self.width, self.height)
    }
}

impl Named {
    fn text(&self) -> String {
        format!("'{}' {}", name(&self.name), self.kind)
    }
}

impl Clip {
    fn text(&self, index: usize) -> String {
        let (name, seconds) = (name(&self.name), self.duration_s);
        let channels = self.channel_count;
        format!("{index} '{name}' {seconds:.2} s, {channels} channels")
    }
}

/// A number of things in words; none where there are none.
fn counted_as(count: usize, what: &str) -> Option<String> {
    match count {
        0 => None,
        1 => Some(format!("1 {what}")),
        _ => Some(format!("{count} {what}s")),
    }
}

impl Bone {
    fn text(&self) -> String {
        format!("{} '{}'", self.name, name(&self.node))
    }
}

impl Expression {
    fn text(&self) -> String {
        // Tell its name, and the file's where that is another.
        let mut text = format!("'{}'", name(&self.name));
        if self.file_name != self.name {
            let _ = write!(text, " (in the file '{}')", name(&self.file_name));
        }

        // Tell what it binds.
        let counts = [
            counted_as(self.morphs.len(), "morph"),
            counted_as(self.colors.len(), "colour"),
            counted_as(self.textures.len(), "texture"),
        ];
        let counts: Vec<String> = counts.into_iter().flatten().collect();
        match counts.is_empty() {
            true => text.push_str(" binds nothing"),
            false => {
                let _ = write!(text, " binds {}", counts.join(", "));
            }
        }

        // Tell how it behaves.
        if self.binary {
            text.push_str(", binary");
        }
        let Overrides {
            blinks,
            looks,
            mouths,
        } = self.overrides;
        let kinds = [(blinks, "blinks"), (looks, "looks"), (mouths, "mouths")];
        for (does, kind) in kinds.into_iter().filter(|(does, _)| *does != "none") {
            let _ = write!(text, ", {does}s {kind}");
        }
        text
    }
}

impl Skin {
    fn text(&self) -> String {
        format!("'{}' {} joints", name(&self.name), self.joint_count)
    }
}

pub(super) fn point([x, y, z]: [f32; 3], decimals: usize) -> String {
    format!("{x:.decimals$},{y:.decimals$},{z:.decimals$}")
}

/// Number of decimal places that shows about five digits of a box's longest side.
pub(super) fn decimals_for(min: [f32; 3], max: [f32; 3]) -> usize {
    let longest = (0..3).map(|axis| max[axis] - min[axis]).fold(0.0, f32::max);
    (0..12)
        .find(|places| longest * 10f32.powi(*places) >= 1e4)
        .unwrap_or(4) as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_box_is_shown_to_five_digits() {
        let shown = |side: f32| point([side; 3], decimals_for([0.0; 3], [side; 3]));
        assert_eq!(shown(1.234_567), "1.2346,1.2346,1.2346");
        assert_eq!(shown(12_345.6), "12346,12346,12346");
        assert_eq!(shown(0.0), "0.0000,0.0000,0.0000");
    }

    #[test]
    fn long_lists_are_cut() {
        let mut text = String::new();
        list(&mut text, "skin", (0..LISTED + 7).map(|i| i.to_string()));
        assert_eq!(text.lines().count(), LISTED + 1);
        assert!(text.ends_with("skin and 7 more\n"), "{text}");
    }
}
