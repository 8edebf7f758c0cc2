//! Laws of drawing, from outside.

use std::sync::atomic::{AtomicUsize, Ordering};

use crazing::raster::{Colors, Edges, Frame, Style, render};
use crazing::{Error, Point, Result, Watch};
use proptest::prelude::*;

const BLACK: Style = Style { colors: Colors { ink: [0, 0, 0, 255], ground: [255; 4] }, min_width: 0.0 };

#[derive(Debug, Clone, Default)]
struct Net {
    vertices: Vec<Point>,
    edges: Vec<[i32; 2]>,
    widths: Vec<[f64; 2]>,
}

impl Net {
    fn add(&mut self, ends: [Point; 2], widths: [f64; 2]) {
        let next = self.vertices.len() as i32;
        self.vertices.extend(ends);
        self.edges.push([next, next + 1]);
        self.widths.push(widths);
    }

    fn draw(&self, frame: &Frame, style: &Style, threads: usize) -> Result<Vec<u8>> {
        let mut out = vec![7; frame.height * frame.width * 4];
        let edges = Edges { vertices: &self.vertices, edges: &self.edges, widths: &self.widths };
        render(edges, frame, style, threads, Watch::default(), &mut out)?;
        Ok(out)
    }

    /// Inked area in pixels, from a drawing of black on white.
    fn area(&self, frame: &Frame) -> Result<f64> {
        let out = self.draw(frame, &BLACK, 1)?;
        Ok(out.as_chunks::<4>().0.iter().map(|pixel| f64::from(255 - pixel[0]) / 255.0).sum())
    }
}

/// A picture whose pixels are the data units.
fn pixels(height: usize, width: usize) -> Frame {
    Frame { bounds: [0.0, 0.0, width as f64, height as f64], height, width }
}

fn one(ends: [Point; 2], widths: [f64; 2]) -> Net {
    let mut net = Net::default();
    net.add(ends, widths);
    net
}

/// Short edges all over a square, the same on every machine.
fn thicket(count: u32, side: f64) -> Net {
    let mut net = Net::default();
    let part = |i: u32, step: u32| f64::from(i.wrapping_mul(step) >> 8) / f64::from(1 << 24);
    for i in 0..count {
        let start = [part(i, 0x9E37_79B1) * side, part(i, 0x85EB_CA77) * side];
        let end = [start[0] + part(i, 0xC2B2_AE3D) * 40.0 - 20.0, start[1] + part(i, 0x27D4_EB2F) * 40.0 - 20.0];
        net.add([start, end], [part(i, 0x1656_67B1) * 6.0, part(i, 0x9E37_0001) * 3.0]);
    }
    net
}

fn largest_difference(a: &[u8], b: &[u8]) -> u8 {
    a.iter().zip(b).map(|(p, q)| p.abs_diff(*q)).max().unwrap_or(0)
}

#[test]
fn a_capsule_covers_its_area() -> Result<()> {
    let frame = pixels(200, 300);
    for (width, end) in [(0.7, [251.3, 17.9]), (3.0, [33.3, 140.2]), (41.0, [240.0, 90.1])] {
        let start = [40.2_f64, 100.7];
        let length = (end[0] - start[0]).hypot(end[1] - start[1]);
        let wanted = length * width + std::f64::consts::PI * width * width / 4.0;
        let found = one([start, end], [width, width]).area(&frame)?;
        assert!((found - wanted).abs() < 0.01 * wanted + 0.1, "width {width}: {found} against {wanted}");
    }
    Ok(())
}

#[test]
fn a_taper_to_a_point_covers_its_area() -> Result<()> {
    // The hull of a disc of radius r and a point at distance d: two right triangles and the rest of the disc.
    let (r, d) = (20.0_f64, 120.0_f64);
    let tangent = (d * d - r * r).sqrt();
    let angle = (r / d).acos();
    let wanted = r * tangent + r * r * (std::f64::consts::PI - angle);
    let found = one([[60.0, 60.0], [180.0, 60.0]], [2.0 * r, 0.0]).area(&pixels(128, 256))?;
    assert!((found - wanted).abs() < 0.005 * wanted, "{found} against {wanted}");
    Ok(())
}

#[test]
fn a_disc_within_the_other_adds_nothing() -> Result<()> {
    let frame = pixels(64, 64);
    let within = one([[32.0, 32.0], [35.0, 32.0]], [40.0, 10.0]).draw(&frame, &BLACK, 1)?;
    let alone = one([[32.0, 32.0], [32.0, 32.0]], [40.0, 40.0]).draw(&frame, &BLACK, 1)?;
    assert_eq!(within, alone);
    Ok(())
}

