//! Laws of mazes and of the cracks along their walls.
#![allow(clippy::unwrap_used, missing_docs)]

mod families;

use crazing::clip::dual_edges;
use crazing::crack::{Net, Profile, pairs, strands, widths, within};
use crazing::diagram::diagram;
use crazing::maze::{Doors, Maze, Tree, carve, distances, longest, solve, voronoi_doors};
use crazing::sets::DisjointSets;
use crazing::{Diagram, Point, Watch};
use families::{any_points, family, lattice};
use proptest::prelude::*;

fn of(points: &[Point]) -> Diagram {
    diagram(points, Watch::default()).unwrap()
}

fn tree_of(d: &Diagram, tree: Tree, start: Option<usize>, opening: f64, seed: u64) -> Maze {
    let door = voronoi_doors(d.view(), None);
    let doors = Doors { cells: d.sites.len(), sides: &d.edges, door: &door };
    carve(doors, tree, start, opening, [seed, 0], Watch::default()).unwrap()
}

fn maze_of(d: &Diagram, opening: f64, seed: u64) -> Maze {
    tree_of(d, Tree::DepthFirst, None, opening, seed)
}

/// First and last step of the search at each cell: an ancestor's interval holds its descendants'.
fn intervals(m: &Maze, cells: usize) -> Vec<(usize, usize)> {
    let mut parent = vec![-1; cells];
    let mut found = vec![(0, 0); cells];
    for (step, &[from, to]) in m.passages.iter().enumerate() {
        parent[to as usize] = from;
        found[to as usize] = (step + 1, step + 1);
    }
    for (step, &[_, to]) in m.passages.iter().enumerate() {
        let mut at = to;
        while at != -1 {
            found[at as usize].1 = found[at as usize].1.max(step + 1);
            at = parent[at as usize];
        }
    }
    found
}

#[test]
fn a_star_of_cells_and_a_million_deep_path_need_no_recursion() {
    let path = of(&family("line", 200_000, 0));
    let m = maze_of(&path, 1.0, 1);
    assert_eq!(m.passages.len(), 199_999);
    assert!(m.open.iter().all(|&open| open));
}

#[test]
fn choice_among_neighbours_is_uniform() {
    // The centre of a hexagon: which of six neighbours comes first, over many seeds.
    let mut points = family("circle", 6, 0);
    points.push([0.0, 0.0]);
    let d = of(&points);
    let mut first = [0_u32; 6];
    for seed in 0..6000 {
        let m = tree_of(&d, Tree::DepthFirst, Some(6), 1.0, seed);
        first[m.passages[0][1] as usize] += 1;
    }
    let chi2: f64 = first.iter().map(|&c| (f64::from(c) - 1000.0).powi(2) / 1000.0).sum();
    assert!(chi2 < 25.0, "{first:?}"); // 1 in 7000 with 5 degrees of freedom
}

#[test]
fn wilsons_trees_are_uniform() {
    // Two squares side by side: the 15 spanning trees of the 2 x 3 grid (its Laplacian's cofactor).
    let sides = [[0, 1], [1, 2], [3, 4], [4, 5], [0, 3], [1, 4], [2, 5]];
    let mut counts = std::collections::BTreeMap::new();
    let doors = Doors { cells: 6, sides: &sides, door: &[true; 7] };
    for seed in 0..15_000 {
        let m = carve(doors, Tree::Wilson, None, 1.0, [seed, 5], Watch::default()).unwrap();
        *counts.entry(m.open).or_insert(0_u32) += 1;
    }
    assert_eq!(counts.len(), 15);
    let chi2: f64 = counts.values().map(|&c| (f64::from(c) - 1000.0).powi(2) / 1000.0).sum();
    assert!(chi2 < 42.0, "{chi2}"); // 1 in 8000 with 14 degrees of freedom
}

#[test]
fn every_tree_spans_every_part_of_a_torn_graph() {
    let sides = [[0, 1], [1, 2], [2, 0], [3, 4], [4, -1], [5, 5], [3, 4]];
    let doors = Doors { cells: 6, sides: &sides, door: &[true; 7] };
    for tree in [Tree::DepthFirst, Tree::Kruskal, Tree::Prim, Tree::Wilson] {
        for seed in 0..50 {
            let m = carve(doors, tree, None, 1.0, [seed, 0], Watch::default()).unwrap();
            assert_eq!((m.passages.len(), m.open.iter().filter(|&&o| o).count()), (3, 3), "{tree:?}");
            assert!(!m.open[4] && !m.open[5]);
            assert_eq!(longest(6, &sides, &m.open, Watch::default()).unwrap().len(), 3);
        }
    }
}

#[test]
fn widths_taper_to_free_tips_and_stay_at_the_bounds() {
    let d = of(&family("uniform", 300, 2));
    let m = maze_of(&d, 1.0, 2);
    let bounds = [0.0, 0.0, 1.0, 1.0];
    let net = within(d.view(), &m.open, bounds).unwrap().net;
    let found = strands(net.view(), &pairs(net.view(), 4.0), &[]);
    let profile = Profile { width: 0.01, ..Profile::default() };
    let width = widths(net.view(), &found, profile, [2, 0]).unwrap();
    let degree = net.view().degrees();
    let mut tips = 0;
    for (edge, width) in net.edges.iter().zip(&width) {
        for (&v, &w) in edge.iter().zip(width) {
            let on_bounds = net.vertices[v as usize].iter().any(|&x| x == 0.0 || x == 1.0);
            assert!((0.0..=0.01 + 1e-15).contains(&w));
            if degree[v as usize] == 1 {
                tips += usize::from(!on_bounds);
                assert_eq!(w == 0.0, !on_bounds);
            }
        }
    }
    assert!(tips > 20);
    assert_eq!(found.of_edge.iter().zip(&found.generation).filter(|(s, _)| **s == 0).map(|(_, g)| *g).max(), Some(0));
}

