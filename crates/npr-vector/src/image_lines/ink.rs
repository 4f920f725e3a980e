//! The ink of lines in a picture, and the surface that each of its pixels belongs to.

use npr_core::geometry::NONE;

/// Pixels beside lines, each with the pixel whose surface the line lies on.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct LineInk {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// For every pixel with ink, the pixel whose surface the line lies on; [`NONE`] for others.
    pub owners: Vec<u32>,
    /// The kind of the line that a pixel owns, a bit of [`npr_core::line_kind::KindSet::BITS`]; 0 for others.
    pub kinds: Vec<u32>,
    /// Whether it is the ink of light painted lines, whose strokes have other identities than those of dark ones.
    pub is_light: bool,
}

impl LineInk {
    /// No ink.
    pub fn new(size: [u32; 2]) -> Self {
        let count = size[0] as usize * size[1] as usize;
        Self {
            size,
            owners: vec![NONE; count],
            kinds: vec![0; count],
            is_light: false,
        }
    }

    /// Inks a pixel that owns a line, and its neighbours beyond the line: left, right, above, below, a bit of `sides`
    /// each.
    ///
    /// A pixel that owns a line itself stays its own.
    pub fn add(&mut self, pixel: u32, kind: u32, sides: u32) {
        let width = self.size[0];
        let [x, y] = [pixel % width, pixel / width];
        self.kinds[pixel as usize] = kind;
        self.owners[pixel as usize] = pixel;
        let beyond = [
            (x > 0).then(|| pixel - 1),
            (x + 1 < width).then(|| pixel + 1),
            (y > 0).then(|| pixel - width),
            (y + 1 < self.size[1]).then(|| pixel + width),
        ];
        for (side, other) in beyond.into_iter().enumerate() {
            let owner = other.filter(|_| sides >> side & 1 != 0);
            if let Some(owner) = owner.and_then(|other| self.owners.get_mut(other as usize))
                && *owner == NONE
            {
                *owner = pixel;
            }
        }
    }

    /// Keeps the ink of lines whose owning pixel `is_kept` accepts.
    pub fn retain(&mut self, is_kept: impl Fn(usize) -> bool) {
        for owner in &mut self.owners {
            if *owner != NONE && !is_kept(*owner as usize) {
                *owner = NONE;
            }
        }
    }

    /// Whether a pixel has ink.
    pub fn is_ink(&self, x: u32, y: u32) -> bool {
        let at = y as usize * self.size[0] as usize + x as usize;
        self.owners.get(at).is_some_and(|owner| *owner != NONE)
    }

    /// The owner of the inked pixel nearest to a place, up to two pixels away.
    pub(super) fn owner_near(&self, place: [f64; 2]) -> Option<u32> {
        let [x, y] = place.map(|v| v.floor() as i64);
        let [width, height] = self.size.map(i64::from);
        let around = (-2..=2).flat_map(|dy| (-2..=2).map(move |dx| [x + dx, y + dy]));
        around
            .filter(|[x, y]| (0..width).contains(x) && (0..height).contains(y))
            .filter(|[x, y]| self.is_ink(*x as u32, *y as u32))
            .map(|[x, y]| {
                let [dx, dy] = [x as f64 + 0.5 - place[0], y as f64 + 0.5 - place[1]];
                (dx * dx + dy * dy, y * width + x)
            })
            .min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)))
            .map(|(_, pixel)| self.owners[pixel as usize])
    }
}