#[test]
fn drawing_twice_changes_nothing() -> Result<()> {
    let frame = pixels(300, 300);
    let net = thicket(300, 300.0);
    let mut twice = net.clone();
    twice.edges.extend(net.edges.iter().map(|edge| [edge[1], edge[0]]));
    twice.widths.extend(net.widths.iter().map(|widths| [widths[1], widths[0]]));
    let worst = largest_difference(&net.draw(&frame, &BLACK, 1)?, &twice.draw(&frame, &BLACK, 1)?);
    assert!(worst <= 12, "{worst}");
    Ok(())
}

#[test]
fn threads_change_nothing() -> Result<()> {
    let frame = pixels(700, 900);
    let net = thicket(3000, 900.0);
    let alone = net.draw(&frame, &BLACK, 1)?;
    for threads in [0, 2, 3, 8] {
        assert!(alone == net.draw(&frame, &BLACK, threads)?, "{threads} threads");
    }
    Ok(())
}

#[test]
fn a_window_shows_what_the_whole_shows() -> Result<()> {
    // The window's tiles lie elsewhere, so a seam or a lost edge would show.
    let net = thicket(2000, 500.0);
    let whole = net.draw(&pixels(500, 500), &BLACK, 1)?;
    let (left, bottom, side) = (37, 53, 300);
    let bounds = [left as f64, bottom as f64, (left + side) as f64, (bottom + side) as f64];
    let window = net.draw(&Frame { bounds, height: side, width: side }, &BLACK, 1)?;
    let top = 500 - bottom - side;
    for (row, line) in window.chunks_exact(4 * side).enumerate() {
        let start = 4 * (500 * (top + row) + left);
        let worst = largest_difference(line, &whole[start..start + 4 * side]);
        // Two samples of 64: corners cut in different places round differently.
        assert!(worst <= 12, "row {row}: {worst}");
    }
    Ok(())
}

#[test]
fn a_quarter_turn_turns_the_picture() -> Result<()> {
    let frame = pixels(256, 256);
    let net = thicket(200, 256.0);
    let mut turned = net.clone();
    turned.vertices.iter_mut().for_each(|point| *point = [256.0 - point[1], point[0]]);
    let (plain, turned) = (net.draw(&frame, &BLACK, 1)?, turned.draw(&frame, &BLACK, 1)?);
    let mut sum = 0_u64;
    for row in 0..256 {
        for column in 0..256 {
            // A turn to the left takes the right column to the top row.
            let there = plain[4 * (256 * column + (255 - row))];
            let here = turned[4 * (256 * row + column)];
            assert!(here.abs_diff(there) <= 64, "row {row}, column {column}: {here} against {there}");
            sum += u64::from(here.abs_diff(there));
        }
    }
    assert!((sum as f64) < 0.4 * 256.0 * 256.0, "{sum}");
    Ok(())
}

#[test]
fn hairlines_stay_with_a_least_width() -> Result<()> {
    let net = one([[5.0, 31.7], [59.0, 33.1]], [0.0, 0.0]);
    let frame = pixels(64, 64);
    assert_eq!(net.area(&frame)?, 0.0);
    let seen = net.draw(&frame, &Style { min_width: 1.0, ..BLACK }, 1)?;
    let darkest = |column: usize| (0..64).map(|row| seen[4 * (64 * row + column)]).min();
    assert!((6..58).all(|column| darkest(column) < Some(140)));
    Ok(())
}

#[test]
fn the_thinnest_lines_do_not_break() -> Result<()> {
    let seen = one([[2.0, 20.3], [250.0, 29.9]], [0.01, 0.01]).draw(&pixels(64, 256), &BLACK, 1)?;
    assert!((4..248).all(|column| (0..64).any(|row| seen[4 * (256 * row + column)] < 255)));
    Ok(())
}

#[test]
fn a_wide_picture_keeps_its_bounds_whole_and_centred() -> Result<()> {
    let frame = Frame { bounds: [0.0, 0.0, 1.0, 1.0], height: 10, width: 30 };
    let out = one([[0.5, 0.5], [0.5, 0.5]], [0.4, 0.4]).draw(&frame, &BLACK, 1)?;
    assert_eq!(out[4 * (30 * 5 + 15)], 0);
    assert_eq!(out[4 * (30 * 5 + 5)], 255);
    Ok(())
}

