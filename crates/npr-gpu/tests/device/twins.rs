//! Every pass on the device against its twin, at the sizes where something changes.

use crate::agreement::{Meaning, disagreement};
use crate::frame::{Content, Frame, counts_input, grids_for};
use crate::lists::{Chains, Jumping, Lists, is_over_lists};
use crate::pixels::is_over_pixels;
use crate::scene::{FRAME_PX, Look};
use crate::shared;
use npr_gpu::engine::Engine;
use npr_gpu::graph::{Graph, Kind, ResourceId};
use npr_gpu::pass::{Access, Agreement, Element, Format, Pass, Slot, Work};
use npr_gpu::passes::ALL;
use npr_gpu::passes::shade::COMPOSE_FRAME;
use npr_gpu::processor::Processor;

/// Nothing, one, and one workgroup less one, whole, and plus one.
const COUNTS: [u32; 5] = [0, 1, 63, 64, 65];

/// The size of the mask where the output has the size of the frame.
const MASK_SIZE: [u32; 2] = [80, 45];

/// A pass with everything it binds.
struct Case {
    graph: Graph,
    inputs: Vec<(ResourceId, Vec<u32>)>,
    outputs: Vec<(ResourceId, Meaning)>,
}

impl Case {
    /// A pass with `count` elements of work, or with all that the frame has.
    fn new(pass: &'static Pass, frame: &Frame, count: Option<u32>) -> Self {
        let mut case = Self {
            graph: Graph::new(),
            inputs: Vec::new(),
            outputs: Vec::new(),
        };
        let counted = pass.slots[pass.counted_slot()];
        let in_frame = frame.content(pass, counted.name).words.len() * 4 / counted.element.size;
        let count = count.map_or(in_frame, |count| count as usize);
        let bound: Vec<_> = pass
            .slots
            .iter()
            .map(|slot| case.bind(pass, frame, slot, counted.name, count))
            .collect();
        let size = if pass.targets().is_empty() {
            [0; 2]
        } else {
            frame.target_size(pass)
        };
        let targets: Vec<_> = pass
            .targets()
            .iter()
            .map(|format| {
                let id = case.graph.image("target", *format, size);
                case.outputs.push((id, Meaning::Texels(*format)));
                id
            })
            .collect();
        match targets.is_empty() {
            true => case.graph.compute(pass, &bound),
            false => case.graph.draw(pass, &bound, &targets, true),
        }
        case
    }

    fn bind(
        &mut self,
        pass: &Pass,
        frame: &Frame,
        slot: &Slot,
        counted: &str,
        count: usize,
    ) -> ResourceId {
        let stride = slot.element.size;
        let Content {
            mut words,
            size,
            layers,
        } = frame.content(pass, slot.name).clone();
        if slot.access.writes() {
            let room = match pass.work {
                // Listed pixels may lie anywhere in the picture.
                Work::PerListed { .. } => words.len() * 4 / stride,
                _ => count + usize::from(slot.access == Access::Append),
            };
            let kind = Kind::Buffer {
                stride,
                count: room,
            };
            let id = self.graph.add(slot.name, kind);
            if let Some(mut words) = frame.before(pass, slot) {
                words.truncate(room * stride / 4);
                self.inputs.push((id, words));
            }
            let meaning = match slot.access {
                Access::Append => Meaning::List,
                _ => Meaning::Elements(slot.element),
            };
            self.outputs.push((id, meaning));
            return id;
        }
        if slot.name == counted {
            words.truncate(count * stride / 4);
        }
        let id = self.graph.add(
            slot.name,
            match (slot.access, slot.access.image_format()) {
                (Access::Uniform, _) => Kind::Uniform { size: stride },
                (_, Some(format)) => Kind::Image {
                    format,
                    size,
                    layers,
                },
                _ => Kind::Buffer {
                    stride,
                    count: words.len() * 4 / stride,
                },
            },
        );
        // No host writes depth images: here they stay empty, and frames drawn whole fill them.
        if slot.access.image_format() != Some(Format::Depth) {
            self.inputs.push((id, words));
        }
        id
    }

    /// A pass over lists.
    fn of_lists(pass: &'static Pass, lists: &Lists) -> Self {
        let mut case = Self {
            graph: Graph::new(),
            inputs: Vec::new(),
            outputs: Vec::new(),
        };
        let mut bound = Vec::new();
        for slot in pass.slots {
            let stride = slot.element.size;
            let is_output = slot.access.writes();
            let kind = match slot.access {
                Access::Uniform => Kind::Uniform { size: stride },
                _ => Kind::Buffer {
                    stride,
                    count: match is_output {
                        true => lists.output_count(pass, slot.name),
                        false => lists.content(pass, slot.name).len() * 4 / stride,
                    },
                },
            };
            let id = case.graph.add(slot.name, kind);
            match is_output {
                true => case.outputs.push((id, Meaning::Elements(slot.element))),
                false => case
                    .inputs
                    .push((id, lists.content(pass, slot.name).to_vec())),
            }
            bound.push(id);
        }
        case.graph.compute(pass, &bound);
        case
    }

    fn run_on(&self, engine: &dyn Engine) -> Vec<Vec<u32>> {
        let mut session = engine.prepare(self.graph.clone()).unwrap();
        for (id, words) in &self.inputs {
            session.write(*id, words).unwrap();
        }
        session.run().unwrap();
        self.outputs
            .iter()
            .map(|(id, _)| session.read(*id).unwrap())
            .collect()
    }

