//! Huffman codes of deflate: bytes, the end of a block, lengths.

/// Symbols of a block: 256 bytes, its end, 29 lengths.
pub(crate) const SYMBOLS: usize = 286;

/// The end of a block.
pub(crate) const END: usize = 256;

/// Longest code. Deflate allows 15; four codes of 12 fit into a word, and the codes cost a thousandth more.
const LIMIT: u32 = 12;

/// Bits that hold a symbol.
const PLACE: u32 = 9;

/// The length of each symbol's code, 0 for one that does not come; at least two do.
pub(crate) fn lengths(counts: &[u32; SYMBOLS]) -> [u8; SYMBOLS] {
    let mut counts = *counts;
    if counts.iter().filter(|&&count| count > 0).count() < 2 {
        // A lone code would have no bits.
        counts[0] = 1;
        counts[END] = 1;
    }
    loop {
        let depths = depths(&counts);
        if depths.iter().all(|&depth| u32::from(depth) <= LIMIT) {
            return depths;
        }
        // Counts closer to one another make a flatter tree.
        for count in counts.iter_mut().filter(|count| **count > 0) {
            *count = *count / 2 + 1;
        }
    }
}

/// Depths in the tree that joins the two least nodes again and again.
fn depths(counts: &[u32; SYMBOLS]) -> [u8; SYMBOLS] {
    // In one number each, which are sorted several times faster than pairs.
    let packed = |(i, &count): (usize, &u32)| (count > 0).then_some(u64::from(count) << PLACE | i as u64);
    let mut leaves: Vec<u64> = counts.iter().enumerate().filter_map(packed).collect();
    leaves.sort_unstable();
    // Joined nodes arise in order of weight: two queues do for a heap.
    let mut weights: Vec<u64> = leaves.iter().map(|leaf| leaf >> PLACE).collect();
    let mut parents = vec![0; 2 * leaves.len() - 1];
    let (mut leaf, mut node) = (0, leaves.len());
    while weights.len() < parents.len() {
        let mut take = || {
            let from_leaves = leaf < leaves.len() && (node >= weights.len() || weights[leaf] <= weights[node]);
            let next = if from_leaves { &mut leaf } else { &mut node };
            *next += 1;
            *next - 1
        };
        let (a, b) = (take(), take());
        parents[a] = weights.len();
        parents[b] = weights.len();
        weights.push(weights[a] + weights[b]);
    }
    let mut levels = vec![0_u8; parents.len()];
    for i in (0..parents.len() - 1).rev() {
        levels[i] = levels[parents[i]].saturating_add(1);
    }
    let mut out = [0; SYMBOLS];
    for (leaf, &level) in leaves.iter().zip(&levels) {
        out[(leaf & ((1 << PLACE) - 1)) as usize] = level;
    }
    out
}

/// The codes, lowest bit first, with their lengths above the lowest sixteen bits (RFC 1951, section 3.2.2).
pub(crate) fn codes(lengths: &[u8; SYMBOLS]) -> [u32; SYMBOLS] {
    let mut out = [0; SYMBOLS];
    let mut code = 0_u16;
    for len in 1..=LIMIT {
        for (symbol, _) in lengths.iter().enumerate().filter(|(_, found)| u32::from(**found) == len) {
            out[symbol] = u32::from(code.reverse_bits() >> (16 - len)) | len << 16;
            code += 1;
        }
        code <<= 1;
    }
    out
}

/// Code and length of an entry of [`codes`].
#[inline]
pub(crate) fn unpacked(entry: u32) -> (u64, u32) {
    (u64::from(entry & 0xFFFF), entry >> 16)
}
