//! Laws of crusts and axes.
#![allow(clippy::unwrap_used, missing_docs)]

mod families;

use std::collections::BTreeSet;

use crazing::diagram::{diagram, representatives};
use crazing::predicates::{apex_sign, one_step_sign};
use crazing::skeleton::{axis_edges, one_step, second};
use crazing::{Diagram, Error, Point, Watch};
use families::{any_points, family, lattice, shuffled};
use proptest::prelude::*;

fn of(points: &[Point]) -> Diagram {
    diagram(points, Watch::default()).unwrap()
}

fn crust_bits(d: &Diagram, mask: &[bool]) -> BTreeSet<[[u64; 2]; 2]> {
    let bits = |site: i32| d.sites[site as usize].map(f64::to_bits);
    let kept = d.edges.iter().zip(mask).filter(|(_, kept)| **kept);
    kept.map(|(&[p, q], _)| [bits(p).min(bits(q)), bits(p).max(bits(q))]).collect()
}

#[test]
fn every_edge_of_a_sampled_convex_curve_is_crust_although_all_are_hull_edges() {
    for points in [family("circle", 60, 0), family("circle", 61, 0).iter().map(|p| [3.0 * p[0], p[1]]).collect()] {
        let d = of(&points);
        for crust in [one_step(d.view()).unwrap(), second(d.view(), Watch::default()).unwrap().crust] {
            assert_eq!(crust.iter().filter(|&&c| c).count(), points.len());
            let inner = d.dual_edges.iter().zip(&crust).any(|(dual, c)| *c && !dual.contains(&-1));
            assert!(!inner, "a chord is crust");
        }
    }
}

#[test]
fn a_flower_is_reconstructed() {
    let d = of(&family("curve", 2000, 0));
    let second = second(d.view(), Watch::default()).unwrap();
    let one = one_step(d.view()).unwrap();
    assert_eq!(one.iter().filter(|&&c| c).count(), 2000);
    assert_eq!(second.crust, one);
    let axis: BTreeSet<_> = second.axis.iter().copied().collect();
    let not_crust: Vec<bool> = one.iter().map(|c| !c).collect();
    let anti: BTreeSet<_> = axis_edges(d.view(), &not_crust).into_iter().map(|[a, b]| [a.min(b), a.max(b)]).collect();
    let filtered = axis_edges(d.view(), &second.filtered);
    assert!(
        filtered.iter().all(|&[a, b]| axis.contains(&[a.min(b), a.max(b)]) && anti.contains(&[a.min(b), a.max(b)]))
    );
}

#[test]
fn degenerate_input_is_an_error_of_its_own() {
    let few = of(&[[0.0, 0.0], [1.0, 0.0]]);
    assert_eq!(one_step(few.view()), Err(Error::TooFewSites { found: 2 }));
    let line = of(&family("line", 9, 0));
    assert_eq!(second(line.view(), Watch::default()), Err(Error::Collinear { found: 9 }));
}

#[test]
fn signs_at_and_next_to_a_tie() {
    // A square has both angles 90 degrees at its diagonal; two right angles are more than 90 in all.
    let (p, q) = ([0.0, 0.0], [1.0, 1.0]);
    assert!(one_step_sign(p, q, [1.0, 0.0], [0.0, 1.0]) < 0.0);
    // Angles of 45 degrees on both sides: exactly a tie, and one ulp to either side of it.
    let up = 0.5 + 0.5 * std::f64::consts::SQRT_2;
    let [r, s] = [[0.5, up], [0.5, -up]];
    let (p, q) = ([0.0, 0.0], [1.0, 0.0]);
    let sign = |u: f64| one_step_sign(p, q, [0.5, -u], [0.5, u]);
    assert!(sign(up.next_up().next_up()) > 0.0 && sign(up.next_down().next_down()) < 0.0);
    assert_eq!(one_step_sign(p, q, s, r), sign(up));
    // 45 degrees on both sides in integers: r on the circle of radius sqrt(2)/2 about (0.5, 0.5).
    assert_eq!(one_step_sign(p, q, [0.0, 1.0], [0.0, -1.0]), 0.0);
    assert_eq!(apex_sign(p, q, [0.5, 0.5]), 0.0);
    assert!(apex_sign(p, q, [0.5, 0.5_f64.next_down()]) < 0.0 && apex_sign(p, q, [0.5, 0.5_f64.next_up()]) > 0.0);
}

#[test]
fn integers_and_expansions_agree() {
    // A lattice takes the integer path; the same shape scaled by a third does not, but keeps all signs that are not ties.
    let points = family("duplicates", 4000, 5);
    let mut ties = 0;
    for four in points.chunks_exact(4) {
        let &[p, q, r, s] = four else { continue };
        if crazing::predicates::orientation(p, q, r) >= 0.0 || crazing::predicates::orientation(p, q, s) <= 0.0 {
            continue;
        }
        let whole = one_step_sign(p, q, r, s);
        let third = |p: Point| p.map(|x| x * (1.0 / 3.0));
        let scaled = one_step_sign(third(p), third(q), third(r), third(s));
        ties += usize::from(whole == 0.0);
        assert!(whole == 0.0 || whole == scaled);
    }
    assert!(ties > 3);
}

proptest! {
    #[test]
    fn crusts_and_axes_are_nested(points in any_points()) {
        let d = of(&points);
        let Ok(one) = one_step(d.view()) else { return Ok(()) };
        let second = second(d.view(), Watch::default()).unwrap();
        let gabriel = |k: usize| {
            let [p, q] = d.edges[k].map(|i| d.sites[i as usize]);
            d.dual_edges[k].iter().filter(|&&t| t != -1).all(|&t| {
                let r = d.triangles[t as usize].into_iter().find(|c| !d.edges[k].contains(c)).unwrap();
                apex_sign(p, q, d.sites[r as usize]) >= 0.0
            })
        };
        let moderate = d.sites.iter().flatten().all(|x| x.abs() < 1e60);
        for (k, (&one, &two)) in one.iter().zip(&second.crust).enumerate() {
            prop_assert!(!moderate || !one || gabriel(k), "one-step crust outside Gabriel");
            prop_assert!(one || !two, "two-pass crust outside one-step");
            prop_assert!(!(one && second.filtered[k]), "edge-filtered axis outside one-step");
        }
        for &[a, b] in &second.axis {
            prop_assert!(a < b && (b as usize) < d.triangles.len());
        }
    }

    #[test]
    fn one_step_does_not_depend_on_how_ties_were_triangulated(points in lattice(), seed in any::<u64>()) {
        let (a, b) = (of(&points), of(&shuffled(&points, seed)));
        if let (Ok(x), Ok(y)) = (one_step(a.view()), one_step(b.view())) {
            prop_assert_eq!(crust_bits(&a, &x), crust_bits(&b, &y));
            let turned: Vec<Point> = points.iter().map(|p| [-p[1], p[0]]).collect();
            let c = of(&turned);
            prop_assert_eq!(x.iter().filter(|c| **c).count(), one_step(c.view()).unwrap().iter().filter(|c| **c).count());
        }
    }

    #[test]
    fn no_axis_edge_has_no_length(points in prop_oneof![any_points(), lattice()]) {
        let d = of(&points);
        if let Ok(crust) = one_step(d.view()) {
            let anti: Vec<bool> = crust.iter().map(|c| !c).collect();
            let representative = representatives(d.view());
            for [a, b] in axis_edges(d.view(), &anti) {
                prop_assert!(a != b && representative[a as usize] == a && representative[b as usize] == b);
            }
        }
    }
}
