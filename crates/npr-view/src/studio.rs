//! All that is seen: the picture, the panel and what is told below.

mod aside;
mod canvas;
mod dropped;
mod figure;
mod filming;
mod gallery;
mod guides;
mod joints;
mod layers;
mod lights;
mod smoke;
mod split;
mod swatches;
mod timeline;
mod times;
mod why;

use egui::{Align, Key, KeyboardShortcut, Layout, Modifiers, RichText, TextureHandle, Ui};
use npr_core::standard_view::StandardView;
use npr_stylesheet::StyleError;

use crate::beside::{Gallery, Split, Swatches};
use crate::film::Filming;
use crate::history::History;
use crate::host::{FileKind, Host, Layer, News, Order, Picture, Take};
use crate::pace::Pace;
use crate::panel::{Edit, Panel};
use crate::pose::Pose;
use crate::sheet::Sheet;
use crate::times::Times;
use crate::viewpoint::Viewpoint;
use crate::why::Asked;
use timeline::Timeline;

/// Seconds without a change after which the picture is drawn in full.
const STILL_S: f64 = 0.2;

/// Width of the panel in points.
const PANEL_WIDTH: f32 = 330.0;

/// A style and a camera that are being worked on, with the picture that they give.
pub struct Studio {
    host: Box<dyn Host>,
    sheet: Sheet,
    history: History,
    panel: Panel,
    scene: String,
    /// Where the picture is seen from; `None` where the host frames the scene.
    viewpoint: Option<Viewpoint>,
    /// How the scene stands.
    pose: Pose,
    timeline: Timeline,
    filming: Filming,
    /// Width and height of pictures, where they do not follow the window.
    fixed_size: Option<[u32; 2]>,
    pace: Pace,
    /// Counts changes of style, camera and size.
    change: u64,
    /// When the last of them was, in seconds of the window.
    changed_s: f64,
    /// The order that is being drawn.
    ordered: Option<Order>,
    /// The order beside it that is being drawn, or could not be.
    aside: Option<Order>,
    /// The picture of the style at first.
    split: Split,
    /// Pictures of the presets.
    gallery: Gallery,
    /// Samples of brush and hatching.
    swatches: Swatches,
    /// The bones of a pose that were saved last, and their file.
    saved_pose: Option<(Pose, String)>,
    /// Width and height that a full picture has now, in pixels.
    size: [u32; 2],
    shown: Option<(Picture, TextureHandle)>,
    /// What is told, and whether it is a fault.
    told: Option<(String, bool)>,
    /// What was asked about the picture.
    asked: Asked,
    /// Whether clicks on the picture add guide points, and take them away.
    places_guides: bool,
    /// Files that were dropped, of which it is asked what they are for.
    dropped: Vec<(String, FileKind)>,
    /// Whether handles over the picture turn lights.
    moves_lights: bool,
    /// The layer that is shown in place of the picture, and those that there are.
    layer: Option<String>,
    layers: Vec<Layer>,
    /// How long the last pictures took.
    times: Times,
}

impl Studio {
    /// A studio with a style. Pictures are as large as the room that the window leaves, or of `size` pixels.
    ///
    /// # Errors
    ///
    /// [`StyleError`] where overrides do not fit the style; its name is looked up by the host.
    pub fn new(sheet: Sheet, size: Option<[u32; 2]>, host: Box<dyn Host>) -> Self {
        Self {
            layers: host.layers(),
            host,
            split: Split::new(sheet.clone()),
            sheet,
            history: History::default(),
            panel: Panel::default(),
            scene: String::new(),
            viewpoint: None,
            pose: Pose::default(),
            timeline: Timeline::default(),
            filming: Filming::default(),
            fixed_size: size,
            pace: Pace::default(),
            change: 1,
            changed_s: 0.0,
            ordered: None,
            aside: None,
            gallery: Gallery::default(),
            swatches: Swatches::default(),
            saved_pose: None,
            size: size.unwrap_or([1, 1]),
            shown: None,
            told: None,
            asked: Asked::default(),
            places_guides: false,
            dropped: Vec::new(),
            moves_lights: false,
            layer: None,
            times: Times::default(),
        }
    }

