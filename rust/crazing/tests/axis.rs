//! Curves through all samples, sides of the axis, and what is taken off it.
#![allow(clippy::unwrap_used, missing_docs)]

mod families;

use crazing::diagram::diagram;
use crazing::graph::{components, degrees};
use crazing::skeleton::{Measure, Rings, axis_edges, beyond, branches, curve, longest, one_step, ring_edges};
use crazing::{Diagram, Error, Point, Watch};
use families::{any_points, family, lattice, shuffled};
use proptest::prelude::*;

fn of(points: &[Point]) -> Diagram {
    diagram(points, Watch::default()).unwrap()
}

fn edges_of(d: &Diagram, mask: &[bool]) -> Vec<[i32; 2]> {
    d.edges.iter().zip(mask).filter(|(_, kept)| **kept).map(|(&ends, _)| ends).collect()
}

#[test]
fn a_smooth_curve_is_its_crust() {
    let d = of(&family("curve", 2000, 0));
    assert_eq!(curve(d.view(), Watch::default()).unwrap(), one_step(d.view()).unwrap());
}

#[test]
fn degenerate_input_and_interrupts_are_errors() {
    let line = of(&family("line", 9, 0));
    assert_eq!(curve(line.view(), Watch::default()), Err(Error::Collinear { found: 9 }));
    let d = of(&family("uniform", 60, 1));
    assert_eq!(curve(d.view(), Watch::new(&|| false)), Err(Error::Interrupted));
    let short = Rings::of(d.view(), &[true], Watch::default()).map(|_| ());
    assert!(matches!(short, Err(Error::BadLength { array: "mask", found: 1, .. })));
}

#[test]
fn inside_of_nested_circles_alternates() {
    let d = of(&family("two circles", 400, 0));
    let crust = one_step(d.view()).unwrap();
    let inner = Rings::of(d.view(), &crust, Watch::default()).unwrap().inside(Watch::default()).unwrap();
    for (dual, _) in d.dual_edges.iter().zip(&inner).filter(|(_, inner)| **inner) {
        let [x, y] = d.vertices[dual[0] as usize];
        assert!((x.hypot(y) - 1.5).abs() < 0.01);
    }
    assert!(inner.iter().any(|&inner| inner));
}

#[test]
fn inside_is_the_same_whether_rings_have_gaps_or_not() {
    // More edges than one thread looks at, and fewer.
    for count in [300, 15_000] {
        let d = of(&family("two circles", count, 0));
        let crust = one_step(d.view()).unwrap();
        // A line that misses an edge has an inside, as its gap is closed, though the mask alone has none.
        let gap = crust.iter().position(|&kept| kept).unwrap();
        let gapped: Vec<bool> = crust.iter().enumerate().map(|(k, &kept)| kept && k != gap).collect();
        for mask in [&crust, &gapped] {
            let (rings, inside) = Rings::with_inside(d.view(), mask, false, Watch::default()).unwrap();
            assert_eq!(rings.walls_between(), crust);
            assert_eq!(inside, Rings::of(d.view(), mask, Watch::default()).unwrap().inside(Watch::default()).unwrap());
            assert!(inside.iter().any(|&inside| inside));
        }
    }
}

#[test]
fn edges_along_rings_are_found() {
    // Two squares, one in the other.
    let square = |r: f64| [[-r, -r], [r, -r], [r, r], [-r, r]];
    let d = of(&[square(2.0), square(1.0)].concat());
    let found = ring_edges(d.view(), &[0, 4, 8]).unwrap();
    let wanted = |&[a, b]: &[i32; 2]| a / 4 == b / 4 && (a - b).abs() != 2;
    assert_eq!(found, d.edges.iter().map(wanted).collect::<Vec<_>>());
    for starts in [&[][..], &[0, 4], &[0, 4, 9], &[0, 5, 4, 8], &[1, 8], &[0, 0, 8], &[-3, 8], &[0, 4, 5, i64::MAX]] {
        let refused = ring_edges(d.view(), starts);
        assert!(matches!(refused, Err(Error::BadLength { array: "rings", wanted: 8, .. })), "{starts:?}");
    }
}

