//! Groups and objects: one mesh per name, one part per material.
#![deny(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing,
    clippy::arithmetic_side_effects
)]

use std::collections::BTreeMap;

use super::corner::Corner;
use crate::limits::{self, LimitError};
use crate::loading::Loading;
use crate::polygon;

/// Triangles by material.
type Parts = BTreeMap<Option<u32>, Vec<[Corner; 3]>>;

/// Line segments by material.
type Lines = BTreeMap<Option<u32>, Vec<[Corner; 2]>>;

/// What one `o` or `g` line opens.
#[derive(Debug, Default)]
pub(crate) struct Group {
    pub(crate) name: String,
    pub(crate) parts: Parts,
    pub(crate) lines: Lines,
}

/// All groups in order of first mention; a name that comes back continues its group.
#[derive(Debug)]
pub(crate) struct Groups {
    list: Vec<Group>,
    places: BTreeMap<String, usize>,
    current: usize,
    material: Option<u32>,
}

impl Default for Groups {
    fn default() -> Self {
        let places = BTreeMap::from([(String::new(), 0)]);
        Self {
            list: vec![Group::default()],
            places,
            current: 0,
            material: None,
        }
    }
}

impl Groups {
    /// Sends the faces that follow to the group of this name.
    pub(crate) fn open(&mut self, name: &str, loading: &Loading) -> Result<(), LimitError> {
        if let Some(&place) = self.places.get(name) {
            self.current = place;
            return Ok(());
        }
        self.current = self.list.len();
        limits::check(
            "node count",
            self.current as u64,
            loading.allowance.limits.nodes,
            "--max-nodes",
        )?;
        self.places.insert(name.to_owned(), self.current);
        self.list.push(Group {
            name: name.to_owned(),
            ..Group::default()
        });
        Ok(())
    }

    /// Gives the faces that follow this material.
    pub(crate) fn set_material(&mut self, material: u32) {
        self.material = Some(material);
    }

    /// Adds a polygon to the open group.
    pub(crate) fn add_face(
        &mut self,
        corners: &[Corner],
        loading: &mut Loading,
    ) -> Result<(), LimitError> {
        let count = corners.len().saturating_sub(2);
        loading.allowance.take_triangles(count)?;
        loading.allowance.take::<[Corner; 3]>("faces", count)?;
        if let Some(group) = self.list.get_mut(self.current) {
            group
                .parts
                .entry(self.material)
                .or_default()
                .extend(polygon::fan(corners));
        }
        Ok(())
    }

    /// Adds a line through points to the open group.
    pub(crate) fn add_polyline(
        &mut self,
        corners: &[Corner],
        loading: &mut Loading,
    ) -> Result<(), LimitError> {
        let count = corners.len().saturating_sub(1);
        loading.allowance.take_segments(count)?;
        loading.allowance.take::<[Corner; 2]>("lines", count)?;
        if let Some(group) = self.list.get_mut(self.current) {
            let lines = group.lines.entry(self.material).or_default();
            lines.extend(corners.array_windows::<2>());
        }
        Ok(())
    }

    /// The groups that have faces or lines.
    pub(crate) fn into_list(self) -> impl Iterator<Item = Group> {
        self.list
            .into_iter()
            .filter(|group| !group.parts.is_empty() || !group.lines.is_empty())
    }
}
