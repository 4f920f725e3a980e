//! Growing, leaning and bending: maps of the plane that whole lines of letters go through.

use super::setting::Setting;
use kurbo::{Affine, BezPath, CubicBez, Line, ParamCurve, PathEl, PathSeg, Point, QuadBez, Vec2};
use npr_core::math::tan_f64;
use std::f64::consts::PI;

/// Least bend: lines with less are straight.
const STRAIGHT: f64 = 1e-6;

/// Longest piece of a curve that is bent as one, in cap heights: a quarter stays within a thousandth.
const PIECE: f64 = 0.25;

/// Most pieces of one curve.
const PIECES_MAX: f64 = 64.0;

/// Grows, leans and bends lines that are centred on the origin, in this order.
pub(super) struct Warp {
    spread: f64,
    slant: f64,
    /// Half the width of the widest line.
    half_width: f64,
    arc: Option<Arc>,
}

/// The circle that the middle of all lines is laid on.
struct Arc {
    radius: f64,
    /// 1 where its centre lies below, -1 where above.
    side: f64,
}

impl Warp {
    /// The warp that a setting asks for around lines.
    pub(super) fn around<'a>(lines: impl Iterator<Item = &'a BezPath>, setting: &Setting) -> Self {
        let half = lines
            .map(reach_of)
            .fold(Vec2::ZERO, |a, b| Vec2::new(a.x.max(b.x), a.y.max(b.y)));
        let grown = half.y * (1.0 + setting.spread.abs());
        let wide = half.x * (1.0 + 0.5 * setting.spread.abs()) + setting.slant.abs() * grown;
        let bend = setting.bend.abs();
        let arc = (bend > STRAIGHT).then(|| Arc {
            radius: (2.0 * wide / (bend * PI)).max(grown + 1.0),
            side: setting.bend.signum(),
        });
        Self {
            spread: setting.spread,
            slant: setting.slant,
            half_width: half.x.max(1e-9),
            arc,
        }
    }

    /// Appends a line, mapped, to `out`.
    ///
    /// Where lines stay straight, so does every piece. An arc keeps the length of the baseline.
    pub(super) fn carry_path(&self, path: &BezPath, baseline: f64, out: &mut BezPath) {
        if self.arc.is_none() && self.spread == 0.0 {
            let lean = Affine::new([1.0, 0.0, -self.slant, 1.0, 0.0, 0.0]);
            out.extend(&(lean * path.clone()));
            return;
        }
        let mut here = Point::ORIGIN;
        let mut start = Point::ORIGIN;
        for element in path.elements() {
            match *element {
                PathEl::MoveTo(p) => {
                    out.move_to(self.carry(p, Vec2::ZERO, baseline).0);
                    (here, start) = (p, p);
                }
                PathEl::LineTo(p) => self.curve(PathSeg::Line(Line::new(here, p)), baseline, out),
                PathEl::QuadTo(a, p) => {
                    self.curve(PathSeg::Quad(QuadBez::new(here, a, p)), baseline, out);
                }
                PathEl::CurveTo(a, b, p) => {
                    self.curve(PathSeg::Cubic(CubicBez::new(here, a, b, p)), baseline, out);
                }
                PathEl::ClosePath => {
                    // The closing side is a line like others: it bends too.
                    if here != start {
                        self.curve(PathSeg::Line(Line::new(here, start)), baseline, out);
                    }
                    out.close_path();
                    here = start;
                }
            }
            here = element.end_point().unwrap_or(here);
        }
    }

    /// Appends a mapped curve: its pieces keep their ends and their directions there.
    fn curve(&self, curve: PathSeg, baseline: f64, out: &mut BezPath) {
        let cubic = curve.to_cubic();
        let length =
            cubic.p0.distance(cubic.p1) + cubic.p1.distance(cubic.p2) + cubic.p2.distance(cubic.p3);
        let count = (length / PIECE).ceil().clamp(1.0, PIECES_MAX);
        for i in 0..count as u32 {
            let at = |step: u32| f64::from(step) / count;
            let piece = cubic.subsegment(at(i)..at(i + 1));
            let (p0, leaving) = self.carry(piece.p0, piece.p1 - piece.p0, baseline);
            let (p3, coming) = self.carry(piece.p3, piece.p3 - piece.p2, baseline);
            out.curve_to(p0 + leaving, p3 - coming, p3);
        }
    }

    /// The image of a point, and that of a small step there.
    fn carry(&self, p: Point, step: Vec2, baseline: f64) -> (Point, Vec2) {
        // Grow: the scale runs linearly along the line, so its integral is the place.
        let rate = self.spread / self.half_width;
        let scale = 1.0 + rate * p.x;
        let x = p.x + 0.5 * rate * p.x * p.x - 0.5 * self.spread * self.half_width;
        let y = p.y * scale;
        let (dx, dy) = (scale * step.x, rate * p.y * step.x + scale * step.y);
        // Lean.
        let (x, dx) = (x - self.slant * y, dx - self.slant * dy);
        let Some(Arc { radius, side }) = self.arc else {
            return (Point::new(x, y), Vec2::new(dx, dy));
        };
        // Bend: lengths on the line's own baseline become lengths on its own circle.
        let own_radius = radius - side * baseline;
        let [cos, sin] = cos_sin(x / own_radius);
        let (reach, reach_step) = (radius - side * y, -side * dy);
        let along = reach * dx / own_radius;
        (
            Point::new(reach * sin, side * (radius - reach * cos)),
            Vec2::new(
                reach_step * sin + along * cos,
                side * (along * sin - reach_step * cos),
            ),
        )
    }
}

/// Greatest coordinates of a path along both axes, with its control points: all places that a map meets lie within.
fn reach_of(path: &BezPath) -> Vec2 {
    if path.is_empty() {
        return Vec2::ZERO;
    }
    let reach = path.control_box();
    Vec2::new(
        reach.x0.abs().max(reach.x1.abs()),
        reach.y0.abs().max(reach.y1.abs()),
    )
}

/// The turn by an angle in radians, counter-clockwise in a picture whose y runs down.
pub(super) fn turned(angle: f64) -> Affine {
    let [cos, sin] = cos_sin(angle);
    Affine::new([cos, -sin, sin, cos, 0.0, 0.0])
}

/// Cosine and sine from the tangent of half the angle, the same on every platform.
fn cos_sin(angle: f64) -> [f64; 2] {
    let t = tan_f64(0.5 * angle);
    let square = t * t;
    if !square.is_finite() {
        return [-1.0, 0.0];
    }
    [(1.0 - square) / (1.0 + square), 2.0 * t / (1.0 + square)]
}
