//! Closed regions as triangle meshes, by constrained Delaunay triangulation [Chew 1989].

use super::map::Map;
use super::snap::{Point, snapped};
use super::{FINENESS, FillError, LONGEST_SIDE, on_grid};
use glam::DVec2;
use npr_core::number::push_fixed;
use npr_trace::{Segment, Tracing, flattened};
use serde_json::json;

pub use npr_trace::FLATNESS_PX;

/// Height of the bands in which segments are looked up, in grid units.
const BAND: i64 = 4 * FINENESS as i64;

/// Triangles in a plane.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct FlatMesh {
    /// Corners of triangles, in the unit of the rings.
    pub points: Vec<[f64; 2]>,
    /// Corners of triangles, all of positive area in the coordinates of the rings.
    pub triangles: Vec<[u32; 3]>,
}

/// A file format of meshes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum MeshFormat {
    /// Wavefront OBJ.
    Obj,
    /// Binary glTF 2.0, with a black material that is seen from both sides.
    Glb,
}

/// The regions that rings go around, as triangles.
///
/// A place belongs to a region where more rings of positive area (by the shoelace formula) go around it than of
/// negative area, so that holes are rings the other way round. Rings may touch, cross and lie on each other; they are
/// closed without repeating their first point. Triangles do not overlap, meet only along whole sides and in corners,
/// and cover the regions but for slivers: points are moved to a grid of 1/256, and crossings become points of it.
///
/// About 20 us a segment. The same for any number of threads.
///
/// # Errors
///
/// [`FillError`] where coordinates are beyond [`LONGEST_SIDE`] or no numbers, or rings cross too often.
pub fn triangulate(rings: &[Vec<[f64; 2]>]) -> Result<FlatMesh, FillError> {
    let limit = f64::from(LONGEST_SIDE);
    let is_sound = |p: &[f64; 2]| p.iter().all(|v| v.abs() <= limit);
    if !rings.iter().flatten().all(is_sound) {
        return Err(FillError::TooLarge { side: LONGEST_SIDE });
    }
    let sides: Vec<[Point; 2]> = rings.iter().flat_map(|ring| sides(ring)).collect();
    let map = Map::new(&snapped(sides.clone())?)?;
    let inside = Inside::of(&sides);
    let areas = map.areas();
    // The largest triangle of an area decides for all: its middle is furthest from where rings were moved.
    let mut largest: Vec<Option<usize>> = Vec::new();
    for (triangle, area) in areas.iter().enumerate() {
        let area = *area as usize;
        largest.resize(largest.len().max(area + 1), None);
        let best = &mut largest[area];
        if best.is_none_or(|best| map.area(triangle) > map.area(best)) {
            *best = Some(triangle);
        }
    }
    let shown: Vec<bool> = largest
        .iter()
        .map(|triangle| triangle.is_some_and(|triangle| inside.holds(middle(&map, triangle))))
        .collect();
    let kept = (0..areas.len()).filter(|triangle| shown[areas[*triangle] as usize]);
    Ok(compact(&map, kept))
}

/// The sides of a ring, on the grid.
fn sides(ring: &[[f64; 2]]) -> impl Iterator<Item = [Point; 2]> {
    let next = ring.iter().cycle().skip(1);
    let pairs = ring.iter().zip(next).map(|(a, b)| [*a, *b].map(on_grid));
    pairs.filter(|[a, b]| a != b)
}

/// The middle of a triangle, in thirds of the grid.
fn middle(map: &Map, triangle: usize) -> Point {
    let corners = map.triangles[triangle].map(|p| map.points[p as usize]);
    [0, 1].map(|axis| corners.iter().map(|corner| corner[axis]).sum())
}

/// Segments by the bands of rows that they go through.
struct Inside {
    bands: Vec<Vec<[Point; 2]>>,
    top: i64,
}

impl Inside {
    fn of(sides: &[[Point; 2]]) -> Self {
        let rows = || sides.iter().flatten().map(|p| p[1].div_euclid(BAND));
        let (top, bottom) = (rows().min().unwrap_or(0), rows().max().unwrap_or(0));
        let mut bands = vec![Vec::new(); (bottom - top + 1) as usize];
        for side in sides {
            let [a, b] = side.map(|p| p[1].div_euclid(BAND) - top);
            for band in &mut bands[a.min(b) as usize..=a.max(b) as usize] {
                band.push(*side);
            }
        }
        Self { bands, top }
    }

