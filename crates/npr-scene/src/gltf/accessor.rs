//! Accessors: typed lists within buffers, read with every bound checked first.
#![deny(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing,
    clippy::arithmetic_side_effects
)]

use std::array;

use ::gltf::json::Root;
use ::gltf::json::accessor::sparse::Sparse;
use ::gltf::json::accessor::{Accessor, ComponentType, Type};
use ::gltf::json::validation::Checked;

use super::buffers::{Buffers, range};
use super::error::{GltfError, Item};
use crate::error::SceneError;
use crate::limits::Allowance;

/// Elements that an accessor without a buffer view may have, however little data the file has.
const FREE_ELEMENTS: u64 = 1024;

/// Reads the accessors of a file.
#[derive(Clone, Copy)]
pub(crate) struct Accessors<'a> {
    pub(crate) root: &'a Root,
    pub(crate) buffers: &'a Buffers<'a>,
}

/// A list of elements within a buffer view; element `count - 1` ends within `bytes`.
struct Rows<'a> {
    bytes: &'a [u8],
    stride: usize,
    count: usize,
    component: ComponentType,
    normalized: bool,
}

/// Place and shape of a list, before it is checked against its view.
struct Layout {
    accessor: usize,
    offset: u64,
    count: u64,
    component: ComponentType,
    element_bytes: usize,
    normalized: bool,
}

impl<'a> Accessors<'a> {
    /// How many elements accessor `index` has.
    pub(crate) fn count(&self, index: usize, user: Item) -> Result<usize, GltfError> {
        let accessor = self.get(index, user)?;
        Ok(usize::try_from(accessor.count.0).unwrap_or(usize::MAX))
    }

    /// How many components an element of accessor `index` has; 0 where its type is unknown.
    pub(crate) fn width(&self, index: usize, user: Item) -> Result<usize, GltfError> {
        Ok(type_width(self.get(index, user)?))
    }

    /// Elements of `N` numbers; normalised integers become -1..1 or 0..1, others keep their value.
    pub(crate) fn floats<const N: usize>(
        &self,
        index: usize,
        user: Item,
        allowance: &mut Allowance,
    ) -> Result<Vec<[f32; N]>, SceneError> {
        self.read(index, user, "numbers", allowance, float_rows)
    }

    /// Elements of `N` unsigned integers.
    pub(crate) fn integers<const N: usize>(
        &self,
        index: usize,
        user: Item,
        allowance: &mut Allowance,
    ) -> Result<Vec<[u32; N]>, SceneError> {
        self.read(index, user, "unsigned integers", allowance, integer_rows)
    }

    /// Checks that accessor `index` could be read, without reading it.
    pub(crate) fn check(&self, index: usize) -> Result<(), GltfError> {
        // Check the list itself against the view that it lies in.
        let item = Item::new("accessor", index);
        let accessor = self.get(index, item)?;
        let width = type_width(accessor);
        let component = component_type(accessor).filter(|_| width > 0);
        let component = component.ok_or(GltfError::UnknownElements { accessor: index })?;
        let layout = Layout::of_accessor(index, accessor, component, width);
        if let Some(view) = accessor.buffer_view {
            self.rows(view.value(), &layout)?;
        }
        self.check_count(index, accessor)?;

        // Check the values that replace single elements of it.
        let Some(sparse) = &accessor.sparse else {
            return Ok(());
        };
        self.check_sparse_count(index, sparse, self.count(index, item)?)?;
        self.sparse_rows(index, sparse)?;
        self.rows(
            sparse.values.buffer_view.value(),
            &layout.of_sparse_values(sparse),
        )?;
        Ok(())
    }

