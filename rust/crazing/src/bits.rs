//! Bits, the lowest first, into bytes.

/// Room for bytes, and an unfinished word.
#[derive(Debug)]
pub(crate) struct Bits {
    out: Vec<u8>,
    /// Bytes of `out` that are written.
    done: usize,
    word: u64,
    /// Bits of `word` in use, less than 64.
    used: u32,
}

impl Bits {
    /// Room for that many bits. What is pushed beyond them is lost.
    pub(crate) fn with_room(bits: u64) -> Self {
        Self { out: vec![0; (bits / 8) as usize + 16], done: 0, word: 0, used: 0 }
    }

    /// Appends the lowest `len` bits of `bits`, 1 to 63; its others are zero.
    #[inline]
    pub(crate) fn push(&mut self, bits: u64, len: u32) {
        self.word |= bits << self.used;
        self.used += len;
        if self.used >= 64 {
            self.flush();
            self.used -= 64;
            self.word = bits >> (len - self.used);
        }
    }

    #[inline]
    fn flush(&mut self) {
        if let Some(room) = self.out.get_mut(self.done..self.done + 8) {
            room.copy_from_slice(&self.word.to_le_bytes());
        }
        self.done += 8;
    }

    /// The bytes, the last one filled up with zeros.
    pub(crate) fn finish(mut self) -> Vec<u8> {
        let len = self.done + self.used.div_ceil(8) as usize;
        self.flush();
        self.out.truncate(len);
        self.out
    }
}