    /// Whether rings wind around a place more often in their sense than against it; in thirds of the grid.
    fn holds(&self, [x, y]: Point) -> bool {
        let band = y.div_euclid(3 * BAND) - self.top;
        let sides = usize::try_from(band)
            .ok()
            .and_then(|band| self.bands.get(band));
        let mut winding = 0;
        for [a, b] in sides.into_iter().flatten() {
            let [a, b] = [a, b].map(|p| p.map(|v| 3 * v));
            let turn = i128::from(b[0] - a[0]) * i128::from(y - a[1])
                - i128::from(x - a[0]) * i128::from(b[1] - a[1]);
            if a[1] <= y && b[1] > y && turn > 0 {
                winding += 1;
            } else if b[1] <= y && a[1] > y && turn < 0 {
                winding -= 1;
            }
        }
        winding > 0
    }
}

/// Triangles with only the points that they use.
fn compact(map: &Map, kept: impl Iterator<Item = usize>) -> FlatMesh {
    let mut numbers = vec![u32::MAX; map.points.len()];
    let mut mesh = FlatMesh::default();
    for triangle in kept {
        let corners = map.triangles[triangle].map(|point| {
            let number = &mut numbers[point as usize];
            if *number == u32::MAX {
                *number = mesh.points.len() as u32;
                mesh.points
                    .push(map.points[point as usize].map(|v| v as f64 / FINENESS));
            }
            *number
        });
        mesh.triangles.push(corners);
    }
    mesh
}

impl FlatMesh {
    /// A tracing as triangles, within [`FLATNESS_PX`] of its curves; pixels, y up from the lower edge.
    ///
    /// # Errors
    ///
    /// As [`triangulate`].
    pub fn of_tracing(tracing: &Tracing) -> Result<Self, FillError> {
        let height = f64::from(tracing.size[1]);
        let rings: Vec<Vec<[f64; 2]>> = tracing
            .paths
            .iter()
            .map(|path| {
                let mut ring = corners(&path.segments);
                ring.iter_mut().for_each(|[_, y]| *y = height - *y);
                if (area(&ring) > 0.0) != path.is_ink {
                    ring.reverse();
                }
                ring
            })
            .collect();
        triangulate(&rings)
    }

    /// The mesh as the bytes of a file, in the plane z = 0 and facing +z. Same mesh, same bytes.
    pub fn write(&self, format: MeshFormat) -> Vec<u8> {
        match format {
            MeshFormat::Obj => self.obj(),
            MeshFormat::Glb => self.glb(),
        }
    }

    fn obj(&self) -> Vec<u8> {
        let mut text = "o tracing\n".to_owned();
        for point in &self.points {
            text.push('v');
            for v in point {
                text.push(' ');
                // Whole steps of the grid, without loss.
                push_fixed(&mut text, *v, 8);
            }
            text += " 0\n";
        }
        for [a, b, c] in &self.triangles {
            text += &format!("f {} {} {}\n", a + 1, b + 1, c + 1);
        }
        text.into_bytes()
    }

    fn glb(&self) -> Vec<u8> {
        // Write points, then triangles, as bytes.
        let mut bytes = Vec::with_capacity(12 * (self.points.len() + self.triangles.len()));
        let [mut low, mut high] = [[f32::INFINITY; 3], [f32::NEG_INFINITY; 3]];
        for [x, y] in &self.points {
            let place = [*x as f32, *y as f32, 0.0];
            for axis in 0..3 {
                low[axis] = low[axis].min(place[axis]);
                high[axis] = high[axis].max(place[axis]);
            }
            bytes.extend(place.iter().flat_map(|v| v.to_le_bytes()));
        }
        let split = bytes.len();
        bytes.extend(
            self.triangles
                .as_flattened()
                .iter()
                .flat_map(|v| v.to_le_bytes()),
        );

        // An empty tracing is an empty scene.
        let mut scene = json!({
            "asset": { "version": "2.0", "generator": "npr" },
            "scene": 0,
            "scenes": [{ "nodes": [] }],
        });
        if !self.triangles.is_empty() {
            scene = json!({
                "asset": { "version": "2.0", "generator": "npr" },
                "scene": 0,
                "scenes": [{ "nodes": [0] }],
                "nodes": [{ "mesh": 0, "name": "tracing" }],
                "meshes": [{
                    "name": "tracing",
                    "primitives": [{ "attributes": { "POSITION": 0 }, "indices": 1, "material": 0 }]
                }],
                "materials": [{
                    "name": "ink", "doubleSided": true,
                    "pbrMetallicRoughness": { "baseColorFactor": [0, 0, 0, 1], "metallicFactor": 0 },
                }],
                "buffers": [{ "byteLength": bytes.len() }],
                "bufferViews": [
                    { "buffer": 0, "byteLength": split, "target": 34962 },
                    { "buffer": 0, "byteOffset": split, "byteLength": bytes.len() - split, "target": 34963 },
                ],
                "accessors": [
                    {
                        "bufferView": 0, "componentType": 5126, "count": self.points.len(),
                        "type": "VEC3", "min": low, "max": high
                    },
                    { "bufferView": 1, "componentType": 5125, "count": 3 * self.triangles.len(), "type": "SCALAR" },
                ],
            });
        }
        container(scene.to_string().into_bytes(), bytes)
    }
}

