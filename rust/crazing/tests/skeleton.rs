//! Laws of crusts and axes.
#![allow(clippy::unwrap_used, missing_docs)]

mod families;

use std::collections::BTreeSet;

use crazing::diagram::{diagram, representatives};
use crazing::predicates::{apex_sign, nearer_sign, one_step_sign, projection_sign};
use crazing::skeleton::{Variant, axis_edges, gabriel, nearest, one_step, one_step_drawn, poles, poles_axis, second};
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

/// The test on the four sites of every edge, in exact numbers.
fn literal(d: &Diagram) -> Vec<bool> {
    let at = |site: i32| d.sites[site as usize];
    let apex = |k: usize, t: i32| {
        let corners = d.triangles[t as usize];
        at(*corners.iter().find(|corner| !d.edges[k].contains(corner)).unwrap())
    };
    let is_crust = |k: usize| {
        let [p, q] = d.edges[k].map(at);
        match d.dual_edges[k] {
            [t, -1] | [-1, t] => apex_sign(p, q, apex(k, t)) > 0.0,
            [right, left] => one_step_sign(p, q, apex(k, right), apex(k, left)) >= 0.0,
        }
    };
    (0..d.edges.len()).map(is_crust).collect()
}

#[test]
fn edges_are_told_apart_where_a_chain_of_vertices_shares_one_place_far_from_its_own() {
    // Inside a ring that is nearly a circle all vertices share one place. Outside of it every edge has a site that
    // would make it a tie if the ring were a circle about that place, but for a little: less, as much, and more than
    // the place is off.
    let count = 600;
    for flat in [0.0, 1e-12, 1e-9, 2e-8] {
        let mut rng = crazing::rng::Rng::new([7, 0], 1);
        let step = std::f64::consts::TAU / f64::from(count);
        let at = |turn: f64, radius: f64| [(1.0 + flat) * radius * libm::cos(turn), radius * libm::sin(turn)];
        let tie = 1.0 / libm::cos(0.5 * step) + libm::tan(0.5 * step);
        let ring = (0..count).map(|i| at(step * f64::from(i), 1.0));
        let mut beyond = Vec::new();
        for i in 0..count {
            let off = libm::pow(10.0, -3.0 - 11.0 * rng.unit()) * if i % 2 == 0 { 1.0 } else { -1.0 };
            beyond.push(at(step * (f64::from(i) + 0.5), tie * (1.0 + off)));
        }
        let d = of(&ring.chain(beyond).collect::<Vec<_>>());
        let shared = d.dual_edges.iter().filter(|dual| !dual.contains(&-1));
        let shared = shared.filter(|dual| d.vertices[dual[0] as usize] == d.vertices[dual[1] as usize]).count();
        assert!(shared > 500, "{shared}");
        let (crust, literal) = (one_step(d.view()).unwrap(), literal(&d));
        assert_eq!(crust, literal);
        let on_ring = (0..crust.len()).filter(|&k| d.edges[k].iter().all(|&site| site < count));
        let kept = on_ring.filter(|&k| crust[k]).count();
        assert!((200..400).contains(&kept), "{kept}");
        let drawn = one_step_drawn(d.view()).unwrap();
        let mut rows = drawn.counts().map(|count| vec![[-9; 2]; count]);
        let [first, second] = &mut rows;
        drawn.draw(d.view(), first, second);
        let rest: Vec<bool> = crust.iter().map(|kept| !kept).collect();
        let wanted = d.edges.iter().zip(&crust).filter(|(_, kept)| **kept).map(|(&ends, _)| ends);
        assert_eq!(rows, [wanted.collect(), axis_edges(d.view(), &rest)]);
    }
}

