//! Lines drawn twice: ink beside other ink that runs the same or the opposite way.

use super::ink::{Bins, Curve, InkPoint};

/// Two lines nearer than this, and near parallel, are one drawn twice.
const DOUBLE_PX: f64 = 3.0;

/// Cosine of the angle over which two near lines are parallel.
const PARALLEL: f64 = 0.9;

/// Share of ink of `curves` that lies double.
pub fn double_share(ink: &[InkPoint], curves: &[Curve]) -> f64 {
    let is_double = is_double(ink, curves);
    let twice: f64 = ink.iter().filter(|p| is_double(p)).map(|p| p.length).sum();
    let all: f64 = ink.iter().map(|point| point.length).sum();
    if all > 0.0 { twice / all } else { 0.0 }
}

/// Where ink of `curves` lies double.
pub fn double_places(ink: &[InkPoint], curves: &[Curve]) -> impl Iterator<Item = [f64; 2]> {
    let is_double = is_double(ink, curves);
    ink.iter()
        .filter(move |point| is_double(point))
        .map(|point| point.at)
}

/// Tells ink near other ink that runs the same or the opposite way; on one line only where it comes back later.
fn is_double(ink: &[InkPoint], curves: &[Curve]) -> impl Fn(&InkPoint) -> bool {
    let bins = Bins::new(ink.iter().map(|point| point.at).collect(), DOUBLE_PX);
    let lengths: Vec<f64> = curves.iter().map(Curve::length).collect();
    move |point| {
        bins.near(point.at, DOUBLE_PX).any(|(other, _)| {
            let other = &ink[other];
            let cosine = point.along[0] * other.along[0] + point.along[1] * other.along[1];
            let curve = point.curve as usize;
            let apart = (point.travelled - other.travelled).abs();
            let apart = if curves[curve].closed {
                apart.min(lengths[curve] - apart)
            } else {
                apart
            };
            cosine.abs() > PARALLEL && (other.curve != point.curve || apart > 4.0 * DOUBLE_PX)
        })
    }
}
