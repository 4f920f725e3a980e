//! Lights of the style that are dragged round the middle of the scene.

use egui::{Color32, CursorIcon, Pos2, Rect, Sense, Stroke, Ui, Vec2, pos2, vec2};
use npr_stylesheet::{LightShape, LightSpace};
use toml::Value;

use super::Studio;
use crate::panel::{Edit, arrows, name_it};

/// Radius of the ball that lights lie on, as a share of the picture's smaller side: lights behind it lie outside, up to
/// twice as far from the middle.
const RADIUS: f32 = 0.23;

/// Side of the room in which a handle is taken hold of, in points, and radius of its dot.
const ROOM: f32 = 26.0;
const DOT: f32 = 7.0;

/// What an arrow key moves a handle by, in radii of the ball.
const STEP: f32 = 0.05;

/// Farthest from the middle that a handle goes, in radii: at 2 lies what shines from straight behind.
const FARTHEST: f32 = 1.99;

/// Digits behind the point of directions that a drag gives.
const DIGITS: f32 = 1000.0;

/// A light of the style with a direction.
struct Handle {
    name: String,
    /// The key of the direction, and for an entry of `light.extra` its number.
    key: &'static str,
    entry: Option<usize>,
    /// Towards the light.
    direction: [f32; 3],
    /// Whether that is said in the axes of the camera.
    on_camera: bool,
    color: Color32,
}

/// The ball that lights lie on: its middle and radius in the window, and the axes of the camera.
struct Ball {
    middle: Pos2,
    radius: f32,
    axes: [[f32; 3]; 3],
}

impl Studio {
    /// The lights that can be dragged.
    fn light_handles(&self) -> Vec<Handle> {
        let style = self.sheet.style();
        let light = &style.light;
        let on_camera = light.space == LightSpace::Camera;
        let color = |color: npr_stylesheet::Color| Color32::from_rgb(color.r, color.g, color.b);
        let mut handles = Vec::new();
        if !(light.file && self.timeline.cast.has_lights) {
            handles.push(Handle {
                name: "main light".to_owned(),
                key: "light.direction",
                entry: None,
                direction: light.unit_direction(),
                on_camera,
                color: color(light.color),
            });
        }
        for (entry, extra) in light.extra.iter().enumerate() {
            if extra.kind != LightShape::Point {
                handles.push(Handle {
                    name: format!("light.extra.{entry}"),
                    key: "light.extra",
                    entry: Some(entry),
                    direction: extra.unit_direction(),
                    on_camera: false,
                    color: color(extra.color),
                });
            }
        }
        handles.extend(style.smoke.light.map(|direction| Handle {
            name: "light of the smoke".to_owned(),
            key: "smoke.light",
            entry: None,
            direction: unit(direction),
            on_camera,
            color: color(light.color),
        }));
        handles
    }

    /// Shows handles for lights over the picture, or no more.
    pub(super) fn toggle_lights(&mut self) {
        self.moves_lights = !self.moves_lights;
        if self.moves_lights && self.light_handles().is_empty() {
            self.tell_fault("light.file is on, so that the lights of the file shine: the style has none to drag");
        }
    }

    /// The ball over the picture that covers `place`, about the middle of the scene.
    fn ball(&self, place: Rect) -> Option<Ball> {
        let shown = self.shown.as_ref().map(|(picture, _)| picture.viewpoint);
        let viewpoint = self.viewpoint.or(shown)?;
        let [x, y] = viewpoint.share_of(viewpoint.target, self.size)?;
        let middle = place.min + vec2(x, y) * place.size();
        Some(Ball {
            middle: middle.clamp(place.min, place.max),
            radius: (RADIUS * place.size().min_elem()).max(1.0),
            axes: viewpoint.camera().axes(),
        })
    }

    /// Shows a handle for every light over the picture that covers `place`, and turns the lights.
    pub(super) fn show_lights(&mut self, ui: &mut Ui, place: Rect) {
        let Some(ball) = self.ball(place).filter(|_| self.moves_lights) else {
            return;
        };
        let faint = Stroke::new(1.5, Color32::from_gray(128));
        let painter = ui.painter().with_clip_rect(place);
        painter.circle_stroke(ball.middle, ball.radius, faint);
        for handle in self.light_handles() {
            if let Some(direction) = show_handle(ui, &ball, place, &handle) {
                self.turn_light(&handle, direction, ui);
            }
        }
    }

    /// Lets a light shine from another direction.
    fn turn_light(&mut self, handle: &Handle, direction: [f32; 3], ui: &Ui) {
        let rounded = direction.map(|part| (part * DIGITS).round() / DIGITS);
        let numbers = rounded.map(|part| Value::Float(f64::from(part)));
        let direction = Value::Array(numbers.to_vec());
        let value = match handle.entry {
            None => direction,
            Some(entry) => {
                let Some(mut all) = self.sheet.value(handle.key).cloned() else {
                    return;
                };
                if let Some(light) = all.get_mut(entry).and_then(Value::as_table_mut) {
                    light.insert("direction".to_owned(), direction);
                }
                all
            }
        };
        self.edit(&Edit::Set(handle.key.to_owned(), value), ui);
    }
}

