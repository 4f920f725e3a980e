//! Smoke in a frame: what the passes of smoke need, and where they stand in the graph.

use crate::error::RenderError;
use crate::hatching::TILE_RADII;
use crate::placement::{Bounds, radius_of};
use glam::Vec3;
use npr_core::camera::Camera;
use npr_core::camera::bounds_of;
use npr_core::smoke::{REACH, SmokePixel, Sphere, SphereView, ViewSphere};
use npr_core::window::{View, Window};
use npr_gpu::graph::{Graph, ResourceId};
use npr_gpu::pass::Format;
use npr_gpu::passes::smoke;
use npr_smoke::Puffs;
use npr_style::lighting::Lights;
use npr_style::shadow::{SHADOW_SIDE, SHADOWS_MAX};
use npr_style::smoke::{SmokeLook, pen};
use npr_stylesheet::{SmokeLines, SmokeMethod, SmokeStyle, Style, Unit};

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
        let spheres = puffs.spheres();
        let largest = match puffs {
            Puffs::Cover(_) => spheres
                .iter()
                .map(|sphere| sphere.radius)
                .fold(0.0, f32::max),
            Puffs::Published(_) => 0.0,
        };
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

    /// Both together, the spheres of `other` after those of this one; in the box around both spaces.
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

/// The box around two.
pub(crate) fn around(a: Bounds, b: Bounds) -> Bounds {
    (
        std::array::from_fn(|i| a.0[i].min(b.0[i])),
        std::array::from_fn(|i| a.1[i].max(b.1[i])),
    )
}

/// Numbers that decide what smoke takes of a plan.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Needs {
    /// Most spheres.
    pub spheres: usize,
    /// Cells of the grids that tones are smoothed on.
    pub cells: usize,
    /// Lights whose shadows fall within the smoke.
    pub lights: usize,
    /// Texels of their pictures along a side.
    pub side: u32,
    /// Whether the scene's shadows fall on it.
    pub takes_shadows: bool,
    /// Output pixels.
    pub size: [u32; 2],
}

/// Frame heights and dots per inch that lengths of a style are resolved with.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Measure {
    pub height_px: f32,
    pub dpi: f32,
    /// Output pixels of a tile.
    pub size: [u32; 2],
    /// Samples per pixel along each axis.
    pub samples: u32,
}

impl Measure {
    /// Deviation in pixels that tones are smoothed with where a world unit is `world_px` pixels.
    fn sigma_px(&self, style: &SmokeStyle, world_px: f32) -> f32 {
        style.sigma.to_px(self.height_px, self.dpi, world_px)
    }

    /// Cells of the grids, for any camera: lengths in the world may need the finest.
    pub fn cell_count(&self, style: &SmokeStyle) -> usize {
        let finest = 4.0;
        let sigma = match style.sigma.unit {
            Unit::World => finest,
            _ => self.sigma_px(style, 1.0),
        };
        let mut look = SmokeLook {
            layers: style.layers,
            ..SmokeLook::default()
        };
        look.smooth(self.size, sigma);
        look.cell_count()
    }

    /// How far a pixel's smoke depends on those around, for tiles.
    pub fn reach_px(&self, style: &SmokeStyle) -> f32 {
        let line = style.line.width.to_px(self.height_px, self.dpi, 0.0);
        4.0 * self.sigma_px(style, 0.0) + 2.0 * line
    }

