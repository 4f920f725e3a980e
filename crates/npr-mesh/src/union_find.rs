//! Disjoint sets, merged pair by pair.

/// Disjoint sets of `0..n`, each named by its smallest member, so that names do not depend on the
/// order of merges [Tarjan 1975].
#[derive(Debug)]
pub struct UnionFind {
    parent: Vec<u32>,
}

impl UnionFind {
    /// Sets of one member each.
    pub fn new(count: usize) -> Self {
        Self {
            parent: (0..count as u32).collect(),
        }
    }

    /// The smallest member of the set that holds `member`; halves the path it walks.
    pub fn find(&mut self, mut member: u32) -> u32 {
        while self.parent[member as usize] != member {
            let grandparent = self.parent[self.parent[member as usize] as usize];
            self.parent[member as usize] = grandparent;
            member = grandparent;
        }
        member
    }

    /// Makes one set of the sets that hold two members.
    pub fn unite(&mut self, a: u32, b: u32) {
        let (a, b) = (self.find(a), self.find(b));
        self.parent[a.max(b) as usize] = a.min(b);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_set_is_named_by_its_smallest_member(pairs in prop::collection::vec((0u32..30, 0u32..30), 0..40)) {
            let mut sets = UnionFind::new(30);
            let mut name: Vec<u32> = (0..30).collect();
            for (a, b) in pairs {
                sets.unite(a, b);
                let (x, y) = (name[a as usize], name[b as usize]);
                name.iter_mut().filter(|n| **n == x.max(y)).for_each(|n| *n = x.min(y));
            }
            let found: Vec<u32> = (0..30).map(|member| sets.find(member)).collect();
            prop_assert_eq!(found, name);
        }
    }
}
