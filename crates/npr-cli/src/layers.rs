//! Layers of frames as OpenEXR files.

use crate::fault::{Exit, Fault};
use exr::image::{AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer};
use exr::meta::attribute::{AttributeValue, Chromaticities, Text};
use exr::meta::header::LayerAttributes;
use exr::prelude::{SmallVec, WritableImage, f16};
use npr_core::color::premultiplied_light;
use npr_render::{Frame, LayerPixel};
use std::collections::BTreeMap;
use std::io::Cursor;
use std::mem::take;

/// Primaries and white of sRGB and of Rec. 709, on the CIE xy diagram.
const REC_709: Chromaticities = Chromaticities {
    red: exr::math::Vec2(0.64, 0.33),
    green: exr::math::Vec2(0.3, 0.6),
    blue: exr::math::Vec2(0.15, 0.06),
    white: exr::math::Vec2(0.3127, 0.329),
};

/// A value of a pixel.
type Value = fn(&LayerPixel) -> f32;

/// An OpenEXR file of a frame with its layers, which it takes out of it; `object_names` are those of the layer of
/// object ids.
///
/// The frame's colours are the channels R, G, B and A, the layers stand beside them as `line.R` to `id.line`: colours
/// as halves, all else as floats, which every program reads and which hold whole numbers up to 16 million. Compressed
/// without loss. The same frame gives the same bytes. O(pixels).
pub fn exr(frame: &mut Frame, object_names: &BTreeMap<u32, &str>) -> Result<Vec<u8>, Fault> {
    // Put every layer into channels, and let go of what they are made of.
    let size = frame.size.map(|side| side as usize);
    let channels = AnyChannels::sort(channels_of(take(&mut frame.rgba), take(&mut frame.layers)));

    // Describe them.
    let names = serde_json::to_string(object_names);
    let names = names.map_err(|error| cannot_encode(&error))?;
    let mut attributes = LayerAttributes::default();
    let names = AttributeValue::Text(Text::from_slice_unchecked(names.as_bytes()));
    attributes.other.insert("objects".into(), names);
    let (width, height) = (size[0], size[1]);
    let encoding = Encoding::SMALL_LOSSLESS;
    let layer = Layer::new((width, height), attributes, encoding, channels);
    let mut image = Image::from_layer(layer);
    image.attributes.chromaticities = Some(REC_709);

    // Encode them.
    let mut file = Cursor::new(Vec::new());
    let written = image.write().non_parallel().to_buffered(&mut file);
    written.map_err(|error| cannot_encode(&error))?;
    Ok(file.into_inner())
}

fn cannot_encode(error: &dyn std::error::Error) -> Fault {
    Fault::new(Exit::Failed, format!("cannot encode the layers: {error}"))
}

/// The channels of a frame: sRGB bytes with straight alpha, and layers.
fn channels_of(rgba: Vec<u8>, layers: Vec<LayerPixel>) -> SmallVec<[AnyChannel<FlatSamples>; 4]> {
    let (pixels, _) = rgba.as_chunks::<4>();
    let beauty = ["R", "G", "B", "A"].into_iter().enumerate();
    let beauty = beauty.map(|(i, name)| {
        let lights = pixels.iter().map(|pixel| premultiplied_light(*pixel)[i]);
        AnyChannel::new(name, FlatSamples::F16(lights.map(f16::from_f32).collect()))
    });
    let lines = ["line.R", "line.G", "line.B", "line.A"].into_iter();
    let lines = lines.enumerate().map(|(i, name)| {
        let lights = layers.iter().map(|pixel| f16::from_f32(pixel.line[i]));
        AnyChannel::new(name, FlatSamples::F16(lights.collect()))
    });
    let floats: [(&str, Value); 9] = [
        ("depth.Z", |pixel| pixel.depth),
        ("normal.X", |pixel| pixel.normal[0]),
        ("normal.Y", |pixel| pixel.normal[1]),
        ("normal.Z", |pixel| pixel.normal[2]),
        ("id.object", |pixel| pixel.object as f32),
        ("id.line", |pixel| pixel.stroke as f32),
        ("line_depth.Z", |pixel| pixel.stroke_depth),
        ("uv.U", |pixel| pixel.uv[0]),
        ("uv.V", |pixel| pixel.uv[1]),
    ];
    let floats = floats.into_iter().map(|(name, of)| {
        let values = layers.iter().map(of);
        AnyChannel::new(name, FlatSamples::F32(values.collect()))
    });
    beauty.chain(lines).chain(floats).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_frame_gives_the_same_bytes() {
        let pixel = LayerPixel {
            line: [0.0, 0.0, 0.0, 0.5],
            depth: LayerPixel::FAR,
            normal: [0.0; 3],
            object: 1,
            stroke: 2,
            stroke_depth: 2.5,
            uv: [3.0, -0.5],
        };
        let frame = Frame {
            size: [2, 1],
            rgba: vec![255, 0, 0, 255, 0, 0, 255, 128],
            layers: vec![pixel; 2],
            ..Frame::default()
        };
        let names = BTreeMap::from([(1, "Würfel"), (7, "Ball")]);
        let file = || exr(&mut frame.clone(), &names).expect("encoded");
        assert_eq!(file(), file());
        let has = |text: &str| {
            file()
                .windows(text.len())
                .any(|window| window == text.as_bytes())
        };
        assert!(has(r#"{"1":"Würfel","7":"Ball"}"#));
    }
}
