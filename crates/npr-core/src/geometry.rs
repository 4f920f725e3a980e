//! The structs that passes read and write, laid out alike in Rust and in WGSL.
//!
//! Their WGSL text is `shaders/lib/geometry.wgsl`; the shader test compares the two field by field.

use crate::edge_flags::EdgeFlags;
use crate::gpu_layout;
use crate::line_kind::{COLORED_KINDS, KindSet};
use bytemuck::{Pod, Zeroable};

/// Marks "none" wherever an index is expected.
pub const NONE: u32 = u32::MAX;

/// View depth of a pixel that shows no surface; finite, so that differences with it stay finite.
pub const FAR_DEPTH: f32 = 1e30;

/// A vertex as stored: rest position and what hangs on it.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct Vertex {
    /// Position before posing, in the space its influences start from.
    pub position: [f32; 3],
    /// Vertex colour, sRGB bytes, the first in the lowest byte; white where there is none.
    pub color: u32,
    /// Unit normal in the same space as `position`.
    pub normal: [f32; 3],
    /// Direction of `curvatures[0]`, packed by [`crate::math::pack_unit`].
    pub direction: u32,
    /// Texture coordinates of the base colour texture.
    pub uv: [f32; 2],
    /// Principal curvatures in the world, in 1 / bounding radius of the scene; positive is convex.
    pub curvatures: [f32; 2],
    /// Unit normal averaged over all vertices at this position, packed: hulls grow along it without cracks.
    pub weld_normal: u32,
    /// The line width that the style's width source gives here, 0..1, where it depends on the vertex alone; where
    /// width follows the projected curvature, the size of the tightest curvature, in 1 / bounding radius of the
    /// scene.
    pub width: f32,
    /// Index into the parts.
    pub part: u32,
    /// How badly hatch strokes lie around it, where the dark is solid ink, and how much of its shade the pen leaves
    /// out, as on faces: two shares packed by [`crate::math::pack_shares`].
    pub pen: u32,
}
gpu_layout!(Vertex {
    position,
    color,
    normal,
    direction,
    uv,
    curvatures,
    weld_normal,
    width,
    part,
    pen
});

impl Vertex {
    /// Whether it leaves the colour of its material as it is; alpha does not count.
    pub fn is_white(&self) -> bool {
        self.color | 0xff00_0000 == u32::MAX
    }
}

/// Which matrices move a vertex, and how much: linear blend skinning; rigid parts use one joint.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct Influence {
    /// Indices into the palette of matrices.
    pub joints: [u32; 4],
    /// Weights, summing to 1.
    pub weights: [f32; 4],
}
gpu_layout!(Influence { joints, weights });

/// A vertex after posing and projection.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct PosedVertex {
    /// Position in clip space: reversed depth, 1 at the near plane.
    pub clip: [f32; 4],
    /// Position in the world.
    pub world: [f32; 3],
    /// Distance from the eye along the view axis.
    pub depth: f32,
    /// Unit normal in the world.
    pub normal: [f32; 3],
    /// Half the line width at this vertex, in frame pixels.
    pub half_width: f32,
}
gpu_layout!(PosedVertex {
    clip,
    world,
    depth,
    normal,
    half_width
});

/// A triangle and the part it belongs to.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct Triangle {
    /// Vertex indices, counter-clockwise seen from the front.
    pub corners: [u32; 3],
    /// Index into the parts.
    pub part: u32,
}
gpu_layout!(Triangle { corners, part });

/// Where the corners of a triangle lie in its stroke chart: tiles across and along the strokes.
///
/// Passes read charts from an image of bits of floats, six texels a chart: storage buffers are few.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct ChartCorners {
    /// Of the first corner.
    pub a: [f32; 2],
    /// Of the second.
    pub b: [f32; 2],
    /// Of the third.
    pub c: [f32; 2],
}

impl ChartCorners {
    /// Texels of a chart.
    pub const TEXELS: u32 = 6;
    /// Charts in a row of an image: 8192 rows, which every device has, hold one for each triangle that fits a buffer.
    pub const ACROSS: u32 = 1024;

    /// Width and height in texels of an image with room for `count` charts, row by row.
    pub fn image_size(count: usize) -> [u32; 2] {
        let count = u32::try_from(count).unwrap_or(u32::MAX);
        let across = count.min(Self::ACROSS);
        [across * Self::TEXELS, count.div_ceil(Self::ACROSS)]
    }
}

/// A unique mesh edge between two stored vertices that stand for their welded positions.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct Edge {
    /// Vertex indices.
    pub ends: [u32; 2],
    /// Triangle indices; the second is [`NONE`] on a boundary.
    pub faces: [u32; 2],
    /// Cosine of the angle by which the edge folds, between what the style says; 1 where the surface runs on.
    pub dihedral_cos: f32,
    /// How its faces meet.
    pub traits: EdgeFlags,
}
gpu_layout!(Edge {
    ends,
    faces,
    dihedral_cos,
    traits
});

