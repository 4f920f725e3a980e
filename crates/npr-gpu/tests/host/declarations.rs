//! Every shader against its declaration, by reflection: nothing here needs a device.

use naga::proc::{Layouter, TypeLayout};
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use naga::{AddressSpace, GlobalVariable, Module, StorageAccess, TypeInner};
use npr_core::layout::Field;
use npr_gpu::pass::{Access, Element, Features, Format, Pass, Slot, WORKGROUP_SIZE, Work};
use npr_gpu::passes::ALL;
use std::collections::{BTreeMap, BTreeSet};

/// A linked shader with the layout of its types.
struct Reflection {
    module: Module,
    info: ModuleInfo,
    layouts: Layouter,
}

impl Reflection {
    fn of(pass: &Pass, features: Features) -> Self {
        let text = npr_shaders::link(&pass.shader, features);
        let module = naga::front::wgsl::parse_str(&text)
            .unwrap_or_else(|error| panic!("{}: {}", pass.name, error.emit_to_string(&text)));
        let info = Validator::new(ValidationFlags::all(), Capabilities::empty())
            .validate(&module)
            .unwrap_or_else(|error| panic!("{}: {}", pass.name, error.emit_to_string(&text)));
        let mut layouts = Layouter::default();
        layouts.update(module.to_ctx()).unwrap();
        Self {
            module,
            info,
            layouts,
        }
    }

    /// The names of the resources that any entry point uses.
    fn used(&self) -> BTreeSet<&str> {
        let globals = self.module.global_variables.iter();
        let entries = 0..self.module.entry_points.len();
        let used = globals.filter(|(handle, global)| {
            let is_used = |entry| !self.info.get_entry_point(entry)[*handle].is_empty();
            global.binding.is_some() && entries.clone().any(is_used)
        });
        used.filter_map(|(_, global)| global.name.as_deref())
            .collect()
    }

    /// The resources of group 0 by binding number.
    fn bindings(&self, pass: &Pass) -> Vec<&GlobalVariable> {
        let globals = self
            .module
            .global_variables
            .iter()
            .map(|(_, global)| global);
        let mut bound: Vec<_> = globals.filter(|global| global.binding.is_some()).collect();
        bound.sort_by_key(|global| global.binding.as_ref().unwrap().binding);
        for (number, global) in bound.iter().enumerate() {
            let binding = global.binding.as_ref().unwrap();
            assert_eq!(
                (binding.group, binding.binding),
                (0, number as u32),
                "{}: {:?}",
                pass.name,
                global.name
            );
        }
        bound
    }

    /// The element type of a buffer: of an array its base.
    fn element(&self, global: &GlobalVariable) -> naga::Handle<naga::Type> {
        match self.module.types[global.ty].inner {
            TypeInner::Array { base, .. } => base,
            _ => global.ty,
        }
    }

    /// Bytes from one element of an array to the next.
    fn stride(&self, element: naga::Handle<naga::Type>) -> u32 {
        let TypeLayout { size, alignment } = self.layouts[element];
        alignment.round_up(size)
    }

    /// The name of a struct, or how WGSL writes a scalar, vector or matrix.
    fn type_name(&self, ty: naga::Handle<naga::Type>) -> String {
        let scalar = |scalar: naga::Scalar| match scalar.kind {
            naga::ScalarKind::Uint => "u32",
            naga::ScalarKind::Sint => "i32",
            naga::ScalarKind::Float => "f32",
            _ => "another scalar",
        };
        let ty = &self.module.types[ty];
        match ty.inner {
            TypeInner::Scalar(of) | TypeInner::Atomic(of) => scalar(of).to_owned(),
            TypeInner::Vector { size, scalar: of } => format!("vec{}<{}>", size as u8, scalar(of)),
            TypeInner::Matrix {
                columns,
                rows,
                scalar: of,
            } => {
                format!("mat{}x{}<{}>", columns as u8, rows as u8, scalar(of))
            }
            _ => ty.name.clone().unwrap_or_default(),
        }
    }

    /// Names and offsets of the fields of a struct.
    fn fields(&self, ty: naga::Handle<naga::Type>) -> Vec<(&str, usize)> {
        match &self.module.types[ty].inner {
            TypeInner::Struct { members, .. } => members
                .iter()
                .map(|m| (m.name.as_deref().unwrap_or_default(), m.offset as usize))
                .collect(),
            _ => Vec::new(),
        }
    }
}