    /// The same studio with a scene that stands in a pose at first.
    pub fn posed(mut self, pose: Pose) -> Self {
        self.pose = pose;
        self
    }

    /// The style that is being worked on.
    pub fn sheet(&self) -> &Sheet {
        &self.sheet
    }

    /// The picture that is shown, if there is one yet.
    pub fn picture(&self) -> Option<&Picture> {
        self.shown.as_ref().map(|(picture, _)| picture)
    }

    /// What is told below the picture, if anything.
    pub fn told(&self) -> Option<&str> {
        self.told.as_ref().map(|(text, _)| text.as_str())
    }

    /// Shows the keys alone whose name or description holds these words; all where there are none.
    pub fn search(&mut self, words: &str) {
        words.clone_into(&mut self.panel.search);
    }

    /// The order of the full picture as things are.
    pub fn order(&self) -> Order {
        Order {
            change: self.change,
            style: self.sheet.name().to_owned(),
            overrides: self.sheet.overrides(),
            viewpoint: self.viewpoint,
            pose: self.pose.said(),
            layer: self.layer.clone(),
            swatch: None,
            size: self.size,
            is_draft: false,
        }
    }

    /// Shows all of it, takes what the user does, and asks for pictures.
    pub fn show(&mut self, ui: &mut Ui) {
        self.take_news(ui);
        self.take_dropped(ui);
        self.take_keys(ui);
        self.follow_clock(ui);
        let wide = ui.available_width() > PANEL_WIDTH + 80.0;
        if wide {
            egui::Panel::right("panel")
                .default_size(PANEL_WIDTH)
                .min_size(PANEL_WIDTH)
                .max_size(PANEL_WIDTH * 1.8)
                .show(ui, |ui| self.show_panel(ui));
        }
        if ui.available_height() > 60.0 {
            egui::Panel::bottom("told").show(ui, |ui| self.show_told(ui));
        }
        self.show_timeline(ui);
        egui::CentralPanel::default()
            .frame(egui::Frame::NONE)
            .show(ui, |ui| self.show_canvas(ui));
        self.show_dropped(ui);
        self.ask(ui);
    }

    /// Notes a change of what is drawn.
    fn changed(&mut self, ui: &Ui) {
        self.change += 1;
        self.changed_s = ui.input(|input| input.time);
        ui.ctx().request_repaint();
    }

    fn tell_fault(&mut self, text: impl ToString) {
        self.told = Some((text.to_string(), true));
    }

    /// Takes pictures and messages that the host has.
    fn take_news(&mut self, ui: &Ui) {
        for news in self.host.news() {
            match news {
                News::Picture(picture) => self.take_picture(ui, *picture),
                News::Fault(text) => {
                    self.ordered = self.ordered.take().filter(|order| !order.is_draft);
                    self.tell_fault(text);
                }
                News::Done(text) => self.told = Some((text, false)),
                News::Scene(name, cast) => {
                    // Another scene is framed anew; one that has changed is seen from where the user is.
                    if !self.scene.is_empty() {
                        self.viewpoint = self.viewpoint.filter(|_| self.scene == name);
                        if self.scene != name {
                            self.pose = Pose::default();
                            self.history.forget_figure();
                        }
                        self.ordered = None;
                        self.aside = None;
                        self.split.forget();
                        self.gallery.forget();
                        self.changed(ui);
                    }
                    self.scene = name;
                    self.take_cast(*cast, ui);
                }
                News::Aside(order, drawn) => self.take_aside(&order, drawn, ui),
                News::Pointed(answer) => self.take_answer(*answer, ui),
                News::Film(done) => self.filming.done = done,
                News::StyleChanged => {
                    let name = self.sheet.name().to_owned();
                    self.split.forget();
                    self.take_style(&name, ui);
                }
            }
        }
    }