/// What an edge is in a view.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct EdgeRole {
    /// Bits of [`KindSet`] and [`EdgeFlags::FACING`]; 0 where it draws no line.
    pub kinds: u32,
    /// The part that draws its line: that of its first face.
    pub part: u32,
}
gpu_layout!(EdgeRole { kinds, part });

/// One surface of one object in one material, with what the style makes of it.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct Part {
    /// Base colour factor, linear light, straight alpha.
    pub base_color: [f32; 4],
    /// Colour of its lines, sRGB, straight alpha.
    pub line_color: [f32; 4],
    /// Colour of its ink and hatching, linear light; alpha is how much it covers.
    pub ink_color: [f32; 4],
    /// Object number, equal for all parts of one object.
    pub object: u32,
    /// Material number.
    pub material: u32,
    /// Where its base colour texture's header starts in the texture store, or [`NONE`].
    pub texture: u32,
    /// Bits of [`Part::DOUBLE_SIDED`] to [`Part::FOLDS`].
    pub flags: u32,
    /// Factor on the line width.
    pub width_factor: f32,
    /// |n.v| under which the surface-angle method draws a line, 0..1.
    pub facing_threshold: f32,
    /// Alpha under which a cut-out pixel is a hole.
    pub alpha_cutoff: f32,
    /// Width of a tone step in ramp coordinate; 0 is a hard step.
    pub softness: f32,
    /// Where its hatch tile's header starts in the texture store, or [`NONE`].
    pub hatch: u32,
    /// Ramp coordinate up to which the shade ramp of ink is black.
    pub dark_at: f32,
    /// Ramp coordinate from which it is white.
    pub light_at: f32,
    /// Value under which hatch plus tone is ink.
    pub threshold: f32,
    /// Distance between hatch strokes, in frame pixels.
    pub spacing_px: f32,
    /// Steepness of strokes from their middle outwards; 1 as the tile has them.
    pub hatch_gain: f32,
    /// Share of ink from which the second layer of strokes joins in.
    pub second_from: f32,
    /// Hatch tiles per unit of the mapping's coordinate.
    pub tile_scale: f32,
    /// Cosine and sine of the angle by which hatch coordinates are turned.
    pub turn: [f32; 2],
    /// The colour it is painted in without its texture, sRGB bytes, the first in the lowest byte; the highest is how
    /// much it darkens its shade, 255 all the way. Read with [`Part::PAINTED`].
    pub paint_color: u32,
    /// Where its row of tones starts in the texture store, with [`Part::TONE_ROW`].
    pub tone_row: u32,
    /// Colour of its highlight and streak, linear light; alpha is the strength.
    pub highlight_color: [f32; 4],
    /// Colour of the light from behind, linear light; alpha is the strength.
    pub back_color: [f32; 4],
    /// Exponent, threshold and gradient factor of the highlight; place of the streak, in radii of the model.
    pub highlight: [f32; 4],
    /// Shift along both axes, stretch and squareness of the highlight.
    pub highlight_shape: [f32; 4],
    /// Cosine and sine of the turn of its axes; gaps along both.
    pub highlight_turn: [f32; 4],
    /// Where on its ramp the light from behind begins and is full; width of the streak in radii; |n.v| above which it
    /// shows.
    pub back: [f32; 4],
    /// Opacity of a beam from each of the first four steps of its ramp on.
    pub beam_alpha: [f32; 4],
    /// Tone steps: linear light rgb from coordinate `a` upwards; unused ones start at 2.
    pub ramp: [[f32; 4]; 8],
    /// What decides the colour of its lines beside `line_color`: the bits of kinds with a colour of their own, of
    /// [`Part::LINE_KINDS`], then [`Part::LINE_SURFACE`] to [`Part::LINE_WIDTH`].
    pub line_flags: u32,
    /// What a colour of the surface is multiplied by for lines, in linear light.
    pub line_factor: f32,
    /// Where the header of the picture of its lines' colours starts in the texture store, with [`Part::LINE_TEXTURE`].
    pub line_texture: u32,
    /// Where the row over depth starts there, with [`Part::LINE_DEPTH`].
    pub line_depth_row: u32,
    /// Where the row over light starts there, with [`Part::LINE_LIGHT`].
    pub line_light_row: u32,
    /// Laid over all of its lines, sRGB bytes; alpha is how much.
    pub line_tint: u32,
    /// How much lines take the colour of the light behind where that lights them, 0..1.
    pub line_rim: f32,
    /// Number of its connected surface within the object: parts of one number are one skin, however many materials
    /// and ids it has.
    pub component: u32,
    /// View depth where the row over depth begins, and 1 / its length; in the world.
    pub line_depth: [f32; 2],
    /// Opacity of lines in the dark and in full light.
    pub line_opacity: [f32; 2],
    /// Factor on their width in the dark and in full light.
    pub line_width: [f32; 2],
    /// Across its streak, to the right and up in the picture: a unit vector.
    pub streak_across: [f32; 2],
    /// Unit vector towards the light behind it, in the camera's axes: to the right, up, and towards the eye.
    pub back_direction: [f32; 3],
    /// Colours of single kinds of its lines, sRGB bytes, in the order of [`Kind::ALL`](crate::line_kind::Kind::ALL).
    /// A colour counts where `line_flags` has the bit of its kind.
    pub line_kinds: [u32; COLORED_KINDS],
    /// How much the grain of the paper shows in its hatching, 0..2.
    pub hatch_grain: f32,
    /// Hills of the paper per pixel.
    pub spots_per_px: f32,
    /// Where its toon material starts in the texture store, with [`Part::TOON`] or [`Part::TOON_LINE`].
    pub toon: u32,
    /// Radius in pixels of the disc over which its tones are evened; 0 leaves them as light makes them.
    pub tone_reach_px: f32,
    /// Fills up what these leave of a multiple of 16 bytes.
    pub unused: [u32; UNUSED],
}
gpu_layout!(Part {
    base_color,
    line_color,
    ink_color,
    object,
    material,
    texture,
    flags,
    width_factor,
    facing_threshold,
    alpha_cutoff,
    softness,
    hatch,
    dark_at,
    light_at,
    threshold,
    spacing_px,
    hatch_gain,
    second_from,
    tile_scale,
    turn,
    paint_color,
    tone_row,
    highlight_color,
    back_color,
    highlight,
    highlight_shape,
    highlight_turn,
    back,
    beam_alpha,
    ramp,
    line_flags,
    line_factor,
    line_texture,
    line_depth_row,
    line_light_row,
    line_tint,
    line_rim,
    component,
    line_depth,
    line_opacity,
    line_width,
    streak_across,
    back_direction,
    line_kinds,
    hatch_grain,
    spots_per_px,
    toon,
    tone_reach_px,
});

