//! Which graphics devices there are, and opening one.

use crate::engine::EngineError;
use std::fmt;

/// The interfaces that are looked for. OpenGL is left out: its loader writes to standard error on servers.
const BACKENDS: wgpu::Backends = wgpu::Backends::VULKAN
    .union(wgpu::Backends::METAL)
    .union(wgpu::Backends::DX12);

/// Which adapters may be opened.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AdapterChoice {
    /// Graphics hardware only: software devices are slower than the processor engine.
    Hardware,
    /// Any, hardware first.
    Any,
}

/// What an adapter is made of, best first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum AdapterKind {
    /// A graphics card with its own memory.
    Discrete,
    /// Graphics that share the processor's memory.
    Integrated,
    /// A share of a card in another machine.
    Virtual,
    /// The driver does not say.
    Unknown,
    /// A driver that computes on the processor.
    Software,
}

/// An adapter in words and numbers, for people who report a problem.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct AdapterSummary {
    /// Name of the device.
    pub name: String,
    /// What it is made of.
    pub kind: AdapterKind,
    /// Name and version of the driver, as far as it tells them.
    pub driver: String,
    /// The interface through which it is reached: `vulkan`, `metal` or `dx12`.
    pub backend: &'static str,
    /// Largest width and height of an image, in texels.
    pub max_image_side: u32,
    /// Largest buffer that a pass can bind, in bytes.
    pub max_binding_bytes: u64,
    /// Whether it can time passes.
    pub has_clock: bool,
}

impl AdapterSummary {
    /// Whether it computes on the processor.
    pub fn is_software(&self) -> bool {
        self.kind == AdapterKind::Software
    }

    pub(super) fn of(adapter: &wgpu::Adapter) -> Self {
        let (info, limits) = (adapter.get_info(), adapter.limits());
        Self {
            kind: kind_of(info.device_type),
            driver: format!("{} {}", info.driver, info.driver_info)
                .trim()
                .to_owned(),
            backend: info.backend.to_str(),
            max_image_side: limits.max_texture_dimension_2d,
            max_binding_bytes: limits.max_storage_buffer_binding_size,
            has_clock: adapter.features().contains(wgpu::Features::TIMESTAMP_QUERY),
            name: info.name,
        }
    }
}

impl fmt::Display for AdapterSummary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} ({}, {})", self.name, self.backend, self.driver)
    }
}

/// Every adapter of this machine, best first; empty where no driver is installed.
pub fn adapters() -> Vec<AdapterSummary> {
    ranked().into_iter().map(|(summary, _)| summary).collect()
}

/// Opens the best adapter that can be opened, with the limits of WebGPU, and a clock where there is one.
pub(super) fn open(
    choice: AdapterChoice,
) -> Result<(AdapterSummary, wgpu::Device, wgpu::Queue), EngineError> {
    let (adapter, device, queue) = open_raw(choice, &descriptor)?;
    Ok((AdapterSummary::of(&adapter), device, queue))
}

/// Opens the best adapter that can be opened and that passes can run on, as `descriptor` asks.
pub(super) fn open_raw(
    choice: AdapterChoice,
    descriptor: &dyn Fn(&wgpu::Adapter) -> wgpu::DeviceDescriptor<'static>,
) -> Result<(wgpu::Adapter, wgpu::Device, wgpu::Queue), EngineError> {
    // Try adapters from the best on, and remember why each was refused.
    let mut refusals = Vec::new();
    for (summary, adapter) in ranked() {
        if choice == AdapterChoice::Hardware && summary.is_software() {
            refusals.push(format!("{} is software", summary.name));
            continue;
        }
        if let Some(lacking) = lacking(&adapter, &adapter.limits()) {
            refusals.push(format!("{} lacks {lacking}", summary.name));
            continue;
        }
        match pollster::block_on(adapter.request_device(&descriptor(&adapter))) {
            Ok((device, queue)) => return Ok((adapter, device, queue)),
            Err(error) => refusals.push(format!("{}: {error}", summary.name)),
        }
    }

    // Say why none is left.
    let reason = if refusals.is_empty() {
        "no driver offers one".to_owned()
    } else {
        refusals.join("; ")
    };
    Err(EngineError::NoDevice { reason })
}

