//! How long the panel takes for a frame of the window, folded and unfolded, and a change of a key.

use criterion::{Criterion, criterion_group, criterion_main};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use npr_stylesheet::Stated;
use npr_view::{FileKind, Film, Host, Layer, News, Order, Pose, Question, Sheet, Studio, Take};
use std::hint::black_box;
use toml::Value;

/// A host that draws nothing.
struct Idle;

impl Host for Idle {
    fn style(&mut self, name: &str) -> Result<Stated, String> {
        Stated::preset(name).map_err(|error| error.to_string())
    }

    fn kind(&self, _: &str) -> FileKind {
        FileKind::Scene
    }

    fn smokes(&self) -> Vec<String> {
        Vec::new()
    }

    fn layers(&self) -> Vec<Layer> {
        Vec::new()
    }

    fn open(&mut self, _: &str) {}

    fn draw(&mut self, _: Order) {}

    fn draw_aside(&mut self, _: Order) {}

    fn point_at(&mut self, _: Question) {}

    fn news(&mut self) -> Vec<News> {
        Vec::new()
    }

    fn command(&self, order: &Order) -> String {
        order.options().join(" ")
    }

    fn save(&mut self, _: Take, _: &Sheet, _: &Order) {}

    fn save_pose(&mut self, _: &Pose) -> Result<String, String> {
        Err(String::new())
    }

    fn film_command(&self, _: &Film, order: &Order) -> String {
        self.command(order)
    }

    fn film(&mut self, _: &Film, _: &Order) {}

    fn cancel(&mut self) {}
}

fn toon() -> Sheet {
    let stated = Stated::preset("toon").expect("a preset");
    Sheet::new("toon", stated, &[]).expect("a sheet")
}

fn show_panel(c: &mut Criterion) {
    let mut group = c.benchmark_group("panel");
    for (name, is_unfolded) in [("folded", false), ("unfolded", true)] {
        let studio = Studio::new(toon(), None, Box::new(Idle));
        let mut harness = Harness::builder()
            .with_size(egui::vec2(1280.0, 800.0))
            .build_ui_state(|ui, studio: &mut Studio| studio.show(ui), studio);
        if is_unfolded {
            harness.get_by_label("Unfold all").click();
            harness.run_steps(32);
        }
        group.bench_function(name, |b| b.iter(|| harness.run_steps(1)));
    }
    group.finish();
}

fn set_key(c: &mut Criterion) {
    let mut sheet = toon();
    let mut opacity = 0.0;
    c.bench_function("set", |b| {
        b.iter(|| {
            opacity = 1.0 - opacity;
            sheet.set(black_box("line.opacity"), &Value::Float(opacity))
        });
    });
}

criterion_group!(benches, show_panel, set_key);
criterion_main!(benches);
