//! Two runs of a session in flight.

use crate::contours::engines;
use crate::sample_passes::{ADD_TEXELS, DOUBLE};
use crate::shared;
use npr_gpu::device::{Device, Traffic, wgpu};
use npr_gpu::engine::{Engine, EngineError, IN_FLIGHT, Session};
use npr_gpu::graph::{Graph, ResourceId};
use npr_gpu::pass::Format;
use proptest::prelude::*;
use std::collections::VecDeque;
use std::time::{Duration, Instant};

/// A buffer, an image and a uniform that are written, and two buffers that passes compute of them.
struct Sums {
    graph: Graph,
    written: [ResourceId; 3],
    computed: [ResourceId; 2],
}

impl Sums {
    fn new() -> Self {
        let mut graph = Graph::new();
        let step = graph.uniform::<[u32; 4]>("step");
        let numbers = graph.image("numbers", Format::U32, [3, 2]);
        let bytes = graph.image("bytes", Format::Rgba8, [3, 2]);
        let sums = graph.buffer::<u32>("sums", 6);
        let single = graph.buffer::<u32>("single", 5);
        let doubled = graph.buffer::<u32>("doubled", 5);
        graph.compute(&ADD_TEXELS, &[step, numbers, bytes, sums]);
        graph.compute(&DOUBLE, &[single, doubled]);
        Self {
            graph,
            written: [step, numbers, single],
            computed: [sums, doubled],
        }
    }

    fn write(&self, session: &mut dyn Session, value: u32) {
        let [step, numbers, single] = self.written;
        session.write(step, &[value, 0, 0, 0]).unwrap();
        session.write(numbers, &[value; 6]).unwrap();
        session.write(single, &[value; 5]).unwrap();
    }

    /// Some of the resources, and their words after a run with a value.
    fn read_after(&self, value: u32, choice: usize) -> Vec<(ResourceId, Vec<u32>)> {
        let [sums, doubled] = self.computed;
        let all = [
            (sums, vec![2 * value; 6]),
            (doubled, (0..5).map(|i| 2 * value + i).collect()),
            (self.written[1], vec![value; 6]),
            (self.written[2], vec![value; 5]),
        ];
        let chosen = all
            .into_iter()
            .enumerate()
            .filter(|(i, _)| choice >> i & 1 == 1);
        chosen.map(|(_, read)| read).collect()
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, ..ProptestConfig::default() })]

    /// Whatever is written and started meanwhile, a run gives what it gives alone.
    #[test]
    fn runs_in_flight_do_not_see_each_other(
        steps in prop::collection::vec((any::<bool>(), 0u32..100, 0usize..16), 1..20),
    ) {
        let sums = Sums::new();
        for engine in engines() {
            let mut session = engine.prepare(sums.graph.clone()).unwrap();
            let mut wanted = VecDeque::new();
            for &(wants_more, value, choice) in &steps {
                let fits = wanted.len() < IN_FLIGHT;
                if fits && (wants_more || wanted.is_empty()) {
                    sums.write(session.as_mut(), value);
                    let expected = sums.read_after(value, choice);
                    let ids: Vec<ResourceId> = expected.iter().map(|(id, _)| *id).collect();
                    session.submit(&ids).unwrap();
                    wanted.push_back(expected);
                } else {
                    let (times, mut read) = session.collect().unwrap();
                    prop_assert!(!times.is_empty());
                    for (id, words) in wanted.pop_front().unwrap() {
                        prop_assert_eq!(read.take(id), words);
                    }
                }
                prop_assert_eq!(session.in_flight(), wanted.len());
                // What is written now, no run sees that has started.
                sums.write(session.as_mut(), 1000 + value);
            }
        }
    }
}

#[test]
fn a_run_is_submitted_and_waited_for_once() {
    // A device of its own: others would count along.
    let Some(device) = shared::open() else { return };
    let sums = Sums::new();
    let mut session = device.prepare(sums.graph.clone()).unwrap();
    let traffic = |submits, waits| Traffic { submits, waits };
    session.submit(&sums.computed).unwrap();
    assert_eq!(device.traffic(), traffic(1, 0));
    for done in 0..5 {
        sums.write(session.as_mut(), done as u32);
        session.submit(&sums.computed).unwrap();
        assert_eq!(device.traffic(), traffic(done + 2, done));
        session.collect().unwrap();
        assert_eq!(device.traffic(), traffic(done + 2, done + 1));
    }
    session.collect().unwrap();
    assert_eq!(device.traffic(), traffic(6, 6));
}

