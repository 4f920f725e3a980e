//! What can be wrong with a glTF file.

use std::fmt;

use crate::shown::shown;

/// An item of a glTF file, for messages: `mesh 3`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Item {
    /// What it is, in the words of the format.
    pub kind: &'static str,
    /// Its place in the file's list, counted from 0.
    pub index: usize,
}

impl Item {
    /// The item of this kind at `index`.
    pub(crate) fn new(kind: &'static str, index: usize) -> Self {
        Self { kind, index }
    }
}

impl fmt::Display for Item {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", self.kind, self.index)
    }
}

/// What makes a file of an older version readable, as the end of a sentence.
fn converter(version: &str) -> &'static str {
    match version.split('.').next() {
        Some("0" | "1") => "; gltf-pipeline converts it",
        _ => "",
    }
}

/// What is wrong with a glTF or VRM file.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum GltfError {
    /// The file does not begin as a binary glTF file.
    #[error("the file does not begin with 'glTF'")]
    NotGlb,
    /// The container has another version than 2.
    #[error(
        "the container has version {version}, and only 2 is supported{}",
        converter(&version.to_string())
    )]
    ContainerVersion {
        /// The version as read.
        version: u32,
    },
    /// The file ends before it should.
    #[error("{part} ends at byte {end}, but the file has only {file_bytes}")]
    Truncated {
        /// What is cut off.
        part: &'static str,
        /// Where it should end.
        end: u64,
        /// Where the file, or its stated length, ends.
        file_bytes: u64,
    },
    /// A binary file does not begin with a JSON chunk.
    #[error("the first chunk is not JSON")]
    NoJson,
    /// The text is not JSON, or not of the shape of glTF.
    #[error("JSON, line {line}, column {column}: {fault}")]
    Json {
        /// Line, counted from 1.
        line: usize,
        /// Column, counted from 1.
        column: usize,
        /// What is wrong there.
        fault: &'static str,
    },
    /// The text stopped its decoder.
    #[error("the JSON text is broken")]
    Unreadable,
    /// The file is of another major version than 2.
    #[error(
        "glTF version '{}' is not supported, only 2.0 is{}",
        shown(version),
        converter(version)
    )]
    Version {
        /// The version as the file states it.
        version: String,
    },
    /// The file cannot be drawn without an extension that is not supported.
    #[error("the extension '{}' is required, but not supported", shown(extension))]
    RequiredExtension {
        /// Name of the extension.
        extension: String,
    },
    /// The file draws a scene that does not exist.
    #[error("the default scene is {scene}, but the file has only {count} scenes")]
    NoScene {
        /// Index of the scene.
        scene: usize,
        /// How many scenes there are.
        count: usize,
    },
    /// An item refers to one that does not exist.
    #[error("{user} uses {item}, but the file has only {count}")]
    Missing {
        /// The item that refers.
        user: Item,
        /// What it refers to.
        item: Item,
        /// How many there are.
        count: usize,
    },
    /// A buffer has no data.
    #[error("buffer {buffer} has neither a URI nor a binary chunk")]
    NoData {
        /// Index of the buffer.
        buffer: usize,
    },
    /// A buffer's data is shorter than stated.
    #[error("buffer {buffer} should have {stated_bytes} bytes, but only {bytes} are there")]
    BufferTooShort {
        /// Index of the buffer.
        buffer: usize,
        /// Length as stated.
        stated_bytes: u64,
        /// Length as found.
        bytes: u64,
    },
    /// A buffer view reaches past its buffer.
    #[error("buffer view {view} ends at byte {end}, but buffer {buffer} has only {buffer_bytes}")]
    ViewPastEnd {
        /// Index of the view.
        view: usize,
        /// Where it ends.
        end: u64,
        /// Index of the buffer.
        buffer: usize,
        /// Length of the buffer.
        buffer_bytes: u64,
    },
    /// An accessor reaches past its buffer view.
    #[error("accessor {accessor} ends at byte {end}, but buffer view {view} has only {view_bytes}")]
    AccessorPastEnd {
        /// Index of the accessor.
        accessor: usize,
        /// Where it ends, counted from the start of the view.
        end: u64,
        /// Index of the view.
        view: usize,
        /// Length of the view.
        view_bytes: u64,
    },
    /// Elements would overlap.
    #[error("accessor {accessor} has elements of {element_bytes} bytes, but a stride of {stride}")]
    Stride {
        /// Index of the accessor.
        accessor: usize,
        /// Bytes of one element.
        element_bytes: usize,
        /// Bytes from one element to the next.
        stride: usize,
    },
    /// An accessor without a buffer view has more elements than the file has bytes.
    #[error(
        "accessor {accessor} has {count} elements, but the file has only {data_bytes} bytes of data"
    )]
    TooManyElements {
        /// Index of the accessor.
        accessor: usize,
        /// How many elements it states.
        count: u64,
        /// Bytes of all buffers together.
        data_bytes: u64,
    },
    /// A sparse accessor replaces an element that does not exist.
    #[error("accessor {accessor} replaces element {element}, but has only {count}")]
    SparseElement {
        /// Index of the accessor.
        accessor: usize,
        /// The element as read.
        element: u32,
        /// How many elements there are.
        count: usize,
    },
    /// An accessor holds something else than its use asks for.
    #[error("{user} needs {wanted} from accessor {accessor}, which holds something else")]
    ElementType {
        /// The item that reads it.
        user: Item,
        /// Index of the accessor.
        accessor: usize,
        /// What is needed.
        wanted: &'static str,
    },
    /// An accessor has elements of a type that glTF does not know.
    #[error("accessor {accessor} has elements of an unknown type")]
    UnknownElements {
        /// Index of the accessor.
        accessor: usize,
    },
    /// Two lists that belong together differ in length.
    #[error("{user}: accessor {accessor} has {count} elements where {wanted} are needed")]
    Count {
        /// The item that reads it.
        user: Item,
        /// Index of the accessor.
        accessor: usize,
        /// How many elements it has.
        count: usize,
        /// How many are needed.
        wanted: usize,
    },
    /// A triangle names a vertex that does not exist.
    #[error(
        "mesh {mesh}, part {part}: triangle {triangle} uses vertex {vertex}, but the part has only {vertex_count}"
    )]
    MissingVertex {
        /// Index of the mesh.
        mesh: usize,
        /// Index of the primitive in the mesh.
        part: usize,
        /// Which triangle, counted from 0.
        triangle: usize,
        /// The vertex index as read.
        vertex: u32,
        /// How many vertices there are.
        vertex_count: usize,
    },
    /// A line segment names a vertex that does not exist.
    #[error(
        "mesh {mesh}, part {part}: line segment {segment} uses vertex {vertex}, but the part has only {vertex_count}"
    )]
    MissingEnd {
        /// Index of the mesh.
        mesh: usize,
        /// Index of the primitive in the mesh.
        part: usize,
        /// Which segment, counted from 0.
        segment: usize,
        /// The vertex index as read.
        vertex: u32,
        /// How many vertices there are.
        vertex_count: usize,
    },
    /// A node is reached on two ways, or hangs on itself.
    #[error("node {node} is reached twice: nodes must form a tree")]
    NodeReachedTwice {
        /// Index of the node.
        node: usize,
    },
}
