//! The local crust and edge filter against brute force and against the literal second triangulation.
#![allow(clippy::unwrap_used, missing_docs)]

mod families;

use std::collections::BTreeSet;

use crazing::diagram::scale::{Scale, largest};
use crazing::diagram::{diagram, representatives};
use crazing::skeleton::{Known, axis_edges, edge_filter, edge_filter_among, filtered_among, links, one_step};
use crazing::skeleton::{one_step_drawn, second, two_pass, two_pass_among};
use crazing::{Diagram, Error, Point, Watch};
use families::{FAMILIES, any_points, family, lattice, shuffled};
use proptest::prelude::*;

fn of(points: &[Point]) -> Diagram {
    diagram(points, Watch::default()).unwrap()
}

/// Width, over half the length of `pq`, of the interval of circles through `p` and `q` that hold none of `others`;
/// zero or less when there is none.
fn margin(p: Point, q: Point, others: impl Iterator<Item = Point>) -> f64 {
    let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
    for v in others {
        let (a, b) = ([p[0] - v[0], p[1] - v[1]], [q[0] - v[0], q[1] - v[1]]);
        let (dot, cross) = (a[0] * b[0] + a[1] * b[1], a[0] * b[1] - a[1] * b[0]);
        if cross > 0.0 {
            high = high.min(dot / cross);
        } else if cross < 0.0 {
            low = low.max(dot / cross);
        } else if dot < 0.0 {
            return f64::NEG_INFINITY;
        }
    }
    high - low
}

/// Margins of every edge and every dual edge (NaN where that is no axis edge by itself).
fn margins(d: &Diagram) -> Vec<[f64; 2]> {
    let scale = Scale::of(largest(&d.sites));
    let sites: Vec<Point> = d.sites.iter().map(|&p| scale.down(p)).collect();
    let vertices: Vec<Point> = d.vertices.iter().map(|&p| scale.down(p)).collect();
    let both = || sites.iter().chain(&vertices).copied();
    let without = |a: Point, b: Point| both().filter(move |&v| v != a && v != b);
    let row = |(edge, dual): (&[i32; 2], &[i32; 2])| {
        let [p, q] = edge.map(|i| sites[i as usize]);
        if dual.contains(&-1) {
            return [margin(p, q, without(p, q)), f64::NAN];
        }
        let [from, to] = dual.map(|t| vertices[t as usize]);
        let axis = if from == to { f64::NAN } else { margin(from, to, without(from, to)) };
        [margin(p, q, without(p, q)), axis]
    };
    d.edges.iter().zip(&d.dual_edges).map(row).collect()
}

/// Whether arithmetic without care, as in `margin` and in rounded vertices, can be trusted on these points.
fn tame(d: &Diagram) -> bool {
    let size = largest(&d.sites);
    let spread = d.edges.iter().map(|&[p, q]| {
        let [p, q] = [d.sites[p as usize], d.sites[q as usize]];
        (p[0] - q[0]).abs().max((p[1] - q[1]).abs())
    });
    // Vertices of subnormal data are rounded to few digits.
    size > 1e-290
        && spread.fold(f64::INFINITY, f64::min) > 1e-5 * size
        && largest(&d.vertices) < (1e5 * size).min(f64::MAX)
}

#[test]
fn equals_the_second_triangulation_edge_for_edge() {
    for name in ["uniform", "curve"] {
        for seed in 0..3 {
            let d = of(&family(name, 5000, seed));
            let (local, literal) = (edge_filter(d.view()).unwrap(), second(d.view(), Watch::default()).unwrap());
            assert_eq!(two_pass(d.view()).unwrap(), literal.crust, "{name}");
            assert_eq!(local.crust, literal.crust, "{name}");
            assert_eq!(local.axis, literal.filtered, "{name}");
        }
    }
}

#[test]
fn large_discs_beyond_all_sites_equal_the_second_triangulation() {
    // Off the lattice of symmetry, where vertices far away would tie.
    let at = |i: usize| {
        let t = (i as f64 + 0.3 * (i as f64 * 2.4).sin()) / 20_000.0 * std::f64::consts::TAU;
        let r = 1.0 + 0.3 * (5.0 * t + 0.1).cos() + 0.1 * (13.0 * t).cos() + 0.01 * (2.0 * t).sin();
        [r * t.cos(), r * t.sin()]
    };
    let flower: Vec<Point> = (0..20_000).map(at).collect();
    let wave: Vec<Point> = (0..20_000).map(|i| f64::from(i) * 5e-5).map(|x| [x, 1e-4 * (40.0 * x).sin()]).collect();
    for (name, points) in [("flower", flower), ("wave", wave)] {
        let d = of(&points);
        let (local, literal) = (edge_filter(d.view()).unwrap(), second(d.view(), Watch::default()).unwrap());
        assert_eq!(local.crust, literal.crust, "{name}");
        assert_eq!(local.axis, literal.filtered, "{name}");
    }
}

