//! A font made on the spot, for tests: a few letters of bars, a ring and a disc.

/// Units per em of [`block_font`].
pub const UNITS_PER_EM: u16 = 1000;

/// Height of capitals of [`block_font`], in its units.
pub const CAP_HEIGHT: i16 = 700;

/// Space on both sides of a letter of [`block_font`], in its units.
pub const SIDE: i16 = 50;

/// What kerning takes between V and O in [`block_font`], in its units.
pub const KERN: i16 = 120;

/// A corner in font units, and whether it lies on the outline rather than pulling it.
type Corner = (i16, i16, bool);

/// A letter: its character, its width, and its contours.
struct Glyph {
    character: char,
    width: u16,
    contours: Vec<Vec<Corner>>,
}

fn bar(x: [i16; 2], y: [i16; 2]) -> Vec<Corner> {
    let [(x0, x1), (y0, y1)] = [(x[0], x[1]), (y[0], y[1])];
    [(x0, y0), (x0, y1), (x1, y1), (x1, y0)]
        .map(|(x, y)| (x, y, true))
        .to_vec()
}

/// The letters, in the order of their characters, after the one for characters that are missing.
fn glyphs() -> Vec<Glyph> {
    let cap = CAP_HEIGHT;
    let glyph = |character, width: i16, contours| Glyph {
        character,
        width: (width + 2 * SIDE) as u16,
        contours,
    };
    let bars = |bars: &[[[i16; 2]; 2]]| bars.iter().map(|[x, y]| bar(*x, *y)).collect();
    let mut hole = bar([250, 450], [200, 500]);
    hole.reverse();
    let disc = [(50, 0), (50, cap), (650, cap), (650, 0)].map(|(x, y)| (x, y, false));
    let wedge = [
        (0, cap),
        (160, cap),
        (300, 200),
        (440, cap),
        (600, cap),
        (370, 0),
        (230, 0),
    ];
    let wedge = wedge.map(|(x, y)| (x + SIDE, y, true));
    vec![
        glyph('\0', 400, bars(&[[[50, 450], [0, cap]]])),
        glyph(' ', 250, Vec::new()),
        glyph(
            'H',
            500,
            bars(&[
                [[50, 200], [0, cap]],
                [[150, 450], [280, 420]],
                [[400, 550], [0, cap]],
            ]),
        ),
        glyph('I', 200, bars(&[[[50, 250], [0, cap]]])),
        glyph('O', 600, vec![bar([50, 650], [0, cap]), hole]),
        glyph('Q', 600, vec![disc.to_vec()]),
        glyph('V', 600, vec![wedge.to_vec()]),
    ]
}

/// A TrueType font with the letters H, I, O, Q (a disc), V and the blank; V and O are kerned.
pub fn block_font() -> Vec<u8> {
    let glyphs = glyphs();
    let (glyf, loca) = outlines(&glyphs);
    let tables = [
        (b"OS/2", os2()),
        (b"cmap", cmap(&glyphs)),
        (b"glyf", glyf),
        (b"head", head()),
        (b"hhea", hhea(glyphs.len() as u16)),
        (
            b"hmtx",
            shorts(glyphs.iter().flat_map(|g| [g.width as i16, SIDE])),
        ),
        (b"kern", kern(&glyphs)),
        (b"loca", loca),
        (b"maxp", maxp(glyphs.len() as u16)),
    ];
    let count = tables.len() as u16;
    let mut file = vec![0, 1, 0, 0];
    file.extend(shorts([count as i16, 128, 3, 16 * count as i16 - 128]));
    let mut offset = 12 + 16 * tables.len();
    for (tag, table) in &tables {
        file.extend_from_slice(*tag);
        file.extend([0; 4]);
        file.extend((offset as u32).to_be_bytes());
        file.extend((table.len() as u32).to_be_bytes());
        offset += table.len().next_multiple_of(4);
    }
    for (_, mut table) in tables {
        table.resize(table.len().next_multiple_of(4), 0);
        file.extend(table);
    }
    file
}

