//! Laws of diagrams and of the quad-edge, on every family of points.
#![allow(clippy::unwrap_used, clippy::indexing_slicing, missing_docs)]

mod families;

use std::collections::BTreeSet;

use crazing::diagram::scale::{Scale, largest};
use crazing::diagram::{diagram, representatives};
use crazing::predicates::{circumcentre, orientation};
use crazing::quad_edge::{inv_rot, onext, rot, sym};
use crazing::{Diagram, Error, Point, Watch};
use families::{FAMILIES, any_points, family, lattice, shuffled};
use proptest::prelude::*;

fn of(points: &[Point]) -> Diagram {
    diagram(points, Watch::default()).unwrap()
}

/// Sites in the unit in which exact predicates neither over- nor underflow.
fn near_one(d: &Diagram) -> Vec<Point> {
    let scale = Scale::of(largest(&d.sites));
    d.sites.iter().map(|&p| scale.down(p)).collect()
}

fn in_circle([a, b, c, d]: [Point; 4]) -> f64 {
    let coord = |p: Point| robust::Coord { x: p[0], y: p[1] };
    robust::incircle(coord(a), coord(b), coord(c), coord(d))
}

fn apex(d: &Diagram, t: i32, edge: [i32; 2]) -> i32 {
    *d.triangles[t as usize].iter().find(|c| !edge.contains(c)).unwrap()
}

/// Every law at once: alignments, Euler, orientation, the empty circle, the outside on the left.
fn check(d: &Diagram) {
    d.view().check().unwrap();
    let at = near_one(d);
    let corner = |site: i32| at[site as usize];
    for &[a, b, c] in &d.triangles {
        assert!(orientation(corner(a), corner(b), corner(c)) > 0.0);
    }
    for (&[p, q], &[right, left]) in d.edges.iter().zip(&d.dual_edges) {
        for (t, sign) in [(right, -1.0), (left, 1.0)] {
            if t != -1 {
                let r = apex(d, t, [p, q]);
                assert!(sign * orientation(corner(p), corner(q), corner(r)) > 0.0);
            }
        }
        if right != -1 && left != -1 {
            assert!(p < q);
            let (r, s) = (apex(d, right, [p, q]), apex(d, left, [p, q]));
            assert!(in_circle([corner(p), corner(q), corner(s), corner(r)]) <= 0.0, "not Delaunay");
        }
        assert!(right != -1 || d.triangles.is_empty(), "the outside is on the right");
    }
    let n = d.sites.len() as i64;
    let euler = n + d.triangles.len() as i64 - d.edges.len() as i64;
    assert_eq!(euler, i64::from(n > 0), "Euler");
    assert!(d.vertices.iter().flatten().all(|x| x.is_finite()));
}

fn edge_set(d: &Diagram) -> BTreeSet<[[u64; 2]; 2]> {
    let bits = |site: i32| d.sites[site as usize].map(f64::to_bits);
    d.edges.iter().map(|&[p, q]| [bits(p).min(bits(q)), bits(p).max(bits(q))]).collect()
}

#[test]
fn laws_hold_on_large_sets_of_every_family() {
    for name in FAMILIES {
        check(&of(&family(name, 3000, 7)));
    }
}

#[test]
fn nothing_one_and_two() {
    assert_eq!(of(&[]), Diagram::default());
    assert_eq!(of(&[[1.0, 2.0]; 3]).sites, [[1.0, 2.0]]);
    let two = of(&[[0.0, 0.0], [1.0, 0.0]]);
    assert_eq!((two.edges, two.dual_edges), (vec![[0, 1]], vec![[-1, -1]]));
}

#[test]
fn duplicates_merge_in_order_of_first_appearance() {
    let d = of(&[[1.0, 1.0], [0.0, 0.0], [1.0, 1.0], [-0.0, 0.0], [2.0, 0.0]]);
    assert_eq!(d.site_of, [0, 1, 0, 1, 2]);
    assert_eq!(d.sites, [[1.0, 1.0], [0.0, 0.0], [2.0, 0.0]]);
}

#[test]
fn not_finite_is_named() {
    let error = diagram(&[[0.0, 0.0], [f64::NAN, 2.0]], Watch::default()).unwrap_err();
    assert_eq!(error.to_string(), "points[1] is (nan, 2.0); every coordinate must be finite");
    assert!(matches!(diagram(&[[f64::INFINITY, 0.0]], Watch::default()), Err(Error::NotFinite { row: 0, .. })));
}