    /// Settings of a frame: `bounds` is the space of the smoke, `lights` what it is lit by.
    ///
    /// `surface_maps` says how many lights' pictures hold surfaces.
    pub fn look(
        &self,
        style: &Style,
        lens: &SphereView,
        bounds: Bounds,
        lights: &Lights,
        surface_maps: u32,
    ) -> SmokeLook {
        let smoke = &style.smoke;
        let center = (Vec3::from(bounds.0) + Vec3::from(bounds.1)) * 0.5;
        let radius = radius_of(bounds);
        let depth = (center - Vec3::from(lens.eye_world)).dot(Vec3::from(lens.forward_world));
        let world_px = 1.0 / lens.pixel_at(depth.max(lens.near)).max(1e-20);
        let layers = smoke.layers as f32;
        let range = match smoke.layer_depth > 0.0 {
            true => smoke.layer_depth,
            false => 2.0 * radius / layers,
        };
        let is_published = smoke.line.method == SmokeLines::Published;
        let is_flat = smoke.method == SmokeMethod::Billboards;
        let line = smoke.line.width.to_px(self.height_px, self.dpi, world_px);
        let mut look = SmokeLook {
            layers: smoke.layers,
            flags: flag(is_published || is_flat, SmokeLook::PUBLISHED)
                | flag(is_flat, SmokeLook::UNLIT),
            range_start: depth - range * layers * 0.5,
            range_size: range.max(1e-12),
            range_blend: smoke.layer_blend,
            softness: smoke.softness,
            heat: smoke.heat,
            wrap: smoke.wrap,
            line_px: if smoke.line.method == SmokeLines::Off {
                0.0
            } else {
                line.min(200.0)
            },
            line_inner: smoke.line.inner,
            line_from: smoke.line.jump,
            line_weight: if smoke.line.method == SmokeLines::Off {
                0.0
            } else {
                smoke.line.weight
            },
            depth_start: depth - radius,
            depth_size: 2.0 * radius,
            swell: smoke.line.swell,
            alpha: smoke.opacity,
            line_color: smoke.line.color.linear(),
            towards_light: towards_light(lights, lens, center),
            ambient: smoke.ambient,
            samples: self.samples,
            shadow_side: if smoke.shadow && lights.shadow_side > 0 {
                smoke.shadow_px
            } else {
                0
            },
            surface_maps,
            surface_side: SHADOW_SIDE,
            ramp: smoke.levels(),
            ..SmokeLook::default()
        };
        if smoke.is_finished_late() {
            let ([r, g, b], alpha) = (pen::OUTLINE, look.line_color[3]);
            (look.ramp, look.softness) = (pen::TONES, 0.5);
            look.line_color = [r, g, b, alpha];
        }
        look.smooth(self.size, self.sigma_px(smoke, world_px));
        look
    }
}

/// Tells the last pass that part `part` finishes the smoke, and hangs the sheet that strokes lie on in the middle of
/// its space.
///
/// Strokes move and grow with that place as the camera moves, so they neither swim through smoke that stands still
/// nor crawl over puffs that do not.
pub(crate) fn hang_sheet(
    compose: &mut npr_style::compose::Compose,
    part: u32,
    smoke: &Smoke,
    style: &SmokeStyle,
    view: &View,
) {
    let (lens, bounds) = (SphereView::of_view(view), smoke.bounds());
    let offset = (Vec3::from(bounds.0) + Vec3::from(bounds.1)) * 0.5 - Vec3::from(lens.eye_world);
    let [x, y, z] = [lens.right_world, lens.up_world, lens.forward_world]
        .map(|axis| offset.dot(Vec3::from(axis)));
    let depth = z.max(lens.near).max(1e-12);
    compose.smoke_part = part;
    compose.smoke_line = style.line.color.linear();
    compose.smoke_anchor_px = lens.frame_of([x, y, depth]).map(|px| px.clamp(-1e5, 1e5));
    compose.smoke_tiles = lens.pixel_at(depth) / (radius_of(bounds) * TILE_RADII);
}

fn flag(on: bool, bit: u32) -> u32 {
    if on { bit } else { 0 }
}

/// Towards the first light from the middle of the smoke, in axes of the picture; towards the eye without lights.
fn towards_light(lights: &Lights, lens: &SphereView, center: Vec3) -> [f32; 3] {
    if lights.count == 0 {
        return [0.0, 0.0, -1.0];
    }
    let towards = Vec3::from(lights.sources[0].towards(center.to_array()));
    [lens.right_world, lens.up_world, lens.forward_world].map(|axis| towards.dot(Vec3::from(axis)))
}

/// The eye of a frame as it looks at smoke.
pub(crate) fn lens_of(view: &View, style: &SmokeStyle) -> SphereView {
    SphereView {
        discs: f32::from(style.method == SmokeMethod::Billboards),
        ..SphereView::of_view(view)
    }
}

/// The resources of smoke that the host fills, and those that the last pass reads.
#[derive(Debug, Clone)]
pub(crate) struct SmokePlan {
    pub lens: ResourceId,
    pub look: ResourceId,
    pub lights: ResourceId,
    pub light_lenses: Vec<ResourceId>,
    pub light_window: ResourceId,
    pub spheres: ResourceId,
    balls: ResourceId,
    colors: ResourceId,
    depths: ResourceId,
    light_ids: [ResourceId; SHADOWS_MAX],
    light_depths: [ResourceId; SHADOWS_MAX],
}

impl SmokePlan {
    /// Adds the resources and passes of smoke to a graph, for a picture on the grid of `window`.
    ///
    /// `surfaces` are the depths of what the scene's lights see of it.
    pub fn new(
        graph: &mut Graph,
        needs: &Needs,
        window: ResourceId,
        surfaces: [ResourceId; SHADOWS_MAX],
    ) -> Self {
        let plan = Self::inputs(graph, needs);
        plan.draw_for_lights(graph);
        plan.draw(graph, needs, window, surfaces);
        plan
    }