/// Samples of two arms and the bend between them, in which a disc touches one edge of a cell and comes in by another: a
/// walk that enters every cell once only keeps an axis edge too many.
#[rustfmt::skip]
const TWO_DOORS: [[Point; 10]; 3] = [
    [[1e6, 0.0], [708541.0, 387683.0], [707912.0, 388555.0], [562920.0, 493883.0], [561978.0, 494596.0],
     [561029.0, 495290.0], [558147.0, 497250.0], [557173.0, 497861.0], [1310.0, 341225.0], [0.0, 340885.0]],
    [[0.0, 410640.0], [211999.0, 24960.0], [212961.0, 23048.0], [224805.0, 9233.0], [231784.0, 5084.0],
     [233680.0, 4240.0], [625276.0, 5687.0], [626816.0, 5647.0], [628355.0, 5662.0], [1e6, 0.0]],
    [[0.0, 420122.0], [352943.0, 70626.0], [353693.0, 69838.0], [512590.0, 1155.0], [513670.0, 609.0],
     [514747.0, 142.0], [525226.0, 0.0], [526233.0, 447.0], [998882.0, 504879.0], [1e6, 505894.0]],
];

#[test]
fn a_cell_is_entered_by_every_edge_that_a_disc_comes_in_by() {
    for points in TWO_DOORS {
        let d = of(&points);
        let (one, local) = (one_step(d.view()).unwrap(), edge_filter(d.view()).unwrap());
        for (k, [crust, axis]) in margins(&d).into_iter().enumerate() {
            assert!(crust.abs() > 1e-7 && (axis.is_nan() || axis.abs() >= 1e-7), "no tie");
            assert_eq!(local.crust[k], crust > 0.0 && one[k]);
            assert_eq!(local.axis[k], axis > 0.0 && !one[k]);
        }
    }
}

#[test]
fn every_family_ends() {
    for name in FAMILIES {
        let d = of(&family(name, 3000, 5));
        if one_step(d.view()).is_ok() {
            edge_filter(d.view()).unwrap();
        }
    }
}

#[test]
fn a_wheel_is_not_quadratic() {
    let mut points = family("circle", 30_000, 0);
    points.push([0.0, 0.0]);
    let d = of(&points);
    let local = edge_filter(d.view()).unwrap();
    assert_eq!(local.crust.iter().filter(|c| **c).count(), 30_000);
}

#[test]
fn an_open_arc_is_not_quadratic() {
    // Nearly all vertices are about its centre, tens of thousands of them in one place, and those far out see all cells.
    let n = 60_000;
    let at = |i: usize| (i as f64 + 0.4 * (i as f64 * 2.4).sin()) / n as f64 * std::f64::consts::PI;
    let mut points: Vec<Point> = (0..n).map(at).map(|t| [t.cos(), t.sin()]).collect();
    points.extend([[1e9, 1e9], [-1e7, 3e9]]);
    let d = of(&points);
    let local = edge_filter(d.view()).unwrap();
    let rim = d.edges.iter().zip(&local.crust).filter(|([p, q], kept)| **kept && p.abs_diff(*q) == 1);
    assert_eq!(rim.filter(|(ends, _)| ends.iter().all(|&end| (end as usize) < n)).count(), n - 1);
}

#[test]
fn a_lattice_whose_sides_are_nearly_straight_is_not_quadratic() {
    // Slivers along its sides have vertices out at 1e17: the circles about these are lines for all the rest.
    let g = 150;
    let at = |i: usize| [(i % g) as f64 + 0.5 * (i / g) as f64, 0.8660254 * (i / g) as f64];
    let d = of(&(0..g * g).map(at).collect::<Vec<Point>>());
    let local = edge_filter(d.view()).unwrap();
    let is_inner = |t: i32| {
        let (v, p) = (d.vertices[t as usize], d.sites[d.triangles[t as usize][0] as usize]);
        (v[0] - p[0]).hypot(v[1] - p[1]) < 1.0
    };
    let inner = d.dual_edges.iter().zip(&local.axis).filter(|(dual, _)| dual.iter().all(|&t| t != -1 && is_inner(t)));
    let (count, kept) = inner.fold((0, 0), |(count, kept), (_, &axis)| (count + 1, kept + usize::from(axis)));
    assert_eq!((count, kept), (3 * (g - 1) * (g - 1) - 2 * (g - 1), count));
}

