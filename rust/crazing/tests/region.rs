//! Regions against the plain even-odd rule, on lattices where corners lie on every line there is.
#![allow(clippy::unwrap_used, missing_docs)]

use crazing::predicates::orientation;
use crazing::region::Region;
use crazing::{Error, PlanarGraph, Point, Watch};
use proptest::prelude::*;

fn region(ring: &[Point]) -> Region {
    Region::of(ring, &[0, ring.len() as i64], Watch::default()).unwrap()
}

fn sides(ring: &[Point]) -> impl Iterator<Item = [Point; 2]> + '_ {
    ring.iter().zip(ring.iter().cycle().skip(1)).map(|(&a, &b)| [a, b])
}

/// A ray to the right meets each side in its half-open span of y.
fn by_ray(ring: &[Point], p: Point) -> bool {
    let meets = |[a, b]: [Point; 2]| {
        let [low, high] = if a[1] < b[1] { [a, b] } else { [b, a] };
        low[1] <= p[1] && p[1] < high[1] && orientation(low, high, p) > 0.0
    };
    sides(ring).filter(|&side| meets(side)).count() % 2 == 1
}

fn lattice(n: std::ops::Range<usize>) -> impl Strategy<Value = Vec<Point>> {
    prop::collection::vec((0..9_i32, 0..9_i32).prop_map(|(x, y)| [f64::from(x), f64::from(y)]), n)
}

#[test]
fn flat_and_broken_rings_are_named() {
    let flat = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]];
    assert!(matches!(Region::of(&flat, &[0, 3], Watch::default()), Err(Error::BadValue { .. })));
    assert!(matches!(Region::of(&flat, &[0, 4], Watch::default()), Err(Error::BadIndex { .. })));
    assert!(matches!(Region::of(&flat, &[3, 0], Watch::default()), Err(Error::BadIndex { .. })));
    assert!(matches!(Region::of(&[[f64::NAN, 0.0]], &[0, 1], Watch::default()), Err(Error::NotFinite { .. })));
}

proptest! {
    #[test]
    fn inside_is_even_odd(ring in lattice(3..30), points in lattice(1..30)) {
        prop_assume!((0..2).all(|i| ring.iter().any(|p| p[i] != ring[0][i])));
        let region = region(&ring);
        let middles = points.iter().map(|p| [p[0] + 0.25, p[1] + 0.125]);
        for p in points.iter().copied().chain(middles) {
            let on_outline = sides(&ring).any(|[a, b]| {
                let between = (0..2).all(|i| a[i].min(b[i]) <= p[i] && p[i] <= a[i].max(b[i]));
                orientation(a, b, p) == 0.0 && between
            });
            prop_assert!(on_outline || region.contains(p) == by_ray(&ring, p), "{p:?}");
        }
    }

    #[test]
    fn parts_are_inside_and_the_rest_is_not(ring in lattice(3..20), ends in lattice(2..9)) {
        prop_assume!((0..2).all(|i| ring.iter().any(|p| p[i] != ring[0][i])));
        let region = region(&ring);
        let vertices: Vec<Point> = ends.iter().map(|p| [p[0] + 0.3, p[1] + 0.17]).collect();
        let edges = (1..vertices.len() as i32).map(|i| [i - 1, i]).collect();
        let parts = region.clip(&PlanarGraph { vertices, edges }, Watch::default()).unwrap();
        for &ends in &parts.graph.edges {
            let [a, b] = ends.map(|end| parts.graph.vertices[end as usize]);
            let middle = [f64::midpoint(a[0], b[0]), f64::midpoint(a[1], b[1])];
            let length = (a[0] - b[0]).hypot(a[1] - b[1]);
            prop_assert!(length < 1e-9 || by_ray(&ring, middle), "{a:?} {b:?}");
        }
    }
}
