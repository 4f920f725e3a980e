//! Pictures beside the present one are what the command draws, and leave it as it is.

use super::*;
use npr_view::Swatch;

/// What the host tells of a picture beside the present one.
fn beside(shop: &mut Shop, order: &Order) -> Result<Picture, String> {
    shop.desk.draw_aside(order.clone());
    shop.wait(|news| match news {
        News::Aside(drawn, picture) if *drawn == *order => Some(picture.map(|picture| *picture)),
        _ => None,
    })
}

#[test]
fn a_picture_beside_the_present_one_is_what_the_command_draws() {
    let mut shop = Shop::new("--backend cpu");
    for viewpoint in [None, Some(aside(false))] {
        let now = order(&["line.color=#0000ff", "line.method=shape"], viewpoint);
        let before = Order {
            change: 0,
            style: "toon".to_owned(),
            overrides: vec!["line.width.base=4px".to_owned()],
            ..now.clone()
        };
        let first = shop.picture(&now);
        let picture = beside(&mut shop, &before).expect("a picture");
        let png = encoder::png(before.size, &picture.rgba, false).expect("a file");
        assert!(
            shop.drawn(&shop.desk.words(&before)) == png,
            "{viewpoint:?}"
        );
        assert_eq!(picture.viewpoint, first.viewpoint);
        let again = shop.picture(&Order { change: 2, ..now });
        assert!(again.rgba == first.rgba && again.rgba != picture.rgba);
    }
}

#[test]
fn a_picture_beside_that_cannot_be_drawn_is_told_of_and_the_present_one_goes_on() {
    let mut shop = Shop::new("--backend cpu");
    let now = order(&[], None);
    let first = shop.picture(&now);
    let broken = order(&["background=none.png"], None);
    let fault = beside(&mut shop, &broken).expect_err("no such picture");
    assert!(fault.contains("none.png"), "{fault}");
    let again = shop.picture(&Order { change: 2, ..now });
    assert!(again.rgba == first.rgba);
}

#[test]
fn a_picture_that_is_asked_for_later_takes_the_place_of_one_beside_it() {
    let mut shop = Shop::new("--backend cpu");
    shop.picture(&order(&[], None));
    let drafts = (2..5).map(|change| Order {
        change,
        is_draft: true,
        ..order(&[], Some(aside(false)))
    });
    // All are asked for while the first is drawn.
    let slow = Order {
        size: [1600, 1200],
        ..order(&[], Some(aside(true)))
    };
    shop.desk.draw(slow);
    thread::sleep(Duration::from_millis(20));
    shop.desk.draw_aside(order(&["line.opacity=0.5"], None));
    for draft in drafts {
        shop.desk.draw(draft);
    }
    shop.wait(|news| match news {
        News::Picture(picture) => (picture.order.change == 4).then_some(()),
        News::Aside(..) => panic!("drawn before a later one"),
        _ => None,
    });
}

#[test]
fn a_small_picture_of_a_preset_has_the_strokes_of_the_large_one() {
    let mut shop = Shop::new("--backend cpu");
    let now = Order {
        size: [480, 360],
        ..order(&[], Some(aside(false)))
    };
    let preset = Order {
        style: "toon".to_owned(),
        overrides: vec!["line.width.base=12px".to_owned()],
        ..now.clone()
    };
    let large = ink_of(&shop.picture(&preset));
    shop.picture(&now);
    let small = Order {
        size: [160, 120],
        is_draft: true,
        ..preset
    };
    let small = ink_of(&beside(&mut shop, &small).expect("a picture"));
    assert!((small / large - 1.0).abs() < 0.15, "{small} of {large}");
}

/// How dark a column of the middle rows of a sample is, 0..1.
fn darkness(picture: &Picture, column: u32) -> f64 {
    let [width, height] = picture.order.size;
    let rows = height / 2 - 20..height / 2 + 20;
    let light = rows.map(|row| f64::from(picture.rgba[((row * width + column) * 4 + 1) as usize]));
    1.0 - light.sum::<f64>() / (40.0 * 255.0)
}

