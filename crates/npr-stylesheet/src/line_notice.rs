//! The notices about line colours that the line methods of a style cannot draw.

use npr_core::geometry::Part;
use npr_core::line_kind::KindSet;

use crate::{OutlineMethod, Style};

impl Style {
    /// The notices about settings of `line.paint` that have no effect, one sentence each.
    pub fn line_paint_notices(&self) -> Vec<String> {
        // Gather the methods that lines of any part are drawn by.
        let has = |bits: u32| self.line_paint_flags() & bits != 0;
        let rules = self.rule.iter().filter_map(|rule| rule.line.method);
        let methods: Vec<OutlineMethod> = std::iter::once(self.line.method).chain(rules).collect();
        let draws = |wanted: &[OutlineMethod]| methods.iter().any(|method| wanted.contains(method));
        let filters = [OutlineMethod::Filter, OutlineMethod::FilterHull];
        let hulls = [OutlineMethod::Hull, OutlineMethod::FilterHull];
        let even = [filters[0], filters[1], OutlineMethod::Angle];

        // List the settings of light and of kinds that these methods ignore.
        let mut notices = Vec::new();
        if has(Part::LINE_WIDTH) && draws(&even) {
            notices.push("line.paint.light.width changes no lines of method filter or angle");
        }
        if has(Part::LINE_OPACITY) && draws(&[hulls[0], hulls[1], OutlineMethod::Angle]) {
            notices.push("line.paint.light.opacity changes no lines of method hull or angle");
        }
        if has(Part::LINE_KINDS & !KindSet::CONTOUR)
            && draws(&[hulls[0], hulls[1], OutlineMethod::Angle])
        {
            notices.push("lines of method hull or angle are all contours to line.paint.kinds");
        }
        notices.extend(self.line_source_notice());
        notices.into_iter().map(str::to_owned).collect()
    }

    /// The notice about lines that take their colour from vertex colours while the style does not use those.
    pub fn line_source_notice(&self) -> Option<&'static str> {
        let asks = self.line_paint_flags() & Part::LINE_VERTEX != 0;
        (asks && !self.shade.use_vertex_colors)
            .then_some("line.paint.source is vertex-color, but shade.use_vertex_colors is off")
    }
}
