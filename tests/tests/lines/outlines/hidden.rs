//! Edges behind other objects.

use super::fixture::{SIZE, corner_camera, cube_front_silhouette, cube_other_silhouette};
use npr_tests::{Ink, Object, Wanted, boxed, draw_from, lines, scene_of};

#[test]
fn a_hidden_edge_does_not_draw_on_the_nearer_mask_line() {
    let cube = Object::new("Cube", boxed([-1.0; 3], [1.0; 3]));
    // Its long front edges cross behind the cube's creases.
    let bar = Object::new("Bar", boxed([-6.0, -0.3, -4.0], [6.0, 0.3, -2.5]));
    for method in ["shape", "okuya"] {
        let mut style = lines(method);
        style.set("line.width.base=6px").unwrap();
        let draw =
            |objects: &[Object]| draw_from(&scene_of(objects), &style, &corner_camera(), SIZE);
        let (alone, both) = (
            draw(std::slice::from_ref(&cube)),
            draw(&[cube.clone(), bar.clone()]),
        );
        let view = &alone.view;
        let silhouette = cube_front_silhouette(view).and(cube_other_silhouette(view));
        let crease = Wanted::seen(view, &[[[1.0; 3], [1.0, -1.0, 1.0]]]);
        let changed = Ink::of(&both.frame).without(&Ink::of(&alone.frame));
        assert!(changed.count() > 1000, "the bar shows beside the cube");
        let slips = changed
            .centers()
            .filter(|center| crease.distance(*center) < 12.0 && silhouette.distance(*center) > 8.0);
        assert_eq!(slips.count(), 0, "{method}");
    }
}
