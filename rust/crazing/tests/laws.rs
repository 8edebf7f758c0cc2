//! What must not change any crust or axis: another unit, another origin, a quarter turn, another order of the samples.
//! (`curve` is not among them: it is a search, and in samples of no curve there are many good answers.)
#![allow(clippy::unwrap_used, missing_docs)]

mod families;

use std::collections::{BTreeMap, BTreeSet};

use crazing::diagram::diagram;
use crazing::skeleton::{
    Variant, axis_edges, edge_filter, gabriel, nearest, one_step, poles, poles_axis, second, two_pass,
};
use crazing::{Diagram, Point, Watch};
use families::family;

/// Edges by their samples, axis edges by the samples of their two triangles.
type Found = BTreeMap<&'static str, BTreeSet<Vec<usize>>>;

/// What is done to the samples, in words and in deed.
type Change = (&'static str, fn(Point) -> Point);

fn sorted(mut rows: Vec<usize>) -> Vec<usize> {
    rows.sort_unstable();
    rows
}

/// Edges of a mask, by the names of their samples.
fn edges(d: &Diagram, name: &impl Fn(i32) -> usize, mask: &[bool]) -> BTreeSet<Vec<usize>> {
    let kept = d.edges.iter().zip(mask).filter(|(_, kept)| **kept);
    kept.map(|(ends, _)| sorted(ends.map(name).to_vec())).collect()
}

/// What every method finds; `name` is the sample of a row.
fn found(points: &[Point], name: impl Fn(i32) -> usize) -> Found {
    let d = diagram(points, Watch::default()).unwrap();
    let (view, calm) = (d.view(), Watch::default());
    let triangle = |t: i32| sorted(d.triangles[t as usize].map(&name).to_vec());
    let axis = |rows: Vec<[i32; 2]>| -> BTreeSet<Vec<usize>> {
        let ends = rows.into_iter().map(|[a, b]| [triangle(a), triangle(b)]);
        ends.map(|[a, b]| if a < b { [a, b].concat() } else { [b, a].concat() }).collect()
    };
    let one = one_step(view).unwrap();
    let not: Vec<bool> = one.iter().map(|crust| !crust).collect();
    let poles_of = |variant| -> BTreeSet<Vec<usize>> {
        let rows = poles(view, variant, Watch::default()).unwrap();
        let corners = |pole: i32| if pole == -1 { Vec::new() } else { triangle(pole) };
        let row =
            |(site, pair): (usize, &[i32; 2])| [vec![name(site as i32)], corners(pair[0]), corners(pair[1])].concat();
        rows.iter().enumerate().map(row).collect()
    };
    BTreeMap::from([
        ("one-step", edges(&d, &name, &one)),
        ("one-step axis", axis(axis_edges(view, &not))),
        ("two-pass", edges(&d, &name, &two_pass(view).unwrap())),
        ("edge-filter", edges(&d, &name, &edge_filter(view).unwrap().axis)),
        ("gabriel", edges(&d, &name, &gabriel(view).unwrap())),
        ("nn", edges(&d, &name, &nearest(view, Watch::default()).unwrap())),
        ("initial", axis(second(view, calm).unwrap().axis)),
        ("poles, thesis", poles_of(Variant::Thesis)),
        ("poles, amenta", poles_of(Variant::Amenta)),
        ("poles axis", axis(poles_axis(view, Variant::Thesis, calm).unwrap())),
    ])
}

/// Families without ties, on a grid so fine that moving them far away is exact.
fn samples(n: usize) -> Vec<(&'static str, Vec<Point>)> {
    let fine = |x: f64| (x * 16_777_216.0).round() / 16_777_216.0;
    let noise = family("uniform", n, 7);
    let near: Vec<Point> = family("uniform", n, 9).iter().map(|p| [p[0], p[1] / 4096.0]).collect();
    let noisy: Vec<Point> =
        family("curve", n, 0).iter().zip(&noise).map(|(p, e)| [p[0] + 0.02 * e[0], p[1] + 0.02 * e[1]]).collect();
    let clusters: Vec<Point> =
        noise.iter().enumerate().map(|(i, p)| [(i % 3) as f64 + p[0] / 64.0, (i % 2) as f64 + p[1] / 64.0]).collect();
    let all = [("uniform", noise), ("nearly flat", near), ("noisy curve", noisy), ("clusters", clusters)];
    all.map(|(name, points)| (name, points.iter().map(|p| p.map(fine)).collect())).to_vec()
}

fn assert_same(of: &str, change: &str, a: &Found, b: &Found) {
    for (method, rows) in a {
        assert!(rows == &b[method], "{method} of {of} differs {change}");
    }
}

#[test]
fn no_method_sees_the_unit_the_origin_or_a_quarter_turn() {
    for (name, points) in samples(80) {
        let same = |i: i32| i as usize;
        let plain = found(&points, same);
        // 2^30 is 1.07e9; the offset is some 2^20 extents.
        let changes: [Change; 7] = [
            ("in a small unit", |p| p.map(|x| x / f64::from(1 << 30))),
            ("in a large unit", |p| p.map(|x| x * f64::from(1 << 30))),
            ("moved far away", |[x, y]| [x + 2_097_152.0, y - 4_194_304.0]),
            ("turned by a quarter", |[x, y]| [-y, x]),
            ("turned by a half", |[x, y]| [-x, -y]),
            ("turned by three quarters", |[x, y]| [y, -x]),
            ("mirrored", |[x, y]| [-x, y]),
        ];
        for (what, change) in changes {
            let changed: Vec<Point> = points.iter().copied().map(change).collect();
            assert_same(name, what, &plain, &found(&changed, same));
        }
    }
}

#[test]
fn no_method_sees_the_order_of_the_samples() {
    for (name, points) in samples(80) {
        let row = |i: usize| (27 * i + 11) % points.len();
        let shuffled: Vec<Point> = (0..points.len()).map(|i| points[row(i)]).collect();
        assert_same(name, "in another order", &found(&points, |i| i as usize), &found(&shuffled, |i| row(i as usize)));
    }
}

/// The methods that do not depend on how ties are triangulated.
const STEADY: [&str; 4] = ["one-step", "two-pass", "edge-filter", "nn"];

#[test]
fn ties_change_nothing_either() {
    // A brick wall, a lattice of triangles' sides, and two rings: all ties.
    let wall = |i: usize| [(2 * (i % 9) + (i / 9) % 2) as f64, (2 * (i / 9)) as f64];
    let square = |i: usize| [(i % 9) as f64, (i / 9) as f64];
    let corners =
        [[5, 0], [4, 3], [3, 4], [0, 5], [-3, 4], [-4, 3], [-5, 0], [-4, -3], [-3, -4], [0, -5], [3, -4], [4, -3]];
    let rings: Vec<Point> = (1..=5).flat_map(|r| corners.map(|[x, y]| [f64::from(r * x), f64::from(r * y)])).collect();
    let sets = [("wall", (0..80).map(wall).collect()), ("square", (0..81).map(square).collect()), ("rings", rings)];
    for (name, points) in sets {
        let key = |p: Point| p.map(|x| (x + 100.0) as usize);
        let by = |points: &[Point], back: fn(Point) -> Point| -> Found {
            let d = diagram(points, Watch::default()).unwrap();
            let place = |site: i32| key(back(d.sites[site as usize]));
            let row = |ends: &[i32; 2]| {
                let [a, b] = ends.map(place);
                if a < b { [a, b].concat() } else { [b, a].concat() }
            };
            let rows =
                |mask: Vec<bool>| d.edges.iter().zip(mask).filter(|(_, kept)| *kept).map(|(e, _)| row(e)).collect();
            let masks = [
                one_step(d.view()).unwrap(),
                two_pass(d.view()).unwrap(),
                edge_filter(d.view()).unwrap().axis,
                nearest(d.view(), Watch::default()).unwrap(),
            ];
            STEADY.into_iter().zip(masks.map(rows)).collect()
        };
        let plain = by(&points, |p| p);
        let turned: Vec<Point> = points.iter().map(|&[x, y]| [-y, x]).collect();
        assert_same(name, "turned by a quarter", &plain, &by(&turned, |[x, y]| [y, -x]));
        let moved: Vec<Point> = points.iter().map(|&[x, y]| [x + 67_108_864.0, y - 33_554_432.0]).collect();
        assert_same(name, "moved far away", &plain, &by(&moved, |[x, y]| [x - 67_108_864.0, y + 33_554_432.0]));
        let shuffled: Vec<Point> = (0..points.len()).map(|i| points[(37 * i + 5) % points.len()]).collect();
        assert_same(name, "in another order", &plain, &by(&shuffled, |p| p));
    }
}
