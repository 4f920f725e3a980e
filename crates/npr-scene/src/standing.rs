//! Where nodes stand in a pose that a scene has not taken yet.

use crate::matrix::{self, Matrix};
use crate::pose::Pose;
use crate::scene::Scene;
use std::collections::BTreeMap;

/// World space from the spaces of some nodes, each worked out once.
pub(crate) struct Standing<'a> {
    scene: &'a Scene,
    worlds: BTreeMap<u32, Matrix>,
}

impl<'a> Standing<'a> {
    /// Nothing is worked out yet.
    pub fn new(scene: &'a Scene) -> Self {
        Self {
            scene,
            worlds: BTreeMap::new(),
        }
    }

    /// Where a node stands in a pose, in world space. The pose may change between calls where no node changes that was
    /// asked for, or that one of those hangs on.
    ///
    /// O(nodes on the way to the root that were not asked for yet).
    pub fn world(&mut self, node: u32, pose: &Pose) -> Matrix {
        // Go up to what is known.
        let (mut way, mut above) = (Vec::new(), Some(node));
        let mut world = matrix::IDENTITY;
        while let Some(index) = above {
            if let Some(known) = self.worlds.get(&index) {
                world = *known;
                break;
            }
            way.push(index);
            above = self.scene.nodes[index as usize].parent;
        }

        // Come back down.
        for index in way.into_iter().rev() {
            let local = self.scene.nodes[index as usize].local_in(pose.transforms.get(&index));
            world = matrix::multiply(&world, &local);
            self.worlds.insert(index, world);
        }
        world
    }
}
