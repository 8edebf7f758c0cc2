//! Regions against the plain even-odd rule, on lattices where corners lie on every line there is.
#![allow(clippy::unwrap_used, missing_docs)]

use crazing::diagram::diagram;
use crazing::predicates::orientation;
use crazing::region::{Region, cells, doors};
use crazing::{Error, Point, Watch};
use proptest::prelude::*;

fn region(coords: &[Point], offsets: &[i64]) -> Result<Region, Error> {
    Region::of(coords, offsets, 0, Watch::default())
}

fn sides(coords: &[Point], offsets: &[i64]) -> Vec<[Point; 2]> {
    let ring = |ends: &[i64]| {
        let ring = &coords[ends[0] as usize..ends[1] as usize];
        ring.iter().zip(ring.iter().cycle().skip(1)).map(|(&a, &b)| [a, b]).collect::<Vec<_>>()
    };
    offsets.windows(2).flat_map(ring).collect()
}

/// A ray to the right meets each side in its half-open span of y.
fn by_ray(sides: &[[Point; 2]], p: Point) -> bool {
    let meets = |&[a, b]: &[Point; 2]| {
        let [low, high] = if a[1] < b[1] { [a, b] } else { [b, a] };
        low[1] <= p[1] && p[1] < high[1] && orientation(low, high, p) > 0.0
    };
    sides.iter().filter(|side| meets(side)).count() % 2 == 1
}

fn lattice(n: std::ops::Range<usize>) -> impl Strategy<Value = Vec<Point>> {
    prop::collection::vec((0..9_i32, 0..9_i32).prop_map(|(x, y)| [f64::from(x), f64::from(y)]), n)
}

/// Squares of a lattice, each a ring: they share sides and corners in every way.
fn squares() -> impl Strategy<Value = (Vec<Point>, Vec<i64>)> {
    prop::collection::btree_set((0..6_i32, 0..6_i32), 1..20).prop_map(|squares| {
        let corners =
            |&(x, y): &(i32, i32)| [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(a, b)| [f64::from(x + a), f64::from(y + b)]);
        let coords: Vec<Point> = squares.iter().flat_map(corners).collect();
        let offsets = (0..=squares.len() as i64).map(|i| 4 * i).collect();
        (coords, offsets)
    })
}

#[test]
fn small_shapes_far_apart_are_told_as_by_a_ray() {
    // All sides of each are in one of so many squares over all of them, unless squares follow the corners.
    let at = |i: u32| f64::from(i.wrapping_mul(2_654_435_769)) / f64::from(u32::MAX);
    let n = 1500;
    let islands: Vec<Point> = (0..6).map(|i| [1e4 * at(3 * i), 1e5 * at(3 * i + 1)]).chain([[1e9, -3e3]]).collect();
    let rim = |&[x, y]: &Point| {
        let angle = |i: u32| std::f64::consts::TAU * f64::from(i) / f64::from(n);
        let r = |t: f64| 1.0 + 0.3 * (7.0 * t).cos();
        (0..n).map(angle).map(move |t| [x + r(t) * t.cos(), y + r(t) * t.sin()]).collect::<Vec<_>>()
    };
    let coords: Vec<Point> = islands.iter().flat_map(rim).collect();
    let offsets: Vec<i64> = (0..=islands.len() as i64).map(|i| i * i64::from(n)).collect();
    let (found, sides) = (region(&coords, &offsets).unwrap(), sides(&coords, &offsets));
    assert_eq!(found.rings().1, offsets);
    let mut inside = 0;
    for i in 0..3000 {
        let near = islands[i as usize % islands.len()];
        let p = [0, 1].map(|axis| near[axis] + 3.0 * (at(2 * i + axis as u32 + 9) - 0.5));
        assert_eq!(found.contains(p), by_ray(&sides, p), "{p:?}");
        inside += usize::from(found.contains(p));
    }
    assert!(inside > 500 && inside < 2500);
    assert!((0..200).all(|i| !found.contains([1e9 * at(i), 1e5 * at(i + 1) + 10.0])));
}

