//! A finished picture.

use crate::layer_pixel::LayerPixel;
use crate::stage::StagePixel;
use npr_gpu::engine::PassTime;
use rayon::prelude::*;

/// A finished picture and how long its passes took.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Frame {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// sRGB bytes with straight alpha, row by row from the top.
    pub rgba: Vec<u8>,
    /// What every pixel holds beside its colour, where [`RendererOptions::layers`](crate::RendererOptions::layers) asks
    /// for it; else empty. Speed lines, words and a second look of a blend are in the colours alone.
    pub layers: Vec<LayerPixel>,
    /// What every pixel is on the way to the picture, where [`RendererOptions::stages`](crate::RendererOptions::stages)
    /// asks for it; else empty.
    pub stages: Vec<StagePixel>,
    /// Time per pass in running order, summed over tiles.
    pub times: Vec<PassTime>,
    /// What was drawn in another way than the style asks, for the user.
    pub notices: Vec<String>,
}

impl Frame {
    /// A transparent frame.
    pub(crate) fn new(size: [u32; 2]) -> Self {
        let count = size[0] as usize * size[1] as usize * 4;
        Self {
            size,
            rgba: vec![0; count],
            layers: Vec::new(),
            stages: Vec::new(),
            times: Vec::new(),
            notices: Vec::new(),
        }
    }

    /// Copies a tile in, at `origin`; what lies beyond the frame is left out.
    ///
    /// `skip` is the first texel of the tile that is copied, in each direction, and `extent` how many. Parallel over
    /// rows.
    pub(crate) fn paste(
        &mut self,
        tile: &[u32],
        tile_width: u32,
        skip: [u32; 2],
        origin: [u32; 2],
        extent: [u32; 2],
    ) {
        let columns = extent[0].min(self.size[0] - origin[0]) as usize;
        let rows = extent[1].min(self.size[1] - origin[1]) as usize;
        let to = origin[0] as usize * 4..(origin[0] as usize + columns) * 4;
        let lines = self
            .rgba
            .par_chunks_exact_mut((self.size[0] as usize * 4).max(1));
        let lines = lines.skip(origin[1] as usize).take(rows);
        lines.enumerate().for_each(|(row, line)| {
            let from = (skip[1] as usize + row) * tile_width as usize + skip[0] as usize;
            let bytes = bytemuck::cast_slice(&tile[from..from + columns]);
            line[to.clone()].copy_from_slice(bytes);
        });
    }

    /// Adds the times of another tile.
    pub(crate) fn add_times(&mut self, times: &[PassTime]) {
        if self.times.is_empty() {
            self.times = times.to_vec();
            return;
        }
        for (sum, time) in self.times.iter_mut().zip(times) {
            sum.time += time.time;
        }
    }
}