    fn take_picture(&mut self, ui: &Ui, picture: Picture) {
        if picture.order.is_draft {
            self.pace.learn(picture.seconds);
        }
        self.times.note(&picture);
        let is_last = self.ordered.as_ref() == Some(&picture.order);
        if is_last {
            self.ordered = None;
        }
        // A draft of before does not go over a full picture of after.
        let is_older = |(shown, _): &(Picture, TextureHandle)| {
            shown.order.change > picture.order.change
                || shown.order.change == picture.order.change
                    && !shown.order.is_draft
                    && picture.order.is_draft
        };
        if self.shown.as_ref().is_some_and(is_older) {
            return;
        }
        let texture = canvas::texture(ui.ctx(), &picture);
        let is_fault = self.told.as_ref().is_some_and(|(_, is_fault)| *is_fault);
        if is_fault && !picture.order.is_draft {
            self.told = None;
        }
        self.shown = Some((picture, texture));
        ui.ctx().request_repaint();
    }

    /// Takes a style by its name. What was changed stays, where it is the same style read anew.
    fn take_style(&mut self, name: &str, ui: &Ui) {
        let stated = match self.host.style(name) {
            Ok(stated) => stated,
            Err(text) => return self.tell_fault(text),
        };
        let sheet = match name == self.sheet.name() {
            true => self.sheet.over(stated),
            false => Sheet::new(name, stated, &[]),
        };
        match sheet {
            Ok(sheet) => {
                self.history.close();
                self.history.note(&self.sheet, "");
                self.history.close();
                self.sheet = sheet;
                self.changed(ui);
            }
            Err(error) => self.tell_fault(error),
        }
    }

    /// Applies what was changed in the panel.
    fn edit(&mut self, edit: &Edit, ui: &Ui) {
        let before = self.sheet.clone();
        let done: Result<(), StyleError> = match edit {
            Edit::Set(key, value) => self.sheet.set(key, value),
            Edit::Reset(key) => self.sheet.reset(key),
        };
        match done {
            Ok(()) if self.sheet == before => {}
            Ok(()) => {
                self.history.note(&before, edit.key());
                self.told = None;
                self.changed(ui);
            }
            Err(error) => self.tell_fault(error),
        }
    }

    fn undo(&mut self, ui: &Ui) {
        self.history.undo(&mut self.sheet, &mut self.pose);
        self.changed(ui);
    }

    fn redo(&mut self, ui: &Ui) {
        self.history.redo(&mut self.sheet, &mut self.pose);
        self.changed(ui);
    }

    fn save(&mut self, take: Take) {
        self.host.save(take, &self.sheet, &self.order());
    }

    fn copy_command(&mut self, ui: &Ui) {
        let order = self.order();
        let Some(order) = self.told_order(order) else {
            return;
        };
        ui.ctx().copy_text(self.host.command(&order));
        let text = "the command line of this picture is in the clipboard";
        self.told = Some((text.to_owned(), false));
    }