#[test]
fn passes_that_are_timed_one_by_one_are_done_when_they_are_submitted() {
    let Some(device) = shared::open() else { return };
    if !device.adapter().is_software() {
        return;
    }
    assert!(!device.tells_passes_apart());
    let device = device.timing_passes();
    assert!(device.tells_passes_apart());
    let sums = Sums::new();
    let mut session = device.prepare(sums.graph.clone()).unwrap();
    for (value, runs) in [(1, 1), (7, 2)] {
        sums.write(session.as_mut(), value);
        session.submit(&sums.computed).unwrap();
        // Two passes and the reading, each waited for.
        let Traffic { submits, waits } = device.traffic();
        assert_eq!([submits, waits], [3 * runs; 2]);
    }
    for value in [1, 7] {
        let (times, mut read) = session.collect().unwrap();
        assert!(
            times
                .iter()
                .map(|time| time.name)
                .eq(["test.add_texels", "test.double"])
        );
        for (id, words) in sums.read_after(value, 3) {
            assert_eq!(read.take(id), words);
        }
    }
}

#[test]
fn a_device_that_is_lost_with_two_runs_in_flight_gives_neither() {
    if let Some(device) = shared::open() {
        check_loss(&device, || device.destroy());
    }
    // One that a host gives up.
    if let Some((adapter, device, queue)) = shared::open_host(&wgpu::Limits::default()) {
        let guest = Device::from_wgpu(&adapter, device.clone(), queue).unwrap();
        check_loss(&guest, || device.destroy());
    }
}

fn check_loss(device: &Device, lose: impl FnOnce()) {
    let sums = Sums::new();
    let mut session = device.prepare(sums.graph.clone()).unwrap();
    for value in [1, 2] {
        sums.write(session.as_mut(), value);
        session.submit(&sums.computed).unwrap();
    }
    lose();
    for left in [1, 0] {
        let lost = session.collect();
        assert!(matches!(lost, Err(EngineError::Lost { .. })), "{lost:?}");
        assert_eq!(session.in_flight(), left);
    }
    let refused = session.submit(&[]);
    assert!(matches!(refused, Err(EngineError::Lost { .. })));
    assert_eq!(session.in_flight(), 0);
}

/// Without a clock, no time counts twice.
#[test]
fn wall_times_of_runs_in_flight_add_up_to_no_more_than_passed() {
    let Some((adapter, device, queue)) = shared::open_host(&wgpu::Limits::default()) else {
        return;
    };
    let device = Device::from_wgpu(&adapter, device, queue).unwrap();
    assert!(!device.has_clock());
    let sums = Sums::new();
    let mut session = device.prepare(sums.graph.clone()).unwrap();
    let start = Instant::now();
    let mut sum = Duration::ZERO;
    session.submit(&sums.computed).unwrap();
    for _ in 0..4 {
        session.submit(&sums.computed).unwrap();
        std::thread::sleep(Duration::from_millis(20));
        let (times, _) = session.collect().unwrap();
        assert!(times.iter().map(|time| time.name).eq(["device"]));
        sum += times[0].time;
    }
    assert!(sum > Duration::ZERO && sum <= start.elapsed(), "{sum:?}");
}

/// The message of the panic of some work.
fn message_of(work: impl FnOnce()) -> String {
    let panicked = std::panic::catch_unwind(std::panic::AssertUnwindSafe(work)).unwrap_err();
    match panicked.downcast::<String>() {
        Ok(message) => *message,
        Err(other) => (*other.downcast::<&str>().unwrap()).to_owned(),
    }
}

#[test]
fn no_third_run_starts_and_none_is_collected_that_did_not() {
    let sums = Sums::new();
    for engine in engines() {
        let mut session = engine.prepare(sums.graph.clone()).unwrap();
        let none = message_of(|| drop(session.collect()));
        assert!(none.contains("no run is in flight"), "{none}");
        session.submit(&[]).unwrap();
        for read in [
            message_of(|| drop(session.read(sums.computed[0]))),
            message_of(|| drop(session.run())),
        ] {
            assert!(read.contains("in flight (1)"), "{read}");
        }
        session.submit(&[]).unwrap();
        let third = message_of(|| drop(session.submit(&[])));
        assert!(third.contains("2 runs are in flight"), "{third}");

        // Nothing is broken by what was refused.
        session.collect().unwrap();
        session.collect().unwrap();
        session.run().unwrap();
    }
}
