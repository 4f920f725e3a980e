//! Words of a style, set in their fonts and placed in a view.

use crate::error::RenderError;
use glam::{Mat4, Vec3};
use npr_core::window::View;
use npr_style::{Color, LetteringOutline, Style};
use npr_vector::lettering::{Band, Font, Lettered, Setting, Words, set_words};
use std::collections::BTreeMap;

/// Words of a style, set in their fonts: ready to be placed in any view.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Lettering {
    words: Vec<(npr_style::Lettering, Words)>,
    notices: Vec<String>,
}

impl Lettering {
    /// Sets the words of a style; `fonts` by the names that the style gives them.
    ///
    /// Words whose font is not among them are left out, and [`Lettering::notices`] tells.
    ///
    /// # Errors
    ///
    /// [`RenderError::Lettering`] for words beyond the limits and for fonts that break off.
    pub fn new(style: &Style, fonts: &BTreeMap<String, Font>) -> Result<Self, RenderError> {
        let mut lettering = Self::default();
        for (index, said) in style.lettering.iter().enumerate() {
            let Some(font) = fonts.get(&said.font) else {
                let notice = format!("lettering.{index} is left out: its font was not given");
                lettering.notices.push(notice);
                continue;
            };
            let words = set_words(font, &said.text, &setting_of(said))
                .map_err(|source| RenderError::Lettering { index, source })?;
            lettering.notices.extend(notice_of(index, &words.missing));
            lettering.words.push((said.clone(), words));
        }
        Ok(lettering)
    }

    /// Whether there is nothing to draw.
    pub fn is_empty(&self) -> bool {
        self.words.is_empty()
    }

    /// What is left out, for the user.
    pub fn notices(&self) -> &[String] {
        &self.notices
    }

    /// The words in a view, in pixels of its frame, the last on top; those anchored behind the eye are left out.
    pub fn placed(&self, view: &View, dpi: f32) -> Vec<Lettered> {
        let placed = self.words.iter().filter_map(|(said, words)| {
            let (middle, world_px) = place_of(said, view)?;
            let px = |length: npr_style::Length| {
                f64::from(length.to_px(view.frame_px[1], dpi, world_px))
            };
            let band = |band: &LetteringOutline| Band {
                color: bytes_of(band.color),
                width_px: px(band.width),
            };
            let bands: Vec<Band> = said.bands().map(band).collect();
            let middle = middle.map(f64::from);
            Some(Lettered {
                text: said.text.clone(),
                marks: words.marks(middle, px(said.size), bytes_of(said.color), &bands),
            })
        });
        placed.filter(|words| !words.marks.is_empty()).collect()
    }
}

fn bytes_of(color: Color) -> [u8; 4] {
    [color.r, color.g, color.b, color.a]
}

fn setting_of(said: &npr_style::Lettering) -> Setting {
    Setting {
        bend: f64::from(said.bend),
        slant: f64::from(said.slant),
        spread: f64::from(said.spread),
        spacing: f64::from(said.spacing),
        line_step: f64::from(said.line_step),
        turn: f64::from(said.rotate_deg).to_radians(),
    }
}

fn notice_of(index: usize, missing: &[char]) -> Option<String> {
    let names: Vec<String> = missing.iter().map(|c| format!("'{c}'")).collect();
    (!names.is_empty()).then(|| {
        format!(
            "lettering.{index}: the font lacks {}, which is left out",
            names.join(", ")
        )
    })
}

