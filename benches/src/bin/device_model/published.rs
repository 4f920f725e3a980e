//! Frames whose times were published, measured on the adapter that is there: passes alone, without what a processor
//! does.

use npr_benches::cost::{Cost as Fit, Sample};
use npr_benches::subject::{Subject, bunny_path};
use npr_benches::table::Table;
use npr_gpu::engine::Engine;
use npr_stylesheet::Style;

use super::{Outcome, Row, measure_subject, pixel_count, slowest, sum};

/// Triangles and frame sizes of Okuya's first table, and the frames a second that it gives.
const TRIANGLES: [usize; 3] = [960, 9_566, 66_400];
const SIZES: [[u32; 2]; 3] = [[640, 360], [1280, 720], [1920, 1080]];
const PUBLISHED_FPS: [[f64; 3]; 3] = [
    [1699.3, 649.7, 331.7],
    [1394.6, 610.4, 317.0],
    [445.1, 318.4, 209.8],
];

/// Frame pixels along a mask pixel in his second table, and its frames a second.
const MASK_SCALES: [(f32, f64); 4] = [(1.0, 209.8), (1.5, 282.4), (3.0, 346.0), (6.0, 377.6)];

/// Looks whose prices are compared with that of the first; Suzuki's were 8 % above plain shading at 1024x768.
const LOOKS: [&str; 8] = [
    "toon",
    "plain",
    "comic-silver",
    "comic-modern",
    "screentone",
    "pencil",
    "crosshatch",
    "stipple",
];
const LOOK_SIZE: [u32; 2] = [1024, 768];

/// Measures the frames of published tables and prints them.
pub fn report(engine: &dyn Engine) -> Outcome<()> {
    println!("\n## Published tables\n");
    println!(
        "Times of passes alone, in ms: the processor's part and reading the picture back are left out.\n"
    );
    triangles_and_pixels(engine)?;
    mask_scales(engine)?;
    looks(engine)
}

/// The published method, without supersampling.
fn okuya() -> Outcome<Style> {
    let mut style = Style::preset("okuya")?;
    style.antialias.samples = 1;
    Ok(style)
}

fn millis(rows: &[Row]) -> f64 {
    sum(rows).1
}

fn triangles_and_pixels(engine: &dyn Engine) -> Outcome<()> {
    println!("### Triangles and pixels [Okuya 2016, table 1]\n");
    println!("Preset `okuya`, 1 sample; in brackets what was published, of a GTX 580.\n");
    let style = okuya()?;
    let head = SIZES.map(|[width, height]| format!("{width}x{height}"));
    let mut table = Table::new(std::iter::once("triangles".to_owned()).chain(head));
    let mut samples = Vec::new();
    for (count, published) in TRIANGLES.into_iter().zip(PUBLISHED_FPS) {
        let subject = Subject::ball(count)?;
        let mut cells = Vec::new();
        for (size, fps) in SIZES.into_iter().zip(published) {
            let ms = millis(&measure_subject(engine, &subject, &style, size)?);
            cells.push(format!("{ms:.2} ({:.2})", 1e3 / fps));
            samples.push(Sample {
                triangles: subject.triangle_count() as f64,
                pixels: pixel_count(size),
                ms,
            });
        }
        table.add(count.to_string(), cells);
    }
    println!("{table}");
    if let (Some(sum), Some(both)) = (Fit::fit_sum(&samples), Fit::fit(&samples)) {
        println!("Least squares, T in 100 000 triangles, P in millions of pixels:\n");
        println!("    t = {sum}    R^2 {:.4}", sum.r_squared);
        println!("    t = {both}    R^2 {:.4}\n", both.r_squared);
    }
    Ok(())
}

fn mask_scales(engine: &dyn Engine) -> Outcome<()> {
    println!("### Size of the mask [Okuya 2016, table 2]\n");
    println!("66400 triangles at 1920x1080.\n");
    let subject = Subject::ball(TRIANGLES[2])?;
    let mut table = Table::new(["mask", "ms", "published", "slowest pass"]);
    for (scale, fps) in MASK_SCALES {
        let mut style = okuya()?;
        style.detect.scale = scale;
        let rows = measure_subject(engine, &subject, &style, SIZES[2])?;
        let cells = [
            format!("{:.2}", millis(&rows)),
            format!("{:.2}", 1e3 / fps),
            slowest(&rows),
        ];
        table.add(format!("{:.0} rows", 1080.0 / scale), cells);
    }
    println!("{table}");
    Ok(())
}

fn looks(engine: &dyn Engine) -> Outcome<()> {
    let Some(path) = bunny_path() else {
        return Ok(());
    };
    let subject = Subject::from_file(&path)?;
    println!("### What ink and hatching cost [Suzuki 2004]\n");
    println!(
        "The bunny at {}x{}; published: 380 frames a second plain, 350 in comic style.\n",
        LOOK_SIZE[0], LOOK_SIZE[1]
    );
    let mut table = Table::new(["preset", "ms", "by toon", "slowest pass"]);
    let mut first = None;
    for name in LOOKS {
        let rows = measure_subject(engine, &subject, &Style::preset(name)?, LOOK_SIZE)?;
        let ms = millis(&rows);
        let cells = [
            format!("{ms:.2}"),
            format!("{:.2}", ms / *first.get_or_insert(ms)),
            slowest(&rows),
        ];
        table.add(name, cells);
    }
    println!("{table}");
    Ok(())
}
