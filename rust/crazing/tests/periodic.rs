//! Law 10: a periodic diagram is the diagram of copies of its sites, restricted to one period.
#![allow(clippy::unwrap_used, missing_docs)]

mod families;

use std::collections::{BTreeMap, BTreeSet};

use crazing::diagram::{PeriodicDiagram, diagram, periodic};
use crazing::predicates::in_circle;
use crazing::{Error, Point, Watch};
use families::{FAMILIES, family, shuffled};
use proptest::prelude::*;

/// An edge whatever its direction and copy: site, site and the periods between.
type Edge = (i32, i32, [i32; 2]);

fn of(points: &[Point], period: Point) -> PeriodicDiagram {
    periodic(points, period, Watch::default()).unwrap()
}

fn edge(a: i32, b: i32, shift: [i32; 2]) -> Edge {
    let back = shift.map(|x| -x);
    (a.min(b), a.max(b), if a < b || (a == b && shift > back) { shift } else { back })
}

fn edges(d: &PeriodicDiagram) -> BTreeMap<Edge, usize> {
    let mut found = BTreeMap::new();
    for (ends, shift) in d.diagram.edges.iter().zip(&d.shifts) {
        *found.entry(edge(ends[0], ends[1], shift.map(i32::from))).or_insert(0) += 1;
    }
    found
}

/// Edges at the middle one of (2 r + 1)^2 copies, and whether each is there whichever way ties are decided.
fn by_copies(sites: &[Point], [w, h]: Point, r: i32) -> BTreeMap<Edge, bool> {
    let n = sites.len();
    let mut shifts: Vec<[i32; 2]> = (-r..=r).flat_map(|a| (-r..=r).map(move |b| [a, b])).collect();
    shifts.sort_by_key(|shift| *shift != [0, 0]);
    let copies: Vec<Point> = shifts
        .iter()
        .flat_map(|&[a, b]| sites.iter().map(move |p| [p[0] + f64::from(a) * w, p[1] + f64::from(b) * h]))
        .collect();
    let d = diagram(&copies, Watch::default()).unwrap();
    let at = |i: i32| d.sites[i as usize];
    let mut found = BTreeMap::new();
    for (&[a, b], &sides) in d.edges.iter().zip(&d.dual_edges) {
        if (a as usize) < n || (b as usize) < n {
            let apex = |t: i32| *d.triangles[t as usize].iter().find(|&&c| c != a && c != b).unwrap();
            let is_sure = in_circle(at(a), at(b), at(apex(sides[1])), at(apex(sides[0]))) != 0.0;
            let [from, to] = [a, b].map(|i| shifts[i as usize / n]);
            let shift = [to[0] - from[0], to[1] - from[1]];
            found.insert(edge(a % n as i32, b % n as i32, shift), is_sure);
        }
    }
    found
}

/// Law 10, Euler on the torus, alignments and empty circles.
fn check(d: &PeriodicDiagram, period: Point, r: i32) {
    let PeriodicDiagram { diagram, shifts, dual_shifts } = d;
    diagram.view().check().unwrap();
    assert_eq!(diagram.sites.len() + diagram.triangles.len(), diagram.edges.len(), "Euler");
    assert!(diagram.dual_edges.iter().flatten().all(|&t| t != -1), "a torus has no outside");
    let inside = |p: &Point| (0.0..period[0]).contains(&p[0]) && (0.0..period[1]).contains(&p[1]);
    assert!(diagram.sites.iter().chain(&diagram.vertices).all(inside));
    let (ours, theirs) = (edges(d), by_copies(&diagram.sites, period, r));
    assert!(ours.values().all(|&times| times == 1), "an edge twice");
    for (edge, is_sure) in &theirs {
        assert!(!is_sure || ours.contains_key(edge), "{edge:?} is missing");
    }
    let mut degree = vec![0; diagram.triangles.len()];
    for k in 0..shifts.len() {
        let [a, b] = diagram.edges[k];
        let is_point = is_coincident(d, k);
        let is_sure = theirs.get(&edge(a, b, shifts[k].map(i32::from))) == Some(&true);
        assert!(is_sure || is_point, "the copies have no such edge");
        assert!(a < b || (a == b && shifts[k] > [0, 0]), "edges run upward");
        for (side, t) in diagram.dual_edges[k].into_iter().enumerate() {
            degree[t as usize] += 1;
            let corners = diagram.triangles[t as usize];
            assert!(corners.contains(&a) && corners.contains(&b), "side {side}");
        }
        assert!(is_perpendicular(d, k, period), "dual of {:?} by {:?}, {:?}", [a, b], shifts[k], dual_shifts[k]);
    }
    assert!(degree.iter().all(|&edges| edges == 3));
}

