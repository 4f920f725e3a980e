//! Lists of what several nodes or materials share.

use std::collections::BTreeMap;

/// Items in order of first use, each made once however often it is asked for.
#[derive(Debug)]
pub(crate) struct Pool<K, T> {
    places: BTreeMap<K, Option<u32>>,
    pub(crate) items: Vec<T>,
}

impl<K, T> Default for Pool<K, T> {
    fn default() -> Self {
        Self {
            places: BTreeMap::new(),
            items: Vec::new(),
        }
    }
}

impl<K: Ord, T> Pool<K, T> {
    /// Where the item of `key` is; none where `make`, asked once per key, gave none.
    pub(crate) fn place<E>(
        &mut self,
        key: K,
        make: impl FnOnce() -> Result<Option<T>, E>,
    ) -> Result<Option<u32>, E> {
        if let Some(&place) = self.places.get(&key) {
            return Ok(place);
        }
        let next = self.items.len() as u32;
        let item = make()?;
        let place = item.is_some().then_some(next);
        self.items.extend(item);
        self.places.insert(key, place);
        Ok(place)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_key_is_made_once() {
        let mut pool = Pool::default();
        let mut made = Vec::new();
        for key in ["a", "none", "b", "a", "none"] {
            let make = || {
                made.push(key);
                Ok::<_, ()>((key != "none").then_some(key))
            };
            let expected = [("a", 0), ("b", 1)]
                .into_iter()
                .find(|(name, _)| *name == key);
            assert_eq!(pool.place(key, make), Ok(expected.map(|(_, place)| place)));
        }
        assert_eq!(made, ["a", "none", "b"]);
        assert_eq!(pool.items, ["a", "b"]);
    }
}