fn check_access(pass: &Pass, slot: &Slot, global: &GlobalVariable, inner: &TypeInner) {
    let fits = match slot.access {
        Access::Uniform => global.space == AddressSpace::Uniform,
        Access::Read => {
            global.space
                == AddressSpace::Storage {
                    access: StorageAccess::LOAD,
                }
        }
        Access::Write | Access::Update | Access::Scatter | Access::Append => {
            global.space
                == AddressSpace::Storage {
                    access: StorageAccess::LOAD | StorageAccess::STORE,
                }
        }
        // No shader declares them.
        Access::Indices => false,
        Access::Texture(format) | Access::Layered(format) => {
            let is_layered = matches!(slot.access, Access::Layered(_));
            matches!(inner, TypeInner::Image { dim: naga::ImageDimension::D2, arrayed, class }
            if *class == image_class(format) && *arrayed == is_layered)
        }
    };
    assert!(
        fits,
        "{}: '{}' is bound as {:?}, declared as {:?}",
        pass.name, slot.name, global.space, slot.access
    );
}

fn image_class(format: Format) -> naga::ImageClass {
    match format {
        Format::U32 => naga::ImageClass::Sampled {
            kind: naga::ScalarKind::Uint,
            multi: false,
        },
        Format::Rgba8 => naga::ImageClass::Sampled {
            kind: naga::ScalarKind::Float,
            multi: false,
        },
        Format::Depth => naga::ImageClass::Depth { multi: false },
    }
}

fn check_element(pass: &Pass, reflection: &Reflection, slot: &Slot, global: &GlobalVariable) {
    let (ty, Element { name, size, fields }) = (reflection.element(global), slot.element);
    let of = format!("{}: '{}'", pass.name, slot.name);
    assert_eq!(reflection.type_name(ty), name, "{of}: type");
    assert_eq!(reflection.stride(ty) as usize, size, "{of}: size of {name}");
    let declared: Vec<_> = fields
        .iter()
        .map(|Field { name, offset }| (*name, *offset))
        .collect();
    assert_eq!(reflection.fields(ty), declared, "{of}: fields of {name}");
}

#[test]
fn bindings_are_as_declared() {
    for pass in ALL {
        let reflection = Reflection::of(pass, Features::ALL);
        let bound = reflection.bindings(pass);
        let names: Vec<_> = bound
            .iter()
            .map(|global| global.name.as_deref().unwrap_or_default())
            .collect();
        let is_bound = |slot: &&Slot| slot.is_bound_for(Features::ALL);
        let slots = || pass.slots.iter().filter(is_bound);
        let declared: Vec<_> = slots().map(|slot| slot.name).collect();
        assert_eq!(names, declared, "{}", pass.name);
        for (slot, global) in slots().zip(bound) {
            check_access(
                pass,
                slot,
                global,
                &reflection.module.types[global.ty].inner,
            );
            if slot.access.image_format().is_none() {
                check_element(pass, &reflection, slot, global);
            }
        }
    }
}

/// None, all, each alone, all but each, and pairs.
fn feature_sets() -> BTreeSet<Features> {
    let each = || Features::NAMED.iter().map(|(_, feature)| *feature);
    let mut sets = BTreeSet::from([Features::NONE, Features::ALL]);
    sets.extend(each());
    sets.extend(each().map(|feature| Features::ALL.without(feature)));
    sets.extend(each().flat_map(|one| each().map(move |other| one.or(other))));
    sets
}

/// A shader that is linked for some features is valid, and uses only what a device binds for them.
#[test]
fn slots_are_left_out_only_where_nothing_uses_them() {
    for pass in ALL {
        let deciding = feature_sets()
            .into_iter()
            .map(|set| (pass.deciding(set), set));
        for features in deciding.collect::<BTreeMap<_, _>>().into_values() {
            let reflection = Reflection::of(pass, features);
            let slots = pass.slots.iter();
            let bound = slots.filter(|slot| slot.is_bound_for(features));
            let bound: BTreeSet<&str> = bound.map(|slot| slot.name).collect();
            let used = reflection.used();
            assert!(
                used.is_subset(&bound),
                "{} for {features:?}: uses {used:?}, not {bound:?}",
                pass.name
            );
        }
    }
}

/// Every slot that serves features is used where one of them is there: none is bound for nothing.
#[test]
fn slots_that_serve_a_feature_are_used_by_it() {
    for pass in ALL {
        for slot in pass
            .slots
            .iter()
            .filter(|slot| slot.serves != Features::NONE)
        {
            let reflection = Reflection::of(pass, Features::ALL);
            assert!(
                reflection.used().contains(slot.name),
                "{}: {}",
                pass.name,
                slot.name
            );
        }
    }
}

