//! Smoke as spheres, beside or without a model.

use crate::placement::{Bounds, around};
use glam::Vec3;
use npr_core::camera::{Camera, bounds_of};
use npr_core::smoke::{REACH, Sphere};
use npr_smoke::Puffs;
use npr_stylesheet::{SmokeMethod, SmokeStyle};

/// Smoke as spheres, beside or without a model.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Smoke {
    /// The puffs; their order is their identity. Radius 0 for one that is not there.
    pub spheres: Vec<Sphere>,
    /// Lowest and highest corner of the space that smoke moves in, the same for all frames of a sequence, so that
    /// layers of depth stay where they are. `None` for the box around the spheres themselves.
    pub space: Option<([f32; 3], [f32; 3])>,
}

impl Smoke {
    /// Smoke of a single picture.
    pub fn new(spheres: Vec<Sphere>) -> Self {
        Self {
            spheres,
            space: None,
        }
    }

    /// The space given, or the box around the spheres.
    pub fn bounds(&self) -> Bounds {
        self.space.unwrap_or_else(|| self.extent())
    }

    /// The box around the spheres that are drawn; a unit box without any.
    pub fn extent(&self) -> Bounds {
        let corners = self.spheres.iter().filter(is_drawn).flat_map(|sphere| {
            let (center, reach) = (Vec3::from(sphere.center), Vec3::splat(sphere.radius));
            [center - reach, center + reach]
        });
        bounds_of(corners)
    }

    /// The spheres of a moment. Heat is still the temperature of the volume: see [`with_hottest`](Self::with_hottest).
    ///
    /// Spheres that grow from nothing or shrink away are left out while they are tiny; published ones are drawn at
    /// any size.
    pub fn of_puffs(puffs: &Puffs) -> Self {
        // Find the largest sphere, which the others are compared with.
        let spheres = puffs.spheres();
        let largest = match puffs {
            Puffs::Cover(_) => spheres
                .iter()
                .map(|sphere| sphere.radius)
                .fold(0.0, f32::max),
            Puffs::Published(_) => 0.0,
        };

        // Leave out specks, and take temperature as heat.
        let drawn = spheres.into_iter().map(|sphere| Sphere {
            heat: sphere.temperature,
            ..Sphere::new(
                sphere.center.to_array(),
                if sphere.radius < largest * SPECK {
                    0.0
                } else {
                    sphere.radius
                },
            )
        });
        Self::new(drawn.collect())
    }

    /// The same with heat 1 for what is as hot as `hottest` and more, and in proportion below; no heat where nothing
    /// is hot.
    pub fn with_hottest(mut self, hottest: f32) -> Self {
        for sphere in &mut self.spheres {
            let share = sphere.heat / hottest;
            sphere.heat = if hottest > 0.0 && share.is_finite() {
                share.clamp(0.0, 1.0)
            } else {
                0.0
            };
        }
        self
    }

    /// The same, `scale` times as large, with the place `from` moved to `to`.
    pub fn moved(mut self, from: [f32; 3], to: [f32; 3], scale: f32) -> Self {
        let moved = |place: [f32; 3]| std::array::from_fn(|i| to[i] + (place[i] - from[i]) * scale);
        for sphere in &mut self.spheres {
            sphere.center = moved(sphere.center);
            sphere.radius *= scale;
        }
        self.space = self.space.map(|(low, high)| (moved(low), moved(high)));
        self
    }

    /// Both smokes together, the spheres of `other` after those of this one; in the box around both spaces.
    pub fn with(mut self, other: Self) -> Self {
        if self.spheres.is_empty() || other.spheres.is_empty() {
            let is_other = self.spheres.is_empty() && !other.spheres.is_empty();
            return if is_other { other } else { self };
        }
        self.space = match (self.space, other.space) {
            (None, None) => None,
            _ => Some(around(self.bounds(), other.bounds())),
        };
        self.spheres.extend(other.spheres);
        self
    }

    /// A view of all spheres from three quarters above, for a frame of width / height `aspect`; `fov_y` is in radians.
    pub fn framing(&self, aspect: f32, fov_y: f32) -> Camera {
        Camera::framing_points(self.reach().map(|point| point.to_array()), aspect, fov_y)
    }

    /// Points all over the spheres that are drawn, for framing.
    pub(crate) fn reach(&self) -> impl Iterator<Item = Vec3> + '_ {
        let directions =
            (0..27).map(|i| Vec3::new((i % 3) as f32, (i / 3 % 3) as f32, (i / 9) as f32));
        let directions: Vec<Vec3> = directions
            .filter_map(|corner| (corner - 1.0).try_normalize())
            .collect();
        self.spheres
            .iter()
            .filter(is_drawn)
            .flat_map(move |sphere| {
                let center = Vec3::from(sphere.center);
                let points = directions.iter().map(|d| center + *d * sphere.radius);
                points.collect::<Vec<_>>()
            })
    }

    /// The spheres as a style draws them: in their own sizes, or all in their mean one.
    pub(crate) fn styled(&self, style: &SmokeStyle) -> Vec<Sphere> {
        let mut spheres = self.spheres.clone();
        if style.method == SmokeMethod::Billboards {
            let drawn = || {
                spheres
                    .iter()
                    .filter(|s| s.radius > 0.0 && s.radius < REACH)
            };
            let sum: f64 = drawn().map(|s| f64::from(s.radius)).sum();
            let mean = (sum / drawn().count().max(1) as f64) as f32;
            for sphere in spheres.iter_mut().filter(|s| s.radius > 0.0) {
                sphere.radius = mean;
            }
        }
        spheres
    }
}

/// Share of the largest radius under which a sphere is a speck of dirt rather than a puff.
const SPECK: f32 = 0.06;

/// Whether anything of a sphere can be seen.
fn is_drawn(sphere: &&Sphere) -> bool {
    let is_near = sphere.center.iter().all(|x| x.abs() < REACH);
    sphere.radius > 0.0 && sphere.radius < REACH && is_near
}