    /// How the device disagrees with the twin, output by output.
    fn disagreements(&self, pass: &Pass, device: &dyn Engine) -> Vec<String> {
        let (twin, device) = (self.run_on(&Processor), self.run_on(device));
        let results = self.outputs.iter().zip(twin.iter().zip(&device));
        results
            .filter_map(|((_, meaning), (twin, device))| disagreement(pass, *meaning, twin, device))
            .collect()
    }
}

/// Runs every pass over a frame on both engines and lists where they differ.
fn check_all(cases: impl Fn(&'static Pass) -> Vec<(String, Case)>) {
    check(|pass| !is_over_lists(pass) && !is_over_pixels(pass), cases);
}

/// The same for those passes that are `chosen`.
fn check(chosen: fn(&Pass) -> bool, cases: impl Fn(&'static Pass) -> Vec<(String, Case)>) {
    let Some(device) = shared::device() else {
        return;
    };
    let mut found = Vec::new();
    for pass in ALL.iter().filter(|pass| chosen(pass)) {
        for (name, case) in cases(pass) {
            let differences = case.disagreements(pass, device);
            found.extend(
                differences
                    .iter()
                    .map(|difference| format!("{} {name}: {difference}", pass.name)),
            );
        }
    }
    assert!(found.is_empty(), "\n{}", found.join("\n"));
}

#[test]
fn passes_agree_on_a_whole_frame() {
    for look in [Look::Ours, Look::Published] {
        let frame = Frame::new(look, FRAME_PX, MASK_SIZE);
        check_all(|pass| vec![(format!("{look:?}"), Case::new(pass, &frame, None))]);
    }
}

/// The passes one after the other, each on what the device made before.
#[test]
fn whole_frames_agree() {
    let Some(device) = shared::device() else {
        return;
    };
    for look in [Look::Ours, Look::Published] {
        let twin = Frame::new(look, FRAME_PX, MASK_SIZE);
        let device = Frame::run_on(device, look, FRAME_PX, MASK_SIZE);
        // One pixel of the mask that ties decides over a line of up to eight of its pixels: about 60 texels of this
        // frame.
        let pass = Pass {
            agreement: Agreement::Texels(0.005),
            ..COMPOSE_FRAME
        };
        let meaning = Meaning::Elements(Element::of::<u32>());
        let [of_twin, of_device] = [&twin, &device].map(|frame| &frame.named("frame").words);
        let found = disagreement(&pass, meaning, of_twin, of_device);
        assert_eq!(
            found,
            None,
            "{look:?}; on the way:\n{}",
            on_the_way(&twin, &device)
        );
    }
}

/// How many words differ in what the passes made, and the first.
fn on_the_way(twin: &Frame, device: &Frame) -> String {
    let lines = Frame::MADE.iter().filter_map(|name| {
        let [a, b] = [twin, device].map(|frame| &frame.named(name).words);
        let apart = a.iter().zip(b).filter(|(a, b)| a != b).count();
        let (at, (a, b)) = a.iter().zip(b).enumerate().find(|(_, (a, b))| a != b)?;
        Some(format!(
            "{name}: {apart} of {} words, first {at}: {a:#x} became {b:#x}",
            twin.named(name).words.len()
        ))
    });
    lines.collect::<Vec<_>>().join("\n")
}

/// Agreement on empty pictures would prove nothing.
#[test]
fn every_pass_has_something_to_do() {
    let frame = Frame::new(Look::Ours, FRAME_PX, MASK_SIZE);
    for name in Frame::MADE {
        let words = &frame.named(name).words;
        let set = words.iter().filter(|word| **word != 0).count();
        assert!(
            set * 100 >= words.len(),
            "only {set} of {} words of '{name}' are set",
            words.len()
        );
    }
}

#[test]
fn passes_agree_around_a_workgroup() {
    let whole = Frame::new(Look::Ours, FRAME_PX, MASK_SIZE);
    check_all(|pass| {
        let cases = COUNTS.into_iter().map(|count| {
            let case = if counts_input(pass) {
                Case::new(pass, &whole, Some(count))
            } else {
                let [size, mask_size] = grids_for(pass, count);
                Case::new(pass, &Frame::new(Look::Ours, size, mask_size), Some(count))
            };
            (format!("of {count}"), case)
        });
        cases.collect()
    });
}

/// Lists of as many nodes, more than one workgroup can add up, and many.
#[test]
fn passes_over_lists_agree() {
    for count in COUNTS.into_iter().chain([4097, 20_000]) {
        for chains in [Chains::Mixed, Chains::Single] {
            for jumping in [Jumping::Nodes, Jumping::Splitters] {
                let lists = Lists::new(chains, jumping, count as usize);
                check(is_over_lists, |pass| {
                    let name = format!("of {count}, {chains:?}, {jumping:?}");
                    vec![(name, Case::of_lists(pass, &lists))]
                });
            }
        }
    }
}

#[test]
fn every_pass_over_lists_has_something_to_do() {
    let lists = Lists::new(Chains::Mixed, Jumping::Nodes, 1000);
    for pass in ALL.iter().filter(|pass| is_over_lists(pass)) {
        for words in Case::of_lists(pass, &lists).run_on(&Processor) {
            let set = words.iter().filter(|word| **word != 0).count();
            let is_quiet = pass.name == "vector.scatter_ranks" && set == 0;
            assert!(is_quiet || set * 100 >= words.len(), "{}", pass.name);
        }
    }
}