    fn inputs(graph: &mut Graph, needs: &Needs) -> Self {
        let side = |i: usize| match i < needs.lights {
            true => [needs.side; 2],
            false => [1, 1],
        };
        Self {
            lens: graph.uniform::<SphereView>("lens"),
            look: graph.uniform::<SmokeLook>("smoke look"),
            lights: graph.uniform::<Lights>("smoke lights"),
            light_lenses: (0..needs.lights)
                .map(|_| graph.uniform::<SphereView>("light lens"))
                .collect(),
            light_window: graph.uniform::<Window>("light window"),
            spheres: graph.buffer::<Sphere>("spheres", needs.spheres),
            balls: graph.buffer::<ViewSphere>("balls", needs.spheres),
            colors: graph.image("smoke colors", Format::Rgba8, needs.size),
            depths: graph.image("smoke depths", Format::U32, needs.size),
            light_ids: std::array::from_fn(|i| graph.image("smoke light", Format::U32, side(i))),
            light_depths: std::array::from_fn(|i| {
                graph.image("smoke shadow", Format::Depth, side(i))
            }),
        }
    }

    /// What the lights see; one list of balls serves them all in turn.
    fn draw_for_lights(&self, graph: &mut Graph) {
        for (i, lens) in self.light_lenses.iter().enumerate() {
            let project = [*lens, self.spheres, self.balls];
            graph.compute(&smoke::PROJECT_SPHERES, &project);
            let bound = [self.light_window, *lens, self.balls];
            let targets = [self.light_ids[i], self.light_depths[i]];
            graph.draw(&smoke::DRAW_SPHERES, &bound, &targets, true);
        }
    }

    fn draw(
        &self,
        graph: &mut Graph,
        needs: &Needs,
        window: ResourceId,
        surfaces: [ResourceId; SHADOWS_MAX],
    ) {
        let pixel_count = needs.size[0] as usize * needs.size[1] as usize;
        let ids = graph.image("smoke ids", Format::U32, needs.size);
        let depths = graph.image("smoke id depths", Format::Depth, needs.size);
        let pixels = graph.buffer::<SmokePixel>("smoke pixels", pixel_count);
        let tones = graph.buffer::<f32>("smoke tones", pixel_count);
        graph.compute(
            &smoke::PROJECT_SPHERES,
            &[self.lens, self.spheres, self.balls],
        );
        let bound = [window, self.lens, self.balls];
        graph.draw(&smoke::DRAW_SPHERES, &bound, &[ids, depths], true);
        let shade = [
            window,
            self.lens,
            self.look,
            self.lights,
            ids,
            self.spheres,
            self.balls,
            pixels,
        ];
        let shade = [&shade[..], &self.light_ids, &surfaces].concat();
        graph.compute(&smoke::SHADE_SPHERES, &shade);
        let gathered = graph.buffer::<[f32; 2]>("gathered tones", needs.cells);
        let blurred = graph.buffer::<[f32; 2]>("blurred tones", needs.cells);
        graph.compute(&smoke::GATHER_TONES, &[window, self.look, pixels, gathered]);
        graph.compute(&smoke::BLUR_ROWS, &[self.look, gathered, blurred]);
        graph.compute(&smoke::BLUR_COLUMNS, &[self.look, blurred, gathered]);
        graph.compute(
            &smoke::SMOOTH_TONES,
            &[window, self.look, pixels, gathered, tones],
        );
        let bound = [window, self.lens, self.look, ids, self.balls, pixels, tones];
        let targets = [self.colors, self.depths];
        // Every texel is written, so none is cleared first.
        graph.draw(&smoke::RESOLVE_PICTURE, &bound, &targets, false);
    }

    /// What the last pass binds of smoke, whether there is any or not.
    pub fn composed(plan: Option<&Self>, graph: &mut Graph) -> [ResourceId; 2 + SHADOWS_MAX] {
        let Some(plan) = plan else {
            let depth = graph.image("no smoke shadow", Format::Depth, [1, 1]);
            return [
                graph.image("no smoke", Format::Rgba8, [1, 1]),
                graph.image("no smoke depths", Format::U32, [1, 1]),
                depth,
                depth,
                depth,
                depth,
            ];
        };
        let [a, b, c, d] = plan.light_depths;
        [plan.colors, plan.depths, a, b, c, d]
    }
}

/// Refuses more spheres than a stage was planned for.
pub(crate) fn check_count(count: usize, limit: usize) -> Result<(), RenderError> {
    if count > limit {
        return Err(RenderError::TooMany {
            what: "spheres",
            limit: limit as u64,
        });
    }
    Ok(())
}
