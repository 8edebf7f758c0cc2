//! Hilbert's curve on a 65536 x 65536 grid.

/// Bits of each coordinate that one look at the table takes.
const BITS: u32 = 4;
/// Values of those of both coordinates.
const CELLS: usize = 1 << (2 * BITS);

/// For each of the four ways a square may be turned and each of its cells, the cell's position along the curve, and
/// above it the turn of the cell.
const TABLE: [u16; 4 * CELLS] = table();

/// The cell's position along the curve.
pub(super) fn curve_position(x: u32, y: u32) -> u32 {
    let part = |value: u32, i: u32| (value >> (BITS * i)) as usize % (1 << BITS);
    let (mut position, mut turn) = (0, 0);
    for i in (0..16 / BITS).rev() {
        let found = usize::from(TABLE[turn * CELLS + (part(x, i) << BITS) + part(y, i)]);
        position = (position << (2 * BITS)) | (found % CELLS) as u32;
        turn = found / CELLS;
    }
    position
}

const fn table() -> [u16; 4 * CELLS] {
    let mut table = [0; 4 * CELLS];
    let mut i = 0;
    while i < table.len() {
        let cell = (i % CELLS) as u32;
        let (position, turn) = by_quadrants(cell >> BITS, cell % (1 << BITS), (i / CELLS) as u32);
        table[i] = position + CELLS as u16 * turn;
        i += 1;
    }
    table
}

/// Quadrant by quadrant from the largest down. Turns are two bits: whether the axes are exchanged, and whether both run
/// backwards.
const fn by_quadrants(x: u32, y: u32, mut turn: u32) -> (u16, u16) {
    let (mut position, mut bit) = (0, BITS);
    while bit > 0 {
        bit -= 1;
        let (x, y) = ((x >> bit) & 1, (y >> bit) & 1);
        let (x, y) = if turn & 1 == 1 { (y, x) } else { (x, y) };
        let (right, top) = (x ^ (turn >> 1), y ^ (turn >> 1));
        position = (position << 2) | ((3 * right) ^ top);
        // The curve of a quadrant starts at its own origin: backwards on the lower right, exchanged unless on top.
        turn ^= ((right & !top & 1) << 1) | (top ^ 1);
    }
    (position as u16, turn as u16)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_on_the_curve_are_neighbours_on_the_grid() {
        // The upper bits alone, and the lower ones alone: every look at the table is at some place the first.
        for shift in [11, 7, 3, 0] {
            let mut at = std::collections::BTreeMap::new();
            for x in 0..32 {
                for y in 0..32 {
                    at.insert(curve_position(x << shift, y << shift) >> (2 * shift), (x, y));
                }
            }
            let cells: Vec<_> = at.values().collect();
            assert_eq!(cells.len(), 1024);
            assert!(cells.windows(2).all(|w| w[0].0.abs_diff(w[1].0) + w[0].1.abs_diff(w[1].1) == 1));
        }
    }

    #[test]
    fn corners_and_a_place_amid_the_curve() {
        let found = [(0, 0), (65535, 65535), (65535, 0), (0, 65535), (12345, 54321)].map(|(x, y)| curve_position(x, y));
        assert_eq!(found, [0, 0xAAAA_AAAA, u32::MAX, 0x5555_5555, 1_555_040_834]);
    }
}
