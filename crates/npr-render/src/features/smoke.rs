//! Smoke in a frame: its settings and its passes.

use crate::error::RenderError;
use crate::frame_graph::{pixel_count, size_if, write};
use crate::hatching::TILE_RADII;
use crate::light::ChosenLights;
use crate::placement::{Bounds, radius_of};
use crate::smoke::Smoke;
use glam::Vec3;
use npr_core::camera::Camera;
use npr_core::smoke::{SmokePixel, Sphere, SphereView, ViewSphere};
use npr_core::window::{View, Window};
use npr_gpu::engine::{EngineError, Session};
use npr_gpu::graph::{Graph, ResourceId};
use npr_gpu::pass::Format;
use npr_gpu::passes::smoke;
use npr_style::compose::Compose;
use npr_style::lighting::Lights;
use npr_style::shadow::SHADOW_SIDE;
use npr_style::smoke::{SmokeLook, pen};
use npr_stylesheet::{SmokeLines, SmokeMethod, SmokeStyle, Style, Unit};

/// The sizes that lengths of a style are resolved with.
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

    /// Number of cells of the grids that tones are smoothed on, enough for any camera: lengths in the world may need
    /// the finest.
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

    /// Distance in pixels within which other smoke changes a pixel: the margin of tiles.
    pub fn reach_px(&self, style: &SmokeStyle) -> f32 {
        let line = style.line.width.to_px(self.height_px, self.dpi, 0.0);
        4.0 * self.sigma_px(style, 0.0) + 2.0 * line
    }

    /// Settings of a frame: `bounds` is the space of the smoke, `lights` what it is lit by.
    ///
    /// `surface_maps` is the number of lights whose pictures hold surfaces.
    pub fn look(
        &self,
        style: &Style,
        lens: &SphereView,
        bounds: Bounds,
        lights: &Lights,
        surface_maps: u32,
    ) -> SmokeLook {
        let smoke = &style.smoke;

        // Measure how deep the smoke lies, and how many pixels a unit of the world covers there.
        let center = (Vec3::from(bounds.0) + Vec3::from(bounds.1)) * 0.5;
        let radius = radius_of(bounds);
        let depth = (center - Vec3::from(lens.eye_world)).dot(Vec3::from(lens.forward_world));
        let world_px = 1.0 / lens.pixel_at(depth.max(lens.near)).max(1e-20);

        // Cut its space into layers of depth.
        let layers = smoke.layers as f32;
        let range = match smoke.layer_depth > 0.0 {
            true => smoke.layer_depth,
            false => 2.0 * radius / layers,
        };

        // Take over the settings of the style, lengths in pixels.
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

        // Draw numbers of tones and outlines in place of colours where the last pass finishes the smoke.
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
    compose: &mut Compose,
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

/// The smoke of a frame: its lights, and its resources and passes.
#[derive(Debug, Clone)]
pub(crate) struct SmokePasses {
    measure: Measure,
    chosen: ChosenLights,
    /// Lights of the scene whose pictures of surfaces throw shadows on the smoke; 0 for smoke with lights of its own.
    surface_maps: u32,
    lens: ResourceId,
    look: ResourceId,
    lights: ResourceId,
    light_lenses: Vec<ResourceId>,
    light_window: ResourceId,
    spheres: ResourceId,
    /// Most spheres.
    most: usize,
    balls: ResourceId,
    /// Numbers of the nearest spheres, plus one; 0 without smoke.
    pub ids: ResourceId,
    /// Smoothed tones, 0..1.
    pub tones: ResourceId,
    colors: ResourceId,
    depths: ResourceId,
    /// What the lights see of the smoke, a layer each.
    light_ids: ResourceId,
    light_depths: ResourceId,
}

/// Smoke as one camera sees it, in a style.
#[derive(Clone, Copy)]
pub(crate) struct SmokeMoment<'a> {
    pub smoke: &'a Smoke,
    pub style: &'a Style,
    pub camera: &'a Camera,
    pub view: &'a View,
    /// The box of all that is drawn.
    pub bounds: Bounds,
}