/// Words of [`Part`] from the light behind to its end, the last that it fills.
const LAST: usize = 3 + COLORED_KINDS + 4;

/// Words of [`Part`] behind them.
const UNUSED: usize = LAST.next_multiple_of(4) - LAST;

impl Part {
    /// Both sides are drawn.
    pub const DOUBLE_SIDED: u32 = 1;
    /// Pixels under the alpha cutoff are holes.
    pub const CUTOUT: u32 = 2;
    /// Lines are found and drawn on it.
    pub const LINES: u32 = 4;
    /// Light does not change its colour.
    pub const UNLIT: u32 = 8;
    /// What lies in the dark is solid ink.
    pub const INK: u32 = 16;
    /// Strokes lie between the dark and the light.
    pub const HATCH: u32 = 32;
    /// Strokes lie in the plane of the picture.
    pub const ON_SCREEN: u32 = 64;
    /// Strokes follow the stroke chart of the surface; without this and the one above, its UV coordinates.
    pub const ON_SURFACE: u32 = 128;
    /// The hatch is alike in all directions, as dots are.
    pub const ISOTROPIC: u32 = 256;
    /// A second layer of strokes crosses the first where it is darker.
    pub const TWO_LAYERS: u32 = 512;
    /// It has a highlight with a hard edge.
    pub const CRISP: u32 = 1024;
    /// It has a highlight with a soft edge.
    pub const SOFT: u32 = 2048;
    /// Its highlight is Phong's; without this Blinn's.
    pub const PHONG: u32 = 4096;
    /// Light from behind catches its rims.
    pub const BACK_LIGHT: u32 = 8192;
    /// It has a straight streak of gloss.
    pub const STREAK: u32 = 16384;
    /// It is a beam of light: no surface, but a glow over what lies behind it.
    pub const BEAM: u32 = 32768;
    /// A beam that covers lines too.
    pub const BEAM_COVERS: u32 = 65536;
    /// A beam that only shows where nothing lies behind it.
    pub const BEAM_BEHIND: u32 = 131_072;
    /// A hull behind it is its outline.
    pub const HULL: u32 = 262_144;
    /// It is inked where it turns from the eye.
    pub const ANGLE: u32 = 524_288;
    /// The colour it is painted in darkens its shade.
    pub const PAINTED: u32 = 1_048_576;
    /// It shows its base colour alone: neither its texture nor its vertex colours.
    pub const PLAIN: u32 = 2_097_152;
    /// Its tones are a row of the texture store, not its ramp.
    pub const TONE_ROW: u32 = 4_194_304;
    /// It is lit as a toon material says, not by its ramp.
    pub const TOON: u32 = 1 << 23;
    /// Its hull has the colour that its toon material gives it.
    pub const TOON_LINE: u32 = 1 << 24;
    /// Its line width is measured in the world, whatever the style says.
    pub const WORLD_LINE: u32 = 1 << 25;
    /// The pen leaves out some of the shade of its vertices.
    pub const SPARED: u32 = 1 << 26;
    /// Its hatch is cut out: it leaves no strip that is narrower than the spacing of its strokes.
    pub const CUT: u32 = 1 << 27;
    /// Its lines are found where its faces fold, whatever its normals say.
    pub const FOLDS: u32 = 1 << 30;
    /// Any outline.
    pub const OUTLINES: u32 = Self::LINES | Self::HULL | Self::ANGLE;
    /// Any highlight.
    pub const HIGHLIGHTS: u32 = Self::CRISP | Self::SOFT | Self::BACK_LIGHT | Self::STREAK;