#[test]
fn entry_points_are_as_declared() {
    for pass in ALL {
        let module = Reflection::of(pass, Features::ALL).module;
        let entries: Vec<_> = module
            .entry_points
            .iter()
            .map(|entry| (entry.name.as_str(), entry.stage))
            .collect();
        match pass.work {
            Work::PerElement { .. } | Work::PerRun { .. } | Work::PerListed { .. } => {
                assert_eq!(
                    entries,
                    [("main", naga::ShaderStage::Compute)],
                    "{}",
                    pass.name
                );
                check_workgroup(pass, &module);
            }
            Work::Draw { .. } => {
                let both = [
                    ("vertex", naga::ShaderStage::Vertex),
                    ("fragment", naga::ShaderStage::Fragment),
                ];
                assert_eq!(entries, both, "{}", pass.name);
            }
        }
    }
}

/// The workgroup is as wide as the host dispatches for, and nothing is left to be set when a pass is compiled.
fn check_workgroup(pass: &Pass, module: &Module) {
    let size = module.entry_points[0].workgroup_size;
    assert_eq!(size, [WORKGROUP_SIZE, 1, 1], "{}", pass.name);
    assert!(module.overrides.is_empty(), "{}", pass.name);
}

/// Most images and storage buffers that a pass binds: WebGPU grants 16 and 8, and what embeds frames or extends them
/// needs some room.
const BOUND_MAX: [usize; 2] = [12, 7];

#[test]
fn no_pass_binds_more_than_its_share() {
    let bound = ALL.iter().map(|pass| {
        let bound = |slot: &&Slot| slot.is_bound_for(Features::ALL);
        let slots = || pass.slots.iter().filter(bound);
        let images = slots().filter(|slot| slot.access.image_format().is_some());
        let is_buffer = |slot: &&Slot| slot.access == Access::Read || slot.access.writes();
        (
            pass.name,
            [images.count(), slots().filter(is_buffer).count()],
        )
    });
    let over: Vec<String> = bound
        .filter(|(_, counts)| {
            counts
                .iter()
                .zip(BOUND_MAX)
                .any(|(count, most)| *count > most)
        })
        .map(|(name, [images, buffers])| format!("{name}: {images} images, {buffers} buffers"))
        .collect();
    let [images, buffers] = BOUND_MAX;
    assert!(
        over.is_empty(),
        "no pass may bind more than {images} images or {buffers} storage buffers:\n{}",
        over.join("\n")
    );
}

#[test]
fn no_pass_needs_more_than_every_device_has() {
    const { assert!(WORKGROUP_SIZE <= 256) };
    for pass in ALL {
        let Reflection {
            module, layouts, ..
        } = Reflection::of(pass, Features::ALL);
        let globals = module.global_variables.iter().map(|(_, global)| global);
        let shared = globals.filter(|global| global.space == AddressSpace::WorkGroup);
        let bytes: u32 = shared.map(|global| layouts[global.ty].size).sum();
        assert!(
            bytes <= 16 << 10,
            "{} takes {bytes} bytes of workgroup memory",
            pass.name
        );
    }
}

#[test]
fn indices_are_what_their_draw_counts() {
    let mut count = 0;
    for pass in ALL {
        for slot in pass
            .slots
            .iter()
            .filter(|slot| slot.access == Access::Indices)
        {
            count += 1;
            let counted = pass.slots[pass.counted_slot()].name;
            assert!(!slot.is_bound_for(Features::ALL) && slot.is_read_for(Features::ALL));
            assert_eq!((counted, pass.vertices()), (slot.name, 1), "{}", pass.name);
            assert_eq!(
                pass.slots.last().map(|slot| slot.name),
                Some(slot.name),
                "{}",
                pass.name
            );
        }
    }
    assert!(count > 0);
}

#[test]
fn a_pass_writes_only_what_it_can() {
    for pass in ALL {
        let writes = pass.slots.iter().any(|slot| slot.access.writes());
        assert_eq!(
            writes,
            !matches!(pass.work, Work::Draw { .. }),
            "{}",
            pass.name
        );
        let depth = pass
            .targets()
            .iter()
            .position(|format| *format == Format::Depth);
        assert!(
            depth.is_none_or(|at| at + 1 == pass.targets().len()),
            "{}: depth is not last",
            pass.name
        );
        assert!(pass.counted_slot() < pass.slots.len());
    }
}

#[test]
fn names_open_the_shaders_and_are_their_paths() {
    for pass in ALL {
        assert_eq!(pass.name, pass.shader.path.replace('/', "."));
        assert!(
            pass.shader.text.starts_with(&format!("// {}: ", pass.name)),
            "{}",
            pass.name
        );
    }
}

#[test]
fn every_shader_is_a_pass_and_every_pass_a_shader() {
    let shaders: BTreeSet<_> = npr_shaders::ALL.iter().map(|shader| shader.path).collect();
    let passes: BTreeSet<_> = ALL.iter().map(|pass| pass.shader.path).collect();
    assert_eq!(shaders, passes);
    assert_eq!(passes.len(), ALL.len(), "two passes share a shader");
}
