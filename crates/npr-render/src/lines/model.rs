//! A scene prepared for line drawings.

use super::assembly::Assembly;
use super::colors::{ColorInput, StrokeColors};
use super::expression::{Expression, curve_of};
use super::film::HeldLines;
use super::finder::{Finder, OnProcessor};
use super::options::{LineModelOptions, LineOptions};
use super::paint::Paint;
use super::prepared::PreparedOnDemand;
use super::recent::RecentViews;
use super::smoke::SmokeView;
use super::stroke_contrast::StrokeContrast;
use super::texture_map::TextureMap;
use super::view::{LineView, notices_of_view};
use super::welded::{Built, Posables, build, check_budget, colors_of, mark_materials, notices_of};
use super::why::{Watch, WidthStep, nobody};
use super::widths::{ShapeBends, WidthInput, Widths};
use super::{colors, image, paint, pixels, smoke, widths};
use crate::brushes::Brushes;
use crate::error::RenderError;
use crate::file_light::{self, FileLight};
use crate::frame::Frame;
use crate::kept::{Cache, input_of};
use crate::look;
use crate::manners::StrokeManners;
use crate::movement::Movement;
use crate::options::{Picture, check_size};
use crate::part_info::PartInfo;
use crate::pictures::Pictures;
use crate::placement::{self, Bounds};
use crate::smoke::Smoke;
use glam::{DVec3, Vec3};
use npr_core::budget::{Budget, OverBudget};
use npr_core::camera::Camera;
use npr_core::crease::CreaseFrom;
use npr_core::interrupt::Interrupt;
use npr_core::line_source::LineSource;
use npr_core::texture::TextureStore;
use npr_drawing::artwork::StrokeBrushes;
use npr_drawing::pressure::Pressure;
use npr_mesh::half_edge::HalfEdgeMesh;
use npr_scene::Scene;
use npr_stylesheet::{DepthSpace, Look, Style};
use npr_vector::hold::Ends;
use npr_vector::mesh_lines::bvh::FaceTree;
use npr_vector::mesh_lines::contour::EdgeContours;
use npr_vector::mesh_lines::draw::{
    FindCrossings, LineSettings, PointPaint, Prepared, StrokeLook, ViewStrokes, eye_of,
};
use npr_vector::mesh_lines::intersect::{Crossings, crossings};
use npr_vector::mesh_lines::puff::SilhouettePoint;
use npr_vector::mesh_lines::run::RunPoint;
use npr_vector::mesh_lines::{DrawnBetween, JointsInView, Tip};
use npr_vector::project::Projector;
use npr_vector::stroke::{Drawing, Kind, Stroke};
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// Most points of all strokes of a drawing together.
const POINT_LIMIT: u64 = 20_000_000;

/// A scene prepared for line drawings: one welded surface, whatever the camera and the style.
///
/// Lines come from the geometry alone: textures may colour them but hide nothing, so a cut-out leaf is drawn as the
/// card it lies on. Surfaces whose base colour is too transparent for pictures are left out.
///
/// A glTF file asks for lines of its own by the vertex attribute `_NPR_LINE` (an edge between two vertices above one
/// half), and by `"extras": {"npr": {"lines": true}}` in a material (wherever it meets another material). They are of
/// kind [`Kind::Marked`], and drawn whatever kinds are asked for. So are lines that a file has as geometry: linked
/// where two segments meet, hidden by the surfaces before them and shown where they lie on one (within
/// [`npr_vector::mesh_lines::polyline::TOUCH_SHARE`]).
#[derive(Debug)]
pub struct LineModel {
    pub(super) shape: HalfEdgeMesh,
    pub(super) parts: Vec<PartInfo>,
    /// Colour of every vertex of the shape; empty where the scene has no colours.
    pub(super) colors: Vec<u32>,
    pub(super) points: Vec<[f32; 3]>,
    pub(super) bounds: Bounds,
    /// The radius of the sphere around the bounds of the first pose, once there is another.
    pub(super) first_radius: Option<f32>,
    /// Where the vertices of the shape were in the first pose, once there is another.
    pub(super) first_positions: Option<Vec<[f32; 3]>>,
    /// What other poses need of the meshes.
    pub(super) posables: Posables,
    pub(super) cameras: Vec<(String, Camera)>,
    /// The lights of the file, for smoke.
    pub(super) lights: Vec<FileLight>,
    pub(super) smoke: Option<Smoke>,
    pub(super) notices: Vec<String>,
    pub(super) triangle_count: usize,
    /// Most bytes that a drawing may take.
    pub(super) memory_limit: u64,
    /// Where what is costly to prepare is kept.
    pub(super) cache: Cache,
    /// What was prepared last, for views to come.
    pub(super) prepared: Mutex<Option<(PreparedKey, Arc<Prepared>)>>,
    pub(super) recent: RecentViews,
    pub(super) bends: OnceLock<ShapeBends>,
    /// Where textures lie, for lines that take their colour from there.
    pub(super) map: Option<TextureMap>,
    /// What regions of each surface multiply their base colour by; empty where that is nothing.
    pub(super) fill_lights: Vec<[f32; 3]>,
    /// Pictures of styles, by name.
    pub(super) pictures: BTreeMap<String, Picture>,
}

