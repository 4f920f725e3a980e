//! The bar below the picture: what plays, and which moment of it is drawn.

use egui::{Button, Checkbox, ComboBox, DragValue, Key, Modifiers, RichText, Slider, Ui};

use super::Studio;
use crate::panel::name_it;
use crate::pose::{Cast, Clip};

/// Frames a second where the user says nothing, as `npr animate` has them.
const USUAL_FPS: f32 = 24.0;

/// Least and most frames a second, as `npr animate` takes them.
const RATES: [f32; 2] = [1.0, 1000.0];

/// Seconds that pictures on surfaces play where there is no clip, as in `npr animate`.
const FLOW_S: f32 = 5.0;

/// Share of a frame up to which a time counts as that of the next one: times are rounded.
const SLACK: f64 = 1e-3;

/// Width in points below which the bar has a button and a slider alone.
const WIDE: f32 = 520.0;

/// The clock of what plays.
pub(super) struct Timeline {
    /// What of the scene can move.
    pub cast: Cast,
    /// Frames a second.
    fps: f32,
    /// Whether what has ended begins again.
    loops: bool,
    /// While it plays: the time of the window when it began, in seconds, and the frame that was shown then.
    began: Option<(f64, u32)>,
}

impl Default for Timeline {
    fn default() -> Self {
        Self {
            cast: Cast::default(),
            fps: USUAL_FPS,
            loops: true,
            began: None,
        }
    }
}

impl Timeline {
    /// Whether it plays.
    pub fn plays(&self) -> bool {
        self.began.is_some()
    }

    /// Stops at the frame that is shown.
    pub fn pause(&mut self) {
        self.began = None;
    }

    /// Frames a second.
    pub fn fps(&self) -> f32 {
        self.fps
    }

    /// Whether there is anything that could play.
    pub fn has_time(&self) -> bool {
        !self.cast.clips.is_empty() || self.cast.flows
    }

    /// The clip that a word of `--clip` means: one of that name, or else of that number.
    fn clip(&self, word: &str) -> Option<&Clip> {
        let clips = &self.cast.clips;
        let named = clips.iter().find(|clip| clip.name == word);
        named.or_else(|| clips.get(word.parse::<usize>().ok()?))
    }

    /// Number of frames of a clip, the first without any name, or of what plays without clips: as many as its film has.
    fn frame_count(&self, clip: Option<&str>) -> u32 {
        let clip = match clip {
            Some(word) => self.clip(word),
            None => self.cast.clips.first(),
        };
        let seconds = clip.map_or(FLOW_S, |clip| clip.seconds);
        (f64::from(seconds) * f64::from(self.fps)).round().max(1.0) as u32
    }

    /// The frame that is shown at a time.
    fn frame_at(&self, time_s: f32) -> u32 {
        (f64::from(time_s) * f64::from(self.fps) + SLACK) as u32
    }

    /// The time of a frame, as films have it.
    fn time_of(&self, frame: u32) -> f32 {
        (f64::from(frame) / f64::from(self.fps)) as f32
    }

    /// The frame that is shown at a time of the window, and whether it is the last.
    fn played(&self, (began_s, first): (f64, u32), now_s: f64, count: u32) -> (u32, bool) {
        let passed = ((now_s - began_s) * f64::from(self.fps) + SLACK).max(0.0) as u64;
        let frame = u64::from(first) + passed;
        let last = u64::from(count) - 1;
        match self.loops {
            true => ((frame % u64::from(count)) as u32, false),
            false => (frame.min(last) as u32, frame >= last),
        }
    }
}

impl Studio {
    /// Whether what is shown plays.
    pub fn plays(&self) -> bool {
        self.timeline.plays()
    }

    /// Takes what of a scene can move. A clip that it does not have is played no more.
    pub(super) fn take_cast(&mut self, cast: Cast, ui: &Ui) {
        let (before, is_first) = (self.pose.clone(), self.shown.is_none());
        let is_other_motion = before.motion != cast.motion;
        let first = cast.clips.first().map(|clip| clip.name.clone());
        self.timeline.cast = cast;
        self.pose.motion.clone_from(&self.timeline.cast.motion);

        // Call the clip by its name; a time or another motion alone plays the first.
        let asked = before.clip.as_deref().filter(|_| !is_other_motion);
        let found = asked.and_then(|word| self.timeline.clip(word));
        self.pose.clip = match (found, asked) {
            (Some(clip), _) => Some(clip.name.clone()),
            (None, Some(word)) if is_first => Some(word.to_owned()),
            (None, _) => first.filter(|_| before.time_s.is_some() || is_other_motion),
        };
        if self.pose.clip.is_some() {
            self.pose.time_s = self.pose.time_s.or(Some(0.0));
        } else if !self.timeline.cast.flows {
            self.pose.time_s = None;
        }
        if !self.timeline.has_time() {
            self.timeline.began = None;
        }

        // At first that is what was ordered, said in other words.
        if !is_first && self.pose != before {
            self.changed(ui);
        }
    }

