//! Voronoi vertices beyond all sites, to be searched for what a disc out there holds.
//!
//! Cells that reach out there are open wedges, and a large disc meets very many of them: of a million sites on a flower
//! twenty thousand, for one circle. All that can be in it is a vertex beyond the sites, and of these there are few.

use super::boxes::{Box, Boxes, around_points};
use super::circle::Circle;
use super::flood::Cells;
use crate::graph::Point;
use crate::parallel;

/// The box about the sites, and the vertices that are not in it.
pub(super) struct Outer {
    frame: Box,
    /// Beyond each side of the frame. Triangles follow a curve through the sites: their vertices on one side of all
    /// sites follow one as well, those on both sides would make boxes that reach across.
    sides: [Boxes; 4],
}

impl Outer {
    pub(super) fn of(cells: &Cells<'_>) -> Self {
        let frame = around_points(&cells.sites);
        let side = |v: Point| {
            let beyond = [v[0] < frame[0], v[1] < frame[1], v[0] > frame[2], v[1] > frame[3]];
            beyond.into_iter().position(|is_beyond| is_beyond)
        };
        let vertices: &[Point] = &cells.vertices;
        let all = parallel::compact(vertices.len(), |t| Some(vertices[t]).filter(|&v| side(v).is_some()));
        let sides = std::array::from_fn(|i| Boxes::new(all.iter().copied().filter(|&v| side(v) == Some(i)).collect()));
        Self { frame, sides }
    }

    /// The first of these vertices found that is inside a circle.
    pub(super) fn find(&self, circle: &Circle<'_>) -> Option<Point> {
        self.sides.iter().find_map(|boxes| boxes.find(circle))
    }

    /// Whether a circle holds no site, nor any other vertex than these.
    pub(super) fn is_all_in(&self, circle: &Circle<'_>) -> bool {
        !circle.meets(&self.frame)
    }
}

#[cfg(test)]
mod tests {
    use super::super::links::links;
    use super::Outer;
    use crate::Watch;
    use crate::diagram::diagram;
    use crate::graph::Point;
    use crate::skeleton::circle::Circle;
    use crate::skeleton::flood::Cells;
    use crate::skeleton::pencil::Pencil;

    #[test]
    fn finds_what_a_look_at_every_vertex_finds() {
        let at = |i: u32| f64::from(i.wrapping_mul(2_654_435_769)) / f64::from(u32::MAX);
        let points: Vec<Point> = (1..400).map(|i| [at(i), at(i + 7919)]).collect();
        let d = diagram(&points, Watch::default()).unwrap_or_default();
        let links = links(d.view());
        let cells = Cells::of(d.view(), &links);
        let outer = Outer::of(&cells);
        let bound = |axis: usize, least| {
            d.sites.iter().map(|p| p[axis]).fold(least, if least > 0.0 { f64::min } else { f64::max })
        };
        let frame = [0, 1].map(|axis| bound(axis, f64::INFINITY)..=bound(axis, f64::NEG_INFINITY));
        let beyond = |v: &Point| (0..2).any(|axis| !frame[axis].contains(&v[axis]));
        let (mut found, mut alone) = (0, 0);
        for i in 0..2000 {
            let (centre, radius) = ([at(i) * 6.0 - 2.5, at(i + 11) * 6.0 - 2.5], 2.0 * at(i + 5) * at(i + 6));
            let pencil = Pencil::new([centre[0] - radius, centre[1]], [centre[0] + radius, centre[1]]);
            let circle = Circle::of(&pencil, 0.0);
            let is_wanted = |v: Point| circle.holds(v);
            let held: Vec<Point> = d.vertices.iter().copied().filter(|&v| is_wanted(v)).collect();
            let first = outer.find(&circle);
            assert!(first.is_none_or(|v| held.contains(&v)));
            assert_eq!(first.is_some(), held.iter().any(beyond));
            if outer.is_all_in(&circle) {
                assert_eq!(first.is_some(), !held.is_empty());
                assert!(!d.sites.iter().any(|&p| is_wanted(p)));
                alone += 1;
            }
            found += usize::from(first.is_some());
        }
        assert!(found > 100 && alone > 100, "{found} {alone}");
    }
}
