//! Pictures beside the present one.

use egui::TextureHandle;

use toml::Value;

use crate::host::Order;
use crate::sheet::Sheet;

/// A picture of the style that the studio began with, left of a handle.
pub(crate) struct Split {
    /// Whether it is shown.
    pub is_on: bool,
    /// The style that the studio began with.
    pub first: Sheet,
    /// Where the handle is, as a share of the picture's width from the left.
    pub share: f32,
    /// The picture of the style at first, with its order.
    pub shown: Option<(Order, TextureHandle)>,
}

impl Split {
    /// A split that is not shown, with the style at first.
    pub fn new(first: Sheet) -> Self {
        Self {
            is_on: false,
            first,
            share: 0.5,
            shown: None,
        }
    }

    /// Forgets the picture: its scene or its style has changed where they lie.
    pub fn forget(&mut self) {
        self.shown = None;
    }
}

/// Pictures of the scene in every preset, drawn while their list is open.
#[derive(Default)]
pub(crate) struct Gallery {
    /// Whether the list is open.
    pub is_open: bool,
    /// The view that they show, as the order of a picture without a style.
    pub view: Option<Order>,
    /// Pictures by the name of their preset; none for one that could not be drawn.
    pub pictures: Vec<(String, Option<TextureHandle>)>,
}

impl Gallery {
    /// Forgets all pictures: another scene is shown.
    pub fn forget(&mut self) {
        self.pictures.clear();
    }

    /// The picture of a preset, if one was asked for.
    pub fn picture(&self, name: &str) -> Option<&Option<TextureHandle>> {
        let mut all = self.pictures.iter();
        all.find_map(|(other, picture)| (other == name).then_some(picture))
    }
}

/// Samples of brushes and hatchings, drawn while they are in sight.
pub(crate) struct Swatches {
    /// The tables of those that the panel shows.
    pub in_sight: Vec<&'static str>,
    /// Pixels to a point.
    pub scale: f32,
    drawn: Vec<Drawn>,
}

/// A sample that was drawn.
struct Drawn {
    table: &'static str,
    /// The values that it shows, and its size in pixels.
    values: Vec<Option<Value>>,
    size: [u32; 2],
    /// Its picture; none for one that could not be drawn.
    picture: Option<TextureHandle>,
}

impl Default for Swatches {
    fn default() -> Self {
        Self {
            in_sight: Vec::new(),
            scale: 1.0,
            drawn: Vec::new(),
        }
    }
}

impl Swatches {
    /// The last picture of a table's sample, which stays while another is drawn.
    pub fn picture(&self, table: &str) -> Option<&TextureHandle> {
        let mut all = self.drawn.iter();
        all.find(|drawn| drawn.table == table)?.picture.as_ref()
    }

    /// Whether a table's sample of these values and this size was drawn.
    pub fn shows(&self, table: &str, values: &[Option<Value>], size: [u32; 2]) -> bool {
        let is_it =
            |drawn: &Drawn| drawn.table == table && drawn.size == size && drawn.values == values;
        self.drawn.iter().any(is_it)
    }

    /// Takes a table's sample in place of the one before.
    pub fn put(
        &mut self,
        table: &'static str,
        values: Vec<Option<Value>>,
        size: [u32; 2],
        picture: Option<TextureHandle>,
    ) {
        self.drawn.retain(|drawn| drawn.table != table);
        self.drawn.push(Drawn {
            table,
            values,
            size,
            picture,
        });
    }
}