    /// Plays a clip of the scene from its start; none for the scene at rest.
    fn choose_clip(&mut self, name: Option<&str>, ui: &Ui) {
        self.pose.clip = name.map(str::to_owned);
        self.pose.time_s = name.map(|_| 0.0);
        self.timeline.began = None;
        self.hold_camera();
        self.changed(ui);
    }

    /// Starts to play, or stops.
    fn play_or_pause(&mut self, ui: &Ui) {
        if self.timeline.plays() {
            self.timeline.began = None;
            return self.changed(ui);
        }
        let count = self.timeline.frame_count(self.pose.clip.as_deref());
        let frame = self.frame();
        let is_over = !self.timeline.loops && frame + 1 >= count;
        let first = if is_over { 0 } else { frame };
        self.timeline.began = Some((ui.input(|input| input.time), first));
        self.show_frame(first, ui);
    }

    /// The frame that is shown.
    fn frame(&self) -> u32 {
        self.timeline.frame_at(self.pose.time_s.unwrap_or(0.0))
    }

    fn show_frame(&mut self, frame: u32, ui: &Ui) {
        self.show_time(self.timeline.time_of(frame), ui);
    }

    fn show_time(&mut self, time_s: f32, ui: &Ui) {
        self.pose.time_s = Some(time_s);
        if self.pose.clip.is_none() {
            let first = self.timeline.cast.clips.first();
            self.pose.clip = first.map(|clip| clip.name.clone());
        }
        self.hold_camera();
        self.changed(ui);
    }

    /// Leaves the camera where it is, where it would follow what moves only to frame it.
    pub(super) fn hold_camera(&mut self) {
        if self.viewpoint.is_none() && !self.timeline.cast.has_own_camera {
            self.viewpoint = self.picture().map(|picture| picture.viewpoint);
        }
    }

    /// Goes on to the frame that the clock asks for. Frames that were not drawn in time are left out.
    pub(super) fn follow_clock(&mut self, ui: &Ui) {
        let Some(began) = self.timeline.began else {
            return;
        };
        let now_s = ui.input(|input| input.time);
        let count = self.timeline.frame_count(self.pose.clip.as_deref());
        let (frame, is_last) = self.timeline.played(began, now_s, count);
        if frame != self.frame() {
            self.show_frame(frame, ui);
        }
        if is_last {
            self.timeline.began = None;
        }
        let frame_s = 1.0 / f64::from(self.timeline.fps);
        ui.ctx()
            .request_repaint_after(std::time::Duration::from_secs_f64(frame_s));
    }

    /// Takes the keys of time: Space plays, arrows step.
    pub(super) fn take_time_keys(&mut self, ui: &Ui) {
        if !self.timeline.has_time() {
            return;
        }
        let pressed = |key| ui.input_mut(|input| input.consume_key(Modifiers::NONE, key));
        if pressed(Key::Space) {
            self.play_or_pause(ui);
        }
        let steps = i32::from(pressed(Key::ArrowRight)) - i32::from(pressed(Key::ArrowLeft));
        if steps != 0 {
            self.step(steps, ui);
        }
    }

    /// Stops at the next frame, or at the one before.
    fn step(&mut self, frames: i32, ui: &Ui) {
        let count = self.timeline.frame_count(self.pose.clip.as_deref());
        let frame = i64::from(self.frame()) + i64::from(frames);
        let frame = match self.timeline.loops {
            true => frame.rem_euclid(i64::from(count)),
            false => frame.clamp(0, i64::from(count) - 1),
        };
        self.timeline.began = None;
        self.show_frame(frame as u32, ui);
    }

    /// Shows the bar, where anything can play.
    pub(super) fn show_timeline(&mut self, ui: &mut Ui) {
        if !self.timeline.has_time() || ui.available_height() < 120.0 {
            return;
        }
        egui::Panel::bottom("timeline").show(ui, |ui| {
            let is_wide = ui.available_width() >= WIDE;
            ui.horizontal(|ui| {
                self.show_transport(ui, is_wide);
            });
            if is_wide {
                ui.horizontal(|ui| self.show_clips(ui));
            }
        });
    }

