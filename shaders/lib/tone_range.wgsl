// Tones that a triangle can have anywhere. Twin: npr_style::corners. The shader declares `lights`.

//# use lib/lighting
//# use lib/surface_color

// How far the tone of a flat triangle may lie beyond the tones of its corners, in ramp coordinate: rounding.
const TONE_ROOM: f32 = 0.002;

// Lowest and highest ramp coordinate that the smooth normal can have anywhere towards a direction.
fn range_towards(corners: Corners, towards: vec3<f32>) -> vec2<f32> {
    let a = ramp_coordinate(dot(corners.normals[0], towards) * corners.side);
    let b = ramp_coordinate(dot(corners.normals[1], towards) * corners.side);
    let c = ramp_coordinate(dot(corners.normals[2], towards) * corners.side);
    // A blend of normals that is scaled to unit length bulges beyond them by at most their difference.
    let apart = min(
        dot(corners.normals[0], corners.normals[1]),
        min(dot(corners.normals[1], corners.normals[2]), dot(corners.normals[2], corners.normals[0])),
    );
    let room = TONE_ROOM + 0.5 * (1.0 - apart);
    return vec2<f32>(min(a, min(b, c)) - room, max(a, max(b, c)) + room);
}
