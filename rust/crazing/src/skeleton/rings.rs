//! What the rings of a crust say of the axis: which side it is on, and how much of the ring each part of it spans.

use crate::diagram::scale::{Scale, largest};
use crate::diagram::{DiagramView, depths};
use crate::error::{Error, Result};
use crate::graph::{Polylines, polylines};
use crate::watch::Watch;

/// The lines of the masked edges, closed ones last, their first site repeated.
fn lines(view: DiagramView<'_>, mask: &[bool], watch: Watch<'_>) -> Result<Polylines> {
    let kept: Vec<[i32; 2]> = view.edges.iter().zip(mask).filter(|(_, kept)| **kept).map(|(&ends, _)| ends).collect();
    polylines(view.sites.len(), &kept, watch)
}

/// The sites along every line.
fn each(lines: &Polylines) -> impl Iterator<Item = &[i32]> {
    lines.offsets.windows(2).map(|ends| &lines.rows[ends[0] as usize..ends[1] as usize])
}

fn is_ring(line: &[i32]) -> bool {
    line.len() > 3 && line.first() == line.last()
}

/// Whether each dual edge lies inside the closed rings of the masked edges: both its ends are in triangles that an
/// odd number of rings parts from infinity, and no ring passes between them. Open lines do not count.
///
/// # Errors
/// [`Error::BadLength`], [`Error::Interrupted`].
pub fn inside(view: DiagramView<'_>, mask: &[bool], watch: Watch<'_>) -> Result<Vec<bool>> {
    check(view, mask)?;
    let wall = walls(view, mask, watch)?;
    let depth = depths(view, &wall, watch)?;
    let is_inner = |t: i32| t != -1 && depth[t as usize] % 2 == 1;
    Ok(view.dual_edges.iter().zip(&wall).map(|(dual, wall)| !wall && dual.iter().all(|&t| is_inner(t))).collect())
}

fn check(view: DiagramView<'_>, mask: &[bool]) -> Result<()> {
    let (found, wanted) = (mask.len(), view.edges.len());
    if found == wanted { Ok(()) } else { Err(Error::BadLength { array: "mask", found, wanted }) }
}

/// The masked edges that are part of a ring.
fn walls(view: DiagramView<'_>, mask: &[bool], watch: Watch<'_>) -> Result<Vec<bool>> {
    let lines = lines(view, mask, watch)?;
    let mut ringed = vec![false; view.sites.len()];
    for &site in each(&lines).filter(|line| is_ring(line)).flatten() {
        ringed[site as usize] = true;
    }
    let both = |ends: &[i32; 2]| ends.iter().all(|&site| ringed[site as usize]);
    Ok(view.edges.iter().zip(mask).map(|(ends, &kept)| kept && both(ends)).collect())
}

/// Arc residual of every dual edge: the shorter way along the line of the masked edges between its two sites, as a
/// part of the length of that line; infinite between two lines.
///
/// On a closed ring it never decreases from a tip of the axis towards its middle.
///
/// # Errors
/// [`Error::BadLength`], [`Error::Interrupted`].
///
/// # Source
/// Ogniewicz, Kübler: Hierarchic Voronoi Skeletons (1995).
pub fn residuals(view: DiagramView<'_>, mask: &[bool], watch: Watch<'_>) -> Result<Vec<f64>> {
    check(view, mask)?;
    let scale = Scale::of(largest(view.sites));
    let place = |site: i32| scale.down(view.sites[site as usize]);
    // The line of every site, and how far along it stands as a part of the whole.
    let mut stands = vec![(-1, 0.0, false); view.sites.len()];
    for (number, line) in each(&lines(view, mask, watch)?).enumerate() {
        let mut along = vec![0.0; line.len()];
        for (i, pair) in line.windows(2).enumerate() {
            watch.poll_at(i)?;
            along[i + 1] = along[i] + super::cost::distance(place(pair[0]), place(pair[1]));
        }
        let length = along[line.len() - 1];
        for (&site, &at) in line.iter().zip(&along).rev() {
            stands[site as usize] = (number as i32, at / length, is_ring(line));
        }
    }
    let residual = |&[p, q]: &[i32; 2]| {
        let ((line, from, ring), (other, to, _)) = (stands[p as usize], stands[q as usize]);
        let way = (to - from).abs();
        if line != other || line == -1 {
            f64::INFINITY
        } else if ring {
            way.min(1.0 - way)
        } else {
            way
        }
    };
    Ok(view.edges.iter().map(residual).collect())
}