/// What passes use of an adapter that WebGPU does not let it lack, by the names that people know.
const CAPABILITIES: [(wgpu::DownlevelFlags, &str); 5] = [
    (wgpu::DownlevelFlags::COMPUTE_SHADERS, "compute shaders"),
    (
        wgpu::DownlevelFlags::INDIRECT_EXECUTION,
        "work sizes from buffers",
    ),
    (
        wgpu::DownlevelFlags::VERTEX_STORAGE,
        "storage buffers for vertices",
    ),
    (
        wgpu::DownlevelFlags::FRAGMENT_STORAGE,
        "storage buffers for fragments",
    ),
    (
        wgpu::DownlevelFlags::BUFFER_BINDINGS_NOT_16_BYTE_ALIGNED,
        "buffers of any size",
    ),
];

/// The first thing that passes need and that is not there: a capability of the adapter, or one of the least limits of
/// WebGPU, of which a device with `limits` has less.
pub(super) fn lacking(adapter: &wgpu::Adapter, limits: &wgpu::Limits) -> Option<String> {
    let flags = adapter.get_downlevel_capabilities().flags;
    lacking_of(flags, limits)
}

fn lacking_of(flags: wgpu::DownlevelFlags, limits: &wgpu::Limits) -> Option<String> {
    let absent = CAPABILITIES.iter().find(|(flag, _)| !flags.contains(*flag));
    if let Some((_, name)) = absent {
        return Some((*name).to_owned());
    }
    let mut short = None;
    wgpu::Limits::default().check_limits_with_fail_fn(limits, true, |name, least, has| {
        short = Some(format!("{name} of {least}, it has {has}"));
    });
    short
}

/// All adapters, best first, in the driver's order among equals.
fn ranked() -> Vec<(AdapterSummary, wgpu::Adapter)> {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor {
        backends: BACKENDS,
        ..wgpu::InstanceDescriptor::new_without_display_handle()
    });
    let found = pollster::block_on(instance.enumerate_adapters(BACKENDS));
    let mut adapters: Vec<_> = found
        .into_iter()
        .map(|adapter| (AdapterSummary::of(&adapter), adapter))
        .collect();
    adapters.sort_by_key(|(summary, _)| summary.kind);
    adapters
}

/// What is asked of a device: the limits of WebGPU, and a clock where there is one.
fn descriptor(adapter: &wgpu::Adapter) -> wgpu::DeviceDescriptor<'static> {
    wgpu::DeviceDescriptor {
        label: Some("npr"),
        required_features: adapter.features() & wgpu::Features::TIMESTAMP_QUERY,
        required_limits: wgpu::Limits::default(),
        ..wgpu::DeviceDescriptor::default()
    }
}

fn kind_of(device_type: wgpu::DeviceType) -> AdapterKind {
    match device_type {
        wgpu::DeviceType::DiscreteGpu => AdapterKind::Discrete,
        wgpu::DeviceType::IntegratedGpu => AdapterKind::Integrated,
        wgpu::DeviceType::VirtualGpu => AdapterKind::Virtual,
        wgpu::DeviceType::Cpu => AdapterKind::Software,
        wgpu::DeviceType::Other => AdapterKind::Unknown,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_an_adapter_lacks_is_named() {
        let (all, least) = (wgpu::DownlevelFlags::all(), wgpu::Limits::default());
        assert_eq!(lacking_of(all, &least), None);
        for (flag, name) in CAPABILITIES {
            assert_eq!(lacking_of(all - flag, &least).as_deref(), Some(name));
        }
        let few = wgpu::Limits {
            max_storage_buffers_per_shader_stage: 7,
            ..least
        };
        let short = "max_storage_buffers_per_shader_stage of 8, it has 7";
        assert_eq!(lacking_of(all, &few).as_deref(), Some(short));
    }
}
