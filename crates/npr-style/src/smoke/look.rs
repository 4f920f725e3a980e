//! Settings of smoke, as passes read them.

use bytemuck::{Pod, Zeroable};
use npr_core::gpu_layout;
use npr_core::math;

/// Most depth layers in which smoke is smoothed.
pub const LAYERS_MAX: u32 = 16;

/// Farthest pixel or cell that the Gaussian reaches.
pub const TAPS_MAX: u32 = 11;

/// Most cells in all layers together: at two floats each they take 64 MiB.
pub const CELLS_MAX: u64 = 8 << 20;

/// Reach of the Gaussian in deviations: cells beyond weigh less than 0.0005 of a row.
const DEVIATIONS: f32 = 3.5;

/// Least deviation in cells on a grid; a coarser grid would be below it.
const FINEST: f32 = 1.5;

/// Deviation in pixels below which all pixels in the window are summed.
const WINDOWED: f32 = 3.0;

/// How smoke is toned and outlined.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct SmokeLook {
    /// Number of depth layers that are smoothed separately, 1..16.
    pub layers: u32,
    /// Cells of the layers' grids are `2^shift` pixels wide; 0 to sum over whole windows without grids.
    pub shift: u32,
    /// Reach of the Gaussian to each side, in cells or pixels; 0 for none.
    pub taps: u32,
    /// Bits of [`SmokeLook::PUBLISHED`] and [`SmokeLook::UNLIT`].
    pub flags: u32,
    /// Width and height of a grid.
    pub cells: [u32; 2],
    /// View depth where the first layer begins.
    pub range_start: f32,
    /// Depth of a layer.
    pub range_size: f32,
    /// Part of a layer, 0..1, over which spheres pass on to the next one.
    pub range_blend: f32,
    /// Width of the step between two tones, in tone.
    pub softness: f32,
    /// Share of the sphere's heat, instead of light, in a tone, 0..1.
    pub heat: f32,
    /// How far light reaches round a sphere: 0 half of it, 1 all of it.
    pub wrap: f32,
    /// Width of the outer line in frame pixels.
    pub line_px: f32,
    /// Factor on that width for lines inside the smoke.
    pub line_inner: f32,
    /// Least jump in depth, in radii, at which one sphere is outlined before another.
    pub line_from: f32,
    /// Darkness of the published line.
    pub line_weight: f32,
    /// View depth where the smoke begins.
    pub depth_start: f32,
    /// How deep the smoke is.
    pub depth_size: f32,
    /// How much lines swell away from the light, 0..1.
    pub swell: f32,
    /// Opacity of the smoke.
    pub alpha: f32,
    /// Colour of lines, linear light, straight alpha.
    pub line_color: [f32; 4],
    /// Unit vector towards the main light: right, up, along the view axis.
    pub towards_light: [f32; 3],
    /// Light that reaches everything, 0..1.
    pub ambient: f32,
    /// Samples per pixel along each axis, 1 or 2.
    pub samples: u32,
    /// Texels along a side of the lights' pictures of the smoke; 0 if it throws no shadow on itself.
    pub shadow_side: u32,
    /// How many of the lights' pictures, from the first on, also hold surfaces, and their side in texels; 0 if surfaces
    /// throw no shadow on smoke.
    pub surface_maps: u32,
    /// See `surface_maps`.
    pub surface_side: u32,
    /// Weights of the Gaussian from the middle outwards.
    pub kernel: [[f32; 4]; 3],
    /// Colours in linear light, each with the tone it begins at; see [`crate::ramp::Level`].
    pub ramp: [[f32; 4]; 8],
}
gpu_layout!(SmokeLook {
    layers,
    shift,
    taps,
    flags,
    cells,
    range_start,
    range_size,
    range_blend,
    softness,
    heat,
    wrap,
    line_px,
    line_inner,
    line_from,
    line_weight,
    depth_start,
    depth_size,
    swell,
    alpha,
    line_color,
    towards_light,
    ambient,
    samples,
    shadow_side,
    surface_maps,
    surface_side,
    kernel,
    ramp,
});

impl SmokeLook {
    /// Bit: lines come from differences of depth between diagonal neighbours, as published.
    pub const PUBLISHED: u32 = 1;
    /// Bit: no light; the baseline of discs has one tone.
    pub const UNLIT: u32 = 2;

    /// Sets how far tones are smoothed in a picture of `size` pixels, for a Gaussian of deviation `sigma` pixels.
    ///
    /// Up to 3 pixels, every pixel in reach is summed. Beyond, layers are smoothed on grids whose cells double as the
    /// deviation does, so the cost stays that of 1.5 to 3 cells. Summing cells and reading between them smooths too:
    /// that variance is subtracted from the kernel's.
    pub fn smooth(&mut self, size: [u32; 2], sigma: f32) {
        // Choose the size of the cells by the deviation.
        let sigma = if sigma.is_finite() {
            sigma.clamp(0.0, 1e4)
        } else {
            0.0
        };
        (self.shift, self.cells) = (0, [1, 1]);
        let mut deviation = sigma;

        // Subtract from the kernel the variance that the cells add.
        if sigma >= WINDOWED {
            self.shift = shift_for(size, sigma, self.layers);
            self.cells = cells_of(size, self.shift);
            let cell = (1u32 << self.shift) as f32;
            let added = (1.0 - 1.0 / (cell * cell)) / 12.0 + 1.0 / 3.0;
            let wanted = sigma / cell;
            deviation = (wanted * wanted - added).max(0.05).sqrt();
        }

        // Fill the kernel.
        self.taps = ((deviation * DEVIATIONS).ceil() as u32).min(TAPS_MAX);
        if deviation < 0.1 {
            self.taps = 0;
        }
        for i in 0..=TAPS_MAX {
            let d = i as f32 / deviation.max(1e-6);
            let weight = math::exp(-0.5 * d * d);
            self.kernel[i as usize / 4][i as usize % 4] = if i <= self.taps { weight } else { 0.0 };
        }
    }

    /// Weight of the Gaussian `i` cells from its middle.
    pub(super) fn weight(&self, i: u32) -> f32 {
        self.kernel[i as usize / 4][i as usize % 4]
    }

    /// Number of cells in all grids together; 1 if there are no grids.
    pub fn cell_count(&self) -> usize {
        if self.shift == 0 {
            return 1;
        }
        self.layers as usize * self.cells[0] as usize * self.cells[1] as usize
    }
}

fn cells_of(size: [u32; 2], shift: u32) -> [u32; 2] {
    size.map(|side| side.div_ceil(1 << shift))
}

/// How often the width of cells doubles: until the deviation is below 3 of them and all cells fit.
fn shift_for(size: [u32; 2], sigma: f32, layers: u32) -> u32 {
    let mut shift = 1;
    let is_coarse = |shift: u32| {
        let cells = cells_of(size, shift).map(u64::from);
        sigma / ((1u32 << shift) as f32) < 2.0 * FINEST
            && cells[0] * cells[1] * u64::from(layers) <= CELLS_MAX
    };
    while shift < 14 && !is_coarse(shift) {
        shift += 1;
    }
    shift
}