/// What lines are prepared for: the cosines of the crease angles and the width of roundings, as bits, what these lie
/// between, and whether intersections are wanted.
pub(super) type PreparedKey = ([u32; 4], CreaseFrom, bool);

/// What a drawing is made of besides contours.
struct Wanted<'a> {
    camera: &'a Camera,
    style: &'a Style,
    options: &'a LineOptions,
    /// Smoke that hides lines, and has an outline.
    smoke: Option<&'a Smoke>,
    /// The style's pictures by name.
    pictures: &'a BTreeMap<String, Picture>,
    /// A picture of the scene without lines and background, for lines whose colours follow it.
    behind: Option<&'a Frame>,
    /// Where everything was before, where lines lag behind.
    movement: Option<&'a Movement>,
    /// Whether it is left open what is seen of lines, and with that where they thin out.
    is_open: bool,
    /// Sees strokes after every step that changes their widths.
    watch: Watch<'a>,
    /// Ends the work where it is raised.
    interrupt: &'a Interrupt,
}

impl LineModel {
    /// Prepares a scene: poses and joins its meshes, welds them, and finds what is beside every edge.
    ///
    /// O(n log n) in the number of triangles, on all threads.
    ///
    /// # Errors
    ///
    /// [`RenderError::TooMany`] where half-edges cannot be numbered, [`RenderError::Memory`] beyond the limit.
    pub fn new(scene: &Scene, options: &LineModelOptions) -> Result<Self, RenderError> {
        Self::of_assembly(scene, &Assembly::new(scene, None), options, None)
    }

    /// As [`LineModel::new`], without what a style makes beams of: light has no lines and hides none. Where the style
    /// colours lines by textures, these are kept too, and the scene's images have to be there. Cards that the style
    /// draws by their centres ([`CardLines::Centre`](npr_stylesheet::CardLines)) are so from here on, whatever style
    /// draws the model later. With a `folder` what is costly is kept there as by [`LineModel::cached`].
    ///
    /// # Errors
    ///
    /// As [`LineModel::new`].
    pub fn for_style(
        scene: &Scene,
        style: &Style,
        options: &LineModelOptions,
        folder: Option<&Path>,
    ) -> Result<Self, RenderError> {
        let assembly = Assembly::new(scene, Some(style));
        let mut model = Self::of_assembly(scene, &assembly, options, folder)?;
        let keeps_map = options.painted || colors::needs_map(style);
        model.lay_textures(scene, &assembly, (keeps_map, options.fills));
        model.draw_cards(style)?;
        model.note_card_offsets();
        Ok(model)
    }

    fn of_assembly(
        scene: &Scene,
        assembly: &Assembly,
        options: &LineModelOptions,
        folder: Option<&Path>,
    ) -> Result<Self, RenderError> {
        check_budget(assembly, options)?;
        Ok(Self {
            memory_limit: options.memory_limit,
            cache: Cache::of(folder),
            ..Self::of_shape(scene, assembly, build(assembly, options))
        })
    }

    /// The same with what is costly to prepare kept in `folder` between runs, as
    /// [`Model::cached`](crate::Model::cached) does: how surfaces bend, and where they cut through each other.
    ///
    /// # Errors
    ///
    /// As [`LineModel::new`]; none for the sake of the folder.
    pub fn cached(
        scene: &Scene,
        options: &LineModelOptions,
        folder: &Path,
    ) -> Result<Self, RenderError> {
        Self::of_assembly(scene, &Assembly::new(scene, None), options, Some(folder))
    }

