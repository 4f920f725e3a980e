//! The window of npr: a drawing that changes while its style and camera do.
//!
//! [`Studio`] is all that is seen: a picture that the mouse turns, and a panel with a control for every key of a style,
//! made from the style's schema. It shows itself in any program that draws with egui, and asks its [`Host`] for
//! pictures and files; the host of the command `npr view` draws them as `npr render` does. With the feature `window`,
//! `window::open` shows it in a window of its own.
//!
//! ```
//! use npr_stylesheet::Stated;
//! use npr_view::Sheet;
//! use toml::Value;
//!
//! let mut sheet = Sheet::new("ink", Stated::preset("ink")?, &["line.width.max=3".to_owned()])?;
//! sheet.set("line.color", &Value::String("#402010".to_owned()))?;
//! assert_eq!(sheet.overrides(), ["line.width.max=3", "line.color=#402010"]);
//! assert!(sheet.file().starts_with("extends = \"ink\""));
//! # Ok::<(), npr_stylesheet::StyleError>(())
//! ```

mod beside;
mod film;
mod history;
mod host;
mod pace;
mod panel;
mod pose;
mod sheet;
mod studio;
mod times;
mod value;
mod viewpoint;
mod why;
#[cfg(feature = "window")]
pub mod window;

pub use film::{Film, FilmForm};
pub use host::{
    FileKind, Host, Layer, News, Order, PassSeconds, Picture, Question, Swatch, Take, shell_line,
};
pub use pose::{Cast, Clip, Face, LookAt, Pose};
pub use sheet::Sheet;
pub use studio::Studio;
pub use viewpoint::Viewpoint;
pub use why::{Answer, Remedy, ToldFact, ToldLine, ToldPart};
