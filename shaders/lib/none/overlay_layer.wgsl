// Stamps where there are none.

fn overlay_at(element: u32) -> vec4<f32> {
    return vec4<f32>(0.0);
}