#[test]
fn every_sample_of_a_dense_flower_gets_its_two_edges() {
    // The shape on which triangulating the sites and vertices in floating point loses nine edges of ten.
    let n = 100_000;
    let at = |i: usize| {
        let t = i as f64 / n as f64 * std::f64::consts::TAU;
        let r = 1000.0 * (1.0 + 0.3 * (5.0 * t).cos() + 0.1 * (13.0 * t).cos());
        [r * t.cos(), r * t.sin()]
    };
    let d = of(&(0..n).map(at).collect::<Vec<Point>>());
    let (one, local) = (one_step(d.view()).unwrap(), edge_filter(d.view()).unwrap());
    assert_eq!(one.iter().filter(|crust| **crust).count(), n);
    assert_eq!(local.crust, one);
    assert_eq!(two_pass(d.view()).unwrap(), one);
    let mut degrees = vec![0; n];
    d.edges
        .iter()
        .zip(&one)
        .filter(|(_, crust)| **crust)
        .flat_map(|(ends, _)| ends)
        .for_each(|&i| degrees[i as usize] += 1);
    assert!(degrees.iter().all(|&degree| degree == 2));
}

fn rows(d: &Diagram, mask: &[bool]) -> BTreeSet<[[u64; 2]; 2]> {
    let bits = |site: i32| d.sites[site as usize].map(f64::to_bits);
    let kept = d.edges.iter().zip(mask).filter(|(_, kept)| **kept);
    kept.map(|(&[p, q], _)| [bits(p).min(bits(q)), bits(p).max(bits(q))]).collect()
}

proptest! {
    #[test]
    fn equals_brute_force_and_the_literal_form_away_from_ties(points in any_points()) {
        let d = of(&points);
        let Ok(one) = one_step(d.view()) else { return Ok(()) };
        prop_assume!(tame(&d));
        let (local, literal) = (edge_filter(d.view()).unwrap(), second(d.view(), Watch::default()).unwrap());
        for (k, [crust, axis]) in margins(&d).into_iter().enumerate() {
            if crust.abs() > 1e-7 {
                prop_assert_eq!(local.crust[k], crust > 0.0 && one[k], "crust {} margin {}", k, crust);
                prop_assert_eq!(local.crust[k], literal.crust[k], "literal crust {} margin {}", k, crust);
            }
            if axis.abs() > 1e-7 {
                prop_assert_eq!(local.axis[k], axis > 0.0 && !one[k], "axis {} margin {}", k, axis);
                prop_assert_eq!(local.axis[k], literal.filtered[k], "literal axis {} margin {}", k, axis);
            }
        }
    }

    #[test]
    fn ties_do_not_depend_on_the_triangulation(points in lattice(), seed in any::<u64>()) {
        let (a, b) = (of(&points), of(&shuffled(&points, seed)));
        if let (Ok(x), Ok(y)) = (edge_filter(a.view()), edge_filter(b.view())) {
            prop_assert_eq!(rows(&a, &x.crust), rows(&b, &y.crust));
            prop_assert_eq!(rows(&a, &x.axis), rows(&b, &y.axis));
        }
    }

    #[test]
    fn nested_in_one_step_on_every_family(points in prop_oneof![any_points(), lattice()]) {
        let d = of(&points);
        let Ok(one) = one_step(d.view()) else { return Ok(()) };
        let local = edge_filter(d.view()).unwrap();
        let representative = representatives(d.view());
        for (k, &one) in one.iter().enumerate() {
            prop_assert!(one || !local.crust[k]);
            prop_assert!(!(one && local.axis[k]));
            let [a, b] = d.dual_edges[k];
            let point = a != -1 && b != -1 && representative[a as usize] == representative[b as usize];
            prop_assert!(!local.axis[k] || (a != -1 && b != -1 && !point));
        }
    }
}

#[test]
fn what_is_drawn_is_read_off_the_mask() {
    for name in FAMILIES {
        for n in [3, 60, 400] {
            let d = of(&family(name, n, 1));
            if d.triangles.is_empty() {
                continue;
            }
            let (found, mask) = (one_step_drawn(d.view()).unwrap(), one_step(d.view()).unwrap());
            let rest: Vec<bool> = mask.iter().map(|kept| !kept).collect();
            let crust = d.edges.iter().zip(&mask).filter(|(_, kept)| **kept).map(|(&ends, _)| ends);
            let mut drawn = found.counts().map(|count| vec![[-9; 2]; count]);
            let [first, second] = &mut drawn;
            found.draw(d.view(), first, second);
            assert_eq!(drawn, [crust.collect(), axis_edges(d.view(), &rest)], "{name} {n}");
            assert_eq!(found.into_mask(), mask, "{name} {n}");
        }
    }
}

#[test]
fn what_is_known_of_another_diagram_is_refused() {
    let d = of(&family("uniform", 50, 1));
    let (one_step, links) = (one_step(d.view()).unwrap(), links(d.view()));
    for (array, one_step, links) in [("links", &one_step[..], &links[3..]), ("one_step", &one_step[1..], &links[..])] {
        let known = Known { one_step, links };
        let errors = [two_pass_among(d.view(), known).err(), filtered_among(d.view(), known).err()];
        for error in errors.into_iter().chain([edge_filter_among(d.view(), known).err()]) {
            assert!(matches!(error, Some(Error::BadLength { array: of, .. }) if of == array));
        }
    }
}