#[test]
fn bad_input_is_named() {
    let frame = pixels(8, 8);
    let good = one([[1.0, 1.0], [7.0, 7.0]], [1.0, 1.0]);
    let mut net = good.clone();
    net.edges[0] = [0, 2];
    assert!(matches!(net.draw(&frame, &BLACK, 1), Err(Error::BadIndex { array: "edges", row: 0, value: 2, .. })));
    let mut net = good.clone();
    net.widths[0][1] = -1.0;
    assert!(matches!(net.draw(&frame, &BLACK, 1), Err(Error::BadEntry { array: "widths", row: 0, .. })));
    let mut net = good.clone();
    net.vertices[1][0] = f64::NAN;
    assert!(matches!(net.draw(&frame, &BLACK, 1), Err(Error::BadEntry { array: "vertices", row: 1, .. })));
    let mut net = good.clone();
    net.widths.clear();
    assert!(matches!(net.draw(&frame, &BLACK, 1), Err(Error::BadLength { array: "widths", .. })));
    let flat = Frame { bounds: [0.0, 0.0, 0.0, 1.0], ..frame };
    assert!(matches!(good.draw(&flat, &BLACK, 1), Err(Error::BadValue { .. })));
    assert!(matches!(good.draw(&Frame { height: 0, ..frame }, &BLACK, 1), Err(Error::BadValue { .. })));
    assert!(matches!(good.draw(&frame, &Style { min_width: f64::NAN, ..BLACK }, 1), Err(Error::BadValue { .. })));
}

#[test]
fn an_unused_vertex_may_be_infinite() -> Result<()> {
    let mut net = one([[1.0, 1.0], [7.0, 7.0]], [1.0, 1.0]);
    net.vertices.push([f64::INFINITY, f64::NAN]);
    net.draw(&pixels(8, 8), &BLACK, 1).map(drop)
}

#[test]
fn the_watch_stops_the_work() {
    let net = thicket(2000, 1000.0);
    for threads in [1, 4] {
        let asked = AtomicUsize::new(0);
        let go_on = || asked.fetch_add(1, Ordering::Relaxed) < 20;
        let edges = Edges { vertices: &net.vertices, edges: &net.edges, widths: &net.widths };
        let mut out = vec![0; 1000 * 1000 * 4];
        let outcome = render(edges, &pixels(1000, 1000), &BLACK, threads, Watch::new(&go_on), &mut out);
        assert_eq!(outcome, Err(Error::Interrupted));
    }
}

/// Numbers of every size, many of them at places where rounding or overflow lurks.
fn hostile() -> impl Strategy<Value = f64> {
    let special = prop::sample::select(vec![
        0.0,
        -0.0,
        1.0,
        64.0,
        64.0 - 1e-14,
        100.0,
        128.0,
        1e-300,
        5e-324,
        1e300,
        -1e300,
        f64::MAX,
        f64::MIN,
        5e8,
        -5e8,
    ]);
    prop_oneof![2 => special, 4 => -20.0..170.0, 1 => -1e9..1e9, 1 => prop::num::f64::NORMAL]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(3000))]

    #[test]
    fn no_finite_input_breaks_it(
        drawn in prop::collection::vec((hostile(), hostile(), hostile(), hostile(), hostile(), hostile()), 1..6),
        joined in any::<bool>(),
    ) {
        let mut net = Net::default();
        for (a, b, c, d, e, f) in drawn {
            let ends = if joined { [[a, b], [a, b]] } else { [[a, b], [c, d]] };
            net.add(ends, [e.abs(), f.abs()]);
        }
        let out = net.draw(&pixels(100, 150), &BLACK, 1)?;
        prop_assert!(out.as_chunks::<4>().0.iter().all(|pixel| pixel[3] == 255 && pixel[0] == pixel[1]));
    }

    #[test]
    fn no_frame_breaks_it(bounds in [hostile(), hostile(), hostile(), hostile()]) {
        let net = thicket(20, 100.0);
        let outcome = net.draw(&Frame { bounds, height: 70, width: 90 }, &BLACK, 1);
        let is_fine = matches!(outcome, Ok(_) | Err(Error::BadValue { .. }));
        prop_assert!(is_fine);
    }

    #[test]
    fn far_ends_draw_the_same_near_part(slope in -3.0..3.0_f64, far in 1.0..9.0_f64, width in 1.0..30.0_f64) {
        // The part of a long line within the picture does not depend on where its ends are.
        let line = |reach: f64| one([[50.0 - reach, 50.0 - slope * reach], [50.0 + reach, 50.0 + slope * reach]], [width; 2]);
        let near = line(200.0).draw(&pixels(100, 100), &BLACK, 1)?;
        let away = line(10_f64.powf(far) + 200.0).draw(&pixels(100, 100), &BLACK, 1)?;
        prop_assert!(largest_difference(&near, &away) <= 40);
    }
}
