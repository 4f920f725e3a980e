//! Cards of hair and grass, drawn by a line each where a style asks for it.

use super::colors::needs_map;
use super::model::LineModel;
use super::welded::BYTES_PER_POLYLINE;
use crate::error::{RenderError, check_count};
use crate::part_info::PartInfo;
use npr_core::budget::Budget;
use npr_mesh::card::{LEAST_RATIO, cards, draw_by_centre};
use npr_stylesheet::{CardLines, Style};

impl LineModel {
    /// Whether two styles give the same model of some parts: with as many beams, lines of cards and maps of textures.
    pub(crate) fn is_alike_for(parts: &[PartInfo], one: &Style, other: &Style) -> bool {
        let is_alike = |info: &PartInfo| {
            info.is_beam(one) == info.is_beam(other)
                && info.look(one).line_cards == info.look(other).line_cards
        };
        needs_map(one) == needs_map(other) && parts.iter().all(is_alike)
    }

    /// Draws the cards of the parts for which the style asks for it by their centre lines from now on, or as one mass.
    ///
    /// # Errors
    ///
    /// [`RenderError`] where there is no room for their lines.
    pub(super) fn draw_cards(&mut self, style: &Style) -> Result<(), RenderError> {
        // Note the surfaces of masses.
        for (surface, info) in self.shape.surfaces.iter_mut().zip(&self.parts) {
            surface.is_mass = info.look(style).line_cards == CardLines::Tuft;
        }

        // Find the cards.
        let asks: Vec<bool> = self
            .parts
            .iter()
            .map(|info| info.look(style).line_cards == CardLines::Centre)
            .collect();
        if !asks.contains(&true) {
            return Ok(());
        }
        let surfaces = &self.shape.face_surfaces;
        let found = cards(&self.shape, |face| asks[surfaces[face as usize] as usize]);
        if found.is_empty() {
            self.notices.push(format!(
                "line.cards is centre, but no piece of these parts is a strip or a tube {LEAST_RATIO} times as long as \
                 wide"
            ));
            return Ok(());
        }

        // Pay for their lines.
        let count = found.iter().map(|card| card.points.len()).sum();
        let half_edges = 3 * self.shape.faces.len() + self.shape.polylines.len();
        check_count("half-edges", half_edges, count)?;
        Budget::new(self.memory_limit).take("lines of cards", count, BYTES_PER_POLYLINE)?;

        // Put them into the shape, with parts for their faces, and colours of their own vertices.
        for copied in draw_by_centre(&mut self.shape, &found) {
            self.parts.push(self.parts[copied as usize].clone());
            if let Some(map) = &mut self.map {
                map.starts.push(map.starts[copied as usize]);
            }
        }
        if !self.colors.is_empty() {
            let points = self.shape.cards.points().iter();
            let colors: Vec<u32> = points
                .map(|point| self.colors[point.vertex as usize])
                .collect();
            self.colors.extend(colors);
        }
        Ok(())
    }
}
