//! Parses points and directions.

use std::str::FromStr;

/// Three finite numbers: a point or a direction in the world.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point(pub [f32; 3]);

impl FromStr for Point {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        const EXPECTED: &str = "must be three numbers with commas between, such as 0,1.5,-3";
        let mut numbers = text
            .split(',')
            .map(|number| number.trim().parse::<f32>().ok());
        let mut next = || numbers.next().flatten().ok_or(EXPECTED);
        let point = [next()?, next()?, next()?];
        if numbers.next().is_some() {
            return Err(EXPECTED);
        }
        if !point.iter().all(|number| number.is_finite()) {
            return Err("must be of finite numbers");
        }
        Ok(Self(point))
    }
}

/// Parses a direction: any point but the origin.
pub fn direction(text: &str) -> Result<Point, String> {
    let point: Point = text.parse()?;
    if point.0 == [0.0; 3] {
        return Err("must point somewhere".to_owned());
    }
    Ok(point)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_finite_numbers_make_a_point() {
        assert_eq!("1, -2.5,3e2".parse(), Ok(Point([1.0, -2.5, 300.0])));
        for text in [
            "1,2", "1,2,3,4", "1,2,x", "", "nan,0,0", "0,inf,0", "1e99,0,0",
        ] {
            assert!(text.parse::<Point>().is_err(), "{text}");
        }
    }

    #[test]
    fn no_direction_is_zero() {
        assert!(direction("0,0,0").is_err());
        assert!(direction("0,0,-1").is_ok());
    }
}
