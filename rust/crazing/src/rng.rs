//! Random numbers by counter: word `i` of a stream is a function of key, stream and `i` alone, so no order of
//! work and no number of threads can change it.
//!
//! # Source
//! Salmon, Moraes, Dror, Shaw: Parallel Random Numbers: As Easy as 1, 2, 3 (SC 2011), Philox4x64-10.

/// What a call draws all its randomness from.
pub type Key = [u64; 2];

/// One purpose a stream: a draw added to one never shifts another. A number, once released, is never given to
/// another purpose, or old seeds would give new results.
pub mod stream {
    /// Points of a distribution, see [`crate::sample`].
    pub const SAMPLE: u64 = 1;
    /// Poisson-disk points.
    pub const POISSON_DISK: u64 = 2;
    /// Points by the brightness of an image.
    pub const DENSITY: u64 = 3;
    /// The order in which a maze opens its doors.
    pub const MAZE: u64 = 4;
    /// Which of a crack's edges open.
    pub const OPENING: u64 = 5;
    /// Where cracks start.
    pub const SOURCE: u64 = 6;
    /// Width along a crack.
    pub const WIDTH: u64 = 7;
    /// The wandering of a crack about its straight edges.
    pub const ROUGHNESS: u64 = 8;
    /// The smooth warp of a whole crack pattern.
    pub const WARP: u64 = 9;
    /// Where and in which order cells are split.
    pub const SPLIT: u64 = 10;
    /// Spokes and arcs about an impact.
    pub const IMPACT: u64 = 11;
    /// Short free branches of cracks.
    pub const STUBS: u64 = 12;
    /// In which order constraints that cross many edges are inserted.
    pub const CONSTRAINT: u64 = 20;
    /// Noise over the pixels of a texture.
    pub const GRAIN: u64 = 40;
    /// How the plates of a texture differ.
    pub const PLATE: u64 = 41;
}

// Multipliers and Weyl increments (golden ratio, sqrt(3) - 1) of the paper, table 2 and section 4.3.
const MULTIPLIERS: [u64; 2] = [0xD2E7_470E_E14C_6C93, 0xCA5A_8263_9512_1157];
const WEYL: [u64; 2] = [0x9E37_79B9_7F4A_7C15, 0xBB67_AE85_84CA_A73B];
const ROUNDS: usize = 10;

/// The four random words at `counter`.
#[inline]
pub fn block(mut key: Key, mut counter: [u64; 4]) -> [u64; 4] {
    for _ in 0..ROUNDS {
        let (high0, low0) = product(MULTIPLIERS[0], counter[0]);
        let (high1, low1) = product(MULTIPLIERS[1], counter[2]);
        counter = [high1 ^ counter[1] ^ key[0], low1, high0 ^ counter[3] ^ key[1], low0];
        key = [key[0].wrapping_add(WEYL[0]), key[1].wrapping_add(WEYL[1])];
    }
    counter
}

/// High and low word of `a` times `b`.
#[inline]
fn product(a: u64, b: u64) -> (u64, u64) {
    let wide = u128::from(a) * u128::from(b);
    ((wide >> 64) as u64, wide as u64)
}

/// A word as a number of the open interval (0, 1), one of 2^52 midpoints.
///
/// Midpoints of 2^52 intervals, not of 2^53: those need 54 bits, and the last would round to 1. `p` and `1 - p`
/// are both exact here, so quantile functions are symmetric to the last bit.
#[inline]
pub fn open_unit(word: u64) -> f64 {
    // The bits behind the point of a number from 1 to 2; what is taken from it leaves half an interval, exactly.
    const BELOW_ONE: f64 = 1.0 - f64::EPSILON / 2.0;
    f64::from_bits(0x3ff0_0000_0000_0000 | (word >> 12)) - BELOW_ONE
}

/// A word as a multiple of 2^-53 in [0, 1).
#[inline]
pub fn unit(word: u64) -> f64 {
    const STEP: f64 = 1.0 / (1_u64 << 53) as f64;
    (word >> 11) as f64 * STEP
}

/// The words of one stream in turn.
///
/// Block `b` of an item is at counter `[b, item, stream, 0]`: the first word counts, the second separates things of one
/// purpose, such as tiles, the third the purposes. The last stays free.
#[derive(Debug, Clone)]
pub struct Rng {
    key: Key,
    stream: u64,
    item: u64,
    next_block: u64,
    words: [u64; 4],
    /// 32-bit halves of `words` already given away.
    used: usize,
}

const HALVES: usize = 8;

impl Rng {
    /// The start of `stream` under `key`.
    pub fn new(key: Key, stream: u64) -> Self {
        Self::of_item(key, stream, 0)
    }

    /// The start of an item's own words of `stream`; those of item 0 are what [`Rng::new`] gives.
    pub fn of_item(key: Key, stream: u64, item: u64) -> Self {
        Self { key, stream, item, next_block: 0, words: [0; 4], used: HALVES }
    }

    /// 64 random bits. Passes over the second half of a word of which [`Rng::next_u32`] gave the first.
    #[inline]
    pub fn next_u64(&mut self) -> u64 {
        self.used = self.used.next_multiple_of(2);
        self.refill_if_empty();
        let word = self.words[self.used / 2 % 4];
        self.used += 2;
        word
    }

    /// 32 random bits: the lower half of a word, then its upper half.
    #[inline]
    pub fn next_u32(&mut self) -> u32 {
        self.refill_if_empty();
        let word = self.words[self.used / 2 % 4];
        let half = word >> (32 * (self.used % 2));
        self.used += 1;
        half as u32
    }

    /// A number of 0, ..., n - 1, each as likely as the other; 0 for `n` = 0.
    ///
    /// # Source
    /// Lemire: Fast Random Integer Generation in an Interval (ACM TOMACS 2019).
    #[inline]
    pub fn below(&mut self, n: u32) -> u32 {
        let mut wide = u64::from(self.next_u32()) * u64::from(n);
        if (wide as u32) < n {
            // The first 2^32 mod n values of the lower half would favour some numbers: draw again.
            let surplus = n.wrapping_neg() % n;
            while (wide as u32) < surplus {
                wide = u64::from(self.next_u32()) * u64::from(n);
            }
        }
        (wide >> 32) as u32
    }

    /// A multiple of 2^-53 in [0, 1).
    #[inline]
    pub fn unit(&mut self) -> f64 {
        unit(self.next_u64())
    }

    #[inline]
    fn refill_if_empty(&mut self) {
        if self.used == HALVES {
            self.words = block(self.key, [self.next_block, self.item, self.stream, 0]);
            self.next_block = self.next_block.wrapping_add(1);
            self.used = 0;
        }
    }
}
