// One distant light as strong as 1 that throws no shadow.

struct Reach {
    towards: vec3<f32>,
    strength: f32,
}

fn only_distant() -> bool {
    return true;
}

fn reach_at(source: LightSource, world: vec3<f32>) -> Reach {
    return Reach(source.direction, 1.0);
}

fn lit_by_all(world: vec3<f32>, normal: vec3<f32>, dark: u32, open: Openness) -> Lit {
    return Lit(0.0, vec3<f32>(1.0));
}

struct SkyLight {
    share: f32,
    color: vec3<f32>,
}

fn sky_light(source: LightSource, normal: vec3<f32>, open: Openness) -> SkyLight {
    return SkyLight(0.0, vec3<f32>(0.0));
}