fn shorts(values: impl IntoIterator<Item = i16>) -> Vec<u8> {
    values.into_iter().flat_map(i16::to_be_bytes).collect()
}

/// Tables `glyf` and `loca`.
fn outlines(glyphs: &[Glyph]) -> (Vec<u8>, Vec<u8>) {
    let (mut glyf, mut loca) = (Vec::new(), vec![0; 4]);
    for glyph in glyphs {
        if !glyph.contours.is_empty() {
            glyf.extend(simple_glyph(&glyph.contours));
            glyf.resize(glyf.len().next_multiple_of(4), 0);
        }
        loca.extend((glyf.len() as u32).to_be_bytes());
    }
    (glyf, loca)
}

fn simple_glyph(contours: &[Vec<Corner>]) -> Vec<u8> {
    let corners: Vec<Corner> = contours.iter().flatten().copied().collect();
    let bound = |at: fn(&Corner) -> i16| {
        let values = corners.iter().map(at);
        (values.clone().min().unwrap_or(0), values.max().unwrap_or(0))
    };
    let ((x0, x1), (y0, y1)) = (bound(|c| c.0), bound(|c| c.1));
    let mut bytes = shorts([contours.len() as i16, x0, y0, x1, y1]);
    let mut end = -1;
    for contour in contours {
        end += contour.len() as i16;
        bytes.extend(shorts([end]));
    }
    bytes.extend([0, 0]);
    bytes.extend(corners.iter().map(|corner| u8::from(corner.2)));
    for at in [|c: &Corner| c.0, |c: &Corner| c.1] {
        let mut before = 0;
        for corner in &corners {
            bytes.extend(shorts([at(corner) - before]));
            before = at(corner);
        }
    }
    bytes
}

fn cmap(glyphs: &[Glyph]) -> Vec<u8> {
    // One subtable for all of Unicode: format 12, one group per character.
    let mut bytes = shorts([0, 1, 3, 10, 0, 12, 12, 0]);
    let groups = glyphs.len() as u32 - 1;
    for value in [16 + 12 * groups, 0, groups] {
        bytes.extend(value.to_be_bytes());
    }
    for (id, glyph) in glyphs.iter().enumerate().skip(1) {
        let code = u32::from(glyph.character);
        for value in [code, code, id as u32] {
            bytes.extend(value.to_be_bytes());
        }
    }
    bytes
}

fn kern(glyphs: &[Glyph]) -> Vec<u8> {
    let id = |character| {
        glyphs
            .iter()
            .position(|g| g.character == character)
            .unwrap_or(0) as i16
    };
    shorts([0, 1, 0, 20, 1, 1, 6, 0, 0, id('V'), id('O'), -KERN])
}

fn head() -> Vec<u8> {
    let mut bytes = vec![
        0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0x5f, 0x0f, 0x3c, 0xf5, 0, 0,
    ];
    bytes.extend(UNITS_PER_EM.to_be_bytes());
    bytes.extend([0; 16]);
    bytes.extend(shorts([0, 0, 700, CAP_HEIGHT, 0, 8, 2, 1, 0]));
    bytes
}

fn hhea(count: u16) -> Vec<u8> {
    let mut bytes = shorts([1, 0, 800, -200, 0, 750, 0, 0, 750, 1, 0, 0, 0, 0, 0, 0, 0]);
    bytes.extend(count.to_be_bytes());
    bytes
}

fn maxp(count: u16) -> Vec<u8> {
    let mut bytes = vec![0, 1, 0, 0];
    bytes.extend(count.to_be_bytes());
    bytes.extend(shorts([20, 4, 0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0]));
    bytes
}

/// Table `OS/2`, version 2, of which only the height of capitals is told.
fn os2() -> Vec<u8> {
    let mut bytes = vec![0; 96];
    bytes[1] = 2;
    bytes[88..90].copy_from_slice(&CAP_HEIGHT.to_be_bytes());
    bytes
}
