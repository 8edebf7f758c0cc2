//! Laws of drawings, on random edges with loops, duplicates and lonely vertices.

use std::collections::BTreeMap;

use crazing::graph::{Polylines, compact, components, degrees, polylines};
use crazing::{Error, Watch};
use proptest::prelude::*;

type Edges = Vec<[i32; 2]>;

/// Few vertices make loops, duplicates and rings frequent; many make chains.
fn drawing() -> impl Strategy<Value = (usize, Edges)> {
    (1_usize..40).prop_flat_map(|count| {
        let vertex = 0..count as i32;
        (Just(count), prop::collection::vec([vertex.clone(), vertex], 0..50))
    })
}

fn line_of(lines: &Polylines, i: usize) -> &[i32] {
    &lines.rows[lines.offsets[i] as usize..lines.offsets[i + 1] as usize]
}

fn counted(edges: impl IntoIterator<Item = [i32; 2]>) -> BTreeMap<[i32; 2], usize> {
    edges.into_iter().fold(BTreeMap::new(), |mut counts, [a, b]| {
        *counts.entry([a.min(b), a.max(b)]).or_default() += 1;
        counts
    })
}

/// Labels by repeated sweeps: slow and plain.
fn swept(count: usize, edges: &Edges) -> Vec<usize> {
    let mut label: Vec<usize> = (0..count).collect();
    for _ in 0..count {
        for &[a, b] in edges {
            let least = label[a as usize].min(label[b as usize]);
            label[a as usize] = least;
            label[b as usize] = least;
        }
    }
    label
}

proptest! {
    #[test]
    fn every_edge_has_two_ends((count, edges) in drawing()) {
        let degrees = degrees(count, &edges, Watch::default())?;
        prop_assert_eq!(degrees.iter().sum::<i32>() as usize, 2 * edges.len());
    }

    #[test]
    fn lines_hold_every_edge_once((count, edges) in drawing()) {
        let lines = polylines(count, &edges, Watch::default())?;
        let steps = (0..lines.offsets.len() - 1)
            .flat_map(|i| line_of(&lines, i).windows(2).map(|pair| [pair[0], pair[1]]));
        prop_assert_eq!(counted(steps), counted(edges.iter().copied()));
    }

    #[test]
    fn lines_end_only_at_junctions_or_close((count, edges) in drawing()) {
        let lines = polylines(count, &edges, Watch::default())?;
        let degrees = degrees(count, &edges, Watch::default())?;
        let through = |&vertex: &i32| degrees[vertex as usize] == 2;
        let mut rings = false;
        for line in (0..lines.offsets.len() - 1).map(|i| line_of(&lines, i)) {
            let ring = through(&line[0]);
            prop_assert!(line.len() >= 2);
            prop_assert!(line[1..line.len() - 1].iter().all(through));
            prop_assert!(!ring || line.first() == line.last());
            prop_assert!(ring || !through(&line[line.len() - 1]));
            prop_assert!(ring || !rings, "a chain after a ring");
            rings = ring;
        }
    }

    #[test]
    fn labels_are_the_components((count, edges) in drawing()) {
        let found = components(count, &edges, Watch::default())?;
        let plain = swept(count, &edges);
        for &[a, _] in &edges {
            for &[b, _] in &edges {
                let (a, b) = (a as usize, b as usize);
                prop_assert_eq!(found.labels[a] == found.labels[b], plain[a] == plain[b]);
            }
        }
        let mut seen = 0;
        for &[a, b] in &edges {
            prop_assert_eq!(found.labels[a as usize], found.labels[b as usize]);
            prop_assert!(found.labels[a as usize] <= seen);
            seen = seen.max(found.labels[a as usize] + 1);
        }
        prop_assert_eq!(found.count, seen as usize);
        let degrees = degrees(count, &edges, Watch::default())?;
        prop_assert!(degrees.iter().zip(&found.labels).all(|(&degree, &label)| (degree == 0) == (label < 0)));
    }

    #[test]
    fn compact_drops_only_lonely_vertices((count, edges) in drawing()) {
        let vertices: Vec<_> = (0..count).map(|i| [i as f64, -(i as f64)]).collect();
        let small = compact(&vertices, &edges, Watch::default())?;
        let drawn = small.edges.iter().map(|edge| edge.map(|row| small.vertices[row as usize]));
        prop_assert!(drawn.eq(edges.iter().map(|edge| edge.map(|row| vertices[row as usize]))));
        prop_assert!(!degrees(small.vertices.len(), &small.edges, Watch::default())?.contains(&0));
        prop_assert!(small.vertices.is_sorted_by(|a, b| a[0] < b[0]));
    }
}

#[test]
fn rings_loops_and_duplicates_are_closed_lines() -> Result<(), Error> {
    let edges = [[0, 1], [1, 2], [2, 0], [3, 3], [4, 5], [5, 4], [6, 7]];
    let lines = polylines(8, &edges, Watch::default())?;
    assert_eq!(lines.rows, [6, 7, 0, 1, 2, 0, 3, 3, 4, 5, 4]);
    assert_eq!(lines.offsets, [0, 2, 6, 8, 11]);
    Ok(())
}

#[test]
fn an_edge_to_nowhere_is_named() {
    let bad = Error::BadIndex { array: "edges", row: 1, value: 3, low: 0, limit: 3 };
    assert_eq!(degrees(3, &[[0, 1], [2, 3]], Watch::default()), Err(bad.clone()));
    assert_eq!(polylines(3, &[[0, 1], [2, 3]], Watch::default()), Err(bad.clone()));
    assert_eq!(components(3, &[[0, 1], [2, 3]], Watch::default()), Err(bad));
}

#[test]
fn work_stops_when_asked() {
    let stop = Watch::new(&|| false);
    assert_eq!(polylines(2, &[[0, 1]], stop), Err(Error::Interrupted));
    assert_eq!(components(2, &[[0, 1]], stop), Err(Error::Interrupted));
    assert_eq!(compact(&[[0.0; 2]; 2], &[[0, 1]], stop), Err(Error::Interrupted));
}
