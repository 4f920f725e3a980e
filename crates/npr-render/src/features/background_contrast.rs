//! Background contrast: which subjects a scene has, by which rules the colours of their outlines follow what lies
//! behind them, and the passes that find both sides of every outline.

use super::line_features::LineFeatures;
use crate::frame_graph::{FrameGraph, Grids, Layers, size_if, write};
use crate::part_info::PartInfo;
use npr_core::window::{View, Window};
use npr_gpu::engine::{EngineError, Session};
use npr_gpu::graph::ResourceId;
use npr_gpu::pass::Format;
use npr_gpu::passes::backdrop;
use npr_style::backdrop::{
    BIAS_REACH_MOST, ContrastBias, PartSubject, RULES_MAX, Rim, Rule, Rules, SMOOTH_MOST, TILE,
    TileRims,
};
use npr_style::compose::Compose;
use npr_stylesheet::{BackgroundMethod, Style, Subjects};
use std::collections::BTreeMap;

/// Greatest distance from an outline, in frame pixels, at which its line may still follow the background.
const REACH_MOST: f32 = 64.0;

/// Frame pixels beyond a line's half width over which its rule fades out.
const FADE_PX: f32 = 3.0;

/// Length of the stretches that decide together whether their lines turn darker or brighter, as a multiple of the
/// length over which colours are blended.
const BIAS_OF_SMOOTH: f32 = 12.0;

/// The subject whose parts are the background of all others.
const BACKGROUND: &str = "background";

/// What the parts of one subject have in common.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
enum SubjectKey<'a> {
    /// The name that a rule gives.
    Named(&'a str),
    /// They have no name, and the whole scene is one subject.
    Scene,
    /// Their node: at the top of the tree, or the object's own.
    Node(u32),
}

/// The subjects and rules of a scene in a style.
#[derive(Debug, Clone, Default)]
pub(crate) struct BackgroundContrast {
    /// One for every part.
    pub part_subjects: Vec<PartSubject>,
    rules: [Rule; RULES_MAX],
    /// Whether any part follows a rule.
    pub is_on: bool,
    /// What was done in another way than asked.
    pub notice: Option<String>,
}

impl BackgroundContrast {
    /// Numbers the subjects and rules of `part_count` parts; those beyond the model's own, `infos`, are background.
    pub fn needs(infos: &[PartInfo], style: &Style, part_count: usize) -> Self {
        let mut made = Self::default();
        let mut subjects = BTreeMap::new();
        let mut rule_count = 1;
        for info in infos {
            // Number the subject of the part, 0 for the background.
            let look = info.look(style);
            let key = match look.subject {
                Some(name) => SubjectKey::Named(name),
                None => match style.line.background.subjects {
                    Subjects::Scene => SubjectKey::Scene,
                    Subjects::Root => SubjectKey::Node(info.root),
                    Subjects::Object => SubjectKey::Node(info.object),
                },
            };
            let next = subjects.len() as u32 + 1;
            let subject = match key == SubjectKey::Named(BACKGROUND) || look.beam.is_some() {
                true => 0,
                false => *subjects.entry(key).or_insert(next),
            };

            // Number the rule that its outlines follow, 0 for none.
            let contrast = look.line_background.method != BackgroundMethod::Off && look.line_on;
            let rule = match contrast && subject != 0 {
                true => made.number_of(look.line_background.rule(), &mut rule_count),
                false => 0,
            };
            made.is_on |= rule != 0;
            made.part_subjects.push(PartSubject { subject, rule });
        }
        made.part_subjects
            .resize(part_count, PartSubject::default());
        made
    }

    /// The number of a rule, which is added to the list if it is new.
    fn number_of(&mut self, rule: Rule, count: &mut usize) -> u32 {
        if let Some(found) = (1..*count).find(|i| self.rules[*i] == rule) {
            return found as u32;
        }
        if *count == RULES_MAX {
            let most = RULES_MAX - 1;
            self.notice = Some(format!(
                "lines mind the background by at most {most} different rules; more are drawn by the last"
            ));
            return most as u32;
        }
        self.rules[*count] = rule;
        *count += 1;
        *count as u32 - 1
    }

