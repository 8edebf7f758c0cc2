//! New spokes in wedges between others.

use super::{OFF, SAG, STEP, Star, Wedge};

/// The share of those that are forks, and the most radians beside its spoke that one leads on, for each time as far: it
/// leaves at about twice that.
const FORKS: f64 = 0.4;
const FORKED: f64 = 0.22;

impl Star {
    /// A new spoke in a wedge that has become too wide: from the middle of an arc, or forking off one of its spokes.
    pub(super) fn part(&mut self, wedge: &Wedge, far: f64, most: f64) {
        let (is_fork, is_first) = (self.rng.unit() < FORKS, self.rng.unit() < 0.5);
        let (off, straight) = (0.3 + 0.25 * self.rng.unit(), far * (1.6 + 0.8 * self.rng.unit()));
        let off = (off * wedge.wide).min(FORKED * (straight / far - 1.0));
        let [a, b] = wedge.spokes;
        let (spoke, from, part) = if is_fork && straight < most {
            let (old, off) = if is_first { (a, off) } else { (b, -off) };
            let part = if is_first { off / wedge.wide } else { 1.0 + off / wedge.wide };
            (self.fork(old, far, off, straight), straight, part)
        } else {
            let (middle, angle) = self.arc(wedge, far, true);
            (self.add_spoke(angle, middle), far * (1.0 + OFF), 0.5)
        };
        for (spokes, part) in [([a, spoke], part), ([spoke, b], 1.0 - part)] {
            let busy = wedge.busy * (0.6 + 0.8 * self.rng.unit());
            self.wedges.push_back(Wedge { spokes, from, to: wedge.to, wide: part * wedge.wide, busy });
        }
    }

    /// A spoke that leaves another and is `off` radians beside it at a distance, from where it leads away from the source.
    fn fork(&mut self, old: usize, far: f64, off: f64, straight: f64) -> usize {
        let angle = self.spokes[old].angle;
        let root = self.add_point(angle, far);
        self.spokes[old].at.push((far, root));
        self.forks.push((root, off.abs()));
        let spoke = self.add_spoke(angle + off, (far, root));
        let bend = self.add_point(angle + off, straight);
        self.spokes[spoke].at.push((straight, bend));
        self.spokes[spoke].to = self.spokes[spoke].to.max(straight);
        spoke
    }

    /// Breaks up a piece near the source: a short spoke between two arcs, and what lies on both its sides. Whether there
    /// is room for it.
    pub(super) fn chip(&mut self, wedge: &Wedge, far: f64, most: f64) -> bool {
        let end = far * STEP * STEP * (1.0 + 0.8 * self.rng.unit());
        if end * (1.0 + OFF) >= most {
            return false;
        }
        let (start, angle) = self.arc(wedge, far, true);
        let spoke = self.add_spoke(angle, start);
        let (middle, _) = self.arc(wedge, end, true);
        self.spokes[spoke].at.push(middle);
        self.spokes[spoke].to = middle.0;
        self.spokes[spoke].reaches = false;
        let [a, b] = wedge.spokes;
        let (from, to, wide) = (far * (1.0 + OFF), end * (1.0 - OFF - SAG), 0.5 * wedge.wide);
        for spokes in [[a, spoke], [spoke, b]] {
            self.wedges.push_back(Wedge { spokes, from, to, wide, busy: 1.0 });
        }
        self.wedges.push_back(Wedge { from: end * (1.0 + OFF), ..*wedge });
        true
    }
}