    /// Shows the button that plays, the slider of frames, and the time.
    fn show_transport(&mut self, ui: &mut Ui, is_wide: bool) {
        // Play or pause.
        let name = if self.plays() { "Pause" } else { "Play" };
        let button = ui.add(Button::new(name).min_size(egui::vec2(48.0, 0.0)));
        if button.on_hover_text("Space").clicked() {
            self.play_or_pause(ui);
        }

        // Scrub.
        let count = self.timeline.frame_count(self.pose.clip.as_deref());
        let mut frame = self.frame().min(count - 1);
        let text_width = if is_wide { 170.0 } else { 0.0 };
        ui.spacing_mut().slider_width = (ui.available_width() - text_width - 12.0).max(20.0);
        let slider = ui.add(Slider::new(&mut frame, 0..=count - 1).show_value(false));
        name_it(&slider, "Frame");
        if slider
            .on_hover_text("the moment that is drawn; Left and Right step a frame")
            .changed()
        {
            self.timeline.began = None;
            self.show_frame(frame, ui);
        }
        if !is_wide {
            return;
        }

        // Tell the time.
        let mut time_s = self.pose.time_s.unwrap_or(0.0);
        let drag = DragValue::new(&mut time_s)
            .range(0.0..=self.timeline.time_of(count))
            .speed(0.01)
            .max_decimals(3)
            .suffix(" s");
        let drag = ui.add(drag);
        name_it(&drag, "Time in seconds");
        if drag.changed() {
            self.timeline.began = None;
            self.show_time(time_s, ui);
        }
        ui.label(RichText::new(format!("frame {frame} of {count}")).weak());
    }

    /// Shows which clip plays, how fast, and whether it begins again.
    fn show_clips(&mut self, ui: &mut Ui) {
        // Choose a clip.
        let mut chosen = None;
        if !self.timeline.cast.clips.is_empty() {
            let now = self.pose.clip.as_deref();
            let shown = ComboBox::from_id_salt("clips")
                .width(160.0)
                .selected_text(now.unwrap_or("at rest"))
                .show_ui(ui, |ui| {
                    if ui.selectable_label(now.is_none(), "at rest").clicked() {
                        chosen = Some(None);
                    }
                    for clip in &self.timeline.cast.clips {
                        let is_own = now == Some(&clip.name);
                        let text = format!("{}   {:.2} s", clip.name, clip.seconds);
                        if ui.selectable_label(is_own, text).clicked() {
                            chosen = Some(Some(clip.name.clone()));
                        }
                    }
                });
            name_it(&shown.response, "Clip");
        }
        if let Some(name) = chosen {
            self.choose_clip(name.as_deref(), ui);
        }

        // Set the pace.
        let [least, most] = RATES;
        let mut fps = self.timeline.fps;
        let drag = DragValue::new(&mut fps)
            .range(least..=most)
            .speed(0.2)
            .max_decimals(2)
            .suffix(" frames a second");
        let drag = ui.add(drag);
        name_it(&drag, "Frames a second");
        if drag.changed() {
            self.set_rate(fps, ui);
        }
        ui.add(Checkbox::new(&mut self.timeline.loops, "Loop"))
            .on_hover_text("what has ended begins again");
        let is_moved = self.pose.time_s.is_some_and(|time_s| time_s != 0.0);
        let back = ui.add_enabled(is_moved, Button::new("To the start"));
        if back.clicked() {
            self.timeline.began = None;
            self.show_time(0.0, ui);
        }
    }

    /// Changes the rate; what plays goes on from where it is.
    fn set_rate(&mut self, fps: f32, ui: &Ui) {
        let time_s = self.pose.time_s.unwrap_or(0.0);
        self.timeline.fps = fps;
        if self.timeline.plays() {
            let first = self.timeline.frame_at(time_s);
            self.timeline.began = Some((ui.input(|input| input.time), first));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn timeline(loops: bool) -> Timeline {
        let clip = |name: &str, seconds| Clip {
            name: name.to_owned(),
            seconds,
        };
        Timeline {
            cast: Cast {
                clips: vec![clip("1", 1.01), clip("Walk", 0.0)],
                ..Cast::default()
            },
            loops,
            ..Timeline::default()
        }
    }

    #[test]
    fn frames_are_those_of_the_film() {
        let timeline = timeline(true);
        assert_eq!(timeline.frame_count(Some("1")), 24);
        assert_eq!(timeline.frame_count(Some("Walk")), 1);
        assert_eq!(timeline.frame_count(None), 24);
        assert_eq!(Timeline::default().frame_count(None), 120);
        for frame in 0..5000 {
            assert_eq!(timeline.frame_at(timeline.time_of(frame)), frame);
        }
        assert_eq!(timeline.frame_at(-2.0), 0);
        let named = |word: &str| timeline.clip(word).map(|clip| clip.seconds);
        assert_eq!((named("1"), named("0")), (Some(1.01), Some(1.01)));
        assert_eq!(named("walk"), None);
    }

    #[test]
    fn the_clock_leaves_frames_out_and_is_never_slowed() {
        let endless = timeline(true);
        assert_eq!(endless.played((10.0, 20), 10.0, 24), (20, false));
        assert_eq!(endless.played((10.0, 20), 10.125, 24), (23, false));
        assert_eq!(endless.played((10.0, 20), 12.25, 24), (2, false));
        let once = timeline(false);
        assert_eq!(once.played((10.0, 20), 10.0, 24), (20, false));
        assert_eq!(once.played((10.0, 20), 10.125, 24), (23, true));
        assert_eq!(once.played((10.0, 20), 99.0, 24), (23, true));
        assert_eq!(once.played((10.0, 20), 9.0, 24), (20, false));
    }
}
