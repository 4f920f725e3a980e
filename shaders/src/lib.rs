//! The WGSL text of every pass, and the linker that joins it with its libraries.
//!
//! Usable without wgpu: link a shader, give the text to any WebGPU host. A line `//# use lib/NAME` in a shader stands
//! for the text of `lib/NAME.wgsl`, put in once however often it is asked for; what no entry point reaches is left out
//! again. Some libraries serve a feature that many frames do without; for those frames the short text of
//! `lib/none/NAME.wgsl` takes their place, with the same functions.
//!
//! ```
//! use npr_shaders::{Features, SHADE_COMPOSE_FRAME, link};
//!
//! let plain = link(&SHADE_COMPOSE_FRAME, Features::NONE);
//! let whole = link(&SHADE_COMPOSE_FRAME, Features::ALL);
//! assert!(plain.len() < whole.len() / 2);
//! ```

mod features;
mod library;
mod reached;

pub use features::Features;

use library::library;
use reached::reached;

/// A shader file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shader {
    /// Its path below the folder of shaders, without the extension.
    pub path: &'static str,
    /// Its text, before linking.
    pub text: &'static str,
}

macro_rules! shaders {
    ($($(#[$doc:meta])* $name:ident = $path:literal;)+) => {
        $($(#[$doc])* pub const $name: Shader =
            Shader { path: $path, text: include_str!(concat!("../", $path, ".wgsl")) };)+

        /// Every shader that is a pass.
        pub const ALL: &[Shader] = &[$($name),+];
    };
}

shaders! {
    /// Marks the tiles that lie near a border between subjects.
    BACKDROP_FLAG_TILES = "backdrop/flag_tiles";
    /// Finds the colours of both sides of such borders.
    BACKDROP_FIND_RIMS = "backdrop/find_rims";
    /// Draws them as outlines of one pixel.
    BACKDROP_DRAW_RIMS = "backdrop/draw_rims";
    /// Blends them along the outline.
    BACKDROP_SMOOTH_RIMS = "backdrop/smooth_rims";
    /// What the lines of every tile start from, and what they stand before.
    BACKDROP_GATHER_TILES = "backdrop/gather_tiles";
    /// The bounds of what the lines of every tile stand before, and its own vote.
    BACKDROP_BOUND_TILES = "backdrop/bound_tiles";
    /// Decides which way the lines of every tile move.
    BACKDROP_VOTE_BIAS = "backdrop/vote_bias";
    /// Keeps what was decided for the frame that comes next.
    BACKDROP_BLEND_BIASES = "backdrop/blend_biases";
    /// Finds the nearest one in every row.
    BACKDROP_SPREAD_ROWS = "backdrop/spread_rows";
    /// Carries the nearest one to every pixel.
    BACKDROP_SPREAD_RIMS = "backdrop/spread_rims";
    /// Poses and projects vertices.
    MESH_POSE_VERTICES = "mesh/pose_vertices";
    /// Decides which edges may become lines.
    MESH_CLASSIFY_EDGES = "mesh/classify_edges";
    /// Pushes vertices out along their normals.
    MESH_EXTRUDE_HULL = "mesh/extrude_hull";
    /// Projects vertices for a light.
    MESH_PROJECT_SHADOW = "mesh/project_shadow";
    /// Draws triangle numbers with depth.
    RASTER_DRAW_IDS = "raster/draw_ids";
    /// Draws triangle numbers as a light sees them.
    RASTER_DRAW_SHADOW = "raster/draw_shadow";
    /// Draws the numbers of hull triangles with depth.
    RASTER_DRAW_HULL = "raster/draw_hull";
    /// Draws triangle numbers of beams with depth.
    RASTER_DRAW_BEAMS = "raster/draw_beams";
    /// Turns triangle numbers into a G-buffer.
    LINE_RESOLVE_GBUFFER = "line/resolve_gbuffer";
    /// Detects lines on the G-buffer.
    LINE_DETECT = "line/detect";
    /// Decides the colour of lines at the pixels of the mask.
    LINE_COLOR_MASK = "line/color_mask";
    /// Lets light change the width of lines.
    LINE_LIGHT_WIDTHS = "line/light_widths";
    /// Draws edges as ribbons where the mask is set.
    LINE_DRAW_RIBBONS = "line/draw_ribbons";
    /// Finds mask pixels that no ribbon inked.
    LINE_FIND_RESIDUAL = "line/find_residual";
    /// Evens out where stamps lie along a line.
    LINE_SMOOTH_STAMPS = "line/smooth_stamps";
    /// Claims pixels for the stamps that cover them.
    LINE_CLAIM_PIXELS = "line/claim_pixels";
    /// Inks discs around the mask pixels that no ribbon inked.
    LINE_STAMP_RESIDUAL = "line/stamp_residual";
    /// Draws the mask itself.
    LINE_DRAW_MASK = "line/draw_mask";
    /// Looks what hides samples of lines.
    STROKE_SEE_SAMPLES = "stroke/see_samples";
    /// Decides where lines are clearly visible or hidden.
    STROKE_WEIGH_SAMPLES = "stroke/weigh_samples";
    /// Lets lines change only where it is clear.
    STROKE_FILTER_VISIBILITY = "stroke/filter_visibility";
    /// Marks where parts of lines begin.
    STROKE_PART_SAMPLES = "stroke/part_samples";
    /// Makes points of ink of what is seen of lines.
    STROKE_INK_SAMPLES = "stroke/ink_samples";
    /// Draws strokes with width.
    STROKE_DRAW_STROKES = "stroke/draw_strokes";
    /// Decides which faces are turned to the eye.
    VECTOR_FACE_EYE = "vector/face_eye";
    /// Marks the half-edges on contours.
    VECTOR_MARK_CONTOURS = "vector/mark_contours";
    /// Links them to closed lines.
    VECTOR_LINK_CONTOURS = "vector/link_contours";
    /// Lets nodes of lines be ranked.
    VECTOR_LIST_NODES = "vector/list_nodes";
    /// Sizes the passes over a list by its length.
    VECTOR_SIZE_WORK = "vector/size_work";
    /// Sums values within blocks.
    VECTOR_SCAN_BLOCKS = "vector/scan_blocks";
    /// Adds the sums of earlier blocks.
    VECTOR_SCAN_ADD = "vector/scan_add";
    /// Puts marked elements in a row.
    VECTOR_COMPACT = "vector/compact";
    /// Lets every node of a list look at its predecessor.
    VECTOR_START_NODES = "vector/start_nodes";
    /// Finds the heads of chains, one round.
    VECTOR_BREAK_LOOPS = "vector/break_loops";
    /// Cuts loops at their heads.
    VECTOR_CUT_LOOPS = "vector/cut_loops";
    /// Ranks lists, one round.
    VECTOR_RANK_JUMP = "vector/rank_jump";
    /// Marks the nodes that others count from.
    VECTOR_FIND_SPLITTERS = "vector/find_splitters";
    /// Counts from every node to its splitter.
    VECTOR_WALK_TO_SPLITTER = "vector/walk_to_splitter";
    /// Lets every splitter look at the one before it.
    VECTOR_START_SPLITTERS = "vector/start_splitters";
    /// Ranks short lists, all rounds.
    VECTOR_RANK_SPLITTERS = "vector/rank_splitters";
    /// Passes ranks on to nodes.
    VECTOR_SCATTER_RANKS = "vector/scatter_ranks";
    /// Measures the lengths of chains.
    VECTOR_MEASURE_CHAINS = "vector/measure_chains";
    /// Counts from the heads of chains.
    VECTOR_TURN_RANKS = "vector/turn_ranks";
    /// Puts the nodes of all chains in a row.
    VECTOR_ORDER_NODES = "vector/order_nodes";
    /// Marks the edges that a picture of lines shows.
    VECTOR_MARK_EDGES = "vector/mark_edges";
    /// Lays edges on the fine grid of a picture.
    VECTOR_PROJECT_EDGES = "vector/project_edges";
    /// Draws the depths of surfaces that hide lines.
    VECTOR_DRAW_SURFACES = "vector/draw_surfaces";
    /// Places the fragments of lines.
    VECTOR_EMIT_FRAGMENTS = "vector/emit_fragments";
    /// Tests fragments of lines against depths.
    VECTOR_TEST_FRAGMENTS = "vector/test_fragments";
    /// Keeps the nearest fragment of every pixel.
    VECTOR_DRAW_NEAREST = "vector/draw_nearest";
    /// Finds the sides of inked pixels.
    VECTOR_MARK_SIDES = "vector/mark_sides";
    /// Links the sides of inked pixels.
    VECTOR_LINK_SIDES = "vector/link_sides";
    /// Puts sides in the order of their loops.
    VECTOR_GATHER_SIDES = "vector/gather_sides";
    /// Drops loops that are too small.
    VECTOR_DROP_SPECKS = "vector/drop_specks";
    /// Smooths vectors along loops.
    VECTOR_SMOOTH_LOOPS = "vector/smooth_loops";
    /// Fits tangents to loops.
    VECTOR_FIT_TANGENTS = "vector/fit_tangents";
    /// Keeps sides that run as their contour does.
    VECTOR_CULL_SIDES = "vector/cull_sides";
    /// Lets neighbours decide about sides.
    VECTOR_VOTE_SIDES = "vector/vote_sides";
    /// Finds where strips of kept sides start.
    VECTOR_START_STRIPS = "vector/start_strips";
    /// Ranks the sides of strips.
    VECTOR_RANK_STRIPS = "vector/rank_strips";
    /// Measures the lengths of strips.
    VECTOR_MEASURE_STRIPS = "vector/measure_strips";
    /// Drops strips that are too short.
    VECTOR_DROP_SHORT = "vector/drop_short";
    /// Draws the numbers of spheres with depth.
    RASTER_DRAW_SPHERES = "raster/draw_spheres";
    /// Projects spheres of smoke.
    SMOKE_PROJECT_SPHERES = "smoke/project_spheres";
    /// Lights spheres of smoke.
    SMOKE_SHADE_SPHERES = "smoke/shade_spheres";
    /// Adds up the tones of smoke in cells.
    SMOKE_GATHER_TONES = "smoke/gather_tones";
    /// Smooths cells along rows.
    SMOKE_BLUR_ROWS = "smoke/blur_rows";
    /// Smooths cells along columns.
    SMOKE_BLUR_COLUMNS = "smoke/blur_columns";
    /// Gives every pixel its smoothed tone.
    SMOKE_SMOOTH_TONES = "smoke/smooth_tones";
    /// Draws tones and outlines of smoke.
    SMOKE_RESOLVE_PICTURE = "smoke/resolve_picture";
    /// Finds what is the same all over each triangle.
    SHADE_KNOW_TRIANGLES = "shade/know_triangles";
    /// Fills pixels of one known colour, and lists the others.
    SHADE_FILL_FRAME = "shade/fill_frame";
    /// Shades surfaces and lays lines over them.
    SHADE_COMPOSE_FRAME = "shade/compose_frame";
    /// Finds the tone of every pixel.
    SHADE_FIND_TONES = "shade/find_tones";
    /// Finds the tiles in which tones may change.
    SHADE_FLAG_TONES = "shade/flag_tones";
    /// Evens tones.
    SHADE_EVEN_TONES = "shade/even_tones";
    /// Finds how deep each pixel of a picture lies.
    SHADE_FIND_DEPTHS = "shade/find_depths";
}

/// Lays a finished frame into a target of a host program; no pass, since the target is not of a graph.
pub const HOST_LAY_FRAME: Shader = Shader {
    path: "host/lay_frame",
    text: include_str!("../host/lay_frame.wgsl"),
};

/// The text of a shader with its libraries in place, as far as `features` need them: what its entry points reach, and
/// all bindings, without comments.
///
/// # Panics
///
/// When a shader of this crate names a library that does not exist, which the tests rule out.
pub fn link(shader: &Shader, features: Features) -> String {
    reached(&linked(shader, features).text)
}

/// The features that decide about the text of a shader that is linked for `features`: another set with the same ones of
/// these gives the same text.
///
/// # Panics
///
/// As [`link`].
pub fn deciding(shader: &Shader, features: Features) -> Features {
    linked(shader, features).decided_by
}

/// A shader while its libraries are put in.
#[derive(Debug, Default)]
struct Linked {
    text: String,
    used: Vec<&'static str>,
    decided_by: Features,
}

fn linked(shader: &Shader, features: Features) -> Linked {
    let mut linked = Linked::default();
    linked.append(shader.text, features);
    linked
}

impl Linked {
    /// Appends a text, its libraries before the lines that follow their first use.
    fn append(&mut self, text: &'static str, features: Features) {
        for line in text.lines() {
            let Some(name) = line.strip_prefix("//# use ") else {
                let code = code_of(line);
                if !code.is_empty() {
                    self.text.push_str(code);
                    self.text.push('\n');
                }
                continue;
            };
            let name = name.trim();
            if !self.used.contains(&name) {
                self.used.push(name);
                let library = library(name);
                self.decided_by = self.decided_by.or(library.serves);
                self.append(library.text_for(features), features);
            }
        }
    }
}

/// The example of the README, as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

/// What stands in a line before its comment.
fn code_of(line: &str) -> &str {
    let slashes = line.match_indices('/').map(|(at, _)| at);
    let mut comments = slashes.filter(|at| line[at + 1..].starts_with('/'));
    comments.next().map_or(line, |at| &line[..at]).trim_end()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_shader_links_and_opens_with_its_name() {
        for shader in ALL {
            for features in [Features::NONE, Features::ALL] {
                let linked = link(shader, features);
                let path = shader.path;
                assert!(!linked.contains("//# use"), "{path} keeps a use line");
            }
            let name = shader.path.replace('/', ".");
            assert!(
                shader.text.starts_with(&format!("// {name}: ")),
                "{} opens with another name",
                shader.path
            );
        }
    }

    #[test]
    fn comments_are_left_out() {
        let lines = [
            ("let a = b / c; // half of it", "let a = b / c;"),
            ("// alone", ""),
            ("  x = 1u;", "  x = 1u;"),
            ("a /", "a /"),
        ];
        for (line, code) in lines {
            assert_eq!(code_of(line), code);
        }
        let texts = ALL.iter().map(|shader| link(shader, Features::ALL));
        assert_eq!(texts.filter(|text| text.contains("//")).count(), 0);
    }

    #[test]
    fn a_library_asked_for_twice_comes_once() {
        let shader = Shader {
            path: "test",
            text: "//# use lib/surface\n//# use lib/surface\n\
                   @compute @workgroup_size(1)\nfn main() { weights_at(); }\n",
        };
        assert_eq!(
            link(&shader, Features::ALL)
                .matches("fn weights_at")
                .count(),
            1
        );
    }

    /// Sets that agree on the deciding features give one text, whatever else is in them.
    #[test]
    fn only_deciding_features_change_a_text() {
        for shader in ALL {
            for (_, asked) in Features::NAMED {
                for features in [*asked, Features::ALL.without(*asked)] {
                    let decided_by = deciding(shader, features);
                    let (own, text) = (features.and(decided_by), link(shader, features));
                    assert_eq!(link(shader, own), text, "{}", shader.path);
                    let other = own.or(Features::ALL.without(decided_by));
                    assert_eq!(link(shader, other), text, "{}", shader.path);
                }
            }
        }
    }
}