    /// The rules of a frame whose widest line is `half_width` to each side, in pixels, with `samples` a pixel along
    /// each axis.
    pub fn rules(
        &self,
        style: &Style,
        features: LineFeatures,
        half_width: f32,
        px: [f32; 3],
        samples: u32,
    ) -> Rules {
        let background = &style.line.background;
        let [height_px, dpi, world_px] = px;
        let smooth = background.smooth.to_px(height_px, dpi, world_px);
        // A hull lies outside of its shape with its whole width.
        let width = if features.hull { 2.0 } else { 1.0 } * half_width;
        let whole_px = (width + 1.0).min(REACH_MOST - FADE_PX);
        let bit = |bit: u32, when: bool| if when { bit } else { 0 };
        let layers = Rules::ALWAYS
            | bit(Rules::RIBBONS, features.layers & Compose::RIBBONS != 0)
            | bit(
                Rules::OVERLAY,
                features.layers & Compose::OVERLAY != 0 && !features.rim,
            );
        Rules {
            rules: self.rules,
            smooth_px: smooth.min(SMOOTH_MOST as f32),
            bias_px: (BIAS_OF_SMOOTH * smooth).min((BIAS_REACH_MOST * TILE) as f32),
            whole_px,
            reach_px: (whole_px + FADE_PX).ceil() as u32,
            hold: background.hold,
            fade: 1.0 / background.fade.max(1.0),
            samples,
            within: bit(layers, self.rules.iter().any(|rule| rule.within != 0)),
        }
    }
}

/// The passes that find both sides of outlines, in a frame where some follow the background; else placeholders.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ContrastPasses {
    pub rules: ResourceId,
    /// Colours of the subject beside its outline, and of what lies behind.
    sides: [ResourceId; 2],
    borders: Option<Borders>,
}

/// What the host fills where borders between subjects are found.
#[derive(Debug, Clone, Copy)]
struct Borders {
    /// The grid of tiles over the output.
    tile_window: ResourceId,
    /// Settings of the picture without lines.
    bare_compose: ResourceId,
    part_subjects: ResourceId,
    /// Whether lines turned darker or brighter in the frame before, a bias per tile.
    kept_biases: ResourceId,
}

impl ContrastPasses {
    /// The resources that the last pass reads, whether borders are found or not.
    pub fn inputs(
        frame: &mut FrameGraph,
        grids: &Grids,
        part_count: usize,
        features: LineFeatures,
    ) -> Self {
        let graph = &mut frame.graph;
        let is_on = features.rim || features.contrast;
        let sides = size_if(is_on, grids.output);
        let tiles = grids.output.map(|side| side.div_ceil(TILE));
        let tile_count = tiles[0] as usize * tiles[1] as usize;
        Self {
            rules: graph.uniform::<Rules>("rules"),
            sides: ["fronts", "backs"].map(|name| graph.image(name, Format::Rgba8, sides)),
            borders: is_on.then(|| Borders {
                tile_window: graph.uniform::<Window>("tile window"),
                bare_compose: graph.uniform::<Compose>("bare compose"),
                part_subjects: graph.buffer::<PartSubject>("part subjects", part_count),
                kept_biases: graph.buffer::<ContrastBias>("kept biases", tile_count),
            }),
        }
    }

