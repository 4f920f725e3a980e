// How much of the sky a place sees where nothing hides it.

struct SkyPoint {
    all: bool,
}

fn open_at(open: SkyPoint, offset: vec2<f32>) -> Openness {
    return Openness(1.0, 1.0);
}

fn openness(corners: Corners, px: vec2<f32>) -> SkyPoint {
    return SkyPoint(true);
}
