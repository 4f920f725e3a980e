//! What a studio asks of the program that it is shown in.

use npr_stylesheet::Stated;

use crate::film::Film;
use crate::pose::{Cast, Pose};
use crate::sheet::Sheet;
use crate::value::number_text;
use crate::viewpoint::Viewpoint;
use crate::why::Answer;

/// A picture that is asked for.
#[derive(Debug, Clone, PartialEq)]
pub struct Order {
    /// Counts up with every change of style or camera.
    pub change: u64,
    /// Name of the preset or path of the style file.
    pub style: String,
    /// What is changed of it, as `--set` takes it.
    pub overrides: Vec<String>,
    /// Where it is seen from; `None` where the host frames the scene by itself.
    pub viewpoint: Option<Viewpoint>,
    /// How the scene stands.
    pub pose: Pose,
    /// The layer that is shown in place of the picture, by its name; none for the picture.
    pub layer: Option<String>,
    /// The sample that is drawn in place of the scene; none for the scene.
    pub swatch: Option<Swatch>,
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Whether it is for the time being, while something changes.
    pub is_draft: bool,
}

impl Order {
    /// The order as options of a command line that draws the same: style, what is changed of it, camera, size and pose.
    pub fn options(&self) -> Vec<String> {
        let mut words: Vec<String> = vec!["--style".to_owned(), self.style.clone()];
        for text in &self.overrides {
            words.extend(["--set".to_owned(), text.clone()]);
        }
        if let Some(point) = &self.viewpoint {
            let triple = |values: [f32; 3]| values.map(|value| format!("{value}")).join(",");
            for (name, values) in [
                ("--eye", point.eye),
                ("--target", point.target),
                ("--up", point.up),
            ] {
                words.push(format!("{name}={}", triple(values)));
            }
            let fov = number_text(f64::from(point.fov_deg));
            words.extend(["--fov".to_owned(), fov]);
            if point.is_parallel {
                words.push("--ortho".to_owned());
            }
        }
        let [width, height] = self.size;
        words.extend(["--size".to_owned(), format!("{width}x{height}")]);
        words.extend(self.pose.options());
        let layer = self.layer.iter();
        words.extend(layer.map(|name| format!("--debug-layer={name}")));
        words
    }
}

/// A sample of what a style draws with, seen from the front and as wide as its picture, in whose middle it lies. What
/// lengths of the style go by, it takes from the picture's height.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Swatch {
    /// A stroke with both its ends.
    Brush,
    /// Hatching from the dark at the left to the light at the right.
    Hatch,
}

/// A layer that can be shown in place of a picture.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Layer {
    /// What [`Order::layer`] and the command call it.
    pub name: String,
    /// What it shows.
    pub text: String,
}

/// What is at a place of a picture?
#[derive(Debug, Clone, PartialEq)]
pub struct Question {
    /// The picture.
    pub order: Order,
    /// The place in its pixels, from the top left corner, y down.
    pub place: [f32; 2],
    /// How far from there a line may be that is meant, in pixels.
    pub reach_px: f32,
}

/// A picture that was drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    /// Of which order.
    pub order: Order,
    /// sRGB bytes with straight alpha, row by row from the top.
    pub rgba: Vec<u8>,
    /// Where it is seen from.
    pub viewpoint: Viewpoint,
    /// What drew it, in one line.
    pub engine: String,
    /// How long that took, in seconds.
    pub seconds: f32,
    /// How long its passes took, in running order; none where the engine cannot tell them apart.
    pub passes: Option<Vec<PassSeconds>>,
    /// What was drawn in another way than the style asks.
    pub notices: Vec<String>,
}

/// How long a pass of a picture took.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PassSeconds {
    /// The name of the pass.
    pub name: &'static str,
    /// Seconds that it took.
    pub seconds: f32,
}

/// What a host has to tell.
#[derive(Debug, Clone, PartialEq)]
pub enum News {
    /// A picture is finished.
    Picture(Box<Picture>),
    /// Something went wrong; the picture before stays. One line.
    Fault(String),
    /// Something was done. One line.
    Done(String),
    /// Another scene is drawn from now on, or the same read anew, of this name, and with this to move. What was ordered
    /// before and is not drawn yet is drawn no more, but for the first scene.
    Scene(String, Box<Cast>),
    /// How many frames of a film are drawn, and of how many; none when it has ended.
    Film(Option<[usize; 2]>),
    /// The style file has changed where it lies.
    StyleChanged,
    /// A picture beside the present one is finished, or why it is not.
    Aside(Box<Order>, Result<Box<Picture>, String>),
    /// What is at a place of a picture.
    Pointed(Box<Answer>),
}

