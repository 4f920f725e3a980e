//! Stacks of layers, against pictures painted pixel by pixel.

use super::*;
use std::collections::BTreeSet;
use std::sync::LazyLock;

/// A picture in colour as the bytes of a file.
fn file_of_colors(picture: &IndexPicture, options: &TraceOptions, format: TraceFormat) -> Vec<u8> {
    let mut bytes = Vec::new();
    trace_colors_to_file(picture, options, format, &mut bytes).expect("memory");
    bytes
}

/// One thread, and more.
static POOLS: LazyLock<[rayon::ThreadPool; 2]> = LazyLock::new(|| {
    [1, 3].map(|count| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(count);
        pool.build().expect("threads")
    })
});

/// Any small picture: blocks of a few colours, some transparent.
fn pictures() -> impl Strategy<Value = IndexPicture> {
    let sizes = (1u32..24, 1u32..20, 1u32..5);
    let palettes = prop::collection::vec(any::<[u8; 3]>(), 1..9);
    (sizes, palettes, any::<u32>()).prop_map(|((width, height, block), palette, seed)| {
        let indices = (0..width * height)
            .map(|i| {
                let place = (i % width / block) << 16 | (i / width / block);
                let number = npr_core::math::mix_bits(place ^ npr_core::math::mix_bits(seed));
                let index = number as usize % (palette.len() + 1);
                if index < palette.len() {
                    index as u16
                } else {
                    IndexPicture::NONE
                }
            })
            .collect();
        IndexPicture::new(width, height, palette, indices).expect("sound")
    })
}

/// Whether pixels of a layer that the colour itself does not reach, by steps over the layer, are there.
fn has_strays(picture: &IndexPicture, layer: &ColorLayer) -> bool {
    let [width, height] = picture.size();
    let all = (0..i64::from(height)).flat_map(|y| (0..i64::from(width)).map(move |x| (x, y)));
    let color = |(x, y): (i64, i64)| picture.indices()[(y * i64::from(width) + x) as usize];
    let mut reached: BTreeSet<_> = all.clone().filter(|p| color(*p) == layer.index).collect();
    let mut ahead: Vec<_> = reached.iter().copied().collect();
    while let Some((x, y)) = ahead.pop() {
        for (dx, dy) in [-1, 0, 1].map(|dx| [-1, 0, 1].map(|dy| (dx, dy))).concat() {
            let beside = (x + dx, y + dy);
            if layer.ink.is_ink(beside.0, beside.1) && reached.insert(beside) {
                ahead.push(beside);
            }
        }
    }
    let mut ink = all.filter(|(x, y)| layer.ink.is_ink(*x, *y));
    ink.any(|place| !reached.contains(&place))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn layers_painted_in_order_are_the_picture(picture in pictures()) {
        let [width, height] = picture.size();
        let mut stack: Vec<ColorLayer> = layers(&picture).collect();
        stack.reverse();
        let order: Vec<u16> = stack.iter().map(|layer| layer.index).collect();
        prop_assert_eq!(&order, &stacking_order(&picture));
        let mut painted = vec![IndexPicture::NONE; picture.indices().len()];
        for layer in &stack {
            for (place, to) in (0..width * height).zip(&mut painted) {
                if layer.ink.is_ink(i64::from(place % width), i64::from(place / width)) {
                    *to = layer.index;
                }
            }
        }
        prop_assert_eq!(&painted, picture.indices());
    }

    #[test]
    fn every_layer_goes_on_under_those_that_touch_it(picture in pictures()) {
        let [width, height] = picture.size();
        let mut above = BTreeSet::new();
        for layer in layers(&picture) {
            above.insert(layer.index);
            prop_assert!(!has_strays(&picture, &layer));
            for place in 0..width * height {
                let (x, y) = (i64::from(place % width), i64::from(place / width));
                let covers = above.contains(&picture.indices()[place as usize]);
                let near = [-1, 0, 1].map(|dx| [-1, 0, 1].map(|dy| layer.ink.is_ink(x + dx, y + dy))).concat();
                prop_assert_eq!(layer.ink.is_ink(x, y), covers && near.contains(&true), "{} {}", x, y);
            }
        }
    }

    #[test]
    fn colors_are_the_same_for_any_number_of_threads(picture in pictures(), turd_size in 0u64..4) {
        let options = TraceOptions { turd_size, ..TraceOptions::default() };
        for format in TraceFormat::ALL {
            let write = || file_of_colors(&picture, &options, format);
            let [alone, several] = POOLS.each_ref().map(|pool| pool.install(write));
            prop_assert_eq!(several, alone);
        }
    }

    #[test]
    fn a_picture_of_one_color_has_the_paths_of_its_bitmap(bitmap in bitmaps()) {
        let [width, height] = [bitmap.width(), bitmap.height()];
        let indices = (0..width * height)
            .map(|i| if bitmap.is_ink(i64::from(i % width), i64::from(i / width)) { 0 } else { IndexPicture::NONE })
            .collect();
        let picture = IndexPicture::new(width, height, vec![[0; 3]], indices).expect("sound");
        prop_assume!(picture.counts() != [0]);
        let options = TraceOptions::default();
        for format in [TraceFormat::Svg, TraceFormat::GeoJson] {
            let text = String::from_utf8(file_of_colors(&picture, &options, format)).expect("text");
            let plain = text.replace(",\"fill\":\"#000000\"", "");
            prop_assert_eq!(plain.into_bytes(), traced(&bitmap, &options, format));
        }
    }
}

