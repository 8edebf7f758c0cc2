//! The cracks of an impact as a drawing, and the room about each.

use super::{OFF, OWN, Star};
use crate::crack::aged::{Aged, by_age};
use crate::crack::fence::Fence;
use crate::crack::net::Net;
use crate::graph::Point;

/// How near the room about an edge comes to its neighbours; where a fork leaves at a narrow angle, this part of it.
const ROOM: f64 = 0.25;
const SHARP: f64 = 0.25;

impl Star {
    pub(super) fn finish(mut self) -> Aged {
        let (mut net, mut fence, mut age) = (Net::default(), Fence::default(), Vec::new());
        let mut lines = Vec::new();
        for i in 0..self.spokes.len() {
            let (angle, to) = (self.spokes[i].angle, self.spokes[i].to);
            let mut at = std::mem::take(&mut self.spokes[i].at);
            at.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            if at.last().is_some_and(|&(far, _)| far < to) {
                let tip = self.add_point(angle, to);
                at.push((to, tip));
            }
            lines.push((at.into_iter().map(|(_, vertex)| vertex).collect::<Vec<i32>>(), self.spokes[i].age));
        }
        lines.extend(self.arcs.iter().map(|(line, age, _)| (line.clone(), *age)));
        let narrowest = self.narrowest();
        let mut is_fork = vec![false; self.points.len()];
        self.forks.iter().for_each(|&(vertex, _)| is_fork[vertex as usize] = true);
        for (line, born) in lines {
            for pair in line.windows(2) {
                net.edges.push([pair[0], pair[1]]);
                age.push(born);
            }
        }
        net.vertices = self.points;
        net.cut = vec![false; net.vertices.len()];
        for &[a, b] in &net.edges {
            let first = (net.vertices.len() + fence.anchors.len()) as i32;
            let ends = [a, b].map(|vertex| net.vertices[vertex as usize]);
            let part = if is_fork[a as usize] || is_fork[b as usize] { SHARP } else { 1.0 };
            fence.anchors.extend(self::room(ends, self.how.source, narrowest, part * ROOM));
            fence.kites.push([a, b, first, first + 1]);
        }
        if let Some(half) = self.half {
            net.period = half.map(|side| 2.0 * side / OWN);
            net.shifts = vec![[0, 0]; net.edges.len()];
            fence.shifts = vec![[0; 6]; net.edges.len()];
        }
        let partner = by_age(&net, &age);
        Aged { net, fence, partner, age }
    }

    /// The least angle between neighbouring spokes.
    fn narrowest(&self) -> f64 {
        let across = self.arcs.iter().map(|(_, _, wide)| *wide);
        across.chain(self.forks.iter().map(|&(_, off)| off)).fold(std::f64::consts::PI, f64::min)
    }
}

/// A place to the left and one to the right of an edge, nearer than any other edge: neighbours leave its ends at about
/// a right angle, other spokes are an angle away, other arcs a part of the distance to the source.
fn room([a, b]: [Point; 2], source: Point, narrowest: f64, part: f64) -> [Point; 2] {
    let (x, y) = (b[0] - a[0], b[1] - a[1]);
    let middle = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
    let far = libm::hypot(middle[0] - source[0], middle[1] - source[1]);
    let most = part * libm::hypot(x, y).min(far * narrowest).min(OFF * far);
    let part = most / libm::hypot(x, y).max(f64::MIN_POSITIVE);
    [[middle[0] - part * y, middle[1] + part * x], [middle[0] + part * y, middle[1] - part * x]]
}
