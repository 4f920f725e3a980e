//! The brushes that a style draws the strokes of a model with.

use crate::error::RenderError;
use crate::part_info::PartInfo;
use crate::pictures::Pictures;
use npr_core::texture::TextureStore;
use npr_drawing::artwork::StrokeBrushes;
use npr_drawing::ink::{BrushLay, Images};
use npr_drawing::stamps::Stamps;
use npr_style::brush::BrushImage;
use npr_stylesheet::{BrushMapping, LineBrush, Look, Style};
use npr_vector::brush::Brush;
use npr_vector::stroke::Stroke;

/// The brushes of a style, and how they lie on the strokes of every part.
#[derive(Debug, Default)]
pub(crate) struct Brushes {
    /// The brushes, a pen first; empty where all draw with a pen.
    pub all: Vec<Brush>,
    /// How that of every part of a line model lies on strokes, where a pixel is as long as the base width.
    of_parts: Vec<BrushLay>,
}

/// A picture or a tip whose texels lie in the texture store.
struct StoredImage {
    brush: LineBrush,
    header: Brush,
    length: f32,
}

impl Brushes {
    /// Gives each of the `parts` on which strokes are found, where `is_stroked` is true of its look, its brush, and
    /// puts the images into the texture store, each once; a pixel has so many hills of the paper.
    pub fn new(
        parts: &[PartInfo],
        style: &Style,
        pictures: &Pictures<'_>,
        (spots_per_px, is_stroked): (f32, fn(&Look<'_>) -> bool),
        textures: &mut TextureStore,
    ) -> Result<Self, RenderError> {
        // Find the brushes that are no pens.
        let looks = parts.iter().map(|info| info.look(style));
        let drawn: Vec<Option<LineBrush>> = looks
            .map(|look| {
                let draws = look.line_on && is_stroked(&look);
                Some(look.line_brush).filter(|brush| draws && !brush.is_pen())
            })
            .collect();
        if drawn.iter().all(Option::is_none) {
            return Ok(Self::default());
        }

        // Store the image of each once.
        let mut brushes = Self {
            all: vec![Brush::default()],
            of_parts: Vec::with_capacity(drawn.len()),
        };
        let mut stored: Vec<StoredImage> = Vec::new();
        for brush in drawn {
            let Some(brush) = brush else {
                brushes.of_parts.push(BrushLay::PEN);
                continue;
            };
            let has_it = |other: &StoredImage| {
                (&other.brush.image, other.brush.tip) == (&brush.image, brush.tip)
            };
            let found = match stored.iter().position(has_it) {
                Some(found) => found,
                None => {
                    stored.push(StoredImage::new(&brush, pictures, textures)?);
                    stored.len() - 1
                }
            };

            // Let it take to paper in its own manner.
            let StoredImage { header, length, .. } = &stored[found];
            let manner = brush.manner();
            let own = Brush {
                dry: manner.dry,
                grain: manner.grain,
                soft: manner.soft,
                spots_per_px,
                ..*header
            };
            let number = match brushes.all.iter().position(|other| *other == own) {
                Some(number) => number,
                None => {
                    brushes.all.push(own);
                    brushes.all.len() - 1
                }
            };
            brushes.of_parts.push(BrushLay {
                brush: number as u32,
                images: images_of(&brush, *length),
            });
        }
        Ok(brushes)
    }

    /// Whether any of them draws by stamps.
    pub fn has_stamps(&self) -> bool {
        let mut lays = self.of_parts.iter();
        lays.any(|lay| matches!(lay.images, Images::Stamps(_)))
    }

    /// How a brush lies on a stroke, where the base width is `base_px`.
    pub fn lay_of(&self, stroke: &Stroke, base_px: f32) -> BrushLay {
        let of_part = self.of_parts.get(stroke.surface as usize);
        scaled(of_part.copied().unwrap_or(BrushLay::PEN), base_px)
    }

    /// The same for files, where `textures` holds the images of the brushes alone.
    pub fn into_files(self, textures: TextureStore, base_px: f32) -> StrokeBrushes {
        let lays = self.of_parts.iter().map(|lay| scaled(*lay, base_px));
        StrokeBrushes {
            lays: lays.collect(),
            all: self.all,
            texels: textures.words().to_vec(),
        }
    }
}

/// How a brush lies where the base width is `base_px`, of how it does where that is a pixel.
fn scaled(BrushLay { brush, images }: BrushLay, base_px: f32) -> BrushLay {
    let width = f64::from(base_px);
    let images = match images {
        Images::Once => Images::Once,
        Images::ByLength(widths) => Images::ByLength(widths * width),
        Images::Stamps(stamps) => Images::Stamps(Stamps {
            spacing_px: stamps.spacing_px * width,
            ..stamps
        }),
    };
    BrushLay { brush, images }
}

/// How often the image of a brush, `length` widths long, lies on a stroke, where a pixel is as long as the base width.
fn images_of(brush: &LineBrush, length: f32) -> Images {
    let stamp = &brush.stamp;
    match brush.mapping {
        BrushMapping::Length => Images::ByLength(f64::from(length * brush.stretch)),
        BrushMapping::Once => Images::Once,
        BrushMapping::Stamps => {
            // Tips leave a round mark of theirs; a picture is one itself.
            let is_tip = brush.image.is_empty();
            Images::Stamps(Stamps {
                spacing_px: stamp.spacing.into(),
                size: stamp.size.into(),
                length: if is_tip { 1.0 } else { length.into() },
                jitter: stamp.jitter.into(),
                angle: f64::from(stamp.angle_deg).to_radians(),
                turn: f64::from(stamp.turn_deg).to_radians(),
                rakes: stamp.rake,
                scatter: stamp.scatter.into(),
                part: match is_tip {
                    true => (None, 1.0 / f64::from(length)),
                    false => (Some(0.0), 1.0),
                },
                is_round: is_tip,
            })
        }
    }
}

impl StoredImage {
    fn new(
        brush: &LineBrush,
        pictures: &Pictures<'_>,
        textures: &mut TextureStore,
    ) -> Result<Self, RenderError> {
        let name = &brush.image;
        let image = match name.is_empty() {
            true => brush.tip.image(),
            false => {
                let picture = pictures.of(name)?;
                let image = BrushImage::from_picture(picture.size, &picture.rgba);
                Some(image.map_err(|source| RenderError::Brush {
                    key: pictures.key_of(name),
                    source,
                })?)
            }
        };
        let stored = image.and_then(|image| Some((textures.add_words(&image.words())?, image)));
        let (header, length) = stored.map_or((Brush::default(), 1.0), |(start, image)| {
            let [texels_along, texels_across] = image.size();
            let header = Brush {
                start,
                texels_along,
                texels_across,
                levels: image.levels(),
                ..Brush::default()
            };
            (header, image.length())
        });
        Ok(Self {
            brush: brush.clone(),
            header,
            length,
        })
    }
}