    /// In `line_flags`: the bits of kinds that may have a colour of their own.
    pub const LINE_KINDS: u32 = KindSet::COLORED;
    /// Lines take the colour that the surface shows without light.
    pub const LINE_SURFACE: u32 = KindSet::END;
    /// Lines take the colour of the vertices.
    pub const LINE_VERTEX: u32 = KindSet::END << 1;
    /// Lines take the colour of a picture, at the surface's texture coordinates.
    pub const LINE_TEXTURE: u32 = KindSet::END << 2;
    /// A row of the texture store lies over lines by their depth.
    pub const LINE_DEPTH: u32 = KindSet::END << 3;
    /// Depth counts from the depth of the model's middle, not from the eye.
    pub const LINE_FROM_MIDDLE: u32 = KindSet::END << 4;
    /// A row lies over lines by the light on their surface.
    pub const LINE_LIGHT: u32 = KindSet::END << 5;
    /// Light changes their opacity.
    pub const LINE_OPACITY: u32 = KindSet::END << 6;
    /// A tint lies over all lines.
    pub const LINE_TINT: u32 = KindSet::END << 7;
    /// The light behind colours lines that it lights.
    pub const LINE_RIM: u32 = KindSet::END << 8;
    /// Light changes their width.
    pub const LINE_WIDTH: u32 = KindSet::END << 9;
    /// Anything that gives lines a colour of the surface.
    pub const LINE_SOURCES: u32 = Self::LINE_SURFACE | Self::LINE_VERTEX | Self::LINE_TEXTURE;
    /// Anything that lies over the colour of lines.
    pub const LINE_GLAZES: u32 =
        Self::LINE_DEPTH | Self::LINE_LIGHT | Self::LINE_TINT | Self::LINE_RIM;
    /// Anything that is decided at a line's place.
    pub const LINE_PLACED: u32 = Self::LINE_SOURCES | Self::LINE_GLAZES | Self::LINE_OPACITY;
}

/// A disc of ink in frame pixels; half width 0 where there is none.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct Stamp {
    /// Centre, in frame pixels.
    pub center: [f32; 2],
    /// Radius, in frame pixels.
    pub half_width: f32,
    /// Index into the parts.
    pub part: u32,
}
gpu_layout!(Stamp {
    center,
    half_width,
    part
});

/// What one pixel of the G-buffer holds.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub struct GPixel {
    /// Change of the plane coordinate ([`crate::window::View::plane_coordinate`]) over one pixel to the right and down.
    pub plane_step: [f32; 2],
    /// Distance from the eye along the view axis, or [`FAR_DEPTH`].
    pub depth: f32,
    /// Half the line width here, in frame pixels.
    pub half_width: f32,
    /// Unit normal in the world, packed.
    pub normal: u32,
    /// Part index, or [`NONE`] where no surface is seen; the part knows its object and its material.
    pub part: u32,
}
gpu_layout!(GPixel {
    plane_step,
    depth,
    half_width,
    normal,
    part
});

impl GPixel {
    /// A pixel that shows no surface.
    pub const EMPTY: GPixel = GPixel {
        plane_step: [0.0; 2],
        depth: FAR_DEPTH,
        half_width: 0.0,
        normal: 0,
        part: NONE,
    };
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_of_charts_hold_every_triangle_that_fits_a_buffer() {
        let sizes = [0, 1, 1024, 1025].map(ChartCorners::image_size);
        assert_eq!(sizes, [[0, 0], [6, 1], [6144, 1], [6144, 2]]);
        let most = (128 << 20) / size_of::<Triangle>();
        assert_eq!(ChartCorners::image_size(most), [6144, 8192]);
        assert_eq!(size_of::<ChartCorners>(), 4 * ChartCorners::TEXELS as usize);
    }
}
