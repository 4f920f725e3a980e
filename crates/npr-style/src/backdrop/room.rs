//! How far away rims may lie that decide about the line at a place.

use super::rims::TILE;
use super::rule::Rules;
use super::spread::SMOOTH_MOST;
use super::stretch::{BIAS_REACH_MOST, STRETCH_TILES};

impl Rules {
    /// Distance in pixels up to which rims may decide about the line at a place.
    pub fn room_px(&self) -> u32 {
        let smoothed = (self.smooth_px.max(0.0) as u32).min(SMOOTH_MOST);
        let tiles = (self.bias_px.max(0.0) / TILE as f32).ceil() as u32;
        let stretch = match tiles {
            0 => 1,
            tiles => tiles.min(BIAS_REACH_MOST) + STRETCH_TILES + 1,
        };
        self.reach_px + smoothed + 3 + stretch * TILE
    }
}
