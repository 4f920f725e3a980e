//! Drawn lines as single strokes along their middle, with the width of their ink.
//!
//! Outlines ([`crate::trace`]) go around a line on both sides; this goes along it once. Each stage is a function usable alone:
//! [`despeckle`] takes out specks and pinholes, [`thin`] leaves lines one pixel thin, [`Network::of`] makes a network of
//! them, [`Network::cut_spurs`] and [`Network::join_junctions`] take out what thinning adds, [`link`] makes strokes that
//! run straight through junctions, and each is measured across its ink and made smooth. [`centrelines`] does it all. What comes out is
//! a [`crate::stroke::Drawing`] for the writers of lines by [`Centrelines::drawing`].
//!
//! ```
//! use npr_vector::centreline::{CentrelineOptions, centrelines};
//! use npr_vector::trace::Bitmap;
//!
//! // A cross of two lines, three pixels wide.
//! let mut bitmap = Bitmap::new(40, 40)?;
//! for (x, y) in (0..1600).map(|i| (i % 40, i / 40)) {
//!     let inside = |v: u32| (4..36).contains(&v);
//!     let is_line = (18..21).contains(&x) && inside(y) || (18..21).contains(&y) && inside(x);
//!     bitmap.set(x, y, is_line);
//! }
//! let found = centrelines(&bitmap, &CentrelineOptions::default());
//! assert_eq!((found.strokes.len(), found.junctions.len()), (2, 1));
//! assert!(found.strokes.iter().all(|stroke| (stroke.points[5].width - 3.0).abs() < 0.01));
//! # Ok::<(), npr_vector::trace::BitmapError>(())
//! ```

mod calm;
mod corner;
mod crossing;
mod despeckle;
mod distance;
mod file;
mod link;
mod measure;
mod network;
mod stroke;
#[cfg(test)]
mod tests;
mod thin;
mod tidy;

pub use despeckle::despeckle;
pub use distance::distance2;
pub use file::{write_centreline_geojson, write_centrelines};
pub(crate) use link::line as line_of;
pub use link::{Way, WayPoint, Ways, link};
pub use network::{Branch, Network, Node};
pub(crate) use stroke::smooth_border;
pub use thin::thin;

use crate::graph::{CurveGraph, CurveNode};
use crate::stroke::{Drawing, Kind, Stroke, StrokePoint, StrokeSurface};
use crate::trace::Bitmap;
use npr_core::geometry::NONE;
use rayon::prelude::*;

/// How centre lines are found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CentrelineOptions {
    /// Shapes and holes of up to so many pixels are left out.
    pub turd_size: u64,
    /// Branches that stick out of their line by less than this share of its width are cut: 0 keeps all, 0.5 cuts what rough
    /// edges and square ends make, 1 and more cuts short hairs too.
    pub spur: f64,
    /// Angle, in radians, up to which a stroke may turn where it goes on through a junction.
    pub link_turn: f64,
    /// Angle, in radians, from which a bend between straight sides is a corner.
    pub corner: f64,
}

impl Default for CentrelineOptions {
    fn default() -> Self {
        Self {
            turd_size: 2,
            spur: 0.5,
            link_turn: 0.8,
            corner: 0.7,
        }
    }
}

/// A point on the middle of a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CentrePoint {
    /// Pixels from the top left corner, y down; pixel centres lie at .5.
    pub place: [f64; 2],
    /// Whole width of the ink, in pixels.
    pub width: f64,
}

/// A drawn line.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct CentreStroke {
    /// About a pixel apart, at least two. Ends have round caps: the ink ends half a width beyond.
    pub points: Vec<CentrePoint>,
    /// The last point runs on to the first, which is not repeated.
    pub closed: bool,
    /// Whether it ends in nothing at its start and end, rather than on another stroke.
    pub free: [bool; 2],
}

/// The lines of a bitmap.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Centrelines {
    /// Width and height of the bitmap, in pixels.
    pub size: [u32; 2],
    /// All strokes.
    pub strokes: Vec<CentreStroke>,
    /// Places where strokes meet or cross.
    pub junctions: Vec<[f64; 2]>,
}