    fn of_shape(scene: &Scene, assembly: &Assembly, built: Built) -> Self {
        let Built {
            mut shape,
            preparation,
            posables,
        } = built;
        mark_materials(&mut shape, &assembly.marked);
        let points = assembly.used_points();
        let bounds = npr_core::camera::bounds_of(points.iter().copied().map(Vec3::from));
        Self {
            parts: assembly.parts.clone(),
            colors: colors_of(&shape, assembly),
            bounds,
            first_radius: None,
            first_positions: None,
            posables,
            lights: file_light::of_scene(scene, bounds),
            smoke: None,
            points,
            cameras: placement::cameras_of(scene),
            notices: notices_of(scene, assembly, &preparation),
            triangle_count: assembly.triangle_count(),
            memory_limit: u64::MAX,
            cache: Cache::default(),
            prepared: Mutex::new(None),
            recent: RecentViews::default(),
            bends: OnceLock::new(),
            map: None,
            fill_lights: Vec::new(),
            pictures: BTreeMap::new(),
            shape,
        }
    }

    /// The lines that a camera sees.
    ///
    /// Line colours (`line.paint` with them, for every point of a stroke), width factors and whether a part has lines
    /// at all follow the style's rules; kinds and the crease angle are those of the options ([`LineOptions::of_style`]
    /// takes them from the style). Width source `texture` counts as full. Colours follow what lies behind lines only by
    /// [`LineRenderer::with_backdrop`](super::LineRenderer::with_backdrop), which draws a picture of it. Strokes of the
    /// same lines keep their ids from camera to camera. Of a scene out of sight the drawing is empty.
    ///
    /// The first drawing with a crease angle also prepares creases and, where they are wanted, intersections; every
    /// further one is O(faces + lines log lines), on all threads, with the same result for any number of them.
    ///
    /// # Errors
    ///
    /// [`RenderError`] for a frame without pixels or beyond 32768 a side, or more than 20 million points.
    pub fn draw(
        &self,
        camera: &Camera,
        style: &Style,
        options: &LineOptions,
    ) -> Result<Drawing, RenderError> {
        self.draw_next(camera, style, options, None)
    }

    /// As [`LineModel::draw`], for the next frame of a film: strokes run the way that they ran, have the ids and the
    /// texture coordinates that they had, and come in the same order, as far as they were there in the frame before.
    ///
    /// `held` has that frame, and this one afterwards; the first frame is that of [`LineModel::draw`]. Frames depend on
    /// all before them, so whoever draws a part of a film draws those before it, too.
    ///
    /// # Errors
    ///
    /// As [`LineModel::draw`].
    pub fn draw_held(
        &self,
        camera: &Camera,
        style: &Style,
        options: &LineOptions,
        held: &mut HeldLines,
    ) -> Result<Drawing, RenderError> {
        self.draw_next(camera, style, options, Some(held))
    }

    /// As [`LineModel::draw`], after a frame that the lines hold to, if any.
    fn draw_next(
        &self,
        camera: &Camera,
        style: &Style,
        options: &LineOptions,
        held: Option<&mut HeldLines>,
    ) -> Result<Drawing, RenderError> {
        // Within the threads that share the work, so that each step does not wait for one of them to wake.
        rayon::scope(|_| {
            let find = &mut OnProcessor;
            let seen = (camera, None);
            self.draw_with(seen, style, options, find, (held, None), &nobody)
        })
    }

