//! Which subjects a scene has, and by which rules their lines mind the background.

use crate::blueprint::Method;
use crate::frame::Frame;
use crate::model::PartInfo;
use npr_core::color::{linear_from_srgb, linear_rgba, srgb_from_linear, unpack_rgba8};
use npr_style::backdrop::{
    BIAS_REACH_MOST, ContrastCache, PartSubject, RULES_MAX, Rule, Rules, SMOOTH_MOST, TILE,
};
use npr_style::compose::Compose;
use npr_stylesheet::{BackgroundMethod, Style, Subjects};
use std::collections::BTreeMap;

/// Most frame pixels from an outline at which its line may still mind the background.
const REACH_MOST: f32 = 64.0;

/// Frame pixels over which the rule ends beyond a line's own half width.
const FADE_PX: f32 = 3.0;

/// How much longer the stretches are that decide together which way their lines move than those over which colours
/// are blended.
const BIAS_OF_SMOOTH: f32 = 12.0;

/// The subject whose parts are the background of all others.
const BACKGROUND: &str = "background";

/// What makes parts one subject.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
enum SubjectKey<'a> {
    /// The name that a rule gives.
    Named(&'a str),
    /// Everything else.
    Scene,
    /// A node: at the top of the tree, or an object's own.
    Node(u32),
}

/// The subjects and rules of a scene in a style.
#[derive(Debug, Clone, Default)]
pub(crate) struct Backdrop {
    /// One for every part.
    pub part_subjects: Vec<PartSubject>,
    rules: [Rule; RULES_MAX],
    /// Whether any part follows a rule.
    pub is_on: bool,
    /// What was done in another way than asked.
    pub notice: Option<String>,
}

impl Backdrop {
    /// Those of `part_count` parts; what follows a model's own parts, `infos`, is of the background.
    pub fn new(infos: &[PartInfo], style: &Style, part_count: usize) -> Self {
        let mut made = Self::default();
        let mut subjects = BTreeMap::new();
        let mut rule_count = 1;
        for info in infos {
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

    /// The number of a rule, which may be new.
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

    /// The rules of a frame whose widest line is `half_width` to each side, with `samples` a pixel along each axis.
    pub fn rules(
        &self,
        style: &Style,
        method: Method,
        half_width: f32,
        px: [f32; 3],
        samples: u32,
    ) -> Rules {
        let background = &style.line.background;
        let [height_px, dpi, world_px] = px;
        let smooth = background.smooth.to_px(height_px, dpi, world_px);
        // A hull lies outside of its shape with its whole width.
        let width = if method.hull { 2.0 } else { 1.0 } * half_width;
        let whole_px = (width + 1.0).min(REACH_MOST - FADE_PX);
        let bit = |bit: u32, when: bool| if when { bit } else { 0 };
        let layers = Rules::ALWAYS
            | bit(Rules::RIBBONS, method.layers & Compose::RIBBONS != 0)
            | bit(
                Rules::OVERLAY,
                method.layers & Compose::OVERLAY != 0 && !method.rim,
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

impl PartInfo {
    /// The node without a parent that node `object` hangs on.
    pub(crate) fn root_of(scene: &npr_scene::Scene, object: u32) -> u32 {
        let mut root = object;
        while let Some(parent) = scene.nodes.get(root as usize).and_then(|node| node.parent) {
            // A parent stands before its children, so this ends.
            if parent >= root {
                break;
            }
            root = parent;
        }
        root
    }
}

/// What lies on both sides of the lines of a frame, for lines that the host draws.
#[derive(Debug, Clone)]
pub(crate) struct Sides {
    /// The subject's colour with its weight in alpha, and that behind with the number of the rule, as bytes.
    pub fronts: Frame,
    pub backs: Frame,
}

impl Sides {
    pub fn new(size: [u32; 2]) -> Self {
        Self {
            fronts: Frame::new(size),
            backs: Frame::new(size),
        }
    }

    /// Lays lines over a frame, each in the colour that minds what lies behind it.
    ///
    /// Both are sRGB bytes with straight alpha; edges are blended in sRGB, as curves are everywhere.
    pub fn lay(&self, lines: &[u8], rules: &Rules, rgba: &mut [u8]) {
        let texels = |bytes: &'_ [u8]| -> Vec<[u8; 4]> {
            bytes
                .chunks_exact(4)
                .filter_map(|c| c.try_into().ok())
                .collect()
        };
        let (fronts, backs, lines) = (
            texels(&self.fronts.rgba),
            texels(&self.backs.rgba),
            texels(lines),
        );
        let sides = fronts.iter().zip(&backs);
        let mut contrast_cache = ContrastCache::default();
        for ((under, line), (front, back)) in rgba.chunks_exact_mut(4).zip(&lines).zip(sides) {
            if line[3] == 0 {
                continue;
            }
            let [r, g, b, alpha] = unpack_rgba8(u32::from_le_bytes(*line));
            let mut color = [r, g, b];
            if front[3] != 0 {
                let sides = [front, back].map(|texel| u32::from_le_bytes(*texel));
                let light_of = |texel| linear_rgba(unpack_rgba8(texel));
                let light =
                    contrast_cache.light(color.map(linear_from_srgb), sides, rules, light_of);
                color = light.map(srgb_from_linear);
            }
            blend(under, color, alpha);
        }
    }
}

/// Lays a colour over a texel of bytes with straight alpha.
fn blend(under: &mut [u8], color: [f32; 3], alpha: f32) {
    let [r, g, b, a] = under else { return };
    let below = f32::from(*a) / 255.0 * (1.0 - alpha);
    let whole = alpha + below;
    for (channel, over) in [r, g, b].into_iter().zip(color) {
        let mixed = (over * alpha + f32::from(*channel) / 255.0 * below) / whole.max(1e-6);
        *channel = (mixed.clamp(0.0, 1.0) * 255.0 + 0.5) as u8;
    }
    *a = (whole.clamp(0.0, 1.0) * 255.0 + 0.5) as u8;
}
