//! Random numbers that are a function of seed, loader and case.

/// The draws of one case.
pub(crate) struct Chance {
    key: u64,
    draws: u64,
}

fn mixed(value: u64) -> u64 {
    let value = (value ^ (value >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let value = (value ^ (value >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    value ^ (value >> 31)
}

impl Chance {
    pub(crate) fn new(seed: u64, loader: &str, case: u64) -> Self {
        let name = loader.bytes().fold(seed, |key, byte| mixed(key ^ u64::from(byte)));
        Self { key: mixed(name ^ mixed(case.wrapping_add(0x9e37_79b9_7f4a_7c15))), draws: 0 }
    }

    /// From 0 to below `limit`; 0 where that is 0.
    pub(crate) fn below(&mut self, limit: u64) -> u64 {
        self.draws += 1;
        mixed(self.key.wrapping_add(self.draws.wrapping_mul(0x9e37_79b9_7f4a_7c15))).checked_rem(limit).unwrap_or(0)
    }

    /// An index of a list; 0 where it is empty.
    pub(crate) fn index(&mut self, length: usize) -> usize {
        self.below(length as u64) as usize
    }

    /// One in `many`.
    pub(crate) fn one_in(&mut self, many: u64) -> bool {
        self.below(many) == 0
    }

    pub(crate) fn pick<'a, T>(&mut self, list: &'a [T]) -> &'a T {
        &list[self.index(list.len())]
    }

    /// A stretch within a list, short ones more often.
    pub(crate) fn stretch(&mut self, length: usize) -> std::ops::Range<usize> {
        let start = self.index(length);
        let most = if self.one_in(4) { length } else { length.min(16) };
        start..(start + 1 + self.index(most)).min(length)
    }
}
