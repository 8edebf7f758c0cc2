//! Tips of an axis that run on to its ends.
#![allow(clippy::unwrap_used, missing_docs)]

use crazing::diagram::diagram;
use crazing::graph::{components, degrees};
use crazing::skeleton::{Rings, axis_edges, peeled, reaching, ring_edges};
use crazing::{Diagram, Error, Point, Watch};
use proptest::prelude::*;

/// The diagram of a ring of points in order, its inner axis, and the residual and arc of every dual edge.
fn axis_of(ring: &[Point]) -> (Diagram, Vec<bool>, Vec<f64>, Vec<f64>) {
    let d = diagram(ring, Watch::default()).unwrap();
    let boundary = ring_edges(d.view(), &[0, ring.len() as i64]).unwrap();
    let (rings, inside) = Rings::with_inside(d.view(), &boundary, true, Watch::default()).unwrap();
    let residuals = rings.residuals();
    let arcs = rings.arcs(&residuals);
    (d, inside, residuals, arcs)
}

/// Points round a box of `length` x 1, four a unit.
fn corridor(length: u32) -> Vec<Point> {
    let (long, far) = (4 * length, f64::from(length));
    let along = |count: u32| (0..count).map(|i| f64::from(i) / 4.0);
    let there = along(long).map(|x| [x, 0.0]).chain(along(4).map(|y| [far, y]));
    let back = along(long).map(|x| [far - x, 1.0]).chain(along(4).map(|y| [0.0, 1.0 - y]));
    there.chain(back).collect()
}

/// The places of the free ends, from left to right.
fn tips(d: &Diagram, mask: &[bool]) -> Vec<Point> {
    let ends = degrees(d.vertices.len(), &axis_edges(d.view(), mask), Watch::default()).unwrap();
    let mut tips: Vec<Point> = (0..ends.len()).filter(|&v| ends[v] == 1).map(|v| d.vertices[v]).collect();
    tips.sort_by(|a, b| a[0].total_cmp(&b[0]));
    tips
}

#[test]
fn a_corridor_is_followed_to_where_its_corners_part() {
    let (d, axis, residuals, arcs) = axis_of(&corridor(80));
    for (arc, residual) in arcs.iter().zip(&residuals) {
        assert!((arc - 162.0 * residual).abs() < 1e-9);
    }
    let kept = peeled(d.view(), &axis, &residuals, 0.025, Watch::default()).unwrap();
    let whole = reaching(d.view(), &axis, &residuals, &arcs, 0.025, Watch::default()).unwrap();
    let ([a, b], [c, e]) = (tips(&d, &kept)[..].try_into().unwrap(), tips(&d, &whole)[..].try_into().unwrap());
    assert!(a[0] > 1.2 && b[0] < 78.8);
    for (tip, end) in [(c, [0.5, 0.5]), (e, [79.5, 0.5])] {
        assert!((tip[0] - end[0]).hypot(tip[1] - end[1]) <= 0.25, "{tip:?}");
    }
}

#[test]
fn an_axis_that_is_whole_or_gone_has_nowhere_to_go() {
    let (d, axis, residuals, arcs) = axis_of(&corridor(9));
    for (least, wanted) in [(0.0, axis.clone()), (0.6, vec![false; axis.len()])] {
        assert_eq!(reaching(d.view(), &axis, &residuals, &arcs, least, Watch::default()).unwrap(), wanted);
    }
}

#[test]
fn arrays_of_another_length_and_interrupts_are_errors() {
    let (d, axis, residuals, arcs) = axis_of(&corridor(9));
    let (view, wanted) = (d.view(), axis.len());
    let bad = |array| Err(Error::BadLength { array, found: 1, wanted });
    let watch = Watch::default();
    assert_eq!(reaching(view, &[true], &residuals, &arcs, 0.1, watch), bad("axis"));
    assert_eq!(reaching(view, &axis, &[1.0], &arcs, 0.1, watch), bad("worth"));
    assert_eq!(reaching(view, &axis, &residuals, &[1.0], 0.1, watch), bad("arcs"));
    // Nothing is weak, so that the tips are the first to ask.
    let refused = reaching(view, &axis, &residuals, &arcs, 0.0, Watch::new(&|| false));
    assert_eq!(refused, Err(Error::Interrupted));
}

proptest! {
    #[test]
    fn reaching_makes_tips_longer_and_nothing_else(
        radii in prop::collection::vec(0.3..1.0_f64, 12..200),
        least in 0.0..0.3_f64,
        spread in 0.0..0.2_f64,
    ) {
        let turn = std::f64::consts::TAU / radii.len() as f64;
        let place = |(i, radius): (usize, &f64)| {
            let (sin, cos) = (i as f64 * turn).sin_cos();
            let radius = 1.0 - spread * radius;
            [radius * cos, radius * sin]
        };
        let ring: Vec<Point> = radii.iter().enumerate().map(place).collect();
        let (d, axis, residuals, arcs) = axis_of(&ring);
        let kept = peeled(d.view(), &axis, &residuals, least, Watch::default()).unwrap();
        let whole = reaching(d.view(), &axis, &residuals, &arcs, least, Watch::default()).unwrap();
        prop_assert!(kept.iter().zip(&whole).zip(&axis).all(|((kept, whole), axis)| kept <= whole && whole <= axis));
        // Free ends, components, and vertices less edges, of which a cycle would take one.
        let shape = |mask: &[bool]| {
            let drawn = axis_edges(d.view(), mask);
            let ends = degrees(d.vertices.len(), &drawn, Watch::default()).unwrap();
            let used = ends.iter().filter(|&&degree| degree > 0).count();
            let parts = components(d.vertices.len(), &drawn, Watch::default()).unwrap().count as usize;
            (ends.iter().filter(|&&degree| degree == 1).count(), parts, used as i64 - drawn.len() as i64)
        };
        prop_assert_eq!(shape(&kept), shape(&whole));
    }
}