#[test]
fn every_family_is_decided_as_by_the_four_sites_of_each_edge() {
    for name in ["uniform", "curve", "grid", "circle"] {
        let plain = family(name, 700, 3);
        for (size, offset) in [(1.0, 0.0), (1e-9, 0.0), (1e9, 0.0), (1.0, 1e9)] {
            let points: Vec<Point> = plain.iter().map(|p| p.map(|x| size * (x + offset))).collect();
            let d = of(&points);
            assert_eq!(one_step(d.view()).unwrap(), literal(&d), "{name} {size} {offset}");
        }
        // Where the four sites' own products would leave the range of a float, a power of two changes no sign.
        let wanted = one_step(of(&plain).view()).unwrap();
        for size in [-500, 500].map(|power| 2_f64.powi(power)) {
            let points: Vec<Point> = plain.iter().map(|p| p.map(|x| size * x)).collect();
            assert_eq!(one_step(of(&points).view()).unwrap(), wanted, "{name} {size}");
        }
    }
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
fn distances_are_told_apart_by_one_ulp() {
    let (p, a) = ([0.1, 0.2], [3.7, 4.9]);
    let b = [p[0] - (a[0] - p[0]), p[1] - (a[1] - p[1])];
    assert_eq!(nearer_sign(p, a, a), 0.0);
    assert_eq!(nearer_sign(p, a, b), -nearer_sign(p, b, a));
    assert!(nearer_sign(p, a, [a[0].next_up(), a[1]]) < 0.0 && nearer_sign(p, a, [a[0], a[1].next_down()]) > 0.0);
    assert_eq!(nearer_sign([0.0, 0.0], [3.0, 4.0], [-5.0, 0.0]), 0.0);
    assert_eq!(projection_sign([0.0, 0.0], [1.0, 1.0], [1.0, 3.0], [2.0, 2.0]), 0.0);
    assert!(projection_sign([0.0, 0.0], [1.0, 1.0], [1.0, 3.0_f64.next_down()], [2.0, 2.0]) < 0.0);
}

#[test]
fn equally_near_neighbours_are_all_taken() {
    // Every site of a grid has two to four neighbours at distance 1, and no more.
    let d = of(&family("grid", 36, 0));
    let mask = nearest(d.view(), Watch::default()).unwrap();
    for (k, &[p, q]) in d.edges.iter().enumerate() {
        let [a, b] = [p, q].map(|i| d.sites[i as usize]);
        assert_eq!(mask[k], (a[0] - b[0]).abs() + (a[1] - b[1]).abs() == 1.0);
    }
    let d = of(&family("curve", 2000, 0));
    assert_eq!(nearest(d.view(), Watch::default()).unwrap(), one_step(d.view()).unwrap());
}

#[test]
fn poles_of_a_cell_with_known_corners() {
    let d = of(&[[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0], [2.0, 1.0]]);
    for variant in [Variant::Thesis, Variant::Amenta] {
        let [first, second] = poles(d.view(), variant, Watch::default()).unwrap()[4].map(|t| d.vertices[t as usize]);
        assert_eq!(first, [2.0, -1.5]);
        assert!(second[0] == 2.0 && (second[1] - 19.0 / 6.0).abs() < 1e-15);
    }
    let corner = |variant| poles(d.view(), variant, Watch::default()).unwrap()[2];
    assert_ne!(corner(Variant::Thesis)[0], -1);
    assert_eq!(corner(Variant::Amenta)[0], -1);
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
        let gabriel = gabriel(d.view()).unwrap();
        for (k, (&one, &two)) in one.iter().zip(&second.crust).enumerate() {
            prop_assert!(!one || gabriel[k], "one-step crust outside Gabriel");
            prop_assert!(one || !two, "two-pass crust outside one-step");
            prop_assert!(!(one && second.filtered[k]), "edge-filtered axis outside one-step");
        }
        for &[a, b] in &second.axis {
            prop_assert!(a < b && (b as usize) < d.triangles.len());
        }
    }

    #[test]
    fn nearest_neighbours_join_every_site_and_are_gabriel_or_beyond(points in any_points()) {
        let d = of(&points);
        let Ok(mask) = nearest(d.view(), Watch::default()) else { return Ok(()) };
        let mut joined = vec![0; d.sites.len()];
        for (ends, _) in d.edges.iter().zip(&mask).filter(|(_, kept)| **kept) {
            ends.iter().for_each(|&end| joined[end as usize] += 1);
        }
        prop_assert!(joined.iter().all(|&degree| degree > 0));
        let other = of(&shuffled(&points, 3));
        prop_assert_eq!(crust_bits(&d, &mask).len(), mask.iter().filter(|&&kept| kept).count());
        if points.len() < 40 && d.sites.iter().flatten().all(|x| x.fract() != 0.0) {
            prop_assert_eq!(crust_bits(&d, &mask), crust_bits(&other, &nearest(other.view(), Watch::default()).unwrap()));
        }
    }

    #[test]
    fn poles_are_corners_of_their_cell(points in prop_oneof![any_points(), lattice()]) {
        let d = of(&points);
        let representative = representatives(d.view());
        for variant in [Variant::Thesis, Variant::Amenta] {
            let Ok(poles) = poles(d.view(), variant, Watch::default()) else { return Ok(()) };
            let mut hull = vec![false; d.sites.len()];
            for (ends, _) in d.edges.iter().zip(&d.dual_edges).filter(|(_, dual)| dual.contains(&-1)) {
                ends.iter().for_each(|&end| hull[end as usize] = true);
            }
            for (site, &[first, second]) in poles.iter().enumerate() {
                prop_assert_eq!(first == -1, variant == Variant::Amenta && hull[site]);
                prop_assert!(first != second || first == -1);
                for pole in [first, second].into_iter().filter(|&pole| pole != -1) {
                    prop_assert_eq!(representative[pole as usize], pole);
                    let corner = |t: usize| d.triangles[t].contains(&(site as i32));
                    prop_assert!((0..d.triangles.len()).any(|t| representative[t] == pole && corner(t)));
                }
            }
            let all: BTreeSet<i32> = poles.iter().flatten().copied().collect();
            for ends in poles_axis(d.view(), variant, Watch::default()).unwrap() {
                prop_assert!(ends[0] < ends[1] && ends.iter().all(|end| all.contains(end)));
            }
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
