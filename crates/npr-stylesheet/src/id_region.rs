//! The regions of id maps that a style tells apart.

use std::collections::BTreeSet;

use crate::id_map::color_of;
use crate::{Color, IdMap, Style};

/// A region of an id map.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct IdRegion {
    /// Its colour, sRGB bytes.
    pub color: [u8; 3],
    /// Its names in rules: its own name, if it has one, and its colour as `#rrggbb`.
    pub names: Vec<String>,
}

impl IdRegion {
    fn new(color: Color, name: Option<&str>) -> Self {
        let names = name.map(str::to_owned).into_iter();
        Self {
            color: [color.r, color.g, color.b],
            names: names.chain([color.to_string()]).collect(),
        }
    }
}

impl Style {
    /// The regions that may be told apart on an id map: its named colours, then those that rules name by colour alone.
    pub fn id_regions(&self, map: &IdMap) -> Vec<IdRegion> {
        let named = map.ids.iter();
        let mut regions: Vec<IdRegion> = named
            .map(|id| IdRegion::new(id.color, Some(&id.name)))
            .collect();
        let mut known: BTreeSet<[u8; 3]> = regions.iter().map(|region| region.color).collect();
        let colors = self
            .rule
            .iter()
            .filter_map(|rule| color_of(&rule.matching.id));
        for region in colors.map(|color| IdRegion::new(color, None)) {
            if known.insert(region.color) {
                regions.push(region);
            }
        }
        regions
    }

    /// The pictures of the id maps, as pairs of key and picture name. Each name is listed once, with the first key
    /// that has it. The caller loads the pictures.
    pub fn id_map_pictures(&self) -> Vec<(String, &str)> {
        let mut named: Vec<(String, &str)> = Vec::new();
        for (i, map) in self.id_map.iter().enumerate() {
            if named.iter().all(|(_, name)| *name != map.image) {
                named.push((format!("id_map.{i}.image"), &map.image));
            }
        }
        named
    }
}