/// A binary glTF file of its two chunks [glTF 2.0, section 4.4].
fn container(mut json: Vec<u8>, bytes: Vec<u8>) -> Vec<u8> {
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut chunks = Vec::with_capacity(json.len() + bytes.len() + 28);
    for (kind, chunk) in [(b"JSON", json), (b"BIN\0", bytes)] {
        if !chunk.is_empty() {
            chunks.extend((chunk.len() as u32).to_le_bytes());
            chunks.extend(kind);
            chunks.extend(chunk);
        }
    }
    let mut file = b"glTF\x02\0\0\0".to_vec();
    file.extend((12 + chunks.len() as u32).to_le_bytes());
    file.extend(chunks);
    file
}

/// A closed curve as points, the first not repeated.
fn corners(segments: &[Segment]) -> Vec<[f64; 2]> {
    let mut ring = flattened(segments);
    ring.pop();
    ring.iter().map(DVec2::to_array).collect()
}

/// The signed area of a ring, by the shoelace formula.
fn area(ring: &[[f64; 2]]) -> f64 {
    let next = ring.iter().cycle().skip(1);
    let pairs = ring.iter().zip(next);
    0.5 * pairs.map(|(a, b)| a[0] * b[1] - b[0] * a[1]).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;
    use npr_trace::{Bitmap, TraceOptions, trace};
    use proptest::prelude::*;

    fn triangle_area(mesh: &FlatMesh, corners: &[u32; 3]) -> f64 {
        area(&corners.map(|point| mesh.points[point as usize]))
    }

    fn mesh_area(mesh: &FlatMesh) -> f64 {
        mesh.triangles
            .iter()
            .map(|corners| triangle_area(mesh, corners))
            .sum()
    }

    /// Asserts that triangles have area, share no side in the same sense, and so do not overlap where their area is
    /// the rings'.
    fn assert_sound(mesh: &FlatMesh) {
        let mut sides = std::collections::BTreeSet::new();
        for corners in &mesh.triangles {
            assert!(triangle_area(mesh, corners) > 0.0, "{corners:?}");
            for i in 0..3 {
                assert!(
                    sides.insert([corners[i], corners[(i + 1) % 3]]),
                    "{corners:?}"
                );
            }
        }
        let used: std::collections::BTreeSet<u32> =
            mesh.triangles.iter().flatten().copied().collect();
        assert_eq!(used.len(), mesh.points.len());
    }

    /// Whether a place lies in some triangle, and in how many.
    fn covering(mesh: &FlatMesh, [x, y]: [f64; 2]) -> usize {
        let holds = |corners: &&[u32; 3]| {
            let corners = corners.map(|point| mesh.points[point as usize]);
            (0..3).all(|i| {
                let [a, b] = [corners[i], corners[(i + 1) % 3]];
                (b[0] - a[0]) * (y - a[1]) - (x - a[0]) * (b[1] - a[1]) > 0.0
            })
        };
        mesh.triangles.iter().filter(holds).count()
    }

    fn square(x: f64, y: f64, side: f64) -> Vec<[f64; 2]> {
        vec![[x, y], [x + side, y], [x + side, y + side], [x, y + side]]
    }

    fn hole(mut ring: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
        ring.reverse();
        ring
    }

    #[test]
    fn holes_stay_holes_and_touching_corners_touch() {
        let rings = [
            square(0.0, 0.0, 10.0),
            hole(square(2.0, 2.0, 4.0)),
            square(3.0, 3.0, 1.0),
            square(10.0, 10.0, 5.0),
            hole(square(10.0, 10.0, 1.0)),
        ];
        let mesh = triangulate(&rings).expect("few rings");
        assert_sound(&mesh);
        assert_eq!(mesh_area(&mesh), 100.0 - 16.0 + 1.0 + 25.0 - 1.0);
        for (place, count) in [
            ([1.1, 1.3], 1),
            ([2.5, 4.4], 0),
            ([3.4, 3.7], 1),
            ([10.2, 10.7], 0),
            ([12.2, 12.9], 1),
            ([20.0, 1.0], 0),
        ] {
            assert_eq!(covering(&mesh, place), count, "{place:?}");
        }
    }

    #[test]
    fn rings_without_extent_give_nothing() {
        for rings in [
            vec![],
            vec![vec![]],
            vec![vec![[1.0, 1.0]]],
            vec![vec![[1.0, 1.0], [5.0, 1.0]]],
            vec![hole(square(0.0, 0.0, 3.0))],
            vec![square(0.0, 0.0, 0.001)],
        ] {
            assert_eq!(
                triangulate(&rings).expect("few rings"),
                FlatMesh::default(),
                "{rings:?}"
            );
        }
        assert!(triangulate(&[vec![[f64::NAN, 0.0], [1.0, 1.0], [0.0, 1.0]]]).is_err());
    }

    #[test]
    fn overlapping_rings_are_covered_once() {
        let mesh = triangulate(&[square(0.0, 0.0, 4.0), square(2.0, 1.0, 4.0)]).expect("few rings");
        assert_sound(&mesh);
        assert_eq!(mesh_area(&mesh), 16.0 + 16.0 - 6.0);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(150))]

        #[test]
        fn tracings_keep_their_area(
            width in 3u32..30, height in 3u32..30, percent in 5u32..95, block in 1u32..5, seed: u32,
        ) {
            let mut bitmap = Bitmap::new(width, height).expect("small");
            for (x, y) in (0..width * height).map(|i| (i % width, i / width)) {
                let place = (x / block) << 16 | (y / block);
                let number = npr_core::math::mix_bits(place ^ npr_core::math::mix_bits(seed));
                bitmap.set(x, y, number % 100 < percent);
            }
            // Polygons with corners on pixel edges' middles do not cross each other, so areas add up.
            let options = TraceOptions {
                turd_size: 0,
                alpha_max: 0.0,
                join_tolerance: None,
                ..TraceOptions::default()
            };
            let tracing = trace(&bitmap, &options);
            let mesh = FlatMesh::of_tracing(&tracing).expect("small");
            assert_sound(&mesh);
            let (mut rings, mut length) = (0.0, 0.0);
            for path in &tracing.paths {
                let ring = corners(&path.segments);
                let next = ring.iter().cycle().skip(1);
                let pairs = ring.iter().zip(next);
                length += pairs.map(|(a, b)| npr_vector::mesh_lines::run::distance(*a, *b)).sum::<f64>();
                rings += if path.is_ink { area(&ring).abs() } else { -area(&ring).abs() };
            }
            // Rounding moves each side by at most half a step of the grid; polygons may cross by slivers.
            let slack = length / FINENESS + 0.02 * rings.abs() + 0.05;
            prop_assert!((mesh_area(&mesh) - rings).abs() <= slack, "{} of {rings}", mesh_area(&mesh));
        }
    }

    #[test]
    fn files_hold_what_the_mesh_holds() {
        let mesh = triangulate(&[square(0.0, 0.0, 4.0)]).expect("one ring");
        let obj = String::from_utf8(mesh.write(MeshFormat::Obj)).expect("text");
        assert_eq!(
            (obj.matches("\nv ").count(), obj.matches("\nf ").count()),
            (4, 2)
        );
        let glb = mesh.write(MeshFormat::Glb);
        let length = u32::from_le_bytes([glb[8], glb[9], glb[10], glb[11]]);
        assert_eq!((length as usize, glb.len() % 4), (glb.len(), 0));
    }
}
