//! Drawings as PDF files: one page, with layers that readers can switch on and off.
//!
//! Layers by kind hold layers by object. Stamps of a brush are images that stand once, of one colour under a soft mask.
//! Nothing depends on time or chance: no dates, no identifiers.

use crate::artwork::{
    Artwork, DASH, Group, Mark, Paint, REGION_SEAM_PX, StampImage, arrange, plain_name,
};
use kurbo::{Affine, PathEl};
use npr_core::number::on_grid;
use npr_vector::stroke::Drawing;
use pdf_writer::types::{LineCapStyle, LineJoinStyle};
use pdf_writer::{Content, Dict, Finish, Name, Pdf, Rect, Ref, TextStr};
use std::collections::BTreeMap;

pub use crate::artwork::ArtworkOptions as PdfOptions;

/// Points per pixel, where the file has the picture's size: 96 pixels are an inch.
const POINTS_PER_PX: f64 = 0.75;

/// Points per millimetre.
const POINTS_PER_MM: f64 = 72.0 / 25.4;

const CATALOG: Ref = Ref::new(1);
const PAGES: Ref = Ref::new(2);
const PAGE: Ref = Ref::new(3);
const CONTENT: Ref = Ref::new(4);

/// First number that is free for layers and opacities.
const FIRST_FREE: i32 = 5;

/// The drawing as a PDF file, version 1.7.
///
/// Same drawing and options, same bytes.
pub fn write_pdf(drawing: &Drawing, options: &PdfOptions) -> Vec<u8> {
    // Number the layers and opacities, and measure the page in points.
    let artwork = arrange(drawing, options);
    let plan = Plan::of(&artwork);
    let points = if artwork.is_page {
        POINTS_PER_MM
    } else {
        POINTS_PER_PX
    };
    let [width, height] = artwork.size.map(|side| (side * points) as f32);

    // Write the catalogue, the list of layers, and the page.
    let mut pdf = Pdf::new();
    let mut catalog = pdf.catalog(CATALOG);
    catalog.pages(PAGES);
    plan.list_layers(catalog.insert(Name(b"OCProperties")).dict());
    catalog.finish();
    pdf.pages(PAGES).kids([PAGE]).count(1);
    let mut page = pdf.page(PAGE);
    page.parent(PAGES)
        .media_box(Rect::new(0.0, 0.0, width, height))
        .contents(CONTENT);
    plan.list_resources(&mut page.resources());
    page.finish();
    plan.write_parts(&mut pdf);
    for (image, ids) in artwork.images.iter().zip(&plan.images) {
        write_image(&mut pdf, image, *ids);
    }

    // Write the marks, with y up as PDF has it.
    let mut writer = Writer {
        content: Content::new(),
        plan: &plan,
        seam: REGION_SEAM_PX * artwork.scale,
    };
    writer
        .content
        .transform([points as f32, 0.0, 0.0, -points as f32, 0.0, height]);
    writer.artwork(&artwork);
    pdf.stream(CONTENT, writer.content.finish().as_slice());
    pdf.finish()
}

/// A layer of the file, and the layers inside it.
struct Folder {
    id: Ref,
    label: String,
    inner: Vec<Folder>,
}

/// The numbered objects that the page refers to.
struct Plan {
    folders: Vec<Folder>,
    /// Opacities in use, out of 255, in rising order.
    opacities: BTreeMap<u8, Ref>,
    /// Images of brushes, each with its mask.
    images: Vec<[Ref; 2]>,
}

