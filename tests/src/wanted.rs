//! The drawing that a method should make, as line segments in frame pixels.

use npr_core::window::View;

/// Distance between points that stand for a segment, in pixels.
const POINT_STEP: f32 = 0.5;

/// Line segments in frame pixels.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Wanted {
    segments: Vec<[[f32; 2]; 2]>,
}

impl Wanted {
    /// Segments given by their ends.
    pub fn new(segments: Vec<[[f32; 2]; 2]>) -> Self {
        Self { segments }
    }

    /// Segments between points of the world, as a camera sees them.
    pub fn seen(view: &View, segments: &[[[f32; 3]; 2]]) -> Self {
        let ends = segments.iter().map(|ends| ends.map(|end| px_of(view, end)));
        Self::new(ends.collect())
    }

    /// These segments and those of another drawing.
    pub fn and(mut self, other: Self) -> Self {
        self.segments.extend(other.segments);
        self
    }

    /// The segments.
    pub fn segments(&self) -> &[[[f32; 2]; 2]] {
        &self.segments
    }

    /// Distance of a point from the nearest segment.
    pub fn distance(&self, point: [f32; 2]) -> f32 {
        let apart = self.segments.iter().map(|ends| distance(*ends, point));
        apart.fold(f32::MAX, f32::min)
    }

    /// Points along all segments, half a pixel apart.
    pub fn points(&self) -> Vec<[f32; 2]> {
        let of_segment = |[a, b]: &[[f32; 2]; 2]| {
            let (a, b) = (*a, *b);
            let count = ((b[0] - a[0]).hypot(b[1] - a[1]) / POINT_STEP).ceil() as u32 + 1;
            (0..=count).map(move |i| {
                let t = i as f32 / count as f32;
                [a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t]
            })
        };
        self.segments.iter().flat_map(of_segment).collect()
    }
}

/// Where a point of the world lies in the frame, in pixels.
pub(crate) fn px_of(view: &View, world: [f32; 3]) -> [f32; 2] {
    let m = view.clip_from_world;
    let clip: [f32; 4] = std::array::from_fn(|i| {
        m[0][i] * world[0] + m[1][i] * world[1] + m[2][i] * world[2] + m[3][i]
    });
    [
        (clip[0] / clip[3] + 1.0) * 0.5 * view.frame_px[0],
        (1.0 - clip[1] / clip[3]) * 0.5 * view.frame_px[1],
    ]
}

fn distance([a, b]: [[f32; 2]; 2], p: [f32; 2]) -> f32 {
    let (ab, ap) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
    let length = (ab[0] * ab[0] + ab[1] * ab[1]).max(1e-12);
    let t = ((ap[0] * ab[0] + ap[1] * ab[1]) / length).clamp(0.0, 1.0);
    (ap[0] - ab[0] * t).hypot(ap[1] - ab[1] * t)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distance_is_to_the_segment_and_not_to_its_line() {
        let wanted = Wanted::new(vec![[[0.0, 0.0], [10.0, 0.0]]]);
        assert_eq!(wanted.distance([5.0, 3.0]), 3.0);
        assert_eq!(wanted.distance([13.0, 4.0]), 5.0);
        assert!(wanted.points().len() >= 20);
    }
}
