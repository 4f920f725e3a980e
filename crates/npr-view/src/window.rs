//! A window with a studio in it, by eframe.

use std::fmt;

use egui::ViewportBuilder;

use crate::Studio;

/// Why there is no window.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct WindowError(String);

impl fmt::Display for WindowError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for WindowError {}

/// Lets the window look for news of its host; may be called from any thread.
pub type Wake = Box<dyn Fn() + Send>;

/// Opens a window with the studio that `make` gives, and comes back when the user closes it. Call it on the main
/// thread.
///
/// # Errors
///
/// [`WindowError`] where the system has no display, lacks a library that windows need, or refuses a window; or
/// what `make` says.
pub fn open(
    title: &str,
    make: impl FnOnce(Wake) -> Result<Studio, String>,
) -> Result<(), WindowError> {
    check_display()?;
    let options = eframe::NativeOptions {
        viewport: ViewportBuilder::default()
            .with_title(title)
            .with_inner_size([1280.0, 800.0])
            .with_min_inner_size([1.0, 1.0])
            .with_drag_and_drop(true),
        ..eframe::NativeOptions::default()
    };
    let creator: eframe::AppCreator<'_> = Box::new(move |creation| {
        let ctx = creation.egui_ctx.clone();
        let studio = make(Box::new(move || ctx.request_repaint()))?;
        Ok(Box::new(Shown(studio)))
    });
    eframe::run_native(title, options, creator).map_err(|error| {
        let text = error.to_string();
        let line = text.lines().next().unwrap_or_default();
        WindowError(format!("the system opens no window: {line}"))
    })
}

/// A studio as eframe shows it.
struct Shown(Studio);

impl eframe::App for Shown {
    fn ui(&mut self, ui: &mut egui::Ui, _: &mut eframe::Frame) {
        self.0.show(ui);
    }
}

/// Refuses to start without a display, or without a library whose lack makes the window's library panic.
#[cfg(target_os = "linux")]
fn check_display() -> Result<(), WindowError> {
    let is_set = |name: &str| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    let has_wayland = is_set("WAYLAND_DISPLAY") || is_set("WAYLAND_SOCKET");
    if !has_wayland && !is_set("DISPLAY") {
        let text = "there is no display: neither WAYLAND_DISPLAY nor DISPLAY is set";
        return Err(WindowError(text.to_owned()));
    }

    // The loader's list of libraries is a file of names; where there is none, nothing is known.
    let listed = std::fs::read("/etc/ld.so.cache").unwrap_or_default();
    let mut needed = vec!["libxkbcommon.so.0"];
    if !has_wayland {
        needed.extend([
            "libX11.so.6",
            "libxkbcommon-x11.so.0",
            "libXcursor.so.1",
            "libXi.so.6",
        ]);
    }
    for library in needed {
        let is_listed = || {
            listed
                .windows(library.len())
                .any(|name| name == library.as_bytes())
        };
        if !listed.is_empty() && !is_listed() {
            let text = format!("windows need the library {library}, which is not installed");
            return Err(WindowError(text));
        }
    }
    Ok(())
}

#[cfg(not(target_os = "linux"))]
fn check_display() -> Result<(), WindowError> {
    Ok(())
}
