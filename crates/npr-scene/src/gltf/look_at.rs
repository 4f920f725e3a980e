//! How VRM 0.x and 1.0 say that a figure looks somewhere; what is broken counts as if it were not said, with a notice.
#![deny(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing,
    clippy::arithmetic_side_effects
)]

use serde_json::Value;

use crate::error::SceneError;
use crate::loading::Loading;
use crate::look_at::{Eyes, LookAt, RangeMap};
use crate::posture::numbers;

/// Where a figure looks from where the file does not say, in the space of its head.
const OFFSET: [f32; 3] = [0.0, 0.06, 0.0];

/// The angle from which a look does not grow any more where the file does not say, in degrees.
const MOST_DEG: f32 = 90.0;

/// The least such angle, in degrees.
const LEAST_DEG: f32 = 0.01;

/// The curve that grows evenly.
const EVEN: [[f32; 4]; 2] = [[0.0, 0.0, 0.0, 1.0], [1.0, 1.0, 1.0, 0.0]];

/// What VRM 1.0 says of looks.
///
/// # Errors
///
/// More keys than the memory limit.
pub(crate) fn of_1(vrm: &Value, loading: &mut Loading) -> Result<Option<LookAt>, SceneError> {
    let Some(said) = vrm.get("lookAt").filter(|said| said.is_object()) else {
        return Ok(None);
    };
    let eyes = match said.get("type").and_then(Value::as_str) {
        Some("expression") => Eyes::Expressions,
        _ => Eyes::Bones,
    };
    let offset = said.get("offsetFromHeadBone");
    let offset = offset.map_or(Some(OFFSET), numbers::<3>);
    let ranges = ("rangeMap", ["inputMaxValue", "outputScale"]);
    look_at(said, (eyes, offset), ranges, loading).map(Some)
}

/// What VRM 0.x says of looks.
///
/// # Errors
///
/// More keys than the memory limit.
pub(crate) fn of_0(vrm: &Value, loading: &mut Loading) -> Result<Option<LookAt>, SceneError> {
    let Some(said) = vrm.get("firstPerson").filter(|said| said.is_object()) else {
        return Ok(None);
    };
    let eyes = match said.get("lookAtTypeName").and_then(Value::as_str) {
        Some("BlendShape") => Eyes::Expressions,
        _ => Eyes::Bones,
    };
    let offset = said.get("firstPersonBoneOffset");
    let offset = offset.map_or(Some(OFFSET), |offset| vector_of_0(offset, OFFSET));
    let ranges = ("lookAt", ["xRange", "yRange"]);
    look_at(said, (eyes, offset), ranges, loading).map(Some)
}

/// What both versions say alike: an offset, and ranges by names that begin with `prefix`, each with the names of its
/// greatest input and output.
fn look_at(
    said: &Value,
    (eyes, offset): (Eyes, Option<[f32; 3]>),
    (prefix, keys): (&str, [&str; 2]),
    loading: &mut Loading,
) -> Result<LookAt, SceneError> {
    if offset.is_none() {
        note(loading, "the offset of looks from the head");
    }
    let mut map = |key: &str| range_map(said.get(format!("{prefix}{key}")), keys, eyes, loading);
    Ok(LookAt {
        eyes,
        offset: offset.unwrap_or(OFFSET),
        inner: map("HorizontalInner")?,
        outer: map("HorizontalOuter")?,
        down: map("VerticalDown")?,
        up: map("VerticalUp")?,
    })
}

/// A vector of VRM 0.x as an object of three numbers, in the space of glTF, whose z runs the other way; what it lacks
/// is that of `default`. None where one is no number in range.
pub(crate) fn vector_of_0(said: &Value, default: [f32; 3]) -> Option<[f32; 3]> {
    let [x, y, z] = default;
    let part = |key: &str, default: f32| said.get(key).map_or(Some(default), number);
    let is_there = said.is_object();
    let vector = [part("x", x)?, part("y", y)?, -part("z", -z)?];
    vector
        .iter()
        .all(|v| v.abs() <= crate::POSITION_LIMIT)
        .then_some(vector)
        .filter(|_| is_there)
}

/// A finite number.
pub(crate) fn number(said: &Value) -> Option<f32> {
    said.as_f64().map(|v| v as f32).filter(|v| v.is_finite())
}

/// What an angle becomes, by the names of its greatest input and output.
fn range_map(
    said: Option<&Value>,
    [most, output]: [&str; 2],
    eyes: Eyes,
    loading: &mut Loading,
) -> Result<RangeMap, SceneError> {
    // Read its two numbers.
    let usual = match eyes {
        Eyes::Bones => 10.0,
        Eyes::Expressions => 1.0,
    };
    let mut part = |key: &str, default: f32| {
        let said = said.and_then(|said| said.get(key));
        let value = said.map_or(Some(default), number);
        if value.is_none() {
            note(loading, &format!("'{key}' of how it looks"));
        }
        value.unwrap_or(default)
    };
    let (most_deg, output) = (part(most, MOST_DEG), part(output, usual));

    // Read its curve, which VRM 1.0 has none of.
    let list = said.and_then(|said| said.get("curve"));
    let list = list
        .and_then(Value::as_array)
        .map_or(&[][..], Vec::as_slice);
    loading
        .allowance
        .take::<f32>("curves of looks", list.len())?;
    let values: Option<Vec<f32>> = list.iter().map(number).collect();
    let (keys, rest) = values.as_deref().unwrap_or_default().as_chunks::<4>();
    let rises = keys.is_sorted_by(|a, b| a.first() < b.first());
    let is_sound = values.is_some() && rest.is_empty() && rises;
    if !is_sound {
        note(loading, "a curve of how it looks");
    }
    let is_even = !is_sound || *keys == EVEN;
    Ok(RangeMap {
        most_deg: most_deg.max(LEAST_DEG),
        output,
        curve: if is_even { Vec::new() } else { keys.to_vec() },
    })
}

fn note(loading: &mut Loading, what: &str) {
    let text = format!("{what} of the avatar is no number that can be used; the usual one counts");
    loading.notices.add(text);
}