#[test]
fn residuals_are_ways_along_the_ring() {
    let d = of(&family("circle", 60, 0));
    let crust = one_step(d.view()).unwrap();
    let found = Rings::of(d.view(), &crust, Watch::default()).unwrap().residuals();
    for (&[p, q], residual) in d.edges.iter().zip(found) {
        let steps = (p - q).abs().min(60 - (p - q).abs());
        assert!((residual - f64::from(steps) / 60.0).abs() < 1e-9);
    }
}

/// Samples of a flower of five petals, each moved by its part of `noise`, in spacings.
fn wavy(moves: &[[f64; 2]], noise: f64) -> Vec<Point> {
    let (n, size) = (moves.len() as f64, noise * 8.5 / moves.len() as f64);
    let place = |(i, [x, y]): (usize, &[f64; 2])| {
        let t = i as f64 * std::f64::consts::TAU / n;
        let radius = 1.0 + 0.3 * (5.0 * t).cos();
        [radius * t.cos() + size * x, radius * t.sin() + size * y]
    };
    moves.iter().enumerate().map(place).collect()
}

/// The axis of the one-step crust inside the rings.
fn inner_axis(rings: &Rings<'_>, crust: &[bool]) -> Vec<bool> {
    let inside = rings.inside(Watch::default()).unwrap();
    crust.iter().zip(&inside).map(|(crust, inside)| !crust && *inside).collect()
}

/// Free ends, components and edges of the drawn dual edges of a mask.
fn shape(d: &Diagram, mask: &[bool]) -> [usize; 3] {
    let drawn = axis_edges(d.view(), mask);
    let ends = degrees(d.vertices.len(), &drawn, Watch::default()).unwrap();
    let parts = components(d.vertices.len(), &drawn, Watch::default()).unwrap().count as usize;
    [ends.iter().filter(|&&degree| degree == 1).count(), parts, drawn.len()]
}

#[test]
fn hairs_go_and_petals_stay() {
    let moves: Vec<[f64; 2]> =
        (0..1000).map(|i| [f64::from(i * 37 % 101) / 50.0 - 1.0, f64::from(i * 59 % 103) / 51.0 - 1.0]).collect();
    let d = of(&wavy(&moves, 0.2));
    let crust = one_step(d.view()).unwrap();
    let rings = Rings::of(d.view(), &crust, Watch::default()).unwrap();
    let axis = inner_axis(&rings, &crust);
    let kept = rings.without_hairs(&axis, 0.0125, Watch::default()).unwrap();
    assert!(shape(&d, &axis)[0] > 100);
    assert_eq!(shape(&d, &kept)[..2], [5, 1]);
    // Cut shorter by a bump's height, tips come back; where nothing is cut, nothing grows.
    let short = rings.without_bumps(&axis, 0.1, Watch::default()).unwrap();
    let grown = rings.grown(&axis, &short, Watch::default()).unwrap();
    let ([leaves, parts, edges], [ends, pieces, more]) = (shape(&d, &short), shape(&d, &grown));
    assert_eq!([leaves, parts], [5, 1]);
    assert_eq!([ends, pieces], [5, 1]);
    assert!(more > edges + 5);
    assert_eq!(rings.without_bumps(&axis, 0.0, Watch::default()).unwrap(), axis);
    assert_eq!(rings.grown(&axis, &axis, Watch::default()).unwrap(), axis);
}

#[test]
fn masks_of_another_length_and_interrupts_are_errors_of_tips() {
    let d = of(&wavy(&[[0.0; 2]; 200], 0.0));
    let crust = one_step(d.view()).unwrap();
    let rings = Rings::of(d.view(), &crust, Watch::default()).unwrap();
    let (whole, wanted) = (vec![true; d.edges.len()], d.edges.len());
    for other in [vec![true], vec![true; wanted + 1]] {
        let found = other.len();
        let bad = |array| Err(Error::BadLength { array, found, wanted });
        assert_eq!(rings.grown(&other, &whole, Watch::default()), bad("axis"));
        assert_eq!(rings.grown(&whole, &other, Watch::default()), bad("kept"));
        assert_eq!(rings.without_bumps(&other, 1.0, Watch::default()), bad("axis"));
        assert_eq!(rings.without_hairs(&other, 0.1, Watch::default()), bad("axis"));
    }
    let refuse = || false;
    let axis = inner_axis(&rings, &crust);
    assert_eq!(rings.grown(&axis, &axis, Watch::new(&refuse)), Err(Error::Interrupted));
    assert_eq!(rings.without_hairs(&axis, 0.1, Watch::new(&refuse)), Err(Error::Interrupted));
}