/// What is taken away from a studio.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Take {
    /// The style, as a file that extends the preset.
    Style,
    /// The picture, as `.png`.
    Png,
    /// Its lines, as `.svg`.
    Svg,
    /// Its lines as data, as `.json`.
    Json,
}

/// What a file is, by its name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FileKind {
    /// A style file.
    Style,
    /// A picture.
    Picture,
    /// A volume of smoke.
    Volume,
    /// A scene, or a motion.
    Scene,
}

/// The program that a studio is shown in: it reads files and draws.
pub trait Host {
    /// The style of a preset's name or of a file's path.
    ///
    /// # Errors
    ///
    /// What is wrong with it, in one line.
    fn style(&mut self, name: &str) -> Result<Stated, String>;

    /// What a file is, by its name.
    fn kind(&self, path: &str) -> FileKind;

    /// The layers that can be shown in place of a picture.
    fn layers(&self) -> Vec<Layer>;

    /// Names of smoke that needs no file, as `--volume` takes them.
    fn smokes(&self) -> Vec<String>;

    /// Opens a scene in place of the present one, or a motion that its figure plays; [`News`] tells how that went.
    fn open(&mut self, path: &str);

    /// Draws a picture. One that is asked for later may be drawn in place of it.
    fn draw(&mut self, order: Order);

    /// Draws a picture beside the present one, as of another style, when nothing else is to be drawn; [`News::Aside`]
    /// tells it. Any picture that is asked for later may be drawn in place of it.
    fn draw_aside(&mut self, order: Order);

    /// Finds out what is at a place of a picture; [`News::Pointed`] tells it.
    fn point_at(&mut self, question: Question);

    /// What happened since the last call.
    fn news(&mut self) -> Vec<News>;

    /// A command line that draws the picture of an order, ready for a shell.
    fn command(&self, order: &Order) -> String;

    /// Writes a file; [`News`] tells under which name.
    fn save(&mut self, take: Take, sheet: &Sheet, order: &Order);

    /// Writes the bones of a pose, those of its file and those that are turned besides, into a file for `--pose`, and
    /// gives its path.
    ///
    /// # Errors
    ///
    /// Why it is not written, in one line.
    fn save_pose(&mut self, pose: &Pose) -> Result<String, String>;

    /// A command line that draws a film, ready for a shell.
    fn film_command(&self, film: &Film, order: &Order) -> String;

    /// Draws a film and writes it; [`News`] tells how far it is, and under which name it lies.
    fn film(&mut self, film: &Film, order: &Order);

    /// Ends the film that is drawn, of which no file stays that is not whole.
    fn cancel(&mut self);
}

/// Words as a line for a shell: those with anything but plain letters in single quotes.
pub fn shell_line(words: &[String]) -> String {
    let quoted = |word: &String| {
        let is_plain =
            |letter: char| letter.is_ascii_alphanumeric() || "-_./=,:+%@".contains(letter);
        match !word.is_empty() && word.chars().all(is_plain) {
            true => word.clone(),
            false => format!("'{}'", word.replace('\'', "'\\''")),
        }
    };
    words.iter().map(quoted).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_quoted_where_a_shell_would_read_more_into_it() {
        let words = ["npr", "a b", "x=#f00", "it's", ""].map(str::to_owned);
        assert_eq!(shell_line(&words), "npr 'a b' 'x=#f00' 'it'\\''s' ''");
    }

    #[test]
    fn an_order_is_said_by_options() {
        let viewpoint = Viewpoint {
            eye: [-1.5, 0.1, 1e-7],
            target: [0.0; 3],
            up: [0.0, 1.0, 0.0],
            fov_deg: 40.0,
            is_parallel: true,
        };
        let order = Order {
            change: 0,
            style: "ink".to_owned(),
            overrides: vec!["line.color=#fff".to_owned()],
            viewpoint: Some(viewpoint),
            pose: Pose {
                time_s: Some(0.5),
                ..Pose::default()
            },
            layer: Some("found".to_owned()),
            swatch: None,
            size: [64, 48],
            is_draft: false,
        };
        assert_eq!(
            order.options().join(" "),
            "--style ink --set line.color=#fff --eye=-1.5,0.1,0.0000001 --target=0,0,0 --up=0,1,0 --fov 40 --ortho \
             --size 64x48 --time=0.5 --debug-layer=found"
        );
    }
}