impl SmokePasses {
    /// Adds the resources and passes of smoke of at most `most` spheres to a graph, for a picture on the grid of
    /// `window`, lit by `chosen`.
    ///
    /// `surfaces` has the depths of what the scene's lights see of it, a layer each, of which `surface_maps` count.
    pub fn plan(
        graph: &mut Graph,
        (measure, chosen): (Measure, ChosenLights),
        (style, most): (&SmokeStyle, usize),
        window: ResourceId,
        (surfaces, surface_maps): (ResourceId, u32),
    ) -> Self {
        // Give every light with shadows a picture; without any, there is one of a single texel.
        let light_count = chosen.smoke_shadow_count();
        let light_size = size_if(light_count > 0, [style.shadow_px; 2]);
        let layers = light_count.max(1) as u32;
        let pixels = pixel_count(measure.size);
        let light_lenses = (0..light_count).map(|_| graph.uniform::<SphereView>("light lens"));
        let passes = Self {
            light_lenses: light_lenses.collect(),
            lens: graph.uniform::<SphereView>("lens"),
            look: graph.uniform::<SmokeLook>("smoke look"),
            lights: graph.uniform::<Lights>("smoke lights"),
            light_window: graph.uniform::<Window>("light window"),
            spheres: graph.buffer::<Sphere>("spheres", most),
            balls: graph.buffer::<ViewSphere>("balls", most),
            ids: graph.image("smoke ids", Format::U32, measure.size),
            tones: graph.buffer::<f32>("smoke tones", pixels),
            colors: graph.image("smoke colors", Format::Rgba8, measure.size),
            depths: graph.image("smoke depths", Format::U32, measure.size),
            light_ids: graph.layered_image("smoke lights", Format::U32, light_size, layers),
            light_depths: graph.layered_image("smoke shadows", Format::Depth, light_size, layers),
            measure,
            chosen,
            surface_maps,
            most,
        };

        // Draw the spheres as the lights see them, then as the eye does.
        passes.draw_for_lights(graph);
        passes.draw(graph, style, window, surfaces);
        passes
    }

    /// Draws what the lights see; one list of projected spheres serves them all in turn.
    fn draw_for_lights(&self, graph: &mut Graph) {
        for (layer, lens) in (0..).zip(&self.light_lenses) {
            let project = [*lens, self.spheres, self.balls];
            graph.compute(&smoke::PROJECT_SPHERES, &project);
            let bound = [self.light_window, *lens, self.balls];
            let targets = [self.light_ids.layer(layer), self.light_depths.layer(layer)];
            graph.draw(&smoke::DRAW_SPHERES, &bound, &targets, true);
        }
    }

    fn draw(
        &self,
        graph: &mut Graph,
        style: &SmokeStyle,
        window: ResourceId,
        surfaces: ResourceId,
    ) {
        let pixels = pixel_count(self.measure.size);
        let cells = self.measure.cell_count(style);
        let id_depths = graph.image("smoke id depths", Format::Depth, self.measure.size);
        let shaded = graph.buffer::<SmokePixel>("smoke pixels", pixels);

        // Draw and light the nearest spheres.
        graph.compute(
            &smoke::PROJECT_SPHERES,
            &[self.lens, self.spheres, self.balls],
        );
        let bound = [window, self.lens, self.balls];
        graph.draw(&smoke::DRAW_SPHERES, &bound, &[self.ids, id_depths], true);
        let shade = [
            window,
            self.lens,
            self.look,
            self.lights,
            self.ids,
            self.spheres,
            self.balls,
            shaded,
            self.light_ids,
            surfaces,
        ];
        graph.compute(&smoke::SHADE_SPHERES, &shade);

        // Smooth their tones among those of one layer of depth.
        let gathered = graph.buffer::<[f32; 2]>("gathered tones", cells);
        let blurred = graph.buffer::<[f32; 2]>("blurred tones", cells);
        graph.compute(&smoke::GATHER_TONES, &[window, self.look, shaded, gathered]);
        graph.compute(&smoke::BLUR_ROWS, &[self.look, gathered, blurred]);
        graph.compute(&smoke::BLUR_COLUMNS, &[self.look, blurred, gathered]);
        graph.compute(
            &smoke::SMOOTH_TONES,
            &[window, self.look, shaded, gathered, self.tones],
        );

        // Paint tones and outlines.
        let bound = [
            window, self.lens, self.look, self.ids, self.balls, shaded, self.tones,
        ];
        let targets = [self.colors, self.depths];
        // Every texel is written, so none is cleared first.
        graph.draw(&smoke::RESOLVE_PICTURE, &bound, &targets, false);
    }

