//! Orders of a studio as arguments of `npr render`.

use crate::arguments::{CameraArguments, Point, RenderArguments, Size, ViewArguments};
use npr_view::Order;
use std::path::Path;

/// The arguments of `npr render` that draw the same.
pub fn render_arguments(args: &ViewArguments, scene: &Path) -> RenderArguments {
    RenderArguments {
        scene: Some(scene.to_owned()),
        output: None,
        enlarge: 1,
        debug_layer: None,
        drawing: args.drawing.clone(),
        cache: args.cache.clone(),
    }
}

/// The arguments of `npr render` that draw an order.
pub fn order_arguments(args: &ViewArguments, scene: &Path, order: &Order) -> RenderArguments {
    let mut args = render_arguments(args, scene);
    let drawing = &mut args.drawing;
    drawing.look.style = Some(order.style.clone());
    drawing.look.overrides.clone_from(&order.overrides);
    drawing.look.background = None;
    drawing.look.dump_style = false;
    let [width, height] = order.size;
    drawing.size = Size { width, height };
    drawing.quiet = true;
    drawing.timings = None;
    if let Some(point) = &order.viewpoint {
        drawing.camera = CameraArguments {
            eye: Some(Point(point.eye)),
            target: Some(Point(point.target)),
            up: Some(Point(point.up)),
            fov: Some(point.fov_deg),
            ortho: point.is_parallel,
            ..CameraArguments::default()
        };
    }
    args
}
