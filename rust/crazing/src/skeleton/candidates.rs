//! The edges a curve may be made of: those of the diagram, and on request the other diagonal of two triangles.

use crate::diagram::DiagramView;
use crate::error::Result;
use crate::graph::Point;
use crate::incidence::Incidence;
use crate::parallel;
use crate::predicates::orientation;
use crate::watch::Watch;

/// No edge.
const NONE: u32 = u32::MAX;

/// Edges of the diagram in its order, then those across them.
pub(super) struct Candidates {
    pub(super) edges: Vec<[i32; 2]>,
    /// Rows of `edges` at every site.
    pub(super) about: Incidence,
    /// Which edge of the diagram each later one crosses.
    crossed: Vec<u32>,
    /// For every edge of the diagram the one across it.
    across: Vec<u32>,
    /// The triangles on both sides of every edge of the diagram.
    duals: Vec<[i32; 2]>,
    /// Edges of every triangle.
    sides: Vec<[u32; 3]>,
}

impl Candidates {
    /// The edges of the diagram alone.
    pub(super) fn of_diagram(view: DiagramView<'_>) -> Self {
        let (edges, about) = (view.edges.to_vec(), Incidence::of(view.sites.len(), view.edges));
        Self { edges, about, crossed: Vec::new(), across: Vec::new(), duals: Vec::new(), sides: Vec::new() }
    }

    /// And those across, wherever two triangles make a convex quadrilateral.
    ///
    /// # Errors
    /// [`crate::Error::Interrupted`].
    pub(super) fn with_across(view: DiagramView<'_>, watch: Watch<'_>) -> Result<Self> {
        let (mut edges, mut crossed) = (view.edges.to_vec(), Vec::new());
        let mut across = vec![NONE; edges.len()];
        let over = parallel::map_watched(edges.len(), |k| diagonal(view, view.edges[k], view.dual_edges[k]), watch)?;
        for (k, edge) in over.into_iter().enumerate() {
            if let Some(edge) = edge {
                across[k] = edges.len() as u32;
                crossed.push(k as u32);
                edges.push(edge);
            }
        }
        watch.poll()?;
        let about = Incidence::of(view.sites.len(), &edges);
        watch.poll()?;
        Ok(Self { edges, about, crossed, across, duals: view.dual_edges.to_vec(), sides: sides(view) })
    }

    /// The end of an edge that is not `v`.
    #[inline]
    pub(super) fn other(&self, k: u32, v: usize) -> usize {
        let [a, b] = self.edges[k as usize].map(|end| end as usize);
        if a == v { b } else { a }
    }

    /// Which of all `sites` are within so many edges of many.
    pub(super) fn reached(
        &self,
        sites: usize,
        mut last: Vec<usize>,
        steps: usize,
        watch: Watch<'_>,
    ) -> Result<Vec<bool>> {
        let mut seen = vec![false; sites];
        last.iter().for_each(|&v| seen[v] = true);
        for _ in 0..steps {
            let mut ahead = Vec::new();
            for (step, &v) in last.iter().enumerate() {
                watch.poll_at(step)?;
                ahead.extend(self.beside(v).filter(|&u| !std::mem::replace(&mut seen[u], true)));
            }
            last = ahead;
        }
        Ok(seen)
    }

    /// The sites at the other ends of the edges at one.
    pub(super) fn beside(&self, v: usize) -> impl Iterator<Item = usize> {
        self.about.at(v).iter().map(move |&k| self.other(k, v))
    }

    /// Whether an edge crosses one of those chosen.
    pub(super) fn is_barred(&self, k: u32, chosen: &[bool]) -> bool {
        let is_chosen = |k: u32| k != NONE && chosen[k as usize];
        if self.across.is_empty() {
            return false;
        }
        if let Some(&over) = self.across.get(k as usize) {
            return is_chosen(over);
        }
        // Two that leave one triangle by different sides cross within it.
        let under = self.crossed[k as usize - self.across.len()];
        let beside = |&t: &i32| self.sides[t as usize].iter().any(|&side| is_chosen(self.across[side as usize]));
        is_chosen(under) || self.duals[under as usize].iter().any(beside)
    }
}

/// The edges of every triangle.
fn sides(view: DiagramView<'_>) -> Vec<[u32; 3]> {
    let mut sides = vec![[NONE; 3]; view.triangles.len()];
    for (k, duals) in view.dual_edges.iter().enumerate() {
        for &t in duals.iter().filter(|&&t| t != -1) {
            let side = sides[t as usize].iter_mut().find(|side| **side == NONE);
            side.into_iter().for_each(|side| *side = k as u32);
        }
    }
    sides
}

/// The other diagonal of two triangles that make a convex quadrilateral.
fn diagonal(view: DiagramView<'_>, edge: [i32; 2], duals: [i32; 2]) -> Option<[i32; 2]> {
    let apex = |t: i32| view.triangles.get(t as usize)?.iter().copied().find(|v| !edge.contains(v));
    let apexes = [apex(duals[0])?, apex(duals[1])?];
    let place = |v: i32| -> Point { view.sites[v as usize] };
    let side = |v: i32| orientation(place(apexes[0]), place(apexes[1]), place(v));
    (side(edge[0]) * side(edge[1]) < 0.0).then_some(apexes)
}