#[test]
fn a_grid_has_one_vertex_a_square_and_a_regular_polygon_one_in_all() {
    let count = |d: &Diagram| representatives(d.view()).into_iter().collect::<BTreeSet<_>>().len();
    let grid = of(&family("grid", 64, 0));
    assert_eq!((grid.triangles.len(), count(&grid)), (98, 49));
    assert_eq!(count(&of(&family("circle", 100, 0))), 1);
    let distinct: BTreeSet<_> = grid.vertices.iter().map(|v| v.map(f64::to_bits)).collect();
    assert_eq!(distinct.len(), 49);
}

#[test]
fn far_offsets_cost_no_vertex() {
    let points = family("far offset", 400, 3);
    let d = of(&points);
    for (corners, vertex) in d.triangles.iter().zip(&d.vertices) {
        let distance = |site: i32| (d.sites[site as usize][0] - vertex[0]).hypot(d.sites[site as usize][1] - vertex[1]);
        let radii = corners.map(distance);
        // A position at 4.6e6 is rounded to 5e-10; flat triangles have vertices far away, relative error counts there.
        assert!((radii[0] - radii[1]).abs() <= 4e-9 * radii[0].max(1.0), "{radii:?}");
    }
}

#[test]
fn interrupted_work_stops() {
    let points = family("uniform", 50_000, 1);
    assert_eq!(diagram(&points, Watch::new(&|| false)).unwrap_err(), Error::Interrupted);
}

proptest! {
    #[test]
    fn laws_hold(points in any_points()) {
        check(&of(&points));
    }

    #[test]
    fn laws_hold_on_lattices(points in lattice()) {
        check(&of(&points));
    }

    #[test]
    fn order_of_rows_changes_nothing_but_numbers(points in prop_oneof![any_points(), lattice()], seed in any::<u64>()) {
        prop_assert_eq!(edge_set(&of(&points)), edge_set(&of(&shuffled(&points, seed))));
    }

    #[test]
    fn scaling_by_powers_of_two_changes_no_row(points in lattice(), exponent in -900_i32..900) {
        let factor = power_of_two(exponent);
        let scaled: Vec<Point> = points.iter().map(|p| p.map(|x| x * factor)).collect();
        let (a, b) = (of(&points), of(&scaled));
        prop_assert_eq!(a.edges, b.edges);
        prop_assert_eq!(a.dual_edges, b.dual_edges);
    }

    #[test]
    fn quad_edge_laws(points in prop_oneof![any_points(), lattice()]) {
        let d = of(&points);
        let next = onext(d.view(), None).unwrap();
        let next = |q: i32| next[q as usize];
        for q in 0..4 * d.edges.len() as i32 {
            prop_assert_eq!(rot(rot(rot(rot(q)))), q);
            prop_assert_eq!(rot(next(rot(next(q)))), q);
            prop_assert_eq!(sym(q), rot(rot(q)));
            prop_assert_eq!(inv_rot(rot(q)), q);
            prop_assert_eq!(origin(&d, q), origin(&d, next(q)));
            // The next edge about the left face starts where this one ends.
            prop_assert_eq!(origin(&d, rot(next(inv_rot(q)))), origin(&d, sym(q)));
        }
    }
}

/// Site of a primal quarter-edge, triangle of a dual one.
fn origin(d: &Diagram, q: i32) -> i32 {
    let (k, r) = ((q / 4) as usize, (q % 4) as usize);
    if r.is_multiple_of(2) { d.edges[k][r / 2] } else { d.dual_edges[k][r / 2] }
}

fn power_of_two(exponent: i32) -> f64 {
    2_f64.powi(exponent)
}

#[test]
fn circumcentres_of_slivers_are_right_from_every_corner() {
    // Three corners of a rectangle, along the axes and turned: the worst is the sharp corner, wherever it stands.
    for narrow in (0..200).map(|k| 0.9_f64.powi(2 * k)) {
        for [u, v] in [[1.0, 0.0], [0.0, 1.0], [0.6, 0.8], [-0.28, 0.96]] {
            let at = |x: f64, y: f64| [x * u - y * v, x * v + y * u];
            let [a, b, c] = [at(0.0, 0.0), at(narrow, 0.0), at(0.0, 1.25)];
            for corners in [[a, b, c], [a, c, b], [b, a, c], [b, c, a], [c, a, b], [c, b, a]] {
                let [x, y] = circumcentre(corners[0], corners[1], corners[2]);
                let [wanted_x, wanted_y] = [(b[0] + c[0]) / 2.0, (b[1] + c[1]) / 2.0];
                // Turned corners are rounded, and so is the right angle.
                let least = 1e-12 + if u * v == 0.0 { 0.0 } else { 4e-16 / narrow };
                assert!((x - wanted_x).hypot(y - wanted_y) < least, "{narrow} {corners:?}: {x} {y}");
            }
        }
    }
}