    /// Takes keys that are meant for no text.
    fn take_keys(&mut self, ui: &Ui) {
        // Undo and redo go over the whole window, but for texts that are typed.
        let pressed = |modifiers, key| {
            ui.input_mut(|input| input.consume_shortcut(&KeyboardShortcut::new(modifiers, key)))
        };
        if pressed(Modifiers::COMMAND, Key::S) {
            self.save(Take::Style);
        }
        if ui.ctx().text_edit_focused() {
            return;
        }
        if pressed(Modifiers::COMMAND | Modifiers::SHIFT, Key::Z)
            || pressed(Modifiers::COMMAND, Key::Y)
        {
            self.redo(ui);
        }
        if pressed(Modifiers::COMMAND, Key::Z) {
            self.undo(ui);
        }
        if ui.input(|input| input.events.contains(&egui::Event::Copy)) {
            self.copy_command(ui);
        }

        // Keys of time and camera, which are those of Blender's numbers, unless a control has the keys.
        if ui.ctx().egui_wants_keyboard_input() {
            return;
        }
        self.take_time_keys(ui);
        for (key, side) in [
            (Key::Num1, StandardView::Front),
            (Key::Num3, StandardView::Right),
            (Key::Num7, StandardView::Top),
        ] {
            if pressed(Modifiers::NONE, key) {
                self.move_camera(ui, |point| point.look_from(side));
            }
        }
        if pressed(Modifiers::NONE, Key::Num5) {
            self.move_camera(ui, |point| point.is_parallel = !point.is_parallel);
        }
        if pressed(Modifiers::NONE, Key::B) {
            self.split.is_on = !self.split.is_on;
        }
        if pressed(Modifiers::NONE, Key::L) {
            self.toggle_lights();
        }
        if pressed(Modifiers::NONE, Key::Home) {
            self.viewpoint = None;
            self.changed(ui);
        }
    }

    /// Moves the camera from where it is.
    fn move_camera(&mut self, ui: &Ui, change: impl FnOnce(&mut Viewpoint)) {
        let shown = self.shown.as_ref().map(|(picture, _)| picture.viewpoint);
        if let Some(mut point) = self.viewpoint.or(shown) {
            change(&mut point);
            self.viewpoint = Some(point);
            self.changed(ui);
        }
    }