    fn get(&self, index: usize, user: Item) -> Result<&'a Accessor, GltfError> {
        let item = Item::new("accessor", index);
        let count = self.root.accessors.len();
        self.root
            .accessors
            .get(index)
            .ok_or(GltfError::Missing { user, item, count })
    }

    fn read<const N: usize, T: Copy + Default>(
        &self,
        index: usize,
        user: Item,
        wanted: &'static str,
        allowance: &mut Allowance,
        decode: impl Fn(&Rows) -> Option<Vec<[T; N]>>,
    ) -> Result<Vec<[T; N]>, SceneError> {
        let accessor = self.get(index, user)?;
        let mismatch = || GltfError::ElementType {
            user,
            accessor: index,
            wanted,
        };
        let component = component_type(accessor).filter(|_| type_width(accessor) == N);
        let layout = Layout::of_accessor(index, accessor, component.ok_or_else(mismatch)?, N);

        // Check every bound before memory is planned: what lies past the end is a fault, not a limit.
        let rows = accessor
            .buffer_view
            .map(|view| self.rows(view.value(), &layout))
            .transpose()?;
        self.check_count(index, accessor)?;
        let count = self.count(index, user)?;
        allowance.take::<[T; N]>("vertex data", count)?;

        let mut elements = match rows {
            Some(rows) => decode(&rows).ok_or_else(mismatch)?,
            None => vec![[T::default(); N]; count],
        };
        if let Some(sparse) = &accessor.sparse {
            let places = self.sparse_places(index, sparse, count)?;
            let values = layout.of_sparse_values(sparse);
            let rows = self.rows(sparse.values.buffer_view.value(), &values)?;
            let values = decode(&rows).ok_or_else(mismatch)?;
            replace(index, &mut elements, &places, &values)?;
        }
        Ok(elements)
    }

    /// Elements without a view cost memory that no byte of the file pays for, so they are bounded.
    fn check_count(&self, index: usize, accessor: &Accessor) -> Result<(), GltfError> {
        let (count, data_bytes) = (accessor.count.0, self.buffers.byte_count());
        if accessor.buffer_view.is_none() && count > data_bytes.max(FREE_ELEMENTS) {
            return Err(GltfError::TooManyElements {
                accessor: index,
                count,
                data_bytes,
            });
        }
        Ok(())
    }

    /// Which elements `sparse` replaces in a list of `count`.
    fn sparse_places(
        &self,
        index: usize,
        sparse: &Sparse,
        count: usize,
    ) -> Result<Vec<[u32; 1]>, GltfError> {
        self.check_sparse_count(index, sparse, count)?;
        integer_rows(&self.sparse_rows(index, sparse)?).ok_or(no_sparse_indices(index))
    }

    /// Refuses more replaced elements than there are.
    fn check_sparse_count(
        &self,
        index: usize,
        sparse: &Sparse,
        count: usize,
    ) -> Result<(), GltfError> {
        if sparse.count.0 <= count as u64 {
            return Ok(());
        }
        let element = u32::try_from(sparse.count.0).unwrap_or(u32::MAX);
        Err(GltfError::SparseElement {
            accessor: index,
            element,
            count,
        })
    }

    /// The bytes that say which elements `sparse` replaces.
    fn sparse_rows(&self, index: usize, sparse: &Sparse) -> Result<Rows<'a>, GltfError> {
        let Checked::Valid(component) = sparse.indices.component_type else {
            return Err(no_sparse_indices(index));
        };
        let layout = Layout {
            accessor: index,
            offset: sparse.indices.byte_offset.0,
            count: sparse.count.0,
            component: component.0,
            element_bytes: component.0.size(),
            normalized: false,
        };
        self.rows(sparse.indices.buffer_view.value(), &layout)
    }

    /// The bytes of a list in `view`, checked against its end.
    fn rows(&self, view: usize, layout: &Layout) -> Result<Rows<'a>, GltfError> {
        // Find the view and how far apart elements lie in it.
        let accessor = layout.accessor;
        let bytes = self
            .buffers
            .view(self.root, view, Item::new("accessor", accessor))?;
        let stride = self.stride(view, layout)?;

        // Refuse a list that goes on beyond its view.
        let end = layout.end(stride);
        let view_bytes = bytes.len() as u64;
        let past_end = GltfError::AccessorPastEnd {
            accessor,
            end,
            view,
            view_bytes,
        };
        Ok(Rows {
            bytes: range(bytes, layout.offset, end).ok_or(past_end)?,
            stride,
            count: layout.count as usize,
            component: layout.component,
            normalized: layout.normalized,
        })
    }

    /// Bytes from one element of the list to the next.
    fn stride(&self, view: usize, layout: &Layout) -> Result<usize, GltfError> {
        let &Layout {
            accessor,
            element_bytes,
            ..
        } = layout;
        let view = self.root.buffer_views.get(view);
        let stated = view.and_then(|view| view.byte_stride);
        let stride = stated.map_or(element_bytes, |stride| stride.0);
        if stride < element_bytes {
            return Err(GltfError::Stride {
                accessor,
                element_bytes,
                stride,
            });
        }
        Ok(stride)
    }
}

impl Layout {
    fn of_accessor(
        index: usize,
        accessor: &Accessor,
        component: ComponentType,
        width: usize,
    ) -> Self {
        Self {
            accessor: index,
            offset: accessor.byte_offset.unwrap_or_default().0,
            count: accessor.count.0,
            component,
            element_bytes: component.size().saturating_mul(width),
            normalized: accessor.normalized,
        }
    }

