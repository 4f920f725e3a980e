//! Buffers: the bytes behind everything else.
#![deny(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing,
    clippy::arithmetic_side_effects
)]

use std::borrow::Cow;
use std::collections::BTreeMap;

use ::gltf::json::Root;
use ::gltf::json::buffer::Buffer;

use super::error::{GltfError, Item};
use crate::error::SceneError;
use crate::loading::Loading;
use crate::uri;

/// The data of all buffers of a file.
#[derive(Debug, Default)]
pub(crate) struct Buffers<'a> {
    /// Data by source; buffers that name the same URI share one.
    data: Vec<Cow<'a, [u8]>>,
    /// Of each buffer: its data, and how many bytes of it belong to the buffer.
    slots: Vec<(usize, usize)>,
}

impl<'a> Buffers<'a> {
    /// Reads every buffer of `root`; `bin` is the binary chunk.
    pub(crate) fn read(
        root: &'a Root,
        bin: Option<&'a [u8]>,
        loading: &mut Loading,
    ) -> Result<Self, SceneError> {
        let mut buffers = Self::default();
        let mut known = BTreeMap::new();
        for (index, buffer) in root.buffers.iter().enumerate() {
            let slot = match known.get(&buffer.uri) {
                Some(&slot) => slot,
                None => buffers.add(index, buffer, bin, loading)?,
            };
            known.insert(&buffer.uri, slot);
            buffers.push_slot(index, buffer, slot)?;
        }
        Ok(buffers)
    }

    fn add(
        &mut self,
        index: usize,
        buffer: &Buffer,
        bin: Option<&'a [u8]>,
        loading: &mut Loading,
    ) -> Result<usize, SceneError> {
        // Take the bytes from where the buffer says: another file, a data URI, or the binary chunk.
        let data = match &buffer.uri {
            Some(uri) => Cow::Owned(uri::read(
                uri,
                loading.resources,
                loading.allowance.limits.file_bytes,
            )?),
            None => Cow::Borrowed(bin.ok_or(GltfError::NoData { buffer: index })?),
        };

        // Count what was copied towards the memory limit.
        if let Cow::Owned(bytes) = &data {
            loading.allowance.take::<u8>("buffers", bytes.len())?;
        }
        self.data.push(data);
        Ok(self.data.len().saturating_sub(1))
    }

    fn push_slot(&mut self, index: usize, buffer: &Buffer, slot: usize) -> Result<(), GltfError> {
        let bytes = self.data.get(slot).map_or(0, |data| data.len()) as u64;
        let stated_bytes = buffer.byte_length.0;
        if stated_bytes > bytes {
            return Err(GltfError::BufferTooShort {
                buffer: index,
                stated_bytes,
                bytes,
            });
        }
        self.slots.push((slot, stated_bytes as usize));
        Ok(())
    }

    /// Bytes of all buffers together.
    pub(crate) fn byte_count(&self) -> u64 {
        self.data
            .iter()
            .fold(0, |sum, data| sum.saturating_add(data.len() as u64))
    }

    /// The bytes of buffer view `view`, which `user` asks for.
    pub(crate) fn view(&self, root: &Root, view: usize, user: Item) -> Result<&[u8], GltfError> {
        let count = root.buffer_views.len();
        let item = Item::new("buffer view", view);
        let entry = root
            .buffer_views
            .get(view)
            .ok_or(GltfError::Missing { user, item, count })?;
        let buffer = entry.buffer.value();
        let bytes = self.bytes(buffer, item)?;

        let start = entry.byte_offset.unwrap_or_default().0;
        let end = start.saturating_add(entry.byte_length.0);
        let buffer_bytes = bytes.len() as u64;
        range(bytes, start, end).ok_or(GltfError::ViewPastEnd {
            view,
            end,
            buffer,
            buffer_bytes,
        })
    }

    fn bytes(&self, buffer: usize, user: Item) -> Result<&[u8], GltfError> {
        let item = Item::new("buffer", buffer);
        let missing = GltfError::Missing {
            user,
            item,
            count: self.slots.len(),
        };
        let found = self
            .slots
            .get(buffer)
            .and_then(|&(slot, length)| self.data.get(slot)?.get(..length));
        found.ok_or(missing)
    }
}

/// `bytes[start..end]`, where that exists.
pub(crate) fn range(bytes: &[u8], start: u64, end: u64) -> Option<&[u8]> {
    bytes.get(usize::try_from(start).ok()?..usize::try_from(end).ok()?)
}
