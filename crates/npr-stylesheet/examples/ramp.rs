//! Draws the tone ramp of every preset in the terminal, dark side on the left.

use npr_style::ramp::ramp_light;
use npr_stylesheet::{Style, StyleError, levels, presets};

const COLUMNS: usize = 64;

/// Characters from dark to light.
const TONES: [char; 5] = ['#', '+', '-', '.', ' '];

fn main() -> Result<(), StyleError> {
    for preset in presets() {
        let style = Style::preset(preset.name)?;
        println!("{:>12} |{}|", preset.name, bar(&style));
    }
    Ok(())
}

/// The ramp as one line of characters.
fn bar(style: &Style) -> String {
    let levels = levels(&style.shade.ramp);
    (0..COLUMNS)
        .map(|column| {
            let x = (column as f32 + 0.5) / COLUMNS as f32;
            let light = ramp_light(&levels, style.shade.softness, x)[1];
            let tone = light.clamp(0.0, 1.0) * (TONES.len() - 1) as f32;
            TONES[tone as usize]
        })
        .collect()
}
