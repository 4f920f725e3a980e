//! Every sample bitmap is traced, to the pixel.

use crate::files::samples;
use std::process::{Command, Stdio};

#[test]
fn outlines_hold_as_many_pixels_as_there_is_ink() {
    for file in samples("bitmaps", &["png", "pbm"]) {
        let output = Command::new(env!("CARGO_BIN_EXE_npr"))
            .args(["trace", "--turdsize", "0", "--format", "json", "-o", "-"])
            .arg(&file)
            .stdin(Stdio::null())
            .output()
            .expect("it starts");
        let name = file.display();
        assert_eq!(String::from_utf8_lossy(&output.stderr), "", "{name}");
        assert_eq!(output.status.code(), Some(0), "{name}");
        let data: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
        let mut inside = 0;
        for path in data["paths"].as_array().expect("a list") {
            let area = path["area"].as_i64().expect("a number");
            inside += if path["ink"] == true { area } else { -area };
            for segment in path["segments"].as_array().expect("a list") {
                assert!(
                    [4, 6].contains(&segment.as_array().map_or(0, Vec::len)),
                    "{name}"
                );
            }
        }
        let grey = image::open(&file).expect("a sound image").into_luma8();
        let ink = grey.pixels().filter(|pixel| pixel.0[0] <= 127).count();
        assert_eq!(inside, ink as i64, "{name}");
    }
}