    /// The brushes with which a style draws the lines of this model in files that have them
    /// ([`Paths::Stamps`](npr_drawing::artwork::Paths)), whatever its line method; none where all lines are a pen's.
    ///
    /// Stamps lie apart as in pictures of this size. O(texels of the brushes' images).
    ///
    /// # Errors
    ///
    /// [`RenderError::MissingPicture`] for a picture that was not [given](Self::set_pictures), [`RenderError::Brush`]
    /// for one that is no brush.
    pub fn brushes(
        &self,
        style: &Style,
        options: &LineOptions,
    ) -> Result<StrokeBrushes, RenderError> {
        let pictures = Pictures::new(style, &self.pictures)?;
        let [height, dpi, world_px] = self.px(options);
        let paper = look::spots_per_px(style, [height, dpi, 0.5 * world_px]);
        let mut textures = TextureStore::new();
        let laid = (paper, (|_| true) as fn(&Look<'_>) -> bool);
        let brushes = Brushes::new(&self.parts, style, &pictures, laid, &mut textures)?;
        let base_px = look::base_px(style, options.size[1], dpi, world_px);
        Ok(brushes.into_files(textures, base_px))
    }

    /// Gives the pictures that styles name in `line.paint.image` and `line.brush.image`, by these names.
    pub fn set_pictures(&mut self, pictures: BTreeMap<String, Picture>) {
        self.pictures = pictures;
    }

    /// Draws smoke with the scene from now on, or none.
    ///
    /// Smoke is outlined by [`SmokeStyle::line`](npr_stylesheet::SmokeStyle), as strokes of kind [`Kind::Contour`] on a
    /// surface `smoke`: exact arcs of its spheres, where nothing lies behind them or smoke far enough behind, as
    /// thick as in pictures. Billboards and the published line have these outlines too. Scene and smoke hide each
    /// other's lines; smoke of opacity below 0.5 hides none. Fills are the tones of pictures, traced, in the colours
    /// of the style's `smoke.ramp`. [`LineModel::bounds`] and [`LineModel::framing`] take it in.
    pub fn set_smoke(&mut self, smoke: Option<Smoke>) {
        self.smoke = smoke;
        let points = self.points.iter().copied().map(Vec3::from);
        let bounds = npr_core::camera::bounds_of(points);
        self.bounds = smoke::joined(self.smoke.as_ref(), bounds, self.points.is_empty());
    }

    /// As [`LineModel::draw`], with lines that `find` finds, a picture of what lies behind them, the frame before, and
    /// where everything was before.
    pub(super) fn draw_with(
        &self,
        (camera, behind): (&Camera, Option<&Frame>),
        style: &Style,
        options: &LineOptions,
        find: &mut dyn Finder,
        (held, movement): (Option<&mut HeldLines>, Option<&Movement>),
        watch: Watch<'_>,
    ) -> Result<Drawing, RenderError> {
        let wanted = Wanted {
            camera,
            style,
            options,
            smoke: self.smoke.as_ref(),
            pictures: &self.pictures,
            behind,
            movement,
            is_open: false,
            watch,
            interrupt: &Interrupt::NEVER,
        };
        self.draw_some(&wanted, (find, held), |_| true)
    }

    /// The lines of the parts whose style asks for curves that are found as `options` says; smoke hides none of them.
    /// Where it `is_open` what is seen of them, all are there, but for those of rounded edges: nothing would tell them
    /// from a contour beside them.
    pub(crate) fn draw_curves(
        &self,
        camera: &Camera,
        style: &Style,
        (options, is_open): (&LineOptions, bool),
        pictures: &BTreeMap<String, Picture>,
        (find, (held, movement)): (&mut dyn Finder, (Option<&mut HeldLines>, Option<&Movement>)),
        (watch, interrupt): (Watch<'_>, &Interrupt),
    ) -> Result<Drawing, RenderError> {
        let is_curve = |look: &Look<'_>| look.line_method.source() == Some(options.method);
        let folds_alone = LineOptions {
            crease_round: 0.0,
            ..*options
        };
        let wanted = Wanted {
            camera,
            style,
            options: if is_open { &folds_alone } else { options },
            smoke: None,
            pictures,
            behind: None,
            movement,
            is_open,
            watch,
            interrupt,
        };
        self.draw_some(&wanted, (find, held), is_curve)
    }

    /// The lines of the parts for whose look `has_lines` is true.
    fn draw_some(
        &self,
        wanted: &Wanted<'_>,
        (find, held): (&mut dyn Finder, Option<&mut HeldLines>),
        has_lines: impl Fn(&Look<'_>) -> bool,
    ) -> Result<Drawing, RenderError> {
        let Wanted {
            camera,
            style,
            options,
            smoke,
            pictures,
            behind,
            movement,
            is_open,
            watch,
            interrupt,
        } = *wanted;
        interrupt.check()?;
        check_size(options.size)?;
        let is_empty = self.points.is_empty();
        let bounds = smoke::joined(smoke, self.bounds, is_empty);
        let projector = Projector::new(camera, options.size, bounds);
        let prepared = PreparedOnDemand::new(self, options);
        // A picture of lines finds its own contours.
        let contours = if options.method == LineSource::Potrace && smoke.is_none() {
            EdgeContours::default()
        } else {
            // Errors come again when it is asked for.
            let meanwhile = || drop(prepared.get());
            find.contours(&self.shape, &eye_of(&self.shape, &projector), &meanwhile)?
        };
        let smoke_layer = match smoke {
            Some(smoke) => Some(self.smoke_view(wanted, smoke, &projector, bounds)?),
            None => None,
        };
        let width_at = |point: &SilhouettePoint| {
            smoke_layer
                .as_ref()
                .map_or(0.0, |smoke_layer| smoke_layer.width_at(point))
        };
        let smoke_lines = smoke_layer
            .as_ref()
            .map(|smoke_layer| smoke_layer.lines(&width_at));
        let colors = match colors::is_painted(style) {
            true => Some(self.colors(wanted, prepared.get()?, &contours, pictures)?),
            false => None,
        };
        let stroke_contrast = match behind {
            Some(picture) => {
                let seen = (&self.shape, &prepared.get()?.tree);
                let px = self.px(options);
                StrokeContrast::new(seen, &projector, picture, &self.parts, style, px)
            }
            None => None,
        };
        let view = LineView {
            shape: &self.shape,
            map: self.map.as_ref(),
            memory_limit: self.memory_limit,
            camera,
            projector: &projector,
            contours: &contours,
            bounds,
            smoke: smoke_lines.as_ref(),
            colors: colors.as_ref(),
            changes: stroke_contrast.is_some(),
            is_open,
            interrupt,
            recent: &self.recent,
        };
        let surfaces = &self.shape.surfaces;
        let paint = Paint::new((&self.parts, surfaces), style, has_lines).filled(
            &self.fill_lights,
            &self.parts,
            style,
        );
        let mut held = held.map(|held| held.of(options.method));
        let known = held
            .as_mut()
            .map(|held| held.strokes.in_view(&self.shape, &projector));
        let was_between = |tips: &[Tip; 2]| match &known {
            Some(known) => known.between(tips),
            None => DrawnBetween::Nothing,
        };
        let joints = held
            .as_mut()
            .map(|held| held.joints.in_view(&self.shape, &projector, &was_between));
        let ViewStrokes {
            mut strokes,
            left_out,
        } = self.strokes(&prepared, &view, (style, options), &paint, (find, joints))?;
        interrupt.check()?;
        watch(WidthStep::Source, &strokes);
        paint.apply(&mut strokes);
        watch(WidthStep::Part, &strokes);
        if let (Some(held), Some(known)) = (&mut held, known) {
            let ends = match options.method.is_of_pixels() {
                true => Ends::Stay,
                false => Ends::Grow,
            };
            (held.strokes).hold_to(known, &mut strokes, (&self.shape, &projector), ends);
        }
        if let Some(stroke_contrast) = stroke_contrast {
            stroke_contrast.apply(&mut strokes, &|surface| paint.line_color(surface));
        }
        check_points(&strokes)?;
        let regions = if options.fill {
            paint::regions(
                &self.shape,
                &prepared.get()?.tree,
                &projector,
                options.size,
                &strokes,
                smoke_layer.as_ref(),
            )?
        } else {
            Vec::new()
        };
        if let Some(movement) = movement.filter(|_| !options.method.is_of_pixels()) {
            let view = (camera, style, options.size);
            self.smear(&mut strokes, (movement, &projector), view);
            watch(WidthStep::Motion, &strokes);
        }
        interrupt.check()?;
        let manners = StrokeManners::new(&self.parts, style);
        let manner_of = |stroke: &Stroke| {
            let is_of_part = (stroke.surface as usize) < self.parts.len();
            is_of_part.then(|| manners.number_of(stroke))
        };
        let depth = self.pressure_over_depth(style, &projector);
        let expression = Expression::new((style, options), &manners, self.px(options), &depth);
        let expression = match is_open {
            true => expression.before_sight(),
            false => expression,
        };
        let expression = expression.guided(self.guides(style, &projector));
        let expression = match held.is_some() {
            true => expression.held(),
            false => expression,
        };
        let drawn = held.map(|held| &mut held.drawn);
        expression.draw(&mut strokes, options.size, manner_of, (drawn, watch))?;
        check_points(&strokes)?;
        let mut surfaces = paint.into_surfaces(&self.parts);
        let object_number = surfaces.iter().map(|s| s.object_number + 1).max();
        if let Some(smoke_layer) = smoke_layer {
            surfaces.extend(smoke_layer.surfaces(object_number.unwrap_or(0)));
        }
        Ok(Drawing {
            size: options.size,
            surfaces,
            strokes,
            regions,
            notices: notices_of_view(prepared.so_far(), left_out),
        })
    }

    /// What lengths are resolved with: the height of the picture and pixels per inch, and about how many pixels a unit
    /// covers.
    fn px(&self, options: &LineOptions) -> [f32; 3] {
        let height = options.size[1] as f32;
        [height, options.dpi, height / self.radius()]
    }

    /// What all strokes are pressed by in a view, however a part is drawn.
    fn pressure_over_depth(&self, style: &Style, projector: &Projector) -> Pressure {
        let width = &style.line.width;
        let depth = &width.depth;
        let counted = depth.space.counted([depth.near, depth.far], self.radius());
        let (low, high) = self.bounds;
        let middle = [0, 1, 2].map(|i| 0.5 * (f64::from(low[i]) + f64::from(high[i])));
        let start = match depth.space {
            DepthSpace::Model => projector.depth(DVec3::from(middle)),
            DepthSpace::World => 0.0,
        };
        Pressure {
            along: curve_of(&[]),
            depth: curve_of(&depth.curve),
            range: counted.map(|from_start| start + f64::from(from_start)),
        }
    }

    /// Colours along strokes, lit as in pictures but without beams and shadows.
    fn colors<'a>(
        &'a self,
        wanted: &Wanted<'a>,
        prepared: &'a Prepared,
        contours: &'a EdgeContours,
        pictures: &'a BTreeMap<String, Picture>,
    ) -> Result<StrokeColors<'a>, RenderError> {
        let input = ColorInput {
            shape: &self.shape,
            infos: &self.parts,
            vertex_colors: &self.colors,
            map: self.map.as_ref(),
            lights: &self.lights,
            pictures,
            bounds: self.bounds,
            style: wanted.style,
        };
        let normals = prepared.corner_normals(&self.shape);
        let size = wanted.options.size;
        StrokeColors::new(input, normals, &contours.front, wanted.camera, size)
    }

    /// Smoke as a view sees it, lit as in pictures but without beams.
    fn smoke_view<'a>(
        &self,
        wanted: &Wanted<'a>,
        smoke: &Smoke,
        projector: &Projector,
        bounds: Bounds,
    ) -> Result<SmokeView<'a>, RenderError> {
        SmokeView::new(
            smoke,
            (wanted.style, wanted.options),
            (wanted.camera, projector, bounds),
            (&self.lights, wanted.pictures),
            self.parts.len() as u32,
        )
    }

