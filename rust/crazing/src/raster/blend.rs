//! Ink over ground, for every coverage a pixel can have.

use super::tile::SAMPLES;

/// Two colours, straight (not premultiplied) RGBA.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Colors {
    /// Of the edges.
    pub ink: [u8; 4],
    /// Of what is under them; alpha 0 leaves it open.
    pub ground: [u8; 4],
}

/// The colour of a pixel with that many of its samples inked.
pub(super) type Table = [[u8; 4]; SAMPLES as usize + 1];

impl Colors {
    /// Blends once for all pixels.
    pub(super) fn table(&self) -> Table {
        let mut table = [self.ground; SAMPLES as usize + 1];
        for (inked, color) in (0..).zip(&mut table).skip(1) {
            *color = self.over(inked);
        }
        table
    }

    /// Porter and Duff's "over" in exact integers, rounded once a channel.
    fn over(&self, inked: u32) -> [u8; 4] {
        let (ink_alpha, ground_alpha) = (u32::from(self.ink[3]), u32::from(self.ground[3]));
        // Weights in units of 1 / (SAMPLES * 255 * 255).
        let top = inked * ink_alpha * 255;
        let under = (SAMPLES * 255 - inked * ink_alpha) * ground_alpha;
        let both = top + under;
        if both == 0 {
            return self.ground;
        }
        let mix = |channel: usize| {
            let sum = top * u32::from(self.ink[channel]) + under * u32::from(self.ground[channel]);
            ((sum + both / 2) / both) as u8
        };
        let unit = SAMPLES * 255;
        [mix(0), mix(1), mix(2), ((both + unit / 2) / unit) as u8]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_are_the_colours_themselves() {
        let table = Colors { ink: [1, 2, 3, 255], ground: [200, 100, 0, 255] }.table();
        assert_eq!(table[0], [200, 100, 0, 255]);
        assert_eq!(table[SAMPLES as usize], [1, 2, 3, 255]);
        assert_eq!(table[SAMPLES as usize / 2], [101, 51, 2, 255]);
    }

    #[test]
    fn open_ground_keeps_the_ink_and_takes_its_alpha() {
        let table = Colors { ink: [9, 8, 7, 255], ground: [0; 4] }.table();
        assert_eq!(table[SAMPLES as usize / 2], [9, 8, 7, 128]);
        assert_eq!(table[0], [0; 4]);
    }

    #[test]
    fn clear_ink_changes_nothing() {
        let table = Colors { ink: [9, 8, 7, 0], ground: [5, 6, 7, 8] }.table();
        assert!(table.iter().all(|color| *color == [5, 6, 7, 8]));
    }
}
