//! Where what takes long to make is kept from run to run. The core knows of no files: a host gives it a [`Store`].

/// Keeps bytes under names.
pub trait Store {
    /// What is kept under a name: nothing, or its bytes; or why it cannot be read.
    ///
    /// # Errors
    /// In words.
    fn load(&self, name: &str) -> Result<Option<Vec<u8>>, String>;

    /// Keeps bytes under a name: all of them or none.
    ///
    /// # Errors
    /// In words.
    fn save(&self, name: &str, bytes: &[u8]) -> Result<(), String>;
}

/// Keeps nothing.
#[derive(Clone, Copy, Debug)]
pub struct NoStore;

impl Store for NoStore {
    fn load(&self, _: &str) -> Result<Option<Vec<u8>>, String> {
        Ok(None)
    }

    fn save(&self, _: &str, _: &[u8]) -> Result<(), String> {
        Ok(())
    }
}

/// How something was come by.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Found {
    /// It was stored before.
    pub stored: bool,
    /// What went wrong with the store, in words; the result is right all the same.
    pub trouble: Vec<String>,
}

/// A sum of 128 bits over long data, 16 bytes at a time. Every change of one word is found; nobody is kept from forging.
#[derive(Clone, Debug)]
pub struct Sum(u128);

impl Default for Sum {
    fn default() -> Self {
        Self(0x6c62_272e_07bb_0142_62b8_2175_6295_c58d)
    }
}

impl Sum {
    fn word(&mut self, word: u128) {
        // Each of the three can be undone, so two words never give the same sum. The shift brings high bits down, where products spread them.
        let product = (self.0 ^ word).wrapping_mul(0x0000_0000_0100_0000_0000_0000_0000_013b);
        self.0 = (product ^ (product >> 67)).wrapping_add(0x9e37_79b9_7f4a_7c15);
    }

    /// Adds bytes, and how many they are.
    pub fn bytes(&mut self, bytes: &[u8]) {
        let (words, rest) = bytes.as_chunks::<16>();
        words.iter().for_each(|word| self.word(u128::from_le_bytes(*word)));
        let mut last = [0; 16];
        last[..rest.len()].copy_from_slice(rest);
        self.word(u128::from_le_bytes(last));
        self.word(bytes.len() as u128);
    }

    /// The sum of all that was added.
    pub fn value(&self) -> u128 {
        self.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sum(bytes: &[u8]) -> u128 {
        let mut sum = Sum::default();
        sum.bytes(bytes);
        sum.value()
    }

    #[test]
    fn every_bit_and_the_length_count() {
        let bytes: Vec<u8> = (0..77_u32).map(|k| (k * k) as u8).collect();
        let mut sums = vec![sum(&bytes), sum(&bytes[..76]), sum(&[]), sum(&[0]), sum(&[0; 16]), sum(&[0; 32])];
        for bit in 0..8 * bytes.len() {
            let mut changed = bytes.clone();
            changed[bit / 8] ^= 1 << (bit % 8);
            sums.push(sum(&changed));
        }
        let count = sums.len();
        sums.sort_unstable();
        sums.dedup();
        assert_eq!(sums.len(), count);
        assert_eq!(sum(&bytes), sum(&bytes.clone()), "control");
    }
}