    fn strokes(
        &self,
        prepared: &PreparedOnDemand<'_>,
        view: &LineView<'_>,
        (style, options): (&Style, &LineOptions),
        paint: &Paint,
        (find, joints): (&mut dyn Finder, Option<JointsInView<'_>>),
    ) -> Result<ViewStrokes, RenderError> {
        // Trace lines from a picture of them, and measure how the shape bends while a device does.
        let radius = self.radius();
        let bends = || {
            widths::follow_bends(style).then(|| {
                self.bends
                    .get_or_init(|| ShapeBends::new(&self.cache, &self.shape, radius))
            })
        };
        let traced = match options.method {
            LineSource::Potrace => {
                let meanwhile = || {
                    bends();
                };
                Some(pixels::traced(view, options, paint, find, &meanwhile)?)
            }
            LineSource::Image | LineSource::Edges | LineSource::Surface => None,
        };

        // Settle the widths of lines in this view.
        let input = WidthInput {
            shape: &self.shape,
            bends: bends(),
            colors: &self.colors,
            style,
            projector: view.projector,
        };
        let of_frame = view.camera.view(options.size, self.bounds);
        let outline = look::outline(style, radius, options.size[1], options.dpi, 0);
        let widths = Widths::new(input, &of_frame, outline);

        // Settle which lines are drawn, and how their points are painted.
        let settings = LineSettings {
            size: options.size,
            kinds: options.kinds.bits(),
            method: options.method,
            smooth: options.smooth,
            hidden: options.hidden,
            split: options.split,
            memory_limit: self.memory_limit,
        };
        let paint_at = |kind: Kind, surface: u32, point: &RunPoint| match view.colors {
            Some(colors) => colors.paint_at(kind, surface, point),
            None => PointPaint {
                color: None,
                width: 1.0,
            },
        };
        let look = StrokeLook {
            width_at: &|vertex| widths.at(vertex),
            paint_at: (view.changes || view.colors.is_some()).then_some(&paint_at),
            is_lit: colors::is_lit(style),
            follows_bends: widths::follow_bends(style),
        };
        let line = (&settings, paint, &look);

        // Find the strokes by the method, and those painted in textures.
        let mut found = match traced {
            Some(traced) => ViewStrokes {
                strokes: pixels::strokes(view, prepared, &traced, (&settings, &look))?,
                left_out: 0,
            },
            None if options.method == LineSource::Image => view.of_mesh(
                prepared.get()?,
                &image::beside_image(&settings),
                &look,
                None,
            )?,
            None => view.of_mesh(prepared.get()?, &settings, &look, joints)?,
        };
        if options.method == LineSource::Image || options.painted.is_some() {
            let of_image = image::strokes(view, prepared.get()?, options, line)?;
            found.strokes.extend(of_image);
        }
        Ok(found)
    }

    /// What does not depend on the camera, made anew only where the crease angle or the wish for intersections changes.
    pub(super) fn prepared(&self, options: &LineOptions) -> Result<Arc<Prepared>, RenderError> {
        let creases = options.creases(self.radius());
        let is_on_mesh = !options.method.is_of_pixels();
        let with_crossings = is_on_mesh && options.kinds.has(Kind::Intersection);
        let lengths = [
            creases.cos,
            creases.weak_cos,
            creases.hard_cos,
            creases.round,
        ]
        .map(f32::to_bits);
        let key = (lengths, creases.from, with_crossings);
        let mut last = self.prepared.lock().unwrap_or_else(PoisonError::into_inner);
        match &*last {
            Some((of, prepared)) if *of == key => Ok(Arc::clone(prepared)),
            _ => {
                let find: &FindCrossings<'_> = &|tree| self.crossings(tree);
                let find = with_crossings.then_some(find);
                let made = Prepared::with_crossings(&self.shape, creases, find);
                let prepared = Arc::new(made?);
                *last = Some((key, Arc::clone(&prepared)));
                Ok(prepared)
            }
        }
    }

    /// Where surfaces cut through each other, kept where there is a folder.
    fn crossings(&self, tree: &FaceTree) -> Result<Crossings, OverBudget> {
        let shape = &self.shape;
        let input = || {
            let mut hash = input_of("crossings");
            hash.positions(&shape.positions);
            hash.numbers(shape.faces.as_flattened());
            hash.numbers(&shape.face_surfaces);
            hash.numbers(&shape.edge_sides);
            let objects = shape.surfaces.iter().flat_map(|s| [s.object, s.material]);
            hash.numbers(&objects.collect::<Vec<u32>>());
            hash
        };
        let of_rows = |rows: Vec<u32>| Crossings::from_rows(&rows, shape);
        let make = || crossings(shape, tree, &mut Budget::new(self.memory_limit));
        self.cache.value(input, of_rows, Crossings::to_rows, make)
    }

    /// The smoke that is drawn with the scene.
    pub(crate) fn smoke(&self) -> Option<&Smoke> {
        self.smoke.as_ref()
    }

    /// The welded surface in the world that lines are drawn of.
    pub fn shape(&self) -> &HalfEdgeMesh {
        &self.shape
    }

    placement::accessors!();

    /// Radius of the sphere around the bounds, in the world; at least a tiny number. Other poses than the first one
    /// leave it as it is, so that what a style measures in radii does not pulse.
    pub fn radius(&self) -> f32 {
        self.first_radius
            .unwrap_or_else(|| placement::radius_of(self.bounds))
    }

    /// Number of triangles, counted for every instance, as the file has them.
    pub fn triangle_count(&self) -> usize {
        self.triangle_count
    }
}

fn check_points(strokes: &[Stroke]) -> Result<(), RenderError> {
    let points = strokes.iter().map(|stroke| stroke.points.len() as u64);
    check_count(points.sum())
}

/// Refuses more points of strokes than a drawing may have.
pub(super) fn check_count(count: u64) -> Result<(), RenderError> {
    if count > POINT_LIMIT {
        return Err(RenderError::TooMany {
            what: "points of strokes",
            limit: POINT_LIMIT,
        });
    }
    Ok(())
}