impl Plan {
    fn of(artwork: &Artwork) -> Self {
        let mut next = FIRST_FREE;
        let mut free = || {
            next += 1;
            Ref::new(next - 1)
        };

        // Note every opacity that is used.
        let mut opacities = BTreeMap::new();
        if let Some(color) = artwork.background {
            opacities.insert(color[3], free());
        }

        // Number layers and their groups.
        let mut folders = Vec::new();
        for layer in &artwork.layers {
            let id = free();
            let inner = layer.groups.iter().map(|group| {
                for mark in &group.marks {
                    opacities.entry(mark.color[3]).or_insert_with(&mut free);
                }
                Folder {
                    id: free(),
                    label: label(group),
                    inner: Vec::new(),
                }
            });
            let inner = inner.collect();
            folders.push(Folder {
                id,
                label: layer.name.clone(),
                inner,
            });
        }
        let images = artwork.images.iter().map(|_| [free(), free()]).collect();
        Self {
            folders,
            opacities,
            images,
        }
    }

    /// All layers, the outer before the inner ones.
    fn all(&self) -> impl Iterator<Item = &Folder> {
        self.folders
            .iter()
            .flat_map(|folder| std::iter::once(folder).chain(&folder.inner))
    }

    /// The order in which readers list layers.
    fn list_layers(&self, mut properties: Dict) {
        properties
            .insert(Name(b"OCGs"))
            .array()
            .items(self.all().map(|folder| folder.id));
        let mut shown = properties.insert(Name(b"D")).dict();
        let mut order = shown.insert(Name(b"Order")).array();
        for folder in &self.folders {
            order.item(folder.id);
            order
                .push()
                .array()
                .items(folder.inner.iter().map(|inner| inner.id));
        }
    }

    fn list_resources(&self, resources: &mut pdf_writer::writers::Resources) {
        let mut layers = resources.insert(Name(b"Properties")).dict();
        for folder in self.all() {
            layers.pair(Name(&layer_name(folder.id)), folder.id);
        }
        layers.finish();
        let mut states = resources.ext_g_states();
        for (opacity, id) in &self.opacities {
            states.pair(Name(&opacity_name(*opacity)), *id);
        }
        states.finish();
        if !self.images.is_empty() {
            let mut images = resources.x_objects();
            for (number, [image, _]) in self.images.iter().enumerate() {
                images.pair(Name(&image_name(number as u32)), *image);
            }
        }
    }

    /// Writes the layers and opacities themselves.
    fn write_parts(&self, pdf: &mut Pdf) {
        for folder in self.all() {
            pdf.indirect(folder.id)
                .dict()
                .pair(Name(b"Type"), Name(b"OCG"))
                .pair(Name(b"Name"), TextStr(&folder.label));
        }
        for (opacity, id) in &self.opacities {
            let share = f32::from(*opacity) / 255.0;
            pdf.ext_graphics(*id)
                .non_stroking_alpha(share)
                .stroking_alpha(share);
        }
    }
}

fn label(group: &Group) -> String {
    let name = plain_name(&group.label);
    if name.is_empty() {
        "object".into()
    } else {
        name
    }
}

fn layer_name(id: Ref) -> Vec<u8> {
    format!("L{}", id.get()).into_bytes()
}

fn image_name(number: u32) -> Vec<u8> {
    format!("S{number}").into_bytes()
}

/// Writes a pixel of the colour of an image, and the image's ink as its mask.
fn write_image(pdf: &mut Pdf, image: &StampImage, [id, mask_id]: [Ref; 2]) {
    let mut pixel = pdf.image_xobject(id, &image.color);
    pixel.width(1).height(1).bits_per_component(8);
    pixel.color_space().device_rgb();
    pixel.s_mask(mask_id);
    pixel.finish();
    let [width, height] = image.size.map(|side| side as i32);
    let mut mask = pdf.image_xobject(mask_id, &image.alpha);
    mask.width(width).height(height).bits_per_component(8);
    mask.color_space().device_gray();
    mask.interpolate(true);
}

fn opacity_name(opacity: u8) -> Vec<u8> {
    format!("A{opacity}").into_bytes()
}

struct Writer<'a> {
    content: Content,
    plan: &'a Plan,
    /// Width of the line around regions.
    seam: f64,
}

