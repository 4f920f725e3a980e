//! Checks of a style that involve more than one value: order, contradictions, values that need another one.

use crate::error::{Problem, StyleError};
use crate::id_map::color_of;
use crate::motion::TRAILS_MAX;
use crate::nearest::nearest;
use crate::overlay::Over;
use crate::ramp::{Stop, check_order};
use crate::{OutlineMethod, Rule, Style, Width, WidthSource};

impl Style {
    /// Checks everything that involves more than one value: order, contradictions, values that need another one.
    ///
    /// Reading does this already; call it after changing fields by hand.
    ///
    /// # Errors
    ///
    /// [`StyleError::Value`] for the first key that contradicts another.
    pub fn sanity_check(&self) -> Result<(), StyleError> {
        // Check the style's own values.
        self.light.sanity_check()?;
        self.blend.sanity_check()?;
        self.check_trails()?;
        self.check_ids()?;
        check_direction(self.ink.direction, "ink.direction")?;
        check_width(&self.line.width)?;
        self.check_line_paint()?;
        check_ramp(&self.shade.ramp, "shade.ramp")?;
        self.smoke.sanity_check()?;
        let mut words = self.lettering.iter().enumerate();
        words.try_for_each(|(i, words)| words.check(i))?;

        // Check the values of each rule.
        self.rule.iter().enumerate().try_for_each(|(i, rule)| {
            check_method(rule.line.method, i)?;
            check_direction(rule.ink.direction, &format!("rule.{i}.ink.direction"))?;
            let pressure = rule.line.width.pressure.iter().flatten();
            let key = format!("rule.{i}.line.width.pressure");
            check_order(&key, pressure.map(|stop| stop.at))?;
            let ramp = rule.shade.ramp.as_deref();
            ramp.map_or(Ok(()), |stops| {
                check_ramp(stops, &format!("rule.{i}.shade.ramp"))
            })
        })
    }

    /// Checks the colours of lines, with each rule laid over the style's own.
    fn check_line_paint(&self) -> Result<(), StyleError> {
        self.line.paint.check("line.paint")?;
        self.rule.iter().enumerate().try_for_each(|(i, rule)| {
            let paint = rule.line.paint.over(self.line.paint.clone());
            paint.check(&format!("rule.{i}.line.paint"))
        })
    }

    /// Refuses more different trails than frames can tell apart, [`TRAILS_MAX`].
    fn check_trails(&self) -> Result<(), StyleError> {
        if self.trails().len() <= TRAILS_MAX {
            return Ok(());
        }
        let moves = |rule: &Rule| rule.motion.trail.is_some();
        let last = self.rule.iter().rposition(moves).unwrap_or_default();
        let reason = format!("is one of more than {TRAILS_MAX} different trails");
        Err(StyleError::unfit(
            format!("rule.{last}.motion.trail"),
            reason,
        ))
    }

    /// Checks the id maps, and that rules name only ids that exist.
    fn check_ids(&self) -> Result<(), StyleError> {
        // Check every map by itself.
        let mut maps = self.id_map.iter().enumerate();
        maps.try_for_each(|(i, map)| map.check(&format!("id_map.{i}")))?;
        let names = || {
            let ids = self.id_map.iter().flat_map(|map| &map.ids);
            ids.map(|id| id.name.as_str())
        };

        // Check that every id which a rule names is on a map; patterns may match nothing.
        for (i, rule) in self.rule.iter().enumerate() {
            let pattern = rule.matching.id.as_str();
            let unfit =
                |reason: String| Err(StyleError::unfit(format!("rule.{i}.match.id"), reason));
            if pattern.contains(['*', '?']) || pattern.is_empty() {
                continue;
            }
            if self.id_map.is_empty() {
                return unfit("names an id, but the style has no id_map".to_owned());
            }
            if pattern.starts_with('#') {
                match color_of(pattern) {
                    Some(color) if color.a == 255 => continue,
                    _ => return unfit("is no colour such as #ff8000".to_owned()),
                }
            }
            if !names().any(|name| name == pattern) {
                let hint = nearest(pattern, names());
                let hint =
                    hint.map_or_else(String::new, |name| format!("; did you mean '{name}'?"));
                return unfit(format!("is no id of an id_map{hint}"));
            }
        }
        Ok(())
    }
}

fn check_ramp(stops: &[Stop], key: &str) -> Result<(), StyleError> {
    check_order(key, stops.iter().map(|stop| stop.at))
}

/// Refuses a direction of strokes with length 0.
fn check_direction(direction: Option<[f32; 3]>, key: &str) -> Result<(), StyleError> {
    match direction {
        Some([0.0, 0.0, 0.0]) => Err(StyleError::unfit(key, "points nowhere")),
        _ => Ok(()),
    }
}

/// Refuses a line method in a rule that works on whole pictures only.
fn check_method(method: Option<OutlineMethod>, rule: usize) -> Result<(), StyleError> {
    match method {
        None
        | Some(
            OutlineMethod::Off
            | OutlineMethod::Shape
            | OutlineMethod::Hull
            | OutlineMethod::Angle
            | OutlineMethod::Strokes
            | OutlineMethod::Potrace,
        ) => Ok(()),
        Some(_) => Err(StyleError::unfit(
            format!("rule.{rule}.line.method"),
            "works on whole pictures; a part may have strokes, shape, hull, angle, potrace or none",
        )),
    }
}

fn check_width(width: &Width) -> Result<(), StyleError> {
    // Refuse a least width above the greatest.
    if width.min > width.max {
        let (value, max) = (f64::from(width.min), f64::from(width.max));
        return Err(StyleError::value(
            "line.width.min",
            Problem::OutOfRange {
                value,
                min: 0.0,
                max,
            },
        ));
    }

    // Refuse curves that run back.
    let curves = [
        (&width.pressure, "line.width.pressure"),
        (&width.depth.curve, "line.width.depth.curve"),
    ];
    for (stops, key) in curves {
        check_order(key, stops.iter().map(|stop| stop.at))?;
    }
    if width.depth.far <= width.depth.near {
        let reason = "has to lie beyond line.width.depth.near";
        return Err(StyleError::unfit("line.width.depth.far", reason));
    }

    // Refuse a source of widths that the style does not give.
    match width.source {
        WidthSource::Texture if width.texture.is_none() => Err(StyleError::unfit(
            "line.width.source",
            "is texture, but line.width.texture names no image",
        )),
        WidthSource::ControlPoints if width.control_points.is_empty() => Err(StyleError::unfit(
            "line.width.source",
            "is control-points, but line.width.control_points is empty",
        )),
        _ => Ok(()),
    }
}
