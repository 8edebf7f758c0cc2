//! Connected components by union-find.

use super::check;
use crate::error::Result;
use crate::watch::Watch;

/// The connected components of the vertices that have an edge.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Components {
    /// The component of every vertex, numbered by first appearance in the order of the edges; -1 = no edge.
    pub labels: Vec<i32>,
    /// How many components there are.
    pub count: usize,
}

/// Finds the components. Nearly linear: paths are halved while they are walked.
///
/// # Errors
/// [`Error::BadIndex`](crate::Error::BadIndex) or [`Error::TooMany`](crate::Error::TooMany) for edges that do not
/// fit; [`Error::Interrupted`](crate::Error::Interrupted).
pub fn components(count: usize, edges: &[[i32; 2]], watch: Watch<'_>) -> Result<Components> {
    check(count, edges)?;
    let mut parent: Vec<u32> = (0..count as u32).collect();
    for (k, &[a, b]) in edges.iter().enumerate() {
        watch.poll_at(k)?;
        let (a, b) = (root(&mut parent, a as u32), root(&mut parent, b as u32));
        parent[a.max(b) as usize] = a.min(b);
    }
    number(&mut parent, edges, watch)
}

/// The smallest vertex joined with `vertex` so far.
fn root(parent: &mut [u32], mut vertex: u32) -> u32 {
    while parent[vertex as usize] != vertex {
        let above = parent[parent[vertex as usize] as usize];
        parent[vertex as usize] = above;
        vertex = above;
    }
    vertex
}

fn number(parent: &mut [u32], edges: &[[i32; 2]], watch: Watch<'_>) -> Result<Components> {
    let mut found = Components { labels: vec![-1; parent.len()], count: 0 };
    for (k, &[a, b]) in edges.iter().enumerate() {
        watch.poll_at(k)?;
        let top = root(parent, a as u32) as usize;
        if found.labels[top] < 0 {
            found.labels[top] = found.count as i32;
            found.count += 1;
        }
        let label = found.labels[top];
        [a, b].into_iter().for_each(|vertex| found.labels[vertex as usize] = label);
    }
    Ok(found)
}