/// Shows a light, and gives the direction that the user turned it to.
fn show_handle(ui: &mut Ui, ball: &Ball, place: Rect, handle: &Handle) -> Option<[f32; 3]> {
    // Follow the mouse and the arrow keys.
    let seen = match handle.on_camera {
        true => handle.direction,
        false => ball.axes.map(|axis| dot(axis, handle.direction)),
    };
    let at = place_of(seen);
    let room = Rect::from_center_size(ball.at(at), Vec2::splat(ROOM));
    let id = ui.make_persistent_id(("light", &handle.name));
    let response = ui.interact(room, id, Sense::click_and_drag());
    name_it(&response, &format!("direction of {}", handle.name));
    let response = response.on_hover_cursor(CursorIcon::Grab);
    let response = response.on_hover_text(format!(
        "{}: inside the circle it shines from your side, outside from behind",
        handle.name
    ));
    let dragged = response.interact_pointer_pos();
    let dragged = dragged.filter(|_| response.dragged());
    let [right, up] = arrows(&response);
    let moved = match dragged {
        Some(pointer) => Some(ball.place_at(pointer)),
        None if right != 0 || up != 0 => {
            Some([at[0] + STEP * right as f32, at[1] + STEP * up as f32])
        }
        None => None,
    };

    // Draw it, and which way it shines.
    let painter = ui.painter().with_clip_rect(place);
    let is_held = response.has_focus() || response.hovered() || response.dragged();
    let edge = match is_held {
        true => Stroke::new(3.0, ui.visuals().selection.bg_fill),
        false => Stroke::new(1.5, Color32::from_gray(40)),
    };
    for (width, gray) in [(4.0, 250), (2.0, 60)] {
        let line = Stroke::new(width, Color32::from_gray(gray));
        painter.line_segment([room.center(), ball.middle], line);
    }
    let is_before = seen[2] >= 0.0;
    let fill = if is_before {
        handle.color
    } else {
        Color32::from_gray(110)
    };
    painter.circle(room.center(), DOT, fill, edge);

    // Say the direction in the axes in which the style has it.
    let [x, y, z] = direction_at(moved?);
    Some(match handle.on_camera {
        true => [x, y, z],
        false => {
            let [right, up, back] = ball.axes;
            [0, 1, 2].map(|i| right[i] * x + up[i] * y + back[i] * z)
        }
    })
}

impl Ball {
    /// Where a place lies in the window, given in radii from the middle to the right and up.
    fn at(&self, [x, y]: [f32; 2]) -> Pos2 {
        self.middle + vec2(x, -y) * self.radius
    }

    /// The place of a point of the window.
    fn place_at(&self, point: Pos2) -> [f32; 2] {
        let Pos2 { x, y } = pos2(0.0, 0.0) + (point - self.middle) / self.radius;
        [x, -y]
    }
}

/// Where the light of a direction lies, whose z points to the eye: as on a ball in the front half, and beyond its edge
/// in the back half, so that every direction has a place of its own. In radii of the ball, to the right and up.
fn place_of(direction: [f32; 3]) -> [f32; 2] {
    let [x, y, z] = direction;
    let flat = (x * x + y * y).sqrt();
    let away = if z < 0.0 { 2.0 - flat } else { flat };
    match flat > 1e-6 {
        true => [x / flat * away, y / flat * away],
        false => [0.0, away],
    }
}

/// The direction of a place, of length 1.
fn direction_at([x, y]: [f32; 2]) -> [f32; 3] {
    let away = (x * x + y * y).sqrt();
    let inside = away.min(FARTHEST);
    let flat = if inside > 1.0 { 2.0 - inside } else { inside };
    let depth = (1.0 - flat * flat).max(0.0).sqrt();
    let z = if inside > 1.0 { -depth } else { depth };
    match away > 1e-6 {
        true => [x / away * flat, y / away * flat, z],
        false => [0.0, 0.0, z],
    }
}

/// A vector with length 1; towards the eye where it has no direction. Scales first, so that no square overflows.
fn unit(v: [f32; 3]) -> [f32; 3] {
    let largest = v.iter().fold(0.0_f32, |most, part| most.max(part.abs()));
    if largest == 0.0 {
        return [0.0, 0.0, 1.0];
    }
    let scaled = v.map(|part| part / largest);
    let own = dot(scaled, scaled).sqrt();
    scaled.map(|part| part / own)
}

fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn lights_lie_as_on_a_ball_and_those_behind_beyond_its_edge() {
        assert_eq!(place_of([0.0, 0.0, 1.0]), [0.0, 0.0]);
        assert_eq!(place_of([1.0, 0.0, 0.0]), [1.0, 0.0]);
        assert_eq!(place_of([0.0, -0.6, 0.8]), [0.0, -0.6]);
        assert_eq!(place_of([0.0, -0.6, -0.8]), [0.0, -1.4]);
        assert_eq!(place_of([0.0, 0.0, -1.0]), [0.0, 2.0]);
        assert_eq!(direction_at([0.0, 0.0]), [0.0, 0.0, 1.0]);
        assert!(direction_at([0.0, 90.0])[2] < -0.99);
    }

    proptest! {
        /// What lies under the pointer stays there.
        #[test]
        fn a_direction_lies_where_it_was_put(x in -1.4f32..1.4, y in -1.4f32..1.4) {
            let direction = direction_at([x, y]);
            prop_assert!((dot(direction, direction) - 1.0).abs() < 1e-5);
            let [right, up] = place_of(direction);
            let is_far = (x * x + y * y).sqrt() > FARTHEST;
            prop_assert!(is_far || (right - x).abs() < 1e-3 && (up - y).abs() < 1e-3);
        }
    }
}