    /// Shows the presets, what can be taken away, the search, and the keys of the style.
    fn show_panel(&mut self, ui: &mut Ui) {
        ui.add_space(6.0);
        self.show_presets(ui);
        ui.add_space(2.0);
        ui.horizontal(|ui| {
            let button =
                |ui: &mut Ui, text: &str, hint: &str| ui.button(text).on_hover_text(hint).clicked();
            if button(ui, "PNG", "the picture as it is, as a file") {
                self.save(Take::Png);
            }
            if button(ui, "SVG", "the lines of the picture, as a file") {
                self.save(Take::Svg);
            }
            if button(ui, "JSON", "the lines as data, as npr lines writes them") {
                self.save(Take::Json);
            }
            self.show_films(ui);
            if button(
                ui,
                "Copy command",
                "Ctrl+C: the command line that draws this picture",
            ) {
                self.copy_command(ui);
            }
        });
        ui.add_space(4.0);
        let search = egui::TextEdit::singleline(&mut self.panel.search)
            .hint_text("Search keys: width, shadow, colour …")
            .desired_width(f32::INFINITY);
        let search = ui.add(search);
        crate::panel::name_it(&search, "Search");
        ui.add_space(2.0);
        ui.horizontal(|ui| {
            let (undo, redo) = self.history.can();
            let small = |text: &str| egui::Button::new(text.to_owned()).small();
            let response = ui.add_enabled(undo, small("Undo"));
            if response.on_hover_text("Ctrl+Z").clicked() {
                self.undo(ui);
            }
            let response = ui.add_enabled(redo, small("Redo"));
            if response.on_hover_text("Ctrl+Y").clicked() {
                self.redo(ui);
            }
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                for (text, is_open) in [("Fold all", false), ("Unfold all", true)] {
                    if ui.add(small(text)).clicked() {
                        self.panel.fold(is_open);
                    }
                }
            });
        });
        ui.add_space(2.0);
        ui.horizontal(|ui| {
            self.show_layers(ui);
            let guides = ui.toggle_value(&mut self.places_guides, "Guides");
            crate::panel::name_it(&guides, "Guide points");
            guides.on_hover_text(
                "a click on the model adds a guide point, where lines thin out; one on its dot takes it away",
            );
            let lights = ui.selectable_label(self.moves_lights, "Lights");
            let hint = "L: handles over the picture, which turn the lights of the style";
            if lights.on_hover_text(hint).clicked() {
                self.toggle_lights();
            }
        });
        ui.separator();
        let edits = egui::ScrollArea::vertical()
            .auto_shrink([false; 2])
            .show(ui, |ui| {
                self.show_figure(ui);
                self.show_smoke(ui);
                let edits = self.panel.show(ui, &self.sheet, &mut self.swatches);
                self.show_times(ui);
                edits
            })
            .inner;
        for edit in &edits {
            self.edit(edit, ui);
        }
        if ui.input(|input| input.pointer.any_released()) {
            self.history.close();
        }
    }

    /// Shows the presets as a list, and a button that saves the style.
    fn show_presets(&mut self, ui: &mut Ui) {
        let mut chosen = None;
        ui.horizontal(|ui| {
            ui.label(RichText::new("Style").strong().size(15.0));
            let from_right = Layout::right_to_left(Align::Center);
            ui.with_layout(from_right, |ui| {
                let save = ui.button("Save style");
                if save
                    .on_hover_text("Ctrl+S: a style file with what is changed")
                    .clicked()
                {
                    self.save(Take::Style);
                }
                let split = ui.toggle_value(&mut self.split.is_on, "Before");
                split.on_hover_text("B: the style as it was opened, left of a handle to drag");
                chosen = self.show_gallery(ui);
            });
        });
        if let Some(name) = chosen {
            self.take_style(name, ui);
        }
    }

    /// Shows what is told, or how the picture was drawn.
    fn show_told(&mut self, ui: &mut Ui) {
        ui.horizontal_wrapped(|ui| {
            self.show_filming(ui);
            if let Some((text, is_fault)) = &self.told {
                let text = match is_fault {
                    true => RichText::new(text).color(ui.visuals().error_fg_color),
                    false => RichText::new(text),
                };
                ui.label(text);
                return;
            }
            let Some((picture, _)) = &self.shown else {
                ui.label(format!("{} is being drawn", self.scene));
                return;
            };
            let [width, height] = picture.order.size;
            let draft = if picture.order.is_draft {
                "draft, "
            } else {
                ""
            };
            ui.label(format!(
                "{}   {width} × {height}, {draft}{:.2} s, {}",
                self.scene, picture.seconds, picture.engine
            ));
            for notice in &picture.notices {
                ui.label(RichText::new(notice).color(ui.visuals().warn_fg_color));
            }
        });
    }

    /// Asks for a draft while things change, and for the full picture when they are still.
    fn ask(&mut self, ui: &Ui) {
        let now = ui.input(|input| input.time);
        let is_still = now - self.changed_s >= STILL_S
            && !self.plays()
            && !ui.input(|input| input.pointer.any_down());
        let full = self.order();
        let has = |order: &Order, shown: &Order| {
            shown.change == order.change && shown.size == order.size && !shown.is_draft
        };
        let is_done = self
            .shown
            .as_ref()
            .is_some_and(|(picture, _)| has(&full, &picture.order));
        let is_asked = self.ordered.as_ref().is_some_and(|order| has(&full, order));
        if is_done && is_still {
            self.ask_aside();
        }
        if is_done || is_asked {
            return;
        }
        if is_still || self.shown.is_none() {
            self.order_picture(full);
            return;
        }

        // A draft waits for the one before.
        let wait_s = (STILL_S - (now - self.changed_s)).max(0.01);
        ui.ctx()
            .request_repaint_after(std::time::Duration::from_secs_f64(wait_s));
        let draft = Order {
            size: self.pace.size(self.size),
            is_draft: true,
            ..full
        };
        let is_drawn = self
            .shown
            .as_ref()
            .is_some_and(|(picture, _)| picture.order.change == self.change);
        let is_free = self.ordered.as_ref().is_none_or(|order| !order.is_draft);
        if is_free && !is_drawn {
            self.order_picture(draft);
        }
    }

    /// Asks for a picture, in place of one beside it that waits.
    fn order_picture(&mut self, order: Order) {
        self.aside = None;
        self.ordered = Some(order.clone());
        self.host.draw(order);
    }
}