    /// The resources of smoke that the last pass binds; placeholders without smoke.
    pub fn composed(passes: Option<&Self>, graph: &mut Graph) -> [ResourceId; 3] {
        let Some(passes) = passes else {
            return [
                graph.image("no smoke", Format::Rgba8, [1, 1]),
                graph.image("no smoke depths", Format::U32, [1, 1]),
                graph.image("no smoke shadows", Format::Depth, [1, 1]),
            ];
        };
        [passes.colors, passes.depths, passes.light_depths]
    }

    /// Lights the smoke by others, of which as many shine and throw shadows.
    pub fn relight(&mut self, chosen: ChosenLights) {
        self.chosen = chosen;
    }

    /// Refuses smoke of more spheres than were planned.
    pub fn check(passes: Option<&Self>, smoke: &Smoke) -> Result<(), RenderError> {
        let limit = passes.map_or(0, |passes| passes.most);
        if smoke.spheres.len() > limit {
            return Err(RenderError::TooMany {
                what: "spheres",
                limit: limit as u64,
            });
        }
        Ok(())
    }

    /// Hands over the spheres.
    pub fn upload(
        &self,
        session: &mut dyn Session,
        smoke: &Smoke,
        style: &SmokeStyle,
    ) -> Result<(), EngineError> {
        let mut spheres = smoke.styled(style);
        spheres.resize(self.most, Sphere::default());
        let side_px = [style.shadow_px as f32; 2];
        let window = Window::over(side_px, [0.0; 2], side_px, [style.shadow_px; 2]);
        write(session, self.light_window, &[window])?;
        write(session, self.spheres, &spheres)
    }

    /// Hands over how a camera sees the smoke, and its lights.
    pub fn upload_view(
        &self,
        session: &mut dyn Session,
        moment: &SmokeMoment<'_>,
    ) -> Result<(), EngineError> {
        let SmokeMoment {
            smoke,
            style,
            camera,
            view,
            bounds,
        } = *moment;

        // Settle the lens, the lights and the look of the smoke in this view.
        let lens = lens_of(view, &style.smoke);
        let extent = Some(smoke.extent());
        let lights = self.chosen.of_frame(style, bounds, extent, camera, view);
        let space = smoke.bounds();
        let look = self
            .measure
            .look(style, &lens, space, &lights, self.surface_maps);

        // Hand them over, with a lens for every light that throws shadows.
        write(session, self.lens, &[lens])?;
        write(session, self.look, &[look])?;
        write(session, self.lights, &[lights])?;
        for (id, matrix) in self.light_lenses.iter().zip(&lights.shadows) {
            let light = SphereView::of_light(matrix, style.smoke.shadow_px);
            write(session, *id, &[light])?;
        }
        Ok(())
    }

    /// Whether its shadows fall on surfaces: where its lights are those of the scene, and the style wants it.
    pub fn shades_surfaces(&self, style: &SmokeStyle) -> bool {
        self.surface_maps > 0 && style.casts
    }
}