    /// Adds passes that draw the picture without lines near borders between subjects, and find in it the colours on
    /// both sides of lines; gives the pictures of both sides.
    pub fn plan(
        &self,
        frame: &mut FrameGraph,
        grids: &Grids,
        features: LineFeatures,
        layers: &Layers,
    ) -> [ResourceId; 2] {
        let Some(borders) = &self.borders else {
            return self.sides;
        };
        let pixels = grids.output_pixels();
        let tiles = grids.output.map(|side| side.div_ceil(TILE));
        let tile_count = tiles[0] as usize * tiles[1] as usize;
        let [ids, depths] = frame.ids_without_hulls(grids, features.hull);
        let graph = &mut frame.graph;
        let busy = graph.image("busy", Format::Rgba8, tiles);
        let bare = graph.buffer::<u32>("bare", pixels);
        let rims = graph.buffer::<Rim>("rims", pixels);
        let smoothed = graph.buffer::<Rim>("smoothed rims", pixels);
        let columns = graph.buffer::<u32>("columns", pixels);
        let gathered = graph.buffer::<TileRims>("gathered", tile_count);
        let [bounds, biases, blended] = ["bounds", "biases", "blended biases"]
            .map(|name| graph.buffer::<ContrastBias>(name, tile_count));
        let (window, rules) = (frame.output_window, self.rules);

        // Draw the picture without lines, in the tiles that hold borders between subjects.
        let flag = [
            borders.tile_window,
            window,
            rules,
            ids,
            frame.triangles,
            borders.part_subjects,
        ];
        graph.draw(&backdrop::FLAG_TILES, &flag, &[busy], true);
        frame.compose_frame(borders.bare_compose, ids, layers, [busy; 2], bare);

        // Find the pixels beside outlines, and what is the subject and what the background there.
        let find = [
            window,
            rules,
            ids,
            depths,
            frame.ids,
            busy,
            layers.ribbons,
            frame.triangles,
            frame.parts,
            borders.part_subjects,
            bare,
            frame.frame,
            rims,
        ];
        frame.graph.compute(&backdrop::FIND_RIMS, &find);
        let graph = &mut frame.graph;
        if features.rim {
            let draw = [frame.parts, rims, frame.frame];
            graph.compute(&backdrop::DRAW_RIMS, &draw);
        }
        graph.compute(&backdrop::SMOOTH_RIMS, &[window, rules, rims, smoothed]);

        // Decide tile by tile whether lines turn darker or brighter.
        let gather = [window, rules, frame.parts, smoothed, gathered];
        graph.compute(&backdrop::GATHER_TILES, &gather);
        graph.compute(&backdrop::BOUND_TILES, &[window, rules, gathered, bounds]);
        let bias = [window, rules, gathered, bounds, borders.kept_biases, biases];
        graph.compute(&backdrop::VOTE_BIAS, &bias);
        let blend = [window, rules, biases, borders.kept_biases, blended];
        graph.compute(&backdrop::BLEND_BIASES, &blend);

        // Spread the colours of both sides over the width of lines.
        graph.compute(&backdrop::SPREAD_ROWS, &[window, rules, smoothed, columns]);
        let spread = [window, rules, smoothed, columns, blended];
        graph.draw(&backdrop::SPREAD_RIMS, &spread, &self.sides, true);
        self.sides
    }

    /// Hands over the subject and the rule of every part.
    pub fn upload(
        &self,
        session: &mut dyn Session,
        contrast: &BackgroundContrast,
    ) -> Result<(), EngineError> {
        let Some(borders) = &self.borders else {
            return Ok(());
        };
        write(session, borders.part_subjects, &contrast.part_subjects)
    }

    /// Hands over the rules of a frame, and the settings of the picture without lines.
    pub fn upload_view(
        &self,
        session: &mut dyn Session,
        rules: Rules,
        compose: &Compose,
    ) -> Result<(), EngineError> {
        write(session, self.rules, &[rules])?;
        let Some(borders) = &self.borders else {
            return Ok(());
        };
        let lines = Compose::RIBBONS | Compose::OVERLAY | Compose::BACKDROP;
        let bare = Compose {
            flags: compose.flags & !lines | Compose::BARE,
            ..*compose
        };
        write(session, borders.bare_compose, &[bare])
    }

    /// Hands over the grid of tiles over the `size` pixels of an output tile at `corner_px`.
    pub fn upload_tile(
        &self,
        session: &mut dyn Session,
        view: &View,
        corner_px: [f32; 2],
        size: [u32; 2],
    ) -> Result<(), EngineError> {
        let Some(borders) = &self.borders else {
            return Ok(());
        };
        let tiles = size.map(|side| side.div_ceil(TILE));
        let covered = tiles.map(|count| (count * TILE) as f32);
        let window = Window::over(view.frame_px, corner_px, covered, tiles);
        write(session, borders.tile_window, &[window])
    }
}
