//! The arguments about safety limits.

use super::byte_count::byte_count;
use clap::Args;
use npr_scene::Limits;

/// Limits that guard against broken and hostile files; what is not said keeps its default.
#[derive(Debug, Clone, Default, PartialEq, Eq, Args)]
#[command(next_help_heading = "Safety limits")]
pub struct LimitArguments {
    /// Memory that may be planned, in bytes; K, M and G are understood [default: 4G].
    #[arg(long, value_name = "BYTES", value_parser = byte_count)]
    pub memory_limit: Option<u64>,
    /// Largest file, in bytes [default: 2G].
    #[arg(long, value_name = "BYTES", value_parser = byte_count, hide_short_help = true)]
    pub max_file: Option<u64>,
    /// Largest JSON text of a glTF file, in bytes [default: 64M].
    #[arg(long, value_name = "BYTES", value_parser = byte_count, hide_short_help = true)]
    pub max_json: Option<u64>,
    /// Most objects in that JSON text [default: 2M].
    #[arg(long, value_name = "COUNT", value_parser = byte_count, hide_short_help = true)]
    pub max_json_objects: Option<u64>,
    /// Most nodes [default: 1M].
    #[arg(long, value_name = "COUNT", value_parser = byte_count, hide_short_help = true)]
    pub max_nodes: Option<u64>,
    /// Most triangles [default: 64M].
    #[arg(long, value_name = "COUNT", value_parser = byte_count, hide_short_help = true)]
    pub max_triangles: Option<u64>,
    /// Longest side of an image, in pixels [default: 16384].
    #[arg(long, value_name = "PIXELS", hide_short_help = true)]
    pub max_image_side: Option<u32>,
    /// Largest decoded image, in bytes [default: 256M].
    #[arg(long, value_name = "BYTES", value_parser = byte_count, hide_short_help = true)]
    pub max_image: Option<u64>,
    /// All decoded images together, in bytes [default: 1G].
    #[arg(long, value_name = "BYTES", value_parser = byte_count, hide_short_help = true)]
    pub max_images: Option<u64>,
}

impl LimitArguments {
    /// The limits for loading a scene.
    pub fn limits(&self) -> Limits {
        let usual = Limits::default();
        Limits {
            file_bytes: self.max_file.unwrap_or(usual.file_bytes),
            json_bytes: self.max_json.unwrap_or(usual.json_bytes),
            json_objects: self.max_json_objects.unwrap_or(usual.json_objects),
            nodes: self.max_nodes.unwrap_or(usual.nodes),
            triangles: self.max_triangles.unwrap_or(usual.triangles),
            image_side_px: self.max_image_side.unwrap_or(usual.image_side_px),
            image_bytes: self.max_image.unwrap_or(usual.image_bytes),
            images_bytes: self.max_images.unwrap_or(usual.images_bytes),
            decode_images: usual.decode_images,
            memory_bytes: self.memory_limit.unwrap_or(usual.memory_bytes),
        }
    }
}
