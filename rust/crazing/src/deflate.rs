//! Deflate for filtered pixels: Huffman codes fitted to each piece, and runs of zeros.
//!
//! Filtered pixels are mostly small numbers and long runs of zeros; a search for longer matches costs three to eight
//! times as long as all the rest and gains little on them. Every piece ends at a whole byte and knows nothing of the
//! others, so that pieces can be made side by side, kept, and joined later.
//!
//! # Source
//! RFC 1951 for the format; the runs are those of the fdeflate crate.

use simd_adler32::Adler32;

use crate::bits::Bits;
use crate::huffman::{self, END, SYMBOLS};

/// What a zlib stream of joined pieces begins with: deflate, a window of 32 KiB, the fastest level.
pub const HEAD: [u8; 2] = [0x78, 0x01];

/// What it ends with, before the checksum: an empty last block.
pub const LAST: [u8; 2] = [0x03, 0x00];

/// Most bytes of a stored block.
const STORED: usize = 0xFFFF;

/// Longest match; a run of zeros is a zero and matches at distance one.
const LONGEST: usize = 258;

/// Shortest match.
const SHORTEST: usize = 3;

/// Base length of each length symbol from 257 on (RFC 1951, section 3.2.5).
const BASES: [u16; 29] =
    [3, 4, 5, 6, 7, 8, 9, 10, 11, 13, 15, 17, 19, 23, 27, 31, 35, 43, 51, 59, 67, 83, 99, 115, 131, 163, 195, 227, 258];

/// One piece of a deflate stream that holds `data`: whole blocks, none of them the last, up to a whole byte.
pub fn piece(data: &[u8]) -> Vec<u8> {
    let mut counts = Counts([0; SYMBOLS]);
    counts.0[END] = 1;
    tokens(data, &mut counts);
    let lengths = huffman::lengths(&counts.0);
    let bits = cost(&counts.0, &lengths);
    if bits / 8 >= data.len() as u64 {
        return stored(data);
    }
    let mut coder = Coder { bits: Bits::with_room(bits), codes: huffman::codes(&lengths) };
    block_head(&mut coder.bits, &lengths);
    tokens(data, &mut coder);
    coder.symbol(END);
    // An empty stored block brings the stream to a whole byte.
    coder.bits.push(0, 3);
    let mut out = coder.bits.finish();
    out.extend([0, 0, 0xFF, 0xFF]);
    out
}

/// `data` as a whole zlib stream.
pub fn zlib(data: &[u8]) -> Vec<u8> {
    let mut out = HEAD.to_vec();
    out.extend(piece(data));
    out.extend(LAST);
    out.extend(adler(data).to_be_bytes());
    out
}

/// The checksum of a zlib stream (RFC 1950).
pub fn adler(data: &[u8]) -> u32 {
    let mut sum = Adler32::new();
    sum.write(data);
    sum.finish()
}

/// The checksum of two parts joined, from theirs and the second's length.
pub fn joined(first: u32, second: u32, second_len: usize) -> u32 {
    const MODULUS: u64 = 65521;
    let (a, b) = (u64::from(first & 0xFFFF), u64::from(first >> 16));
    let (c, d) = (u64::from(second & 0xFFFF), u64::from(second >> 16));
    // Both sums begin at one, which the second must not bring along again.
    let before = a + MODULUS - 1;
    let high = (b + d + before % MODULUS * (second_len as u64 % MODULUS)) % MODULUS;
    ((high << 16) | ((before + c) % MODULUS)) as u32
}

/// Takes the tokens of a piece.
trait Sink {
    /// Eight bytes that do not need to be looked at one by one.
    fn word(&mut self, bytes: [u8; 8]);
    fn symbol(&mut self, symbol: usize);
    /// A length symbol with its extra bits, at distance one.
    fn length(&mut self, symbol: usize, extra: u32, bits: u32);
}

/// Splits `data` into literals and runs of zeros.
fn tokens(data: &[u8], sink: &mut impl Sink) {
    let mut run = 0;
    let (words, rest) = data.as_chunks::<8>();
    for &word in words {
        let number = u64::from_le_bytes(word);
        if number == 0 {
            run += 8;
            continue;
        }
        // Zeros on the left end the run; a few on the right are not worth one.
        let left = if run > 0 { number.trailing_zeros() as usize / 8 } else { 0 };
        let right = number.leading_zeros() as usize / 8;
        zeros(run + left, sink);
        run = if right >= SHORTEST { right } else { 0 };
        if left + run == 0 {
            sink.word(word);
        } else {
            word[left..8 - run].iter().for_each(|&byte| sink.symbol(usize::from(byte)));
        }
    }
    zeros(run, sink);
    rest.iter().for_each(|&byte| sink.symbol(usize::from(byte)));
}

