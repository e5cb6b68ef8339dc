//! A fingerprint of results, bit for bit: what the proof that two worlds agree compares.

use core::hash::Hasher;

/// FNV-1a (Fowler, Noll, Vo) of 64 bits over the little-endian bytes of what is put in, with their number.
///
/// Not cryptographic: it guards against accidents of arithmetic, of which one changed bit changes the value.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Digest {
    size: u64,
    value: u64,
}

impl Default for Digest {
    fn default() -> Self {
        Self::new()
    }
}

impl Digest {
    /// Of nothing.
    pub fn new() -> Self {
        Self { size: 0, value: 0xcbf2_9ce4_8422_2325 }
    }

    /// Puts the bits of a number in.
    pub fn f64(&mut self, x: f64) {
        self.write(&x.to_bits().to_le_bytes());
    }

    /// Puts an integer in.
    pub fn u32(&mut self, x: u32) {
        self.write(&x.to_le_bytes());
    }

    /// How many bytes went in.
    pub fn size(&self) -> u64 {
        self.size
    }

    /// The fingerprint.
    pub fn value(&self) -> u64 {
        self.value
    }
}

impl Hasher for Digest {
    fn write(&mut self, bytes: &[u8]) {
        self.size += bytes.len() as u64;
        for &byte in bytes {
            self.value = (self.value ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }

    fn finish(&self) -> u64 {
        self.value()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn meets_the_published_test_vector() {
        let mut digest = Digest::new();
        digest.write(b"foobar");
        assert_eq!((digest.size(), digest.value()), (6, 0x8594_4171_f739_67e8));
    }
}
