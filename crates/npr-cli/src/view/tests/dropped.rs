//! Files that are dropped on the window become what the command takes.

use super::*;
use npr_vdb::testing::Sample;
use npr_view::FileKind;

/// Checks that the command draws a picture.
fn check_command(shop: &Shop, order: &Order, picture: &Picture) {
    let words = shop.desk.words(order);
    let png = encoder::png(order.size, &picture.rgba, false).expect("a file");
    assert!(shop.drawn(&words) == png, "{}", words.join(" "));
}

#[test]
fn files_are_told_apart_by_their_names() {
    let shop = Shop::new("--backend cpu");
    for (name, kind) in [
        ("/a/b.toml", FileKind::Style),
        ("b.PNG", FileKind::Picture),
        ("b.jpg", FileKind::Picture),
        ("b.jpeg", FileKind::Picture),
        ("b.vdb", FileKind::Volume),
        ("b.npy", FileKind::Volume),
        ("b.vrm", FileKind::Scene),
        ("png", FileKind::Scene),
    ] {
        assert_eq!(shop.desk.kind(name), kind, "{name}");
    }
}

#[test]
fn smoke_that_is_dropped_into_a_scene_is_drawn_with_it() {
    // Drop smoke into a scene that has some already.
    let [own, ball, large] = [2, 4, 6].map(|radius| Sample::ball(radius).bytes());
    let files = [
        ("box.obj", OBJ.as_bytes()),
        ("ball.vdb", &ball),
        ("own.vdb", &own),
    ];
    let mut shop = Shop::of(&files, "--backend cpu --volume=@/own.vdb");
    let dropped = |shop: &Shop| {
        let mut order = order(&[], Some(aside(false)));
        order.change = 2;
        order.pose.volumes = vec![shop.path("ball.vdb").to_string_lossy().into_owned()];
        order
    };
    let bare = order(&[], Some(aside(false)));
    let before = shop.picture(&bare);
    check_command(&shop, &bare, &before);
    let with_smoke = dropped(&shop);
    let picture = shop.picture(&with_smoke);
    assert!(picture.rgba != before.rgba);
    check_command(&shop, &with_smoke, &picture);

    // It is read anew where it changes, and is gone once it is taken out.
    put(&shop.path("ball.vdb"), &large);
    shop.wait(|news| (news == News::StyleChanged).then_some(()));
    let with_more = Order {
        change: 3,
        ..with_smoke
    };
    let more = shop.picture(&with_more);
    assert!(more.rgba != picture.rgba);
    check_command(&shop, &with_more, &more);
    assert!(shop.picture(&Order { change: 4, ..bare }).rgba == before.rgba);
}

#[test]
fn smoke_that_cannot_be_read_is_told_of() {
    let files = [("box.obj", OBJ.as_bytes()), ("bad.vdb", b"no smoke")];
    let mut shop = Shop::of(&files, "--backend cpu");
    let good = order(&[], None);
    let before = shop.picture(&good);
    let mut bad = Order {
        change: 2,
        ..good.clone()
    };
    bad.pose.volumes = vec![shop.path("bad.vdb").to_string_lossy().into_owned()];
    shop.desk.draw(bad);
    assert!(shop.fault().contains("bad.vdb"));
    assert!(shop.picture(&Order { change: 3, ..good }).rgba == before.rgba);
}

#[test]
fn a_picture_that_is_dropped_serves_every_use() {
    let pixels: Vec<u8> = (0..16 * 16u32)
        .flat_map(|i| [(i * 7) as u8, (i * 3) as u8, 90, (i % 16 * 16) as u8])
        .collect();
    let png = encoder::png([16, 16], &pixels, true).expect("a file");
    let mut shop = Shop::of(
        &[("box.obj", OBJ.as_bytes()), ("my sky.png", &png)],
        "--backend cpu",
    );
    let path = shop.path("my sky.png").to_string_lossy().into_owned();
    for (change, key) in [
        "background",
        "line.brush.image",
        "ink.hatch.image",
        "shade.ramp_image",
    ]
    .into_iter()
    .enumerate()
    {
        let says = format!("{key}={path}");
        let order = Order {
            change: change as u64,
            style: "toon".to_owned(),
            ..order(&["ink.tone=hatch", &says], None)
        };
        let picture = shop.picture(&order);
        check_command(&shop, &order, &picture);
    }
}

#[test]
fn every_smoke_that_needs_no_file_can_be_drawn_beside_a_box() {
    let mut shop = Shop::new("--backend cpu");
    let bare = order(&[], Some(aside(false)));
    let before = shop.picture(&bare);
    for (change, name) in (2..).zip(shop.desk.smokes()) {
        let mut with_smoke = Order {
            change,
            ..bare.clone()
        };
        with_smoke.pose.volumes = vec![format!("{name}@0.5,1,0.5*1.5")];
        let picture = shop.picture(&with_smoke);
        assert!(picture.rgba != before.rgba, "{name}");
        check_command(&shop, &with_smoke, &picture);
    }
}