    /// The layout of the values that `sparse` puts in place of others.
    fn of_sparse_values(&self, sparse: &Sparse) -> Self {
        Self {
            offset: sparse.values.byte_offset.0,
            count: sparse.count.0,
            ..*self
        }
    }

    /// Where the last element ends, counted from the start of the view.
    fn end(&self, stride: usize) -> u64 {
        let Some(last) = self.count.checked_sub(1) else {
            return self.offset;
        };
        let start = last
            .saturating_mul(stride as u64)
            .saturating_add(self.offset);
        start.saturating_add(self.element_bytes as u64)
    }
}

impl Rows<'_> {
    /// Every element as `N` components of `B` bytes each.
    fn decode<const N: usize, const B: usize, T: Copy + Default>(
        &self,
        decode: impl Fn([u8; B]) -> T,
    ) -> Vec<[T; N]> {
        let element = |row: &[u8]| {
            let (cells, _) = row.as_chunks::<B>();
            array::from_fn(|i| cells.get(i).map_or_else(T::default, |&cell| decode(cell)))
        };
        self.bytes
            .chunks(self.stride)
            .take(self.count)
            .map(element)
            .collect()
    }
}

fn no_sparse_indices(accessor: usize) -> GltfError {
    GltfError::ElementType {
        user: Item::new("accessor", accessor),
        accessor,
        wanted: "sparse indices",
    }
}

fn float_rows<const N: usize>(rows: &Rows) -> Option<Vec<[f32; N]>> {
    // Map normalised integers to -1..1 or 0..1; keep all others.
    let unit = rows.normalized;
    let signed = |value: f32, most: f32| {
        if unit {
            (value / most).max(-1.0)
        } else {
            value
        }
    };
    let unsigned = |value: f32, most: f32| if unit { value / most } else { value };
    match rows.component {
        ComponentType::F32 => Some(rows.decode(f32::from_le_bytes)),
        ComponentType::I8 => Some(rows.decode(|b| signed(f32::from(i8::from_le_bytes(b)), 127.0))),
        ComponentType::U8 => {
            Some(rows.decode(|b| unsigned(f32::from(u8::from_le_bytes(b)), 255.0)))
        }
        ComponentType::I16 => {
            Some(rows.decode(|b| signed(f32::from(i16::from_le_bytes(b)), 32_767.0)))
        }
        ComponentType::U16 => {
            Some(rows.decode(|b| unsigned(f32::from(u16::from_le_bytes(b)), 65_535.0)))
        }
        ComponentType::U32 => None,
    }
}

fn integer_rows<const N: usize>(rows: &Rows) -> Option<Vec<[u32; N]>> {
    match rows.component {
        ComponentType::U8 => Some(rows.decode(|b| u32::from(u8::from_le_bytes(b)))),
        ComponentType::U16 => Some(rows.decode(|b| u32::from(u16::from_le_bytes(b)))),
        ComponentType::U32 => Some(rows.decode(u32::from_le_bytes)),
        ComponentType::I8 | ComponentType::I16 | ComponentType::F32 => None,
    }
}

/// Puts `values` at `places`, which accessor `accessor` names.
fn replace<T: Copy>(
    accessor: usize,
    elements: &mut [T],
    places: &[[u32; 1]],
    values: &[T],
) -> Result<(), GltfError> {
    let count = elements.len();
    for (&[element], &value) in places.iter().zip(values) {
        let slot = elements.get_mut(element as usize);
        *slot.ok_or(GltfError::SparseElement {
            accessor,
            element,
            count,
        })? = value;
    }
    Ok(())
}

fn component_type(accessor: &Accessor) -> Option<ComponentType> {
    match accessor.component_type {
        Checked::Valid(component) => Some(component.0),
        Checked::Invalid => None,
    }
}

/// How many components an element has; 0 where its type is unknown.
pub(crate) fn type_width(accessor: &Accessor) -> usize {
    match accessor.type_ {
        Checked::Valid(Type::Scalar) => 1,
        Checked::Valid(Type::Vec2) => 2,
        Checked::Valid(Type::Vec3) => 3,
        Checked::Valid(Type::Vec4 | Type::Mat2) => 4,
        Checked::Valid(Type::Mat3) => 9,
        Checked::Valid(Type::Mat4) => 16,
        Checked::Invalid => 0,
    }
}