#[test]
fn flat_and_broken_rings_are_named() {
    let flat = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]];
    assert!(matches!(region(&flat, &[0, 3]), Err(Error::Crossing { .. })));
    assert!(matches!(region(&flat[..2], &[0, 2]), Err(Error::BadValue { .. })));
    assert!(matches!(region(&flat, &[0, 4]), Err(Error::BadIndex { .. })));
    assert!(matches!(region(&flat, &[3, 0]), Err(Error::BadIndex { .. })));
    assert!(matches!(region(&[[f64::NAN, 0.0]], &[0, 1]), Err(Error::NotFinite { .. })));
    let tie = [[0.0, 0.0], [2.0, 2.0], [2.0, 0.0], [0.0, 2.0]];
    assert_eq!(
        region(&tie, &[0, 4]).unwrap_err(),
        Error::Crossing { what: "outline side", first: [0, 1], second: [2, 3] }
    );
}

#[test]
fn a_ring_that_touches_itself_comes_apart() {
    // Two squares at one corner, drawn as one ring; and a hole that touches the middle of a side.
    let eight = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [2.0, 1.0], [2.0, 2.0], [1.0, 2.0], [1.0, 1.0], [0.0, 1.0]];
    let (coords, offsets) = region(&eight, &[0, 8]).unwrap().rings();
    assert_eq!((coords.len(), offsets), (8, vec![0, 4, 8]));
    let hole = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0], [0.0, 2.0], [1.0, 1.0], [1.0, 3.0]];
    let (coords, offsets) = region(&hole, &[0, 4, 7]).unwrap().rings();
    // The inside is one piece still: outline and hole are one ring.
    assert_eq!((coords.len(), offsets), (8, vec![0, 8]));
}

proptest! {
    #[test]
    fn inside_is_even_odd((coords, offsets) in squares(), points in lattice(1..30)) {
        let region = region(&coords, &offsets).unwrap();
        let sides = sides(&coords, &offsets);
        for p in points.iter().map(|p| [p[0] + 0.25, p[1] + 0.125]) {
            prop_assert_eq!(region.contains(p), by_ray(&sides, p), "{:?}", p);
        }
    }

    #[test]
    fn rings_are_plain_and_made_plain_once_and_for_all((coords, offsets) in squares()) {
        let (plain, starts) = region(&coords, &offsets).unwrap().rings();
        let around = sides(&plain, &starts);
        let given = sides(&coords, &offsets);
        // The inside is on the left of the middle of every side, and the outside on its right.
        for &[a, b] in &around {
            let (middle, left) = ([0, 1].map(|i| f64::midpoint(a[i], b[i])), [a[1] - b[1], b[0] - a[0]]);
            let beside = |step: f64| [0, 1].map(|i| middle[i] + step * left[i]);
            prop_assert!(by_ray(&given, beside(0.25)) && !by_ray(&given, beside(-0.25)));
        }
        prop_assert_eq!(region(&plain, &starts).unwrap().rings(), (plain, starts));
    }

    #[test]
    fn doors_are_inside_and_join_two_cells((coords, offsets) in squares(), sites in lattice(1..20)) {
        let region = region(&coords, &offsets).unwrap();
        let d = diagram(&sites, Watch::default()).unwrap();
        let found = cells::cells(d.view(), &region, Watch::default()).unwrap();
        let all = doors(d.view(), &region, &vec![true; found.sides.len()], Watch::default()).unwrap();
        let sides = sides(&coords, &offsets);
        for (ends, &door) in all.graph.edges.iter().zip(&all.numbers) {
            let [a, b] = ends.map(|end| all.graph.vertices[end as usize]);
            // Off the middle: a corner of the outline may touch a door there from beside. Ways along a side of the
            // outline count as moved to the right and up.
            for part in [0.382, 0.7] {
                let place = [0, 1].map(|i| a[i] + part * (b[i] - a[i]) + 1e-9 / (1.0 + i as f64));
                prop_assert!(by_ray(&sides, place), "{a:?} {b:?}");
            }
            let [p, q] = found.sides[door as usize];
            prop_assert!(p >= 0 && q >= 0 && p != q);
        }
        prop_assert_eq!(all.numbers.len(), found.sides.iter().filter(|sides| sides[0] != -1).count());
    }
}