#[test]
fn paper_is_painted_first_and_blends_lie_between() {
    let palette = vec![[128; 3], [0; 3], [255; 3]];
    for (indices, order) in [
        (vec![2, 2, 2, 0, 1], [2, 0, 1]),
        (vec![1, 1, 1, 0, 2], [1, 0, 2]),
        (vec![2, 0, 1, 0, 1], [1, 0, 2]),
    ] {
        let picture = IndexPicture::new(5, 1, palette.clone(), indices).expect("sound");
        assert_eq!(stacking_order(&picture), order);
    }
}

#[test]
fn specks_of_a_layer_show_what_lies_under_it() {
    let mut indices = vec![0; 64];
    indices[27] = 1;
    let picture = IndexPicture::new(8, 8, vec![[255; 3], [200, 0, 0]], indices).expect("sound");
    let count = |turd_size| {
        let options = TraceOptions {
            turd_size,
            ..TraceOptions::default()
        };
        let svg = file_of_colors(&picture, &options, TraceFormat::Svg);
        String::from_utf8_lossy(&svg).matches("<path").count()
    };
    assert_eq!((count(0), count(1), count(64)), (2, 1, 0));
}

#[test]
fn pictures_are_checked() {
    let palette = vec![[0; 3]; 2];
    assert!(IndexPicture::new(0, 7, palette.clone(), vec![]).is_ok());
    assert!(matches!(
        IndexPicture::new(SIDE_LIMIT + 1, 0, palette.clone(), vec![]),
        Err(IndexPictureError::TooLarge { .. })
    ));
    assert!(matches!(
        IndexPicture::new(2, 2, palette.clone(), vec![0; 3]),
        Err(IndexPictureError::Length { expected: 4, .. })
    ));
    assert!(matches!(
        IndexPicture::new(1, 1, palette, vec![2]),
        Err(IndexPictureError::MissingColor { index: 2, .. })
    ));
    let nothing = IndexPicture::new(3, 1, vec![], vec![IndexPicture::NONE; 3]).expect("sound");
    assert_eq!(layers(&nothing).count(), 0);
    let none = IndexPicture::new(0, 3, vec![[9; 3]], vec![]).expect("sound");
    assert_eq!(layers(&none).count(), 0);
}
