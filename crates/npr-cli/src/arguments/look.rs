//! The arguments about the style.

use clap::Args;
use npr_stylesheet::Background;

/// What the user said about the style.
#[derive(Debug, Clone, Default, PartialEq, Args)]
#[command(next_help_heading = "Style")]
pub struct LookArguments {
    /// A preset, alone or with its version, or a style file [default: toon; for smoke alone smoke-cel-2, explosion or
    /// cloud].
    #[arg(long, value_name = "NAME|FILE.toml")]
    pub style: Option<String>,
    /// Override one value of the style; repeatable, later ones win.
    #[arg(long = "set", value_name = "KEY.PATH=VALUE")]
    pub overrides: Vec<String>,
    /// What shows where no surface is: a CSS colour, `transparent`, or a .png or .jpg image.
    #[arg(long, value_name = "COLOUR|IMAGE", value_parser = background)]
    pub background: Option<Background>,
    /// Print the style as it comes out, with every value, and draw nothing.
    #[arg(long)]
    pub dump_style: bool,
}

impl LookArguments {
    /// The arguments with `preset` as the style, where the user names none.
    pub fn or_style(&self, preset: &str) -> Self {
        let mut look = self.clone();
        look.style.get_or_insert_with(|| preset.to_owned());
        look
    }
}

fn background(text: &str) -> Result<Background, String> {
    text.parse()
        .map_err(|error: npr_stylesheet::BackgroundError| format!("it {error}"))
}
