//! An axis from which tips are cut.

use std::cell::OnceCell;

use crate::diagram::{DiagramView, representatives};
use crate::incidence::Incidence;
use crate::parallel;

/// The drawn edges of an axis, by representatives of coincident vertices. What is not drawn, for it is not kept,
/// infinite or without length, has no ends, and is no tip.
pub(super) struct Tree {
    pub(super) duals: Vec<[i32; 2]>,
    /// How many kept edges every vertex has, and their numbers by exclusive or: of the last one, its number.
    degrees: Vec<u32>,
    last: Vec<u32>,
    pub(super) kept: Vec<bool>,
    /// All drawn edges at every vertex, once they are asked for.
    about: OnceCell<Incidence>,
}

impl Tree {
    pub(super) fn of(view: DiagramView<'_>, axis: &[bool]) -> Self {
        let representative = representatives(view);
        let duals = parallel::map(view.dual_edges.len().min(axis.len()), |k| {
            let ends = view.dual_edges[k].map(|t| if t == -1 { -1 } else { representative[t as usize] });
            if axis[k] && !ends.contains(&-1) && ends[0] != ends[1] { ends } else { [-1; 2] }
        });
        let (mut degrees, mut last) = (vec![0; view.vertices.len()], vec![0; view.vertices.len()]);
        for (k, ends) in (0..).zip(&duals).filter(|(_, ends)| ends[0] != -1) {
            for &v in ends {
                degrees[v as usize] += 1;
                last[v as usize] ^= k;
            }
        }
        Self { duals, degrees, last, kept: axis.to_vec(), about: OnceCell::new() }
    }

    pub(super) fn vertices(&self) -> usize {
        self.degrees.len()
    }

    pub(super) fn is_drawn(&self, k: usize) -> bool {
        self.duals[k][0] != -1
    }

    pub(super) fn is_tip(&self, v: i32) -> bool {
        v != -1 && self.degrees[v as usize] == 1
    }

    pub(super) fn tips(&self) -> impl Iterator<Item = u32> {
        (0..self.duals.len() as u32).filter(|&k| self.hangs(k))
    }

    /// All vertices that are tips.
    pub(super) fn tip_vertices(&self) -> impl Iterator<Item = i32> {
        (0..).zip(&self.degrees).filter(|(_, degree)| **degree == 1).map(|(v, _)| v)
    }

    /// Whether an end of an edge is a tip.
    pub(super) fn hangs(&self, k: u32) -> bool {
        self.duals[k as usize].iter().any(|&v| self.is_tip(v))
    }

    /// The end of a tip's edge that hangs on the rest.
    pub(super) fn inner(&self, k: u32) -> usize {
        let [a, b] = self.duals[k as usize];
        if self.is_tip(a) { b as usize } else { a as usize }
    }

    pub(super) fn cut(&mut self, k: u32) {
        self.kept[k as usize] = false;
        for v in self.duals[k as usize].map(|v| v as usize) {
            self.degrees[v] -= 1;
            self.last[v] ^= k;
        }
    }

    /// The last edge at a vertex, if there is only one left.
    pub(super) fn next_tip(&self, v: usize) -> Option<u32> {
        (self.degrees[v] == 1).then_some(self.last[v])
    }

    /// Takes an edge in again.
    pub(super) fn join(&mut self, k: u32) {
        self.kept[k as usize] = true;
        for v in self.duals[k as usize].map(|v| v as usize) {
            self.degrees[v] += 1;
            self.last[v] ^= k;
        }
    }

    /// The edges at a vertex that are left out and lead to a vertex of which all are.
    pub(super) fn left_out(&self, v: i32) -> impl Iterator<Item = u32> {
        let about = self.about.get_or_init(|| Incidence::of(self.degrees.len(), &self.duals));
        about.at(v as usize).iter().copied().filter(move |&k| self.leads_out(k, v))
    }

    /// Whether an edge at a vertex is left out and leads to a vertex of which all are.
    pub(super) fn leads_out(&self, k: u32, v: i32) -> bool {
        !self.kept[k as usize] && self.duals[k as usize].iter().all(|&u| u == v || self.degrees[u as usize] == 0)
    }
}