impl Writer<'_> {
    fn artwork(&mut self, artwork: &Artwork) {
        self.content
            .set_line_cap(LineCapStyle::RoundCap)
            .set_line_join(LineJoinStyle::RoundJoin);
        if let Some(color) = artwork.background {
            let [width, height] = artwork.size.map(|side| side as f32);
            self.color(color);
            self.content.rect(0.0, 0.0, width, height).fill_nonzero();
        }
        for (layer, folder) in artwork.layers.iter().zip(&self.plan.folders) {
            self.begin(folder);
            for (group, inner) in layer.groups.iter().zip(&folder.inner) {
                self.begin(inner);
                group.marks.iter().for_each(|mark| self.mark(mark));
                self.content.end_marked_content();
            }
            self.content.end_marked_content();
        }
    }

    fn begin(&mut self, folder: &Folder) {
        self.content
            .begin_marked_content_with_properties(Name(b"OC"))
            .properties_named(Name(&layer_name(folder.id)));
    }

    fn color(&mut self, [r, g, b, a]: [u8; 4]) {
        let [red, green, blue] = [r, g, b].map(|v| f32::from(v) / 255.0);
        self.content
            .set_parameters(Name(&opacity_name(a)))
            .set_fill_rgb(red, green, blue)
            .set_stroke_rgb(red, green, blue);
    }

    fn mark(&mut self, mark: &Mark) {
        self.color(mark.color);
        match mark.paint {
            Paint::Ink => {
                self.path(mark);
                self.content.fill_nonzero();
            }
            Paint::Region if mark.color[3] < 255 => {
                self.path(mark);
                self.content.fill_even_odd();
            }
            Paint::Region => {
                self.width(self.seam);
                self.path(mark);
                self.content.fill_even_odd_and_stroke();
            }
            Paint::Line(width) => {
                self.width(width);
                self.content.set_dash_pattern([], 0.0);
                self.path(mark);
                self.content.stroke();
            }
            Paint::Dashes(width) => {
                self.width(width);
                let dashes = DASH.map(|share| (share * width) as f32);
                self.content.set_dash_pattern(dashes, 0.0);
                self.path(mark);
                self.content.stroke();
            }
            Paint::Image(number) => {
                // Images of PDF stand on their lower side.
                let upright = Affine::new([1.0, 0.0, 0.0, -1.0, 0.0, 1.0]);
                let Some(place) = mark.image_place() else {
                    return;
                };
                let place = (place * upright).as_coeffs().map(on_thousandths);
                self.content.save_state().transform(place);
                self.content.x_object(Name(&image_name(number)));
                self.content.restore_state();
            }
        }
    }

    fn width(&mut self, width: f64) {
        self.content
            .set_line_width(on_thousandths(width).max(0.001));
    }

    fn path(&mut self, mark: &Mark) {
        let at = |p: &kurbo::Point| [on_thousandths(p.x), on_thousandths(p.y)];
        for element in mark.path.elements() {
            match element {
                PathEl::MoveTo(p) => {
                    let [x, y] = at(p);
                    self.content.move_to(x, y);
                }
                PathEl::LineTo(p) => {
                    let [x, y] = at(p);
                    self.content.line_to(x, y);
                }
                // Our curves are cubic; of another the chord is drawn rather than nothing.
                PathEl::QuadTo(_, p) => {
                    let [x, y] = at(p);
                    self.content.line_to(x, y);
                }
                PathEl::CurveTo(a, b, p) => {
                    let ([ax, ay], [bx, by], [x, y]) = (at(a), at(b), at(p));
                    self.content.cubic_to(ax, ay, bx, by, x, y);
                }
                PathEl::ClosePath => {
                    self.content.close_path();
                }
            }
        }
    }
}

/// A coordinate on a grid of thousandths, so that files stay short.
fn on_thousandths(value: f64) -> f32 {
    (on_grid(value, 3) as f64 / 1000.0) as f32
}