#[test]
fn a_hair_of_two_edges_goes_as_a_whole() {
    let moves: Vec<[f64; 2]> = (0..200).map(|i| [f64::from(i).sin(), f64::from(7 * i).cos()]).collect();
    let d = of(&wavy(&moves, 0.2));
    let crust = one_step(d.view()).unwrap();
    let rings = Rings::of(d.view(), &crust, Watch::default()).unwrap();
    let (axis, residuals) = (inner_axis(&rings, &crust), rings.residuals());
    let mut twos = 0;
    for v in 0..d.vertices.len() as i32 {
        let near = |k: usize| axis[k] && residuals[k] < 0.1 && d.dual_edges[k].contains(&v);
        let mask: Vec<bool> = (0..axis.len()).map(near).collect();
        let drawn = axis_edges(d.view(), &mask).len();
        if mask.iter().filter(|&&kept| kept).count() == 2 && drawn == 2 {
            twos += 1;
            assert!(!rings.without_bumps(&mask, 10.0, Watch::default()).unwrap().contains(&true));
        }
    }
    assert!(twos > 0);
}

#[test]
fn a_gap_of_a_few_steps_is_closed_and_a_wide_one_is_not() {
    let d = of(&family("circle", 200, 0));
    let crust = one_step(d.view()).unwrap();
    let inner = |missing: i32| {
        let there = |&[p, q]: &[i32; 2]| p.min(q) >= missing || (p.min(q) == 0 && p.max(q) == 199);
        let mask: Vec<bool> = d.edges.iter().zip(&crust).map(|(ends, &kept)| kept && there(ends)).collect();
        let rings = Rings::of(d.view(), &mask, Watch::default()).unwrap();
        rings.inside(Watch::default()).unwrap().into_iter().filter(|&inner| inner).count()
    };
    // The bridge may cut off the few samples it passes.
    assert!(inner(0) > 150 && inner(5) + 10 > inner(0));
    assert_eq!(inner(60), 0);
}

#[test]
fn a_splinter_beside_a_ring_is_no_island() {
    let mut points = family("circle", 200, 0);
    let count = points.len();
    points.extend([[0.99, 0.001], [0.98, 0.006], [0.98, -0.005]]);
    points.push([0.0, 0.0]);
    let d = of(&points);
    let in_ring = |&[p, q]: &[i32; 2]| [p, q].iter().all(|&site| (site as usize) < count);
    let splinter = |&[p, q]: &[i32; 2]| [p, q].iter().all(|&site| (count..count + 3).contains(&(site as usize)));
    let near = |&[p, q]: &[i32; 2]| matches!((p - q).abs(), 1 | 199);
    let mask: Vec<bool> = d.edges.iter().map(|e| (in_ring(e) && near(e)) || splinter(e)).collect();
    let found = Rings::of(d.view(), &mask, Watch::default()).unwrap().residuals();
    let centre = count as i32 + 3;
    for (ends, residual) in d.edges.iter().zip(found) {
        // The sample in the middle is on its own, far from any line; those of the splinter stand on the ring.
        assert_eq!(residual.is_infinite(), ends.contains(&centre));
    }
}

/// A line of four edges with a twig of length 0.5 at its middle.
const TWIG: [Point; 6] = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 0.0], [4.0, 0.0], [2.0, 0.5]];
const TWIG_EDGES: [[i32; 2]; 5] = [[0, 1], [1, 2], [5, 2], [3, 2], [3, 4]];

#[test]
fn the_shortest_branch_goes_and_the_line_stays() {
    let cut = |measure, least| branches(&TWIG, &TWIG_EDGES, &[1.0; 6], measure, least, Watch::default()).unwrap();
    assert_eq!(cut(Measure::Length, 0.5), [true; 5]);
    assert_eq!(cut(Measure::Length, 0.6), [true, true, false, true, true]);
    // Without its junction the line has no branch left, however much is asked for.
    assert_eq!(cut(Measure::Length, 100.0), [true, true, false, true, true]);
    assert_eq!(cut(Measure::Radius, 1.5), [true; 5]);
    assert_eq!(cut(Measure::Radius, 1.6), [true, true, false, true, true]);
}

