//! The one-step crust: every edge is crust, or its dual is anti-crust.

use crate::diagram::DiagramView;
use crate::diagram::scale::{Scale, largest};
use crate::error::Result;
use crate::graph::Point;
use crate::parallel;
use crate::predicates::{apex_sign, one_step_sign, one_step_value};

/// Whether each edge is crust: some circle through its ends contains neither end of its dual.
///
/// An edge of the hull is crust when the angle opposite it is acute. Signs are exact; a tie is crust, but for the
/// hull, where the circle would have to be a line.
///
/// # Errors
/// [`crate::Error::TooFewSites`] or [`crate::Error::Collinear`].
///
/// # Source
/// Gold, Snoeyink: A One-Step Crust and Skeleton Extraction Algorithm (2001); thesis, section 5.3.
pub fn one_step(view: DiagramView<'_>) -> Result<Vec<bool>> {
    view.check_triangle()?;
    let scale = Scale::of(largest(view.sites));
    let sites = scale.all_down(view.sites);
    let mut mask = vec![false; view.edges.len()];
    parallel::fill(&mut mask, |rows, mask| {
        let mut quads = Quads::new();
        for (i, mask) in mask.chunks_mut(TOGETHER).enumerate() {
            quads.decide(view, &sites, rows.start + i * TOGETHER, mask);
        }
    });
    Ok(mask)
}

/// Edges looked at together: the sites of all of them are waited for at once, and then several signs are found at a
/// time.
const TOGETHER: usize = 128;

/// Both ends of some edges and the two corners opposite, one coordinate a row.
struct Quads([[[f64; TOGETHER]; 2]; 4]);

impl Quads {
    fn new() -> Self {
        Self([[[0.0; TOGETHER]; 2]; 4])
    }

    /// The mask of the edges from `first` on.
    fn decide(&mut self, view: DiagramView<'_>, sites: &[Point], first: usize, mask: &mut [bool]) {
        let rows = first..first + mask.len();
        let mut corners = [[0; 4]; TOGETHER];
        let tables = view.edges[rows.clone()].iter().zip(&view.dual_edges[rows]);
        for (corners, (&ends, dual)) in corners.iter_mut().zip(tables) {
            let [r, s] = dual.map(|triangle| apex(view, ends, triangle));
            *corners = [ends[0], ends[1], r, s];
        }
        // Reads and nothing else: many are then under way at once, and what follows waits for none of them.
        let first_halves =
            corners.iter().flatten().filter_map(|&corner| sites.get(corner as usize)).map(|p| p[0].to_bits());
        std::hint::black_box(first_halves.fold(0, std::ops::BitXor::bitxor));
        let nowhere = [0.0; 2];
        for (i, corners) in corners[..mask.len()].iter().enumerate() {
            for (rows, &corner) in self.0.iter_mut().zip(corners) {
                [rows[0][i], rows[1][i]] = *sites.get(corner as usize).unwrap_or(&nowhere);
            }
        }
        let (mut sure, mut positive) = ([false; TOGETHER], [false; TOGETHER]);
        for i in 0..TOGETHER {
            let [p, q, r, s] = [0, 1, 2, 3].map(|corner| [self.0[corner][0][i], self.0[corner][1][i]]);
            let (value, error) = one_step_value(p, q, r, s);
            sure[i] = value.abs() > error;
            positive[i] = value > 0.0;
        }
        for (i, kept) in mask.iter_mut().enumerate() {
            let dual = view.dual_edges[first + i];
            *kept = if sure[i] & !dual.contains(&-1) { positive[i] } else { is_crust(view, sites, first + i) };
        }
    }
}

/// What is left of a triangle's corners when the two ends are taken out.
#[inline]
fn apex(view: DiagramView<'_>, ends: [i32; 2], triangle: i32) -> i32 {
    let [a, b, c] = view.triangles.get(triangle as usize).copied().unwrap_or_default();
    a ^ b ^ c ^ ends[0] ^ ends[1]
}

#[cold]
fn is_crust(view: DiagramView<'_>, sites: &[Point], k: usize) -> bool {
    let ends = view.edges[k];
    let [p, q] = ends.map(|site| sites[site as usize]);
    // Arrays of others may leave no site at all.
    let apex = |triangle| sites.get(apex(view, ends, triangle) as usize).copied().unwrap_or(p);
    match view.dual_edges[k] {
        [-1, -1] => false,
        [t, -1] | [-1, t] => apex_sign(p, q, apex(t)) > 0.0,
        [right, left] => one_step_sign(p, q, apex(right), apex(left)) >= 0.0,
    }
}

/// The corner that is neither `p` nor `q`.
#[inline]
pub(super) fn opposite(corners: [i32; 3], p: i32, q: i32) -> i32 {
    let other = |c: i32| c != p && c != q;
    if other(corners[0]) {
        corners[0]
    } else if other(corners[1]) {
        corners[1]
    } else {
        corners[2]
    }
}
