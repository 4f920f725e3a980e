use super::*;
use proptest::prelude::*;

fn expression(name: &str) -> Expression {
    Expression {
        name: name.to_owned(),
        file_name: name.to_owned(),
        ..Expression::default()
    }
}

/// How much expressions show at shares.
fn shown_at(expressions: &[Expression], shares: &[f32]) -> Vec<f32> {
    shown(expressions, &(0u32..).zip(shares.iter().copied()).collect())
}

#[test]
fn overrides_block_blend_and_add_up() {
    let blocking = Expression {
        of_blinks: Override::Block,
        of_mouths: Override::Blend,
        ..expression("happy")
    };
    let blending = Expression {
        of_mouths: Override::Blend,
        of_looks: Override::Block,
        ..expression("sad")
    };
    let all = [
        blocking,
        blending,
        expression("blinkLeft"),
        expression("aa"),
        expression("lookUp"),
        expression("own"),
    ];
    let at = |shares| shown_at(&all, shares);
    assert_eq!(
        at(&[0.0, 0.0, 1.0, 1.0, 1.0, 1.0]),
        [0.0, 0.0, 1.0, 1.0, 1.0, 1.0]
    );
    assert_eq!(
        at(&[0.25, 0.0, 1.0, 1.0, 1.0, 1.0]),
        [0.25, 0.0, 0.0, 0.75, 1.0, 1.0]
    );
    assert_eq!(
        at(&[0.25, 0.25, 1.0, 0.5, 1.0, 1.0]),
        [0.25, 0.25, 0.0, 0.25, 0.0, 1.0]
    );
    assert_eq!(
        at(&[0.75, 0.75, 1.0, 1.0, 0.5, 1.0]),
        [0.75, 0.75, 0.0, 0.0, 0.0, 1.0]
    );
}

#[test]
fn a_binary_expression_shows_whole_or_not() {
    let binary = |name: &str| Expression {
        is_binary: true,
        ..expression(name)
    };
    let mouthy = Expression {
        of_mouths: Override::Blend,
        ..binary("happy")
    };
    let all = [mouthy, binary("aa"), expression("oh")];
    assert_eq!(shown_at(&all, &[0.5, 0.51, 0.4]), [0.0, 1.0, 0.4]);
    assert_eq!(shown_at(&all, &[0.6, 0.9, 1.0]), [1.0, 0.0, 0.0]);
    let half = Expression {
        of_mouths: Override::Blend,
        ..expression("sad")
    };
    assert_eq!(shown_at(&[half, binary("aa")], &[0.1, 1.0]), [0.1, 0.0]);
}

proptest! {
    #[test]
    fn without_overrides_everything_shows_at_its_share(shares in prop::collection::vec(-1f32..2.0, 5)) {
        let all = ["blink", "aa", "lookUp", "own", "happy"].map(expression);
        let wanted: Vec<f32> = shares.iter().map(|share| share.clamp(0.0, 1.0)).collect();
        prop_assert_eq!(shown_at(&all, &shares), wanted);
        prop_assert_eq!(shown_at(&all[..2], &[f32::NAN]), [0.0, 0.0]);
    }
}

#[test]
fn names_count_in_any_letter_case_and_as_vrm_0_had_them() {
    let own = Expression {
        file_name: "Grin".to_owned(),
        ..expression("happy")
    };
    let all = [
        own,
        expression("Joy"),
        expression("blinkLeft"),
        expression("Ärger"),
        expression("JOY"),
    ];
    let found = |name| find(&all, name);
    assert_eq!(
        [found("happy"), found("HAPPY"), found("grin")],
        [Some(0); 3]
    );
    assert_eq!(
        [found("Joy"), found("joy"), found("JOY")],
        [Some(1), Some(1), Some(4)]
    );
    assert_eq!(
        [found("Blink_L"), found("blinkleft"), found("äRGER")],
        [Some(2), Some(2), Some(3)]
    );
    assert_eq!([found("blink"), found(""), found("fun")], [None; 3]);
}
