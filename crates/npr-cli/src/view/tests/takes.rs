//! Files that are taken away are those that the command writes.

use super::*;
use crate::lines;

impl Shop {
    /// The bytes of what is taken away of an order.
    fn taken(&mut self, take: Take, order: &Order) -> Vec<u8> {
        let base = self.desk.style(&order.style).expect("a preset");
        let sheet = Sheet::new(&order.style, base, &order.overrides).expect("a style");
        self.desk.save(take, &sheet, order);
        let told = self.wait(|news| match news {
            News::Done(text) => Some(text),
            News::Fault(text) => panic!("{text}"),
            _ => None,
        });
        let path = told.split('\'').nth(1).expect("a name").to_owned();
        std::fs::read(path).expect("a file")
    }

    /// What `npr lines` writes of an order into a file with an ending.
    fn lined(&self, order: &Order, ending: &str) -> Vec<u8> {
        let path = self.path(&format!("lined.{ending}"));
        let mut words = self.desk.words_of("lines", order);
        words.extend(["-o".to_owned(), path.to_string_lossy().into_owned()]);
        let parsed = Arguments::try_parse_from(words).expect("a right line");
        let Command::Lines(args) = parsed.command else {
            panic!("another command");
        };
        lines::lines(&args.0).expect("lines");
        std::fs::read(path).expect("a file")
    }
}

#[test]
fn lines_as_data_are_those_of_the_command() {
    // One style fills surfaces, the other draws lines on paper.
    let mut shop = Shop::new("--backend cpu --seed 3");
    let mut seen = Vec::new();
    for style in ["toon", "ink"] {
        for viewpoint in [None, Some(aside(true))] {
            let order = Order {
                style: style.to_owned(),
                ..order(&["line.width.max=4"], viewpoint)
            };
            let json = shop.taken(Take::Json, &order);
            assert!(json == shop.lined(&order, "json"), "{style} {viewpoint:?}");
            assert!(json.starts_with(b"{") && !seen.contains(&json));
            seen.push(json);
        }
    }
    assert!(shop.path("box.json").exists() && shop.path("box-3.json").exists());
}

#[test]
fn lines_of_a_style_that_fills_surfaces_are_those_of_the_command() {
    let mut shop = Shop::new("--backend cpu");
    let order = Order {
        style: "toon".to_owned(),
        ..order(&[], None)
    };
    let svg = shop.taken(Take::Svg, &order);
    assert!(svg == shop.lined(&order, "svg"));
}