fn zeros(run: usize, sink: &mut impl Sink) {
    if run == 0 {
        return;
    }
    sink.symbol(0);
    let mut left = run - 1;
    while left >= SHORTEST {
        let step = left.min(LONGEST);
        let index = BASES.partition_point(|&base| usize::from(base) <= step) - 1;
        sink.length(END + 1 + index, step as u32 - u32::from(BASES[index]), extra_bits(index));
        left -= step;
    }
    for _ in 0..left {
        sink.symbol(0);
    }
}

/// Extra bits of a length symbol: none for the first eight and the last, then one more every four.
const fn extra_bits(index: usize) -> u32 {
    if index < 8 || index == BASES.len() - 1 { 0 } else { (index as u32 - 4) / 4 }
}

/// How often each symbol comes.
struct Counts([u32; SYMBOLS]);

impl Sink for Counts {
    #[inline]
    fn word(&mut self, bytes: [u8; 8]) {
        for byte in bytes {
            self.0[usize::from(byte)] += 1;
        }
    }

    #[inline]
    fn symbol(&mut self, symbol: usize) {
        self.0[symbol] += 1;
    }

    fn length(&mut self, symbol: usize, _: u32, _: u32) {
        self.0[symbol] += 1;
    }
}

/// Writes the symbols in their codes.
struct Coder {
    bits: Bits,
    codes: [u32; SYMBOLS],
}

impl Sink for Coder {
    #[inline]
    fn word(&mut self, bytes: [u8; 8]) {
        for half in bytes.as_chunks::<4>().0 {
            let (mut word, mut len) = (0, 0);
            for &byte in half {
                let (code, bits) = huffman::unpacked(self.codes[usize::from(byte)]);
                word |= code << len;
                len += bits;
            }
            self.bits.push(word, len);
        }
    }

    #[inline]
    fn symbol(&mut self, symbol: usize) {
        let (code, bits) = huffman::unpacked(self.codes[symbol]);
        self.bits.push(code, bits);
    }

    fn length(&mut self, symbol: usize, extra: u32, extra_bits: u32) {
        let (code, bits) = huffman::unpacked(self.codes[symbol]);
        // The one distance code is a single 0 bit, behind the extra bits.
        self.bits.push(code | u64::from(extra) << bits, bits + extra_bits + 1);
    }
}

/// Bits that a block takes.
fn cost(counts: &[u32; SYMBOLS], lengths: &[u8; SYMBOLS]) -> u64 {
    let head = 17 + 19 * 3 + 4 * (SYMBOLS as u64 + 1);
    let symbols = counts.iter().zip(lengths).map(|(&count, &len)| u64::from(count) * u64::from(len));
    let extra = (0..BASES.len()).map(|i| u64::from(counts[END + 1 + i]) * u64::from(extra_bits(i) + 1));
    head + symbols.sum::<u64>() + extra.sum::<u64>()
}

/// The head of a block with codes of its own. Their lengths, 0 to 15, are written in four bits each.
fn block_head(bits: &mut Bits, lengths: &[u8; SYMBOLS]) {
    bits.push(0b100, 3);
    bits.push(SYMBOLS as u64 - 257, 5);
    bits.push(0, 5);
    bits.push(19 - 4, 4);
    // The symbols 16, 17, 18, which repeat, come first and are not used.
    for index in 0..19 {
        bits.push(if index < 3 { 0 } else { 4 }, 3);
    }
    for &len in lengths.iter().chain(&[1]) {
        bits.push(u64::from(len.reverse_bits() >> 4), 4);
    }
}

fn stored(data: &[u8]) -> Vec<u8> {
    let mut out = Vec::with_capacity(data.len() + 5 * (data.len() / STORED + 1));
    for part in data.chunks(STORED) {
        let len = part.len() as u16;
        out.push(0);
        out.extend(len.to_le_bytes());
        out.extend((!len).to_le_bytes());
        out.extend(part);
    }
    out
}
