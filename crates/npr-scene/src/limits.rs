//! What loading may cost at most.

use npr_core::budget::{Budget, OverBudget};

/// How large a scene may be before it is refused.
///
/// They guard against broken and hostile files; each has an option of the command that lifts it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Limits {
    /// Largest file in bytes, the scene's own or one it refers to (`--max-file`).
    pub file_bytes: u64,
    /// Largest JSON text of a glTF file in bytes (`--max-json`).
    pub json_bytes: u64,
    /// Most objects in that JSON text, each of which takes some hundred bytes (`--max-json-objects`).
    pub json_objects: u64,
    /// Most nodes (`--max-nodes`).
    pub nodes: u64,
    /// Most triangles (`--max-triangles`).
    pub triangles: u64,
    /// Longest side of an image in pixels (`--max-image-side`).
    pub image_side_px: u32,
    /// Largest decoded image in bytes (`--max-image`).
    pub image_bytes: u64,
    /// All decoded images together in bytes (`--max-images`).
    pub images_bytes: u64,
    /// Whether images are decoded at all; default true. Without, their files are not opened and materials have no
    /// textures, which is all that drawings of lines alone need.
    pub decode_images: bool,
    /// All vertex data, decoded images and external files together in bytes (`--memory-limit`).
    pub memory_bytes: u64,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            file_bytes: 2 << 30,
            json_bytes: 64 << 20,
            json_objects: 2 << 20,
            nodes: 1 << 20,
            triangles: 64 << 20,
            image_side_px: 16_384,
            image_bytes: 256 << 20,
            images_bytes: 1 << 30,
            decode_images: true,
            memory_bytes: 4 << 30,
        }
    }
}

/// A file asks for more than a limit allows.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{what} {value} exceeds the limit of {limit}, which {option} lifts")]
pub struct LimitError {
    /// What there is too much of.
    pub what: String,
    /// How much the file asks for.
    pub value: u64,
    /// How much is allowed.
    pub limit: u64,
    /// The option of the command that lifts the limit.
    pub option: &'static str,
}

impl From<OverBudget> for LimitError {
    fn from(fault: OverBudget) -> Self {
        let used = fault.limit_bytes.saturating_sub(fault.left_bytes);
        Self {
            what: format!("memory in bytes for {}", fault.what),
            value: used.saturating_add(fault.needed_bytes),
            limit: fault.limit_bytes,
            option: "--memory-limit",
        }
    }
}

/// Refuses `value` above `limit`.
pub(crate) fn check(
    what: &str,
    value: u64,
    limit: u64,
    option: &'static str,
) -> Result<(), LimitError> {
    if value <= limit {
        return Ok(());
    }
    Err(LimitError {
        what: what.to_owned(),
        value,
        limit,
        option,
    })
}

/// What one load may still use.
#[derive(Debug)]
pub(crate) struct Allowance {
    pub(crate) limits: Limits,
    memory: Budget,
    triangle_count: u64,
    image_bytes: u64,
}

impl Allowance {
    pub(crate) fn new(limits: Limits) -> Self {
        Self {
            limits,
            memory: Budget::new(limits.memory_bytes),
            triangle_count: 0,
            image_bytes: 0,
        }
    }

    /// Plans memory for `count` elements of type `T`.
    pub(crate) fn take<T>(&mut self, what: &str, count: usize) -> Result<(), LimitError> {
        Ok(self.memory.take(what, count, size_of::<T>())?)
    }

    /// Plans `count` more triangles and their memory.
    pub(crate) fn take_triangles(&mut self, count: usize) -> Result<(), LimitError> {
        self.triangle_count = self.triangle_count.saturating_add(count as u64);
        check(
            "triangle count",
            self.triangle_count,
            self.limits.triangles,
            "--max-triangles",
        )?;
        self.take::<[u32; 3]>("triangles", count)
    }

    /// Plans memory for `count` more segments of lines.
    pub(crate) fn take_segments(&mut self, count: usize) -> Result<(), LimitError> {
        self.take::<[u32; 2]>("line segments", count)
    }

    /// Plans the decoded bytes of an image of `width` x `height` pixels.
    pub(crate) fn take_image(&mut self, width: u32, height: u32) -> Result<(), LimitError> {
        // Refuse an image that is too large by itself.
        let side = u64::from(width.max(height));
        check(
            "image side in pixels",
            side,
            u64::from(self.limits.image_side_px),
            "--max-image-side",
        )?;
        let bytes = u64::from(width)
            .saturating_mul(u64::from(height))
            .saturating_mul(4);
        check(
            "image size in bytes",
            bytes,
            self.limits.image_bytes,
            "--max-image",
        )?;

        // Refuse one that makes all images together too large.
        self.image_bytes = self.image_bytes.saturating_add(bytes);
        check(
            "size of all images in bytes",
            self.image_bytes,
            self.limits.images_bytes,
            "--max-images",
        )?;
        self.take::<u8>("images", usize::try_from(bytes).unwrap_or(usize::MAX))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn images_are_limited_by_side_by_size_and_together() {
        let limits = Limits {
            image_side_px: 100,
            image_bytes: 4_000,
            images_bytes: 6_000,
            ..Limits::default()
        };
        let mut allowance = Allowance::new(limits);
        assert_eq!(
            allowance.take_image(101, 1).map_err(|e| e.option),
            Err("--max-image-side")
        );
        assert_eq!(
            allowance.take_image(100, 11).map_err(|e| e.option),
            Err("--max-image")
        );
        assert_eq!(allowance.take_image(100, 10), Ok(()));
        assert_eq!(
            allowance.take_image(100, 10).map_err(|e| e.option),
            Err("--max-images")
        );
    }

    #[test]
    fn a_message_names_limit_value_and_option() {
        let mut allowance = Allowance::new(Limits {
            memory_bytes: 100,
            ..Limits::default()
        });
        let fault = allowance
            .take::<[f32; 3]>("positions", 10)
            .expect_err("120 bytes do not fit 100");
        let text = fault.to_string();
        assert_eq!(
            text,
            "memory in bytes for positions 120 exceeds the limit of 100, which --memory-limit lifts"
        );
    }
}
