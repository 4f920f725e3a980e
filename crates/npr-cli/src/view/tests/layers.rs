//! Layers are those of the command.

use super::*;

#[test]
fn every_layer_is_what_the_command_draws() {
    let mut shop = Shop::new("--backend cpu");
    let layers = shop.desk.layers();
    assert!(layers.len() >= 20 && layers.iter().all(|layer| !layer.text.is_empty()));
    let whole = order(&["line.width.base=3px"], Some(aside(false)));
    let mut seen = vec![shop.picture(&whole).rgba];
    for layer in layers {
        let order = Order {
            layer: Some(layer.name.clone()),
            ..whole.clone()
        };
        // A draft before it has a renderer of its own.
        let draft = Order {
            size: [60, 45],
            is_draft: true,
            ..order.clone()
        };
        assert_eq!(shop.picture(&draft).rgba.len(), 60 * 45 * 4);
        let picture = shop.picture(&order);
        let png = encoder::png(order.size, &picture.rgba, false).expect("a file");
        let words = shop.desk.words(&order);
        assert!(words.contains(&format!("--debug-layer={}", layer.name)));
        assert!(shop.drawn(&words) == png, "{}", words.join(" "));
        seen.push(picture.rgba);
    }

    // Each is another picture, and the whole one is drawn again as it was.
    let again = shop.picture(&Order { change: 2, ..whole });
    assert!(again.rgba == seen[0]);
    let mut others = seen;
    others.sort_unstable();
    others.dedup();
    assert!(others.len() >= 18, "{}", others.len());
}

#[test]
fn a_layer_that_a_style_does_not_have_is_told_of() {
    let mut shop = Shop::new("--backend cpu");
    let of = |method: &str| Order {
        layer: Some("found".to_owned()),
        ..order(&[method], Some(aside(false)))
    };
    let told = |picture: &Picture| {
        let mut notices = picture.notices.iter();
        notices.any(|notice| notice.contains("the layer found is of one colour"))
    };
    assert!(!told(&shop.picture(&of("line.method=strokes"))));
    assert!(told(&shop.picture(&of("line.method=shape"))));
}

#[test]
fn a_picture_tells_how_long_its_passes_took() {
    let mut shop = Shop::new("--backend cpu");
    let picture = shop.picture(&order(&[], None));
    let passes = picture.passes.expect("the processor tells them apart");
    let known = |name: &str| npr_gpu::passes::ALL.iter().any(|pass| pass.name == name);
    assert!(passes.len() > 5 && passes.iter().all(|pass| known(pass.name)));
    let sum: f32 = passes.iter().map(|pass| pass.seconds).sum();
    assert!(sum > 0.0 && sum <= picture.seconds, "{sum}");
}