/// Where the middle of words lies in the frame, and how many pixels a unit of the scene covers there.
fn place_of(said: &npr_style::Lettering, view: &View) -> Option<([f32; 2], f32)> {
    let Some(anchor) = said.anchor else {
        let middle = std::array::from_fn(|i| said.at[i] * view.frame_px[i]);
        return Some((middle, 0.0));
    };
    let anchor = Vec3::from(anchor);
    let depth = (anchor - Vec3::from(view.eye_world)).dot(Vec3::from(view.forward_world));
    // A parallel view has no eye that anything could be behind.
    let is_before = depth > 0.0;
    if view.perspective > 0.5 && !is_before {
        return None;
    }
    let clip = Mat4::from_cols_array_2d(&view.clip_from_world) * anchor.extend(1.0);
    let ndc = [clip.x / clip.w, -clip.y / clip.w];
    let middle: [f32; 2] = std::array::from_fn(|i| (ndc[i] + 1.0) * 0.5 * view.frame_px[i]);
    let world_px = 1.0 / view.pixel_at(depth);
    let is_sound = middle.iter().all(|v| v.is_finite()) && world_px.is_finite();
    is_sound.then_some((middle, world_px))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Model, Stage, StageOptions};
    use npr_core::camera::{Camera, Projection};
    use npr_gpu::processor::Processor;
    use npr_style::{Length, Unit};
    use npr_vector::lettering::testing::block_font;
    use proptest::prelude::*;

    const BOUNDS: ([f32; 3], [f32; 3]) = ([-1.0; 3], [1.0; 3]);

    fn camera() -> Camera {
        Camera {
            eye: [0.0, 0.0, 5.0],
            target: [0.0; 3],
            up: [0.0, 1.0, 0.0],
            projection: Projection::Perspective { fov_y: 1.0 },
        }
    }

    fn lettering(words: npr_style::Lettering) -> Lettering {
        let style = Style {
            lettering: vec![words],
            ..Style::default()
        };
        let font = Font::new(block_font()).expect("a sound font");
        Lettering::new(&style, &[("a.ttf".to_owned(), font)].into()).expect("sound words")
    }

    fn anchored(anchor: [f32; 3]) -> npr_style::Lettering {
        npr_style::Lettering {
            anchor: Some(anchor),
            ..npr_style::Lettering::new("HI", "a.ttf")
        }
    }

    #[test]
    fn words_lie_where_the_frame_says() {
        let view = camera().view([200, 100], BOUNDS);
        let said = npr_style::Lettering {
            at: [0.25, 0.5],
            ..npr_style::Lettering::new("HI", "a.ttf")
        };
        assert_eq!(place_of(&said, &view), Some(([50.0, 50.0], 0.0)));
        let placed = lettering(said).placed(&view, 96.0);
        assert_eq!(placed[0].text, "HI");
        assert_eq!(placed[0].marks.len(), 2);
    }

    #[test]
    fn words_behind_the_eye_are_left_out() {
        let view = camera().view([200, 100], BOUNDS);
        for z in [5.0, 5.1, 1e9] {
            assert!(
                lettering(anchored([0.0, 0.0, z]))
                    .placed(&view, 96.0)
                    .is_empty(),
                "{z}"
            );
        }
        assert_eq!(
            lettering(anchored([0.0, 0.0, 4.9]))
                .placed(&view, 96.0)
                .len(),
            1
        );
    }

    #[test]
    fn sizes_of_the_world_shrink_with_distance() {
        let world_px = |z: f32| {
            let view = camera().view([200, 100], BOUNDS);
            place_of(&anchored([0.0, 0.0, z]), &view)
                .expect("before the eye")
                .1
        };
        assert!((world_px(0.0) / world_px(-5.0) - 2.0).abs() < 1e-4);
        // A unit at depth 5 of a view 2 tan(0.5) high per depth.
        assert!((world_px(0.0) - 100.0 / (2.0 * 0.546_302_5 * 5.0)).abs() < 1e-3);
        let said = npr_style::Lettering {
            size: Length {
                value: 1.0,
                unit: Unit::World,
            },
            ..anchored([0.0; 3])
        };
        let view = camera().view([200, 100], BOUNDS);
        assert_eq!(lettering(said).placed(&view, 96.0).len(), 1);
    }

    #[test]
    fn words_lie_over_the_picture_whatever_its_tiles() {
        let style = Style {
            lettering: vec![npr_style::Lettering {
                at: [0.5, 0.5],
                size: Length {
                    value: 90.0,
                    unit: Unit::Px,
                },
                outline: LetteringOutline {
                    width: Length {
                        value: 10.0,
                        unit: Unit::Px,
                    },
                    ..LetteringOutline::default()
                },
                ..npr_style::Lettering::new("I", "a.ttf")
            }],
            ..Style::default()
        };
        let model = Model::new(&npr_scene::Scene::default()).expect("an empty scene");
        let fonts =
            BTreeMap::from([("a.ttf".to_owned(), Font::new(block_font()).expect("a font"))]);
        let picture = |tile_pixels| {
            let options = StageOptions {
                fonts: fonts.clone(),
                tile_pixels,
                ..StageOptions::new([160, 120])
            };
            let mut stage = Stage::new(&Processor, &model, &style, &options).expect("a stage");
            stage.draw(&camera()).expect("a picture")
        };
        let whole = picture(1 << 22);
        assert_eq!(whole.rgba, picture(4096).rgba);
        let pixel = |x: usize, y: usize| &whole.rgba[4 * (y * 160 + x)..][..4];
        let said = &style.lettering[0];
        assert_eq!(pixel(80, 60), bytes_of(said.color));
        // The bar ends 90 / 7 from its middle, the band 10 further out.
        assert_eq!(pixel(97, 60), [0, 0, 0, 255]);
        assert_eq!(pixel(110, 60), [255; 4]);
    }

    #[test]
    fn what_is_left_out_is_told() {
        let style = |font: &str| Style {
            lettering: vec![npr_style::Lettering::new("xHx", font)],
            ..Style::default()
        };
        let fonts = [("a.ttf".to_owned(), Font::new(block_font()).expect("a font"))].into();
        let told = |font| {
            Lettering::new(&style(font), &fonts)
                .expect("words")
                .notices()
                .to_vec()
        };
        assert_eq!(
            told("a.ttf"),
            ["lettering.0: the font lacks 'x', which is left out"]
        );
        assert_eq!(
            told("b.ttf"),
            ["lettering.0 is left out: its font was not given"]
        );
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]
        #[test]
        fn no_place_panics(
            anchor in prop::array::uniform3(prop_oneof![-10_f32..10.0, Just(1e9_f32), Just(-1e9_f32)]),
            eye in prop::array::uniform3(-10_f32..10.0), parallel: bool,
        ) {
            let projection = if parallel { Projection::Parallel { height: 3.0 } } else { Projection::Perspective { fov_y: 1.0 } };
            let view = Camera { eye, projection, ..camera() }.view([64, 48], BOUNDS);
            for words in lettering(anchored(anchor)).placed(&view, 96.0) {
                let mut rgba = vec![0; 64 * 48 * 4];
                npr_vector::drawing::paint_over(&words.marks, &mut rgba, [64, 48]);
            }
        }
    }
}
