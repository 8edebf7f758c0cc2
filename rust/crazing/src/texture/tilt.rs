//! Where a pixel lies on its plate, about the middle of which that is tilted.

use super::cut;
use super::fans::Fans;
use super::finish::Row;
use super::grid::{PART, UNIT, both};
use super::line::Line;
use super::near::{RIGHT, behind};
use super::piece::Piece;
use super::scene::Scene;

impl Scene<'_> {
    /// Where a pixel lies from the middle of its plate, data units, y up.
    pub(super) fn on_own_plate(&self, row: &Row<'_>, x: usize) -> [f32; 2] {
        let Some(piece) = row.piece(x) else { return [0.0; 2] };
        let (beside, place) = self.beside(row, x, piece);
        if beside == self.number(row, x) {
            return place;
        }
        // A wide crack may be nearer than a narrow one in front of it, behind which another plate lies.
        let known = self.scan.as_ref().zip(self.fans.as_ref()).zip(row.plates);
        let line = known.and_then(|((scan, fans), plates)| self.owner(fans, *scan.line(plates[x])?, plates[x] % 2));
        let Some((line, side)) = line else { return place };
        let pixel = [row.corner[0] + x as i64, row.corner[1]];
        let [dx, dy] = both(|axis| (pixel[axis] * UNIT + UNIT / 2 - line.start[axis]) as f32 * PART);
        self.on_plate(line.edge as usize, side, [dx, -dy]).1
    }

    /// The first edge beside the plate on a side of a line, and on which of its sides; on a torus in its image beside that
    /// very plate. Seen from there places do not depend on the window.
    fn owner(&self, fans: &Fans, line: Line, side: u32) -> Option<(Line, usize)> {
        let plate = self.sides.plate(line.edge as usize, side as usize);
        let half = *fans.owners.get(plate as usize)? as usize;
        let own = cut::line(&self.pattern, &self.grid, half / 2).ok()?;
        let middle = |line: &Line, side: usize| {
            let [x, y] = self.sides.middle(line.edge as usize, side).map(|part| part * self.grid.scale);
            both(|axis| line.start[axis] as f64 / UNIT as f64 + [x, -y][axis])
        };
        let (there, here) = (middle(&line, side as usize), middle(&own, half % 2));
        let by = both(|axis| match self.grid.period[axis] {
            0 => 0,
            period => ((there[axis] - here[axis]) / period as f64).round() as i64 * period * UNIT,
        });
        Some((own.moved(by), half % 2))
    }

    /// The plate on the side of the nearest edge where a pixel lies, and from its middle to the pixel.
    fn beside(&self, row: &Row<'_>, x: usize, piece: &Piece) -> (i32, [f32; 2]) {
        let [dx, dy] = row.offset(x, piece);
        let (edge, end) = (piece.edge as usize, behind(row.code[x], piece));
        if let (Some(fans), Some(end)) = (&self.fans, end) {
            let along = if end == 0 { 0.0 } else { piece.length };
            let place = [f64::from(dx - along * piece.along[0]), f64::from(along * piece.along[1] - dy)];
            if let Some((half, from_first)) = fans.beyond(self.pattern.edges[edge][end], place) {
                let from_first = [from_first[0] as f32, from_first[1] as f32];
                return self.on_plate(half as usize / 2, half as usize % 2, from_first);
            }
        }
        let from_first = [dx + piece.before * piece.along[0], -dy - piece.before * piece.along[1]];
        self.on_plate(edge, (row.code[x] & RIGHT) as usize, from_first)
    }

    /// The plate on a side of an edge, and from its middle to a place known from the edge's first end, in pixels.
    fn on_plate(&self, edge: usize, side: usize, from_first: [f32; 2]) -> (i32, [f32; 2]) {
        let middle = self.sides.middle(edge, side);
        let place = [from_first[0] * self.data - middle[0] as f32, from_first[1] * self.data - middle[1] as f32];
        (self.sides.plate(edge, side), place)
    }
}
