use super::*;
use npr_core::math;
use proptest::prelude::*;

fn channel(
    property: Property,
    interpolation: Interpolation,
    times: Vec<f32>,
    values: Vec<f32>,
) -> Channel {
    let channel = Channel {
        node: 0,
        property,
        interpolation,
        times: times.into(),
        values: values.into(),
    };
    channel.sanity_check();
    channel
}

/// Keys at ascending times, each with `width` numbers for every knot.
fn keys(width: usize) -> impl Strategy<Value = (Vec<f32>, Vec<f32>)> {
    let key = (0.05f32..2.0, prop::collection::vec(-2f32..2.0, width));
    prop::collection::vec(key, 1..8).prop_map(|keys| {
        let mut now = 0.0;
        let times = keys.iter().map(|(gap, _)| {
            now += gap;
            now
        });
        (
            times.collect(),
            keys.iter().flat_map(|(_, v)| v.clone()).collect(),
        )
    })
}

fn near(a: &[f32], b: &[f32], most: f32) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() <= most)
}

/// A unit quaternion that turns by `angle` about an axis.
fn about(axis: [f32; 3], angle: f32) -> Vec<f32> {
    let length = axis.iter().map(|v| v * v).sum::<f32>().sqrt();
    let half = math::sin(0.5 * angle) / length;
    let [x, y, z] = axis.map(|v| v * half);
    vec![x, y, z, math::cos(0.5 * angle)]
}

proptest! {
    #[test]
    fn before_and_behind_its_keys_a_curve_stands_still((times, values) in keys(3), early in 0f32..9.0) {
        for interpolation in [Interpolation::Step, Interpolation::Linear] {
            let channel = channel(Property::Scale, interpolation, times.clone(), values.clone());
            let last = times.last().copied().unwrap_or(0.0);
            for (time, key) in [
                (times[0] - early, 0), (f32::NEG_INFINITY, 0), (f32::NAN, 0),
                (last + early, times.len() - 1), (f32::INFINITY, times.len() - 1),
            ] {
                prop_assert_eq!(channel.value_at(time), &values[3 * key..3 * key + 3]);
            }
        }
    }

    #[test]
    fn steps_hold_and_never_blend((times, values) in keys(3), at in -1f32..20.0) {
        let channel = channel(Property::Translation, Interpolation::Step, times.clone(), values.clone());
        // By a walk over all keys.
        let mut wanted = &values[..3];
        for (time, value) in times.iter().zip(values.chunks(3)) {
            if *time <= at {
                wanted = value;
            }
        }
        prop_assert_eq!(channel.value_at(at), wanted);
    }

    #[test]
    fn straight_curves_are_drawn_with_a_ruler((times, values) in keys(2), at in 0f32..16.0) {
        let channel = channel(Property::Weights, Interpolation::Linear, times.clone(), values.clone());
        for (span, ends) in times.windows(2).zip(values.windows(4).step_by(2)) {
            if (span[0]..span[1]).contains(&at) {
                let share = (at - span[0]) / (span[1] - span[0]);
                let wanted = [0, 1].map(|i| ends[i] + share * (ends[i + 2] - ends[i]));
                prop_assert!(near(&channel.value_at(at), &wanted, 1e-4));
            }
        }
    }

    #[test]
    fn rotations_turn_evenly_about_one_axis(
        axis in prop::array::uniform3(-1f32..1.0), from in -3f32..3.0, turn in -3f32..3.0, share in 0f32..1.0,
        flip in any::<bool>(), lengths in prop::array::uniform2(0.3f32..3.0),
    ) {
        prop_assume!(axis.iter().map(|v| v * v).sum::<f32>() > 0.01);
        // The same turn has two quaternions, and files have some that are no unit.
        let sign = if flip { -1.0 } else { 1.0 };
        let [start, end] = [about(axis, from), about(axis, from + turn)];
        let values = start.iter().map(|v| v * lengths[0]).chain(end.iter().map(|v| v * sign * lengths[1]));
        let channel = channel(Property::Rotation, Interpolation::Linear, vec![1.0, 3.0], values.collect());
        let value = channel.value_at(1.0 + 2.0 * share);
        let wanted = about(axis, from + share * turn);
        let other: Vec<f32> = wanted.iter().map(|v| -v).collect();
        prop_assert!(near(&value, &wanted, 1e-4) || near(&value, &other, 1e-4), "{value:?} for {wanted:?}");
    }

    #[test]
    fn splines_go_through_their_keys_with_their_tangents((times, values) in keys(9)) {
        let channel = channel(Property::Translation, Interpolation::CubicSpline, times.clone(), values.clone());
        const STEP: f64 = 1e-3;
        for (key, (time, knots)) in times.iter().zip(values.chunks(9)).enumerate() {
            prop_assert!(near(&channel.value_at(*time), &knots[3..6], 1e-5));
            // Walk a little from the key: the slope is the tangent on that side.
            let sides = [(-1.0, 0, key > 0), (1.0, 6, key + 1 < times.len())];
            for (side, tangent, _) in sides.into_iter().filter(|(_, _, has)| *has) {
                let aside = (f64::from(*time) + side * STEP) as f32;
                let span = f64::from(aside) - f64::from(*time);
                let slope: Vec<f32> = channel.value_at(aside).iter().zip(&knots[3..6])
                    .map(|(there, here)| (f64::from(there - here) / span) as f32).collect();
                // Spans of a twentieth of a second bend by up to 2 * 3 * 4 / 0.05^2 on the way.
                let shortest = times.windows(2).map(|pair| pair[1] - pair[0]).fold(9.0, f32::min);
                let most = 1e-3 * 60.0 / (shortest * shortest) + 0.01;
                prop_assert!(near(&slope, &knots[tangent..tangent + 3], most), "{slope:?} {knots:?}");
            }
        }
    }

    #[test]
    fn splines_with_the_tangents_of_a_line_are_that_line(
        start in prop::array::uniform4(-2f32..2.0), slope in prop::array::uniform4(-2f32..2.0), at in 0f32..3.0,
    ) {
        let on = |time: f32| (0..4).map(move |i| start[i] + slope[i] * time);
        let key = |time: f32| slope.into_iter().chain(on(time)).chain(slope);
        let times = vec![0.5, 1.0, 2.75];
        let values = times.iter().flat_map(|time| key(*time)).collect();
        let channel = channel(Property::Weights, Interpolation::CubicSpline, times, values);
        let wanted: Vec<f32> = on(at.clamp(0.5, 2.75)).collect();
        prop_assert!(near(&channel.value_at(at), &wanted, 1e-4));
    }
}

#[test]
fn a_rotation_without_length_turns_nothing() {
    for interpolation in [Interpolation::Step, Interpolation::Linear] {
        let channel = channel(
            Property::Rotation,
            interpolation,
            vec![0.0, 1.0],
            vec![0.0; 8],
        );
        assert_eq!(channel.value_at(0.5), [0.0, 0.0, 0.0, 1.0]);
    }
}

#[test]
fn a_clip_lasts_until_its_last_key() {
    let ends = |end| {
        channel(
            Property::Scale,
            Interpolation::Step,
            vec![0.5, end],
            vec![1.0; 6],
        )
    };
    let clip = Clip {
        name: String::new(),
        channels: vec![ends(2.0), ends(7.5), ends(1.0)],
    };
    assert_eq!(
        (clip.duration_s(), Clip::default().duration_s()),
        (7.5, 0.0)
    );
}
