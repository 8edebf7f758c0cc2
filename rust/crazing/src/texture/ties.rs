//! Which of several edges that are equally near stands for all: to the last bit rounding would choose, and in every pixel
//! anew.

use super::Pattern;

/// For every edge the one that stands for it beside it, beyond its first end and beyond its second.
#[derive(Debug)]
pub(super) struct Ties(Vec<[u32; 3]>);

/// What is known of a vertex after some edges.
#[derive(Clone, Copy)]
struct Vertex {
    /// The first of the widest edges there, and how wide it is.
    widest: u32,
    width: f64,
    /// The half-edge that was the last to begin or end there.
    last: u32,
}

/// Edges at a vertex that are looked at; no drawing has so many, but any number can be given.
const MANY: usize = 64;

/// No half-edge.
const NONE: u32 = u32::MAX;

impl Ties {
    /// Of edges that are the same it is the first; beyond an end where several meet, the first of the widest there: the
    /// disc of that is nearest, and shared by all of these.
    pub(super) fn of(pattern: &Pattern<'_>) -> Self {
        let mut vertices = vec![Vertex { widest: 0, width: -1.0, last: NONE }; pattern.vertices.len()];
        // The half-edge at the same vertex before.
        let mut before = vec![NONE; 2 * pattern.edges.len()];
        let mut ties = Vec::with_capacity(pattern.edges.len());
        for (row, edge) in (0..).zip(pattern.edges) {
            ties.push([first(pattern, row, vertices[edge[0] as usize].last, &before), 0, 0]);
            for (end, &vertex) in edge.iter().enumerate() {
                let (half, width) = (2 * row + end as u32, pattern.widths[row as usize][end]);
                let vertex = &mut vertices[vertex as usize];
                before[half as usize] = std::mem::replace(&mut vertex.last, half);
                if width > vertex.width {
                    (vertex.widest, vertex.width) = (row, width);
                }
            }
        }
        for (tie, edge) in ties.iter_mut().zip(pattern.edges) {
            [tie[1], tie[2]] = edge.map(|vertex| vertices[vertex as usize].widest);
        }
        Self(ties)
    }

    /// The edges that stand for one.
    pub(super) fn edges(&self, edge: u32) -> [u32; 3] {
        self.0[edge as usize]
    }
}

/// The first edge that is the same as one, of those that share its first vertex: `half` is the last before.
fn first(pattern: &Pattern<'_>, row: u32, half: u32, before: &[u32]) -> u32 {
    let others = std::iter::successors(Some(half), |&half| before.get(half as usize).copied());
    let same = others.take(MANY).take_while(|&half| half != NONE).map(|half| half / 2);
    same.filter(|&other| are_same(pattern, row as usize, other as usize)).last().unwrap_or(row)
}

/// Whether two edges are the same, forwards or backwards.
fn are_same(pattern: &Pattern<'_>, row: usize, other: usize) -> bool {
    let shift = |row: usize| pattern.shifts.get(row).copied().unwrap_or_default();
    let [a, b] = pattern.edges[other];
    if ![[a, b], [b, a]].contains(&pattern.edges[row]) {
        return false;
    }
    let ([x, y], [v, w]) = (shift(other), pattern.widths[other]);
    let own = (pattern.edges[row], shift(row), pattern.widths[row]);
    own == ([a, b], [x, y], [v, w]) || own == ([b, a], [x, y].map(i8::wrapping_neg), [w, v])
}