#[test]
fn the_longest_path_leaves_the_twig_out() {
    let path = longest(&TWIG, &TWIG_EDGES, Watch::default()).unwrap();
    let mut rows = path;
    rows.sort_unstable();
    assert_eq!(rows, [0, 1, 3, 4]);
    assert_eq!(longest(&TWIG, &[], Watch::default()).unwrap(), [0; 0]);
}

proptest! {
    #[test]
    fn no_site_of_a_curve_has_three_edges(points in prop_oneof![any_points(), lattice()], seed in any::<u64>()) {
        let d = of(&points);
        let Ok(mask) = curve(d.view(), Watch::default()) else { return Ok(()) };
        let degrees = degrees(d.sites.len(), &edges_of(&d, &mask), Watch::default()).unwrap();
        prop_assert!(degrees.iter().all(|&degree| degree <= 2));
        let other = of(&shuffled(&points, seed));
        prop_assert!(curve(other.view(), Watch::default()).is_ok());
    }

    #[test]
    fn growing_makes_tips_longer_and_nothing_else(
        moves in prop::collection::vec([-1.0..1.0_f64, -1.0..1.0], 120..400),
        noise in 0.0..0.6_f64,
        height in 0.0..0.3_f64,
    ) {
        let d = of(&wavy(&moves, noise));
        let Ok(crust) = one_step(d.view()) else { return Ok(()) };
        let rings = Rings::of(d.view(), &crust, Watch::default()).unwrap();
        let axis = inner_axis(&rings, &crust);
        let kept = rings.without_bumps(&axis, height, Watch::default()).unwrap();
        let grown = rings.grown(&axis, &kept, Watch::default()).unwrap();
        prop_assert!(kept.iter().zip(&grown).zip(&axis).all(|((kept, grown), axis)| kept <= grown && grown <= axis));
        let ([leaves, parts, edges], [ends, pieces, more]) = (shape(&d, &kept), shape(&d, &grown));
        prop_assert_eq!([leaves, parts], [ends, pieces]);
        // As many vertices as edges are new: no cycle.
        let used = |mask: &[bool]| {
            let ends = degrees(d.vertices.len(), &axis_edges(d.view(), mask), Watch::default()).unwrap();
            ends.iter().filter(|&&degree| degree > 0).count()
        };
        prop_assert_eq!(used(&grown) - used(&kept), more - edges);
        // A tip comes to rest for good.
        prop_assert_eq!(rings.grown(&axis, &grown, Watch::default()).unwrap(), grown);
    }

    #[test]
    fn pruning_parts_nothing(points in any_points(), least in 0.0..2.0_f64) {
        let d = of(&points);
        let Ok(crust) = one_step(d.view()) else { return Ok(()) };
        let anti: Vec<bool> = crust.iter().map(|kept| !kept).collect();
        let axis = axis_edges(d.view(), &anti);
        let radius = vec![1.0; d.vertices.len()];
        let kept = branches(&d.vertices, &axis, &radius, Measure::Length, least, Watch::default()).unwrap();
        let left: Vec<[i32; 2]> = axis.iter().zip(&kept).filter(|(_, kept)| **kept).map(|(&ends, _)| ends).collect();
        let count = |edges: &[[i32; 2]]| components(d.vertices.len(), edges, Watch::default()).unwrap().count;
        prop_assert_eq!(count(&axis), count(&left));
        let path = longest(&d.vertices, &left, Watch::default()).unwrap();
        prop_assert!(path.len() <= left.len());
    }
}

#[test]
fn centres_beyond_a_boundary_are_named() {
    // A low roof sees the side beneath it under an obtuse angle, a high one under an acute one.
    for (height, found) in [(0.1, 1), (3.0, 0)] {
        let d = of(&[[0.0, 0.0], [2.0, 0.0], [1.0, height], [1.0, 9.0]]);
        let is_base = |edge: &[i32; 2]| edge.iter().all(|&end| end < 2);
        let boundary: Vec<bool> = d.edges.iter().map(is_base).collect();
        let out = beyond(d.view(), &boundary, &vec![true; d.edges.len()]).unwrap();
        assert_eq!(out.len(), found);
        assert!(out.iter().all(|&[k, roof]| boundary[k as usize] && roof == 2));
        assert!(beyond(d.view(), &boundary, &vec![false; d.edges.len()]).unwrap().is_empty());
    }
    let d = of(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]);
    assert!(beyond(d.view(), &[true], &[true; 3]).is_err());
}
