//! Random places in a ring, many at a time.

use crate::graph::Point;
use crate::rng::Rng;

/// So many are drawn at a time that the processor has several blocks of random words under way.
const DRAWN: usize = 32;

/// Steps to places in the ring from one radius to two, evenly by area.
pub(super) struct Ring {
    pub(super) rng: Rng,
    radius: f64,
    steps: [Point; DRAWN],
    len: usize,
}

impl Ring {
    pub(super) fn new(radius: f64, rng: Rng) -> Self {
        Self { rng, radius, steps: [[0.0; 2]; DRAWN], len: 0 }
    }

    #[inline(always)]
    pub(super) fn step(&mut self) -> Point {
        while self.len == 0 {
            self.draw();
        }
        self.len -= 1;
        self.steps[self.len % DRAWN]
    }

    /// Places in a square: those in its disc are stretched to the ring, those in its corners passed over.
    #[inline(always)]
    fn draw(&mut self) {
        // Never zero.
        let coordinate = |quarter: i16| (f64::from(quarter) + 0.5) / 32_768.0;
        self.len = 0;
        for _ in 0..DRAWN / 2 {
            let word = self.rng.next_u64();
            let quarters = [0, 16, 32, 48].map(|from| coordinate((word >> from) as i16));
            for [x, y] in [[quarters[0], quarters[1]], [quarters[2], quarters[3]]] {
                let square = x * x + y * y;
                let scale = self.radius * (3.0 + 1.0 / square).sqrt();
                // Every one is written, and the next over it if it is to be passed over: whether it is cannot be foretold.
                self.steps[self.len % DRAWN] = [scale * x, scale * y];
                self.len += usize::from(square <= 1.0);
            }
        }
    }
}