proptest! {
    #[test]
    fn passages_are_a_spanning_tree_and_shut_doors_lead_to_ancestors(
        points in prop_oneof![any_points(), lattice()], seed in any::<u64>()
    ) {
        let d = of(&points);
        let m = maze_of(&d, 1.0, seed);
        prop_assert_eq!(m.passages.len(), d.sites.len().saturating_sub(1));
        let mut sets = DisjointSets::new(d.sites.len());
        for &[a, b] in &m.passages {
            prop_assert!(sets.unite(a as usize, b as usize), "a cycle");
        }
        let spans = intervals(&m, d.sites.len());
        let holds = |a: (usize, usize), b: (usize, usize)| a.0 <= b.0 && b.1 <= a.1;
        for ((&[a, b], door), open) in d.edges.iter().zip(voronoi_doors(d.view(), None)).zip(&m.open) {
            let (a, b) = (spans[a as usize], spans[b as usize]);
            prop_assert!(!door || holds(a, b) || holds(b, a), "a shut door between cousins");
            prop_assert!(door || !open);
        }
    }

    #[test]
    fn cells_hang_together_within_bounds_that_hold_their_sites(
        points in prop_oneof![any_points(), lattice()], seed in any::<u64>()
    ) {
        let d = of(&points);
        let ends = |i: usize| {
            let side = d.sites.iter().map(|p| p[i]);
            (side.clone().fold(f64::INFINITY, f64::min), side.fold(f64::NEG_INFINITY, f64::max))
        };
        let (x, y) = (ends(0), ends(1));
        let most = (x.1 - x.0).max(y.1 - y.0);
        let margin = if most > 0.0 { 0.1 * most } else { 1.0 };
        let door = voronoi_doors(d.view(), Some([x.0 - margin, y.0 - margin, x.1 + margin, y.1 + margin]));
        let doors = Doors { cells: d.sites.len(), sides: &d.edges, door: &door };
        let m = carve(doors, Tree::DepthFirst, None, 1.0, [seed, 0], Watch::default()).unwrap();
        prop_assert_eq!(m.passages.len(), d.sites.len().saturating_sub(1));
    }

    #[test]
    fn every_tree_spans_and_the_longest_way_is_as_long_as_any(points in any_points(), seed in any::<u64>()) {
        let d = of(&points);
        for tree in [Tree::Kruskal, Tree::Prim, Tree::Wilson] {
            let m = tree_of(&d, tree, None, 1.0, seed);
            prop_assert_eq!(m.passages.len(), d.sites.len().saturating_sub(1));
            let mut sets = DisjointSets::new(d.sites.len());
            prop_assert!(m.passages.iter().all(|&[a, b]| sets.unite(a as usize, b as usize)), "a cycle");
            let far = |source| distances(d.sites.len(), &d.edges, &m.open, source, Watch::default()).unwrap();
            let longest = longest(d.sites.len(), &d.edges, &m.open, Watch::default()).unwrap();
            for source in 0..d.sites.len().min(20) {
                let found = far(source);
                prop_assert!(found.iter().all(|&steps| 0 <= steps && (steps as usize) < longest.len()));
                let target = d.sites.len() - 1;
                let way = solve(d.sites.len(), &d.edges, &m.open, source, target, Watch::default()).unwrap();
                prop_assert_eq!(way.len() as i32, found[target] + 1);
            }
        }
    }

    #[test]
    fn opening_opens_that_share(points in any_points(), opening in 0.0..=1.0, seed in any::<u64>()) {
        let d = of(&points);
        let m = maze_of(&d, opening, seed);
        let open = m.open.iter().filter(|&&o| o).count();
        prop_assert_eq!(open, (opening * m.passages.len() as f64).round() as usize);
    }

    #[test]
    fn clipped_edges_lie_within_the_bounds(points in any_points()) {
        let d = of(&points);
        let bounds = [0.1, -0.2, 0.9, 1.7];
        let clipped = dual_edges(d.view(), bounds, |_| true).unwrap();
        for [x, y] in clipped.graph.edges.iter().flatten().map(|&v| clipped.graph.vertices[v as usize]) {
            prop_assert!((0.1 - 1e-9..=0.9 + 1e-9).contains(&x) && (-0.2 - 1e-9..=1.7 + 1e-9).contains(&y));
        }
    }

    #[test]
    fn strands_cover_every_edge_once_and_are_walks(points in prop_oneof![any_points(), lattice()]) {
        let d = of(&points);
        let g = Net::plane(dual_edges(d.view(), [-1.0, -1.0, 7.0, 7.0], |_| true).unwrap().graph);
        let s = strands(g.view(), &pairs(g.view(), 4.0), &[]);
        let mut edges: Vec<u32> = s.entries.iter().map(|entry| entry / 2).collect();
        edges.sort_unstable();
        prop_assert!(edges.into_iter().eq(0..g.edges.len() as u32));
        for strand in s.starts.windows(2) {
            for pair in s.entries[strand[0]..strand[1]].windows(2) {
                let leaves = g.edges[pair[0] as usize / 2][1 - pair[0] as usize % 2];
                prop_assert_eq!(leaves, g.edges[pair[1] as usize / 2][pair[1] as usize % 2]);
            }
        }
        prop_assert!(s.length.is_sorted_by(|a, b| a >= b));
    }
}
