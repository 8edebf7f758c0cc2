//! A tree of bounding boxes over points: is some point of a disc of a given kind?

use super::circle::Circle;
use super::disc::Disc;
use crate::graph::Point;

/// Points a leaf and boxes a box.
const FAN: usize = 16;

/// xmin, ymin, xmax, ymax.
pub(super) type Box = [f64; 4];

/// Whether a disc and a box have a point in common.
pub(super) fn meets(disc: Disc, b: &Box) -> bool {
    let [x, y] = disc.centre;
    let (dx, dy) = ((b[0] - x).max(x - b[2]).max(0.0), (b[1] - y).max(y - b[3]).max(0.0));
    dx * dx + dy * dy <= disc.square_radius
}

/// Points in an order in which neighbours are mostly near each other, boxed sixteen by sixteen, level by level.
#[derive(Debug, Default)]
pub(super) struct Boxes {
    points: Vec<Point>,
    /// From the leaves up; the last has one box.
    levels: Vec<Vec<Box>>,
}

impl Boxes {
    pub(super) fn new(points: Vec<Point>) -> Self {
        let mut levels = Vec::new();
        if !points.is_empty() {
            levels.push(points.chunks(FAN).map(around_points).collect::<Vec<Box>>());
        }
        while let Some(top) = levels.last().filter(|top| top.len() > 1) {
            levels.push(top.chunks(FAN).map(around_boxes).collect());
        }
        Self { points, levels }
    }

    /// The first point found that is inside a circle.
    pub(super) fn find(&self, circle: &Circle<'_>) -> Option<Point> {
        let mut todo = Vec::with_capacity(64);
        if let Some(top) = self.levels.len().checked_sub(1) {
            todo.push((top, 0));
        }
        while let Some((level, index)) = todo.pop() {
            if !circle.meets(&self.levels[level][index]) {
                continue;
            }
            let children = FAN * index..FAN * (index + 1);
            if level > 0 {
                todo.extend(children.take_while(|&child| child < self.levels[level - 1].len()).map(|c| (level - 1, c)));
            } else {
                let leaf = &self.points[children.start..children.end.min(self.points.len())];
                if let Some(&found) = leaf.iter().find(|&&point| circle.holds_one_of(point)) {
                    return Some(found);
                }
            }
        }
        None
    }
}

pub(super) fn around_points(points: &[Point]) -> Box {
    points.iter().fold([f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY], |b, p| {
        [b[0].min(p[0]), b[1].min(p[1]), b[2].max(p[0]), b[3].max(p[1])]
    })
}

fn around_boxes(boxes: &[Box]) -> Box {
    boxes.iter().fold([f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY], |b, c| {
        [b[0].min(c[0]), b[1].min(c[1]), b[2].max(c[2]), b[3].max(c[3])]
    })
}