/// A tie: the dual edge has no length.
fn is_coincident(d: &PeriodicDiagram, k: usize) -> bool {
    let [a, b] = d.diagram.dual_edges[k].map(|t| d.diagram.vertices[t as usize]);
    a == b && d.dual_shifts[k] == [0, 0]
}

/// The dual edge, as its shift lays it, stands on the edge and points to its left.
fn is_perpendicular(d: &PeriodicDiagram, k: usize, period: Point) -> bool {
    let step = |points: &[Point], [a, b]: [i32; 2], shift: [i8; 2]| {
        [0, 1].map(|i| points[b as usize][i] - points[a as usize][i] + f64::from(shift[i]) * period[i])
    };
    let [x, y] = step(&d.diagram.sites, d.diagram.edges[k], d.shifts[k]);
    let [u, v] = step(&d.diagram.vertices, d.diagram.dual_edges[k], d.dual_shifts[k]);
    let size = x.hypot(y) * u.hypot(v);
    let close = 1e-6 * x.hypot(y) * period[0].hypot(period[1]);
    (x * u + y * v).abs() <= close && x * v - y * u >= -close && (size > 0.0 || [u, v] == [0.0; 2])
}

/// The points of a family brought into a period, on a grid fine enough to tell them apart and coarse enough to be
/// exact in every copy.
fn laid(name: &str, n: usize, seed: u64, [w, h]: Point) -> Vec<Point> {
    let points = family(name, n, seed);
    let size = points.iter().flatten().fold(1e-300_f64, |m, x| m.max(x.abs()));
    let onto = |x: f64, side: f64| ((x / size + 1.0) * 0.5 * 1_048_576.0).floor() / 1_048_576.0 * side;
    points.iter().map(|p| [onto(p[0], w), onto(p[1], h)]).collect()
}

#[test]
fn every_family_at_a_size_that_needs_a_halo() {
    for name in FAMILIES {
        for period in [[1.0, 1.0], [8.0, 0.5]] {
            check(&of(&laid(name, 900, 3, period), period), period, 1);
        }
    }
}

#[test]
fn sites_far_from_the_sides_and_about_the_corner() {
    // Few sites near the sides, or nearly all of them: circles reach over any narrow halo.
    let step = |i: usize, golden: f64| (i as f64 * golden).fract();
    let spread = |u: f64| (2.0 * u - 1.0) / (1.02 - (2.0 * u - 1.0).abs()) * 0.02;
    for (centre, n) in [([0.5, 0.5], 2000), ([0.0, 0.0], 2000), ([0.0, 0.5], 1500), ([0.98, 0.3], 700)] {
        let at = |i: usize| [step(i, 0.618_033_988_749), step(i, 0.754_877_666_246)].map(spread);
        let heap: Vec<Point> = (0..n).map(|i| [0, 1].map(|axis| at(i)[axis] + centre[axis])).collect();
        check(&of(&laid_near(&heap, [1.0, 0.75]), [1.0, 0.75]), [1.0, 0.75], 1);
        let turn = |i: usize| 2.0 * std::f64::consts::PI * step(i, 0.618_033_988_749);
        let ring = |i: usize| [centre[0] + 0.1 * turn(i).cos(), centre[1] + 0.1 * turn(i).sin()];
        let ring: Vec<Point> = (0..n).map(ring).collect();
        check(&of(&laid_near(&ring, [1.0, 1.0]), [1.0, 1.0]), [1.0, 1.0], 1);
    }
}

#[test]
fn clusters_of_a_few_roundings_of_the_period() {
    // Rounded centres of circles so small tell nothing of each other.
    let close = |x: f64, most: f64| x / (2.0 * most + 1.0) + 0.5;
    for seed in 0..500 {
        let points = family("many decades", 2 + seed as usize % 6, seed);
        let most = points.iter().flatten().fold(0.0_f64, |most, &x| most.max(x));
        let points: Vec<Point> = points.iter().map(|p| p.map(|x| close(x, most))).collect();
        let d = of(&points, [1.0, 1.25]);
        assert_eq!(d.diagram.sites.len() + d.diagram.triangles.len(), d.diagram.edges.len());
    }
    // Polygons about the corner of the cell lie in four copies at once, with diagonals that must agree; their centres
    // are no floating-point numbers.
    for turn in 0..400 {
        let [a, b, h] = [f64::from(1 + turn % 8), f64::from(1 + turn / 8 % 8), f64::from(3 + turn / 64)];
        let trapezoid = [[-a, -2.0], [a, -2.0], [-b, h - 2.0], [b, h - 2.0]];
        let points = trapezoid.map(|p| p.map(|x| (x * 2.0_f64.powi(-51)).rem_euclid(1.0)));
        let d = of(&points, [1.0, 1.0]);
        assert_eq!(d.diagram.sites.len() + d.diagram.triangles.len(), d.diagram.edges.len());
    }
}

