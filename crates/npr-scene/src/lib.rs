//! Scenes from files.
//!
//! [`load()`] turns a glTF, VRM, OBJ, STL or PLY file into a [`Scene`]: plain lists whose indices are all
//! in range and whose numbers are all finite, so that nothing downstream has to check again. What
//! cannot be mended is a [`SceneError`] that names the place in the file; what was ignored or mended is
//! a [`Notice`].
//!
//! ```
//! use npr_scene::{Limits, MemoryResources, load_bytes};
//!
//! let triangle = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
//! let scene = load_bytes("triangle.obj", triangle, None, &MemoryResources::default(), &Limits::default())?;
//! assert_eq!(scene.triangle_count(), 1);
//! assert_eq!(scene.bounds_world(), Some(([0.0; 3], [1.0, 1.0, 0.0])));
//! # Ok::<(), npr_scene::SceneError>(())
//! ```
//!
//! Clips of a glTF file move its nodes: [`Scene::pose_at`] gives a [`Pose`] at a time of a [`Clip`], and
//! [`Scene::set_pose`] puts the scene into it. The [`Figure`] of a VRM names bones and expressions: [`Scene::bend`]
//! and [`Pose::shares`] pose them, and [`Scene::clips_of`] makes clips of another humanoid its own.
//!
//! Files are hostile until proven sound: sizes are checked against [`Limits`] before memory is
//! planned, trees are walked without recursion, and other files are reached only through
//! [`Resources`], which [`FolderResources`] confines to the scene's own folder.

mod alpha;
mod bending;
mod bone;
mod camera;
mod clip;
mod constraining;
mod constraint;
mod decode;
mod error;
mod expressing;
mod expression;
mod figure;
mod format;
mod gltf;
mod image;
mod laid;
mod light;
mod limits;
mod load;
mod loading;
mod look_at;
mod looking;
mod material;
mod matrix;
mod mesh;
mod morph;
mod morphing;
mod motion;
mod node;
mod notice;
mod obj;
mod ply;
mod polygon;
mod pool;
mod pose;
mod posture;
mod quaternion;
mod reach;
mod resources;
mod scene;
mod shown;
mod skin;
mod skinning;
mod soundness;
mod split;
mod springs;
mod standing;
mod stl;
#[cfg(any(test, feature = "testing"))]
pub mod testing;
mod toon;
mod transform;
mod uri;
mod words;

pub use alpha::AlphaMode;
pub use bone::Bone;
pub use camera::{Camera, Projection};
pub use clip::{Channel, Clip, Interpolation, Property};
pub use constraint::{Constraint, ConstraintKind};
pub use error::SceneError;
pub use expression::{ColorBind, Expression, MorphBind, Override, TextureBind};
pub use figure::Figure;
pub use format::Format;
pub use gltf::{GltfError, Item};
pub use image::Image;
pub use laid::{TextureTransform, TextureUse, Wrap};
pub use light::{Light, LightKind};
pub use limits::{LimitError, Limits};
pub use load::{LoadOptions, load, load_bytes};
pub use look_at::{Eyes, LookAt, RangeMap};
pub use material::Material;
pub use matrix::Matrix;
pub use mesh::{Mesh, POSITION_LIMIT, Part};
pub use morph::{Morph, Unmorphed};
pub use motion::{MotionError, Motions};
pub use node::Node;
pub use notice::Notice;
pub use obj::{Element as ObjElement, ObjError};
pub use ply::PlyError;
pub use pose::{Pose, PoseError};
pub use posture::{Posture, PostureError, PostureFault};
pub use resources::{FolderResources, MemoryResources, ResourceError, Resources};
pub use scene::Scene;
pub use skin::Skin;
pub use springs::{Collider, SpringChain, SpringJoint, Springs, Swing, Swinging};
pub use stl::StlError;
pub use toon::{OutlineWidth, Toon, ToonOutline, UvFlow};
pub use transform::Transform;
