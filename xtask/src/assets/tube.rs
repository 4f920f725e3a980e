//! Tapered tubes along planar centre lines: spouts, handles, stems.

use glam::{Vec2, Vec3};
use npr_core::math;

use super::pen::Path;
use super::shape::{Paint, Shape, Vertex};

/// One cross-section of a tube: an ellipse across the centre line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Station {
    /// The centre in the plane z = 0, in centimetres.
    pub centre: Vec2,
    /// The direction of the centre line, of length 1.
    pub tangent: Vec2,
    /// The half axes: within the plane, and across it along z.
    pub radii: Vec2,
}

/// A tube through `stations`, with `segments` points around, closed by flat ends.
pub fn tube(stations: &[Station], segments: u32, paint: Paint) -> Shape {
    let rows = with_ends(stations);
    let last_row = (rows.len() - 1) as f32;
    Shape::grid(rows.len() as u32, segments + 1, paint, |row, column| {
        let station = rows[row as usize];
        let angle = std::f32::consts::TAU * (column % segments) as f32 / segments as f32;
        let side = Vec2::new(station.tangent.y, -station.tangent.x);
        let place = station.centre + side * (station.radii.x * math::cos(angle));
        Vertex {
            position: Vec3::new(place.x, place.y, station.radii.y * math::sin(angle) + 0.0),
            uv: Vec2::new(column as f32 / segments as f32, row as f32 / last_row),
        }
    })
}

/// Cross-sections along `path`, whose half axes `radii` gives for each fraction 0..1 of its length.
pub fn stations(path: &Path, radii: impl Fn(f32) -> [f32; 2]) -> Vec<Station> {
    let tangents = path.tangents();
    let fractions = path.fractions();
    (0..path.points.len())
        .map(|i| Station {
            centre: path.points[i],
            tangent: tangents[i],
            radii: Vec2::from(radii(fractions[i])),
        })
        .collect()
}

/// The stations with a point put before the first and after the last.
fn with_ends(stations: &[Station]) -> Vec<Station> {
    let point = |station: &Station| Station {
        radii: Vec2::ZERO,
        ..*station
    };
    let first = stations.first().map(point);
    let last = stations.last().map(point);
    first
        .into_iter()
        .chain(stations.iter().copied())
        .chain(last)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::super::shape::{open_edge_count, volume};
    use super::*;

    #[test]
    fn a_straight_tube_is_a_closed_cylinder() {
        let path = Path::start(0.0, 0.0).line(0.0, 1.0).line(0.0, 3.0);
        let shape = tube(&stations(&path, |_| [1.0, 0.5]), 64, Paint(0));
        assert_eq!(open_edge_count(&shape), 0);
        let exact = std::f32::consts::PI * 0.5 * 3.0;
        assert!(
            (volume(&shape) / exact - 1.0).abs() < 0.01,
            "volume {}",
            volume(&shape)
        );
    }
}