/// Points brought into a period and onto a grid on which every copy is exact.
fn laid_near(points: &[Point], period: Point) -> Vec<Point> {
    let onto = |x: f64, side: f64| (x.rem_euclid(side) * 1_073_741_824.0).floor() / 1_073_741_824.0 % side;
    points.iter().map(|p| [onto(p[0], period[0]), onto(p[1], period[1])]).collect()
}

#[test]
fn lattices_aligned_with_the_period_have_the_same_diagonals_everywhere() {
    for side in [1, 2, 3, 5, 24] {
        let points: Vec<Point> = (0..side * side).map(|i| [f64::from(i % side), f64::from(i / side)]).collect();
        let d = of(&points, [f64::from(side); 2]);
        check(&d, [f64::from(side); 2], 1);
        let diagonals = d.diagram.edges.iter().zip(&d.shifts).filter(|&(&[a, b], shift)| {
            let [dx, dy] = [0, 1].map(|i| {
                let [a, b] = [a, b].map(|site| d.diagram.sites[site as usize][i]);
                b - a + f64::from(shift[i]) * f64::from(side)
            });
            dx * dy > 0.0
        });
        assert_eq!(diagonals.count(), (side * side) as usize, "all diagonals rise");
    }
}

#[test]
fn bad_periods_are_named_and_no_point_has_no_triangle() {
    for bad in [[0.0, 1.0], [1.0, f64::NAN], [f64::INFINITY, 1.0], [1.0, -1.0], [1e-20, 1.0], [1e308, 1e308]] {
        assert!(matches!(periodic(&[[0.0, 0.0]], bad, Watch::default()), Err(Error::BadValue { .. })), "{bad:?}");
    }
    assert_eq!(of(&[], [1.0, 1.0]), PeriodicDiagram::default());
}

proptest! {
    #[test]
    fn it_is_the_diagram_of_copies(
        name in 0..FAMILIES.len(), n in 1_usize..70, seed in any::<u64>(), h in prop_oneof![Just(1.0), 0.05..20.0]
    ) {
        let period = [1.0, (h * 64.0_f64).ceil() / 64.0];
        check(&of(&laid(FAMILIES[name], n, seed, period), period), period, 2);
    }

    #[test]
    fn ties_do_not_depend_on_the_copy_or_the_order(
        points in prop::collection::vec((0..6_i32, 0..4_i32), 1..16), move_by in (0..6_i32, 0..4_i32), seed in any::<u64>()
    ) {
        let distinct: BTreeSet<(i32, i32)> = points.into_iter().collect();
        let points: Vec<Point> = distinct.into_iter().map(|(x, y)| [f64::from(x), f64::from(y)]).collect();
        let moved: Vec<Point> =
            points.iter().map(|p| [p[0] + f64::from(move_by.0) - 12.0, p[1] + f64::from(move_by.1)]).collect();
        let (a, b) = (of(&points, [6.0, 4.0]), of(&moved, [6.0, 4.0]));
        check(&a, [6.0, 4.0], 2);
        prop_assert_eq!(drawn(&a, [0.0, 0.0]), drawn(&b, [-f64::from(move_by.0), -f64::from(move_by.1)]));
        prop_assert_eq!(drawn(&a, [0.0, 0.0]), drawn(&of(&shuffled(&points, seed), [6.0, 4.0]), [0.0, 0.0]));
    }
}

/// Edges by position in the 6 x 4 torus and step, moved by `by`.
fn drawn(d: &PeriodicDiagram, by: Point) -> BTreeSet<[i64; 4]> {
    let sites = &d.diagram.sites;
    let mut found = BTreeSet::new();
    for (&[a, b], shift) in d.diagram.edges.iter().zip(&d.shifts) {
        let [p, q] = [a, b].map(|site| sites[site as usize]);
        let step = [0, 1].map(|i| (q[i] - p[i] + f64::from(shift[i]) * [6.0, 4.0][i]) as i64);
        let from = |p: Point, step: [i64; 2]| {
            let at = [0, 1].map(|i| (p[i] + by[i]).rem_euclid([6.0, 4.0][i]) as i64);
            [at[0], at[1], step[0], step[1]]
        };
        found.insert(from(p, step).max(from(q, step.map(|x| -x))));
    }
    found
}
