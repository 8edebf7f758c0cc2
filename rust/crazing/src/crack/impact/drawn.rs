//! The cracks of an impact as a drawing, and the room about each.

use super::Star;
use super::room::rooms;
use crate::crack::aged::{Aged, by_age};
use crate::crack::fence::Fence;
use crate::crack::net::Net;
use crate::graph::Point;

/// How far from the source a vertex is, which one it is, and in which copy of the period.
type Along = (f64, i32, [i8; 2]);

impl Star {
    pub(super) fn finish(mut self) -> Aged {
        let mut net = Net { period: self.period.unwrap_or_default(), ..Net::default() };
        let old = self.points.len() as i32;
        if let Some(period) = self.period {
            self.grow_on(period);
        }
        let (mut age, mut new) = (Vec::new(), Vec::new());
        let is_new = |vertex: i32| vertex >= old;
        let mut lines = Vec::new();
        for i in 0..self.spokes.len() {
            let (angle, to) = (self.spokes[i].angle, self.spokes[i].to);
            let [mut at, mut beyond] = [
                self.spokes[i].at.iter().map(|&(far, vertex)| (far, vertex, [0; 2])).collect(),
                std::mem::take(&mut self.spokes[i].beyond),
            ];
            at.sort_by(by_distance);
            beyond.sort_by(by_distance);
            if beyond.is_empty() && at.last().is_some_and(|&(far, ..)| far < to) {
                let tip = self.add_point(angle, to);
                at.push((to, tip, [0; 2]));
            }
            at.append(&mut beyond);
            let line: Vec<(i32, [i8; 2])> = at.into_iter().map(|(_, vertex, copy)| (vertex, copy)).collect();
            lines.push((line, self.spokes[i].age));
        }
        lines.extend(
            self.arcs.iter().map(|(line, age, _)| (line.iter().map(|&vertex| (vertex, [0; 2])).collect(), *age)),
        );
        let narrowest = self.narrowest();
        let mut is_fork = vec![false; self.points.len()];
        self.forks.iter().for_each(|&(vertex, _)| is_fork[vertex as usize] = true);
        for (line, born) in lines {
            for pair in line.windows(2) {
                if self.period.is_some() && pair.iter().any(|&(vertex, _)| is_new(vertex)) {
                    new.push(net.edges.len());
                }
                net.edges.push([pair[0].0, pair[1].0]);
                net.shifts.push([0, 1].map(|axis| pair[1].1[axis] - pair[0].1[axis]));
                age.push(born);
            }
        }
        net.vertices = self.points;
        net.cut = vec![false; net.vertices.len()];
        if self.period.is_none() {
            net.shifts.clear();
        }
        let fence = fence(&net, rooms(net.view(), self.how.source, narrowest, &is_fork, &new));
        let partner = by_age(&net, &age);
        Aged { net, fence, partner, age }
    }

    /// The least angle between neighbouring spokes.
    fn narrowest(&self) -> f64 {
        let across = self.arcs.iter().map(|(_, _, wide)| *wide);
        across.chain(self.forks.iter().map(|&(_, off)| off)).fold(std::f64::consts::PI, f64::min)
    }
}

/// From the source outward.
fn by_distance(a: &Along, b: &Along) -> std::cmp::Ordering {
    a.0.total_cmp(&b.0).then(a.1.cmp(&b.1))
}

/// Two triangles about each edge, with these places beside it.
fn fence(net: &Net, rooms: Vec<[Point; 2]>) -> Fence {
    let first = net.vertices.len() as i32;
    let kite = |(k, &[a, b]): (usize, &[i32; 2])| [a, b, first + 2 * k as i32, first + 2 * k as i32 + 1];
    Fence {
        kites: net.edges.iter().enumerate().map(kite).collect(),
        shifts: net.shifts.iter().map(|&[x, y]| [x, y, 0, 0, 0, 0]).collect(),
        anchors: rooms.into_flattened(),
    }
}
