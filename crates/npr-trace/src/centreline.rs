//! Drawn lines as single strokes along their middle, with the width of their ink.
//!
//! Outlines ([`crate::trace()`]) go around a line on both sides; this goes along it once. Each stage is a function
//! usable alone: [`despeckle`] takes out specks and pinholes, [`thin`] leaves lines one pixel thin, [`Network::of`]
//! makes a network of them, [`Network::cut_spurs`] and [`Network::join_junctions`] take out what thinning adds,
//! [`link`] makes strokes that run straight through junctions, and each is measured across its ink and made smooth.
//! [`centrelines`] does it all. The crate `npr-drawing` writes them as files.
//!
//! ```
//! use npr_trace::centreline::{CentrelineOptions, centrelines};
//! use npr_trace::Bitmap;
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
//! # Ok::<(), npr_trace::BitmapError>(())
//! ```

mod calm;
mod centre_stroke;
mod corner;
mod crossing;
mod despeckle;
mod distance;
mod link;
mod measure;
mod network;
mod stroke;
#[cfg(test)]
mod tests;
mod thin;
mod tidy;

pub use centre_stroke::{CentrePoint, CentreStroke};
pub use despeckle::despeckle;
pub use distance::distance2;
pub use link::{Way, WayPoint, Ways, line as line_of, link};
pub use network::{Branch, Network, Node};
pub use stroke::smooth_border;
pub use thin::thin;

use crate::Bitmap;
use glam::DVec2;
use rayon::prelude::*;

/// How centre lines are found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CentrelineOptions {
    /// Shapes and holes of up to so many pixels are left out.
    pub turd_size: u64,
    /// Branches that stick out of their line by less than this share of its width are cut: 0 keeps all, 0.5 cuts what
    /// rough edges and square ends make, 1 and more cuts short hairs too.
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
/// The same for any number of threads. Time grows with the pixels, a 64th of a step each, and with the length of
/// lines times their width. None where there is no ink.
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
            let reach = ends.map_or(0.0, |(a, b)| {
                DVec2::from(a.place).distance(DVec2::from(b.place))
            });
            !stroke.closed && (stroke.points.len() > 2 || reach > 4.0 * stroke::DOT_PX)
        });
        let free = lines.flat_map(|stroke| stroke.free);
        free.filter(|free| *free).count()
    }
}
