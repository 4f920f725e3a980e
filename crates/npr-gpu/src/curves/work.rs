//! Sizes of passes over lists whose lengths only the engine knows.

use crate::graph::{Graph, ResourceId, WorkSize};
use crate::passes::vector;
use npr_vector::rank::work::{Arguments, WorkRule};

/// Which elements passes over a list work on: all that there is room for, or those of the list.
///
/// Every pass over a list is appended with the same `ListWork`, so that all of them work on the same elements.
#[derive(Debug, Clone, Copy, Default)]
pub struct ListWork {
    /// Buffer of [`Arguments`] in the order of the rule; `None` if passes work on the whole room.
    arguments: Option<ResourceId>,
    rule: WorkRule,
}

/// Further passes that a list's length sizes, besides those over its elements and sums over them.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct IndirectArguments {
    /// Number of rounds of pointer jumping.
    pub rounds: u32,
    /// Number of vertices drawn for each element.
    pub vertices: u32,
}

impl ListWork {
    /// All elements that there is room for.
    pub const WHOLE: Self = Self {
        arguments: None,
        rule: WorkRule {
            room: 0,
            level_count: 0,
            round_count: 0,
            vertices: 0,
        },
    };

    /// The buffer of arguments, for inspection; `None` if passes work on the whole room.
    pub fn arguments(&self) -> Option<ResourceId> {
        self.arguments
    }

    /// The size of passes over the elements.
    pub fn elements(&self) -> Option<WorkSize> {
        self.at(0)
    }

    /// The size of passes that sum up the elements, the sums of their blocks, the sums of these, and so on.
    ///
    /// # Panics
    ///
    /// When there is no such level in the list's room.
    pub fn level(&self, level: u32) -> Option<WorkSize> {
        assert!(
            self.arguments.is_none() || level < self.rule.level_count,
            "sums reach beyond the room"
        );
        self.at(1 + level)
    }

    /// The size of a round of pointer jumping; rounds that change nothing are empty.
    ///
    /// # Panics
    ///
    /// When the list's work was made for fewer rounds.
    pub fn round(&self, round: u32) -> Option<WorkSize> {
        assert!(
            self.arguments.is_none() || round < self.rule.round_count,
            "work for fewer rounds"
        );
        self.at(1 + self.rule.level_count + round)
    }

    /// The size of draws of the elements.
    ///
    /// # Panics
    ///
    /// When the list's work was made without vertices.
    pub fn draw(&self) -> Option<WorkSize> {
        assert!(
            self.arguments.is_none() || self.rule.vertices > 0,
            "work without draws"
        );
        self.at(1 + self.rule.level_count + self.rule.round_count)
    }

    fn at(&self, index: u32) -> Option<WorkSize> {
        let arguments = self.arguments?;
        let index = index as usize;
        Some(WorkSize { arguments, index })
    }
}

/// Appends the pass that makes the sizes of all passes over a list of `count[0]` elements, with room for `room`.
pub fn add_work(
    graph: &mut Graph,
    count: ResourceId,
    room: usize,
    indirect: IndirectArguments,
) -> ListWork {
    let rule = WorkRule {
        round_count: indirect.rounds,
        vertices: indirect.vertices,
        ..WorkRule::of_room(room)
    };
    let held = graph.constant("work rule", rule);
    let arguments = graph.buffer::<Arguments>("sizes of passes", rule.argument_count());
    graph.compute(&vector::SIZE_WORK, &[held, count, arguments]);
    ListWork {
        arguments: Some(arguments),
        rule,
    }
}
