//! Films that are taken away are those of `npr animate`.

use super::*;
use crate::animate;
use npr_scene::testing::wing;
use npr_view::{Film, FilmForm};

const FILM: Film = Film {
    form: FilmForm::Frames,
    fps: 4.0,
    plays: true,
    turns: false,
};

/// An order of a small picture at a moment of a clip.
fn moment(film: &Film) -> Order {
    let pose = Pose {
        clip: Some("Beat".to_owned()),
        time_s: Some(0.5),
        ..Pose::default()
    };
    Order {
        pose: film.pose(&pose),
        size: [48, 32],
        ..order(&[], Some(aside(false)))
    }
}

impl Shop {
    /// Lets the desk draw a film, and gives what it tells at the end, and how far it was told to be.
    fn film(&mut self, film: &Film) -> (String, Vec<[usize; 2]>) {
        self.desk.film(film, &moment(film));
        let far = std::cell::RefCell::new(Vec::new());
        let told = self.wait(|news| match news {
            News::Film(done) => {
                far.borrow_mut().extend(done);
                None
            }
            News::Done(text) | News::Fault(text) => Some(text),
            _ => None,
        });
        (told, far.into_inner())
    }

    /// The names of the files in the folder, in order.
    fn names(&self) -> Vec<String> {
        let files = std::fs::read_dir(self.folder.path()).expect("a folder");
        let name = |file: std::io::Result<std::fs::DirEntry>| {
            let name = file.expect("a file").file_name();
            name.to_string_lossy().into_owned()
        };
        let mut names: Vec<String> = files.map(name).collect();
        names.sort();
        names
    }

    /// Runs the command line of a film, into files whose names begin with `by`.
    fn filmed(&self, film: &Film) {
        let mut words = self.desk.film_words(film, &moment(film));
        let name = words.last_mut().expect("a name");
        *name = self
            .path(&format!("by-{name}"))
            .to_string_lossy()
            .into_owned();
        let parsed = Arguments::try_parse_from(words).expect("a right line");
        let Command::Animate(args) = parsed.command else {
            panic!("another command");
        };
        animate::animate(&args.0).expect("a film");
    }
}

#[test]
fn a_film_is_the_one_of_its_command_line() {
    let cases = [
        FILM,
        Film {
            form: FilmForm::Apng,
            turns: true,
            ..FILM
        },
        Film {
            form: FilmForm::Gif,
            plays: false,
            turns: true,
            fps: 1.0,
        },
    ];
    for film in cases {
        let mut shop = Shop::of(&[("wing.glb", &wing())], "--backend cpu");
        let (told, far) = shop.film(&film);
        assert!(told.ends_with("is written"), "{told}");
        let count = if film.plays { 8 } else { 5 };
        let all: Vec<[usize; 2]> = (1..=count).map(|done| [done, count]).collect();
        assert!(far == all, "{far:?}");

        // Compare its files.
        shop.filmed(&film);
        let names = shop.names();
        let (by, own): (Vec<&String>, Vec<&String>) =
            names.iter().partition(|name| name.starts_with("by-"));
        let own: Vec<&&String> = own.iter().filter(|name| **name != "wing.glb").collect();
        assert_eq!(own.len(), if film.form == FilmForm::Frames { 8 } else { 1 });
        for (by, own) in by.iter().zip(own) {
            let bytes = |name: &str| std::fs::read(shop.path(name)).expect("a file");
            assert!(bytes(by) == bytes(own), "{by} {own}");
        }
        let command = shop.desk.film_command(&film, &moment(&film));
        assert!(command.starts_with("npr animate "), "{command}");
        assert_eq!(command.contains("--time"), !film.plays, "{command}");
    }
}

#[test]
fn a_film_that_is_cancelled_leaves_no_half() {
    let mut shop = Shop::of(&[("wing.glb", &wing())], "--backend cpu");
    let film = Film {
        form: FilmForm::Apng,
        fps: 1000.0,
        ..FILM
    };
    shop.desk.film(&film, &moment(&film));
    shop.wait(|news| matches!(news, News::Film(Some(_))).then_some(()));
    shop.desk.cancel();
    assert_eq!(shop.fault(), "the film is cancelled");
    assert_eq!(shop.names(), ["wing.glb"]);

    // The painter goes on: pictures are drawn, and another film is.
    shop.picture(&moment(&Film {
        plays: false,
        ..FILM
    }));
    let (told, _) = shop.film(&Film {
        form: FilmForm::Gif,
        ..FILM
    });
    assert!(told.contains("wing.gif"), "{told}");

    // A window that is closed cancels, too.
    shop.desk.film(&film, &moment(&film));
    shop.wait(|news| matches!(news, News::Film(Some(_))).then_some(()));
    let Shop { folder, desk } = shop;
    drop(desk);
    let left = std::fs::read_dir(folder.path()).expect("a folder").count();
    assert_eq!(left, 2);
}
