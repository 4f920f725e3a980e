//! Places and ways of springs.

/// A place or a way. In double precision, so that what rests stays.
pub(super) type Vector = [f64; 3];

pub(super) fn plus(a: Vector, b: Vector) -> Vector {
    std::array::from_fn(|i| a[i] + b[i])
}

pub(super) fn minus(a: Vector, b: Vector) -> Vector {
    std::array::from_fn(|i| a[i] - b[i])
}

pub(super) fn scaled(a: Vector, factor: f64) -> Vector {
    a.map(|v| v * factor)
}

pub(super) fn length(a: Vector) -> f64 {
    a.iter().map(|v| v * v).sum::<f64>().sqrt()
}

pub(super) fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
