//! Numbers as text on a fixed grid: the same bytes everywhere, no exponent, no minus zero, nothing that is no number.

/// Grid numbers beyond this are held at it; it is exact in a double.
const FAR: f64 = 1e15;

/// The nearest multiple of `10^-decimals`, as a whole number of such steps; 0 for what is no number.
pub fn on_grid(value: f64, decimals: u32) -> i64 {
    let steps = (value * 10f64.powi(decimals as i32)).round();
    if steps.is_nan() {
        0
    } else {
        steps.clamp(-FAR, FAR) as i64
    }
}

/// Writes a number of `10^-decimals`, without zeros at its end.
pub fn push_steps(text: &mut String, steps: i64, decimals: u32) {
    let one = 10u64.pow(decimals);
    let (whole, mut part) = (steps.unsigned_abs() / one, steps.unsigned_abs() % one);
    if steps < 0 {
        text.push('-');
    }
    push_digits(text, whole, 1);
    if part == 0 {
        return;
    }
    let mut digits = decimals as usize;
    while part % 10 == 0 {
        part /= 10;
        digits -= 1;
    }
    text.push('.');
    push_digits(text, part, digits);
}

/// Writes a whole number with at least so many digits: several times faster than formatting, which files of curves
/// spend their time in.
fn push_digits(text: &mut String, mut number: u64, least: usize) {
    let mut digits = [b'0'; 20];
    let mut start = digits.len();
    while number > 0 || digits.len() - start < least {
        start -= 1;
        digits[start] = b'0' + (number % 10) as u8;
        number /= 10;
    }
    text.extend(digits[start..].iter().map(|digit| char::from(*digit)));
}

/// Writes a value rounded to a multiple of `10^-decimals`.
pub fn push_fixed(text: &mut String, value: f64, decimals: u32) {
    push_steps(text, on_grid(value, decimals), decimals);
}

/// Writes a value with seven significant digits, in a form that JSON reads; 0 for what is no finite number.
pub fn push_significant(text: &mut String, value: f64) {
    use std::fmt::Write;
    if value == 0.0 || !value.is_finite() {
        text.push('0');
        return;
    }
    let size = value.abs();
    if (1.0..1e6).contains(&size) {
        // As many decimals as leave seven digits; the common case, and the fast one.
        let whole_digits = (size as u64).ilog10() + 1;
        return push_fixed(text, value, 7 - whole_digits);
    }
    let rounded: f64 = format!("{value:.6e}").parse().unwrap_or(0.0);
    let _ = if (1e-5..1e15).contains(&size) {
        write!(text, "{rounded}")
    } else {
        write!(text, "{rounded:e}")
    };
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn fixed(value: f64, decimals: u32) -> String {
        let mut text = String::new();
        push_fixed(&mut text, value, decimals);
        text
    }

    fn significant(value: f64) -> String {
        let mut text = String::new();
        push_significant(&mut text, value);
        text
    }

    #[test]
    fn numbers_are_plain() {
        for (value, decimals, text) in [
            (0.0, 2, "0"),
            (-0.001, 2, "0"),
            (-0.5, 2, "-0.5"),
            (1.005e3, 2, "1005"),
            (12.3456, 3, "12.346"),
            (-7.01, 2, "-7.01"),
            (f64::NAN, 2, "0"),
            (f64::INFINITY, 0, "1000000000000000"),
        ] {
            assert_eq!(fixed(value, decimals), text);
        }
        for (value, text) in [
            (0.1, "0.1"),
            (123.456789, "123.4568"),
            (-1e-9, "-1e-9"),
            (1e300, "1e300"),
            (999_999.96, "1000000"),
            (f64::NAN, "0"),
        ] {
            assert_eq!(significant(value), text);
        }
    }

    proptest! {
        #[test]
        fn text_reads_back_on_the_grid(value in -1e6..1e6f64, decimals in 0u32..4) {
            let back: f64 = fixed(value, decimals).parse().expect("a number");
            prop_assert!((back - value).abs() <= 0.5 * 10f64.powi(-(decimals as i32)) + 1e-9);
        }

        #[test]
        fn seven_digits_are_kept(value: f64) {
            let back: f64 = significant(value).parse().expect("a number");
            prop_assert!(!value.is_finite() || (back - value).abs() <= 1e-6 * value.abs());
        }
    }
}