/// The sample of an order, of which the scene is no part.
fn sample(shop: &mut Shop, swatch: Swatch, overrides: &[&str]) -> Picture {
    let order = Order {
        swatch: Some(swatch),
        size: [236, 480],
        ..order(overrides, None)
    };
    beside(shop, &order).expect("a picture")
}

#[test]
fn a_sample_of_a_brush_is_one_stroke_with_both_its_ends() {
    let mut shop = Shop::new("--backend cpu --volume puff --eye 1,2,3");
    shop.picture(&order(&[], None));
    let style = [
        "background=#ffffff",
        "shade.paper=#ffffff",
        "line.width.base=6px",
    ];
    let pen = sample(&mut shop, Swatch::Brush, &style);
    let dark = |picture: &Picture, columns: [u32; 2]| {
        let [first, last] = columns;
        let all = (first..last).map(|column| darkness(picture, column));
        all.sum::<f64>() / f64::from(last - first)
    };
    assert!(dark(&pen, [0, 12]) == 0.0 && dark(&pen, [224, 236]) == 0.0);
    assert!(dark(&pen, [60, 176]) > 0.03, "{}", dark(&pen, [60, 176]));
    let tapered = [&style[..], &["line.width.taper.start=200px"]].concat();
    let tapered = sample(&mut shop, Swatch::Brush, &tapered);
    let (start, end) = (dark(&tapered, [26, 60]), dark(&tapered, [176, 210]));
    assert!(start < 0.75 * end, "{start} {end}");
    let chalk = [&style[..], &["line.brush.tip=chalk"]].concat();
    let chalk = sample(&mut shop, Swatch::Brush, &chalk);
    assert!(chalk.rgba != pen.rgba && dark(&chalk, [60, 176]) > 0.01);
}

#[test]
fn a_sample_of_hatching_is_dark_at_the_left_and_light_at_the_right() {
    let mut shop = Shop::new("--backend cpu");
    shop.picture(&order(&[], None));
    let style = ["ink.tone=hatch", "ink.hatch.spacing=6px"];
    let lines = sample(&mut shop, Swatch::Hatch, &style);
    let dark = |picture: &Picture, first: u32| {
        let all = (first..first + 40).map(|column| darkness(picture, column));
        all.sum::<f64>() / 40.0
    };
    let shares = [10, 100, 186].map(|first| dark(&lines, first));
    assert!(
        shares[0] > shares[1] && shares[1] > shares[2] + 0.05,
        "{shares:?}"
    );
    let dots = [&style[..], &["ink.hatch.pattern=dots"]].concat();
    assert!(sample(&mut shop, Swatch::Hatch, &dots).rgba != lines.rgba);
}

#[test]
fn a_full_picture_is_ended_where_another_is_asked_for_and_a_draft_is_not() {
    let mut shop = Shop::new("--backend cpu");
    shop.picture(&order(&[], None));
    let large = Order {
        change: 2,
        size: [1600, 1200],
        ..order(&[], Some(aside(true)))
    };
    for is_draft in [false, true] {
        // The next is asked for while the large one is drawn.
        let large = Order {
            is_draft,
            ..large.clone()
        };
        shop.desk.draw(large);
        thread::sleep(Duration::from_millis(40));
        shop.desk.draw(Order {
            change: 3,
            is_draft: true,
            ..order(&[], Some(aside(false)))
        });
        let first = shop.wait(|news| match news {
            News::Picture(picture) => Some(picture.order.change),
            _ => None,
        });
        assert_eq!(first, if is_draft { 2 } else { 3 });
    }
}

#[test]
fn a_picture_is_drawn_to_its_end_where_nothing_else_is_asked_for() {
    let mut shop = Shop::new("--backend cpu");
    let now = order(&["line.color=#0000ff"], Some(aside(true)));
    let whole = shop.picture(&now);
    for change in 2..6 {
        // The flag is raised late, and for nothing.
        let again = Order {
            change,
            ..now.clone()
        };
        shop.desk.draw(again.clone());
        thread::sleep(Duration::from_millis(change));
        shop.desk.ends.picture.raise();
        let drawn = shop.wait(|news| match news {
            News::Picture(picture) if picture.order == again => Some(*picture),
            _ => None,
        });
        assert!(drawn.rgba == whole.rgba);
    }
}
