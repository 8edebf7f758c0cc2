//! Inputs that broke a way of loading spade, kept as what decided how we load it, and run through ours.
//!
//! On spade 2.12 `bulk_load` looped for ever on the six points and gave wrong triangulations over many decades; the
//! release in use is asked again here, on copies of the inputs that our own path must pass.
#![allow(clippy::unwrap_used, missing_docs)]

mod families;

use std::sync::mpsc;
use std::time::Duration;

use crazing::diagram::diagram;
use crazing::{Point, Watch};
use families::{FAMILIES, family};
use spade::{DelaunayTriangulation, Point2, Triangulation};

const SIX: [Point; 6] = [
    [0.499_999_999_996_362, 0.499_999_999_996_362],
    [0.499_999_999_996_362, 0.999_999_999_992_724],
    [0.499_999_999_994_543_03, 0.0],
    [0.499_999_999_996_362, 0.749_999_999_994_543],
    [34_359_738_368.5, 0.999_999_999_996_362],
    [0.499_999_999_998_181, 0.249_999_999_998_181],
];

/// Runs `work` on a thread of its own and gives up on it after a while, as no loop in it could be stopped.
fn ends<T: Send + 'static>(work: impl FnOnce() -> T + Send + 'static) -> Option<T> {
    let (send, receive) = mpsc::channel();
    std::thread::spawn(move || send.send(work()));
    receive.recv_timeout(Duration::from_secs(20)).ok()
}

fn triangles_by_bulk(points: &[Point]) -> Option<usize> {
    let points: Vec<_> = points.iter().map(|p| Point2::new(p[0], p[1])).collect();
    ends(move || DelaunayTriangulation::<Point2<f64>>::bulk_load(points).map(|mesh| mesh.num_inner_faces()).ok())
        .flatten()
}

#[test]
fn six_points_on_which_bulk_loading_once_looped_for_ever() {
    let d = ends(|| diagram(&SIX, Watch::default()).unwrap()).expect("our path ends");
    assert_eq!((d.sites.len(), d.edges.len() - d.triangles.len()), (6, 5));
    assert_eq!(triangles_by_bulk(&SIX), Some(d.triangles.len()), "the release in use has the six points mended");
}

#[test]
fn sites_with_their_own_voronoi_vertices() {
    for name in FAMILIES {
        let d = diagram(&family(name, 200, 11), Watch::default()).unwrap();
        let both: Vec<Point> = d.sites.iter().chain(&d.vertices).copied().collect();
        let again = ends(move || diagram(&both, Watch::default()).unwrap()).expect(name);
        assert_eq!(again.sites.len() + again.triangles.len(), again.edges.len() + 1, "{name}");
    }
}

#[test]
fn all_on_one_line_but_one() {
    let mut points: Vec<Point> = (0..100_000).map(|i| [f64::from(i), 0.0]).collect();
    points.insert(50_000, [0.5, 1.0]);
    let d = ends(move || diagram(&points, Watch::default()).unwrap()).expect("not quadratic");
    assert_eq!(d.triangles.len(), 99_999);
}

#[test]
fn a_regular_polygon_with_its_centre() {
    let mut points = family("circle", 100_000, 0);
    points.push([0.0, 0.0]);
    let d = ends(move || diagram(&points, Watch::default()).unwrap()).expect("not quadratic");
    assert_eq!(d.sites.len(), 100_001);
}