/// Finds the lines of a bitmap.
///
/// The same for any number of threads. Time grows with the pixels, a 64th of a step each, and with the length of lines times their width.
/// None where there is no ink.
pub fn centrelines(bitmap: &Bitmap, options: &CentrelineOptions) -> Centrelines {
    let ink = despeckle(bitmap, options.turd_size);
    let mut network = Network::of(&thin(&ink), &ink);
    network.cut_spurs(options.spur);
    network.join_junctions();
    let Ways { ways, junctions } = link(&network, options.link_turn);
    drop(network);
    Centrelines {
        size: [bitmap.width(), bitmap.height()],
        strokes: ways
            .par_iter()
            .map(|way| stroke::stroke(way, &ink, options.corner))
            .collect(),
        junctions: junctions
            .into_iter()
            .map(|place| place.to_array())
            .collect(),
    }
}

impl Centrelines {
    /// Number of ends of strokes that end in nothing; dots have none.
    pub fn end_count(&self) -> usize {
        let lines = self.strokes.iter().filter(|stroke| {
            let ends = stroke.points.first().zip(stroke.points.last());
            let reach = ends.map_or(0.0, |(a, b)| crate::run::distance(a.place, b.place));
            !stroke.closed && (stroke.points.len() > 2 || reach > 4.0 * stroke::DOT_PX)
        });
        let free = lines.flat_map(|stroke| stroke.free);
        free.filter(|free| *free).count()
    }

    /// The same as nodes of the curve graph, for all that works on linked lines: one node a point, in order, once for every line.
    ///
    /// Points lie on no mesh: the `edge` of a node is its number among all points, where its place and width stand, and `face` is
    /// [`NONE`]. Pieces are [`CurveNode::MARKED`].
    pub fn graph(&self) -> (CurveGraph, Vec<CentrePoint>) {
        let mut graph = CurveGraph::default();
        for stroke in &self.strokes {
            let first = graph.nodes.len() as u32;
            let count = stroke.points.len() as u32;
            let at = |k: u32| {
                if stroke.closed {
                    first + k % count
                } else {
                    first + k
                }
            };
            graph.nodes.extend((0..count).map(|k| CurveNode {
                edge: first + k,
                t: 0.0,
                next: if stroke.closed || k + 1 < count {
                    at(k + 1)
                } else {
                    NONE
                },
                prev: if stroke.closed || k > 0 {
                    at(k + count - 1) - u32::from(!stroke.closed) * count
                } else {
                    NONE
                },
                flags: CurveNode::MARKED,
                face: NONE,
            }));
        }
        let points = self
            .strokes
            .iter()
            .flat_map(|stroke| stroke.points.iter().copied());
        (graph, points.collect())
    }

    /// The same as a drawing for files: black strokes of kind [`Kind::Marked`], numbered in order.
    ///
    /// Places in the world are those in the picture, in pixels; depth is 0.
    pub fn drawing(&self) -> Drawing {
        let strokes = self.strokes.iter().zip(0..).map(|(stroke, id)| {
            let mut u = 0.0;
            let mut before = None;
            let points = stroke.points.iter().map(|point| {
                u += before
                    .replace(point.place)
                    .map_or(0.0, |p| crate::run::distance(p, point.place));
                let [x, y] = point.place;
                StrokePoint {
                    position: point.place,
                    width: point.width,
                    u,
                    world: [x as f32, y as f32, 0.0],
                    ..StrokePoint::default()
                }
            });
            Stroke {
                id,
                kind: Kind::Marked,
                occluders: 0,
                surface: 0,
                closed: stroke.closed,
                points: points.collect(),
            }
        });
        Drawing {
            size: self.size,
            surfaces: vec![StrokeSurface {
                object: "lines".to_owned(),
                line_color: [0, 0, 0, 255],
                fill_color: [255; 4],
                ..StrokeSurface::default()
            }],
            strokes: strokes.collect(),
            ..Drawing::default()
        }
    }
}
